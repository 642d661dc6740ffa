// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the 4/1 twill by its name, an example of a further weave.

#include <npt_dealii/fabric/named_weave.h>

namespace NPT
{
  namespace
  {
    // One row per weft bundle: o where the warp is over it, u where under.
    const Registry<NamedWeave>::Registration
      twill("4/1 twill", {"oooou/ooouo/oouoo/ouooo/uoooo"});
  } // namespace
} // namespace NPT
