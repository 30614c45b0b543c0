"""Writes tests/fixtures/genesis_*.g: meshes of EXODUS I, in FORTRAN records, as programs of 1988 wrote them.

    python3 tests/python/make_genesis.py

The files are kept in the repository; the tests do not need python. They hold the mesh of make_fixtures.py: three unit
cubes in a row along x, two in block 10 and one in block 4. Each file has another byte order, size of words and reals,
size of record marks, or end.
"""

import pathlib
import struct

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "fixtures"
NODES = [(i, y, z) for i in range(4) for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))]
BLOCKS = [(10, [[4 * i + k + 1 for k in range(8)] for i in (0, 1)]), (4, [[4 * 2 + k + 1 for k in range(8)]])]
# Node sets, and side sets as pairs of an element and the nodes of its face, which need not begin where ours do.
NODE_SETS = [(5, [1, 2, 3, 4]), (30, [16])]
SIDE_SETS = [(200, [(1, [2, 1, 4, 3]), (3, [14, 15, 16, 13])]), (7, [(2, [5, 6, 10, 9])])]


class Writer:
    """Records of a file."""

    def __init__(self, name, order="<", integer="i", real="f", mark="i"):
        self.file = open(FOLDER / name, "wb")
        self.order, self.integer, self.real, self.mark = order, integer, real, mark

    def record(self, payload):
        mark = struct.pack(self.order + self.mark, len(payload))
        self.file.write(mark + payload + mark)

    def ints(self, values):
        """An empty array is one word that means nothing."""
        self.record(struct.pack(f"{self.order}{max(len(values), 1)}{self.integer}", *(values or [0])))

    def reals(self, values):
        self.record(struct.pack(f"{self.order}{max(len(values), 1)}{self.real}", *(values or [1.0])))

    def texts(self, values, width=8):
        self.record("".join(value.ljust(width) for value in values).encode())

    def mesh(self, title, version=True, sets=True):
        """Records 1 to 18."""
        node_sets, side_sets = (NODE_SETS, SIDE_SETS) if sets else ([], [])
        sides = [side for _, sides in side_sets for side in sides]
        sizes = [len(NODES), 3, 3, len(BLOCKS), len(node_sets), sum(len(s) for _, s in node_sets), len(side_sets),
                 len(sides), 4 * len(sides)]
        self.texts([title], 80)
        self.ints(sizes + ([1] if version else []))
        self.reals([float(node[axis]) for axis in range(3) for node in NODES])
        self.ints([3, 1, 2])
        for number, elements in BLOCKS:
            self.ints([number, len(elements), 8, 0])
            self.ints([node for element in elements for node in element])
            self.reals([])
        starts = lambda lengths: [1 + sum(lengths[:i]) for i in range(len(lengths))]
        lengths = [len(nodes) for _, nodes in node_sets]
        self.ints([number for number, _ in node_sets])
        self.ints(lengths)
        self.ints(starts(lengths))
        self.ints([node for _, nodes in node_sets for node in nodes])
        self.reals([1.0 for _, nodes in node_sets for _ in nodes])
        lengths = [len(sides) for _, sides in side_sets]
        self.ints([number for number, _ in side_sets])
        self.ints(lengths)
        # Numbers of nodes as some programs write them: wrong.
        self.ints([0 for _ in side_sets])
        self.ints(starts(lengths))
        self.ints(starts([4 * length for length in lengths]))
        self.ints([element for element, _ in sides])
        self.ints([node for _, nodes in sides for node in nodes])
        self.reals([1.0 for _ in sides for _ in range(4)])

    def records(self, names=True):
        """QA and information records, then the names of axes and of element types."""
        self.ints([2])
        self.texts(["FASTQ", "2.0", "12/15/88", "10:11:12"])
        self.texts(["GEN3D", "1.0", "12/16/88", "13:14:15"])
        self.ints([1])
        self.texts(["a line of information"], 80)
        if names:
            self.texts(["X", "Y", "Z"])
            self.texts(["HEX", "hex8"])


def write_all():
    w = Writer("genesis_little_4.g")
    w.mesh("little endian, words of 4 bytes")
    w = Writer("genesis_big_4.g", order=">")
    w.mesh("big endian, words of 4 bytes", version=False)
    w.records()
    w = Writer("genesis_little_8.g", integer="q", real="d")
    w.mesh("little endian, words of 8 bytes")
    w.records(names=False)
    w = Writer("genesis_big_8.g", order=">", integer="q", real="d")
    w.mesh("big endian, words of 8 bytes")
    w.records()
    # No variables: 25, then names and truth table, all empty.
    w.ints([0, 0, 0, 0])
    w = Writer("genesis_little_mixed.g", integer="i", real="d", mark="q")
    w.mesh("integers of 4 bytes, reals and marks of 8")
    w.records()
    w = Writer("genesis_big_marks.g", order=">", mark="q")
    w.mesh("no sets, marks of 8 bytes", sets=False)


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    write_all()
