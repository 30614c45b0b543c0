//! V-08: a patch of irregular elements in a linear velocity field strains uniformly and without hourglass modes.

use super::*;

/// The irregular cube of MacNeal and Harder (1985): eight outer corners, eight inner nodes, seven elements.
const INNER: [[f64; 3]; 8] = [
    [0.249, 0.342, 0.192],
    [0.826, 0.288, 0.288],
    [0.850, 0.649, 0.263],
    [0.273, 0.750, 0.230],
    [0.320, 0.186, 0.643],
    [0.677, 0.305, 0.683],
    [0.788, 0.693, 0.644],
    [0.165, 0.745, 0.702],
];
const CELLS: [[u32; 8]; 7] = [
    [8, 9, 10, 11, 12, 13, 14, 15],
    [0, 1, 2, 3, 8, 9, 10, 11],
    [12, 13, 14, 15, 4, 5, 6, 7],
    [0, 4, 5, 1, 8, 12, 13, 9],
    [1, 5, 6, 2, 9, 13, 14, 10],
    [3, 2, 6, 7, 11, 10, 14, 15],
    [0, 3, 7, 4, 8, 11, 15, 12],
];

/// The patch; its inner nodes already leave every face between elements warped, `warp` moves the outer ones too.
fn patch(control: Hourglass, warp: f64) -> Rig {
    let mut random = Random(12);
    let outer = CUBE.map(|c| {
        let d = random.vector();
        [0, 1, 2].map(|i| c[i] + warp * d[i])
    });
    let points: Vec<[f64; 3]> = outer.into_iter().chain(INNER).collect();
    Rig::new(&points, &CELLS, elastic(0.3), control)
}

fn element_stress(rig: &Rig, i: usize) -> Matrix3<f64> {
    let group = &rig.block.interior;
    let r = rotation_matrix(&group.values::<4>(i, rows::FRAME));
    let r = Matrix3::from_fn(|a, b| r[a][b]);
    let [xx, yy, zz, xy, yz, zx] = group.values(i, rows::STRESS);
    r * Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz) * r.transpose()
}

/// Largest hourglass resistance of any element.
fn hourglass(rig: &Rig) -> f64 {
    let group = &rig.block.interior;
    let values = (0..group.len()).flat_map(|i| group.values::<12>(i, rows::HOURGLASS));
    values.fold(0.0, |m, q| m.max(q.abs()))
}

fn check_equilibrium(rig: &Rig, stress: f64) {
    for node in 8..16 {
        for f in rig.force(node) {
            close("residual of an inner node", f, 0.0, 1e-12 * stress);
        }
    }
}

const FIELD: Matrix3<f64> = Matrix3::new(1.0, 0.5, -0.25, 0.5, -0.7, 0.3, -0.25, 0.3, 0.4);

#[test]
fn symmetric_velocity_gradient_is_reproduced() {
    for (control, warp) in [(ASSUMED, 0.0), (flanagan_belytschko(0.05), 0.0), (ASSUMED, 0.1)] {
        let mut rig = patch(control, warp);
        let time_step = 1e-3;
        let start: Vec<Vector3<f64>> = (0..16).map(|n| rig.position(n).into()).collect();
        rig.step(time_step, |n| (FIELD * start[n] + Vector3::new(3.0, -2.0, 1.0)).into());
        // The field of the start, seen at mid-step.
        let d = FIELD * (Matrix3::identity() + FIELD * (0.5 * time_step)).try_inverse().unwrap();
        let m = elastic(0.3).moduli();
        let expected = (Matrix3::identity() * (m.lambda * d.trace()) + d * m.two_mu) * time_step;
        let size = expected.amax();
        for i in 0..7 {
            close("stress", (element_stress(&rig, i) - expected).amax(), 0.0, 1e-12 * size);
        }
        close("hourglass", hourglass(&rig), 0.0, 1e-12 * size);
        check_equilibrium(&rig, size);
    }
}

/// With spin, over fifty steps to large strain: all elements agree, whatever their frames.
#[test]
fn elements_agree_at_large_strain_and_rotation() {
    for control in [ASSUMED, flanagan_belytschko(0.05)] {
        let mut rig = patch(control, 0.1);
        let spin = Matrix3::new(0.0, -1.0, 0.4, 1.0, 0.0, -0.2, -0.4, 0.2, 0.0);
        for _ in 0..50 {
            let now: Vec<Vector3<f64>> = (0..16).map(|n| rig.position(n).into()).collect();
            rig.step(0.01, |n| ((FIELD + spin) * now[n]).into());
        }
        let first = element_stress(&rig, 0);
        for i in 1..7 {
            close("stress", (element_stress(&rig, i) - first).amax(), 0.0, 1e-11 * first.amax());
        }
        close("hourglass", hourglass(&rig), 0.0, 1e-11 * first.amax());
        check_equilibrium(&rig, 10.0 * first.amax());
    }
}

/// Forces on the outer nodes are those of the uniform traction on the outer faces: their moments about the origin
/// make up V T.
#[test]
fn outer_forces_carry_the_stress() {
    let mut rig = patch(ASSUMED, 0.0);
    let start: Vec<Vector3<f64>> = (0..16).map(|n| rig.position(n).into()).collect();
    rig.step(1e-3, |n| (FIELD * start[n]).into());
    let virial: Matrix3<f64> =
        (0..8).map(|n| Vector3::from(rig.force(n)) * Vector3::from(rig.position(n)).transpose()).sum();
    let stress = element_stress(&rig, 0);
    let grown = (Matrix3::identity() + FIELD * 1e-3).determinant();
    close("virial", (virial - stress * grown).amax(), 0.0, 1e-12 * stress.amax());
}
