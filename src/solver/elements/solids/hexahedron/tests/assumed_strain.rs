//! The assumed strain stiffness against the formulas of Belytschko and Bindeman (1993), put together independently.

use super::*;

/// Stiffness of a hexahedron's hourglass modes: q̇_iα = γ_αI v̂_iI/8 with the theory's γ, resisted by
/// Q_ii = μ[(H_jj + H_kk) q_ii + H_ij q_jj + H_ik q_kk], Q_ij = 2μ/(1−ν) [H_ii q_ij + ν H_ij q_ji],
/// Q_i4 = ⅔ μ (1 + ν) H_ii q_i4, in axes that are the rotation of the polar factor of those of ξ, η and ζ.
fn theory(corners: &Corners, mu: f64, nu: f64) -> DMatrix<f64> {
    let s = |n: usize| CUBE[n].map(|c| 2.0 * c - 1.0);
    let x: [Vector3<f64>; 8] = corners.map(Vector3::from);
    let edge = |a: usize| (0..8).map(|n| x[n] * s(n)[a]).sum::<Vector3<f64>>();
    let factors = Matrix3::from_columns(&[edge(0), edge(1), edge(2)]).svd(true, true);
    let axes = factors.u.unwrap() * factors.v_t.unwrap();
    let along: [f64; 3] = [0, 1, 2].map(|i| axes.column(i).dot(&edge(i)));
    let h = |i: usize, j: usize| {
        if i == j { along[(i + 1) % 3] * along[(i + 2) % 3] / along[i] / 3.0 } else { along[3 - i - j] / 3.0 }
    };
    let b = gradient(corners).at_corners();
    let mode = |a: usize, n: usize| {
        let [xi, eta, zeta] = s(n);
        [eta * zeta, zeta * xi, xi * eta, xi * eta * zeta][a]
    };
    let gamma = |a: usize, n: usize| {
        let linear: f64 =
            (0..3).map(|i| b[i][n] / volume(corners) * (0..8).map(|m| mode(a, m) * x[m][i]).sum::<f64>()).sum();
        (mode(a, n) - linear) / 8.0
    };
    let mut modal = DMatrix::zeros(12, 12);
    for i in 0..3 {
        for j in 0..3 {
            if i == j {
                let (k, l) = ((i + 1) % 3, (i + 2) % 3);
                modal[(4 * i + i, 4 * i + i)] = mu * (h(k, k) + h(l, l));
                modal[(4 * i + 3, 4 * i + 3)] = 2.0 / 3.0 * mu * (1.0 + nu) * h(i, i);
            } else {
                modal[(4 * i + i, 4 * j + j)] = mu * h(i, j);
                modal[(4 * i + j, 4 * i + j)] = 2.0 * mu / (1.0 - nu) * h(i, i);
                modal[(4 * i + j, 4 * j + i)] = 2.0 * mu / (1.0 - nu) * nu * h(i, j);
            }
        }
    }
    let rates = DMatrix::from_fn(12, 24, |mode, dof| axes[(dof % 3, mode / 4)] * gamma(mode % 4, dof / 3));
    rates.transpose() * modal * rates
}

/// The part of the stiffness that hourglass control adds.
fn added(corners: &Corners, poisson: f64, control: Hourglass) -> DMatrix<f64> {
    stiffness(corners, elastic(poisson), control, |_| ()) - stiffness(corners, elastic(poisson), NONE, |_| ())
}

/// Moderately warped bricks in any attitude. The floor under the lengths acts in none of them.
fn bricks() -> Vec<Corners> {
    let mut random = Random(8);
    (0..30)
        .map(|_| {
            let edges = Vector3::from(random.vector()).map(|e| 1.0 + 0.6 * e);
            let warped = random.warped(0.12);
            let turn = random.rotation();
            mapped(&warped, &(turn * Matrix3::from_diagonal(&edges)))
        })
        .collect()
}

#[test]
fn stiffness_is_that_of_the_theory() {
    for nu in [-0.2, 0.0, 0.3, 0.499] {
        let mu = 0.5 * elastic(nu).moduli().two_mu;
        for corners in bricks() {
            let (ours, theory) = (added(&corners, nu, ASSUMED), theory(&corners, mu, nu));
            let scale = elastic(nu).moduli().dilatational();
            close("stiffness", (ours - &theory).amax(), 0.0, 1e-8 * scale);
        }
    }
    let corners = bricks()[0];
    let tenth = added(&corners, 0.3, Hourglass::AssumedStrain { factor: 0.1 });
    close("factor", (tenth * 10.0 - added(&corners, 0.3, ASSUMED)).amax(), 0.0, 1e4);
}

