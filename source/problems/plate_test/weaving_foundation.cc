// SPDX-License-Identifier: LGPL-2.1-or-later
// The soft foundation of weaving.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/problems/plate_test/weaving_foundation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    // Four orders below the stiffness of contact in the default cell.
    const double share_of_shear_modulus = 4.40704e-3;

    // [N/mm per mm^3 of bundle]
    double
    stiffness_per_volume(const PlateCell &cell)
    {
      double G = std::numeric_limits<double>::max();
      for (const auto &law : cell.bodies().laws())
        {
          const auto C = law->small_strain_stiffness();
          // Voigt's order: the shears are the last ones.
          const unsigned int n_axes = 3;
          for (unsigned int shear = n_axes; shear < C.m(); ++shear)
            G = std::min(G, C(shear, shear));
        }
      const double t = cell.fabric().weaving_offset();
      return share_of_shear_modulus * G / (t * t);
    }
  } // namespace



  WeavingFoundation::WeavingFoundation(const PlateCell &cell)
  {
    const FabricCell         &fabric = cell.fabric();
    const IGASpace<3>        &space  = cell.bodies().space();
    const double              kappa  = stiffness_per_volume(cell);
    const std::vector<double> volume =
      cell.bodies().integrals_of_functions(true);
    std::vector<unsigned int> membrane;
    for (const unsigned int n : represented_modes(fabric))
      if (MacroModes::table[n].kind == MacroMode::Kind::membrane)
        membrane.push_back(n);

    for (unsigned int b = 0; b < space.n_patches(); ++b)
      for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
        {
          const unsigned int A = space.control_point(b, l);
          for (unsigned int i = 0; i < 3; ++i)
            {
              if (!fabric.can_float(b)[i] || volume[A] == 0.)
                continue;
              Spring spring{b, kappa * volume[A], {3 * A + i}, {1.}};
              for (const unsigned int n : membrane)
                {
                  const double w_m =
                    macroscopic_displacement(n, space.control_points()[A])[i];
                  if (w_m == 0.)
                    continue;
                  spring.unknowns.push_back(cell.macro().mode(n));
                  spring.factors.push_back(-w_m);
                }
              springs_.push_back(spring);
            }
        }
  }



  double
  WeavingFoundation::Spring::elongation(const Vector<double> &u) const
  {
    double sum = 0;
    for (unsigned int k = 0; k < unknowns.size(); ++k)
      sum += factors[k] * u[unknowns[k]];
    return sum;
  }



  void
  WeavingFoundation::add_groups(ConstrainedSystem &system)
  {
    for (Spring &spring : springs_)
      spring.group = system.add_group(spring.unknowns);
  }



  void
  WeavingFoundation::add_residual(const Vector<double> &u,
                                  const double          share,
                                  Vector<double>       &residual) const
  {
    for (const Spring &spring : springs_)
      {
        const double force = share * spring.stiffness * spring.elongation(u);
        for (unsigned int k = 0; k < spring.unknowns.size(); ++k)
          residual[spring.unknowns[k]] += force * spring.factors[k];
      }
  }



  void
  WeavingFoundation::add_tangent(const double       share,
                                 ConstrainedSystem &system) const
  {
    std::vector<double> K;
    for (const Spring &spring : springs_)
      {
        K.clear();
        for (const double a : spring.factors)
          for (const double b : spring.factors)
            K.push_back(share * spring.stiffness * a * b);
        system.add(spring.group, K);
      }
  }



  double
  WeavingFoundation::energy(const Vector<double> &u) const
  {
    double energy = 0;
    for (const Spring &spring : springs_)
      {
        const double x = spring.elongation(u);
        energy += 0.5 * spring.stiffness * x * x;
      }
    return energy;
  }



  double
  WeavingFoundation::largest_force(const Vector<double> &u,
                                   const double          share) const
  {
    std::map<unsigned int, double> of_bundle;
    double                         largest = 0;
    for (const Spring &spring : springs_)
      {
        double &force = of_bundle[spring.bundle];
        force += share * spring.stiffness * std::abs(spring.elongation(u));
        largest = std::max(largest, force);
      }
    return largest;
  }
} // namespace NPT
