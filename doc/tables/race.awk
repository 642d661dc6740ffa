# Files: tests/peers/curves/race_ARGUMENT.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Runs of the race of CalculiX and this program; those on the front are marked.

BEGIN {
  print "| program | elements | steps | unknowns | factorizations | CPU [s] | error, common reference | bound | error, own reference |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- |"
}

function row(    mesh)
{
  mesh = cell["mesh"]
  gsub(/x/, " x ", mesh)
  print "| " cell["program"] " | " mesh " | " cell["steps"] " | " \
    cell["unknowns"] " | " cell["factorizations"] " | " \
    fixed(cell["cpu_seconds"], 2) " | " fixed(100 * cell["error_common"], 2) \
    " % | " fixed(100 * cell["bound_common"], 2) " %" \
    (cell["front"] + 0 ? " *" : "") " | " \
    fixed(100 * cell["error_own"], 2) " % |"
}

function finish() {}
