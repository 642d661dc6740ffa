#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Defines the cross-checks of the woven cell: runs, tables and pictures.

    cross_checks.py calculix --output DIR [--program npt_dealii] [--store]
        the isotropic cell by CalculiX and by npt_dealii, on several meshes
    cross_checks.py law --output DIR
        one element of CalculiX against the formula of the law
    cross_checks.py slip --output DIR
        the direction of friction in CalculiX after both bodies have turned
    cross_checks.py bases --output DIR [--program npt_dealii] [--friction 0.3]
        the default cell by NURBS, Bernstein and Lagrange functions

Runs found complete in DIR are not repeated, those of npt_dealii if they are of
the same commit, so a study that was interrupted goes on where it stopped; a run
that fails is reported and left out. Needs Python's standard library, gnuplot,
and for all but the last ccx. Without ccx the first takes the rows of CalculiX
from the stored table.
"""

import argparse
import csv
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
IMAGES = HERE.parents[1] / "doc" / "images"
STORED_STUDY = HERE / "curves" / "calculix_study.csv"

# friction coefficient, elements along and across, through, increments per stage
CALCULIX_RUNS = [(mu, n, 2, steps) for mu in (0, 0.3)
                 for n, steps in ((4, 20), (6, 20), (6, 40), (8, 20))]
# the last one is the reference of both programs
NPT_RUNS = [(mu, n, through, 20) for mu in (0, 0.3)
            for n, through in ((5, 2), (7, 2), (9, 2), (13, 2), (17, 4))]

BASES = {"NURBS": (5, 7, 9, 13), "Bernstein": (3, 5, 7, 9),
         "Lagrange": (3, 5, 7, 9)}
BASES_REFERENCE = ("NURBS", 19, 4)


def read_curve(path):
    """Rows of a curve as dictionaries; comments are skipped."""
    with path.open() as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return list(rows)


def shear(path):
    """(H3, n1, n2, n3) of the woven state and of the stage shear."""
    rows = read_curve(path)
    start = max(i for i, row in enumerate(rows) if row["stage"] != "shear")
    return [tuple(float(row[name]) for name in ("H3", "n1", "n2", "n3"))
            for row in rows[start:]]


def value(curve, H, component):
    """n_component at H, linear between rows."""
    for a, b in zip(curve, curve[1:]):
        if H <= b[0] * (1.0 + 1e-4):
            x = (H - a[0]) / (b[0] - a[0])
            return a[component] + x * (b[component] - a[component])
    raise ValueError(f"the curve ends before H3 = {H}")


def difference(curve, reference, component=3, spacing=0.01):
    """Relative L2 difference over H3 of two curves, trapezoidal rule on the
    multiples of the spacing, abscissae that both have (n3 = 0 at H3 = 0)."""
    last = reference[-1][0]
    points = [spacing * k for k in range(1, round(last / spacing) + 1)]
    error = norm = 0.0
    for H in points:
        w = 0.5 if H == points[-1] else 1.0
        error += w * (value(curve, H, component) -
                      value(reference, H, component))**2
        norm += w * value(reference, H, component)**2
    return math.sqrt(error / norm)


def environment():
    """One thread each: CPU seconds are comparable."""
    return dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")


def run_npt(program, parameters, folder, settings):
    """Run npt_dealii unless its curve is complete and of this commit; True if
    it is complete now."""
    curve = folder / "curves.csv"
    now = write_origin(folder.parent)
    if not (curve.exists() and complete(curve) and
            origins([folder]).split(", ")[-1] == now.split(", ")[-1]):
        folder.mkdir(parents=True, exist_ok=True)
        command = ["nice", str(program), str(parameters), "--output", str(folder)]
        for setting in settings:
            command += ["--set", setting]
        with (folder / "screen.txt").open("w") as log:
            subprocess.run(command, stdout=log, stderr=subprocess.STDOUT,
                           env=environment(), check=False)
        write_origin(folder)
    if curve.exists() and complete(curve):
        return True
    print(f"{folder.name} did not finish, see {folder}/screen.txt",
          file=sys.stderr)
    return False


def complete(curve):
    rows = read_curve(curve)
    return bool(rows) and rows[-1]["stage"] == "shear" and \
        float(rows[-1]["load_factor"]) > 1.0 - 1e-6


def write_origin(folder):
    """Note date and commit in a folder, and return them."""
    subprocess.run([str(HERE.parents[1] / "scripts" / "write_origin"),
                    str(folder)], check=True)
    return origins([folder])


def origins(folders):
    """Dates and commits of the runs in some folders."""
    texts = {(folder / "origin.txt").read_text().strip() for folder in folders
             if (folder / "origin.txt").exists()}
    return " and ".join(sorted(texts))


def stored_peer():
    """Rows of CalculiX in the stored table, and where they come from."""
    rows = [list(row.values()) for row in read_curve(STORED_STUDY)
            if row["program"] == "CalculiX"]
    origin = re.search(r"^# Origin: .*(CalculiX.*)", STORED_STUDY.read_text(),
                       re.MULTILINE)
    return rows, origin.group(1)


def free_unknowns(folder):
    return int(re.search(r"(\d+) free unknowns",
                         (folder / "log.txt").read_text()).group(1))


def mesh(n, through):
    return [f"Mesh/Elements along={n}", f"Mesh/Elements across={n}",
            f"Mesh/Elements through={through}"]


def write_table(path, columns, rows, comments):
    with path.open("w") as out:
        out.writelines(f"# {line}\n" for line in comments)
        out.write(",".join(columns) + "\n")
        for row in rows:
            out.write(",".join(f"{x:.6g}" if isinstance(x, float) else str(x)
                               for x in row) + "\n")
    print(path.read_text(), end="")


def plot(script, **names):
    """Run a gnuplot script with variables set."""
    settings = "; ".join(f"{key} = '{name}'" for key, name in names.items())
    subprocess.run(["gnuplot", "-e", settings, str(HERE / script)], check=True)


def run_ccx(folder, mu, n, through, steps):
    """Run CalculiX unless its curve is complete; True if it is complete now."""
    curve = folder / "curve.csv"
    if not (curve.exists() and complete(curve)):
        subprocess.run(["nice", sys.executable, str(HERE / "woven_cell.py"),
                        "--output", str(folder),
                        *peer_options(mu, n, through, steps)],
                       env=environment(), check=False)
        for big in folder.glob("*.frd"):
            big.unlink()
    if curve.exists() and complete(curve):
        return True
    print(f"{folder.name} did not finish", file=sys.stderr)
    return False


def peer_options(mu, n, through, steps):
    """Mesh, increments and friction for woven_cell.py."""
    return ["--along", str(n), "--across", str(n), "--through", str(through),
            "--weave-steps", str(steps), "--shear-steps", str(steps),
            "--friction", str(mu)]


def run_calculix(options, reference):
    """Run CalculiX on all meshes: rows of the table, the curve of the finest
    mesh of each friction, version and dates."""
    rows, stored, made = [], [], set()
    for mu, n, through, steps in CALCULIX_RUNS:
        folder = options.output / f"ccx_mu{mu}_{n}x{n}x{through}_{steps}"
        if not run_ccx(folder, mu, n, through, steps):
            continue
        curve = shear(folder / "curve.csv")
        text = (folder / "curve.csv").read_text()
        made.add(re.search(r"CalculiX \S+, \S+", text).group())
        seconds = float(re.search(r"(\d+) s\n", text).group(1))
        rows.append(["CalculiX", mu, f"{n}x{n}x{through}", steps,
                     *(value(curve, 0.2, c) for c in (1, 2, 3)),
                     *(difference(curve, reference[mu], c) for c in (1, 2, 3)),
                     seconds])
        stored = [entry for entry in stored if entry[0] != mu]
        stored.append((mu, folder / "curve.csv"))

    return rows, stored, " and ".join(sorted(made))


def calculix(options):
    rows, stored = [], []
    npt, reference = {}, {}
    for mu, n, through, steps in NPT_RUNS:
        folder = options.output / f"npt_mu{mu}_{n}x{n}x{through}_{steps}"
        settings = mesh(n, through) + [f"Friction/Friction coefficient={mu}"]
        if run_npt(options.program, HERE / "woven_cell.prm", folder, settings):
            npt[mu, n, through, steps] = folder
            reference[mu] = shear(folder / "curves.csv")
    for (mu, n, through, steps), folder in npt.items():
        curve = shear(folder / "curves.csv")
        seconds = float(read_curve(folder / "curves.csv")[-1]["cpu_seconds"])
        rows.append(["npt_dealii", mu, f"{n}x{n}x{through}", steps,
                     *(value(curve, 0.2, c) for c in (1, 2, 3)),
                     *(difference(curve, reference[mu], c) for c in (1, 2, 3)),
                     seconds])
    if shutil.which("ccx") is None:
        print("There is no ccx; the rows of CalculiX are the stored ones.",
              file=sys.stderr)
        peer_rows, peer_origin = stored_peer()
        rows += peer_rows
    else:
        peer_rows, stored, peer_origin = run_calculix(options, reference)
        rows += peer_rows

    columns = ["program", "friction", "mesh", "steps", "n1", "n2", "n3",
               "difference_n1", "difference_n2", "difference_n3", "seconds"]
    write_table(options.output / "calculix.csv", columns, rows,
                ["n at H3 = 0.2 [N/mm]; relative L2 differences to the finest",
                 "run of npt_dealii [-]; seconds: CPU of npt_dealii, wall of ccx",
                 f"Origin: npt_dealii {origins(npt.values())}; {peer_origin}"])
    if options.store:
        (HERE / "curves").mkdir(exist_ok=True)
        shutil.copy(options.output / "calculix.csv", STORED_STUDY)
        for mu, path in stored:
            shutil.copy(path, HERE / "curves" / f"calculix_mu{mu}.csv")
        finest = {mu: npt[key] / "curves.csv" for key in npt for mu in key[:1]}
        plot("calculix.gp", picture=IMAGES / "peer_calculix.svg",
             peer0=HERE / "curves" / "calculix_mu0.csv",
             peer3=HERE / "curves" / "calculix_mu0.3.csv",
             npt0=finest[0], npt3=finest[0.3])


def bases(options):
    mu = options.friction
    name, n, through = BASES_REFERENCE
    runs = [(name, n, through)]
    runs += [(basis, n, 2) for basis, meshes in BASES.items() for n in meshes]
    rows, folders, reference = [], [], None
    for basis, n, through in runs:
        folder = options.output / f"{basis}_mu{mu:g}_{n}x{n}x{through}"
        settings = mesh(n, through) + [f"Mesh/Basis={basis}",
                                       f"Friction/Friction coefficient={mu:g}"]
        if not run_npt(options.program, HERE / "bases.prm", folder, settings):
            rows.append([basis, f"{n}x{n}x{through}"] + ["nan"] * 5)
            continue
        folders.append(folder)
        curve = shear(folder / "curves.csv")
        if reference is None:
            reference = curve
        last = read_curve(folder / "curves.csv")[-1]
        iterations = sum(int(row["newton_iterations"])
                         for row in read_curve(folder / "curves.csv"))
        rows.append([basis, f"{n}x{n}x{through}", free_unknowns(folder),
                     value(curve, 0.2, 3), difference(curve, reference),
                     iterations, float(last["cpu_seconds"])])
    table = options.output / f"bases_mu{mu:g}.csv"
    write_table(table, ["basis", "mesh", "unknowns", "n3", "difference_n3",
                        "iterations", "cpu_seconds"], rows,
                [f"Default woven cell, KTS, friction {mu:g}; free unknowns; n3 at",
                 "H3 = 0.2 [N/mm]; relative L2 difference to the first run [-]",
                 f"Origin: {origins(folders)}"])
    if options.store:
        (HERE / "curves").mkdir(exist_ok=True)
        shutil.copy(table, HERE / "curves" / table.name)
        plot("bases.gp", picture=IMAGES / f"bases_mu{mu:g}.svg", table=table)


def law(options):
    """Cauchy stress of one homogeneously deformed element against (A14),
    sigma = (mu (b - 1) + lambda/2 (J^2 - 1)) / J."""
    young, nu = 100.0, 0.3
    mu, lame = young / 2.6, young * nu / (1.3 * 0.4)
    F = [[1.2, 0.3, 0.05], [0.0, 0.8, 0.1], [-0.1, 0.0, 1.1]]
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
               (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    deck = ["*NODE, NSET=ALL"]
    deck += [f"{i + 1}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(corners)]
    deck += ["*ELEMENT, TYPE=C3D8, ELSET=ONE", "1, 1, 2, 3, 4, 5, 6, 7, 8",
             "*MATERIAL, NAME=CIARLET_EL", "*USER MATERIAL, CONSTANTS=2",
             f"{young}, {nu}", "*SOLID SECTION, ELSET=ONE, MATERIAL=CIARLET_EL",
             "*STEP, NLGEOM", "*STATIC", "0.25, 1", "*BOUNDARY"]
    for i, X in enumerate(corners):
        for c in range(3):
            w = sum(F[c][J] * X[J] for J in range(3)) - X[c]
            deck.append(f"{i + 1}, {c + 1}, {c + 1}, {w:.12g}")
    deck += ["*EL PRINT, ELSET=ONE", "S", "*END STEP"]
    (options.output / "law.inp").write_text("\n".join(deck) + "\n")
    with (options.output / "law.log").open("w") as log:
        subprocess.run(["ccx", "-i", "law"], cwd=options.output, stdout=log,
                       stderr=subprocess.STDOUT, check=False)

    J = (F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
         F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
         F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]))
    expected = []
    for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)):
        b = sum(F[i][K] * F[j][K] for K in range(3))
        one = 1.0 if i == j else 0.0
        expected.append((mu * (b - one) + 0.5 * lame * (J * J - 1.0) * one) / J)
    lines = (options.output / "law.dat").read_text().splitlines()
    found = [float(word) for word in lines[-1].split()[2:]]
    error = max(abs(a - b) for a, b in zip(found, expected))
    print("found   ", *(f"{x:12.6f}" for x in found))
    print("expected", *(f"{x:12.6f}" for x in expected))
    print(f"largest difference {error / max(map(abs, expected)):.1e} of the "
          "largest component (7 digits are printed)")


def slip(options):
    """Two blocks, all nodes prescribed: press them together, turn both by 90
    degrees about the normal, then slide the upper one along e1. Friction must
    oppose e1; the force that CalculiX has on the upper block is printed."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    overlap, distance, mu = 0.01, 0.2, 0.3
    deck = ["*NODE, NSET=ALL"]
    nodes = []
    for size, low, high in ((2.0, -1.0, 0.0), (0.5, 0.0, 1.0)):
        nodes += [(size * x, size * y, z) for z in (low, high) for x, y in corners]
    deck += [f"{i + 1}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(nodes)]
    deck += ["*NSET, NSET=UPPER", "9, 10, 11, 12, 13, 14, 15, 16",
             "*ELEMENT, TYPE=C3D8, ELSET=BLOCKS", "1, 1, 2, 3, 4, 5, 6, 7, 8",
             "2, 9, 10, 11, 12, 13, 14, 15, 16",
             "*SURFACE, NAME=PRIMARY", "1, S2", "*SURFACE, NAME=SECONDARY",
             "2, S1", "*MATERIAL, NAME=CIARLET_EL",
             "*USER MATERIAL, CONSTANTS=2", "1e-3, 0.3",
             "*SOLID SECTION, ELSET=BLOCKS, MATERIAL=CIARLET_EL",
             "*SURFACE INTERACTION, NAME=CONTACT",
             "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", "100",
             "*FRICTION", f"{mu}, 1000",
             "*CONTACT PAIR, INTERACTION=CONTACT, TYPE=SURFACE TO SURFACE",
             "SECONDARY, PRIMARY"]

    def step(steps, position):
        deck.extend(["*STEP, NLGEOM, INC=1000", "*STATIC",
                     f"{1 / steps}, 1, {1e-3 / steps}, {1 / steps}", "*BOUNDARY"])
        for i, X in enumerate(nodes):
            for c, x in enumerate(position(X, i >= 8)):
                deck.append(f"{i + 1}, {c + 1}, {c + 1}, {x - X[c]:.12g}")
        deck.extend(["*NODE PRINT, NSET=UPPER, TOTALS=ONLY", "RF", "*END STEP"])

    def press(X, upper):
        return X[0], X[1], X[2] - (overlap if upper else 0.0)

    def turn(angle):
        def position(X, upper):
            x, y, z = press(X, upper)
            return (math.cos(angle) * x - math.sin(angle) * y,
                    math.sin(angle) * x + math.cos(angle) * y, z)
        return position

    def slide(X, upper):
        x, y, z = turn(0.5 * math.pi)(X, upper)
        return x + (distance if upper else 0.0), y, z

    step(1, lambda X, upper: X)
    step(1, press)
    for k in range(1, 10):  # chords of ten degrees: the blocks keep their size
        step(1, turn(math.radians(10 * k)))
    step(20, slide)
    (options.output / "slip.inp").write_text("\n".join(deck) + "\n")
    with (options.output / "slip.log").open("w") as log:
        subprocess.run(["ccx", "-i", "slip"], cwd=options.output, stdout=log,
                       stderr=subprocess.STDOUT, check=False)
    lines = (options.output / "slip.dat").read_text().splitlines()
    force = [float(word) for word in lines[-1].split()[-3:]]
    limit = mu * abs(force[2])
    print("reaction that moves the upper block along e1, over mu times the normal "
          f"force: {force[0] / limit:.3f}, {force[1] / limit:.3f}; by Coulomb's "
          "law 1, 0")


def main():
    p = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    p.add_argument("study", choices=("calculix", "law", "slip", "bases"))
    p.add_argument("--output", required=True, type=pathlib.Path)
    p.add_argument("--program", default="npt_dealii", help="npt_dealii to run")
    p.add_argument("--friction", type=float, default=0.0, help="bases only")
    p.add_argument("--store", action="store_true",
                   help="replace the stored curves and pictures of the repository")
    options = p.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    options.output = options.output.resolve()
    {"calculix": calculix, "law": law, "slip": slip,
     "bases": bases}[options.study](options)


if __name__ == "__main__":
    main()