/// κ μ B:B/(4V) γγᵀ in every direction.
#[test]
fn flanagan_belytschko_stiffness_of_a_cube() {
    let added = added(&CUBE, 0.3, flanagan_belytschko(0.05));
    let mu = 0.5 * elastic(0.3).moduli().two_mu;
    // γγᵀ summed over the four modes has 4 on its diagonal; B:B/V = 3/2.
    close("stiffness", added[(0, 0)], 0.05 * mu * 1.5 / 4.0 * 4.0, 1e-6 * mu);
    close("isotropy", added[(0, 1)].abs() + added[(4, 3)].abs(), 0.0, 1e-6 * mu);
}

#[test]
fn stiffness_is_symmetric_semidefinite_and_blind_to_linear_fields() {
    for control in [ASSUMED, flanagan_belytschko(0.15)] {
        for corners in bricks() {
            let k = added(&corners, 0.3, control);
            let size = k.amax();
            close("asymmetry", (&k - k.transpose()).amax(), 0.0, 1e-8 * 3.5 * size.max(77e9));
            let eigenvalues = ((&k + k.transpose()) * 0.5).symmetric_eigenvalues();
            let nothing = 1e-7 * eigenvalues.max();
            assert!(eigenvalues.min() > -nothing, "{control:?}: {}", eigenvalues.min());
            assert_eq!(eigenvalues.iter().filter(|e| e.abs() < nothing).count(), 12, "{control:?}: {eigenvalues}");
            // Translations and displacements linear in position: rigid rotation and constant strain.
            for i in 0..3 {
                for j in 0..4 {
                    let field = DMatrix::from_fn(24, 1, |dof, _| {
                        let x = if j < 3 { corners[dof / 3][j] } else { 1.0 };
                        if dof % 3 == i { x } else { 0.0 }
                    });
                    close("linear field", (&k * field).amax(), 0.0, 1e-7 * 269e9);
                }
            }
        }
    }
}

/// The whole element, too, only lets rigid motions go for nothing, and has no energy of the wrong sign.
#[test]
fn element_stiffness_has_six_rigid_modes() {
    for control in [ASSUMED, flanagan_belytschko(0.05)] {
        for corners in bricks() {
            let k = stiffness(&corners, elastic(0.3), control, |_| ());
            let eigenvalues = ((&k + k.transpose()) * 0.5).symmetric_eigenvalues();
            let nothing = 1e-7 * eigenvalues.max();
            assert_eq!(eigenvalues.iter().filter(|e| **e < nothing).count(), 6, "{eigenvalues}");
        }
    }
}

/// V-12 at element level: a slender element bent by end couples. Beam theory gives curvature 12 M/(E w h³); with
/// assumed strain the element is exact when ν = 0 and 1/(1 − ν²) too stiff across its width otherwise.
#[test]
fn pure_bending_is_free_of_locking() {
    let (length, height) = (4.0, 0.5);
    let corners = mapped(&CUBE, &Matrix3::from_diagonal(&Vector3::new(length, 1.0, height)));
    for nu in [0.0, 0.3, 0.499] {
        let k = stiffness(&corners, elastic(nu), ASSUMED, |_| ());
        // u = κ x z, w follows with no force; the couple M = E w h³ κ/12 through forces ±M/(2 h w/…) at the corners.
        let curvature = 1e-3;
        let bent = DMatrix::from_fn(24, 1, |dof, _| {
            let [x, _, z] = corners[dof / 3];
            let (x, z) = (x - 0.5 * length, z - 0.5 * height);
            if dof % 3 == 0 { curvature * x * z } else { 0.0 }
        });
        let energy = 0.5 * (bent.transpose() * &k * &bent)[(0, 0)];
        let beam = 0.5 * STEEL.young * height.powi(3) / 12.0 * curvature * curvature * length;
        // The sharp value: 2μ/(1 − ν) instead of E, since the element cannot bend across.
        let factor = 1.0 / ((1.0 + nu) * (1.0 - nu));
        close("bending energy", energy / beam, factor, 1e-4);
    }
}
