#!/usr/bin/env python3
"""Times each material law and kind of hexahedron in two programs, in turn: what a change of the kernels brought, and whom it cost.

    python3 benches/paired_kernels.py [--turns N] [--width N] before after

Each scene is a slab of 8 x N x N elements (N = 180) whose two faces are driven towards each other, so that every element deforms
after a few steps; laws are those of decks/materials.i. Printed are nanoseconds that the elements of one rank take of a step, the
least of the turns, for both programs, and the second over the first. A program that does not know a command has no number.
"""
import argparse
import pathlib
import re
import subprocess
import tempfile

MATERIALS = pathlib.Path(__file__).parent.parent / "decks" / "materials.i"
EDGE = 0.01
# Speed of the faces over that of sound, and steps at the stable one.
MACH, STEPS = 0.01, 60


def laws():
    """Names of the laws of decks/materials.i, and their commands as those of block 1, with the functions."""
    text = "\n".join(line.split("$")[0].rstrip() for line in MATERIALS.read_text().splitlines())
    functions = re.findall(r"^FUNCTION,.*?^END\n", text, re.S | re.M)
    for block, law in re.findall(r"^MATERIAL, (\d+), ([^,]+),", text, re.M):
        commands = re.findall(rf"^(?:MATERIAL|EQUATION OF STATE), {block},.*?^END\n", text, re.S | re.M)
        if "JWL" in "".join(commands):
            commands += re.findall(r"^DETONATION POINT, .*\n", text, re.M)
        state = re.search(rf"^EQUATION OF STATE, {block}, (.*)$", text, re.M)
        own = [re.sub(rf", {block},", ", 1,", command, count=1) for command in commands]
        yield law + (f", {state[1]}" if state else ""), functions + own


def deck(commands, sound, more):
    """A deck of a slab that is pressed together."""
    time = STEPS * 0.9 * EDGE / sound
    lines = ["TITLE", " slab", f"TERMINATION TIME, {time!r}", f"OUTPUT TIME, {time!r}", f"PLOT TIME, {time!r}"]
    lines += ["FUNCTION, 99", "0., 1.", "1., 1.", "END", *commands]
    lines += [f"PRESCRIBED VELOCITY, X, 1, 99, {MACH * sound!r}", f"PRESCRIBED VELOCITY, X, 2, 99, {-MACH * sound!r}"]
    return "\n".join(line.rstrip() for line in [*lines, more, "EXIT", ""] if line)


def nanoseconds(program, deck, mesh, elements, folder):
    """What the elements take of a step, by the print file of a run; `None` if it does not run."""
    out = pathlib.Path(folder) / "out"
    command = [program, str(deck), "-m", str(mesh), "-o", str(out), "--quiet", "--ranks", "1"]
    if subprocess.run(command, capture_output=True).returncode != 0:
        return None
    text = out.with_suffix(".o").read_text()
    seconds = re.findall(r"^ *ELEMENTS +[\d.]+ +([\d.]+) +[\d.]+ +[\d.]+ *$", text, re.M)
    steps = re.findall(r"TIME STEPS TAKEN.*?(\d+)\s*$", text, re.M)
    return 1e9 * float(seconds[-1]) / (elements * int(steps[-1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--width", type=int, default=180, help="elements along both long sides of the slab")
    options = parser.parse_args()
    elements, side = 8 * options.width**2, EDGE * options.width
    with tempfile.TemporaryDirectory() as folder:
        recipe, mesh, path = (pathlib.Path(folder) / name for name in ("slab.mesh", "slab.g", "slab.i"))
        recipe.write_text(
            f"TITLE\n slab\nBOX, 1, 0., 0., 0., {8 * EDGE!r}, {side!r}, {side!r}, 8, {options.width}, {options.width}\n"
            f"NODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, {8 * EDGE!r}\n"
        )
        subprocess.run([options.after, "mesh", str(recipe), "-o", str(mesh)], check=True, capture_output=True)
        scenes = [(name, commands, "") for name, commands in laws()]
        first, plastic = scenes[0], next(scene for scene in scenes if scene[0] == "ELASTIC PLASTIC")
        knobs = ["HOURGLASS CONTROL, FB", "PRECISION, SINGLE", "ELEMENT, 1, EIGHT POINTS", "SPIN, SECOND ORDER"]
        scenes += [(f"{name}: {knob}", commands, knob) for name, commands, _ in (first, plastic) for knob in knobs]
        print(f"{elements} elements, ns per element and step\n| | before | after | ratio |\n|---|---|---|---|")
        for name, commands, knob in scenes:
            sound = 5000.0 if "YOUNGS" in "".join(commands) else 1500.0
            path.write_text(deck(commands, sound, knob))
            programs = [options.before, options.after] * options.turns
            times = [nanoseconds(program, path, mesh, elements, folder) for program in programs]
            least = [min((t for t in times[i::2] if t is not None), default=None) for i in (0, 1)]
            told = ["" if t is None else f"{t:.0f}" for t in least]
            ratio = "" if None in least else f"{least[1] / least[0]:.2f}"
            print(f"| {name.lower()} | {told[0]} | {told[1]} | {ratio} |", flush=True)


if __name__ == "__main__":
    main()
