# Files: output-fabrics/*/curves.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# The fabrics of prm/fabrics: shear, tension and bending.

# Folders are "FABRIC TEST", in the order of names: bend, shear, tension.
function row(    f, load, a)
{
  f = load = folder
  sub(/ .*/, "", f)
  sub(/.* /, "", load)
  if (!(f in known)) {
    known[f] = 1
    order[++n] = f
  }
  last[f, load] = cell["stage"] == load && cell["load_factor"] == 1
  cuts[f, load] += cell["cuts"]
  cpu[f, load] = cell["cpu_seconds"]
  if (cell["stage"] == "release" && cell["load_factor"] == 1)
    woven[f] = digits(cell["n1"], 3) ", " digits(cell["n2"], 3)
  if (cell["stage"] == "relax" && cell["load_factor"] == 1)
    rest[f] = sprintf("%.0e", cell["n1"] < 0 ? -cell["n1"] : cell["n1"])
  if (cell["stage"] == "stretch") {
    stretch[f, load] = cell["warp_stretch"]
    moment[f, load] = cell["n4"]
    if (load == "shear") {
      angle[f] = cell["shear_angle"]
      torque[f] = cell["shear_torque"]
    }
  }
  if (cell["stage"] == "tension" && cell["load_factor"] == 1)
    tension[f] = fixed(100 * (cell["warp_stretch"] - stretch[f, load]), 3)
  # A woven cell may have a moment at rest: what bending adds to it.
  if (cell["stage"] == "bend" && cell["load_factor"] == 1)
    bending[f] = digits((cell["n4"] - moment[f, load]) / cell["H4"], 2)
  if (cell["stage"] == "shear") {
    for (a = 5; a <= 20; a += a == 5 ? 5 : 10)
      if (angle[f] < a && cell["shear_angle"] >= a)
        at[f, a] = digits(torque[f] + (cell["shear_torque"] - torque[f]) * \
          (a - angle[f]) / (cell["shear_angle"] - angle[f]), 2)
    angle[f] = cell["shear_angle"]
    torque[f] = cell["shear_torque"]
  }
}

function end(f, load, text)
{
  return last[f, load] ? text : "not reached"
}

function finish(    k, f, name)
{
  print "| fabric | n1, n2 woven | n1 at rest | m at 5 deg | 10 deg | 20 deg | at the end | stretch | B | cuts | CPU [s] |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  for (k = 1; k <= n; ++k) {
    f = order[k]
    name = f
    gsub(/_/, " ", name)
    print "| " name " | " woven[f] " | " rest[f] " | " at[f, 5] " | " \
      at[f, 10] " | " at[f, 20] " | " digits(torque[f], 2) " at " \
      digits(angle[f], 3) (last[f, "shear"] ? "" : ", ends early") " | " \
      end(f, "tension", tension[f] " %") " | " end(f, "bend", bending[f]) \
      " | " cuts[f, "shear"] ", " cuts[f, "tension"] ", " cuts[f, "bend"] \
      " | " digits(cpu[f, "shear"], 2) ", " digits(cpu[f, "tension"], 2) \
      ", " digits(cpu[f, "bend"], 2) " |"
  }
}
