# Files: output-verification-series/spans*/comparison.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Two cylinders over the number of spans.

function row(    q)
{
  q = cell["quantity"]
  if (q == "pressure profile, L2")
    value[q folder] = scientific(cell["computed"], 1)
  else if (cell["exact"] != "")
    value[q folder] = per_cent(cell["error"], 2)
}

function finish(    series)
{
  series = "mortar=4 mortar=8 mortar=16 KTS=8"
  print "| spans per half width | 4, 3 | 8, 7 | 16, 15 | 8, 7 KTS |"
  print "| --- | --- | --- | --- | --- |"
  show_line("peak pressure", "peak pressurespans ", series)
  show_line("half width", "half widthspans ", series)
  show_line("profile, relative L2", "pressure profile, L2spans ", series)
}
