// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the weaves that textile technology knows by name.

#include <npt_dealii/fabric/named_weave.h>

namespace NPT
{
  namespace
  {
    using Registration = Registry<NamedWeave>::Registration;

    const Registration plain("plain", {"ou/uo"});
    const Registration twill("2/2 twill", {"oouu/uoou/uuoo/ouuo"});
    const Registration satin("5-harness satin",
                             {"ouuuu/uuouu/uuuuo/uouuu/uuuou"});
  } // namespace
} // namespace NPT
