"""Reads the pieces of `urto run --split` through the EXODUS library, by the calls that joining programs make.

    python3 tests/python/nemesis_pieces.py run.e.3.0 run.e.3.1 run.e.3.2

Every call must succeed. Nodes inside and at the border, and elements likewise, must make up each piece; the ids of all pieces
those of the whole; and what two pieces share, nodes and faces of elements, must stand on both sides in the same order. Prints
how many numbers were compared. Exit code 3: the library is not here.
"""

import ctypes
import sys

VERSIONS = (("libexoIIv2c.so.5", 602), ("libexoIIv2.so.5", 602))
ELEMENT_MAP, NODE_MAP = 4, 5
# Nodes of the sides 1 to 6 of a hexahedron, from 0.
SIDES = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (0, 3, 2, 1), (4, 5, 6, 7))


def library():
    for name, version in VERSIONS:
        try:
            return ctypes.CDLL(name), version
        except OSError:
            continue
    print("no EXODUS library", file=sys.stderr)
    sys.exit(3)


LIBRARY, VERSION = library()


def call(name, *arguments):
    assert getattr(LIBRARY, name)(*arguments) == 0, name


def numbers(name, file, count, *last, before=()):
    """What a call writes into `count` single numbers."""
    cells = [ctypes.c_int() for _ in range(count)]
    call(name, file, *before, *(ctypes.byref(cell) for cell in cells), *last)
    return [cell.value for cell in cells]


def lists(name, file, lengths, *last, before=()):
    """What a call writes into lists of these lengths."""
    space = [(ctypes.c_int * max(length, 1))() for length in lengths]
    call(name, file, *before, *space, *last)
    return [list(one)[:length] for one, length in zip(space, lengths)]


class Piece:
    def __init__(self, path, rank):
        word, file_word, version = ctypes.c_int(8), ctypes.c_int(0), ctypes.c_float()
        file = LIBRARY.ex_open_int(
            path.encode(), 0, ctypes.byref(word), ctypes.byref(file_word), ctypes.byref(version), VERSION
        )
        assert file > 0, path
        title = ctypes.create_string_buffer(100)
        _, self.nodes, self.elements, blocks, _, _ = numbers("ex_get_init", file, 6, before=(title,))
        self.ranks, in_file = self.init_info(file)
        assert in_file == 1
        self.all_nodes, self.all_elements, self.all_blocks, *_ = numbers("ex_get_init_global", file, 5)
        inner, border, outer, inner_elements, border_elements, maps, element_maps = numbers(
            "ex_get_loadbal_param", file, 7, rank
        )
        assert outer == 0
        self.node_maps = lists("ex_get_processor_node_maps", file, [inner, border, outer], rank)
        self.element_maps = lists("ex_get_processor_elem_maps", file, [inner_elements, border_elements], rank)
        ids, counts, side_ids, side_counts = lists(
            "ex_get_cmap_params", file, [maps, maps, element_maps, element_maps], rank
        )
        self.shared = {
            other: lists("ex_get_node_cmap", file, [count, count], rank, before=(other,))
            for other, count in zip(ids, counts)
        }
        self.faces = {
            other: lists("ex_get_elem_cmap", file, [count] * 3, rank, before=(other,))
            for other, count in zip(side_ids, side_counts)
        }
        self.node_ids, self.element_ids = [
            lists("ex_get_id_map", file, [count], before=(kind,))[0]
            for kind, count in ((NODE_MAP, self.nodes), (ELEMENT_MAP, self.elements))
        ]
        self.corners = self.connectivity(file, blocks)
        call("ex_close", file)

    @staticmethod
    def init_info(file):
        ranks, in_file, kind = ctypes.c_int(), ctypes.c_int(), ctypes.create_string_buffer(4)
        call("ex_get_init_info", file, ctypes.byref(ranks), ctypes.byref(in_file), kind)
        assert kind.value == b"p"
        return ranks.value, in_file.value

    def connectivity(self, file, blocks):
        """Eight nodes of every element, blocks in their order."""
        (ids,) = lists("ex_get_elem_blk_ids", file, [blocks])
        corners = []
        for block in ids:
            kind = ctypes.create_string_buffer(100)
            count, width, _ = numbers("ex_get_elem_block", file, 3, before=(block, kind))
            if count:
                (nodes,) = lists("ex_get_elem_conn", file, [count * width], before=(block,))
                corners += [nodes[8 * i : 8 * i + 8] for i in range(count)]
        return corners

    def face(self, element, side):
        return {self.node_ids[self.corners[element - 1][node] - 1] for node in SIDES[side - 1]}


def check(pieces):
    compared = 0
    for piece in pieces:
        assert piece.ranks == len(pieces)
        for maps, count in ((piece.node_maps, piece.nodes), (piece.element_maps, piece.elements)):
            assert sorted(number for one in maps for number in one) == list(range(1, count + 1))
        border = {node for nodes, _ in piece.shared.values() for node in nodes}
        assert border == set(piece.node_maps[1])
        compared += piece.nodes + piece.elements
    whole = pieces[0]
    assert len({node for piece in pieces for node in piece.node_ids}) == whole.all_nodes
    assert sorted(e for piece in pieces for e in piece.element_ids) == list(range(1, whole.all_elements + 1))
    for rank, piece in enumerate(pieces):
        for other, (nodes, ranks) in piece.shared.items():
            theirs = pieces[other].shared[rank][0]
            assert set(ranks) == {other}
            assert [piece.node_ids[n - 1] for n in nodes] == [pieces[other].node_ids[n - 1] for n in theirs]
            compared += len(nodes)
        for other, (elements, sides, ranks) in piece.faces.items():
            assert set(ranks) == {other}
            theirs = pieces[other].faces[rank]
            own_faces = [piece.face(e, s) for e, s in zip(elements, sides)]
            assert own_faces == [pieces[other].face(e, s) for e, s in zip(theirs[0], theirs[1])]
            compared += len(elements)
    return compared


print(check([Piece(path, rank) for rank, path in enumerate(sys.argv[1:])]), "numbers compared")
