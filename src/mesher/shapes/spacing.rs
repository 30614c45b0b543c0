//! Where the nodes along one direction of a shape stand: evenly, or in geometric progression.

/// Cells along one direction, before refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spacing {
    /// Number of cells n, at least 1.
    pub cells: usize,
    /// Grading g: length of the last cell divided by that of the first, > 0.
    pub grading: f64,
}

impl Spacing {
    /// The n·refine + 1 positions from exactly 0 to exactly 1.
    ///
    /// They are values of one smooth function, s(t) = (Gᵗ − 1)/(G − 1) with G = g^(n/(n−1)), so that the nodes of the
    /// unrefined shape are among those of every refined one.
    pub fn positions(&self, refine: usize) -> Vec<f64> {
        let n = self.cells as f64;
        let cells = self.cells * refine;
        let total = if self.cells > 1 { libm::pow(self.grading, n / (n - 1.0)) } else { 1.0 };
        (0..=cells)
            .map(|i| match i as f64 / cells as f64 {
                t if total == 1.0 || i == 0 || i == cells => t,
                t => (libm::pow(total, t) - 1.0) / (total - 1.0),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grading_is_the_ratio_of_the_last_cell_to_the_first() {
        let s = Spacing { cells: 5, grading: 3.0 }.positions(1);
        assert_eq!((s[0], s[5]), (0.0, 1.0));
        assert!(((s[5] - s[4]) / (s[1] - s[0]) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn refined_positions_contain_the_unrefined_ones() {
        let spacing = Spacing { cells: 4, grading: 0.2 };
        let (coarse, fine) = (spacing.positions(1), spacing.positions(3));
        assert!(coarse.iter().enumerate().all(|(i, s)| (fine[3 * i] - s).abs() < 1e-15));
    }
}
