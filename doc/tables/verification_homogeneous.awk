# Files: output-verification/*/homogeneous.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Homogeneous states: the largest errors over bases and degrees.

function largest(key, value) { if (value > worst[key]) worst[key] = value + 0 }

BEGIN {
  print "| file | state | fiber along | error of the average | of P at the worst point | Newton iterations |"
  print "| --- | --- | --- | --- | --- | --- |"
}

function row(    key)
{
  key = "| `" folder "` | " cell["mode"] " | " cell["fiber_direction"]
  if (!(key in known)) {
    known[key] = ++n
    name[n] = key
  }
  largest(key "average", cell["error_average"])
  largest(key "point", cell["error_pointwise"])
  largest(key "iterations", cell["newton_iterations"])
}

function finish(    k)
{
  for (k = 1; k <= n; ++k)
    print name[k] " | " scientific(worst[name[k] "average"], 1) " | " \
      scientific(worst[name[k] "point"], 1) " | " \
      worst[name[k] "iterations"] + 0 " |"
}
