# Files: output-studies/ARGUMENT/cases.csv output-studies/ARGUMENT/work_precision.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Error of the curve and CPU seconds of every case of a work-precision study.

function row(    series, place)
{
  if (!("error" in cell)) {
    reason[cell["case"]] = cell["reason"]
    return
  }
  series = short_setting(cell["method"])
  if (!(series in known)) {
    known[series] = 1
    name[++n_series] = series
  }
  if (!(cell["curve"] in seen)) {
    seen[cell["curve"]] = 1
    curve[++n_curves] = cell["curve"]
  }
  place = cell["setting"]
  sub(/.*Elements along /, "", place)
  sub(/,.*/, "", place)
  if (!(place in mesh_seen)) {
    mesh_seen[place] = 1
    mesh[++n_meshes] = place
  }
  value[series, cell["curve"], place] = cell["error"] == "nan" ? \
    (reason[cell["case"]] == "" ? cell["status"] : reason[cell["case"]]) : \
    digits(100 * cell["error"], 2) " / " short_time(cell["cpu_seconds"])
}

function short_time(seconds)
{
  return seconds + 0 < 9.95 ? digits(seconds, 2) : fixed(seconds, 0)
}

function finish(    s, c, m, text)
{
  text = "| relative L2 error [%] / CPU [s] |"
  for (c = 1; c <= n_curves; ++c)
    for (m = 1; m <= n_meshes; ++m)
      text = text " " (m == 1 && n_curves > 1 ? curve[c] " " : "") mesh[m] \
        " x " mesh[m] " |"
  print text
  gsub(/[^|]+/, " --- ", text)
  print text
  for (s = 1; s <= n_series; ++s) {
    text = "| " name[s] " |"
    for (c = 1; c <= n_curves; ++c)
      for (m = 1; m <= n_meshes; ++m)
        text = text " " value[name[s], curve[c], mesh[m]] " |"
    print text
  }
}
