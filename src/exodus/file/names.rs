//! Every name that EXODUS II gives to a netCDF attribute, dimension or variable, once.
//!
//! Positions of blocks, sets and variables in the file are one-based in the names; the functions here take them
//! zero-based, as the rest of the program counts.

// Global attributes. Files of version 2.01 and older spell two of them with blanks.
pub const API_VERSION: &str = "api_version";
pub const VERSION: &str = "version";
pub const WORD_SIZE: &str = "floating_point_word_size";
pub const FILE_SIZE: &str = "file_size";
pub const MAXIMUM_NAME_LENGTH: &str = "maximum_name_length";
pub const INT64_STATUS: &str = "int64_status";
pub const TITLE: &str = "title";
/// A file without any of these global attributes was not written by an EXODUS program.
pub const SIGNS_OF_EXODUS: [&str; 4] = [API_VERSION, "api version", VERSION, TITLE];

// Dimensions.
pub const TIME_STEP: &str = "time_step";
pub const LEN_STRING: &str = "len_string";
pub const LEN_LINE: &str = "len_line";
pub const LEN_NAME: &str = "len_name";
pub const FOUR: &str = "four";
pub const NUM_DIM: &str = "num_dim";
pub const NUM_NODES: &str = "num_nodes";
pub const NUM_ELEM: &str = "num_elem";
pub const NUM_BLOCKS: &str = "num_el_blk";
pub const NUM_NODE_SETS: &str = "num_node_sets";
pub const NUM_SIDE_SETS: &str = "num_side_sets";
pub const NUM_QA: &str = "num_qa_rec";
pub const NUM_INFO: &str = "num_info";
pub const NUM_GLOBAL_VARIABLES: &str = "num_glo_var";
pub const NUM_NODAL_VARIABLES: &str = "num_nod_var";
pub const NUM_ELEMENT_VARIABLES: &str = "num_elem_var";

// Variables that stand alone.
pub const TIME: &str = "time_whole";
/// All coordinates in one array, as files without large-model layout have them.
pub const PACKED_COORDINATES: &str = "coord";
pub const COORDINATES: [&str; 3] = ["coordx", "coordy", "coordz"];
pub const COORDINATE_NAMES: &str = "coor_names";
pub const NODE_IDS: &str = "node_num_map";
pub const ELEMENT_IDS: &str = "elem_num_map";
pub const QA: &str = "qa_records";
pub const INFO: &str = "info_records";
pub const GLOBAL_NAMES: &str = "name_glo_var";
pub const GLOBAL_VALUES: &str = "vals_glo_var";
pub const NODAL_NAMES: &str = "name_nod_var";
/// All nodal variables in one array, as files without large-model layout have them.
pub const PACKED_NODAL_VALUES: &str = "vals_nod_var";
pub const ELEMENT_NAMES: &str = "name_elem_var";
pub const TRUTH_TABLE: &str = "elem_var_tab";

// Dimensions and variables of pieces, which Nemesis adds.
pub const NUM_PROCESSORS: &str = "num_processors";
pub const NUM_PROCESSORS_OF_FILE: &str = "num_procs_file";
pub const NUM_NODES_GLOBAL: &str = "num_nodes_global";
pub const NUM_ELEM_GLOBAL: &str = "num_elems_global";
pub const FILE_KIND: &str = "nem_ftype";
pub const NUM_NODE_MAPS: &str = "num_n_cmaps";
pub const NUM_NODE_MAP_ENTRIES: &str = "ncnt_cmap";
pub const NUM_ELEMENT_MAPS: &str = "num_e_cmaps";
pub const NUM_ELEMENT_MAP_ENTRIES: &str = "ecnt_cmap";
/// Version of the Nemesis conventions, as attributes.
pub const NEMESIS_VERSIONS: [&str; 2] = ["nemesis_api_version", "nemesis_file_version"];

/// Attribute of the `connect` variables that holds the element type.
pub const ELEMENT_TYPE: &str = "elem_type";
/// Attribute that says what a property array is, and the value that marks the numbers of blocks and sets.
pub const PROPERTY_NAME: (&str, &str) = ("name", "ID");

/// A family of numbered objects: how many, their status, numbers and names.
pub struct Family {
    pub count: &'static str,
    pub status: &'static str,
    pub ids: &'static str,
    pub names: &'static str,
}

