# Files: output-studies/ARGUMENT/recommended.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# The cheapest setting within each accuracy, and the difference of the two
# finest references.

function row(    a)
{
  a = cell["accuracy"]
  if (!(a in known)) {
    known[a] = 1
    accuracy[++n] = a
  }
  if (!(cell["curve"] in seen)) {
    seen[cell["curve"]] = 1
    curve[++n_curves] = cell["curve"]
  }
  value[a, cell["curve"]] = cell["cpu_seconds"] == "nan" ? "none" : \
    short_setting(cell["setting"]) ": " per_cent(cell["error"], 2) ", " \
    fixed(cell["cpu_seconds"], 1) " s"
  reference[cell["curve"]] = per_cent(cell["reference_error"], 2)
}

function finish(    i, c, text)
{
  text = "| accuracy |"
  for (c = 1; c <= n_curves; ++c)
    text = text " " curve[c] " |"
  print text
  gsub(/[^|]+/, " --- ", text)
  print text
  for (i = 1; i <= n; ++i) {
    text = "| " 100 * accuracy[i] " % |"
    for (c = 1; c <= n_curves; ++c)
      text = text " " value[accuracy[i], curve[c]] " |"
    print text
  }
  text = "| two finest references differ by |"
  for (c = 1; c <= n_curves; ++c)
    text = text " " reference[curve[c]] " |"
  print text
}
