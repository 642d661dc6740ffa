# Files: output-verification-series/patch*/comparison.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Patch test on 4 on 3 spans over the number of Gauss points.

function row()
{
  if (cell["quantity"] == "stress error, maximum")
    value[folder] = scientific(cell["computed"], 1)
}

function finish()
{
  show_series("Gauss points per span", "3 4 5 6 9 12 16 20")
  show_line("mortar", "patch mortar=", "3 4 5 6 9 12 16 20")
  show_line("KTS", "patch KTS=", "3 4 5 6 9 12 16 20")
}
