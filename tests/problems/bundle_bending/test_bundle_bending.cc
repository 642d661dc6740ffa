// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the bending of one bundle: between a solid and loose layers it
// is that of Eq. (A33), and fibers that buckle have the double modulus (A34).

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/material/bundle_bending.h>
#include <npt_dealii/problems/bundle_bending/bundle_bending_test.h>

#include <catch2/catch.hpp>

#include <sstream>

using namespace NPT;

namespace
{
  std::vector<BundleBendingRow>
  bend(const std::vector<std::string> &overrides)
  {
    std::ostringstream screen;
    return bend_bundle(BundleBendingParameters::read({}, overrides),
                       "",
                       screen);
  }
} // namespace



TEST_CASE("A bent bundle has the stiffness of a solid or of sliding layers, as "
          "its shear modulus says",
          "[bundle_bending]")
{
  // E_L (t/L)^2 is 570 MPa.
  for (const std::string G : {"1e6", "100", "5", "0.5"})
    {
      const auto row = bend({"Material/Longitudinal shear modulus=" + G})[0];
      INFO("G_L = " << G);
      // Where layers slide, their boundary layers at the faces are thinner
      // than an element: 0.7 % at 0.5 MPa, 0.01 % with four times the elements.
      CHECK(row.stiffness == Approx(row.formula).epsilon(0.01));
      if (G == "1e6")
        CHECK(row.stiffness == Approx(row.solid).epsilon(1e-3));
      if (G == "0.5")
        CHECK(row.stiffness < 2e-3 * row.solid);
      CHECK(row.loose < row.stiffness);
    }
}



TEST_CASE("The shear modulus of a given bending ratio gives the bundle this "
          "bending stiffness",
          "[bundle_bending]")
{
  const auto row = bend({"Material/Bending ratio=0.02",
                         "Material/Bending slenderness=0.1",
                         "Bending/Half waves=6"})[0];
  CHECK(row.stiffness == Approx(0.02 * row.solid).epsilon(0.01));
}



TEST_CASE("A bundle whose fibers buckle at once bends with the double modulus",
          "[bundle_bending]")
{
  // The bending strain is 7e-3, of which the side in tension has a tenth.
  const auto   row = bend({"Material/Longitudinal shear modulus=1e6",
                           "Material/Compression ratio=0.01",
                           "Material/Buckling strain=1e-7",
                           "Bending/Amplitudes=0.1"})[0];
  const double E   = 43200.;
  CHECK(row.stiffness / row.solid ==
        Approx(double_modulus(E, 0.01 * E) / E).epsilon(0.02));
}



TEST_CASE("A bending stiffness that is not that of the formula is an error if "
          "the file says so",
          "[bundle_bending]")
{
  // Fibers that have buckled bend more softly.
  CHECK_THROWS_WITH(bend({"Material/Longitudinal shear modulus=1e6",
                          "Material/Compression ratio=0.1",
                          "Material/Buckling strain=1e-6",
                          "Bending/Amplitudes=0.01",
                          "Bending/Tolerance=0.02"}),
                    Catch::Contains("not that of Eq. (A33)") &&
                      Catch::Contains("Half wave 5.24 mm"));
}



TEST_CASE("The shear modulus that a measured bending stiffness says gives the "
          "bundle that stiffness; one above a solid's is refused",
          "[bundle_bending]")
{
  const auto measured =
    BundleBendingParameters::read({}, {"Bending/Measured stiffness=3"});
  const IdentifiedBending found = identify_bending(measured);
  CHECK(found.slenderness == Approx(0.6 / 5.24));
  const auto row = bend({"Material/Longitudinal shear modulus=" +
                         std::to_string(found.shear_modulus)})[0];
  CHECK(row.formula == Approx(3.).epsilon(1e-5)); // digits of the text
  CHECK(row.stiffness == Approx(3.).epsilon(0.01));

  CHECK_THROWS_WITH(
    BundleBendingParameters::read({}, {"Bending/Measured stiffness=800"}),
    Catch::Contains("Measured stiffness is 800 N mm") &&
      Catch::Contains("less than that of a solid, 777.6 N mm"));
}
