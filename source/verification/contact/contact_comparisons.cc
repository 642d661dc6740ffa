// SPDX-License-Identifier: LGPL-2.1-or-later
// What a contact benchmark is compared with: one function per case.

#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/verification/contact/contact_benchmark.h>
#include <npt_dealii/verification/contact/exact_contact.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <limits>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::numbers::PI;

  namespace
  {
    const double infinity = std::numeric_limits<double>::infinity();

    /// Relative L2 difference of a field from its exact values, which may be
    /// zero outside of the contact.
    class ProfileError
    {
    public:
      void
      add(const double area, const double computed, const double exact)
      {
        difference_ += area * (computed - exact) * (computed - exact);
        size_ += area * exact * exact;
      }
      double
      value() const
      {
        return std::sqrt(difference_ / size_);
      }

    private:
      double difference_ = 0, size_ = 0;
    };

    /// Stretch in uniaxial strain under the nominal stress -p, by Newton.
    double
    confined_stretch(const NeoHookeanConstants &c, const double p)
    {
      double stretch = 1;
      for (unsigned int i = 0; i < 50; ++i)
        {
          const double log = std::log(stretch);
          const double P =
            c.mu * (stretch - 1 / stretch) + c.lambda * log / stretch;
          const double dP = c.mu * (1 + 1 / (stretch * stretch)) +
                            c.lambda * (1 - log) / (stretch * stretch);
          stretch -= (P + p) / dP;
        }
      return stretch;
    }

    /// Torque [N mm] from the forces on the handles cos - 1 and sin of a
    /// rotation.
    double
    torque(const ContactRow &row)
    {
      const double angle = std::asin(row.value[1]);
      return row.force[1] * std::cos(angle) - row.force[0] * std::sin(angle);
    }
  } // namespace



  void
  ContactBenchmark::compare_value(const std::string &quantity,
                                  const std::string &unit,
                                  const double       computed,
                                  const double       exact)
  {
    comparisons_.push_back({quantity, unit, computed, exact});
  }



  std::vector<ContactSample>
  ContactBenchmark::samples() const
  {
    // C_c = sum_I W_I p^I dg^I = int (sum_I p^I R^I) dg dA: the traction at a
    // Gauss point is what its area carries.
    const auto                &points = contacts_[0]->quadrature_points();
    std::vector<ContactSample> result(points.size());
    for (unsigned int I = 0; I < contacts_[0]->n_nodes(); ++I)
      {
        const auto &state = evaluation_.nodes[I];
        const auto &node  = contacts_[0]->averaging().nodes()[I];
        if (!state.active)
          continue;
        const Tensor<1, 3> traction =
          contacts_[0]->friction_traction(evaluation_, I);
        for (const auto &entry : node.entries)
          {
            // R^I at the point.
            const double value =
              node.area * entry.weight / points[entry.point].area;
            result[entry.point].pressure -= value * state.pressure;
            result[entry.point].traction += value * traction;
          }
      }
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        ContactSample &sample = result[q];
        const auto    &shape  = points[q].shape;
        for (unsigned int l = 0; l < shape.lattice.size(); ++l)
          {
            const unsigned int A =
              contacts_[0]->secondary().surface().control_point(
                shape.lattice[l]);
            Point<3> x = bodies_->space().control_points()[A];
            for (unsigned int c = 0; c < 3; ++c)
              x[c] += state_.u[3 * A + c];
            sample.x += shape.value[l] * x;
          }
        sample.area = points[q].area;
      }
    return result;
  }



  void
  ContactBenchmark::compare(const ContactStage &stage)
  {
    const bool last = stage.name == model_.stages.back().name;
    switch (parameters_.benchmark.type)
      {
        case ContactCase::patch_test:
          if (last)
            compare_patch_test();
          break;
        case ContactCase::cylinders:
          if (last)
            compare_cylinders();
          break;
        case ContactCase::sphere:
        case ContactCase::crossed_cylinders:
          if (last)
            compare_point_contact();
          break;
        case ContactCase::partial_slip:
          compare_partial_slip(stage.name);
          break;
        case ContactCase::block:
          if (last)
            compare_block();
          break;
        case ContactCase::capstan:
          if (last)
            compare_capstan();
          break;
        case ContactCase::disc_twist:
          if (last)
            compare_disc_twist();
          break;
        case ContactCase::sphere_twist:
          if (last)
            compare_sphere_twist();
          break;
        case ContactCase::ironing:
          if (last)
            compare_ironing();
          break;
      }
    if (!last)
      return;
    double force = 0, moment = 0;
    for (const ContactRow &row : rows_)
      {
        force  = std::max(force, row.force_imbalance);
        moment = std::max(moment, row.moment_imbalance);
      }
    compare_value("force imbalance of contact", "-", force, 0.);
    compare_value("moment imbalance of contact", "-", moment, 0.);
    compare_value("largest penetration",
                  "mm",
                  rows_.back().largest_penetration,
                  0.);
  }



  void
  ContactBenchmark::compare_patch_test()
  {
    const auto  &p     = parameters_.benchmark;
    const double upper = confined_stretch(p.upper.constants(), p.pressure);
    const double lower = confined_stretch(p.lower.constants(), p.pressure);
    compare_value("displacement of the plate",
                  "mm",
                  rows_.back().value[0],
                  0.6 * (upper - 1.) + 1. * (lower - 1.) -
                    (parameters_.contact.augmented() ?
                       0. :
                       p.pressure / parameters_.contact.normal_penalty));
    double largest = 0, square = 0, volume = 0;
    bodies_->for_each_point(state_.u,
                            [&](const DeformableBodies::MaterialPoint &point) {
                              const double error =
                                std::abs(point.P[2][2] + p.pressure) /
                                p.pressure;
                              largest = std::max(largest, error);
                              square += error * error * point.dV;
                              volume += point.dV;
                            });
    compare_value("stress error, maximum", "-", largest, 0.);
    compare_value("stress error, mean square",
                  "-",
                  std::sqrt(square / volume),
                  0.);
    double pressure = 0;
    for (const ContactSample &sample : samples())
      pressure =
        std::max(pressure, std::abs(sample.pressure - p.pressure) / p.pressure);
    compare_value("contact pressure error", "-", pressure, 0.);
  }



  void
  ContactBenchmark::compare_cylinders()
  {
    const auto  &p     = parameters_.benchmark;
    const double R     = 1. / (1. / p.upper.radius + 1. / p.lower.radius);
    const double E     = contact_modulus(p.upper.young_modulus,
                                     p.upper.poisson_ratio,
                                     p.lower.young_modulus,
                                     p.lower.poisson_ratio);
    const auto   hertz = HertzLine::from_load(-rows_.back().force[0], R, E);

    double                             largest = 0, load = 0, second_moment = 0;
    ProfileError                       error;
    std::vector<std::array<double, 3>> profile;
    for (const ContactSample &sample : samples())
      {
        const double x = sample.x[0], pressure = sample.pressure;
        largest = std::max(largest, pressure);
        load += pressure * sample.area;
        second_moment += pressure * x * x * sample.area;
        error.add(sample.area, pressure, hertz.pressure(x));
        if (x < 1.4 * hertz.half_width)
          profile.push_back({{x, pressure, hertz.pressure(x)}});
      }
    compare_value("peak pressure", "MPa", largest, hertz.peak_pressure);
    // <x^2> = a^2/4 of Hertz' distribution.
    compare_value("half width",
                  "mm",
                  2. * std::sqrt(second_moment / load),
                  hertz.half_width);
    compare_value("pressure profile, L2", "-", error.value(), 0.);
    compare_value("approach of the plates", "mm", -rows_.back().value[0], 0.);
    write_profile("x [mm]", "contact pressure [MPa]", profile);
  }



  void
  ContactBenchmark::compare_point_contact()
  {
    const auto  &p       = parameters_.benchmark;
    const bool   crossed = p.type == ContactCase::crossed_cylinders;
    const double R_x     = p.upper.radius;
    const double R_y     = crossed ? p.lower.radius : p.upper.radius;
    const double E       = contact_modulus(p.upper.young_modulus,
                                     p.upper.poisson_ratio,
                                     crossed ? p.lower.young_modulus : infinity,
                                     p.lower.poisson_ratio);
    const auto   hertz =
      HertzPoint::from_load(-rows_.back().force.back(), R_x, R_y, E);

    double       largest = 0, load = 0, moment[2] = {0, 0};
    ProfileError error;
    std::vector<std::array<double, 3>> profile;
    for (const ContactSample &sample : samples())
      {
        const double x = sample.x[0], y = sample.x[1];
        const double pressure = sample.pressure;
        const double exact    = hertz.pressure(x, y);
        largest               = std::max(largest, pressure);
        load += pressure * sample.area;
        for (unsigned int c = 0; c < 2; ++c)
          moment[c] += pressure * sample.x[c] * sample.x[c] * sample.area;
        error.add(sample.area, pressure, exact);
        // All points over the radius of the ellipse through them.
        const double r =
          std::hypot(x, y * hertz.half_axis_x / hertz.half_axis_y);
        if (r < 1.4 * hertz.half_axis_x)
          profile.push_back({{r, pressure, exact}});
      }
    // <x^2> = a^2/5 of Hertz' distribution.
    compare_value("peak pressure", "MPa", largest, hertz.peak_pressure);
    compare_value("half axis along x",
                  "mm",
                  std::sqrt(5. * moment[0] / load),
                  hertz.half_axis_x);
    compare_value("half axis along y",
                  "mm",
                  std::sqrt(5. * moment[1] / load),
                  hertz.half_axis_y);
    compare_value("pressure profile, L2", "-", error.value(), 0.);
    compare_value("approach of the plates",
                  "mm",
                  -rows_.back().value.back(),
                  0.);
    write_profile("radius [mm]", "contact pressure [MPa]", profile);
  }



  double
  ContactBenchmark::stick_radius(const bool in_plane) const
  {
    // Between the outermost sticking and the innermost slipping node.
    double outermost = 0, innermost = std::numeric_limits<double>::max();
    for (unsigned int I = 0; I < contacts_[0]->n_nodes(); ++I)
      {
        const auto &state = evaluation_.nodes[I];
        if (!state.active)
          continue;
        Tensor<1, 3> x;
        for (const auto &entry : contacts_[0]->averaging().nodes()[I].entries)
          x += entry.weight * contacts_[0]->quadrature_points()[entry.point].X;
        const double r = in_plane ? std::abs(x[0]) : std::hypot(x[0], x[1]);
        if (state.slipping)
          innermost = std::min(innermost, r);
        else
          outermost = std::max(outermost, r);
      }
    return 0.5 * (outermost + std::min(innermost, 1e3 * outermost));
  }



  void
  ContactBenchmark::compare_partial_slip(const std::string &stage)
  {
    const auto           &p   = parameters_.benchmark;
    const double          E   = contact_modulus(p.upper.young_modulus,
                                     p.upper.poisson_ratio,
                                     p.lower.young_modulus,
                                     p.lower.poisson_ratio);
    const auto           &row = rows_.back();
    const PartialSlipLine exact{HertzLine::from_load(-row.force[1],
                                                     0.5 * p.upper.radius,
                                                     E),
                                parameters_.friction.coefficient,
                                std::abs(row.force[0])};
    if (stage == "shear")
      {
        double                             largest = 0, second_moment = 0;
        ProfileError                       pressure, traction;
        std::vector<std::array<double, 3>> profile;
        // The contact moves with the surfaces; x counts from its center.
        double     load = 0, center = 0;
        const auto all = samples();
        for (const ContactSample &sample : all)
          {
            load += sample.pressure * sample.area;
            center += sample.pressure * sample.area * sample.x[0];
          }
        center /= load;
        for (const ContactSample &sample : all)
          {
            const double x = sample.x[0] - center;
            second_moment += sample.pressure * x * x * sample.area;
            largest = std::max(largest, sample.pressure);
            pressure.add(sample.area,
                         sample.pressure,
                         exact.normal.pressure(x));
            traction.add(sample.area, sample.traction[0], exact.traction(x));
            if (std::abs(x) < 1.4 * exact.normal.half_width)
              profile.push_back({{x, sample.traction[0], exact.traction(x)}});
          }
        compare_value("peak pressure",
                      "MPa",
                      largest,
                      exact.normal.peak_pressure);
        compare_value("half width",
                      "mm",
                      2. * std::sqrt(second_moment / load),
                      exact.normal.half_width);
        compare_value("stick half width",
                      "mm",
                      stick_radius(true),
                      exact.stick_half_width());
        compare_value("pressure profile, L2", "-", pressure.value(), 0.);
        compare_value("traction profile, L2", "-", traction.value(), 0.);
        write_profile("x [mm]", "friction traction [MPa]", profile);
      }
    if (stage == "return")
      {
        double before = 0;
        for (const ContactRow &r : rows_)
          if (r.stage == "shear")
            before = r.dissipation;
        compare_value("loss per cycle",
                      "N",
                      row.dissipation - before,
                      exact.loss_per_cycle(E));
      }
  }



  void
  ContactBenchmark::compare_block()
  {
    // Three springs in series, blocks and tangential penalty, and a slider:
    // exact at finite strain, since simple shear of the neo-Hookean law has
    // P_13 = G times the shear, whatever the stretch.
    const auto  &p       = parameters_.benchmark;
    const double lower_A = (1.2 + 2. * p.distance) * 1.2, lower_H = 1.;
    const double upper_A = 1., upper_H = 0.6;
    const double k =
      1. / (upper_H / (p.upper.constants().mu * upper_A) +
            lower_H / (p.lower.constants().mu * lower_A) +
            (parameters_.contact.augmented() ?
               0. :
               1. / (parameters_.friction.tangential_penalty * upper_A)));
    const double limit =
      parameters_.friction.coefficient * p.pressure * upper_A;

    double                             Q = 0, path = 0, loss = 0, largest = 0;
    std::vector<std::array<double, 3>> profile;
    for (const ContactRow &row : rows_)
      {
        if (row.stage == "approach" || row.stage == "press")
          continue;
        const double trial = Q + k * (row.value[0] - path);
        Q                  = std::min(std::max(trial, -limit), limit);
        loss += limit * std::abs(trial - Q) / k;
        path    = row.value[0];
        largest = std::max(largest, std::abs(row.force[0] - Q) / limit);
        profile.push_back({{row.value[0], row.force[0], Q}});
      }
    compare_value("tangential force, maximum error", "-", largest, 0.);
    compare_value("dissipation", "N mm", rows_.back().dissipation, loss);
    compare_value("force while slipping", "N", rows_.back().force[0], limit);
    write_profile("displacement [mm]", "tangential force [N]", profile, true);
  }



  void
  ContactBenchmark::compare_capstan()
  {
    const auto  &p     = parameters_.benchmark;
    const double mu    = parameters_.friction.coefficient;
    const double angle = p.wrap_angle * PI / 180., R = p.lower.radius;
    const auto  &row = rows_.back();
    compare_value("tension ratio T2/T1",
                  "-",
                  row.force[1] / row.force[0],
                  capstan_ratio(mu, angle));
    // Friction acts half the thickness below the middle of the belt: moments
    // about the axis give dT (R + h/2) = mu p R R d(angle), p R = T.
    compare_value("T2/T1 of a belt of this thickness",
                  "-",
                  row.force[1] / row.force[0],
                  capstan_ratio(mu, angle * R / (R + 0.5 * p.thickness)));
    compare_value("sticking nodes", "-", row.n_stick, 0.);
    std::vector<std::array<double, 3>> profile;
    for (const ContactSample &sample : samples())
      {
        const double phi = std::atan2(sample.x[0], sample.x[2]);
        profile.push_back(
          {{phi * 180. / PI,
            sample.pressure,
            row.force[0] / R * std::exp(mu * (phi + 0.5 * angle))}});
      }
    write_profile("angle [degrees]", "contact pressure [MPa]", profile);
  }



  void
  ContactBenchmark::compare_disc_twist()
  {
    const auto  &row = rows_.back();
    const double exact =
      torque_of_slipping_disc(parameters_.friction.coefficient,
                              -row.force[2],
                              parameters_.benchmark.upper.radius);
    compare_value("torque", "N mm", torque(row), exact);
    compare_value("sticking nodes", "-", row.n_stick, 0.);
    std::vector<std::array<double, 3>> profile;
    for (const ContactRow &r : rows_)
      if (r.stage == "twist")
        profile.push_back(
          {{std::asin(r.value[1]) * 180. / PI, torque(r), exact}});
    write_profile("angle [degrees]", "torque [N mm]", profile, true);
  }



  void
  ContactBenchmark::compare_sphere_twist()
  {
    const auto         &p   = parameters_.benchmark;
    const auto         &row = rows_.back();
    const double        E   = contact_modulus(p.upper.young_modulus,
                                     p.upper.poisson_ratio,
                                     infinity,
                                     0.);
    const TwistedSphere exact{
      HertzPoint::from_load(-row.force[2], p.upper.radius, p.upper.radius, E),
      parameters_.friction.coefficient,
      p.upper.constants().mu};

    double largest = 0;
    for (const ContactSample &sample : samples())
      largest = std::max(largest, sample.pressure);
    compare_value("peak pressure", "MPa", largest, exact.normal.peak_pressure);

    std::vector<std::array<double, 3>> profile;
    for (const ContactRow &r : rows_)
      if (r.stage == "twist")
        {
          const double angle = std::asin(r.value[1]);
          profile.push_back(
            {{angle, torque(r), exact.torque(exact.stick_radius(angle))}});
        }
    const double c = exact.stick_radius(profile.back()[0]);
    compare_value("torque", "N mm", profile.back()[1], exact.torque(c));
    compare_value("stick radius", "mm", stick_radius(false), c);
    write_profile("twist [rad]", "torque [N mm]", profile, true);
  }



  void
  ContactBenchmark::compare_ironing()
  {
    // Where the cylinder is far from both ends of its path the forces change
    // slowly with the distance; what is left beside a parabola comes from the
    // mesh.
    std::vector<std::array<double, 3>> profile;
    std::vector<const ContactRow *>    steady;
    for (const ContactRow &row : rows_)
      if (row.stage == "drag")
        {
          profile.push_back(
            {{row.value[0],
              row.force[0],
              -parameters_.friction.coefficient * row.force[1]}});
          if (row.n_stick == 0 && row.load_factor > 0.25)
            steady.push_back(&row);
        }
    for (const unsigned int handle : {0, 1})
      {
        // Least squares with Legendre polynomials up to the second degree,
        // summed as if they were orthogonal and repeated until they are.
        std::vector<double> rest;
        double              mean = 0;
        for (const ContactRow *row : steady)
          {
            rest.push_back(row->force[handle]);
            mean += std::abs(row->force[handle]) / steady.size();
          }
        const auto legendre = [&](const unsigned int n, const unsigned int i) {
          const double s = 2. * (i + 0.5) / rest.size() - 1.;
          return n == 0 ? 1. : n == 1 ? s : 1.5 * s * s - 0.5;
        };
        for (unsigned int repetition = 0; repetition < 20; ++repetition)
          for (unsigned int n = 0; n < 3; ++n)
            {
              double product = 0, square = 0;
              for (unsigned int i = 0; i < rest.size(); ++i)
                {
                  product += rest[i] * legendre(n, i);
                  square += legendre(n, i) * legendre(n, i);
                }
              for (unsigned int i = 0; i < rest.size(); ++i)
                rest[i] -= product / square * legendre(n, i);
            }
        double largest = 0;
        for (const double value : rest)
          largest = std::max(largest, std::abs(value));
        compare_value(handle == 0 ? "ripple of the tangential force" :
                                    "ripple of the normal force",
                      "-",
                      largest / mean,
                      0.);
      }
    compare_value("force ratio Q/P",
                  "-",
                  -rows_.back().force[0] / rows_.back().force[1],
                  parameters_.friction.coefficient);
    write_profile("displacement [mm]",
                  "tangential force [N/mm]",
                  profile,
                  true);
  }



  void
  ContactBenchmark::write_profile(const std::string                 &x_name,
                                  const std::string                 &y_name,
                                  std::vector<std::array<double, 3>> rows,
                                  const bool                         in_order)
  {
    if (directory_.empty())
      return;
    if (!in_order)
      std::sort(rows.begin(), rows.end());
    TableWriter table(directory_ + "/profile.csv",
                      {x_name, "computed " + y_name, "exact " + y_name});
    for (const auto &row : rows)
      table.add_row({row[0], row[1], row[2]});
    replace_file(directory_ + "/profile.gp", [&](std::ostream &out) {
      out << "# Draws profile.csv to profile.svg. Run `gnuplot` in this "
             "folder.\n"
             "set datafile separator comma\n"
             "set datafile columnheaders\n"
             "set terminal svg size 640,420 font 'sans-serif,13' background "
             "'white' dynamic\n"
             "set output 'profile.svg'\n"
             "set grid linecolor rgb '#dddddd' linetype 1 linewidth 1\n"
             "set tics nomirror out\n"
             "set format '%g'\n"
             "set key top right\n"
          << "set xlabel '" << x_name << "'\n"
          << "set ylabel '" << y_name << "'\n"
          << "plot 'profile.csv' using 1:3 with lines linewidth 2 linecolor "
             "rgb '#d55e00' title 'exact', '' using 1:2 with points pointtype "
             "7 pointsize 0.5 linecolor rgb '#0072b2' title 'computed'\n";
    });
  }
} // namespace NPT
