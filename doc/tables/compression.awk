# Files: output-studies/stability_compression/map.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Strain H1 = H2 at which the cases of the compression end; the target of
# prm/studies/base/compression.prm is -0.2.

BEGIN { target = -0.2 }

function row(    H, p)
{
  p = cell["panel_name"]
  if (!(p in n)) {
    panel[++n_panels] = p
    lowest[p] = 1
    highest[p] = -1
  }
  ++n[p]
  if (index(outcomes[p], cell["outcome"]) == 0)
    outcomes[p] = outcomes[p] (n[p] > 1 ? ", " : "") cell["outcome"]
  H = cell["stage"] == "load" ? target * cell["load_factor"] : 0
  if (H < lowest[p])
    lowest[p] = H
  if (H > highest[p])
    highest[p] = H
}

function finish(    i, p)
{
  print "| | cases | end | H1 = H2 at the end, first | last |"
  print "| --- | --- | --- | --- | --- |"
  for (i = 1; i <= n_panels; ++i) {
    p = panel[i]
    print "| " p " | " n[p] " | " outcomes[p] " | " fixed(highest[p], 4) \
      " | " fixed(lowest[p], 4) " |"
  }
}
