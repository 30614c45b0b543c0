//! V-09: identities of the gradient operator, the volume and the hourglass vectors on random warped elements.

use super::*;
use crate::solver::elements::hexahedron::geometry::{HOURGLASS, corners as from_modes, dot, modes};

/// Natural coordinates of the corners.
fn natural(corner: usize) -> [f64; 3] {
    CUBE[corner].map(|c| 2.0 * c - 1.0)
}

/// ∫ ∂N_I/∂x_i dV by 2 × 2 × 2 Gauss points, which is exact: in each natural coordinate the integrand is quadratic.
fn gauss_operator(corners: &Corners) -> [[f64; 8]; 3] {
    let g = 1.0 / 3.0f64.sqrt();
    let mut b = [[0.0; 8]; 3];
    for point in 0..8 {
        let s = natural(point).map(|c| c * g);
        let slope = |corner: usize| {
            let n = natural(corner);
            let f = [0, 1, 2].map(|i| 1.0 + n[i] * s[i]);
            Vector3::new(n[0] * f[1] * f[2], n[1] * f[0] * f[2], n[2] * f[0] * f[1]) / 8.0
        };
        let jacobian: Matrix3<f64> =
            (0..8).fold(Matrix3::zeros(), |j, c| j + Vector3::from(corners[c]) * slope(c).transpose());
        let adjugate = jacobian.try_inverse().unwrap().transpose() * jacobian.determinant();
        for corner in 0..8 {
            let v = adjugate * slope(corner);
            for i in 0..3 {
                b[i][corner] += v[i];
            }
        }
    }
    b
}

/// The eight modes at the corners: 1, ξ, η, ζ, ηζ, ζξ, ξη, ξηζ.
fn mode(k: usize, corner: usize) -> f64 {
    let [xi, eta, zeta] = natural(corner);
    [1.0, xi, eta, zeta, eta * zeta, zeta * xi, xi * eta, xi * eta * zeta][k]
}

#[test]
fn modes_are_what_they_say() {
    for n in 0..8 {
        let unit: [f64; 8] = std::array::from_fn(|m| f64::from(u8::from(m == n)));
        let found = modes(&unit);
        for k in 0..7 {
            assert_eq!(found[k], mode(k + 1, n), "mode {k} at corner {n}");
        }
    }
    // The way back is the transpose.
    for k in 0..7 {
        let unit: [f64; 7] = std::array::from_fn(|m| f64::from(u8::from(m == k)));
        assert_eq!(from_modes(&unit), std::array::from_fn(|n| mode(k + 1, n)), "mode {k}");
    }
    assert_eq!(mode(HOURGLASS + 1, 0), natural(0)[1] * natural(0)[2]);
}

#[test]
fn gradient_operator_is_the_exact_integral() {
    let mut random = Random(1);
    for _ in 0..200 {
        let corners = random.warped(0.35);
        let (ours, exact) = (gradient(&corners).at_corners(), gauss_operator(&corners));
        for i in 0..3 {
            for n in 0..8 {
                close("B", ours[i][n], exact[i][n], 1e-12);
            }
        }
    }
}

#[test]
fn gradient_operator_sums_to_nothing_and_reproduces_linear_fields() {
    let mut random = Random(2);
    for _ in 0..200 {
        let corners = random.warped(0.4);
        let x = relative(&corners).map(|x| modes(&x));
        let g = gradient(&corners);
        let b = g.at_corners();
        for i in 0..3 {
            close("sum of B", b[i].iter().sum(), 0.0, 1e-12);
            for j in 0..3 {
                let expected = if i == j { volume(&corners) } else { 0.0 };
                close("x B by modes", dot(&x[j], &g.g24[i]) / 192.0, expected, 1e-12);
                close("x B by corners", (0..8).map(|n| corners[n][j] * b[i][n]).sum(), expected, 1e-12);
            }
        }
        close("B B", g.square4608() / 4608.0, b.iter().flatten().map(|b| b * b).sum(), 1e-12);
    }
}

/// The volume is linear in every single coordinate, so a central difference is exact.
#[test]
fn gradient_operator_is_the_derivative_of_the_volume() {
    let mut random = Random(3);
    for _ in 0..50 {
        let corners = random.warped(0.4);
        let b = gradient(&corners).at_corners();
        for n in 0..8 {
            for i in 0..3 {
                let moved = |h: f64| {
                    let mut c = corners;
                    c[n][i] += h;
                    volume(&c)
                };
                close("dV/dx", (moved(0.25) - moved(-0.25)) / 0.5, b[i][n], 1e-12);
            }
        }
    }
}

#[test]
fn volumes_of_simple_bodies() {
    close("cube", volume(&CUBE), 1.0, 1e-15);
    let box_ = mapped(&CUBE, &Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 0.5)));
    close("box", volume(&box_), 3.0, 1e-14);
    // A frustum: base 1, top side 1/2, height 1: (1 + 1/2 + 1/4)/3.
    let frustum = CUBE.map(|[x, y, z]| if z == 0.0 { [x, y, z] } else { [0.5 * x, 0.5 * y, z] });
    close("frustum", volume(&frustum), 1.75 / 3.0, 1e-15);
    close("mirrored", volume(&CUBE.map(|[x, y, z]| [x, y, -z])), -1.0, 1e-15);
}

/// γ_α = Γ_α − B_i (x_i · Γ_α)/V
#[test]
fn hourglass_vectors_are_orthogonal_to_constants_and_to_linear_fields() {
    let mut random = Random(4);
    for _ in 0..100 {
        let corners = random.warped(0.4);
        let x = relative(&corners);
        let b = gradient(&corners).at_corners();
        let h = x.map(|x| modes(&x));
        for a in 0..4 {
            let gamma: [f64; 8] = std::array::from_fn(|n| {
                let linear: f64 = (0..3).map(|i| b[i][n] * h[i][HOURGLASS + a]).sum();
                mode(4 + a, n) - linear / volume(&corners)
            });
            close("gamma 1", gamma.iter().sum(), 0.0, 1e-12);
            for xi in &x {
                close("gamma x", (0..8).map(|n| gamma[n] * xi[n]).sum(), 0.0, 1e-12);
            }
        }
    }
}

#[test]
fn edges_of_a_box_count_four_times() {
    let edges = Vector3::new(2.0, 3.0, 0.5);
    let x = relative(&mapped(&CUBE, &Matrix3::from_diagonal(&edges)));
    for i in 0..3 {
        let along = modes(&x[i]);
        for j in 0..7 {
            close("edge", along[j], if i == j { 4.0 * edges[i] } else { 0.0 }, 1e-14);
        }
    }
}
