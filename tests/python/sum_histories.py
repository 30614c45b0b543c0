"""Sums over full plot states, made from scratch, against the histories that urto wrote, for tests/results/other_programs.rs.

    python3 tests/python/sum_histories.py run.e run.h DENSITY_OF_BLOCK_1 DENSITY_OF_BLOCK_2

Plot states and histories are at the same times; the mesh is of boxes along the axes. Prints how many numbers agreed and the
largest relative difference. Exit code 3: a library is not here.
"""

import sys

try:
    import netCDF4
    import numpy as np
except ImportError as why:
    print(why, file=sys.stderr)
    sys.exit(3)

plot, history = (netCDF4.Dataset(path) for path in sys.argv[1:3])
densities = [float(text) for text in sys.argv[3:]]


def names(file, kind):
    return [netCDF4.chartostring(row).item().strip("\0 ") for row in file[f"name_{kind}_var"][:]]


times = plot["time_whole"][:].data
assert np.array_equal(times, history["time_whole"][:].data), "states at other times"
nodal = {name: plot[f"vals_nod_var{i}"][:].data for i, name in enumerate(names(plot, "nod"), 1)}
glob = {name: plot["vals_glo_var"][:, i].data for i, name in enumerate(names(plot, "glo"))}
found = {name: history["vals_glo_var"][:, i].data for i, name in enumerate(names(history, "glo"))}
vector = lambda stem: np.stack([nodal[stem + axis] for axis in "XYZ"], axis=-1)
u, v, r = vector("DISPL"), vector("VEL"), vector("R")
x0 = np.stack([plot["coord" + axis][:].data for axis in "xyz"], axis=-1)
compared, worst = 0, 0.0


def same(name, expected, scale=None):
    """The largest difference over the largest value of the whole history."""
    global compared, worst
    expected = np.asarray(expected)
    scale = np.abs(expected).max() if scale is None else scale
    difference = np.abs(found[name] - expected).max() / (scale or 1.0)
    assert difference < 1e-9, f"{name}: {found[name]} where {expected} belong"
    compared, worst = compared + expected.size, max(worst, difference)


def same_vector(stem, suffix, expected):
    scale = np.abs(expected).max()
    for i, axis in enumerate("XYZ"):
        same(f"{stem}{axis}_{suffix}", expected[:, i], scale)


def rates(values):
    """Changes over the intervals between states; nothing is before the first."""
    change = np.zeros_like(values)
    change[1:] = np.diff(values, axis=0) / np.diff(times)[:, None]
    return change


kinetic = 0.0
for block, density in enumerate(densities, 1):
    corners = plot[f"connect{block}"][:].data - 1
    sides = x0[corners].max(axis=1) - x0[corners].min(axis=1)
    volumes = sides.prod(axis=1)
    mass = np.zeros(len(x0))
    for corner in corners.T:
        np.add.at(mass, corner, density * volumes / 8)
    suffix, total = f"BLOCK{block}", mass.sum()
    same(f"MASS_{suffix}", np.full(len(times), total))
    same_vector("DISPL", suffix, np.einsum("n,tni->ti", mass, u) / total)
    momentum = np.einsum("n,tni->ti", mass, v)
    velocity = momentum / total
    same_vector("VEL", suffix, velocity)
    same_vector("ACCL", suffix, rates(velocity))
    scale = np.abs(momentum).max()
    for i, axis in enumerate("XYZ"):
        same(f"{axis}MOM_{suffix}", momentum[:, i], scale)
    turning = []
    for state in range(len(times)):
        x = x0 + u[state]
        arm = x - (mass[:, None] * x).sum(axis=0) / total
        spin = (mass[:, None] * np.cross(arm, v[state] - velocity[state])).sum(axis=0)
        inertia = np.einsum("n,ni,ni->", mass, arm, arm) * np.eye(3) - np.einsum("n,ni,nj->ij", mass, arm, arm)
        turning.append(np.linalg.solve(inertia, spin))
    same_vector("ROT", suffix, np.array(turning))
    energy = names(plot, "elem").index("ENERGY") + 1
    same(f"IE_{suffix}", plot[f"vals_elem_var{energy}eb{block}"][:].data @ volumes)
    kinetic = kinetic + found[f"KE_{suffix}"]
    # The plot file has the same energies when it is asked for them.
    for name in ("KE", "IE", "HGE", "BVE"):
        same(f"{name}_{suffix}", glob[f"{name}_{suffix}"])
assert np.allclose(kinetic, glob["KE"], rtol=1e-12), "the blocks' kinetic energies are not that of the body"
compared += len(times)

numbers = list(plot["ns_prop1"][:].data)
for name in [name for name in found if name.startswith("DISPLX_SET")]:
    number = int(name.removeprefix("DISPLX_SET"))
    nodes = np.unique(plot[f"node_ns{numbers.index(number) + 1}"][:].data - 1)
    suffix = f"SET{number}"
    same_vector("DISPL", suffix, u[:, nodes].mean(axis=1))
    same_vector("VEL", suffix, v[:, nodes].mean(axis=1))
    same_vector("ACCL", suffix, rates(v[:, nodes].mean(axis=1)))
    same_vector("R", suffix, r[:, nodes].sum(axis=1))
ids = list(plot["node_num_map"][:].data)
for name in [name for name in found if name.startswith("DISPLX_NODE")]:
    number = int(name.removeprefix("DISPLX_NODE"))
    node, suffix = ids.index(number), f"NODE{number}"
    for stem, values in (("DISPL", u), ("VEL", v), ("ACCL", rates(v[:, node])[:, None]), ("R", r)):
        same_vector(stem, suffix, values[:, 0 if stem == "ACCL" else node])
print(compared, worst)
