// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the contact and friction entries of the parameter file.

#ifndef npt_dealii_contact_contact_parameters_h
#define npt_dealii_contact_contact_parameters_h

#include <npt_dealii/base/own_numbers.h>
#include <npt_dealii/base/parameter_binding.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /// Subsection "Contact".
  struct ContactParameters
  {
    enum class Method
    {
      mortar, ///< conditions averaged over the support of a control point
      KTS     ///< knot to surface: conditions at Gauss points
    };

    enum class Enforcement
    {
      penalty,             ///< pressure = penalty times penetration
      augmented_lagrangian ///< with multipliers, to given tolerances
    };

    enum class RoundEdges
    {
      automatic, ///< where the edges are thick
      yes,
      no
    };

    Method method = Method::mortar;
    /// A name of Registry<NamedNormalLaw>.
    std::string normal_law = "penalty";
    /// Numbers of all normal laws by entry, see NamedNormalLaw::numbers.
    OwnValues normal_law_numbers;
    double    normal_penalty = 100.; ///< epsilon_N [N/mm^3]
    /// Normal and tangential penalty follow from the bundles (A43).
    bool         automatic_penalties = false;
    unsigned int n_quadrature_points = 0;    ///< 0: degree + 1
    double       maximum_penetration = 0.5;  ///< fraction of thickness
    double       maximum_overlap     = 0.2;  ///< fraction of thickness
    double       edge_radius         = 0.25; ///< fraction of thickness
    RoundEdges   round_edges         = RoundEdges::automatic;
    double       kink_rounding       = 0.1; ///< fraction of a span
    Enforcement  enforcement         = Enforcement::penalty;
    /// Of the augmented Lagrangian [mm]; 0: what set_thickness() says.
    double       penetration_tolerance = 0.;
    double       stick_tolerance       = 0.;
    unsigned int max_augmentations     = 50;

    bool
    augmented() const
    {
      return enforcement == Enforcement::augmented_lagrangian;
    }

    /// Put default_tolerance times the thickness [mm] of the bodies where a
    /// tolerance is 0.
    void
    set_thickness(const double thickness);

    /// Of the augmented Lagrangian, fraction of the thickness; 2e-5 mm in the
    /// default cell.
    static constexpr double default_tolerance = 2e-5 / 1.2;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);

  private:
    void
    add_enforcement_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<ContactParameters::Method> &
  enum_names<ContactParameters::Method>();

  template <>
  const EnumNames<ContactParameters::Enforcement> &
  enum_names<ContactParameters::Enforcement>();

  template <>
  const EnumNames<ContactParameters::RoundEdges> &
  enum_names<ContactParameters::RoundEdges>();

  /// Friction coefficient by the angle between fibers; empty: not given.
  struct FrictionTable
  {
    /// Angle [degrees], rising within 0 to 90, and mu >= 0 [-].
    using Values = std::vector<std::pair<double, double>>;
    Values values;
  };

  /// "" or "0: 0.35, 45: 0.27, 90: 0.22". Throws InputError for another.
  template <>
  struct EntryValue<FrictionTable>
  {
    static std::string
    text(const FrictionTable &table);
    static FrictionTable
    value(const std::string &text);
    static std::unique_ptr<dealii::Patterns::PatternBase>
    pattern();
  };

  /// Subsection "Friction".
  struct FrictionParameters
  {
    /// A name of Registry<NamedFrictionLaw<2>>.
    std::string law = "Coulomb";
    /// Numbers of all friction laws by entry, see NamedFrictionLaw::numbers.
    OwnValues law_numbers;
    double    coefficient        = 0.3;  ///< mu [-]
    double    tangential_penalty = 100.; ///< epsilon_T [N/mm^3]
    /// Of yarns, (A38); see FrictionCoefficient.
    FrictionTable by_angle;            ///< mu_s(theta)
    double        dynamic_ratio = 1.;  ///< mu_d / mu_s [-]
    double        slip_length   = 0.1; ///< of the decay from mu_s [mm]
    /// Where Coulomb's law is posed; only Method::mortar has a choice.
    enum class Nodes
    {
      contact_nodes, ///< slip averaged as the gap is, (41), (42)
      Gauss_points   ///< with the interpolated pressure, (A27)
    };
    Nodes nodes = Nodes::Gauss_points;
    /// A name of Registry<NamedSlipMeasure<3>>.
    std::string slip_measure = "relative displacement";

    /// Throws InputError if the coefficient varies and is zero at once.
    void
    check() const;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);

  private:
    void
    add_yarn_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<FrictionParameters::Nodes> &
  enum_names<FrictionParameters::Nodes>();
} // namespace NPT

#endif
