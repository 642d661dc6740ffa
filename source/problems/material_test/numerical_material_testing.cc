// SPDX-License-Identifier: LGPL-2.1-or-later
// Numerical material testing of a micro cell: the method on one page in run(),
// its steps below in the order in which they are used.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/problems/material_test/composite_bounds.h>
#include <npt_dealii/problems/material_test/micro_cell_problem.h>
#include <npt_dealii/problems/material_test/numerical_material_testing.h>
#include <npt_dealii/solid/solid_fields.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    constexpr unsigned int n_macro = SolidMacroUnknowns::n_macro;
  } // namespace



  NumericalMaterialTesting::NumericalMaterialTesting(
    const MaterialTestParameters &parameters,
    const std::string            &directory,
    std::ostream                 &screen)
    : parameters_(parameters)
    , directory_(directory)
    , log_(RunLog::in_folder(directory, screen))
    , cpu_start_(process_cpu_seconds())
    , macro_(0)
    , linear_solver_(parameters.linear_solver)
  {}



  void
  NumericalMaterialTesting::run()
  {
    make_micro_cell(); // array of fibers -> NURBS patches -> one space
    setup_system();    // gradients, periodicity with H as macro unknowns
    compute_moduli();  // static condensation at the natural state

    for (const MaterialTest &test : parameters_.programme.tests)
      run_test(test); // from the natural state to the targets

    if (parameters_.identify && !rows_.empty())
      identify_bundle_law(); // constrained linear least squares
    log_.line("CPU time " +
              short_number(process_cpu_seconds() - cpu_start_, 3) + " s");
  }



  void
  NumericalMaterialTesting::run_test(const MaterialTest &test)
  {
    const MicroCellProblem problem(
      *bodies_, cell_groups_, macro_, cell_->volume(), test, system_);
    begin_test(test); // a row of the natural state
    LoadStepper stepper(
      parameters_.newton, ContactParameters(), system_, linear_solver_, log_);
    state_ =
      stepper.run(problem,
                  problem.natural_state(),
                  test.steps,
                  test.name,
                  LoadStepper::Predictor::extrapolation,
                  [&](const AcceptedStep &step) { add_row(test, step); });
    if (parameters_.output.fields && !directory_.empty())
      output_fields(test);
  }



  // ---------------------------------------------------------------- set-up

  void
  NumericalMaterialTesting::make_micro_cell()
  {
    cell_ = std::make_unique<FiberArray>(parameters_.cell, parameters_.mesh);
    Tensor<1, 3> fiber_direction;
    fiber_direction[0] = 1.;
    std::vector<DeformablePart> parts;
    for (unsigned int b = 0; b < cell_->patches().size(); ++b)
      parts.push_back({cell_->patches()[b],
                       make_material<3>(cell_->is_fiber(b) ? parameters_.fiber :
                                                             parameters_.matrix,
                                        fiber_direction),
                       0,
                       cell_->is_fiber(b) ? "the fiber" : "the matrix"});
    bodies_ = std::make_unique<DeformableBodies>(
      std::move(parts),
      parameters_.mesh.basis,
      parameters_.mesh.degree + 1 + parameters_.mesh.additional_gauss_points);
    macro_ = SolidMacroUnknowns(bodies_->space().n_control_points());
  }



  void
  NumericalMaterialTesting::setup_system()
  {
    system_.reinit(make_solid_couplings(bodies_->space(),
                                        macro_,
                                        cell_->periods(),
                                        parameters_.uniform_along_fiber ? 0 :
                                                                          -1),
                   macro_.n_unknowns());

    cell_groups_ = bodies_->add_groups(system_);
    system_.build_pattern();
    state_.u.reinit(macro_.n_unknowns()); // the natural state

    log_.header(
      "Numerical material test",
      {{"fibers in the cell", std::to_string(parameters_.cell.n_fibers)},
       {"volume fraction", short_number(parameters_.cell.volume_fraction, 5)},
       {"ligament / spacing",
        short_number(cell_->ligament() / parameters_.cell.fiber_spacing, 5)},
       {"patches", std::to_string(bodies_->space().n_patches())},
       {"cells", std::to_string(bodies_->space().cells().size())},
       {"independent unknowns", std::to_string(system_.n_independent())}});
    for (const std::string &remark : parameters_.remarks)
      log_.warning(remark);
    if (directory_.empty())
      return;
    replace_file(directory_ + "/used_parameters.prm",
                 [&](std::ostream &out) { out << parameters_.used_file; });
    std::vector<std::string> columns{"test", "load_factor"};
    for (const std::string kind : {"H", "P"})
      for (unsigned int e = 0; e < 9; ++e)
        columns.push_back(kind + std::to_string(e / 3 + 1) +
                          std::to_string(e % 3 + 1));
    for (const std::string name : {"P12_sym",
                                   "P23_sym",
                                   "P31_sym",
                                   "energy",
                                   "work",
                                   "mean_J",
                                   "newton_iterations",
                                   "newton_order"})
      columns.push_back(name);
    table_ = std::make_unique<TableWriter>(
      directory_ + "/material_tests.csv",
      columns,
      std::vector<std::string>{
        "Numerical material tests of a micro cell, fibers along direction 1.",
        "H: macroscopic displacement gradient [-]; P: first Piola-Kirchhoff "
        "stress [MPa], P12_sym = (P12 + P21)/2; energy and work per reference "
        "volume [MPa]."});
  }



  void
  NumericalMaterialTesting::compute_moduli()
  {
    const FullMatrix<double> A = macroscopic_tangent();

    // Strain 23 as e_23 = e_32 = gamma/2: with minor symmetry the Voigt entry
    // is any of the four; the mean takes out round-off.
    const std::array<std::array<unsigned int, 2>, 6> pair = {
      {{{0, 0}}, {{4, 4}}, {{8, 8}}, {{5, 7}}, {{6, 2}}, {{1, 3}}}};
    stiffness_.reinit(6, 6);
    for (unsigned int a = 0; a < 6; ++a)
      for (unsigned int b = 0; b < 6; ++b)
        for (const unsigned int e : pair[a])
          for (const unsigned int f : pair[b])
            stiffness_(a, b) += 0.25 * A(e, f);

    FullMatrix<double> S(6, 6);
    S.invert(stiffness_);
    const double E1 = 1. / S(0, 0);
    log_.line("Small strain: E_1 = " + short_number(E1, 5) +
              ", E_2 = " + short_number(1. / S(1, 1), 5) +
              ", E_3 = " + short_number(1. / S(2, 2), 5) +
              ", G_12 = " + short_number(stiffness_(5, 5), 5) +
              ", G_31 = " + short_number(stiffness_(4, 4), 5) +
              ", G_23 = " + short_number(stiffness_(3, 3), 5) +
              " MPa, nu_12 = " + short_number(-S(1, 0) * E1, 5) + ", nu_23 = " +
              short_number(-S(2, 1) / S(1, 1), 5) + ", (C22 - C23)/2 = " +
              short_number(0.5 * (stiffness_(1, 1) - stiffness_(1, 2)), 5) +
              " MPa");
    const auto *fiber  = parameters_.fiber.selected<NeoHookeanParameters>();
    const auto *matrix = parameters_.matrix.selected<NeoHookeanParameters>();
    if (fiber && matrix)
      {
        const CompositeBounds b =
          unidirectional_bounds(parameters_.cell.volume_fraction,
                                fiber->young_modulus,
                                fiber->poisson_ratio,
                                matrix->young_modulus,
                                matrix->poisson_ratio);
        const auto interval = [](const Interval &i) {
          return "[" + short_number(i.lower, 5) + ", " +
                 short_number(i.upper, 5) + "]";
        };
        log_.line("Bounds (transverse isotropy): E_1 " + interval(b.E_L) +
                  ", E_2 " + interval(b.E_T) + ", G_12 " + interval(b.G_L) +
                  ", G_23 " + interval(b.G_T) + " MPa");
      }
    if (directory_.empty())
      return;
    TableWriter                      table(directory_ + "/stiffness.csv",
                      {"C", "11", "22", "33", "23", "31", "12"},
                      {"Small-strain stiffness [MPa], engineering shears."});
    const std::array<std::string, 6> names = {
      {"11", "22", "33", "23", "31", "12"}};
    for (unsigned int a = 0; a < 6; ++a)
      {
        std::vector<TableCell> row{names[a]};
        for (unsigned int b = 0; b < 6; ++b)
          row.emplace_back(stiffness_(a, b));
        table.add_row(row);
      }
  }



  // ------------------------------------------------------------- load steps

  void
  NumericalMaterialTesting::begin_test(const MaterialTest &test)
  {
    MaterialTestRow natural_state;
    natural_state.test = test.name;
    rows_.push_back(natural_state);
    write_row(natural_state);
    log_.line("Test " + test.name);
  }



  void
  NumericalMaterialTesting::add_row(const MaterialTest &test,
                                    const AcceptedStep &step)
  {
    MaterialTestRow row;
    row.test         = test.name;
    row.load_factor  = step.after.load_factor;
    row.iterations   = step.report.newton.iterations;
    row.newton_order = step.report.newton.order();
    for (unsigned int e = 0; e < n_macro; ++e)
      {
        row.H[e / 3][e % 3] = step.after.u[macro_.first + e];
        row.P[e / 3][e % 3] = step.after.reactions[e];
      }
    const MaterialTestRow &last = rows_.back();
    row.work = last.work + 0.5 * scalar_product(row.P + last.P, row.H - last.H);
    compute_averages(step.after.u, row);
    rows_.push_back(row);

    std::ostringstream text;
    text << "  " << std::fixed << std::setprecision(3) << row.load_factor
         << "  " << std::setw(2) << row.iterations << " iterations, P =";
    for (unsigned int e = 0; e < n_macro; ++e)
      text << ' ' << std::setprecision(4) << row.P[e / 3][e % 3];
    log_.line(text.str());
    write_row(row);
  }



  void
  NumericalMaterialTesting::write_row(const MaterialTestRow &row)
  {
    if (!table_)
      return;
    std::vector<TableCell> cells{row.test, row.load_factor};
    for (const auto &T : {row.H, row.P})
      for (unsigned int e = 0; e < n_macro; ++e)
        cells.emplace_back(T[e / 3][e % 3]);
    for (const auto &[i, j] : {std::make_pair(0, 1), {1, 2}, {2, 0}})
      cells.emplace_back(0.5 * (row.P[i][j] + row.P[j][i]));
    for (const double value : {row.energy, row.work, row.mean_J})
      cells.emplace_back(value);
    cells.emplace_back(row.iterations);
    cells.emplace_back(row.newton_order);
    table_->add_row(cells);
  }



  // --------------------------------------------------------------- results

  void
  NumericalMaterialTesting::compute_averages(const Vector<double> &u,
                                             MaterialTestRow      &row) const
  {
    double volume = 0, current_volume = 0;
    bodies_->for_each_point(u, [&](const auto &point) {
      row.P_average += point.P * point.dV / cell_->volume();
      row.P_times_F +=
        scalar_product(point.P, point.F) * point.dV / cell_->volume();
      volume += point.dV;
      current_volume += determinant(point.F) * point.dV;
    });
    row.energy = bodies_->stored_energy(u) / cell_->volume();
    row.mean_J = current_volume / volume;
  }



  FullMatrix<double>
  NumericalMaterialTesting::macroscopic_tangent()
  {
    system_.set_zero();
    bodies_->add_tangent(state_.u, cell_groups_, system_);
    std::vector<bool> prescribed(system_.n_independent(), false);
    for (unsigned int e = 0; e < n_macro; ++e)
      prescribed[system_.independent_index(macro_.first + e)] = true;
    system_.set_prescribed(prescribed);
    linear_solver_.factorize(system_.free_matrix());

    FullMatrix<double> A(n_macro, n_macro);
    for (unsigned int e = 0; e < n_macro; ++e)
      {
        // Response of the cell to a unit of H_e: column K_{.H} + K_{.f} x.
        Vector<double> unit(system_.n_independent()), column, x;
        unit[system_.independent_index(macro_.first + e)] = 1.;
        system_.matrix().vmult(column, unit);
        Vector<double> rhs(system_.n_free());
        for (unsigned int k = 0; k < system_.n_free(); ++k)
          rhs[k] = -column[system_.free_unknown(k)];
        linear_solver_.solve(rhs, x);
        for (unsigned int k = 0; k < system_.n_free(); ++k)
          unit[system_.free_unknown(k)] = x[k];
        system_.matrix().vmult(column, unit);
        for (unsigned int f = 0; f < n_macro; ++f)
          A(f, e) = column[system_.independent_index(macro_.first + f)] /
                    cell_->volume();
      }
    return A;
  }



  std::vector<MaterialCurve>
  NumericalMaterialTesting::curves() const
  {
    std::vector<MaterialCurve> result;
    for (const MaterialTestRow &row : rows_)
      {
        if (result.empty() || result.back().name != row.test)
          {
            result.emplace_back();
            result.back().name = row.test;
          }
        result.back().H.push_back(row.H);
        result.back().P.push_back(row.P);
      }
    return result;
  }



  void
  NumericalMaterialTesting::identify_bundle_law()
  {
    log_.line("Identification of the fiber bundle law (50)-(53)");
    identified_ = std::make_unique<IdentificationResult>(
      identify(curves(), parameters_.identification));
    report_fit(*identified_,
               curves(),
               parameters_.identification,
               directory_,
               parameters_.output.picture,
               log_);
  }



  void
  NumericalMaterialTesting::output_fields(const MaterialTest &test) const
  {
    std::string name = "cell-" + test.name + ".vtu";
    std::replace(name.begin(), name.end(), ' ', '-');
    write_vtu(directory_ + "/" + name,
              make_bundle_fields(bodies_->space(),
                                 bodies_->laws(),
                                 bodies_->gradients(),
                                 state_.u));
  }
} // namespace NPT
