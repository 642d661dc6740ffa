// SPDX-License-Identifier: LGPL-2.1-or-later
// Solids against exact solutions: the two kinds of comparison on one page, the
// steps below in the order in which they are used. What is written and judged
// is in solid_benchmark_results.cc.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/iga/iga_surface.h>
#include <npt_dealii/iga/iga_values.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/verification/solids/benchmark_bodies.h>
#include <npt_dealii/verification/solids/driven_solid.h>
#include <npt_dealii/verification/solids/solid_benchmark.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    double
    largest_component(const Tensor<2, 3> &T)
    {
      double largest = 0;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          largest = std::max(largest, std::abs(T[i][j]));
      return largest;
    }

    /// The material of the computed body; the exact solution does not know of
    /// the factor.
    MaterialParameters
    computed_material(const SolidBenchmarkParameters &p)
    {
      MaterialParameters material = p.material;
      material.constants<NeoHookeanParameters>().young_modulus *=
        p.stiffness_factor;
      FiberBundleConstants &c =
        material.constants<FiberBundleParameters>().constants;
      for (double *constant : {&c.mu, &c.lambda, &c.a, &c.b, &c.c, &c.d})
        *constant *= p.stiffness_factor;
      return material;
    }
  } // namespace



  SolidBenchmark::SolidBenchmark(const SolidBenchmarkParameters &parameters,
                                 const std::string              &directory,
                                 std::ostream                   &screen)
    : parameters_(parameters)
    , directory_(directory)
    , log_(RunLog::in_folder(directory, screen))
    , case_(SolidCases::instance().get(parameters.name))
    , exact_(case_.is_homogeneous() ? nullptr :
                                      case_.make_exact_solution(parameters))
    , linear_solver_(parameters.linear_solver)
  {}



  void
  SolidBenchmark::run()
  {
    begin_output();
    if (case_.is_homogeneous())
      compare_homogeneous_states();
    else
      measure_rates();
    finish_output(); // throws if a tolerance is missed
  }



  void
  SolidBenchmark::measure_rates()
  {
    for (const auto &[basis_name, basis] : parameters_.bases)
      for (const unsigned int degree : parameters_.degrees)
        for (const unsigned int n_elements : parameters_.n_elements)
          {
            ConvergenceRow row;
            row.basis          = basis_name;
            row.degree         = degree;
            row.n_elements     = n_elements;
            const double start = process_cpu_seconds();

            make_body(basis, degree, n_elements); // exact geometry, refined
            hold_symmetry_planes(); // plane strain, single-valued at the pole
            assemble_load();        // tension at the edges, inner pressure
            solve_linear_problem(); // K(0) w = f
            compute_errors(row);

            row.cpu_seconds = process_cpu_seconds() - start;
            judge_and_write(row);
          }
  }



  void
  SolidBenchmark::compare_homogeneous_states()
  {
    // Directions mean something only to the law with a fiber.
    std::vector<unsigned int> fiber_axes = parameters_.fiber_axes;
    if (parameters_.material.selected<NeoHookeanParameters>())
      fiber_axes.assign(1, 0);

    for (const auto &[mode_name, mode] : parameters_.modes)
      for (const unsigned int axis : fiber_axes)
        {
          const HomogeneousState exact =
            homogeneous_state(parameters_.material,
                              axis,
                              mode,
                              mode == HomogeneousMode::simple_shear ?
                                parameters_.shear :
                                parameters_.stretch);
          for (const auto &[basis_name, basis] : parameters_.bases)
            for (const unsigned int degree : parameters_.degrees)
              for (const unsigned int n_elements : parameters_.n_elements)
                {
                  HomogeneousRow row;
                  row.mode       = mode_name;
                  row.fiber_axis = axis;
                  row.basis      = basis_name;
                  row.degree     = degree;
                  row.n_elements = n_elements;
                  row.P_exact    = exact.P;

                  make_block(basis, degree, n_elements, axis);
                  drive_faces(mode, exact.F);
                  row.n_iterations = solve_load_steps(mode_name);
                  compute_stress(row);
                  judge_and_write(row);
                }
        }
  }



  // ------------------------------------------- linear problems: rates

  void
  SolidBenchmark::make_body(const Basis        basis,
                            const unsigned int degree,
                            const unsigned int n_elements)
  {
    const double a = parameters_.inner_radius, b = parameters_.outer_size;
    // Nothing changes through the thickness of plate and cylinder.
    const double               thickness = (b - a) / n_elements;
    std::vector<NURBSPatch<3>> patches =
      case_.make_patches(parameters_, thickness);

    std::vector<DeformablePart> parts;
    for (NURBSPatch<3> &patch : patches)
      {
        refine(patch,
               degree,
               {{parameters_.radial_factor * n_elements,
                 n_elements,
                 case_.plane_strain ? 1 : n_elements}});
        parts.push_back({patch,
                         make_material<3>(computed_material(parameters_),
                                          Point<3>::unit_vector(0)),
                         0,
                         "patch " + std::to_string(parts.size())});
      }
    body_ =
      std::make_unique<DeformableBodies>(std::move(parts),
                                         basis,
                                         degree + 1 +
                                           parameters_.additional_gauss_points);
  }



  void
  SolidBenchmark::hold_symmetry_planes()
  {
    const IGASpace<3> &space        = body_->space();
    const bool         plane_strain = case_.plane_strain;
    const double       tolerance    = 1e-10 * parameters_.outer_size;

    dealii::AffineConstraints<double> constraints;
    for (unsigned int A = 0; A < space.n_control_points(); ++A)
      for (unsigned int d = 0; d < 3; ++d)
        if (std::abs(space.control_points()[A][d]) < tolerance ||
            (plane_strain && d == 2))
          constraints.add_line(3 * A + d);

    // Plane strain: the solution does not depend on the third direction, and
    // neither does the discrete one, so one layer of control points is enough.
    // Sphere: control points that coincide at the pole move together.
    for (unsigned int p = 0; p < space.n_patches(); ++p)
      for (unsigned int l = 0; l < space.patch(p).n_control_points(); ++l)
        {
          auto index = space.patch(p).multi_index(l);
          if (index[2] == 0 || (!plane_strain && index[1] > 0))
            continue;
          index[2]             = 0;
          const unsigned int A = space.control_point(p, l);
          const unsigned int B =
            space.control_point(p, space.patch(p).index(index));
          for (unsigned int d = 0; d < 3; ++d)
            if (!constraints.is_constrained(3 * A + d))
              {
                constraints.add_line(3 * A + d);
                constraints.add_entry(3 * A + d, 3 * B + d, 1.);
              }
        }
    constraints.close();
    system_.reinit(constraints, body_->n_displacements());
    cell_groups_ = body_->add_groups(system_);
    system_.build_pattern();
    system_.set_prescribed(std::vector<bool>(system_.n_independent(), false));
  }



  void
  SolidBenchmark::assemble_load()
  {
    load_.reinit(body_->n_displacements());
    const bool pressure = case_.inner_pressure;
    // The loaded faces are those of the first direction: the inner one of
    // cylinder and sphere, the outer ones of the plate.
    for (unsigned int p = 0; p < body_->space().n_patches(); ++p)
      {
        const IGASurface<3> surface(body_->space(), p, 0, pressure ? 0 : 1);
        for (const auto &point : surface.quadrature(surface.degree() + 3))
          {
            const auto  &shape = point.shape;
            Tensor<1, 3> tangent[2];
            for (unsigned int l = 0; l < shape.lattice.size(); ++l)
              for (unsigned int a = 0; a < 2; ++a)
                tangent[a] += shape.first[a][l] *
                              surface.reference_position(shape.lattice[l]);
            Tensor<1, 3> normal = cross_product_3d(tangent[0], tangent[1]);
            normal *= surface.orientation() / normal.norm();
            const Tensor<1, 3> traction = pressure ?
                                            -parameters_.load * normal :
                                            exact_->stress(point.X) * normal;
            for (unsigned int l = 0; l < shape.lattice.size(); ++l)
              for (unsigned int i = 0; i < 3; ++i)
                load_[3 * surface.control_point(shape.lattice[l]) + i] +=
                  shape.value[l] * traction[i] * point.area;
          }
      }
  }



  void
  SolidBenchmark::solve_linear_problem()
  {
    u_.reinit(body_->n_displacements());
    system_.set_zero();
    body_->add_tangent(u_, cell_groups_, system_);

    Vector<double> rhs, m;
    system_.condense(load_, rhs);
    linear_solver_.factorize(system_.free_matrix());
    linear_solver_.solve(rhs, m);
    // The solver is content with a residual of 1e-12; degree four on a fine
    // mesh wants the last digits too.
    Vector<double> correction;
    system_.matrix().vmult(correction, m);
    rhs -= correction;
    linear_solver_.solve(rhs, correction);
    m += correction;
    system_.expand(m, u_);
  }



  void
  SolidBenchmark::compute_errors(ConvergenceRow &row) const
  {
    const auto  &law = parameters_.material.constants<NeoHookeanParameters>();
    const double E   = law.young_modulus;
    const double nu  = law.poisson_ratio;
    const double mu  = E / (2. * (1. + nu));
    const double lambda = 2. * mu * nu / (1. - 2. * nu);
    // sigma : S : sigma
    const auto energy = [&](const Tensor<2, 3> &sigma) {
      return ((1. + nu) * sigma.norm_square() -
              nu * trace(sigma) * trace(sigma)) /
             E;
    };

    double       e_energy = 0, e_L2 = 0, u_energy = 0, u_L2 = 0;
    IGAValues<3> values(body_->space(), row.degree + 2);
    for (const auto &cell :
         body_->space().triangulation().active_cell_iterators())
      {
        values.reinit(cell);
        for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
          {
            Tensor<1, 3> u_h;
            Tensor<2, 3> grad_u;
            for (unsigned int a = 0; a < values.dofs_per_cell(); ++a)
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const double w = u_[3 * values.control_points()[a] + i];
                  u_h[i] += w * values.shape_value(a, q);
                  for (unsigned int j = 0; j < 3; ++j)
                    grad_u[i][j] += w * values.shape_grad(a, q)[j];
                }
            const Tensor<2, 3> strain = 0.5 * (grad_u + transpose(grad_u));
            Tensor<2, 3>       stress = 2. * mu * strain;
            for (unsigned int i = 0; i < 3; ++i)
              stress[i][i] += lambda * trace(strain);

            const Tensor<1, 3> u =
              exact_->displacement(values.quadrature_point(q));
            const Tensor<2, 3> sigma =
              exact_->stress(values.quadrature_point(q));
            e_energy += energy(stress - sigma) * values.JxW(q);
            u_energy += energy(sigma) * values.JxW(q);
            e_L2 += (u_h - u).norm_square() * values.JxW(q);
            u_L2 += u.norm_square() * values.JxW(q);
          }
      }
    row.error_energy = std::sqrt(e_energy / u_energy);
    row.error_L2     = std::sqrt(e_L2 / u_L2);
    row.n_cells      = body_->space().cells().size();
    row.n_unknowns   = system_.n_independent();
  }



  // ------------------------------ finite strain: homogeneous states

  void
  SolidBenchmark::make_block(const Basis        basis,
                             const unsigned int degree,
                             const unsigned int n_elements,
                             const unsigned int fiber_axis)
  {
    NURBSPatch<3> block = unit_block();
    refine(block, degree, {{n_elements, n_elements, n_elements}});
    distort(block, parameters_.distortion);
    std::vector<DeformablePart> parts;
    parts.push_back({block,
                     make_material<3>(computed_material(parameters_),
                                      Point<3>::unit_vector(fiber_axis)),
                     0,
                     "the block"});
    try
      {
        body_ = std::make_unique<DeformableBodies>(
          std::move(parts),
          basis,
          degree + 1 + parameters_.additional_gauss_points);
      }
    catch (const InvertedCell &)
      {
        std::ostringstream text;
        text << "Distortion is " << parameters_.distortion
             << ", which folds the mesh; choose a smaller one (subsection "
                "Homogeneous states).";
        throw InputError(text.str());
      }
  }



  void
  SolidBenchmark::drive_faces(const HomogeneousMode mode, const Tensor<2, 3> &F)
  {
    system_.reinit(dealii::AffineConstraints<double>(),
                   body_->n_displacements());
    cell_groups_ = body_->add_groups(system_);
    system_.build_pattern();

    // w = (F - 1) X is a linear field, which control points carry like nodes.
    std::vector<bool> prescribed(system_.n_independent(), false);
    target_.reinit(system_.n_independent());
    for (unsigned int A = 0; A < body_->space().n_control_points(); ++A)
      {
        const Point<3> X      = body_->space().control_points()[A];
        const auto on_face_at = [&](const unsigned int d, const double side) {
          return std::abs(X[d] - side) < 1e-10;
        };
        bool on_boundary = false;
        for (unsigned int d = 0; d < 3; ++d)
          on_boundary = on_boundary || on_face_at(d, 0.) || on_face_at(d, 1.);

        const Tensor<1, 3> w = F * X - X;
        for (unsigned int d = 0; d < 3; ++d)
          {
            const bool driven_direction =
              d == 0 || mode == HomogeneousMode::dilation ||
              (d == 1 && mode == HomogeneousMode::equibiaxial);
            const bool held =
              mode == HomogeneousMode::simple_shear ?
                on_boundary :
                on_face_at(d, 0.) || (driven_direction && on_face_at(d, 1.));
            if (held)
              {
                const int k   = system_.independent_index(3 * A + d);
                prescribed[k] = true;
                target_[k]    = w[d];
              }
          }
      }
    system_.set_prescribed(prescribed);
  }



  unsigned int
  SolidBenchmark::solve_load_steps(const std::string &name)
  {
    unsigned int      n_iterations = 0;
    const DrivenSolid problem(*body_, cell_groups_, target_);
    State             natural_state;
    natural_state.u.reinit(body_->n_displacements());
    LoadStepper stepper(
      parameters_.newton, ContactParameters(), system_, linear_solver_, log_);
    u_ = stepper
           .run(problem,
                natural_state,
                parameters_.steps,
                name,
                LoadStepper::Predictor::proportional,
                [&](const AcceptedStep &step) {
                  n_iterations += step.report.newton.iterations;
                })
           .u;
    return n_iterations;
  }



  void
  SolidBenchmark::compute_stress(HomogeneousRow &row) const
  {
    const double largest = largest_component(row.P_exact);
    double       volume  = 0;
    row.error_pointwise  = 0;
    body_->for_each_point(u_, [&](const auto &point) {
      row.P += point.P * point.dV;
      volume += point.dV;
      row.error_pointwise =
        std::max(row.error_pointwise,
                 largest_component(point.P - row.P_exact) / largest);
    });
    row.P /= volume;
    row.error_average = largest_component(row.P - row.P_exact) / largest;
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters =
        SolidBenchmarkParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters))
        return;
      const std::string directory =
        make_output_directory(command, parameters.directory);
      const OutputFolder folder(directory);
      SolidBenchmark     benchmark(parameters, directory, std::cout);
      benchmark.run();
    }

    const Registry<Problem>::Registration
      registration("solid benchmark",
                   {4, "a comparison of solids with exact solutions", start});
  } // namespace
} // namespace NPT
