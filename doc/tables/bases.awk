# Files: tests/peers/curves/ARGUMENT.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# The default cell by NURBS, Bernstein and Lagrange functions.

BEGIN {
  print "| basis | spans | free unknowns | n3 at H3 = 0.2 [N/mm] | error of n3(H3) | Newton iterations | CPU [s] |"
  print "| --- | --- | --- | --- | --- | --- | --- |"
}

function row(    mesh)
{
  mesh = cell["mesh"]
  gsub(/x/, " x ", mesh)
  if (cell["n3"] == "nan") {
    print "| " cell["basis"] " | " mesh " | did not finish | | | | |"
    return
  }
  print "| " cell["basis"] " | " mesh " | " cell["unknowns"] " | " \
    fixed(cell["n3"], 5) " | " (cell["difference_n3"] + 0 == 0 ? "reference" : \
      fixed(100 * cell["difference_n3"], 2) " %") " | " cell["iterations"] \
    " | " fixed(cell["cpu_seconds"], 1) " |"
}

function finish() {}
