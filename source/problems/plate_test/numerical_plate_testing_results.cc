// SPDX-License-Identifier: LGPL-2.1-or-later
// What a plate test shows: the cell before any computation, fields, pictures,
// and the state of the material where a stage had to be given up.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/contact/contact_fields.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/problems/plate_test/cell_picture.h>
#include <npt_dealii/problems/plate_test/hysteresis.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/plots.h>
#include <npt_dealii/solid/solid_fields.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace NPT
{
  using dealii::Tensor;
  using dealii::TimerOutput;
  using dealii::Vector;

  void
  NumericalPlateTesting::preview()
  {
    make_unit_cell();
    setup_system();

    // Straight bundles that just touch, warp above.
    const auto lift = [&](const FiberBundle &bundle) {
      const double half = 0.5 * cell_->weaving_offset();
      return bundle.family == FiberBundle::Family::warp ? half :
             bundle.family == FiberBundle::Family::weft ? -half :
                                                          0.;
    };
    Vector<double>    &u     = u_;
    const IGASpace<3> &space = bodies_->space();
    for (unsigned int b = 0; b < cell_->bundles().size(); ++b)
      for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
        u[3 * space.control_point(b, l) + 2] = lift(cell_->bundles()[b]);

    double volume = 0;
    for (const double integral : bodies_->integrals_of_functions(false))
      volume += integral;
    const bool   laminate = parameters_.cell.type == "laminate";
    const double layer    = cell_->area() * (laminate ? 1. : 2.) *
                         (laminate ? parameters_.cell.bundle_thickness.warp :
                                     cell_->weaving_offset());
    std::ostringstream text;
    text << "Geometry only: the cell stands for " << cell_->area()
         << " mm^2 of fabric; volume of its bundles " << volume << " mm^3, "
         << 100 * volume / layer << " % of the layer of thickness "
         << layer / cell_->area() << " mm.";
    log_.line(text.str());
    if (!directory_.empty())
      {
        write_vtu(
          directory_ + "/geometry.vtu",
          make_bundle_fields(space, bodies_->laws(), bodies_->gradients(), u));
        // Pieces of neighboring cells whose surfaces are candidates for
        // contact. A glide maps a straight bundle onto its translate.
        std::vector<DeformablePart>                        parts;
        std::vector<double>                                lifts;
        std::vector<std::pair<unsigned int, Tensor<1, 3>>> known;
        for (const ContactCandidates &pair : cell_->contacts())
          for (const SurfaceImage &image : pair.primaries)
            {
              const Tensor<1, 3> &a      = image.operation.a;
              bool                is_new = a.norm() > 0;
              for (const auto &[bundle, shift] : known)
                is_new = is_new &&
                         (bundle != image.bundle || (shift - a).norm() > 1e-9);
              if (!is_new)
                continue;
              known.emplace_back(image.bundle, a);
              const FiberBundle &bundle = cell_->bundles()[image.bundle];
              NURBSPatch<3>      patch  = bundle.patch;
              patch.transform([&](const dealii::Point<3> &P) { return P + a; });
              parts.push_back(
                {patch,
                 make_material<3>(parameters_.material, bundle.direction),
                 static_cast<unsigned int>(parts.size()),
                 "image"});
              lifts.push_back(lift(bundle));
            }
        if (!parts.empty())
          {
            const DeformableBodies images(std::move(parts),
                                          parameters_.mesh.basis);
            Vector<double>         w(images.n_displacements());
            for (unsigned int b = 0; b < lifts.size(); ++b)
              for (unsigned int l = 0;
                   l < images.space().patch(b).n_control_points();
                   ++l)
                w[3 * images.space().control_point(b, l) + 2] = lifts[b];
            write_vtu(directory_ + "/images.vtu",
                      make_bundle_fields(
                        images.space(), images.laws(), images.gradients(), w));
          }
        log_.line("Written: " + directory_ + "/geometry.vtu" +
                  (lifts.empty() ?
                     "." :
                     ", and images.vtu with the pieces of neighboring cells "
                     "that its bundles may touch."));
      }
    log_.finish();
  }



  /*
   * Whatever ended the stage: a material that lost its ellipticity before is
   * the likelier cause, so that is looked up and said.
   */
  void
  NumericalPlateTesting::give_up(const StageFailed &failure)
  {
    draw_cells();
    if (failure.reason() == "loss of ellipticity")
      throw failure;
    const auto  lowest  = bodies_->lowest_acoustic_eigenvalue(u_);
    std::string message = failure.what();
    message += lowest.lowest.value > 0. ?
                 " The material is elliptic at the last accepted step (" :
                 " The material has lost its ellipticity (";
    message += bodies_->describe(lowest) + ").";
    throw StageFailed(message,
                      lowest.lowest.value > 0. ? failure.reason() :
                                                 "loss of ellipticity",
                      failure.stage(),
                      failure.load_factor(),
                      failure.n_cuts());
  }



  void
  NumericalPlateTesting::output_fields()
  {
    if (directory_.empty())
      return;
    TimerOutput::Scope timer(timer_, "Output");
    const double       time = stages_done_ + load_factor_;
    std::ostringstream number;
    number.width(4);
    number.fill('0');
    number << curve_.size();

    const std::string bundles = "bundles-" + number.str() + ".vtu";
    write_vtu(directory_ + "/" + bundles,
              make_bundle_fields(
                bodies_->space(), bodies_->laws(), bodies_->gradients(), u_));
    bundle_files_.emplace_back(time, bundles);
    write_pvd(directory_ + "/fields.pvd", bundle_files_);

    for (unsigned int k = 0; k < contacts_.size(); ++k)
      {
        const std::string name =
          "contact-" + std::to_string(k) + "-" + number.str() + ".vtu";
        const ContactCandidates &pair = cell_->contacts()[k];
        write_vtu(directory_ + "/" + name,
                  make_contact_fields(bodies_->space(),
                                      pair.secondary_bundle,
                                      pair.direction,
                                      pair.secondary_side,
                                      *contacts_[k],
                                      contact_evaluations_[k],
                                      u_));
        contact_files_.emplace_back(time, name);
      }
    write_pvd(directory_ + "/contact.pvd", contact_files_);
  }



  void
  NumericalPlateTesting::write_picture(const LoadStage &stage)
  {
    if (directory_.empty())
      return;
    TimerOutput::Scope timer(timer_, "Output");
    const IGASpace<3> &space = bodies_->space();
    PictureState       state;
    for (unsigned int A = 0; A < space.n_control_points(); ++A)
      state.positions.push_back(
        space.control_points()[A] +
        Tensor<1, 3>({u_[3 * A], u_[3 * A + 1], u_[3 * A + 2]}));
    for (const PointState &point : states_at_control_points(
           space, bodies_->laws(), bodies_->gradients(), u_))
      state.values.push_back(point.von_mises);
    state.woven = woven_;
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      state.H[n] = u_[macro_.mode(n)];

    std::ostringstream title;
    title << "Stage " << stage.name << ", load factor " << load_factor_;
    for (const auto &[n, target] : stage.H_targets)
      title << ", H" << n + 1 << " = " << state.H[n] << (n < 3 ? "" : " 1/mm");
    for (const auto &[n, target] : stage.n_targets)
      title << ", n" << n + 1 << " = " << applied_[n]
            << (n < 3 ? " N/mm" : " N");
    std::string name = "cell_" + stage.name;
    for (char &c : name)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-')
        c = '_';

    // A picture is not worth a run, so even a full disk does not end it here.
    try
      {
        write_cell_picture(directory_,
                           name,
                           title.str(),
                           "von Mises stress [MPa]",
                           make_picture_surfaces(*cell_, space, state));
        cell_scripts_.push_back(name + ".gp");
      }
    catch (const dealii::ExceptionBase &failure) // of replace_file()
      {
        log_.warning(std::string("The cell is not drawn: ") + failure.what());
      }
  }



  void
  NumericalPlateTesting::draw_cells()
  {
    if (cell_scripts_.empty())
      return;
    TimerOutput::Scope timer(timer_, "Output");
    const std::string  warning = run_gnuplot(directory_, cell_scripts_);
    if (!warning.empty())
      log_.warning(warning);
    cell_scripts_.clear();
  }



  void
  NumericalPlateTesting::finish_output()
  {
    log_.finish();
    if (const auto loop = last_loop(curve_, cell_->area()))
      {
        log_.line(describe(*loop));
        if (!directory_.empty())
          write_hysteresis(directory_ + "/hysteresis.csv", *loop);
      }
    warn_of_penetration();
    if (directory_.empty())
      return;
    draw_cells();
    if (parameters_.output.picture)
      {
        TimerOutput::Scope timer(timer_, "Output");
        const std::string  warning = plot_curves(directory_);
        if (!warning.empty())
          log_.warning(warning);
      }
    log_.line("Factorizations: " + std::to_string(linear_solver_->n_numeric()) +
              " (" + std::to_string(linear_solver_->n_symbolic()) +
              " new patterns), " + std::to_string(system_.n_free()) +
              " free unknowns, " +
              std::to_string(system_.free_matrix().n_nonzeros()) + " nonzeros");
    timer_.print_summary();
  }



  void
  NumericalPlateTesting::warn_of_penetration()
  {
    // Up to about here results are off by some percent; deeper they describe
    // another fabric, and nothing in the curves shows it.
    const double much      = 0.05;
    const double thickness = parameters_.cell.bundle_thickness.smaller();
    const auto   deepest =
      std::max_element(curve_.begin(),
                       curve_.end(),
                       [](const CurveRow &a, const CurveRow &b) {
                         return a.largest_penetration < b.largest_penetration;
                       });
    if (deepest == curve_.end() ||
        deepest->largest_penetration <= much * thickness)
      return;
    log_.warning(
      "The bundles penetrate each other by " +
      short_number(deepest->largest_penetration, 2) + " mm, " +
      short_number(100. * deepest->largest_penetration / thickness, 2) +
      " % of their thickness (stage " + deepest->stage + ", load factor " +
      short_number(deepest->load_factor, 3) +
      "). What to try: a larger Normal penalty, Enforcement = augmented "
      "Lagrangian (subsection Contact), or, if it begins with the first "
      "contact, a shorter Initial step of the weaving stage.");
  }
} // namespace NPT