pub const BLOCKS: Family = Family { count: NUM_BLOCKS, status: "eb_status", ids: "eb_prop1", names: "eb_names" };
pub const NODE_SETS: Family = Family { count: NUM_NODE_SETS, status: "ns_status", ids: "ns_prop1", names: "ns_names" };
pub const SIDE_SETS: Family = Family { count: NUM_SIDE_SETS, status: "ss_status", ids: "ss_prop1", names: "ss_names" };

/// What pieces say of a whole family: its count, numbers and sizes, and the sizes of its distribution factors.
pub struct WholeFamily {
    pub count: &'static str,
    pub ids: &'static str,
    pub sizes: &'static str,
    pub factors: Option<&'static str>,
}

pub const WHOLE_BLOCKS: WholeFamily =
    WholeFamily { count: "num_el_blk_global", ids: "el_blk_ids_global", sizes: "el_blk_cnt_global", factors: None };
pub const WHOLE_NODE_SETS: WholeFamily = WholeFamily {
    count: "num_ns_global",
    ids: "ns_ids_global",
    sizes: "ns_node_cnt_global",
    factors: Some("ns_df_cnt_global"),
};
pub const WHOLE_SIDE_SETS: WholeFamily = WholeFamily {
    count: "num_ss_global",
    ids: "ss_ids_global",
    sizes: "ss_side_cnt_global",
    factors: Some("ss_df_cnt_global"),
};

/// A list of a piece's nodes or elements by what they are to others: its status, dimension and variable.
pub struct Standing {
    pub status: &'static str,
    pub count: &'static str,
    pub list: &'static str,
}

/// Nodes inside and at the border, then elements inside and at the border.
pub const STANDINGS: [Standing; 4] = [
    Standing { status: "int_n_stat", count: "num_int_node", list: "node_mapi" },
    Standing { status: "bor_n_stat", count: "num_bor_node", list: "node_mapb" },
    Standing { status: "int_e_stat", count: "num_int_elem", list: "elem_mapi" },
    Standing { status: "bor_e_stat", count: "num_bor_elem", list: "elem_mapb" },
];
/// Nodes that a piece needs without having them: urto has none.
pub const OUTER_NODES_STATUS: &str = "ext_n_stat";

/// Which nodes are shared with whom: ranks, status and end of each rank's list; then nodes and ranks, entry by entry.
pub const NODE_MAP: [&str; 5] = ["n_comm_ids", "n_comm_stat", "n_comm_data_idx", "n_comm_nids", "n_comm_proc"];
/// Which elements have others of whom across which side: ranks, status and end of each rank's list; then elements, ranks
/// and sides, entry by entry.
pub const ELEMENT_MAP: [&str; 6] =
    ["e_comm_ids", "e_comm_stat", "e_comm_data_idx", "e_comm_eids", "e_comm_proc", "e_comm_sids"];

// Places in the whole file, from 1: ours, as numbers do not tell the order.
pub const NODE_PLACES: &str = "urto_node_places";
pub const ELEMENT_PLACES: &str = "urto_elem_places";
pub fn node_set_places(set: usize) -> String {
    format!("urto_ns_places{}", set + 1)
}
pub fn side_set_places(set: usize) -> String {
    format!("urto_ss_places{}", set + 1)
}

pub fn block_elements(block: usize) -> String {
    format!("num_el_in_blk{}", block + 1)
}
pub fn block_nodes_per_element(block: usize) -> String {
    format!("num_nod_per_el{}", block + 1)
}
pub fn connectivity(block: usize) -> String {
    format!("connect{}", block + 1)
}
pub fn block_attributes(block: usize) -> String {
    format!("num_att_in_blk{}", block + 1)
}
pub fn attributes(block: usize) -> String {
    format!("attrib{}", block + 1)
}
pub fn node_set_size(set: usize) -> String {
    format!("num_nod_ns{}", set + 1)
}
pub fn node_set_nodes(set: usize) -> String {
    format!("node_ns{}", set + 1)
}
pub fn node_set_factors(set: usize) -> String {
    format!("dist_fact_ns{}", set + 1)
}
pub fn side_set_factors(set: usize) -> String {
    format!("dist_fact_ss{}", set + 1)
}
pub fn side_set_size(set: usize) -> String {
    format!("num_side_ss{}", set + 1)
}
pub fn side_set_elements(set: usize) -> String {
    format!("elem_ss{}", set + 1)
}
pub fn side_set_sides(set: usize) -> String {
    format!("side_ss{}", set + 1)
}
pub fn nodal_values(variable: usize) -> String {
    format!("vals_nod_var{}", variable + 1)
}
pub fn element_values(variable: usize, block: usize) -> String {
    format!("vals_elem_var{}eb{}", variable + 1, block + 1)
}
