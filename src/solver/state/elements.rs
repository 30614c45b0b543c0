//! The state of elements, row by row.

use crate::lanes::CHUNK;
use crate::restart::Archive;
use crate::solver::elements::hex8::rows;
use crate::solver::elements::{ElementBlock, Group};

/// Names of the rows that every element has, in their order: stress and stretch in the element's frame, the frame,
/// hourglass resistances, energies, and the viscous stress.
const NAMES: [&str; rows::LAW] = [
    "USIGXX", "USIGYY", "USIGZZ", "USIGXY", "USIGYZ", "USIGZX", "USTRXX", "USTRYY", "USTRZZ", "USTRXY", "USTRYZ",
    "USTRZX", "FRAME0", "FRAME1", "FRAME2", "FRAME3", "HGX1", "HGX2", "HGX3", "HGX4", "HGY1", "HGY2", "HGY3", "HGY4",
    "HGZ1", "HGZ2", "HGZ3", "HGZ4", "EINTERN", "EHOURGL", "EVISCOUS", "BULKQ",
];

/// Visits the rows of all elements, those of laws by their names: `law_states` are the names of all laws of the model, and
/// `count` is the number of local elements.
pub(super) fn visit(archive: &mut dyn Archive, blocks: &mut [ElementBlock], law_states: &[&str], count: usize) {
    for (row, name) in NAMES.into_iter().enumerate() {
        visit_row(archive, blocks, name, count, |_| Some(row));
    }
    for name in law_states {
        let place = |block: &ElementBlock| block.state_names.iter().position(|known| known == name);
        visit_row(archive, blocks, name, count, |block| place(block).map(|place| rows::LAW + place));
    }
}

/// Visits one row of each block, `None` where a block has none.
fn visit_row(
    archive: &mut dyn Archive,
    blocks: &mut [ElementBlock],
    name: &str,
    count: usize,
    row: impl Fn(&ElementBlock) -> Option<usize>,
) {
    let mut values = vec![0.0; count];
    for block in blocks.iter() {
        let Some(row) = row(block) else { continue };
        for group in block.groups() {
            for (i, &place) in group.places.iter().enumerate() {
                values[place as usize] = group.value(i, row);
            }
        }
    }
    archive.element(name, &mut values);
    if !archive.loading() {
        return;
    }
    for block in blocks {
        let Some(row) = row(block) else { continue };
        block.border.set_row(row, &values);
        block.interior.set_row(row, &values);
    }
}

impl Group {
    /// Sets one stored number of every element, given by the element's place in the rank's order.
    fn set_row(&mut self, row: usize, values: &[f64]) {
        // Places, nodes and masses are of the problem and its cut; which are gone has been put back before.
        let Group { places, connectivity, mass: _, state, stride, gone: _ } = self;
        let Some(&last) = places.last() else { return };
        // Lanes that fill up the last chunk copy its last element.
        for slot in 0..connectivity.len() * CHUNK {
            let place = places.get(slot).copied().unwrap_or(last);
            state[slot / CHUNK * *stride + row].0[slot % CHUNK] = values[place as usize];
        }
    }
}
