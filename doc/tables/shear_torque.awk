# SPDX-License-Identifier: LGPL-2.1-or-later
# One line per run for doc/fabrics.md: shear torque [N/mm] at 10, 20, 30 and 40
# degrees in the stage "shear", interpolated linearly between the steps.
#   awk -f doc/tables/csv.awk -f doc/tables/shear_torque.awk RUN/curves.csv ...

function row(    degrees, angle, torque)
{
  angle = cell["shear_angle"] + 0
  torque = cell["shear_torque"] + 0
  if (first_row && line != "")
    print line " |"
  if (first_row)
    line = "| " folder
  if (cell["stage"] == "shear" && !first_row)
    for (degrees = 10; degrees <= 40; degrees += 10)
      if (angle_before < degrees && angle >= degrees)
        line = line " | " fixed(torque_before + (torque - torque_before) * \
          (degrees - angle_before) / (angle - angle_before), 4)
  angle_before = angle
  torque_before = torque
}

function finish() { print line " |" }
