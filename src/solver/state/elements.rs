//! The state of elements, row by row.

use crate::lanes::CHUNK;
use crate::restart::Archive;
use crate::solver::elements::{ElementBlock, Group};

/// A row of an element, and whether its numbers or their bits are kept, as whole numbers.
#[derive(Clone, Copy)]
enum Place {
    Number(usize),
    Bits(usize),
}

/// Visits the rows of all elements by their names: `rows` are the names of all that the model's elements store, `law_states`
/// those that its laws store, `points` those of points of integration, and `count` is the number of local elements.
pub(super) fn visit(
    archive: &mut dyn Archive,
    blocks: &mut [ElementBlock],
    [rows, law_states]: [&[&str]; 2],
    points: &[String],
    count: usize,
) {
    for name in rows {
        let place = |block: &ElementBlock| {
            let own = block.element.entry().rows.iter().position(|row| row.name == *name).map(Place::Number);
            let carried = || block.element.carried().iter().position(|known| known == name);
            own.or_else(|| carried().map(|k| Place::Bits(block.first_of_point(block.element.points()) + k)))
        };
        visit_row(archive, blocks, name, count, place);
    }
    for name in law_states {
        let place = |block: &ElementBlock| {
            let place = block.state_names.iter().position(|known| known == name)?;
            block.element.entry().points.is_none().then(|| Place::Number(block.first_of_law(0) + place))
        };
        visit_row(archive, blocks, name, count, place);
    }
    for name in points {
        visit_row(archive, blocks, name, count, |block| point_row(block, name).map(Place::Number));
    }
}

/// Place among the stored numbers of a block's elements of what a point of integration stores under a name.
fn point_row(block: &ElementBlock, name: &str) -> Option<usize> {
    let (name, number) = name.rsplit_once('.')?;
    let point = number.parse::<usize>().ok()?.checked_sub(1)?;
    let entry = block.element.entry().points.as_ref().filter(|_| point < block.element.points())?;
    let mut names = entry.rows.iter().map(|row| row.name).chain(block.state_names.iter().copied());
    names.position(|known| known == name).map(|place| block.first_of_point(point) + place)
}

/// Visits one row of each block, `None` where a block has none.
fn visit_row(
    archive: &mut dyn Archive,
    blocks: &mut [ElementBlock],
    name: &str,
    count: usize,
    row: impl Fn(&ElementBlock) -> Option<Place>,
) {
    let mut values = vec![0.0; count];
    for block in blocks.iter() {
        let Some(row) = row(block) else { continue };
        for group in block.groups() {
            for (i, &place) in group.places.iter().enumerate() {
                values[place as usize] = match row {
                    Place::Number(row) => group.value(i, row),
                    Place::Bits(row) => f64::from(group.bits(i, row)),
                };
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
    fn set_row(&mut self, row: Place, values: &[f64]) {
        // Places, nodes and masses are of the problem and its cut; which are gone has been put back before,
        // and steps are put back by who wants them.
        let Group {
            places,
            mass,
            state: _,
            single: _,
            stride: _,
            moving: _,
            least_share: _,
            corners: _,
            unknowns: _,
            connectivity: _,
            far: _,
            gone: _,
            steps: _,
        } = self;
        let (Some(&last), lanes) = (places.last(), mass.len() * CHUNK) else { return };
        // Lanes that fill up the last chunk copy its last element.
        for slot in 0..lanes {
            let place = self.places.get(slot).copied().unwrap_or(last);
            let value = values[place as usize];
            match row {
                Place::Number(row) => self.put(slot, row, value),
                Place::Bits(row) => self.put_bits(slot, row, value as u32),
            }
        }
    }
}
