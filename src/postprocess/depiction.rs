//! What pictures need to know of a deck beyond its results: rigid planes, and how thick shells and bars are.
//!
//! A run writes it as comments behind the deck into the records of its results, and who draws reads it there. Ten digits are
//! enough for a picture.

use crate::common::vector::unit;

/// How such a line begins.
const MARK: &str = "$ DRAWN: ";

/// What is told.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Depiction {
    /// Rigid planes, in the order of the deck.
    pub planes: Vec<RigidPlane>,
    /// Thickness of shells or radius of bars, lengths, by the number of their block.
    pub sizes: Vec<(i64, f64)>,
}

/// A plane that the nodes of a side set cannot cross.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidPlane {
    /// Number of the side set.
    pub side_set: i64,
    /// A point of the plane.
    pub point: [f64; 3],
    /// Unit normal, towards the body.
    pub normal: [f64; 3],
}

impl Depiction {
    /// As lines of a deck that say nothing to who runs it.
    pub fn lines(&self) -> Vec<String> {
        let vector = |[x, y, z]: [f64; 3]| format!("{x:.9e} {y:.9e} {z:.9e}");
        let planes = self.planes.iter().flat_map(|plane| {
            // Each line fits a record of eighty letters.
            [
                format!("{MARK}PLANE {} {}", plane.side_set, vector(plane.point)),
                format!("{MARK}NORMAL {}", vector(plane.normal)),
            ]
        });
        let sizes = self.sizes.iter().map(|(block, size)| format!("{MARK}SIZE {block} {size:.9e}"));
        planes.chain(sizes).collect()
    }

    /// Finds these lines among others; what cannot be read is passed over.
    pub fn read(lines: &[String]) -> Depiction {
        let mut told = Depiction::default();
        let mut point = None;
        for line in lines.iter().filter_map(|line| line.strip_prefix(MARK)) {
            let mut words = line.split_whitespace();
            let kind = words.next().unwrap_or_default();
            let id = if kind == "NORMAL" { None } else { words.next().and_then(|word| word.parse::<i64>().ok()) };
            let numbers: Vec<f64> =
                words.filter_map(|word| word.parse().ok()).filter(|x: &f64| x.is_finite()).collect();
            match (kind, id, numbers.as_slice()) {
                ("PLANE", Some(side_set), &[x, y, z]) => point = Some((side_set, [x, y, z])),
                ("NORMAL", _, &[x, y, z]) => {
                    if let (Some((side_set, point)), Some(normal)) = (point.take(), unit([x, y, z])) {
                        told.planes.push(RigidPlane { side_set, point, normal });
                    }
                }
                ("SIZE", Some(block), &[size]) if size > 0.0 => told.sizes.push((block, size)),
                _ => (),
            }
        }
        told
    }

    /// The lines of a deck without these.
    pub fn without(lines: Vec<String>) -> Vec<String> {
        lines.into_iter().filter(|line| !line.starts_with(MARK)).collect()
    }

    /// Size of a block, if it is told.
    pub fn size(&self, block: i64) -> Option<f64> {
        self.sizes.iter().find(|(id, _)| *id == block).map(|(_, size)| *size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_is_read_among_the_lines_of_a_deck() {
        let plane = RigidPlane { side_set: 100, point: [-1.5e-3, 0.0, 123_456.0], normal: [0.0, -1.0, 0.0] };
        let told = Depiction { planes: vec![plane], sizes: vec![(7, 1e-3)] };
        let lines = told.lines();
        assert!(lines.iter().all(|line| line.len() <= 80), "{lines:?}");
        let deck = ["TITLE", "$ DRAWN: NONSENSE", "$ DRAWN: PLANE 3 x", "EXIT"].map(String::from).to_vec();
        let all = [deck, lines].concat();
        assert_eq!(Depiction::read(&all), told);
        assert_eq!(Depiction::without(all), ["TITLE", "EXIT"]);
        assert_eq!((told.size(7), told.size(8)), (Some(1e-3), None));
    }
}
