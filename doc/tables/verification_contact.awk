# Files: output-verification/contact_*/comparison.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Contact: every compared quantity with its error and its tolerance.

BEGIN {
  print "| file | quantity | computed | exact | error | allowed |"
  print "| --- | --- | --- | --- | --- | --- |"
}

function row(    unit, relative)
{
  if (cell["exact"] == "" || cell["quantity"] ~ /imbalance/)
    return
  unit = cell["unit"] == "-" ? "" : " " cell["unit"]
  relative = cell["exact"] + 0 != 0
  print "| " (folder == last ? "" : "`" folder "`") " | " cell["quantity"] \
    " | " digits(cell["computed"], relative ? 5 : 2) unit " | " \
    digits(cell["exact"], 5) unit " | " \
    (relative ? per_cent(cell["error"], 2) : "") " | " \
    (cell["allowed"] == "" ? "" : relative ? per_cent(cell["allowed"], 2) : \
      digits(cell["allowed"], 2)) " |"
  last = folder
}

function finish() {}
