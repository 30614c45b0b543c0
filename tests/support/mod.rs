//! What the verification tests share: meshes made in code, decks run through the library, and the numbers they leave.
#![allow(dead_code)]

pub mod bodies;
pub mod collapsed;
pub mod continued;
pub mod flow;
pub mod gas;
pub mod joined_scenes;
pub mod meshes;
pub mod momentum;
pub mod penetration;
pub mod run;
pub mod scenes;
pub mod shell_scenes;
pub mod stiffness;
pub mod surfaces;

/// Asserts that `value` is within `tolerance` (relative) of `expected`, and prints the line that docs/verification.md
/// quotes.
#[track_caller]
pub fn close(case: &str, quantity: &str, value: f64, expected: f64, tolerance: f64) {
    let error = value / expected - 1.0;
    println!(
        "{case} {quantity}: {value:.6e}, reference {expected:.6e}, error {:+.3} %, tolerance {:.4} %",
        100.0 * error,
        100.0 * tolerance
    );
    assert!(error.abs() <= tolerance, "{case} {quantity}: {value:.6e} is not within {tolerance} of {expected:.6e}");
}

/// Asserts that `value` lies between two bounds, and prints the line that docs/verification.md quotes.
#[track_caller]
pub fn between(case: &str, quantity: &str, value: f64, low: f64, high: f64) {
    println!("{case} {quantity}: {value:.6e}, between {low:e} and {high:e}");
    assert!(value >= low && value <= high, "{case} {quantity}: {value:.6e} is not between {low:e} and {high:e}");
}

/// Asserts that `value` is not below a bound, and prints the line that docs/verification.md quotes.
#[track_caller]
pub fn at_least(case: &str, quantity: &str, value: f64, low: f64) {
    between(case, quantity, value, low, f64::INFINITY);
}

/// Steel as the wave problems use it, in SI units.
pub mod steel {
    /// Young's modulus.
    pub const E: f64 = 200e9;
    /// Density.
    pub const RHO: f64 = 7850.0;

    /// Speed of longitudinal waves in a thin bar, √(E/ρ).
    pub fn bar_speed() -> f64 {
        (E / RHO).sqrt()
    }

    /// Speed of longitudinal waves in a wide body with ν = 0.3, √((λ + 2μ)/ρ).
    pub fn wave_speed() -> f64 {
        let nu = 0.3;
        (E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) / RHO).sqrt()
    }
}
