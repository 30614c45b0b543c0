//! A netCDF file as an editable list of arrays, so that a test can spoil exactly one thing in it.

use std::path::Path;

use netcdf::types::{NcTypeDescriptor, NcVariableType};

/// Values of one array.
#[derive(Clone)]
pub enum Values {
    Integers(Vec<i32>),
    Reals(Vec<f64>),
    Text(&'static str),
}

#[repr(transparent)]
struct Character(u8);

// SAFETY: a transparent u8 has the memory layout of netCDF's NC_CHAR.
unsafe impl NcTypeDescriptor for Character {
    fn type_descriptor() -> NcVariableType {
        NcVariableType::Char
    }
}

/// One array: name, dimensions, values, element type if it is a connectivity.
pub struct Array {
    pub name: String,
    pub dimensions: Vec<String>,
    pub values: Values,
    pub element_type: Option<String>,
}

/// A file that can be spoilt.
#[derive(Default)]
pub struct Raw {
    pub attributes: Vec<(&'static str, String)>,
    pub dimensions: Vec<(String, usize)>,
    pub arrays: Vec<Array>,
}

impl Raw {
    pub fn dimension(&mut self, name: &str, length: usize) {
        self.dimensions.push((name.into(), length));
    }

    pub fn array(&mut self, name: &str, dimensions: &[&str], values: Values) -> &mut Array {
        let dimensions = dimensions.iter().map(|d| d.to_string()).collect();
        self.arrays.push(Array { name: name.into(), dimensions, values, element_type: None });
        self.arrays.last_mut().unwrap()
    }

    pub fn get(&mut self, name: &str) -> &mut Array {
        self.arrays.iter_mut().find(|a| a.name == name).unwrap()
    }

    pub fn integers(&mut self, name: &str) -> &mut Vec<i32> {
        match &mut self.get(name).values {
            Values::Integers(values) => values,
            _ => panic!("{name} holds no integers"),
        }
    }

    pub fn reals(&mut self, name: &str) -> &mut Vec<f64> {
        match &mut self.get(name).values {
            Values::Reals(values) => values,
            _ => panic!("{name} holds no reals"),
        }
    }

    /// Takes arrays and dimensions of these names out of the file.
    pub fn remove(&mut self, names: &[&str]) {
        self.arrays.retain(|a| !names.contains(&a.name.as_str()));
        self.dimensions.retain(|(name, _)| !names.contains(&name.as_str()));
    }

    /// Three unit cubes along x, two in block 10 and one in block 4, with everything a mesh may have.
    pub fn cubes() -> Raw {
        let attributes = vec![("title", "cubes".into()), ("version", "8.03".into())];
        let mut raw = Raw { attributes, ..Raw::default() };
        for (name, length) in [("num_dim", 3), ("num_nodes", 16), ("num_elem", 3), ("num_el_blk", 2)] {
            raw.dimension(name, length);
        }
        let corner = |n: usize| [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)][n % 4];
        let node = |n: usize| [(n / 4) as f64, corner(n).0, corner(n).1];
        for (axis, name) in ["coordx", "coordy", "coordz"].iter().enumerate() {
            raw.array(name, &["num_nodes"], Values::Reals((0..16).map(|n| node(n)[axis]).collect()));
        }
        raw.array("eb_status", &["num_el_blk"], Values::Integers(vec![1, 1]));
        raw.array("eb_prop1", &["num_el_blk"], Values::Integers(vec![10, 4]));
        raw.block(1, "HEX8", 8, (1..=8).chain(5..=12).collect());
        raw.block(2, "HEX8", 8, (9..=16).collect());
        raw.array("node_num_map", &["num_nodes"], Values::Integers((101..=116).collect()));
        raw.array("elem_num_map", &["num_elem"], Values::Integers(vec![1001, 1002, 1003]));
        for (name, length) in [("num_node_sets", 2), ("num_nod_ns1", 4), ("num_nod_ns2", 1)] {
            raw.dimension(name, length);
        }
        raw.array("ns_status", &["num_node_sets"], Values::Integers(vec![1, 1]));
        raw.array("ns_prop1", &["num_node_sets"], Values::Integers(vec![31, 32]));
        raw.array("node_ns1", &["num_nod_ns1"], Values::Integers(vec![1, 2, 3, 4]));
        raw.array("node_ns2", &["num_nod_ns2"], Values::Integers(vec![16]));
        for (name, length) in [("num_side_sets", 2), ("num_side_ss1", 2), ("num_side_ss2", 1)] {
            raw.dimension(name, length);
        }
        raw.array("ss_status", &["num_side_sets"], Values::Integers(vec![1, 1]));
        raw.array("ss_prop1", &["num_side_sets"], Values::Integers(vec![200, 300]));
        raw.array("elem_ss1", &["num_side_ss1"], Values::Integers(vec![1, 3]));
        raw.array("side_ss1", &["num_side_ss1"], Values::Integers(vec![5, 6]));
        raw.array("elem_ss2", &["num_side_ss2"], Values::Integers(vec![2]));
        raw.array("side_ss2", &["num_side_ss2"], Values::Integers(vec![1]));
        raw
    }

    /// Adds a block at a one-based position.
    pub fn block(&mut self, n: usize, element_type: &str, nodes: usize, connectivity: Vec<i32>) {
        let dimensions = [format!("num_el_in_blk{n}"), format!("num_nod_per_el{n}")];
        self.dimension(&dimensions[0], connectivity.len() / nodes);
        self.dimension(&dimensions[1], nodes);
        let dimensions = [dimensions[0].as_str(), dimensions[1].as_str()];
        self.array(&format!("connect{n}"), &dimensions, Values::Integers(connectivity)).element_type =
            Some(element_type.into());
    }

    /// Puts one element of another type in the place of block 4.
    pub fn other_type(&mut self, element_type: &str, nodes: usize) {
        self.remove(&["connect2", "num_el_in_blk2", "num_nod_per_el2"]);
        self.block(2, element_type, nodes, (0..nodes as i32).map(|n| n % 16 + 1).collect());
    }

    /// Writes the file in the 64-bit offset container.
    pub fn write(&self, path: &Path) {
        let mut file = netcdf::create_with(path, netcdf::Options::_64BIT_OFFSET).unwrap();
        for (name, value) in &self.attributes {
            file.add_attribute(name, value.as_str()).unwrap();
        }
        for (name, length) in &self.dimensions {
            file.add_dimension(name, *length).unwrap();
        }
        for array in &self.arrays {
            let dimensions: Vec<&str> = array.dimensions.iter().map(String::as_str).collect();
            let mut variable = match array.values {
                Values::Integers(_) => file.add_variable::<i32>(&array.name, &dimensions),
                Values::Reals(_) => file.add_variable::<f64>(&array.name, &dimensions),
                Values::Text(_) => file.add_variable::<Character>(&array.name, &dimensions),
            }
            .unwrap();
            if let Some(element_type) = &array.element_type {
                variable.put_attribute("elem_type", element_type.as_str()).unwrap();
            }
        }
        file.enddef().unwrap();
        for array in &self.arrays {
            let mut variable = file.variable_mut(&array.name).unwrap();
            match &array.values {
                Values::Integers(values) => variable.put_values(values, ..).unwrap(),
                Values::Reals(values) => variable.put_values(values, ..).unwrap(),
                Values::Text(text) => {
                    let characters: Vec<Character> = text.bytes().map(Character).collect();
                    variable.put_values(&characters, ..).unwrap();
                }
            }
        }
    }
}
