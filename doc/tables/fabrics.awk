# Files: output-fabrics/*/curves.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# The fabrics of prm/fabrics: results of their runs.

function row(    f)
{
  f = folder
  if (!(f in known)) {
    known[f] = 1
    order[++n] = f
  }
  stage[f] = cell["stage"]
  factor[f] = cell["load_factor"]
  cuts[f] += cell["cuts"]
  cpu[f] = cell["cpu_seconds"]
  if (cell["load_factor"] == 1) {
    if (cell["stage"] == "release")
      woven[f] = digits(cell["n1"], 3) ", " digits(cell["n2"], 3)
    if (cell["stage"] == "relax")
      rest[f] = scientific(cell["n1"] > 0 ? cell["n1"] : -cell["n1"], 0)
    if (cell["stage"] == "stretch")
      H1_small[f] = cell["warp_stretch"]
    if (cell["stage"] == "tension")
      tension[f] = fixed(100 * (cell["warp_stretch"] - H1_small[f]), 2) " %"
    if (cell["stage"] == "slack")
      n4[f] = cell["n4"]
    if (cell["stage"] == "bend")
      bending[f] = digits((cell["n4"] - n4[f]) / cell["H4"], 2)
  }
  if (cell["stage"] == "shear") {
    # Torque at 10 and 30 degrees, between the steps around.
    for (a = 10; a <= 30; a += 20)
      if (angle[f] < a && cell["shear_angle"] >= a)
        torque[f, a] = digits(before[f] + (cell["shear_torque"] - before[f]) * \
          (a - angle[f]) / (cell["shear_angle"] - angle[f]), 2)
    angle[f] = cell["shear_angle"]
    before[f] = cell["shear_torque"]
  }
}

function finish(    k, f, name)
{
  print "| fabric | n1, n2 woven | n1 at rest | stretch by 10 times the tension | B [N mm] | m at 10 deg | m at 30 deg | ends at | cuts | CPU [s] |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  for (k = 1; k <= n; ++k) {
    f = order[k]
    name = f
    gsub(/_/, " ", name)
    print "| " name " | " woven[f] " | " rest[f] " | " tension[f] " | " \
      bending[f] " | " torque[f, 10] " | " torque[f, 30] " | " \
      (stage[f] == "shear" ? digits(angle[f], 3) " deg" : stage[f] " " digits(factor[f], 3)) \
      " | " cuts[f] " | " digits(cpu[f], 2) " |"
  }
}
