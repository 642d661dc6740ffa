// SPDX-License-Identifier: LGPL-2.1-or-later
// Bends one bundle to waves: the equations, the table, the parameters, and the
// name of the problem in a parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/material/bundle_bending.h>
#include <npt_dealii/problems/bundle_bending/bundle_bending_test.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace NPT
{
  using dealii::Point;
  using dealii::Vector;

  namespace
  {
    // A quarter wave, as wide as it is thick, with its middle plane at X3 = 0.
    std::vector<DeformablePart>
    make_quarter_wave(const BundleBendingParameters &p, const double half_wave)
    {
      std::vector<Point<3>> corners;
      for (const double z : {-0.5 * p.thickness, 0.5 * p.thickness})
        for (const double y : {0., p.thickness})
          for (const double x : {0., 0.5 * half_wave})
            corners.emplace_back(x, y, z);
      const KnotVector linear = KnotVector::uniform(1, 1);
      NURBSPatch<3>    patch({{linear, linear, linear}}, corners);
      patch.elevate_degree(0, p.degree - 1);
      patch.elevate_degree(2, p.degree - 1);
      if (p.n_along > 1)
        patch.subdivide(0, p.n_along);
      if (p.n_across > 1)
        patch.subdivide(2, p.n_across);

      std::vector<DeformablePart> parts;
      parts.push_back({patch,
                       make_material<3>(p.material, Point<3>::unit_vector(0)),
                       0,
                       "the bundle"});
      return parts;
    }



    // Coefficients of the spline that is sin(pi u/2) at the Greville points.
    Vector<double>
    quarter_sine(const KnotVector &knots)
    {
      const unsigned int         n = knots.n_functions();
      dealii::FullMatrix<double> functions(n, n);
      Vector<double>             values(n), coefficients(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          const double       u = knots.greville(i);
          const unsigned int e = knots.find_span(u);
          const auto         v = knots.values(e, u, 0);
          for (unsigned int a = 0; a <= knots.degree(); ++a)
            functions(i, knots.first_function(e) + a) = v[0][a];
          values[i] = std::sin(0.5 * dealii::numbers::PI * u);
        }
      functions.gauss_jordan();
      functions.vmult(coefficients, values);
      return coefficients;
    }
  } // namespace



  // ---------------------------------------------------------- the equations

  BundleBendingWave::BundleBendingWave(
    const BundleBendingParameters &parameters,
    const double                   half_wave,
    const double                   amplitude)
    : parameters_(parameters)
    , half_wave_(half_wave)
    , amplitude_(amplitude)
    , body_(make_quarter_wave(parameters, half_wave),
            Basis::NURBS,
            parameters.degree + 1)
  {
    system_.reinit(dealii::AffineConstraints<double>(),
                   body_.n_displacements());
    groups_ = body_.add_groups(system_);
    system_.build_pattern();

    std::vector<bool> prescribed(system_.n_independent(), false);
    target_.reinit(system_.n_independent());
    const IGASpace<3>   &space = body_.space();
    const NURBSPatch<3> &patch = space.patch(0);
    const Vector<double> sine  = quarter_sine(patch.knot_vector(0));
    const unsigned int   last  = patch.n_control_points(0) - 1;
    for (unsigned int l = 0; l < patch.n_control_points(); ++l)
      {
        const unsigned int A       = space.control_point(0, l);
        const unsigned int along   = patch.multi_index(l)[0];
        const auto         unknown = [&](const unsigned int i) {
          return system_.independent_index(3 * A + i);
        };
        prescribed[unknown(1)] = prescribed[unknown(2)] = true;
        target_[unknown(2)] = amplitude * sine[along];
        if (along == last)
          prescribed[unknown(0)] = true;
      }
    system_.set_prescribed(prescribed);
  }



  Increment
  BundleBendingWave::increment(const State &, const double load_factor) const
  {
    Increment increment;
    increment.load_factor = load_factor;
    increment.target      = target_;
    increment.target *= load_factor;
    return increment;
  }



  void
  BundleBendingWave::evaluate(const Increment &, Trial &trial) const
  {
    trial.residual.reinit(trial.u.size());
    trial.force_scale = body_.add_residual(trial.u, trial.residual);
  }



  bool
  BundleBendingWave::add_tangent(const Increment &,
                                 const Trial       &trial,
                                 ConstrainedSystem &system) const
  {
    body_.add_tangent(trial.u, groups_, system);
    return true;
  }



  double
  BundleBendingWave::force_unit() const
  {
    return body_.force_unit();
  }



  BundleBendingRow
  BundleBendingWave::run(RunLog &log)
  {
    LinearSolver linear_solver(parameters_.linear_solver);
    LoadStepper  stepper(
      parameters_.newton, ContactParameters(), system_, linear_solver, log);
    State start;
    start.u.reinit(body_.n_displacements());
    const State bent = stepper.run(*this,
                                   start,
                                   parameters_.steps,
                                   "bend",
                                   LoadStepper::Predictor::extrapolation,
                                   [](const AcceptedStep &) {});

    const double t = parameters_.thickness, L = half_wave_;
    const double k                = dealii::numbers::PI / L;
    const double energy_per_width = body_.stored_energy(bent.u) / t;
    const auto   stiffness        = body_.laws()[0]->small_strain_stiffness();
    const double C = stiffness(0, 0), G = stiffness(4, 4); // 11 and 31

    BundleBendingRow row;
    row.half_wave = L;
    row.amplitude = amplitude_;
    row.stiffness =
      8. * energy_per_width / (std::pow(k, 4) * amplitude_ * amplitude_ * L);
    row.solid   = C * t * t * t / 12.;
    row.formula = row.solid * bending_ratio(C, G, t / L);
    row.loose = row.solid * loose_bending_ratio(parameters_.fiber_diameter, t);
    return row;
  }



  // ------------------------------------------------- waves and amplitudes

  namespace
  {
    std::string
    table_line(const BundleBendingRow &row)
    {
      std::ostringstream line;
      line << std::setprecision(5);
      for (const double value : {row.half_wave,
                                 row.amplitude,
                                 row.stiffness,
                                 row.formula,
                                 row.stiffness / row.solid})
        line << std::setw(13) << value;
      return line.str();
    }



    // What the formulas make of the law, for the head of the log.
    std::vector<std::pair<std::string, std::string>>
    facts(const BundleBendingParameters &p)
    {
      const auto C = make_material<3>(p.material, Point<3>::unit_vector(0))
                       ->small_strain_stiffness();
      const auto text = [](const double value, const std::string &unit) {
        std::ostringstream out;
        out << std::setprecision(5) << value << " " << unit;
        return out.str();
      };
      const double t = p.thickness;
      return {{"law", p.material.law},
              {"C_1111", text(C(0, 0), "MPa")},
              {"shear along the fibers", text(C(4, 4), "MPa")},
              {"B of a solid, per width",
               text(C(0, 0) * t * t * t / 12., "N mm")},
              {"B of loose fibers over it",
               text(loose_bending_ratio(p.fiber_diameter, t), "")}};
    }
  } // namespace



  IdentifiedBending
  identify_bending(const BundleBendingParameters &p)
  {
    const double t = p.thickness;
    const double C = make_material<3>(p.material, Point<3>::unit_vector(0))
                       ->small_strain_stiffness()(0, 0);
    const double solid = C * t * t * t / 12.;
    if (!(p.measured > 0. && p.measured < solid))
      {
        std::ostringstream text;
        text << "Measured stiffness is " << p.measured
             << " N mm; it must be > 0 and less than that of a solid, " << solid
             << " N mm (subsection Bending).";
        throw InputError(text.str());
      }
    IdentifiedBending found;
    found.ratio       = p.measured / solid;
    found.slenderness = t / p.half_waves[0];
    found.shear_modulus =
      shear_modulus_for_bending(C, found.ratio, found.slenderness);
    return found;
  }



  namespace
  {
    // The entries of the law that a measurement says, and whether it can be
    // right.
    void
    report_identified(const BundleBendingParameters &p, RunLog &log)
    {
      const IdentifiedBending found = identify_bending(p);
      std::ostringstream      text;
      text << std::setprecision(5) << "Measured " << p.measured
           << " N mm at the half wave " << p.half_waves[0]
           << " mm: Bending ratio = " << found.ratio
           << ", Bending slenderness = " << found.slenderness
           << "; Longitudinal shear modulus = " << found.shear_modulus
           << " MPa.";
      log.line(text.str());
      const double loose = loose_bending_ratio(p.fiber_diameter, p.thickness);
      if (found.ratio < loose)
        {
          std::ostringstream warning;
          warning
            << "The measured stiffness is less than that of loose fibers ("
            << found.ratio / loose
            << " of it): check Fiber diameter, Thickness and the moduli.";
          log.warning(warning.str());
        }
    }
  } // namespace



  std::vector<BundleBendingRow>
  bend_bundle(const BundleBendingParameters &p,
              const std::string             &directory,
              std::ostream                  &screen)
  {
    RunLog log = RunLog::in_folder(directory, screen);
    log.header("Bundle bending", facts(p));
    if (p.measured > 0.)
      report_identified(p, log);
    log.line("  half wave    amplitude            B   by formula   B of solid "
             "= 1");
    std::unique_ptr<TableWriter> table;
    if (!directory.empty())
      {
        replace_file(directory + "/used_parameters.prm",
                     [&](std::ostream &out) { out << p.used_file; });
        table = std::make_unique<TableWriter>(
          directory + "/bending.csv",
          std::vector<std::string>{
            "half_wave", "amplitude", "B", "B_formula", "B_solid", "B_loose"},
          std::vector<std::string>{"Half wave and amplitude [mm], bending "
                                   "stiffness per width [N mm]."});
      }

    std::vector<BundleBendingRow> rows;
    std::string                   misses;
    for (const double half_wave : p.half_waves)
      for (const double amplitude : p.amplitudes)
        {
          const BundleBendingRow row =
            BundleBendingWave(p, half_wave, amplitude * p.thickness).run(log);
          rows.push_back(row);
          log.line(table_line(row));
          if (table)
            table->add_row(std::vector<double>{row.half_wave,
                                               row.amplitude,
                                               row.stiffness,
                                               row.formula,
                                               row.solid,
                                               row.loose});
          const double error = row.stiffness / row.formula - 1.;
          if (amplitude == p.amplitudes[0] && !(std::abs(error) <= p.tolerance))
            {
              std::ostringstream miss;
              miss << " Half wave " << half_wave << " mm: off by "
                   << 100. * error << " %, allowed " << 100. * p.tolerance
                   << " %.";
              misses += miss.str();
            }
        }
    if (!misses.empty())
      throw StageFailed("The bending stiffness is not that of Eq. (A33)." +
                          misses,
                        "tolerance missed");
    return rows;
  }



  // ---------------------------------------------------------- the parameters

  void
  BundleBendingParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    declare_problem(prm, "bundle bending");
    {
      const ParameterSubsection subsection(prm, "Bending");
      add_parameter(prm,
                    "Thickness",
                    thickness,
                    "Thickness t of the bundle [mm], Eq. (A33).",
                    positive_number());
      add_parameter(prm,
                    "Half waves",
                    half_waves,
                    "Half wave lengths L [mm]: in a fabric the crossing "
                    "spacing; pi/2 times the length of a cantilever under its "
                    "weight.",
                    dealii::Patterns::List(positive_number(), 1, 100));
      add_parameter(prm,
                    "Amplitudes",
                    amplitudes,
                    "Amplitudes of the wave over the thickness [-]. The "
                    "formula holds for small ones.",
                    dealii::Patterns::List(positive_number(), 1, 100));
      add_parameter(prm,
                    "Fiber diameter",
                    fiber_diameter,
                    "Diameter d of a fiber [mm], for the stiffness of loose "
                    "fibers, Eq. (A34).",
                    positive_number());
      add_parameter(prm,
                    "Measured stiffness",
                    measured,
                    "Bending stiffness of a bundle per width, at the first of "
                    "the Half waves [N mm]: the log says which Bending ratio "
                    "and shear modulus belong to it, Eq. (A33). 0: none.",
                    dealii::Patterns::Double(0.));
      add_parameter(prm,
                    "Degree",
                    degree,
                    "Degree of the splines along and across [-].",
                    dealii::Patterns::Integer(2, 5));
      add_parameter(prm,
                    "Elements along",
                    n_along,
                    "Per quarter wave [-].",
                    dealii::Patterns::Integer(1, 1000));
      add_parameter(prm,
                    "Elements across",
                    n_across,
                    "Through the thickness [-].",
                    dealii::Patterns::Integer(1, 1000));
      add_parameter(prm,
                    "Tolerance",
                    tolerance,
                    "The run fails if the bending stiffness at the first "
                    "amplitude differs by more from Eq. (A33), relative "
                    "[-].",
                    dealii::Patterns::Double(0.));
      add_parameter(prm,
                    "Output directory",
                    directory,
                    "Folder of bending.csv; created if missing. The option "
                    "--output of the program overrides it.");
      steps.add_parameters(prm);
    }
    material.add_parameters(prm, "Material");
    newton.add_parameters(prm);
    linear_solver.add_parameters(prm);
  }



  BundleBendingParameters
  BundleBendingParameters::read(const ParameterText            &text,
                                const std::vector<std::string> &overrides)
  {
    BundleBendingParameters  parameters;
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    parse_parameter_text(prm, text, overrides);
    parameters.material.check("Material");
    parameters.steps.check("subsection Bending");
    if (parameters.measured > 0.)
      identify_bending(parameters); // throws if it is out of range
    parameters.used_file = documented_parameters(prm);
    return parameters;
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters =
        BundleBendingParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters))
        return;
      bend_bundle(parameters,
                  make_output_directory(command, parameters.directory),
                  std::cout);
    }

    const Registry<Problem>::Registration
      bundle_bending("bundle bending",
                     {4, "the bending of one bundle to waves", start});
  } // namespace
} // namespace NPT
