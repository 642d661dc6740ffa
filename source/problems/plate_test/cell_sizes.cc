// SPDX-License-Identifier: LGPL-2.1-or-later
// Sizes of a cell and of its stiffness, for the head of the log.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/problems/plate_test/cell_contacts.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>

#include <deal.II/lac/full_matrix.h>

namespace NPT
{
  namespace
  {
    std::string
    describe(const WarpWeft &value)
    {
      return value.warp == value.weft ?
               short_number(value.warp) + " mm" :
               "warp " + short_number(value.warp) + " mm, weft " +
                 short_number(value.weft) + " mm";
    }



    // The spacing of a family lies across it.
    std::string
    describe_spacing(const WarpWeft &value)
    {
      return value.warp == value.weft ?
               short_number(value.warp) + " mm" :
               "between warp bundles " + short_number(value.warp) +
                 " mm, between weft bundles " + short_number(value.weft) +
                 " mm";
    }



    std::string
    describe(const StiffnessAtRest &stiffness)
    {
      return "E_L " + short_number(stiffness.E_L) + ", E_T " +
             short_number(stiffness.E_T) + ", G_L " +
             short_number(stiffness.G_L) + ", G_T " +
             short_number(stiffness.G_T) + " MPa";
    }



    std::string
    describe_fraction(const PlateCell           &cell,
                      const PlateTestParameters &parameters)
    {
      double volume = 0;
      for (const double integral : cell.bodies().integrals_of_functions(false))
        volume += integral;
      const double layer = layer_thickness(parameters.cell);
      volume /= cell.fabric().n_layers();
      return short_number(100. * volume / (cell.fabric().area() * layer), 4) +
             " % of the layer, which is " + short_number(layer) +
             " mm thick; volume " + short_number(volume) + " mm^3";
    }
  } // namespace



  double
  layer_thickness(const CellParameters &cell)
  {
    return cell.type == "laminate" ? cell.bundle_thickness.warp :
                                     2. * cell.bundle_thickness.mean();
  }



  StiffnessAtRest
  stiffness_at_rest(const MaterialParameters &material)
  {
    dealii::FullMatrix<double> S =
      make_material<3>(material, dealii::Tensor<1, 3>({1., 0., 0.}))
        ->small_strain_stiffness();
    S.gauss_jordan(); // the compliance; rows 11, 22, 33, 23, 31, 12
    return {1. / S(0, 0), 1. / S(1, 1), 1. / S(5, 5), 1. / S(3, 3)};
  }



  namespace
  {
    // (A43), the number in the text of the entry Automatic penalties.
    const double automatic_ratio = 50.;

    // Mean of warp and weft [mm^3/N].
    double
    compliance_across(const PlateTestParameters &parameters)
    {
      const WarpWeft &t = parameters.cell.bundle_thickness;
      return 0.5 * (t.warp / stiffness_at_rest(parameters.material).E_T +
                    t.weft / stiffness_at_rest(parameters.weft_material).E_T);
    }
  } // namespace



  double
  penalty_over_stiffness(const PlateTestParameters &parameters)
  {
    return parameters.contact.normal_penalty * compliance_across(parameters);
  }



  double
  automatic_penalty(const PlateTestParameters &parameters)
  {
    return automatic_ratio / compliance_across(parameters);
  }



  std::vector<std::pair<std::string, std::string>>
  describe_sizes(const PlateCell &cell, const PlateTestParameters &parameters)
  {
    const CellParameters &sizes = parameters.cell;
    const std::string     area =
      ", stands for " + short_number(cell.fabric().area()) + " mm^2 of fabric";
    const std::string at_rest =
      describe(stiffness_at_rest(parameters.material));
    if (sizes.type == "laminate")
      return {{"cell", sizes.type + area},
              {"thickness", describe(WarpWeft(sizes.bundle_thickness.warp))},
              {"stiffness", at_rest + " at rest"}};
    const std::string of_weft =
      describe(stiffness_at_rest(parameters.weft_material));
    std::vector<std::pair<std::string, std::string>> result = {
      {"cell", sizes.type + area},
      {"weave", sizes.weave},
      {"spacing", describe_spacing(sizes.crossing_spacing)},
      {"width", describe(sizes.bundle_width)},
      {"thickness", describe(sizes.bundle_thickness)},
      {"bundles fill", describe_fraction(cell, parameters)},
      {"stiffness",
       (of_weft == at_rest ? at_rest :
                             "warp " + at_rest + "; weft " + of_weft) +
         " at rest"},
      {"penalty",
       short_number(parameters.contact.normal_penalty) + " N/mm^3, " +
         short_number(penalty_over_stiffness(parameters), 3) +
         " times E_T / thickness"}};
    if (has_round_edges(cell.fabric(), parameters.contact))
      result.emplace_back("edges",
                          "round, of radius " +
                            describe(WarpWeft(sizes.warp_section().tip,
                                              sizes.weft_section().tip)));
    return result;
  }
} // namespace NPT
