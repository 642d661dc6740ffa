#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Defines the woven sub-unit cell as a deck of CalculiX, its run and its curve.

The cell is the isotropic one of doc/cross_checks.md: two straight lens
bundles that just touch, coupled to themselves by the glide planes (47)-(48)
and by the 2-fold axis through the crossing. Stages as in npt_dealii: weave
(the offset of the glide coupling), then in-plane shear H3 at H1 = H2 = 0.
Every coupling becomes one line of *EQUATION in the unknowns H1, H2, H3 and
lambda, which are the displacements of two reference nodes.

    woven_cell.py --output DIR [options]    write the deck, run ccx, write curve.csv

Only Python's standard library and the program ccx are needed.
"""

import argparse
import datetime
import pathlib
import re
import subprocess
import sys
import time


# Of the springs between prescribed and actual H [N]: the cell has some 100 N
# per unit of H, so H deviates by 1e-5 of itself; the curve has the actual H.
DRIVE_STIFFNESS = 1e7

# What computes the deck cell.inp, in its folder.
COMMAND = ["ccx", "-i", "cell"]


class Orbits:
    """Unknowns tied by x_i = s x_j + affine, s = +1 or -1, reduced to one
    representative per orbit, or to an affine value where an orbit closes with
    s = -1. Affine parts are dictionaries {macro unknown: coefficient}."""

    def __init__(self):
        self.parent = {}  # unknown -> (next, sign, affine)
        self.value = {}  # representative -> affine, if the orbit is fixed

    def find(self, x):
        """Representative r of x with x = s r + affine."""
        sign, affine = 1, {}
        while x in self.parent:
            x, s, part = self.parent[x]
            for name, a in part.items():
                affine[name] = affine.get(name, 0.0) + sign * a
            sign *= s
        return x, sign, affine

    def tie(self, x, sign, y, affine):
        """Require x = sign y + affine."""
        rx, sx, ax = self.find(x)
        ry, sy, ay = self.find(y)
        # sx rx + ax = sign (sy ry + ay) + affine
        names = set(ax) | set(ay) | set(affine)
        right = {n: affine.get(n, 0.0) + sign * ay.get(n, 0.0) - ax.get(n, 0.0)
                 for n in names}
        right = {n: a for n, a in right.items() if abs(a) > 1e-12}
        if rx != ry:
            if rx in self.value:
                raise RuntimeError("an orbit was fixed before it was complete")
            self.parent[rx] = (ry, sx * sign * sy,
                               {n: sx * a for n, a in right.items()})
        elif sx == sign * sy:
            if right:
                raise RuntimeError(f"contradictory couplings of {x}: {right}")
        else:  # 2 sx rx = right
            value = {n: 0.5 * sx * a for n, a in right.items()}
            old = self.value.setdefault(rx, value)
            if any(abs(old.get(n, 0.0) - value.get(n, 0.0)) > 1e-12
                   for n in set(old) | set(value)):
                raise RuntimeError(f"contradictory values of {x}")


class Cell:
    """Mesh and couplings. Unknowns are (node, component), component 1..3."""

    def __init__(self, options):
        self.o = options
        self.step = 2 if options.element.startswith("C3D20") else 1
        self.nodes = {}  # number -> coordinates
        self.grid = []  # per bundle {(i, j, k): number}
        self.elements = []  # per bundle [((i, j, k), nodes)]
        for bundle in range(2):
            self.make_bundle(bundle)
        self.orbits = Orbits()
        self.couple()

    def make_bundle(self, bundle):
        """Bundle 0 is the warp (along Y1, above), 1 the weft (along Y2)."""
        o, s = self.o, self.step
        na, nb, nc = o.along, o.across, o.through
        t, e = o.thickness, o.blunt_tip * o.thickness
        middle = 0.5 * t if bundle == 0 else -0.5 * t
        grid = {}
        for i in range(s * na + 1):
            for j in range(s * nb + 1):
                for k in range(s * nc + 1):
                    if s == 2 and i % 2 + j % 2 + k % 2 > 1:
                        continue  # serendipity: corners and edges only
                    a = o.spacing * (i / (s * na) - 0.5)
                    eta = 2.0 * j / (s * nb) - 1.0
                    b = 0.5 * o.width * eta
                    # Half thickness of the lens, (A13) of doc/theory.md.
                    h = e + (0.5 * t - e) * (1.0 - eta * eta)
                    c = h * (2.0 * k / (s * nc) - 1.0)
                    number = len(self.nodes) + 1
                    grid[i, j, k] = number
                    self.nodes[number] = ((a, b, middle + c) if bundle == 0 else
                                          (-b, a, middle + c))
        self.grid.append(grid)

        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                   (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
        edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4),
                 (0, 4), (1, 5), (2, 6), (3, 7)]
        elements = []
        for i in range(na):
            for j in range(nb):
                for k in range(nc):
                    p = [(s * (i + x), s * (j + y), s * (k + z))
                         for x, y, z in corners]
                    if s == 2:
                        p += [tuple((p[m][c] + p[n][c]) // 2 for c in range(3))
                              for m, n in edges]
                    elements.append(((i, j, k), [grid[q] for q in p]))
        self.elements.append(elements)

    def couple(self):
        """Glide planes with jumps (46) and weaving offset, then the axis."""
        o, s = self.o, self.step
        na, nb, nc = s * o.along, s * o.across, s * o.through
        for bundle in range(2):
            grid = self.grid[bundle]
            direction = 1 + bundle  # along Y1 or Y2
            jump = {direction: {f"H{direction}": o.spacing},
                    3 - direction: {"H3": 0.5 * o.spacing}}
            lift = {"lambda": -o.thickness if bundle == 0 else o.thickness}
            for (i, j, k), node in grid.items():
                if i == na:
                    partner = grid[0, j, nc - k]
                    for c in (1, 2):
                        self.orbits.tie((node, c), 1, (partner, c), jump[c])
                    self.orbits.tie((node, 3), -1, (partner, 3), lift)
            for (i, j, k), node in grid.items():
                partner = grid[na - i, nb - j, k]
                if node >= partner:
                    for c, sign in ((1, -1), (2, -1), (3, 1)):
                        self.orbits.tie((node, c), sign, (partner, c), {})

    def equations(self):
        """Lines of *EQUATION and fixed unknowns of *BOUNDARY."""
        n = len(self.nodes)
        macro = {"H1": (n + 1, 1), "H2": (n + 1, 2), "H3": (n + 1, 3),
                 "lambda": (n + 2, 1)}
        lines, fixed = [], []
        for node in self.nodes:
            for c in (1, 2, 3):
                r, sign, affine = self.orbits.find((node, c))
                terms = [(node, c, 1.0)]
                if r in self.orbits.value:
                    for name, a in self.orbits.value[r].items():
                        affine[name] = affine.get(name, 0.0) + sign * a
                elif r != (node, c):
                    terms.append((r[0], r[1], -float(sign)))
                else:
                    continue  # the representative itself
                terms += [(*macro[name], -a) for name, a in affine.items()
                          if abs(a) > 1e-12]
                if len(terms) == 1:
                    fixed.append((node, c))
                else:
                    lines.append(terms)
        return lines, fixed


def write_deck(cell, path):
    """The input file of CalculiX."""
    o = cell.o
    n = len(cell.nodes)
    out = []
    put = out.append
    put("** Isotropic woven sub-unit cell; written by tests/peers/woven_cell.py")
    put("*NODE, NSET=ALL")
    for number, (x, y, z) in cell.nodes.items():
        put(f"{number}, {x:.12g}, {y:.12g}, {z:.12g}")
    # H1, H2, H3 are the displacements of node MACRO, lambda of OFFSET. CalculiX
    # reports no reactions of nodes that only equations refer to, so MACRO
    # is driven from node DRIVE by stiff springs.
    for i, name in ((1, "MACRO"), (2, "OFFSET"), (3, "DRIVE")):
        put(f"*NODE, NSET={name}")
        put(f"{n + i}, 0, 0, 0")

    number, top, bottom = 0, [], []
    for bundle in range(2):
        put(f"*ELEMENT, TYPE={o.element}, ELSET=BUNDLES")
        for (i, j, k), nodes in cell.elements[bundle]:
            number += 1
            if bundle == 0 and k == 0:
                bottom.append(number)
            if bundle == 1 and k == o.through - 1:
                top.append(number)
            line = [str(number)] + [str(q) for q in nodes]
            for start in range(0, len(line), 11):
                last = start + 11 >= len(line)
                put(", ".join(line[start:start + 11]) + ("" if last else ","))
    put("*SURFACE, NAME=PRIMARY")
    out.extend(f"{e}, S1" for e in bottom)
    put("*SURFACE, NAME=SECONDARY")
    out.extend(f"{e}, S2" for e in top)

    for c in (1, 2, 3):
        put(f"*ELEMENT, TYPE=SPRING2, ELSET=DRIVE{c}")
        put(f"{number + c}, {n + 1}, {n + 3}")
        put(f"*SPRING, ELSET=DRIVE{c}")
        put(f"{c}, {c}")
        put(f"{DRIVE_STIFFNESS}")

    # The neo-Hookean law of Ciarlet: S = lambda/2 (J^2 - 1) C^-1
    # + mu (1 - C^-1), one of the user materials that come with CalculiX.
    put("*MATERIAL, NAME=CIARLET_EL")
    put("*USER MATERIAL, CONSTANTS=2")
    put(f"{o.young}, {o.poisson}")
    put("*SOLID SECTION, ELSET=BUNDLES, MATERIAL=CIARLET_EL")

    put("*SURFACE INTERACTION, NAME=CONTACT")
    put("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR")
    put(f"{o.penalty}")
    if o.friction > 0:
        # No friction while weaving: a coefficient that is not quite zero, so
        # that slip is tracked and leaves no elastic part.
        put("*FRICTION")
        put(f"1e-8, {o.tangential_penalty}")
    kind = "SURFACE TO SURFACE" if o.contact == "face" else "NODE TO SURFACE"
    put(f"*CONTACT PAIR, INTERACTION=CONTACT, TYPE={kind}")
    put("SECONDARY, PRIMARY")

    lines, fixed = cell.equations()
    for terms in lines:
        put("*EQUATION")
        put(str(len(terms)))
        for start in range(0, len(terms), 4):
            put(", ".join(f"{node}, {c}, {a:.12g}"
                          for node, c, a in terms[start:start + 4]))
    put("*BOUNDARY")
    out.extend(f"{node}, {c}, {c}, 0" for node, c in fixed)
    put(f"{n + 2}, 2, 3, 0")

    def step(name, increment, values, change_friction=False):
        put(f"** {name}")
        put("*STEP, NLGEOM, INC=10000")
        put("*STATIC")
        put(f"{increment:.12g}, 1, {increment * 1e-4:.3g}, {increment:.12g}")
        # Tighter than the default of half a percent of the mean force.
        put("*CONTROLS, PARAMETERS=FIELD")
        put("1e-4, 1e-3")
        if change_friction:
            put("*CHANGE FRICTION, INTERACTION=CONTACT")
            put("*FRICTION")
            put(f"{o.friction}, {o.tangential_penalty}")
        put("*BOUNDARY")
        for node, c, value in values:
            put(f"{node}, {c}, {c}, {value:.12g}")
        for name in ("MACRO", "DRIVE"):
            put(f"*NODE PRINT, NSET={name}, FREQUENCY=1")
            put("U" if name == "MACRO" else "RF")
        put("*END STEP")

    hold = [(n + 3, 1, 0), (n + 3, 2, 0), (n + 3, 3, 0)]
    # CalculiX ramps penetrations found in the first step as if they were
    # initial overlaps, so that step only brings the bundles into touch.
    step("touch", 1, hold + [(n + 2, 1, 1e-4 * o.depth)])
    step("weave", 1 / o.weave_steps, hold + [(n + 2, 1, o.depth)])
    step("shear", 1 / o.shear_steps,
         [(n + 3, 1, 0), (n + 3, 2, 0), (n + 3, 3, o.shear),
          (n + 2, 1, o.depth)], o.friction > 0)
    path.write_text("\n".join(out) + "\n")


def read_results(path, n_nodes):
    """Rows (time, H, reactions of H) of a .dat file."""
    rows = {}
    quantity, when = None, None
    for line in path.read_text().splitlines():
        match = re.match(r"\s*(displacements|forces) .* and time\s+(\S+)", line)
        if match:
            quantity, when = match.group(1), float(match.group(2))
            continue
        words = line.split()
        if quantity and len(words) == 4:
            rows.setdefault(when, {})[quantity, int(words[0])] = [
                float(w) for w in words[1:]]
    result = []
    for when in sorted(rows):
        row = rows[when]
        result.append((when, row["displacements", n_nodes + 1],
                       row["forces", n_nodes + 3]))
    return result


def write_curve(cell, rows, version, seconds, path):
    o = cell.o
    area = o.spacing * o.spacing
    with path.open("w") as out:
        out.write(f"# Isotropic woven cell, CalculiX {version}, "
                  f"{datetime.date.today().isoformat()}\n")
        out.write(f"# mesh {o.along} x {o.across} x {o.through} {o.element} per "
                  f"bundle, {len(cell.nodes)} nodes, contact {o.contact} to "
                  f"face, {o.weave_steps} and {o.shear_steps} increments, "
                  f"{seconds:.0f} s\n")
        out.write(f"# depth {o.depth}, E {o.young} MPa, nu {o.poisson}, "
                  f"friction {o.friction}, penalties {o.penalty} and "
                  f"{o.tangential_penalty} N/mm^3\n")
        out.write("# stage, load_factor [-], H3 [-], n1, n2, n3 [N/mm]\n")
        out.write("stage,load_factor,H3,n1,n2,n3\n")
        for when, H, force in rows:
            if when <= 1.0 + 1e-9:
                continue
            stage = "weave" if when <= 2.0 + 1e-9 else "shear"
            factor = when - (1.0 if stage == "weave" else 2.0)
            n = [f / area for f in force]
            out.write(f"{stage},{factor:.6g},{H[2]:.6g},{n[0]:.7g},{n[1]:.7g},"
                      f"{n[2]:.7g}\n")


def parse(arguments):
    p = argparse.ArgumentParser(
        description="The woven cell in CalculiX: deck, run, curve.",
        formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    p.add_argument("--output", required=True, type=pathlib.Path)
    p.add_argument("--along", type=int, default=8)
    p.add_argument("--across", type=int, default=8)
    p.add_argument("--through", type=int, default=2)
    p.add_argument("--element", default="C3D20R")
    p.add_argument("--contact", choices=("face", "node"), default="face")
    p.add_argument("--depth", type=float, default=1.0, help="weaving depth [-]")
    p.add_argument("--shear", type=float, default=0.2, help="H3 at the end [-]")
    p.add_argument("--friction", type=float, default=0.0)
    p.add_argument("--penalty", type=float, default=100.0, help="[N/mm^3]")
    p.add_argument("--tangential-penalty", type=float, default=100.0)
    p.add_argument("--young", type=float, default=100.0, help="[MPa]")
    p.add_argument("--poisson", type=float, default=0.3)
    p.add_argument("--weave-steps", type=int, default=20)
    p.add_argument("--shear-steps", type=int, default=20)
    p.add_argument("--spacing", type=float, default=5.0, help="[mm]")
    p.add_argument("--width", type=float, default=4.0, help="[mm]")
    p.add_argument("--thickness", type=float, default=1.2, help="[mm]")
    p.add_argument("--blunt-tip", type=float, default=0.1, help="e/t [-]")
    p.add_argument("--deck-only", action="store_true")
    return p.parse_args(arguments)


def finish(cell, folder, status, seconds):
    """The curve of a run of ccx that has ended; True if it came to the end."""
    text = (folder / "ccx.log").read_text()
    version = re.search(r"CalculiX Version (\S+?),", text)
    rows = read_results(folder / "cell.dat", len(cell.nodes))
    write_curve(cell, rows, version.group(1) if version else "unknown", seconds,
                folder / "curve.csv")
    reached = rows[-1][0] if rows else 0.0
    if status != 0 or "*ERROR" in text or abs(reached - 3.0) > 1e-6:
        print(f"CalculiX stopped at time {reached} of 3; see {folder}/ccx.log",
              file=sys.stderr)
        return False
    return True


def main(arguments):
    options = parse(arguments)
    options.output.mkdir(parents=True, exist_ok=True)
    cell = Cell(options)
    write_deck(cell, options.output / "cell.inp")
    if options.deck_only:
        return 0
    start = time.time()
    with (options.output / "ccx.log").open("w") as log:
        status = subprocess.run(COMMAND, cwd=options.output, stdout=log,
                                stderr=subprocess.STDOUT).returncode
    seconds = time.time() - start
    return 0 if finish(cell, options.output, status, seconds) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
