"""Momentum and energy of each block, summed over full plot states, against forces and works of contact in the history, for
tests/results/other_programs.rs.

    python3 tests/python/contact_histories.py run.e run.h DENSITY

Block 1 strikes blocks 2 and 3, and block 2 lies on the floor of side set 100; nothing else acts. Plot states and histories are at the
same times; the mesh is of boxes along the axes. Prints how many numbers agreed and the largest relative difference. Exit code 3: a
library is not here.
"""

import sys

try:
    import netCDF4
    import numpy as np
except ImportError as why:
    print(why, file=sys.stderr)
    sys.exit(3)

plot, history = (netCDF4.Dataset(path) for path in sys.argv[1:3])
density = float(sys.argv[3])


def names(file, kind):
    return [netCDF4.chartostring(row).item().strip("\0 ") for row in file[f"name_{kind}_var"][:]]


times = plot["time_whole"][:].data
assert np.array_equal(times, history["time_whole"][:].data), "states at other times"
nodal = {name: plot[f"vals_nod_var{i}"][:].data for i, name in enumerate(names(plot, "nod"), 1)}
glob = {name: plot["vals_glo_var"][:, i].data for i, name in enumerate(names(plot, "glo"))}
found = {name: history["vals_glo_var"][:, i].data for i, name in enumerate(names(history, "glo"))}
velocity = np.stack([nodal["VEL" + axis] for axis in "XYZ"], axis=-1)
x0 = np.stack([plot["coord" + axis][:].data for axis in "xyz"], axis=-1)
compared, worst = 0, 0.0


def same(what, values, expected, most):
    """The largest difference over the largest value of the whole history."""
    global compared, worst
    scale = np.abs(expected).max()
    assert scale > 0.0, f"{what}: nothing happened"
    difference = np.abs(values - expected).max() / scale
    assert difference < most, f"{what}: {values} where {expected} belong, {difference:.1e}"
    compared, worst = compared + expected.size, max(worst, difference)


def impulse(suffix):
    """Mean forces times the intervals that they are means of, summed up; nothing is before the first state."""
    forces = np.stack([found[f"F{axis}_{suffix}"] for axis in "XYZ"], axis=-1)
    parts = forces[1:] * np.diff(times)[:, None]
    return np.concatenate([np.zeros((1, 3)), np.cumsum(parts, axis=0)])


momentum, energy = {}, {}
for block in (1, 2, 3):
    corners = plot[f"connect{block}"][:].data - 1
    volumes = (x0[corners].max(axis=1) - x0[corners].min(axis=1)).prod(axis=1)
    mass = np.zeros(len(x0))
    for corner in corners.T:
        np.add.at(mass, corner, density * volumes / 8)
    momentum[block] = np.einsum("n,tni->ti", mass, velocity)
    energy[block] = sum(glob[f"{name}_BLOCK{block}"] for name in ("KE", "IE", "HGE", "BVE"))

gained = {block: momentum[block] - momentum[block][0] for block in momentum}
# Round-off of the sums.
same("momentum of block 1", impulse("CONTACT1_2") + impulse("CONTACT1_3"), gained[1], 1e-11)
same("force of all others", impulse("CONTACT1"), gained[1], 1e-11)
same("momentum of block 2", impulse("CONTACT2_1") + impulse("WALL100"), gained[2], 1e-11)
same("momentum of block 3", -impulse("CONTACT1_3"), gained[3], 1e-11)
same("action and reaction", -impulse("CONTACT2_1"), impulse("CONTACT1_2"), 1e-11)

# Blocks gain what contact works on them, as exactly as the run balances its energy, and what is wrong in all of them is that balance.
gain = {block: energy[block] - energy[block][0] for block in energy}
work = {
    1: found["WORK1_CONTACT1_2"] + found["WORK1_CONTACT1_3"],
    2: found["WORK2_CONTACT1_2"] + found["WORK_WALL100"],
    3: found["WORK2_CONTACT1_3"],
}
initial = glob["KE"][0]
assert glob["KE"].max() <= initial, "the balance is relative to another account"
balance = np.abs(glob["EBAL"]).max()
assert balance < 3e-4, f"the run's balance is {balance:.1e}"
for block in gain:
    difference = np.abs(gain[block] - work[block]).max() / initial
    assert difference < 2.0 * balance, f"energy of block {block}: {gain[block]} where {work[block]} belong"
    assert np.abs(work[block]).max() > 0.1 * initial, f"block {block}: too little happened"
    compared += len(times)
wrong = sum(gain[block] - work[block] for block in gain)
assert np.abs(wrong / initial - glob["EBAL"]).max() < 1e-12, f"{wrong / initial} where {glob['EBAL']} belong"
same("work of all others", found["WORK1_CONTACT1"], found["WORK1_CONTACT1_2"] + found["WORK1_CONTACT1_3"], 1e-12)
same("work seen from block 2", found["WORK1_CONTACT2_1"], found["WORK2_CONTACT1_2"], 1e-12)
works = sum(found[f"WORK{side}_CONTACT1_{other}"] for side in (1, 2) for other in (2, 3)) + found["WORK_WALL100"]
friction = found["FRICE_CONTACT1_2"] + found["FRICE_CONTACT1_3"] + found["FRICE_WALL100"]
same("friction", friction, glob["FRICE"], 1e-12)
same("what contact took", works + friction, glob["CONTE"], 1e-12)
print(compared, worst)
