// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the 3/1 twill by its name, an example of a further weave.

#include <npt_dealii/fabric/named_weave.h>

namespace NPT
{
  namespace
  {
    // One row per weft bundle: o where the warp is over it, u where under.
    const Registry<NamedWeave>::Registration twill("3/1 twill",
                                                   {"ooou/oouo/ouoo/uooo"});
  } // namespace
} // namespace NPT
