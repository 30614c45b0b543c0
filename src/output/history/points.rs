//! Points of the material: what happens in the elements that they lie in.
//!
//! Each rank finds the watched elements that it computes; rank 0 puts the values in the order of the points. In the file
//! they are global variables, named after the plot variables with the number of the point: SIGZZ_1.

use crate::comm::Communicator;
use crate::mesh::{Block, Dimension, Mesh, locate::locate};
use crate::model::{ElementField, Model, NodalField};
use crate::output::fields::FieldList;
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::{Solver, nodes};

/// Element variables of a history.
const ELEMENT_FIELDS: [ElementField; 6] = [
    ElementField::Stress,
    ElementField::Strain,
    ElementField::Pressure,
    ElementField::VonMises,
    ElementField::Energy,
    ElementField::Density,
];

/// What there is to know about the points before the run; the same on all ranks.
#[derive(Debug, Clone)]
pub struct Points {
    points: Vec<Point>,
}

#[derive(Debug, Clone)]
struct Point {
    position: [f64; 3],
    /// Zero-based element of the mesh, and its number in the file.
    element: u32,
    element_id: i64,
    block: usize,
    block_id: i64,
    fields: FieldList,
}

impl Points {
    /// Finds the elements of the model's points.
    pub fn new(mesh: &Mesh, model: &Model, solver: &Solver) -> Points {
        let point = |&position: &[f64; 3]| {
            let element = locate(mesh, position)?.element;
            let (block, _) = mesh.elements().nth(element as usize)?;
            let block_id = mesh.blocks[block].id;
            let material = model.materials.iter().find(|material| material.block == block_id)?;
            let state = material.law.entry().state.iter().map(|variable| variable.name.to_string()).collect();
            let element_id = mesh.element_ids[element as usize];
            let layered = solver.domain.layered[block];
            let fields = FieldList::of_element(ELEMENT_FIELDS.to_vec(), state, Dimension::Three, layered);
            Some(Point { position, element, element_id, block, block_id, fields })
        };
        Points { points: model.material_points.iter().filter_map(point).collect() }
    }

    /// Whether no point is watched.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Where the acceleration stands among the values of a point.
    pub fn acceleration(&self, point: usize) -> usize {
        self.points.get(point).map_or(0, |point| point.count() - 3)
    }

    /// Names of the variables, point by point: displacement and velocity of the element's centre, then its own, then the
    /// centre's acceleration.
    pub fn names(&self) -> Vec<String> {
        let motion = [NodalField::Displacement, NodalField::Velocity].map(|field| field.components()).concat();
        let of_point = |(i, point): (usize, &Point)| {
            let names = motion.iter().map(|name| name.to_string()).chain(point.fields.element_names());
            let names = names.chain(NodalField::Acceleration.components().iter().map(|name| name.to_string()));
            names.map(|name| format!("{name}_{}", i + 1)).collect::<Vec<_>>()
        };
        self.points.iter().enumerate().flat_map(of_point).collect()
    }

    /// One line per point for the records: where it is, and in which element.
    pub fn records(&self) -> Vec<String> {
        let record = |(i, p): (usize, &Point)| {
            let [x, y, z] = p.position;
            format!("MATERIAL POINT {} AT {x} {y} {z}: ELEMENT {} OF BLOCK {}", i + 1, p.element_id, p.block_id)
        };
        self.points.iter().enumerate().map(record).collect()
    }

    /// A mesh of nothing but the watched elements, to show where they are.
    pub fn mesh(&self, whole: &Mesh) -> Mesh {
        let mut elements: Vec<(usize, u32, i64)> =
            self.points.iter().map(|point| (point.block, point.element, point.element_id)).collect();
        elements.sort_unstable();
        elements.dedup();
        let all = whole.connectivity();
        let mut used: Vec<u32> = elements.iter().flat_map(|e| &all[e.1 as usize]).copied().collect();
        used.sort_unstable();
        used.dedup();
        let place = |node: u32| used.binary_search(&node).unwrap_or(0) as u32;
        let blocks = elements.chunk_by(|a, b| a.0 == b.0).map(|group| Block {
            id: whole.blocks[group[0].0].id,
            name: whole.blocks[group[0].0].name.clone(),
            shape: whole.blocks[group[0].0].shape,
            nodes: group.iter().flat_map(|e| &all[e.1 as usize]).map(|&node| place(node)).collect(),
            attributes: Vec::new(),
        });
        Mesh {
            title: whole.title.clone(),
            dimension: whole.dimension,
            blocks: blocks.collect(),
            coordinates: used.iter().map(|&node| whole.coordinates[node as usize]).collect(),
            node_ids: used.iter().map(|&node| whole.node_ids[node as usize]).collect(),
            element_ids: elements.iter().map(|e| e.2).collect(),
            qa: whole.qa.clone(),
            ..Mesh::default()
        }
    }

    /// Values of each point in the order of [`Points::names`], with room for the acceleration, on rank 0; `None` on the
    /// others.
    pub fn values(&self, solver: &Solver, comm: &mut dyn Communicator) -> Option<Vec<Vec<f64>>> {
        let mut own = Vec::new();
        for (i, point) in self.points.iter().enumerate() {
            if let Some(values) = point.values(solver, comm.rank()) {
                own.extend((i as u64).to_ne_bytes());
                own.extend(values.iter().flat_map(|value| value.to_ne_bytes()));
            }
        }
        let parts = comm.gather(own)?;
        let mut values: Vec<Vec<f64>> = self.points.iter().map(|point| vec![0.0; point.count()]).collect();
        for part in parts {
            let mut words = part.chunks_exact(8).map(|word| word.try_into().unwrap_or([0; 8]));
            while let Some(place) = words.next().map(|word| u64::from_ne_bytes(word) as usize) {
                let Some(values) = values.get_mut(place) else { break };
                values.iter_mut().zip(&mut words).for_each(|(value, word)| *value = f64::from_ne_bytes(word));
            }
        }
        Some(values)
    }
}

impl Point {
    fn count(&self) -> usize {
        6 + self.fields.element_names().len() + 3
    }

    /// The point's values, where this rank computes its element.
    fn values(&self, solver: &Solver, rank: usize) -> Option<Vec<f64>> {
        let place = solver.domain.element_file.iter().position(|&file| file == self.element)? as u32;
        let (block, group, i) = find(solver, place)?;
        let mut values = vec![0.0; 6];
        let nodes = group.nodes(i);
        let count = nodes.len() as f64;
        for node in nodes {
            let (x, initial) = (solver.domain.nodes.position(node), solver.domain.nodes.initial(node));
            let motion = [nodes::subtract(x, initial), solver.velocity_now(node)].concat();
            values.iter_mut().zip(motion).for_each(|(value, part)| *value += part / count);
        }
        if group.is_alive(i) {
            self.fields.element_point(solver, block, group, i, rank, &mut values);
        }
        values.resize(self.count(), 0.0);
        Some(values)
    }
}

fn find(solver: &Solver, place: u32) -> Option<(&ElementBlock, &Group, usize)> {
    solver.domain.blocks.iter().find_map(|block| {
        block.groups().into_iter().find_map(|group| {
            let i = group.places.iter().position(|&p| p == place)?;
            Some((block, group, i))
        })
    })
}
