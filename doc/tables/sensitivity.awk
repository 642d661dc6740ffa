# Files: output-studies/ARGUMENT/sensitivity.csv output-studies/ARGUMENT/sensitivity_band.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# A sensitivity study of one quantity: indices with their standard errors, and
# the band of the quantity, over its abscissas.

function remember(list, key)
{
  if (!((list, key) in known)) {
    known[list, key] = 1
    names[list, ++count[list]] = key
  }
}

function put(name, x, text)
{
  remember("name", name)
  remember("place", x)
  value[name, x] = text
}

function plus_minus(a, b) { return fixed(a, 2) " +- " fixed(b, 2) }

function row(    x)
{
  if ("input" in cell) {
    abscissa = column[9]
    x = cell[abscissa]
    put(cell["input"] ", alone", x,
        plus_minus(cell["first_order"], cell["first_order_error"]))
    put(cell["input"] ", with others", x,
        plus_minus(cell["total"], cell["total_error"]))
    return
  }
  x = cell[abscissa]
  put("mean", x, digits(cell["mean"], 3))
  put("5 to 95 %", x, digits(cell["5 %"], 3) " to " digits(cell["95 %"], 3))
  put("least, largest", x, digits(cell["lowest"], 3) ", " \
      digits(cell["highest"], 3))
  put("rows, left out", x, cell["rows"] ", " cell["rows_left_out"])
}

function finish(    i, k, line, rule)
{
  line = "| " abscissa " |"
  rule = "| --- |"
  for (k = 1; k <= count["place"]; ++k) {
    line = line " " names["place", k] " |"
    rule = rule " --- |"
  }
  print line
  print rule
  for (i = 1; i <= count["name"]; ++i) {
    line = "| " names["name", i] " |"
    for (k = 1; k <= count["place"]; ++k)
      line = line " " value[names["name", i], names["place", k]] " |"
    print line
  }
}
