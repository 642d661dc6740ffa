#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Defines the race of CalculiX and npt_dealii on the isotropic woven cell.

    race.py --output DIR [--program npt_dealii] [--friction 0.3] [--store]

In one run, in turn, both programs compute the cell on several meshes and with
two lengths of load steps, each on one thread. Measured are user CPU seconds of
the whole process of either program (not of the scripts that write decks and
read results), medians of the repetitions, and the relative L2 error of n3(H3)
of the stage shear,

- to the common reference, the mean of the finest curves of both programs,
- to the own reference, the finest curve of the program itself.

A coarse mesh may be accurate by accident, where errors cancel. So what counts is
the bound of a run: the largest error of the runs of its program with as many
steps on this mesh and on finer ones. CPU seconds at equal bound are interpolated
in logarithms along the front of each program: its runs with a smaller bound than
every cheaper one. Nothing is extrapolated. The references are no part of the race; found complete in DIR they
are not computed again. Needs Python's standard library, gnuplot and ccx.
"""

import argparse
import dataclasses
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

import cross_checks
import woven_cell

HERE = pathlib.Path(__file__).resolve().parent

# Elements along and across, through, load steps of the stage shear (CalculiX:
# increments of both stages). The steps have a common multiple, see SPACING.
NPT_RUNS = [(n, through, steps) for steps in (10, 20)
            for n, through in ((2, 1), (3, 1), (4, 1), (5, 2), (7, 2), (9, 2))]
NPT_RUNS.append((13, 2, 20))
PEER_RUNS = [(n, 1, steps) for steps in (10, 20) for n in (2, 3, 4, 6)]
PEER_RUNS.append((6, 2, 20))
NPT_REFERENCE = (17, 4, 20)
PEER_REFERENCE = (8, 2, 40)

# Curves are compared where all of them have a row [-]: between rows they are
# not known, and to connect rows of 10 steps by lines costs 1 % with friction.
SPACING = 0.02

LEVELS = (0.05, 0.02, 0.01, 0.005, 0.002)

# A first run of more seconds is not repeated: its relative noise is small.
LONG_RUN = 20.0


@dataclasses.dataclass
class Entry:
    """One setting of one program: CPU seconds of its runs, and its curve."""
    program: str
    setting: tuple
    folder: pathlib.Path
    seconds: list = dataclasses.field(default_factory=list)
    curve: list = None
    unknowns: int = 0
    factorizations: int = 0

    def median(self):
        return statistics.median(self.seconds)


def front(points):
    """Of points (seconds, error) those more accurate than every cheaper one,
    by increasing seconds."""
    result = []
    for seconds, error in sorted(points):
        if not result or error < result[-1][1]:
            result.append((seconds, error))
    return result


def seconds_at(error, points):
    """CPU seconds at an error, linear in logarithms along the front of the
    points; None if the front does not reach from above to below the error."""
    line = front(points)
    for (t0, e0), (t1, e1) in zip(line, line[1:]):
        if e1 <= error <= e0:
            x = math.log(error / e0) / math.log(e1 / e0)
            return t0 * (t1 / t0)**x
    return None


def mean_curve(a, b):
    """Mean of two curves (H3, n1, n2, n3) where both have rows."""
    count = round(a[-1][0] / SPACING)
    return [(SPACING * k,
             *(0.5 * (cross_checks.value(a, SPACING * k, c) +
                      cross_checks.value(b, SPACING * k, c)) for c in (1, 2, 3)))
            for k in range(count + 1)]


def error(curve, reference):
    return cross_checks.difference(curve, reference, spacing=SPACING)


def user_seconds(command, folder, log):
    """Run a command on one thread: exit status and user CPU seconds of it."""
    with (folder / log).open("w") as out:
        process = subprocess.Popen(command, cwd=folder, stdout=out,
                                   stderr=subprocess.STDOUT,
                                   env=cross_checks.environment())
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime


def npt_settings(mu, n, through, steps):
    stage = "Load programme/Stage shear"
    return cross_checks.mesh(n, through) + [
        f"Friction/Friction coefficient={mu:g}",
        f"{stage}/Initial step={1 / steps:g}",
        f"{stage}/Maximum step={1 / steps:g}"]


def run_npt(options, entry):
    """Compute an entry by npt_dealii; False if it fails."""
    command = [options.program, str(HERE / "woven_cell.prm"), "--output", "."]
    for setting in npt_settings(options.friction, *entry.setting):
        command += ["--set", setting]
    status, seconds = user_seconds(command, entry.folder, "screen.txt")
    if status != 0:
        return False
    entry.seconds.append(seconds)
    entry.curve = cross_checks.shear(entry.folder / "curves.csv")
    text = (entry.folder / "log.txt").read_text()
    entry.unknowns = cross_checks.free_unknowns(entry.folder)
    entry.factorizations = int(re.search(r"Factorizations: (\d+)", text).group(1))
    return True


def run_peer(options, entry):
    """Compute an entry by CalculiX; False if it fails."""
    deck = woven_cell.parse(
        ["--output", str(entry.folder),
         *cross_checks.peer_options(options.friction, *entry.setting)])
    cell = woven_cell.Cell(deck)
    woven_cell.write_deck(cell, entry.folder / "cell.inp")
    status, seconds = user_seconds(woven_cell.COMMAND, entry.folder, "ccx.log")
    if not woven_cell.finish(cell, entry.folder, status, seconds):
        return False
    entry.seconds.append(seconds)
    entry.curve = cross_checks.shear(entry.folder / "curve.csv")
    entry.unknowns = int(re.search(r"number of equations\s+(\d+)",
                                   (entry.folder / "ccx.log").read_text())
                         .group(1))
    # Each iteration of CalculiX factorizes; rows of step, increment, attempt,
    # iterations, times follow two lines of titles.
    rows = (entry.folder / "cell.sta").read_text().splitlines()[2:]
    entry.factorizations = sum(int(row.split()[3]) for row in rows)
    return True


def run_all(options):
    """All entries in turn, several times; those that finished."""
    entries = []
    for program, settings in (("CalculiX", PEER_RUNS), ("npt_dealii", NPT_RUNS)):
        for n, through, steps in settings:
            name = f"{program}_mu{options.friction:g}_{n}x{n}x{through}_{steps}"
            entries.append(Entry(program, (n, through, steps),
                                 options.output / name))
    # Both programs in turn, so that a busy machine slows both.
    entries.sort(key=lambda entry: (entry.setting[2], entry.setting))
    for repeat in range(options.repeats):
        for entry in list(entries):
            if repeat > 0 and entry.seconds[0] > LONG_RUN:
                continue
            shutil.rmtree(entry.folder, ignore_errors=True)
            entry.folder.mkdir(parents=True)
            run = run_npt if entry.program == "npt_dealii" else run_peer
            if run(options, entry):
                print(f"{entry.folder.name}: {entry.seconds[-1]:.2f} s",
                      flush=True)
            else:
                print(f"{entry.folder.name} did not finish", file=sys.stderr)
                entries.remove(entry)
    return entries


def references(options):
    """Finest curve of each program, and where they come from."""
    mu = options.friction
    npt = options.output / "npt_dealii_mu{:g}_reference".format(mu)
    peer = options.output / "CalculiX_mu{:g}_reference".format(mu)
    if not cross_checks.run_npt(options.program, HERE / "woven_cell.prm", npt,
                                npt_settings(mu, *NPT_REFERENCE)) or \
            not cross_checks.run_ccx(peer, mu, *PEER_REFERENCE):
        sys.exit("race.py: there is no reference")
    made = re.search(r"CalculiX \S+, \S+",
                     (peer / "curve.csv").read_text()).group()
    return ({"npt_dealii": cross_checks.shear(npt / "curves.csv"),
             "CalculiX": cross_checks.shear(peer / "curve.csv")},
            f"npt_dealii {cross_checks.origins([npt])}; {made}")


def points_table(entries, own, common):
    """Rows of the table of runs, without bounds."""
    rows = []
    for entry in sorted(entries, key=lambda entry: (entry.program,
                                                    entry.median())):
        n, through, steps = entry.setting
        rows.append(dict(
            program=entry.program, mesh=f"{n}x{n}x{through}", steps=steps,
            unknowns=entry.unknowns, factorizations=entry.factorizations,
            cpu_seconds=entry.median(), runs=len(entry.seconds),
            n3=cross_checks.value(entry.curve, 0.2, 3),
            error_common=error(entry.curve, common),
            error_own=error(entry.curve, own[entry.program])))
    return rows


def add_bounds(rows):
    """Add bounds of the errors, and whether a run is on the front of its
    program for the common reference."""
    for reference in ("common", "own"):
        for row in rows:
            row[f"bound_{reference}"] = max(
                finer[f"error_{reference}"] for finer in rows
                if finer["program"] == row["program"] and
                finer["steps"] == row["steps"] and
                finer["unknowns"] >= row["unknowns"])
    for row in rows:
        line = front(points_of(rows, row["program"], "common"))
        row["front"] = int((row["cpu_seconds"], row["bound_common"]) in line)


def points_of(rows, program, reference):
    return [(row["cpu_seconds"], row[f"bound_{reference}"]) for row in rows
            if row["program"] == program]


def levels_table(rows):
    """CPU seconds of both programs at equal error and their ratio; levels that
    both reach."""
    result = []
    for reference in ("common", "own"):
        for level in LEVELS:
            seconds = [seconds_at(level, points_of(rows, program, reference))
                       for program in ("npt_dealii", "CalculiX")]
            if None not in seconds:
                result.append([reference, level, *seconds,
                               seconds[1] / seconds[0]])
    return result


def main():
    p = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    p.add_argument("--output", required=True, type=pathlib.Path)
    p.add_argument("--program", default="npt_dealii", help="npt_dealii to run")
    p.add_argument("--friction", type=float, default=0.3)
    p.add_argument("--repeats", type=int, default=3, help="of the short runs")
    p.add_argument("--store", action="store_true",
                   help="replace the stored results and pictures")
    options = p.parse_args()
    for program in ("ccx", options.program):
        if shutil.which(program) is None:
            p.error(f"there is no {program}")
    options.program = str(pathlib.Path(shutil.which(options.program)).resolve())
    options.output.mkdir(parents=True, exist_ok=True)
    options.output = options.output.resolve()

    own, origin = references(options)
    common = mean_curve(own["npt_dealii"], own["CalculiX"])
    gap = error(own["CalculiX"], own["npt_dealii"])
    rows = points_table(run_all(options), own, common)
    add_bounds(rows)
    name = f"mu{options.friction:g}"
    table = options.output / f"race_{name}.csv"
    levels = options.output / f"race_levels_{name}.csv"
    finest = ["{0} x {0} x {1} in {2} steps".format(*setting)
              for setting in (NPT_REFERENCE, PEER_REFERENCE)]
    comments = ["Isotropic woven cell, friction {:g}. Finest curves: npt_dealii "
                "{}, CalculiX {};".format(options.friction, *finest),
                f"their relative L2 difference is {gap:.3g}; common reference: "
                "their mean.",
                f"Origin: {origin}"]
    cross_checks.write_table(
        table, list(rows[0]), [row.values() for row in rows],
        ["n3 at H3 = 0.2 [N/mm]; relative L2 errors of n3(H3) [-] and the",
         "largest on this and finer meshes (bound); median of user CPU seconds",
         "of the whole process, one thread", *comments])
    cross_checks.write_table(
        levels, ["reference", "error", "npt_seconds", "peer_seconds", "ratio"],
        levels_table(rows),
        ["CPU seconds at equal bound of the error, log-log interpolated; ratio: CalculiX "
         "over npt_dealii", *comments])
    picture = options.output / f"race_{name}.svg"
    cross_checks.plot("race.gp", picture=picture, table=table)
    if options.store:
        for file in (table, levels):
            shutil.copy(file, HERE / "curves")
        shutil.copy(picture, cross_checks.IMAGES)


if __name__ == "__main__":
    main()
