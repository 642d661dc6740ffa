# Files: output-fabrics/*/curves.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# The fabrics of prm/fabrics: tension, bending and shear from one stretched state.

function row(    f, stage, a)
{
  f = folder
  stage = cell["stage"]
  if (!(f in known)) {
    known[f] = 1
    order[++n] = f
  }
  last[f, stage] = cell["load_factor"] == 1
  cuts[f, stage] += cell["cuts"]
  cpu[f] = cell["cpu_seconds"]
  if (stage == "release" && last[f, stage])
    woven[f] = digits(cell["n1"], 3) ", " digits(cell["n2"], 3)
  if (stage == "relax" && last[f, stage])
    rest[f] = sprintf("%.0e", cell["n1"] < 0 ? -cell["n1"] : cell["n1"])
  if (stage == "stretch") {
    stretch[f] = cell["warp_stretch"]
    moment[f] = cell["n4"]
    angle[f] = cell["shear_angle"]
    torque[f] = cell["shear_torque"]
  }
  if (stage == "tension")
    tension[f] = fixed(100 * (cell["warp_stretch"] - stretch[f]), 3)
  # A woven cell may have a moment at rest: what bending adds to it.
  if (stage == "bend")
    bending[f] = digits((cell["n4"] - moment[f]) / cell["H4"], 2)
  if (stage == "shear") {
    for (a = 5; a <= 20; a += a == 5 ? 5 : 10)
      if (angle[f] < a && cell["shear_angle"] >= a)
        at[f, a] = digits(torque[f] + (cell["shear_torque"] - torque[f]) * \
          (a - angle[f]) / (cell["shear_angle"] - angle[f]), 2)
    angle[f] = cell["shear_angle"]
    torque[f] = cell["shear_torque"]
  }
}

function end(f, stage, text)
{
  return last[f, stage] ? text : "not reached"
}

function finish(    k, f, name)
{
  print "| fabric | n1, n2 woven | n1 at rest | stretch | B | m at 5 deg | 10 deg | 20 deg | at the end | cuts | CPU [s] |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  for (k = 1; k <= n; ++k) {
    f = order[k]
    name = f
    gsub(/_/, " ", name)
    print "| " name " | " woven[f] " | " rest[f] " | " \
      end(f, "tension", tension[f] " %") " | " end(f, "bend", bending[f]) \
      " | " at[f, 5] " | " at[f, 10] " | " at[f, 20] " | " \
      digits(torque[f], 2) " at " digits(angle[f], 3) \
      (last[f, "shear"] ? "" : ", ends early") " | " \
      cuts[f, "tension"] + 0 ", " cuts[f, "bend"] + 0 ", " \
      cuts[f, "shear"] + 0 " | " digits(cpu[f], 2) " |"
  }
}
