# Files: output-studies/*/cases.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# What the studies take: sums over all their cases.

BEGIN {
  print "| file | cases | of these done | load steps | Newton iterations | failed steps | CPU [s] | longest case [s] |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- |"
}

function show()
{
  if (n > 0)
    print "| `studies/" last ".prm` | " n " | " done + 0 " | " steps " | " \
      iterations " | " cuts " | " fixed(cpu, 0) " | " fixed(longest, 0) " |"
  n = done = steps = iterations = cuts = cpu = longest = 0
}

function row()
{
  if (folder != last)
    show()
  last = folder
  ++n
  done += cell["status"] == "done"
  steps += cell["steps"]
  iterations += cell["newton_iterations"]
  cuts += cell["cuts"]
  cpu += cell["cpu_seconds"]
  if (cell["cpu_seconds"] + 0 > longest)
    longest = cell["cpu_seconds"] + 0
}

function finish() { show() }
