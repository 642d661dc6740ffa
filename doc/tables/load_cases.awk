# Files: output-load_cases/*/summary.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# What the runs of the ready parameter files take.

BEGIN {
  print "| file | free unknowns | load steps | Newton iterations | failed steps | CPU [s] |"
  print "| --- | --- | --- | --- | --- | --- |"
}

function row()
{
  print "| `" folder ".prm` | " cell["unknowns"] " | " cell["steps"] " | " \
    cell["newton_iterations"] " | " cell["cuts"] " | " \
    (cell["status"] == "done" ? digits(cell["cpu_seconds"], 2) : \
      cell["status"] ": " cell["reason"]) " |"
}

function finish() {}
