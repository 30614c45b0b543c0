//! Bodies of revolution: the section of a two-dimensional mesh turned about its y axis, which then points up.

use super::scene::{Scene, Values};

/// Degrees between two sections of a turned body, at most.
const FINEST: f64 = 7.5;

/// An angle that a section is turned by, so that it lies open towards the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// Where it begins, degrees from the x axis.
    pub from: f64,
    /// How far it goes, degrees, 360 at most.
    pub angle: f64,
}

impl Turn {
    /// The turn by an angle whose gap is in the middle of the side from which the eye looks.
    pub fn open_to(azimuth: f64, angle: f64) -> Turn {
        Turn { from: azimuth + 0.5 * (360.0 - angle), angle }
    }
}

/// The body that a section sweeps. `section` holds its elements as faces in the x-y plane; `rim` its edges, each a-b-b-a with
/// the outside to the right of a-b, coloured by `rim_values`.
pub fn revolve(section: &Scene, rim: &[[u32; 4]], rim_values: &Values, turn: Turn) -> Scene {
    let count = section.positions.len();
    let steps = (turn.angle / FINEST).ceil().max(1.0) as usize;
    let closed = turn.angle >= 360.0;
    let rings = if closed { steps } else { steps + 1 };
    let node = |ring: usize, node: u32| (ring % rings * count) as u32 + node;
    let mut scene = Scene {
        positions: Vec::with_capacity(rings * count),
        quads: Vec::new(),
        values: empty(&section.values),
        seams: Vec::new(),
        vectors: Vec::new(),
    };
    for ring in 0..rings {
        let angle = (turn.from + turn.angle * ring as f64 / steps as f64).to_radians();
        let (c, s) = (libm::cos(angle), libm::sin(angle));
        let around = |&[x, y, _]: &[f64; 3]| [x * c, x * s, y];
        scene.positions.extend(section.positions.iter().map(around));
        // A vector has two components in the section.
        scene.vectors.extend(section.vectors.iter().map(around));
    }
    if !closed {
        // Seen in the section, faces look backwards.
        scene.quads.extend(section.quads.iter().map(|quad| quad.map(|n| node(0, n))));
        append(&mut scene.values, &section.values);
        let last = |&[a, b, c, d]: &[u32; 4]| [d, c, b, a].map(|n| node(steps, n));
        scene.quads.extend(section.quads.iter().map(last));
        append(&mut scene.values, &section.values);
    }
    let on_axis = |n: u32| section.positions[n as usize][0].abs() == 0.0;
    let kept: Vec<usize> = (0..rim.len()).filter(|&i| !(on_axis(rim[i][0]) && on_axis(rim[i][1]))).collect();
    let values = chosen(rim_values, &kept);
    for step in 0..steps {
        let strip = |&i: &usize| {
            let [a, b, ..] = rim[i];
            [node(step, b), node(step, a), node(step + 1, a), node(step + 1, b)]
        };
        scene.quads.extend(kept.iter().map(strip));
        append(&mut scene.values, &values);
    }
    if let (Values::Nodes(all), Values::Nodes(own)) = (&mut scene.values, &section.values) {
        *all = (0..rings).flat_map(|_| own.iter().copied()).collect();
    }
    scene
}

fn empty(values: &Values) -> Values {
    match values {
        Values::Nodes(_) => Values::Nodes(Vec::new()),
        Values::Faces(_) => Values::Faces(Vec::new()),
        Values::Blocks(_) => Values::Blocks(Vec::new()),
    }
}

/// Adds the values of more faces.
fn append(values: &mut Values, more: &Values) {
    match (values, more) {
        (Values::Faces(values), Values::Faces(more)) => values.extend(more),
        (Values::Blocks(values), Values::Blocks(more)) => values.extend(more),
        _ => (),
    }
}

/// The values of some faces.
fn chosen(values: &Values, kept: &[usize]) -> Values {
    match values {
        Values::Nodes(_) => Values::Nodes(Vec::new()),
        Values::Faces(values) => Values::Faces(kept.iter().map(|&i| values[i]).collect()),
        Values::Blocks(blocks) => Values::Blocks(kept.iter().map(|&i| blocks[i]).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square section that touches the axis: its outside is a cylinder that is cut open.
    #[test]
    fn a_square_becomes_a_cylinder_that_faces_outwards() {
        let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let section = Scene {
            positions,
            quads: vec![[0, 1, 2, 3]],
            values: Values::Faces(vec![5.0]),
            seams: Vec::new(),
            vectors: Vec::new(),
        };
        let rim = [[0, 1, 1, 0], [1, 2, 2, 1], [2, 3, 3, 2], [3, 0, 0, 3]];
        let body = revolve(&section, &rim, &Values::Faces(vec![1.0, 2.0, 3.0, 4.0]), Turn { from: 0.0, angle: 270.0 });
        assert_eq!(body.quads.len(), 2 + 36 * 3);
        let Values::Faces(values) = &body.values else { panic!("values of faces") };
        assert_eq!((values.len(), values[..5].to_vec()), (body.quads.len(), vec![5.0, 5.0, 1.0, 2.0, 3.0]));
        let out = body.normal(&body.quads[3]);
        assert!(out[0] > 0.99 && out[2].abs() < 1e-12, "{out:?}");
        assert!(body.normal(&body.quads[0])[1] < -0.99 && body.normal(&body.quads[2])[2] < -0.99);
        let closed = revolve(&section, &rim, &Values::Faces(vec![1.0; 4]), Turn { from: 0.0, angle: 360.0 });
        assert_eq!((closed.quads.len(), closed.positions.len()), (48 * 3, 48 * 4));
    }
}
