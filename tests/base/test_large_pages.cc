// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on memory in large pages.

#include <npt_dealii/base/large_pages.h>

#include <catch2/catch.hpp>

using NPT::LargePages;

TEST_CASE("An array in large pages grows only when it has to", "[base]")
{
  LargePages<float> array;
  CHECK(array.data() == nullptr);
  REQUIRE(array.resize(1000000));
  float *const first = array.data();
  first[0]           = 3;
  first[999999]      = 4;
  REQUIRE(array.resize(10));
  CHECK(array.data() == first);
  CHECK(first[0] == 3);
  CHECK(first[999999] == 4);
  REQUIRE(array.resize(2000000));
  array.data()[1999999] = 5;
}
