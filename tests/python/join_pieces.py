"""Joins the pieces of a split run by the numbers of nodes and elements, as other programs do, and holds them against the
file of an unsplit run; also checks what the pieces say of their neighbours. For tests/results/other_programs.rs.

    python3 tests/python/join_pieces.py whole.e piece.e.3.0 piece.e.3.1 ...

Prints what was compared. Exit code 3: netCDF4 is not here; 1: something is wrong, with a reason.
"""

import sys

try:
    import netCDF4
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(3)


def size(file, name):
    return len(file.dimensions[name]) if name in file.dimensions else 0


def ints(file, name):
    return [int(value) for value in file[name][:]] if name in file.variables else []


def check(right, words):
    if not right:
        sys.exit(words)


def block_of_elements(file):
    """Block position and place in its block of each element."""
    blocks = size(file, "num_el_blk")
    return [(b, i) for b in range(1, blocks + 1) for i in range(size(file, f"num_el_in_blk{b}"))]


def check_counts(whole, piece):
    for mine, theirs in (("num_nodes", "num_nodes_global"), ("num_elem", "num_elems_global"),
                         ("num_el_blk", "num_el_blk_global"), ("num_node_sets", "num_ns_global"),
                         ("num_side_sets", "num_ss_global")):
        check(size(whole, mine) == size(piece, theirs), f"{theirs}")
    check(ints(whole, "eb_prop1") == ints(piece, "el_blk_ids_global"), "block ids")
    check(int(piece["nem_ftype"][...]) == 0, "a parallel file")
    check(sorted(ints(piece, "node_mapi") + ints(piece, "node_mapb")) == list(range(1, size(piece, "num_nodes") + 1)),
          "nodes inside and at the border are all nodes")
    check(sorted(ints(piece, "elem_mapi") + ints(piece, "elem_mapb")) == list(range(1, size(piece, "num_elem") + 1)),
          "elements inside and at the border are all elements")


def shared(piece):
    """For each neighbour the numbers of the nodes shared with it, in the piece's order."""
    ids, ends = ints(piece, "n_comm_ids"), ints(piece, "n_comm_data_idx")
    nodes, ranks, numbers = ints(piece, "n_comm_nids"), ints(piece, "n_comm_proc"), ints(piece, "node_num_map")
    result, start = {}, 0
    for rank, end in zip(ids, ends):
        check(set(ranks[start:end]) == {rank}, "entries stand under their neighbour")
        result[rank] = [numbers[node - 1] for node in nodes[start:end]]
        start = end
    return result


# Corners of the sides of a hexahedron.
SIDES = [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (0, 3, 2, 1), (4, 5, 6, 7)]


def corners(file):
    """The numbers of the nodes of each element."""
    numbers = ints(file, "node_num_map")
    blocks = [b for b in range(1, size(file, "num_el_blk") + 1) if f"connect{b}" in file.variables]
    return [[numbers[node - 1] for node in nodes] for b in blocks for nodes in file[f"connect{b}"][:].tolist()]


def faces_across(piece):
    """For each rank with elements across the sides of this piece, the numbers of the nodes of these sides."""
    ids, ends = ints(piece, "e_comm_ids"), ints(piece, "e_comm_data_idx")
    elements, sides, ranks = ints(piece, "e_comm_eids"), ints(piece, "e_comm_sids"), ints(piece, "e_comm_proc")
    nodes, result, start = corners(piece), {}, 0
    border = set(ints(piece, "elem_mapb"))
    for rank, end in zip(ids, ends):
        check(set(ranks[start:end]) == {rank}, "elements stand under their neighbour")
        check(set(elements[start:end]) <= border, "elements with others across a side are at the border")
        entries = zip(elements[start:end], sides[start:end])
        result[rank] = [frozenset(nodes[element - 1][corner] for corner in SIDES[side - 1]) for element, side in entries]
        start = end
    return result


def check_across(whole, pieces):
    """Holds the element maps against all faces of the whole that elements of two pieces have."""
    owner = {number: rank for rank, piece in enumerate(pieces) for number in ints(piece, "elem_num_map")}
    sharers = {}
    for number, nodes in zip(ints(whole, "elem_num_map"), corners(whole)):
        for side in SIDES:
            face = frozenset(nodes[corner] for corner in side)
            if len(face) > 2:
                sharers.setdefault(face, []).append(owner[number])
    maps, count = [faces_across(piece) for piece in pieces], 0
    for rank, others in enumerate(maps):
        for other, faces in others.items():
            check(maps[other].get(rank) == faces, f"pieces {rank} and {other} name the same faces in the same order")
            between = {face for face, ranks in sharers.items() if sorted(ranks) == sorted([rank, other])}
            check(len(faces) == len(between) and set(faces) == between, f"all faces between {rank} and {other}")
            count += len(faces)
    expected = 2 * sum(1 for ranks in sharers.values() if len(set(ranks)) == 2)
    check(count == expected, f"{count} faces between pieces, {expected} expected")


whole = netCDF4.Dataset(sys.argv[1])
pieces = [netCDF4.Dataset(path) for path in sys.argv[2:]]
for file in [whole] + pieces:
    file.set_auto_mask(False)
node_at = {number: place for place, number in enumerate(ints(whole, "node_num_map"))}
element_at = dict(zip(ints(whole, "elem_num_map"), block_of_elements(whole)))
states, compared, elements = len(whole["time_whole"]), 0, 0
maps = [shared(piece) for piece in pieces]
for rank, piece in enumerate(pieces):
    check_counts(whole, piece)
    check((piece["time_whole"][:] == whole["time_whole"][:]).all(), "times")
    check((piece["vals_glo_var"][:] == whole["vals_glo_var"][:]).all(), "globals")
    for other, nodes in maps[rank].items():
        check(nodes and maps[other][rank] == nodes, f"pieces {rank} and {other} name the same nodes in the same order")
    numbers = ints(piece, "node_num_map")
    for name in ["coordx", "coordy", "coordz"]:
        check(all(whole[name][node_at[n]] == x for n, x in zip(numbers, piece[name][:] if numbers else [])), name)
    for v in range(1, size(whole, "num_nod_var") + 1):
        for state in range(states if numbers else 0):
            ours, theirs = piece[f"vals_nod_var{v}"][state], whole[f"vals_nod_var{v}"][state]
            for number, value in zip(numbers, ours):
                check(theirs[node_at[number]] == value, f"nodal variable {v}, state {state}, node {number}")
                compared += 1
    numbers = ints(piece, "elem_num_map")
    elements += len(numbers)
    for number, (b, i) in zip(numbers, block_of_elements(piece)):
        block, place = element_at[number]
        check(block == b, "the block of an element")
        ours = [piece["node_num_map"][n - 1] for n in piece[f"connect{b}"][i]]
        check(ours == [whole["node_num_map"][n - 1] for n in whole[f"connect{b}"][place]], f"nodes of element {number}")
        for v in range(1, size(whole, "num_elem_var") + 1):
            name = f"vals_elem_var{v}eb{b}"
            check((piece[name][:, i] == whole[name][:, place]).all(), f"element variable {v}, element {number}")
            compared += states
check(elements == size(whole, "num_elem"), "each element stands in one piece")
check_across(whole, pieces)
print(compared, "values compared")
