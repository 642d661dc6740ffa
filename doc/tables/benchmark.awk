# Files: ARGUMENT/benchmark.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Medians of CPU and wall time, memory, and the phases of the runs of
# scripts/benchmark. A second program is the one of the ratio.

function median(list,    v, n, i, j, t)
{
  n = split(list, v, " ")
  for (i = 1; i <= n; ++i)
    for (j = i + 1; j <= n; ++j)
      if (v[j] + 0 < v[i] + 0) {
        t = v[i]
        v[i] = v[j]
        v[j] = t
      }
  return v[int((n + 1) / 2)]
}

function row(    k, c)
{
  if (!(cell["program"] in place))
    place[cell["program"]] = ++n_programs
  c = cell["case"]
  k = c "|" place[cell["program"]]
  if (!(c in known)) {
    known[c] = 1
    order[++n] = c
  }
  cpu[k] = cpu[k] " " cell["cpu"]
  wall[k] = wall[k] " " cell["wall"]
  memory[k] = memory[k] " " (cell["gigabytes"] == "" ? "nan" : cell["gigabytes"])
  unknowns[k] = cell["unknowns"]
  factorizations[k] = cell["factorizations"]
  phases[k] = fixed(cell["factorize"], 2) " | " fixed(cell["solve"], 2) \
    " | " fixed(cell["bundles"], 2) " | " fixed(cell["contact"], 2) " | " \
    fixed(cell["pattern"], 2)
}

function finish(    i, c, k, other)
{
  print "| case | unknowns | CPU [s] | wall [s] | memory [GB] | factorizations | factorize | solve | bundles | contact | pattern | ratio |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  for (i = 1; i <= n; ++i) {
    c = order[i]
    k = c "|1"
    other = c "|2"
    if (k in cpu)
      print "| " c " | " unknowns[k] " | " fixed(median(cpu[k]), 2) " | " \
        fixed(median(wall[k]), 2) " | " fixed(median(memory[k]), 2) " | " \
        factorizations[k] " | " phases[k] " | " \
        (other in cpu ? fixed(median(cpu[k]) / median(cpu[other]), 3) : "") " |"
  }
}
