# Files: output-studies/ARGUMENT/map.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# How the cases of a stability map end, over its two axes.

function row(    line)
{
  if (!(cell["x"] in x_value)) {
    x_value[cell["x"]] = cell[column[14]]
    ++n_x
  }
  line = sprintf("%d %d", cell["panel"], cell["y"])
  if (!(line in title)) {
    title[line] = "| " cell["panel_name"] " | " cell[column[15]] " |"
    panel[++n_lines] = line
  }
  x_name = column[14]
  y_name = column[15]
  if (cell["outcome"] ~ /^done/)
    entry[line, cell["x"]] = cell["newton_iterations"] \
      (cell["cuts"] > 0 ? " (" cell["cuts"] ")" : "")
  else
    entry[line, cell["x"]] = cell["outcome"] ", " cell["text"]
}

function finish(    l, x, text)
{
  text = "| | " y_name " |"
  for (x = 0; x < n_x; ++x)
    text = text " " (x == 0 ? x_name " " : "") x_value[x] " |"
  print text
  gsub(/[^|]+/, " --- ", text)
  print text
  # By panels, and in each by the vertical axis.
  for (l = 1; l <= n_lines; ++l) {
    split(panel[l], part, " ")
    order[part[1] * 1000 + part[2]] = panel[l]
    if (part[1] * 1000 + part[2] > last)
      last = part[1] * 1000 + part[2]
  }
  for (l = 0; l <= last; ++l)
    if (l in order) {
      text = title[order[l]]
      for (x = 0; x < n_x; ++x)
        text = text " " entry[order[l], x] " |"
      print text
    }
}
