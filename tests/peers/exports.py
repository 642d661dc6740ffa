#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Defines the cross-check of exported cells with the programs that read them.

    exports.py --output DIR [--program npt_dealii] [--file exports.prm]

Weaves, releases and relaxes a fabric and exports it (exports.prm). Then CalculiX pulls every
bundle by 0.1 % of its length, gmsh measures the volume of the mesh, meshio (if
Python has it) reads fields and groups, and npt_dealii reads its own TexGen file.
Prints one line per question; the exit status is 1 if an answer is wrong. What is
not installed is left out with a word. Needs Python's standard library.
"""

import argparse
import math
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
STRAIN = 1e-3


def run(command, folder):
    """The output of a command, which must succeed."""
    result = subprocess.run(command, cwd=folder, text=True, check=False,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{result.stdout}")
    return result.stdout


def export(program, file, folder):
    """Run the file; the volumes that the log tells."""
    run([program, file, "--output", folder], HERE)
    log = (folder / "log.txt").read_text(encoding="utf-8")
    return {name: float(volume) for name, volume in re.findall(
        r"Exported (cell_\w+\.\w+): \d+ hexahedra in \d+ bundles, (\S+) mm",
        log)}


def bundles_of(deck):
    """Names of the bundles, and length and axis of each."""
    text = deck.read_text(encoding="ascii")
    nodes = {}
    for line in text[text.index("*NODE"):text.index("*ELEMENT")].splitlines()[1:]:
        number, *x = line.split(",")
        nodes[int(number)] = [float(c) for c in x]
    result = {}
    for name in re.findall(r"\*ELEMENT, TYPE=\w+, ELSET=(\w+)", text):
        ends = []
        for end in ("BEGIN", "END"):
            block = text.split(f"*NSET, NSET={name}_{end}\n")[1].split("*")[0]
            numbers = [int(n) for n in re.findall(r"\d+", block)]
            ends.append([sum(nodes[n][c] for n in numbers) / len(numbers)
                         for c in range(3)])
        axis = 0 if name.startswith("WARP") else 1
        result[name] = (ends[1][axis] - ends[0][axis], axis + 1)
    return result


def check_calculix(folder):
    """Pull the bundles; forces at their ends."""
    bundles = bundles_of(folder / "cell_relax.inp")
    lines = ["*INCLUDE, INPUT=cell_relax.inp", "*STEP", "*STATIC", "*BOUNDARY"]
    for name, (length, axis) in bundles.items():
        lines.append(f"{name}_BEGIN, 1, 3")
        for c in (1, 2, 3):
            value = STRAIN * length if c == axis else 0.
            lines.append(f"{name}_END, {c}, {c}, {value:.9e}")
    for name in bundles:
        lines += [f"*NODE PRINT, NSET={name}_END, TOTALS=ONLY", "RF"]
    lines += ["*EL PRINT, ELSET=ALL_ELEMENTS, TOTALS=ONLY", "EVOL",
              "*END STEP", ""]
    (folder / "pull.inp").write_text("\n".join(lines), encoding="ascii")
    log = run(["ccx", "pull"], folder)

    dat = (folder / "pull.dat").read_text(encoding="ascii")
    forces = {}
    for name, values in re.findall(
            r"total force \(fx,fy,fz\) for set (\w+)_END.*\n\n(.*)", dat):
        forces[name] = float(values.split()[bundles[name][1] - 1])
    volume = float(re.search(r"total volume for set.*\n\n\s*(\S+)", dat)[1])
    # What Abaqus needs and CalculiX does not know.
    known = ("UNSORTED", "COORD3D")
    warnings = [text.split("\n\n")[0] for text in log.split("*WARNING")[1:]]
    warnings = [text for text in warnings if "cannot be" not in text
                and not any(word in text for word in known)]
    return forces, volume, warnings


def check_gmsh(folder):
    """Volume of the mesh by gmsh."""
    (folder / "volume.geo").write_text(
        'Merge "cell_relax.msh";\nPlugin(MeshVolume).Dimension = 3;\n'
        "Plugin(MeshVolume).Run;\n", encoding="ascii")
    log = run(["gmsh", "volume.geo", "-parse_and_exit", "-v", "5"], folder)
    found = re.search(r"Mesh volume \(.*\): (\S+)", log)
    if found is None or "Error" in log:
        sys.exit(f"gmsh says:\n{log}")
    return float(found[1])


def check_meshio(folder):
    """Groups and fibers as meshio reads them."""
    import meshio  # pylint: disable=import-outside-toplevel
    mesh = meshio.read(folder / "cell_relax.msh")
    largest = 0.
    n_elements = 0
    for block, fibers in zip(mesh.cells, mesh.cell_data["fiber_direction"]):
        if block.type not in ("hexahedron", "hexahedron27"):
            continue
        n_elements += len(fibers)
        for fiber in fibers:
            largest = max(largest, abs(math.hypot(*fiber) - 1.))
    names = [name for name, (_, dim) in mesh.field_data.items() if dim == 3]
    return n_elements, names, largest


def main():
    """Ask all programs; see above."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--program", type=pathlib.Path, default="npt_dealii")
    parser.add_argument("--file", type=pathlib.Path, default=HERE / "exports.prm")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    folder = arguments.output.resolve()
    program = shutil.which(arguments.program) or arguments.program
    volumes = export(pathlib.Path(program).resolve(), arguments.file.resolve(),
                     folder)
    print("npt_dealii: " + ", ".join(f"{n} {v} mm^3"
                                     for n, v in volumes.items()))
    wrong = False

    def compare(name, value, expected):
        nonlocal wrong
        difference = value / expected - 1.
        wrong = wrong or not abs(difference) < 1e-4
        print(f"{name}: {value:.6g} mm^3, {difference:+.1e}")

    if shutil.which("ccx"):
        forces, volume, warnings = check_calculix(folder)
        compare("CalculiX", volume, volumes["cell_relax.inp"])
        for name, force in forces.items():
            print(f"  {name} pulled by {STRAIN:g}: {force:.4g} N")
            wrong = wrong or not force > 0.
        for warning in warnings:
            print("  warning: " + " ".join(warning.split()))
    else:
        print("CalculiX: not installed")
    if shutil.which("gmsh"):
        compare("gmsh", check_gmsh(folder), volumes["cell_relax.msh"])
    else:
        print("gmsh: not installed")
    try:
        n_elements, names, largest = check_meshio(folder)
        print(f"meshio: {n_elements} hexahedra in {', '.join(names)}; fibers "
              f"are unit vectors to {largest:.1e}")
        wrong = wrong or not largest < 1e-12
    except ModuleNotFoundError:
        print("meshio: not installed")
    read = run([program, "--from-texgen", folder / "cell_relax.tg3"], folder)
    print("npt_dealii --from-texgen: " + "; ".join(
        re.sub(r"\s+", " ", line.strip().removeprefix("set "))
        for line in read.splitlines() if line.startswith("  set ")))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
