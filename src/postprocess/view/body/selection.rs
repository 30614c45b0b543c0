//! Which elements of a body are drawn: those in a box, and those in which a variable is within a range.

use super::field::{Field, Place};
use crate::postprocess::view::ViewError;

/// A variable and the range that its values are to be in.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    /// The variable.
    pub field: Field,
    /// The ends of the range, which belong to it.
    pub range: (f64, f64),
}

/// Keeps the elements whose centre, the mean of their corners, lies in a box.
pub fn in_region(elements: &mut Vec<usize>, all: &[&[u32]], positions: &[[f64; 3]], region: &[Option<(f64, f64)>; 3]) {
    let centre = |element: usize, axis: usize| mean(all[element], |node| positions[node as usize][axis]);
    let inside = |element: usize| {
        let mut sides = region.iter().enumerate().filter_map(|(axis, ends)| Some((axis, (*ends)?)));
        sides.all(|(axis, ends)| within(centre(element, axis), ends))
    };
    elements.retain(|&element| inside(element));
}

/// Keeps the elements whose value is in the range; that of nodes is the mean of the corners. No number is in no range.
pub fn by_value(elements: &mut Vec<usize>, all: &[&[u32]], values: &[f64], criterion: &Criterion) {
    let value = |element: usize| match criterion.field.place {
        Place::Elements => values[element],
        Place::Nodes => mean(all[element], |node| values[node as usize]),
    };
    elements.retain(|&element| within(value(element), criterion.range));
}

/// Why criteria cannot be judged on a mesh alone.
pub fn needs_a_state(criterion: &Criterion) -> ViewError {
    let expected = "a state of results: a mesh has no values";
    ViewError::option("condition on what is drawn", format!("one on {}", criterion.field.label), expected)
}

fn within(value: f64, (low, high): (f64, f64)) -> bool {
    value >= low && value <= high
}

fn mean(nodes: &[u32], value: impl Fn(u32) -> f64) -> f64 {
    nodes.iter().map(|&node| value(node)).sum::<f64>() / nodes.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn centres_and_means_decide() {
        let (first, second) = ([0, 1], [1, 2]);
        let all: Vec<&[u32]> = vec![&first, &second];
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, f64::NAN]];
        let kept = |region| {
            let mut elements = vec![0, 1];
            in_region(&mut elements, &all, &positions, &region);
            elements
        };
        assert_eq!(kept([None; 3]), [0, 1]);
        assert_eq!(kept([Some((0.5, 1.9)), None, None]), [0]);
        assert_eq!(kept([Some((0.6, f64::INFINITY)), None, None]), [1]);
        // What has no place in space is in no box.
        assert_eq!(kept([None, None, Some((-1.0, 1.0))]), [0]);
        let field = |place| Field { label: "V".into(), place, names: vec!["V".into()], odd: [false; 3] };
        let by = |place, values: &[f64]| {
            let mut elements = vec![0, 1];
            by_value(&mut elements, &all, values, &Criterion { field: field(place), range: (2.0, 3.0) });
            elements
        };
        assert_eq!(by(Place::Elements, &[3.0, f64::NAN]), [0]);
        assert_eq!(by(Place::Nodes, &[0.0, 2.0, 4.0]), [1]);
    }
}
