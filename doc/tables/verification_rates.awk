# Files: output-verification/*/convergence.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# The finest pair of meshes of each series.

function show()
{
  if (line != "")
    print line
  line = ""
}

BEGIN {
  print "| file | basis | p | n | cells | unknowns | energy error | rate | L2 error | rate | CPU [s] |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
}

function row(    series)
{
  series = folder cell["basis"] cell["degree"]
  if (series != last)
    show()
  last = series
  line = "| `" folder "` | " cell["basis"] " | " cell["degree"] " | " \
    cell["elements"] " | " cell["cells"] " | " cell["unknowns"] " | " \
    scientific(cell["error_energy"], 2) " | " fixed(cell["rate_energy"], 2) \
    " | " scientific(cell["error_L2"], 2) " | " fixed(cell["rate_L2"], 2) \
    " | " fixed(cell["cpu_seconds"], 1) " |"
}

function finish() { show() }
