// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the weaves that textile technology knows by name.

#include <npt_dealii/fabric/named_weave.h>

namespace NPT
{
  namespace
  {
    using Weave = Registry<NamedWeave>::Registration;

    const Weave plain("plain", {"ou/uo"});

    // Plain weave with two wefts in every other shed, in every shed, and with
    // pairs of warps as well.
    const Weave rib_21("2/1 rib", {"ou/ou/uo"});
    const Weave rib_22("2/2 rib", {"ou/ou/uo/uo"});
    const Weave basket("2/2 basket", {"oouu/oouu/uuoo/uuoo"});

    const Weave twill_21("2/1 twill", {"oou/uoo/ouo"});
    const Weave twill_31("3/1 twill", {"ooou/uooo/ouoo/oouo"});
    const Weave twill_22("2/2 twill", {"oouu/uoou/uuoo/ouuo"});

    // One binding per bundle and repeat: in a satin the next row has it two or
    // three bundles further on, in the crowfoot in the order 1, 2, 4, 3.
    const Weave crowfoot("crowfoot", {"ouuu/uouu/uuuo/uuou"});
    const Weave satin_5("5-harness satin", {"ouuuu/uuouu/uuuuo/uouuu/uuuou"});
    const Weave satin_8("8-harness satin",
                        {"ouuuuuuu/uuuouuuu/uuuuuuou/uouuuuuu/"
                         "uuuuouuu/uuuuuuuo/uuouuuuu/uuuuuouu"});
  } // namespace
} // namespace NPT
