// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the table of the macroscopic modes of a plate: the generalized
// displacement gradients H1..H6. The only place that knows how many there are.

#ifndef npt_dealii_homogenization_macro_modes_h
#define npt_dealii_homogenization_macro_modes_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace NPT
{
  /**
   * One macroscopic mode: a generalized displacement gradient H_n and its
   * conjugate resultant n_n, the work of both per area being n_n dH_n.
   */
  struct MacroMode
  {
    enum class Kind
    {
      membrane, ///< gradient [-], conjugate [N/mm]
      bending   ///< gradient [1/mm], conjugate [N]
    };

    const char *name;      ///< "H1"
    const char *conjugate; ///< "n1"
    const char *meaning;   ///< "extension"
    Kind        kind;
    /// Whether the mode changes its sign with Q_11, Q_22, Q_33 of a symmetry
    /// operation Y -> Q Y + a.
    std::array<bool, 3> odd;
    /// Displacement w_n(Y) of one unit of H_n.
    dealii::Tensor<1, 3> (*displacement)(const dealii::Point<3> &Y);
    /// Names in reports of loops: the letters of the fabric testers after
    /// Kawabata, or what they stand for where these have none.
    const char *rigidity, *hysteresis;

    constexpr const char *
    unit() const
    {
      return kind == Kind::membrane ? "-" : "1/mm";
    }
    constexpr const char *
    conjugate_unit() const
    {
      return kind == Kind::membrane ? "N/mm" : "N";
    }
    /// Of n_n over H_n.
    constexpr const char *
    rigidity_unit() const
    {
      return kind == Kind::membrane ? "N/mm" : "N mm";
    }
    /// Whether it lengthens or shortens the mid-plane along Y1 or Y2.
    constexpr bool
    is_extension() const
    {
      return kind == Kind::membrane && !odd[0] && !odd[1] && !odd[2];
    }
  };

  /**
   * The modes. Their sum is the macroscopic displacement (theory, section 2)
   *
   * @f[ w_m = ( H_1 Y_1 + H_3 Y_2/2 + Z_3 (H_4 Y_1 + H_6 Y_2/2),\;
   *             H_2 Y_2 + H_3 Y_1/2 + Z_3 (H_5 Y_2 + H_6 Y_1/2),\;
   *           -(H_4 Y_1^2 + H_5 Y_2^2 + H_6 Y_1 Y_2)/2 ) . @f]
   */
  namespace MacroModes
  {
    inline dealii::Tensor<1, 3>
    extension_1(const dealii::Point<3> &Y)
    {
      return dealii::Tensor<1, 3>({Y[0], 0., 0.});
    }
    inline dealii::Tensor<1, 3>
    extension_2(const dealii::Point<3> &Y)
    {
      return dealii::Tensor<1, 3>({0., Y[1], 0.});
    }
    inline dealii::Tensor<1, 3>
    shear(const dealii::Point<3> &Y)
    {
      return dealii::Tensor<1, 3>({0.5 * Y[1], 0.5 * Y[0], 0.});
    }
    inline dealii::Tensor<1, 3>
    bending_1(const dealii::Point<3> &Y)
    {
      return dealii::Tensor<1, 3>({Y[2] * Y[0], 0., -0.5 * Y[0] * Y[0]});
    }
    inline dealii::Tensor<1, 3>
    bending_2(const dealii::Point<3> &Y)
    {
      return dealii::Tensor<1, 3>({0., Y[2] * Y[1], -0.5 * Y[1] * Y[1]});
    }
    inline dealii::Tensor<1, 3>
    torsion(const dealii::Point<3> &Y)
    {
      return dealii::Tensor<1, 3>(
        {0.5 * Y[2] * Y[1], 0.5 * Y[2] * Y[0], -0.5 * Y[0] * Y[1]});
    }

    /// The table: another mode is another row here, and nothing else.
    // clang-format off
    inline constexpr MacroMode table[] = {
      MacroMode{"H1", "n1", "extension", MacroMode::Kind::membrane,
                {{false, false, false}}, &extension_1, "dn1/dH1", "of n1"},
      MacroMode{"H2", "n2", "extension", MacroMode::Kind::membrane,
                {{false, false, false}}, &extension_2, "dn2/dH2", "of n2"},
      MacroMode{"H3", "n3", "shear", MacroMode::Kind::membrane,
                {{true, true, false}}, &shear, "G", "2HG"},
      MacroMode{"H4", "n4", "bending", MacroMode::Kind::bending,
                {{false, false, true}}, &bending_1, "B", "2HB"},
      MacroMode{"H5", "n5", "bending", MacroMode::Kind::bending,
                {{false, false, true}}, &bending_2, "B", "2HB"},
      MacroMode{"H6", "n6", "torsion", MacroMode::Kind::bending,
                {{true, true, true}}, &torsion, "D", "2HT"}};
    // clang-format on

    /// How many modes there are.
    inline constexpr unsigned int n = std::size(table);

    /// The number of the mode with this name of its gradient ("H3") or of its
    /// conjugate ("n3"); `n` if there is none.
    constexpr unsigned int
    number_of(const std::string_view name)
    {
      for (unsigned int k = 0; k < n; ++k)
        if (name == table[k].name || name == table[k].conjugate)
          return k;
      return n;
    }

    /// Whether this is the name of a conjugate.
    constexpr bool
    is_conjugate(const std::string_view name)
    {
      const unsigned int k = number_of(name);
      return k < n && name == table[k].conjugate;
    }

    /// Names of all gradients, then of all conjugates, "H1|H2| ... |n6": what a
    /// parameter may choose from.
    std::string
    choices();

    /// A list with commas, "H1, H2 and H3".
    std::string
    list_of_names(const std::vector<unsigned int> &modes);

    /// What the gradients mean, with their units: "H1, H2 extension [-], H3
    /// shear [-], H4, H5 bending [1/mm], H6 torsion [1/mm]".
    std::string
    meaning_of_gradients();

    /// The units of the conjugates: "n1, n2, n3 [N/mm], n4, n5, n6 [N]".
    std::string
    units_of_conjugates();

    /// A number with its unit, "0.2", "0.01 1/mm", for titles.
    std::string
    with_unit(const std::string &number, const std::string &unit);
  } // namespace MacroModes
} // namespace NPT

#endif
