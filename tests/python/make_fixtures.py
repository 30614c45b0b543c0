"""Writes tests/fixtures/*: small EXODUS files in the manner of other programs.

    python3 -m venv VENV && VENV/bin/pip install netCDF4
    VENV/bin/python tests/python/make_fixtures.py

The files are kept in the repository; the tests do not need python. They hold one mesh, three unit cubes in a row
along x, two in block 10 and one in block 4, each file with the spellings and omissions of one family of writers.
"""

import pathlib

import netCDF4
import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "fixtures"

NODES = np.array([(i, y, z) for i in range(4) for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
BLOCKS = {10: [[4 * i + k + 1 for k in range(8)] for i in (0, 1)], 4: [[4 * 2 + k + 1 for k in range(8)]]}


def chars(texts, width):
    """Texts as rows of NUL padded characters."""
    return np.array([list(text.ljust(width, "\0")) for text in texts], dtype="S1")


class Writer:
    """A file with its types and spellings."""

    def __init__(self, name, container, real="f8", integer="i4", **options):
        self.file = netCDF4.Dataset(FOLDER / name, "w", format=container)
        self.file.set_auto_mask(False)
        self.real, self.integer, self.options = real, integer, options

    def dim(self, name, length):
        self.file.createDimension(name, length)

    def var(self, name, kind, dims, values, /, **attributes):
        options = self.options if kind == self.real else {}
        variable = self.file.createVariable(name, kind, dims, **options)
        for key, value in attributes.items():
            variable.setncattr(key, value)
        if values is not None:
            variable[:] = values

    def ints(self, name, dims, values, /, **attributes):
        self.var(name, self.integer, dims, np.array(values), **attributes)

    def reals(self, name, dims, values):
        self.var(name, self.real, dims, np.array(values))

    def common(self, title, blanks=False, records=True):
        space = " " if blanks else "_"
        self.file.setncattr(f"api{space}version", np.float32(2.01 if blanks else 8.11))
        self.file.setncattr("version", np.float32(2.01 if blanks else 8.11))
        self.file.setncattr(f"floating{space}point{space}word{space}size", np.int32(4 if self.real == "f4" else 8))
        self.file.setncattr("title", title)
        if records:
            self.dim("time_step", None)
            self.dim("len_string", 33)
            self.dim("len_line", 81)
            self.dim("four", 4)
        self.dim("num_dim", 3)
        self.dim("num_nodes", 16)
        self.dim("num_elem", 3)

    def coordinates(self):
        for axis, name in enumerate(("coordx", "coordy", "coordz")):
            self.reals(name, ("num_nodes",), NODES[:, axis])

    def blocks(self, spelling, null=None):
        """Element blocks; `null` is the number of an empty block put between the two."""
        ids = [10] + ([null] if null else []) + [4]
        self.dim("num_el_blk", len(ids))
        self.ints("eb_status", ("num_el_blk",), [int(i in BLOCKS) for i in ids])
        self.ints("eb_prop1", ("num_el_blk",), ids, name="ID")
        for n, block in enumerate(ids, 1):
            if block in BLOCKS:
                self.dim(f"num_el_in_blk{n}", len(BLOCKS[block]))
                self.dim(f"num_nod_per_el{n}", 8)
                dims = (f"num_el_in_blk{n}", f"num_nod_per_el{n}")
                self.ints(f"connect{n}", dims, BLOCKS[block], elem_type=spelling)


def classic_packed():
    """The oldest layout: blanks in attributes, packed coordinates and results, single precision, no maps, no names."""
    w = Writer("classic_packed.exo", "NETCDF3_CLASSIC", real="f4")
    w.common("packed", blanks=True)
    w.reals("coord", ("num_dim", "num_nodes"), NODES.T)
    w.blocks("HEX")
    w.dim("num_node_sets", 1)
    w.ints("ns_status", ("num_node_sets",), [1])
    w.ints("ns_prop1", ("num_node_sets",), [31], name="ID")
    w.dim("num_nod_ns1", 2)
    w.ints("node_ns1", ("num_nod_ns1",), [1, 16])
    w.reals("dist_fact_ns1", ("num_nod_ns1",), [1, 2])
    w.dim("num_nod_var", 2)
    w.var("name_nod_var", "S1", ("num_nod_var", "len_string"), chars(["DISPLX  ", "DISPLY"], 33))
    w.reals("time_whole", ("time_step",), [0.0, 0.5])
    values = [[[100 * s + 10 * v + n / 4 for n in range(16)] for v in range(2)] for s in range(2)]
    w.reals("vals_nod_var", ("time_step", "num_nod_var", "num_nodes"), values)
    w.file.close()


def cdf5_int64():
    """A recent mesher's large model: 64-bit integers everywhere, numbers beyond 32 bits, an element type in lower case."""
    w = Writer("cdf5_int64.g", "NETCDF3_64BIT_DATA", integer="i8")
    w.common("wide")
    w.coordinates()
    w.blocks("hex8")
    w.ints("node_num_map", ("num_nodes",), [10_000_000_000 + 3 * n for n in range(16)])
    w.ints("elem_num_map", ("num_elem",), [70, 50, 90_000_000_000])
    w.dim("num_side_sets", 1)
    w.ints("ss_status", ("num_side_sets",), [1])
    w.ints("ss_prop1", ("num_side_sets",), [200], name="ID")
    w.dim("num_side_ss1", 2)
    w.ints("elem_ss1", ("num_side_ss1",), [1, 3])
    w.ints("side_ss1", ("num_side_ss1",), [5, 6])
    w.file.close()


def netcdf4_compressed():
    """Compressed HDF5 with long names and the type's trailing NUL."""
    w = Writer("netcdf4_compressed.g", "NETCDF4_CLASSIC", zlib=True)
    w.common("compressed", records=False)
    w.dim("len_name", 256)
    w.coordinates()
    w.blocks("HEX8\0")
    w.var("eb_names", "S1", ("num_el_blk", "len_name"), chars(["a block with a name of more than thirty-two characters", ""], 256))
    w.file.close()


def null_block():
    """A piece of a larger model: an empty block, an empty node set, an empty side set; several QA records."""
    w = Writer("null_block.g", "NETCDF3_64BIT_OFFSET", real="f4")
    w.common("piece")
    w.dim("len_name", 33)
    w.coordinates()
    w.blocks("HEX8", null=77)
    w.var("eb_names", "S1", ("num_el_blk", "len_name"), chars(["first", "", "third  "], 33))
    w.dim("num_node_sets", 2)
    w.ints("ns_status", ("num_node_sets",), [0, 1])
    w.ints("ns_prop1", ("num_node_sets",), [5, 3], name="ID")
    w.dim("num_nod_ns2", 3)
    w.dim("num_df_ns2", 3)
    w.ints("node_ns2", ("num_nod_ns2",), [2, 4, 6])
    w.reals("dist_fact_ns2", ("num_df_ns2",), [1, 1, 1])
    w.dim("num_side_sets", 1)
    w.ints("ss_status", ("num_side_sets",), [0])
    w.ints("ss_prop1", ("num_side_sets",), [9], name="ID")
    w.ints("eb_prop2", ("num_el_blk",), [1, 2, 3], name="STRENGTH")
    w.ints("elem_map", ("num_elem",), [3, 2, 1])
    w.dim("num_qa_rec", 2)
    qa = chars(["CUBIT", "16.0", "01/02/2024", "10:11:12", "NEM_SPREAD", "7.01", "2024/01/03", "01:02:03"], 33)
    w.var("qa_records", "S1", ("num_qa_rec", "four", "len_string"), qa.reshape(2, 4, 33))
    w.file.close()


def partial_truth():
    """Results where one block lacks a variable; info records."""
    w = Writer("partial_truth.exo", "NETCDF3_64BIT_OFFSET")
    w.common("results")
    w.dim("len_name", 33)
    w.coordinates()
    w.blocks("HEX8")
    w.dim("num_info", 2)
    w.var("info_records", "S1", ("num_info", "len_line"), chars(["first line", "second line"], 81))
    w.dim("num_glo_var", 1)
    w.dim("num_elem_var", 2)
    w.var("name_glo_var", "S1", ("num_glo_var", "len_name"), chars(["KE"], 33))
    w.var("name_elem_var", "S1", ("num_elem_var", "len_name"), chars(["SIGXX", "EQPS"], 33))
    w.ints("elem_var_tab", ("num_el_blk", "num_elem_var"), [[1, 0], [1, 1]])
    w.reals("time_whole", ("time_step",), [0.0, 1.0])
    w.reals("vals_glo_var", ("time_step", "num_glo_var"), [[5.0], [6.0]])
    w.reals("vals_elem_var1eb1", ("time_step", "num_el_in_blk1"), [[1, 2], [11, 12]])
    w.reals("vals_elem_var1eb2", ("time_step", "num_el_in_blk2"), [[3], [13]])
    w.reals("vals_elem_var2eb2", ("time_step", "num_el_in_blk2"), [[0.25], [0.5]])
    w.file.close()


def smallest():
    """Nothing but what cannot be left out."""
    w = Writer("smallest.g", "NETCDF3_CLASSIC")
    w.file.title = ""
    w.dim("n", 16)
    w.dim("e", 3)
    w.dim("eight", 8)
    w.dim("num_el_blk", 1)
    for axis, name in enumerate(("coordx", "coordy", "coordz")):
        w.reals(name, ("n",), NODES[:, axis])
    w.ints("connect1", ("e", "eight"), BLOCKS[10] + BLOCKS[4])
    w.file.close()


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for write in (classic_packed, cdf5_int64, netcdf4_compressed, null_block, partial_truth, smallest):
        write()
