# Files: tests/peers/curves/calculix_study.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# The isotropic woven cell by both programs.

BEGIN {
  print "| friction | program | elements | steps | n1 [N/mm] | n2 | n3 at H3 = 0.2 | difference n1 | n2 | n3 |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
}

function difference(name)
{
  return cell[name] + 0 == 0 ? "-" : fixed(100 * cell[name], 2) " %"
}

function row(    f, mesh)
{
  f = cell["friction"]
  if (!(f in lines))
    friction[++n] = f
  mesh = cell["mesh"]
  gsub(/x/, " x ", mesh)
  lines[f] = lines[f] "| " f " | " cell["program"] " | " mesh " | " \
    cell["steps"] " | " fixed(cell["n1"], 4) " | " fixed(cell["n2"], 4) " | " \
    fixed(cell["n3"], 4) " | " difference("difference_n1") " | " \
    difference("difference_n2") " | " difference("difference_n3") " |\n"
}

function finish(    i)
{
  for (i = 1; i <= n; ++i)
    printf "%s", lines[friction[i]]
}
