# Files: output-verification-series/penalty*/comparison.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Two cylinders over the normal penalty.

function row(    q)
{
  q = cell["quantity"]
  if (q == "approach of the plates")
    approach[folder] = cell["computed"]
  else if (cell["exact"] != "")
    value[q folder] = per_cent(cell["error"], 3)
}

function finish(    series, folder)
{
  series = "1e5 2e5 4e5 8e5 1.6e6"
  for (folder in approach)
    value["surplus" folder] = \
      scientific(approach[folder] - approach["penalty=1e7"], 1)
  show_series("eps_N [N/mm^3]", series)
  show_line("surplus of the approach [mm]", "surpluspenalty=", series)
  show_line("peak pressure", "peak pressurepenalty=", series)
  show_line("half width", "half widthpenalty=", series)
}
