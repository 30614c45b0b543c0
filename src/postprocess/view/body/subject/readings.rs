//! What is read of a state for a subject: where its nodes are, the field that colours it, and its arrows.

use super::{Face, Subject};
use crate::common::vector::dot;
use crate::exodus::ResultsError;
use crate::postprocess::view::ViewError;
use crate::postprocess::view::body::field::{Field, Place};
use crate::postprocess::view::body::scene::Values;
use crate::postprocess::view::body::section::Between;

impl Subject<'_> {
    /// Node positions with the displacement, as many times as asked for.
    pub(super) fn positions(&self, state: Option<usize>) -> Result<Vec<[f64; 3]>, ViewError> {
        let mut positions = self.mesh.coordinates.to_vec();
        if let (Some(names), Some(state)) = (&self.displacement, state) {
            for (axis, name) in names.iter().enumerate() {
                for (position, displacement) in positions.iter_mut().zip(self.read(Place::Nodes, name, state)?) {
                    position[axis] += self.options.magnify * displacement;
                }
            }
        }
        Ok(positions)
    }

    /// A variable's values in a state, as many as there are nodes or elements.
    pub(super) fn read(&self, place: Place, name: &str, state: usize) -> Result<Vec<f64>, ViewError> {
        let (values, expected) = match place {
            Place::Nodes => (self.results.nodal(name, state)?, self.mesh.coordinates.len()),
            Place::Elements => (self.results.element(name, state)?, self.mesh.element_count()),
        };
        if values.len() == expected {
            return Ok(values);
        }
        let what = format!("{name} has {} values where {expected} belong", values.len());
        Err(ResultsError::Unusable { path: self.path.clone(), what }.into())
    }

    /// The values of a field in a state, one per node or element; of a vector its length.
    pub(super) fn values_of(&self, field: &Field, state: usize) -> Result<Vec<f64>, ViewError> {
        let read = |name: &String| self.read(field.place, name, state);
        let components = field.names.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        Ok(match components.as_slice() {
            [x, y, z] => (0..x.len()).map(|i| dot([x[i], y[i], z[i]], [x[i], y[i], z[i]]).sqrt()).collect(),
            [x, y] => x.iter().zip(y).map(|(x, y)| (x * x + y * y).sqrt()).collect(),
            _ => components.into_iter().next().unwrap_or_default(),
        })
    }

    pub(super) fn values(&self, skin: &[Face], made: &[Between], state: Option<usize>) -> Result<Values, ViewError> {
        let (Some(field), Some(state)) = (&self.field, state) else {
            let block_of: Vec<usize> = self.mesh.elements().map(|(block, _)| block).collect();
            return Ok(Values::Blocks(skin.iter().map(|face| block_of[face.element]).collect()));
        };
        let mut values = self.values_of(field, state)?;
        Ok(match field.place {
            Place::Nodes if field.is_status() => {
                extend(&mut values, made);
                // Faces have been divided among their corners.
                Values::Faces(skin.iter().map(|face| values[face.nodes[0] as usize].round()).collect())
            }
            Place::Nodes => {
                extend(&mut values, made);
                Values::Nodes(values)
            }
            Place::Elements => Values::Faces(skin.iter().map(|face| values[face.element]).collect()),
        })
    }
    /// The vector at each node and each point made; nothing where no arrows are drawn.
    pub(super) fn vectors(&self, made: &[Between], state: Option<usize>) -> Result<Vec<[f64; 3]>, ViewError> {
        let (Some(names), Some(state)) = (&self.arrows, state) else { return Ok(Vec::new()) };
        let read = |name: &String| {
            self.read(Place::Nodes, name, state).map(|mut values| {
                extend(&mut values, made);
                values
            })
        };
        let parts = names.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let count = parts.first().map_or(0, Vec::len);
        let part = |axis: usize, node: usize| parts.get(axis).map_or(0.0, |part| part[node]);
        Ok((0..count).map(|node| [0, 1, 2].map(|axis| part(axis, node))).collect())
    }
}

/// Gives the points made their values, between those of their ends.
fn extend(values: &mut Vec<f64>, made: &[Between]) {
    for Between { ends: [a, b], part } in made {
        let (from, to) = (values[*a as usize], values[*b as usize]);
        values.push(from + part * (to - from));
    }
}
