// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the weaves that textile technology knows by name.

#include <npt_dealii/fabric/named_weave.h>

namespace NPT
{
  namespace
  {
    using Registration = Registry<NamedWeave>::Registration;

    const Registration plain("plain", {"ou/uo"});

    // Plain weave with two wefts in every other shed, in every shed, and with
    // pairs of warps as well.
    const Registration rib_21("2/1 rib", {"ou/ou/uo"});
    const Registration rib_22("2/2 rib", {"ou/ou/uo/uo"});
    const Registration basket("2/2 basket", {"oouu/oouu/uuoo/uuoo"});

    const Registration twill_21("2/1 twill", {"oou/uoo/ouo"});
    const Registration twill_31("3/1 twill", {"ooou/uooo/ouoo/oouo"});
    const Registration twill_22("2/2 twill", {"oouu/uoou/uuoo/ouuo"});

    // One binding per bundle and repeat: in a satin the next row has it two or
    // three bundles further on, in the crowfoot in the order 1, 2, 4, 3.
    const Registration crowfoot("crowfoot", {"ouuu/uouu/uuuo/uuou"});
    const Registration satin_5("5-harness satin",
                               {"ouuuu/uuouu/uuuuo/uouuu/uuuou"});
    const Registration satin_8("8-harness satin",
                               {"ouuuuuuu/uuuouuuu/uuuuuuou/uouuuuuu/"
                                "uuuuouuu/uuuuuuuo/uuouuuuu/uuuuuouu"});
  } // namespace
} // namespace NPT
