// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the sections whose wide face is one arch, and registers them.

#include <npt_dealii/fabric/arch_sections.h>
#include <npt_dealii/fabric/section_shape.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace NPT
{
  using namespace SectionTools;

  namespace ArchSection
  {
    double
    half_height(const BundleSection &section, const double n, const double y)
    {
      const double eta = 2 * y / section.width;
      const double cut =
        1. - std::pow(2 * section.tip / section.thickness, 2. / n);
      return 0.5 * section.thickness * std::pow(1. - cut * eta * eta, 0.5 * n);
    }



    double
    edge_angle(const BundleSection &section, const double n)
    {
      const double epsilon = 2 * section.tip / section.thickness;
      const double slope   = n * section.thickness / section.width *
                           (1. - std::pow(epsilon, 2. / n)) *
                           std::pow(epsilon, 1. - 2. / n);
      return std::atan(slope) * 180. / dealii::numbers::PI;
    }
  } // namespace ArchSection



  namespace
  {
    // ---- Lens --------------------------------------------------------------
    double
    lens_area(const BundleSection &section)
    {
      return section.width *
             (2 * section.tip +
              4. / 3. * (0.5 * section.thickness - section.tip));
    }

    NURBSPatch<2>
    lens_patch(const BundleSection &section,
               const unsigned int   degree,
               const unsigned int   n_across)
    {
      const double a = 0.5 * section.width, e = section.tip;
      // In Bernstein form 1 - (2y/w)^2 has the coefficients 0, 2, 0.
      NURBSPatch<2> patch = between_faces(KnotVector::uniform(2, 1),
                                          {-a, 0., a},
                                          {e, section.thickness - e, e},
                                          {1., 1., 1.});
      patch.elevate_degree(0, degree - 2);
      patch.subdivide(0, n_across);
      return patch;
    }



    // ---- Ellipse -----------------------------------------------------------
    double
    ellipse_area(const BundleSection &section)
    {
      // Two segments of the affine circle beyond the cuts are missing.
      const double epsilon = 2 * section.tip / section.thickness;
      const double cut     = std::sqrt(1 - epsilon * epsilon);
      return 0.5 * section.width / cut * section.thickness *
             (std::asin(cut) + cut * epsilon);
    }

    NURBSPatch<2>
    ellipse_patch(const BundleSection &section,
                  const unsigned int   degree,
                  const unsigned int   n_across)
    {
      const double a = 0.5 * section.width, b = 0.5 * section.thickness;
      // Affine image of a circular arc: the weight of the middle control point
      // is the cosine of half the opening, which is 2e/t here, and the tangents
      // at the ends meet at t/2 over this cosine.
      const double  weight = section.tip / b;
      NURBSPatch<2> patch =
        between_faces(KnotVector::uniform(2, 1),
                      {-a, 0., a},
                      {section.tip, b / weight, section.tip},
                      {1., weight, 1.});
      patch.elevate_degree(0, degree - 2);
      patch.insert_knots(0, equally_wide(patch, {n_across}));
      return patch;
    }



    // ---- Power ellipse -----------------------------------------------------
    const std::string power_entry = "Section power";

    double
    power_half_height(const BundleSection &section, const double y)
    {
      return ArchSection::half_height(section, section.number(power_entry), y);
    }

    double
    power_area(const BundleSection &section)
    {
      const dealii::QGauss<1> gauss(64);
      double                  sum = 0;
      for (unsigned int q = 0; q < gauss.size(); ++q)
        sum +=
          gauss.weight(q) * section.width * 2 *
          power_half_height(section, section.width * (gauss.point(q)[0] - 0.5));
      return sum;
    }

    double
    power_edge_angle(const BundleSection &section)
    {
      return ArchSection::edge_angle(section, section.number(power_entry));
    }

    NURBSPatch<2>
    power_patch(const BundleSection &section,
                const unsigned int   degree,
                const unsigned int   n_across)
    {
      const KnotVector           knots = KnotVector::uniform(degree, n_across);
      const unsigned int         n     = knots.n_functions();
      dealii::FullMatrix<double> N(n, n);
      std::vector<double>        y(n), h(n), value(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          const double       u   = knots.greville(i);
          const unsigned int e   = knots.find_span(u);
          const auto         N_i = knots.values(e, u, 0)[0];
          for (unsigned int k = 0; k < N_i.size(); ++k)
            N(i, knots.first_function(e) + k) = N_i[k];
          y[i]     = section.width * (u - 0.5);
          value[i] = power_half_height(section, y[i]);
        }
      N.gauss_jordan();
      for (unsigned int i = 0; i < n; ++i)
        {
          h[i] = 0;
          for (unsigned int k = 0; k < n; ++k)
            h[i] += N(i, k) * value[k];
        }
      // y(u) is linear, and its coefficients are the Greville points.
      return between_faces(knots, y, h, std::vector<double>(n, 1.));
    }



    // An exact arch of fixed n.
    SectionShape
    arch(const double n,
         double (*area)(const BundleSection &),
         NURBSPatch<2> (*patch)(const BundleSection &,
                                const unsigned int,
                                const unsigned int))
    {
      return {[n](const BundleSection &section, const double y) {
                return ArchSection::half_height(section, n, y);
              },
              area,
              [n](const BundleSection &section) {
                return ArchSection::edge_angle(section, n);
              },
              patch};
    }

    using ArchSection = Registry<SectionShape>::Registration;

    const ArchSection lens("lens", arch(2., lens_area, lens_patch));
    const ArchSection ellipse("ellipse", arch(1., ellipse_area, ellipse_patch));
    const ArchSection power_ellipse(
      "power ellipse",
      {power_half_height,
       power_area,
       power_edge_angle,
       power_patch,
       {{"Section power",
         1.5,
         "Power ellipse only: n of its arch [-]; below 1 fuller than the "
         "ellipse, above 2 slimmer than the lens.",
         std::make_shared<dealii::Patterns::Double>(0.1, 4.)}}});
  } // namespace
} // namespace NPT
