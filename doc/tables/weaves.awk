# Files: output-weaves/*/curves.csv
# SPDX-License-Identifier: LGPL-2.1-or-later
# Ten weaves: tension when woven, extension without it, shear and bending.

# Rows are those of the folders "shear WEAVE MESH"; "bend WEAVE MESH" come first
# in the order of names.
function row(    load, key)
{
  load = folder
  sub(/ .*/, "", load)
  key = folder
  sub(/^[a-z]* /, "", key)
  if (!(key in known)) {
    known[key] = 1
    order[++n_keys] = key
  }
  done[load, key] = cell["stage"] == "load" && cell["load_factor"] == 1
  reached[load, key] = cell["stage"] " " digits(cell["load_factor"], 2)
  cuts[load, key] += cell["cuts"]
  cpu[load, key] = cell["cpu_seconds"]
  if (load == "shear" && cell["stage"] == "release")
    woven[key] = fixed(cell["n1"], 3) " | " fixed(cell["n2"], 3)
  if (load == "shear" && cell["stage"] == "relax")
    relaxed[key] = fixed(cell["H1"], 4) " | " fixed(cell["H2"], 4)
  # A satin has moments in the woven state: what bending adds to them.
  if (cell["stage"] == "relax")
    before[load, key] = load == "shear" ? 0 : cell["n4"]
  if (cell["stage"] == "load")
    end[load, key] = cell[load == "shear" ? "n3" : "n4"] - before[load, key]
}

function seconds(t)
{
  return t >= 100 ? fixed(t, 0) : digits(t, 2)
}

function ending(load, key, n)
{
  if (!((load, key) in done))
    return "not run"
  return done[load, key] ? fixed(end[load, key], n) : "ends in " reached[load, key]
}

function finish(    k, key, name)
{
  print "| weave | mesh | n1, n2 woven | | H1, H2 relaxed | | n3 at H3 = 0.1 | n4 of H4 = 0.005 /mm | cuts | CPU [s] |"
  print "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  for (k = 1; k <= n_keys; ++k) {
    key = order[k]
    name = key
    sub(/ [^ ]*$/, "", name)
    if (name ~ /^[0-9]-[0-9]/)
      sub(/-/, "/", name)
    print "| " name " | " substr(key, length(name) + 2) " | " \
      (key in woven ? woven[key] : " | ") " | " \
      (key in relaxed ? relaxed[key] : " | ") " | " \
      ending("shear", key, 4) " | " ending("bend", key, 3) " | " \
      cuts["shear", key] ", " cuts["bend", key] " | " \
      seconds(cpu["shear", key]) ", " seconds(cpu["bend", key]) " |"
  }
}
