// SPDX-License-Identifier: LGPL-2.1-or-later
// How handles are driven, and what all contact benchmarks compare.

#include <npt_dealii/verification/contact/contact_case.h>

#include <cmath>

namespace NPT
{
  namespace
  {
    std::function<double(double, double)>
    linear_to(const double end)
    {
      return [end](const double start, const double t) {
        return start + t * (end - start);
      };
    }
  } // namespace



  HandleDrive
  move(const unsigned int handle, const double end)
  {
    return {handle, false, linear_to(end)};
  }



  HandleDrive
  load(const unsigned int handle, const double end)
  {
    return {handle, true, linear_to(end)};
  }



  std::vector<HandleDrive>
  turn(const unsigned int cosine, const unsigned int sine, const double angle)
  {
    return {{cosine,
             false,
             [angle](double, const double t) {
               return -2. * std::pow(std::sin(0.5 * angle * t), 2);
             }},
            {sine, false, [angle](double, const double t) {
               return std::sin(angle * t);
             }}};
  }



  std::vector<ComparedQuantity>
  all_quantities(const ContactCase &contact_case)
  {
    std::vector<ComparedQuantity> quantities = contact_case.quantities();
    quantities.push_back({"force imbalance of contact", "-"});
    quantities.push_back({"moment imbalance of contact", "-"});
    quantities.push_back({"largest penetration", "mm", false});
    return quantities;
  }
} // namespace NPT
