# Files: tests/peers/curves/race_levels_ARGUMENT.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# CPU seconds of CalculiX and of this program at equal error.

BEGIN {
  print "| reference | error | npt_dealii [s] | CalculiX [s] | ratio |"
  print "| --- | --- | --- | --- | --- |"
}

function row()
{
  print "| " cell["reference"] " | " per_cent(cell["error"], 2) " | " \
    fixed(cell["npt_seconds"], 2) " | " fixed(cell["peer_seconds"], 1) " | " \
    fixed(cell["ratio"], 1) " |"
}

function finish() {}
