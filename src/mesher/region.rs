//! Where a node may lie to belong to a set: on a plane, an edge, in a box, on a cylinder or a sphere.

use super::distance;

/// A part of space. All are closed, and widened by a tolerance when asked about a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Region {
    /// Given values of some of the coordinates: one makes a plane, two an edge, three a point.
    Coordinates([Option<f64>; 3]),
    /// The plane through a point across a unit vector.
    Plane {
        /// A point of the plane.
        point: [f64; 3],
        /// Unit normal.
        normal: [f64; 3],
    },
    /// Coordinates between bounds, which may be infinite.
    Box {
        /// Lower bounds.
        low: [f64; 3],
        /// Upper bounds.
        high: [f64; 3],
    },
    /// The surface of a circular cylinder parallel to an axis.
    Cylinder {
        /// 0, 1 or 2 for x, y or z.
        axis: usize,
        /// Radius.
        radius: f64,
        /// A point of the centre line.
        centre: [f64; 3],
    },
    /// The surface of a sphere.
    Sphere {
        /// Radius.
        radius: f64,
        /// Centre.
        centre: [f64; 3],
    },
}

impl Region {
    /// Whether a point lies in the region, to the tolerance.
    pub fn contains(&self, x: [f64; 3], tolerance: f64) -> bool {
        self.distance(x) <= tolerance
    }

    /// How far a point is from the region; in a box, and for several coordinates, the largest of the distances.
    pub fn distance(&self, x: [f64; 3]) -> f64 {
        let largest = |distances: [f64; 3]| distances.into_iter().fold(0.0, f64::max);
        match self {
            Region::Coordinates(values) => largest([0, 1, 2].map(|i| values[i].map_or(0.0, |v| (x[i] - v).abs()))),
            Region::Plane { point, normal } => (0..3).map(|i| normal[i] * (x[i] - point[i])).sum::<f64>().abs(),
            Region::Box { low, high } => largest([0, 1, 2].map(|i| (low[i] - x[i]).max(x[i] - high[i]))),
            Region::Cylinder { axis, radius, centre } => {
                let mut across = x;
                across[*axis] = centre[*axis];
                (distance(across, *centre) - radius).abs()
            }
            Region::Sphere { radius, centre } => (distance(x, *centre) - radius).abs(),
        }
    }
}
