# Files: output-verification-series/disc*/comparison.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Torque of the slipping disc over the number of spans.

function row()
{
  if (cell["quantity"] == "torque")
    value[folder] = per_cent(cell["error"], 2)
}

function finish()
{
  show_series("spans across the disc", "4 8 16 32")
  show_line("mortar", "disc mortar=", "4 8 16 32")
  show_line("KTS", "disc KTS=", "4 8 16 32")
}
