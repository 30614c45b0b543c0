//! What refinement says of the finest mesh: Richardson's extrapolation with the observed order of convergence, and the grid
//! convergence index (Roache 1994).

/// Orders of convergence that are believed; elements and steps here are of second order where nothing shocks or slides.
const ORDERS: [f64; 2] = [0.3, 4.0];
/// Factors of safety of the grid convergence index: with an observed order, and with one that is taken for granted.
const SAFETY: [f64; 2] = [1.25, 3.0];
/// Order that is taken for granted where there are but two meshes: the lowest that first-order fronts and contact have.
const TAKEN: f64 = 1.0;

/// What a quantity does under refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Refinement {
    /// There is but one mesh.
    Unknown,
    /// It goes towards a value.
    Converges {
        /// That value.
        limit: f64,
        /// The order with which it does so, and whether it was observed: with two meshes it is not.
        order: f64,
        /// Whether the order was observed.
        observed: bool,
        /// Bound on the error of the finest mesh, the grid convergence index times the value.
        finest: f64,
    },
    /// It does not, as far as these meshes show: the last change, which is the least that can be wrong.
    Wanders {
        /// Difference of the two finest.
        change: f64,
    },
}

/// What the values of a quantity on meshes so many times finer say; ascending, the given mesh (1) first. `scatter` is the part of a
/// difference that says nothing.
pub fn refinement(values: &[(f64, f64)], scatter: f64) -> Refinement {
    match values {
        [.., (r1, f1), (r2, f2), (r3, f3)] => {
            let [first, second] = [f2 - f1, f3 - f2];
            if second.abs() <= scatter {
                let finest = scatter.max(f64::MIN_POSITIVE);
                return Refinement::Converges { limit: *f3, order: f64::NAN, observed: false, finest };
            }
            match order([*r1, *r2, *r3], first / second) {
                Some(order) => converges(*f3, second, (r3 / r2).powf(order) - 1.0, order, true),
                None => Refinement::Wanders { change: second.abs() },
            }
        }
        [(r1, f1), (r2, f2)] => converges(*f2, f2 - f1, (r2 / r1).powf(TAKEN) - 1.0, TAKEN, false),
        _ => Refinement::Unknown,
    }
}

fn converges(finest: f64, change: f64, divisor: f64, order: f64, observed: bool) -> Refinement {
    let safety = SAFETY[usize::from(!observed)];
    let left = change / divisor;
    Refinement::Converges { limit: finest + left, order, observed, finest: safety * left.abs() }
}

/// The order p for which differences have the ratio (r₁⁻ᵖ − r₂⁻ᵖ)/(r₂⁻ᵖ − r₃⁻ᵖ); `None` where no order that is believed has it.
fn order([r1, r2, r3]: [f64; 3], ratio: f64) -> Option<f64> {
    let of = |p: f64| (r1.powf(-p) - r2.powf(-p)) / (r2.powf(-p) - r3.powf(-p));
    let [mut low, mut high] = ORDERS;
    if !ratio.is_finite() || ratio < of(low) {
        return None;
    }
    if ratio > of(high) {
        return Some(high);
    }
    // The ratio grows with the order.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of(middle) < ratio { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_of_the_mesh_width_is_found_again() {
        for (p, ratios) in [(1.0, [1.0, 2.0, 3.0]), (2.0, [1.0, 2.0, 4.0]), (1.5, [1.0, 2.0, 3.0])] {
            let values = ratios.map(|r: f64| (r, 7.0 + 0.5 * r.powf(-p)));
            let Refinement::Converges { limit, order, observed: true, finest } = refinement(&values, 0.0) else {
                panic!("it converges")
            };
            assert!((limit - 7.0).abs() < 1e-12 && (order - p).abs() < 1e-12);
            assert!((finest - 1.25 * 0.5 * ratios[2].powf(-p)).abs() < 1e-12);
        }
    }

    #[test]
    fn what_grows_or_turns_does_not_converge() {
        for wandering in [[1.0, 2.0, 4.0], [1.0, 2.0, 1.5]] {
            let values = [(1.0, wandering[0]), (2.0, wandering[1]), (4.0, wandering[2])];
            assert!(matches!(refinement(&values, 0.0), Refinement::Wanders { .. }), "{wandering:?}");
        }
        // A difference as small as the scatter says nothing against it.
        assert!(matches!(refinement(&[(1.0, 1.0), (2.0, 2.0), (4.0, 2.1)], 0.2), Refinement::Converges { .. }));
        // Two meshes take the first order for granted, and three times the difference for the bound.
        let two = refinement(&[(1.0, 1.0), (2.0, 2.0)], 0.0);
        assert_eq!(two, Refinement::Converges { limit: 3.0, order: 1.0, observed: false, finest: 3.0 });
        assert_eq!(refinement(&[(1.0, 1.0)], 0.0), Refinement::Unknown);
    }
}
