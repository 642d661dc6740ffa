# SPDX-License-Identifier: LGPL-2.1-or-later
# Reading of CSV files for the tables of doc/. For each row the program of the
# table sees its function row(), with the cells by their column names in
# `cell["error_L2"]`, the name of the folder of the file in `folder`, and
# `first_row` = 1 in the first row of each file. Here are functions that format
# numbers. At the end its function finish() is called.

# The cells of a line into the array `part`; returns how many.
function split_csv(line, part,    n, text, quoted)
{
  n = 0
  delete part
  while (1) {
    text = ""
    if (substr(line, 1, 1) == "\"") {
      line = substr(line, 2)
      while (match(line, /"/)) {
        text = text substr(line, 1, RSTART - 1)
        line = substr(line, RSTART + 1)
        if (substr(line, 1, 1) != "\"")
          break
        text = text "\""
        line = substr(line, 2)
      }
    } else {
      match(line, /^[^,]*/)
      text = substr(line, 1, RLENGTH)
      line = substr(line, RLENGTH + 1)
    }
    part[++n] = text
    if (substr(line, 1, 1) != ",")
      return n
    line = substr(line, 2)
  }
}

# A number with some significant digits, without an exponent where possible.
function digits(value, n) { return sprintf("%." n "g", value) }

function scientific(value, n) { return sprintf("%." n "e", value) }

function fixed(value, n) { return sprintf("%." n "f", value) }

# A relative number in per cent; small ones as they are.
function per_cent(value, n)
{
  value += 0 # else texts would be compared
  if (value != 0 && value < 1e-6 && value > -1e-6)
    return sprintf("%.0e", value)
  return sprintf("%." n "g %%", 100 * value)
}

# The settings of a work-precision study in few words: of "Degree 2, Basis
# NURBS, Elements along 5, Method mortar, Enforcement penalty, Normal penalty
# 100, Initial step 0.1" remains "NURBS, mortar, penalty 100, 5 x 5". Steps of
# 10 % are those of all cases but a few.
function short_setting(text,    n, item, i, result, basis, mesh, steps, degree)
{
  n = split(text, item, ", ")
  for (i = 1; i <= n; ++i) {
    sub(/^(Basis|Method|Enforcement) /, "", item[i])
    if (item[i] ~ /^Degree /)
      degree = substr(item[i], 8) == 2 ? "" : " p = " substr(item[i], 8)
    else if (item[i] ~ /^Elements along /)
      mesh = ", " substr(item[i], 16) " x " substr(item[i], 16)
    else if (item[i] ~ /^Initial step /)
      steps = substr(item[i], 14) == 0.1 ? "" : \
        ", steps of " 100 * substr(item[i], 14) " %"
    else if (item[i] ~ /^Normal penalty /) {
      # The augmented Lagrangian has a penalty too, of little influence.
      if (result !~ /augmented Lagrangian/) {
        sub(/, penalty$/, "", result)
        result = result ", " substr(item[i], 8)
      }
    } else
      result = result (i > 1 && result != "" ? ", " : "") item[i]
  }
  sub(/NURBS|Bernstein|Lagrange/, "&" degree, result)
  sub(/Bernstein/, "Bernstein (C0)", result)
  return result steps mesh
}

# The two lines of a header, and a line of cells value[prefix ITEM] for each
# item of a list separated by blanks.
function show_series(title, list,    n, item, i, line, rule)
{
  n = split(list, item, " ")
  line = "| " title " |"
  rule = "| --- |"
  for (i = 1; i <= n; ++i) {
    line = line " " item[i] " |"
    rule = rule " --- |"
  }
  print line
  print rule
}

function show_line(title, prefix, list,    n, item, i, line)
{
  n = split(list, item, " ")
  line = "| " title " |"
  for (i = 1; i <= n; ++i)
    line = line " " value[prefix item[i]] " |"
  print line
}

FNR == 1 {
  n_columns = 0
  first_row = 1
  folder = FILENAME
  sub(/\/[^\/]*$/, "", folder)
  sub(/.*\//, "", folder)
}

/^#/ { next }

n_columns == 0 {
  n_columns = split_csv($0, column)
  next
}

{
  split_csv($0, part)
  delete cell
  for (i = 1; i <= n_columns; ++i)
    cell[column[i]] = part[i]
  row()
  first_row = 0
}

END { finish() }
