//! Tests of the element against theory: what must hold for any shape, any motion, any instruction set.

// Formulas run over indices of several arrays at once.
#![allow(clippy::needless_range_loop)]

use super::sections::{Operator, Section};
use super::{Quadrilateral, rows};
use crate::deck::Source;
use crate::lanes::{Force, Row};
use crate::material::{Elastic, ElasticPlastic, Law};
use crate::mesh::plane::{self, Corners};
use crate::model::{Analysis, Hourglass, examine};
use crate::solver::elements::hexahedron::Hexahedron;
use crate::solver::elements::{Element, ElementBlock, PassOutcome, PassSettings, Sink, by_hand};
use crate::solver::loads::area_vectors;
use nalgebra::DMatrix;

const DENSITY: f64 = 7850.0;
const STEEL: Elastic = Elastic { young: 200e9, poisson: 0.3 };
const ASSUMED: Hourglass = Hourglass::AssumedStrain { factor: 1.0 };

fn quadrilateral(hourglass: Hourglass, about_axis: bool) -> Quadrilateral {
    Quadrilateral { hourglass, section: if about_axis { Section::Axisymmetric } else { Section::PlaneStrain } }
}

/// Numbers that look random and are the same every time (splitmix64).
struct Random(u64);

impl Random {
    /// Evenly spread over −1 to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A unit square at this distance from the axis, whose corners are moved; on the axis those there stay on it.
    fn warped(&mut self, amplitude: f64, radius: f64) -> Corners {
        loop {
            let mut corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
            for corner in &mut corners {
                let on_axis = radius == 0.0 && corner[0] == 0.0;
                corner[1] += amplitude * self.next();
                corner[0] += if on_axis { 0.0 } else { radius + amplitude * self.next() };
            }
            if plane::least_corner(&[0, 1, 2, 3], &corners) > 0.1 {
                return corners;
            }
        }
    }
}

/// One element whose nodes are moved by hand.
struct Rig {
    block: ElementBlock,
    nodes: Vec<Row>,
    forces: Vec<Force>,
    pass: PassSettings,
}

impl Rig {
    fn new(points: &[[f64; 3]], nodes: &[u32], element: Element, law: Law, mass: f64) -> Rig {
        let corners: Vec<[f64; 3]> = nodes.iter().map(|&n| points[n as usize]).collect();
        let new = by_hand::single(nodes, &corners, mass);
        Rig {
            block: by_hand::block(&element, &law, DENSITY, &[new]),
            nodes: points.iter().copied().map(by_hand::at_rest).collect(),
            forces: vec![Force::default(); points.len()],
            pass: by_hand::settings(),
        }
    }

    fn flat(corners: &Corners, law: Law, hourglass: Hourglass, about_axis: bool) -> Rig {
        let element = quadrilateral(hourglass, about_axis);
        let mass = DENSITY * element.whole(corners);
        Rig::new(corners, &[0, 1, 2, 3], Element::Quadrilateral(element), law, mass)
    }

    fn step(&mut self, time_step: f64, velocity: impl Fn(usize, [f64; 3]) -> [f64; 3]) -> PassOutcome {
        for (node, row) in self.nodes.iter_mut().enumerate() {
            let v = velocity(node, [row.0[0], row.0[1], row.0[2]]);
            row.0[4..7].copy_from_slice(&v);
            for i in 0..3 {
                row.0[i] += time_step * v[i];
            }
        }
        self.forces.fill(Force::default());
        self.pass.time_step = time_step;
        self.pass.time += time_step;
        self.block.run(&self.nodes, &[], Sink::Nodes { forces: &mut self.forces, border: &[] }, &self.pass)
    }

    fn force(&self, node: usize) -> [f64; 3] {
        let f = &self.forces[node].0;
        [-f[0], -f[1], -f[2]]
    }

    fn state(&self, row: usize) -> f64 {
        self.block.interior.value(0, row)
    }
}

#[track_caller]
fn close(what: &str, a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{what}: {a:e} instead of {b:e}, off by {:e} > {tolerance:e}", (a - b).abs());
}

fn operator(section: Section, corners: &Corners) -> Operator<f64> {
    let [x, y] = [0, 1].map(|axis: usize| corners.map(|c| c[axis]));
    let y = y.map(|value| value - y[0]);
    section.operator(&[if section.about_axis() { x } else { x.map(|value| value - corners[0][0]) }, y])
}

/// The operator is the gradient of the volume, its parts are those of radial and hoop strain, and a uniform pressure inside is
/// in balance with the loads on the edges, on any shape.
#[test]
fn the_operator_is_the_gradient_of_the_volume() {
    let mut random = Random(1);
    for case in 0..40 {
        let corners = random.warped(0.3, if case % 2 == 0 { 0.0 } else { 3.0 });
        let of_ring = operator(Section::Axisymmetric, &corners);
        close("volume", of_ring.volume, plane::swept(&corners), 1e-14 * of_ring.volume);
        close("hoop", of_ring.hoop.iter().sum(), of_ring.area, 1e-15 * of_ring.area);
        let hoop: f64 = (0..4).map(|i| of_ring.hoop[i] * corners[i][0]).sum();
        close("growth of radii", hoop, of_ring.volume, 1e-14 * of_ring.volume);
        close("radial", of_ring.radial.iter().sum(), 0.0, 1e-14 * of_ring.volume);
        close("axial", of_ring.axial.iter().sum(), 0.0, 1e-14 * of_ring.volume);
        for (analysis, turn) in [(Analysis::PlaneStrain, 1.0), (Analysis::Axisymmetric, std::f64::consts::TAU)] {
            let about_axis = analysis == Analysis::Axisymmetric;
            let at = |i: usize, axis: usize, h: f64| {
                let mut moved = corners;
                moved[i][axis] += h;
                if about_axis { plane::swept(&moved) } else { plane::area(&moved) }
            };
            let operator = if about_axis {
                operator(Section::Axisymmetric, &corners)
            } else {
                operator(Section::PlaneStrain, &corners)
            };
            for i in 0..4 {
                let own = [operator.radial[i] + operator.hoop[i], operator.axial[i]];
                let edges = [(i + 3) % 4, i].map(|first| {
                    let (a, b) = (corners[first], corners[(first + 1) % 4]);
                    area_vectors([a, b, b, a], analysis)[usize::from(first != i)]
                });
                for axis in 0..2 {
                    let slope = (at(i, axis, 1e-6) - at(i, axis, -1e-6)) / 2e-6;
                    close("finite difference", own[axis], slope, 1e-8 * operator.volume);
                    close("loads on edges", edges[0][axis] + edges[1][axis], turn * own[axis], 1e-13 * operator.volume);
                }
            }
        }
    }
}

/// Any linear field of the plane gives its own gradient at every shape; a uniform hoop rate the ring's.
#[test]
fn linear_fields_strain_uniformly() {
    let mut random = Random(2);
    for case in 0..20 {
        let corners = random.warped(0.3, 1.5);
        let l = [[random.next(), random.next()], [random.next(), random.next()]];
        let about_axis = case % 2 == 1;
        // About the axis a radial motion that is not proportional to the radius strains the hoop by its mean.
        let field = |x: [f64; 3]| {
            [l[0][0] * x[0] + if about_axis { 0.0 } else { l[0][1] * x[1] }, l[1][0] * x[0] + l[1][1] * x[1], 0.0]
        };
        let mut rig = Rig::flat(&corners, Law::Elastic(STEEL), ASSUMED, about_axis);
        let time_step = 1e-7;
        rig.step(time_step, |_, x| field(x));
        let s: Vec<f64> = (0..4).map(|k| rig.state(rows::STRETCH + k)).collect();
        close(
            "volume ratio",
            (s[0] * s[1] - s[3] * s[3]) * s[2] - 1.0,
            (l[0][0] + l[1][1] + if about_axis { l[0][0] } else { 0.0 }) * time_step,
            3e-13,
        );
        close("across", s[2], 1.0 + if about_axis { l[0][0] * time_step } else { 0.0 }, 3e-14);
        close("hourglass", rig.state(rows::HOURGLASS).abs() + rig.state(rows::HOURGLASS + 1).abs(), 0.0, 1e-3);
        assert!((0..4).all(|node| rig.force(node)[2] == 0.0));
    }
}

/// A plane strain element and one layer of a hexahedron held across, moved alike for 200 steps: stress, hourglass resistance,
/// forces and energies are the same to round-off. Where `modes` is 0 the motion has no hourglass part.
#[track_caller]
fn assert_one_layer(what: &str, law: &Law, hourglass: Hourglass, corners: &Corners, modes: f64) {
    // Thick: the hexahedron's floors of its lengths do not matter then. Its centre is in the plane, for what starts by its place.
    let thickness = 1.0;
    let solid: Vec<[f64; 3]> = [-0.5, 0.5].iter().flat_map(|&z| corners.map(|[x, y, _]| [x, y, z])).collect();
    let mut flat = Rig::flat(corners, law.clone(), hourglass, false);
    let element =
        Element::Hexahedron(Hexahedron { hourglass, precision: Default::default(), spin: Default::default() });
    let nodes = [0, 1, 2, 3, 4, 5, 6, 7];
    let mut deep = Rig::new(&solid, &nodes, element, law.clone(), DENSITY * plane::area(corners) * thickness);
    let time_step = 1e-5;
    // Of a strain of a thousandth; the motion's is ten times that.
    let mut largest = 1e-3 * law.moduli().dilatational();
    for step in 0..200 {
        let [a, b, c] = [1.0, 2.0, 3.0].map(|k: f64| libm::sin(0.05 * k * f64::from(step)));
        let field = |node: usize, x: [f64; 3]| {
            let corner = node % 4;
            let mode = if corner.is_multiple_of(2) { modes } else { -modes };
            [20.0 * a * x[0] + 30.0 * b * x[1] + 5.0 * c * mode, -60.0 * c * x[0] + 8.0 * mode * a, 0.0]
        };
        let outcomes = [flat.step(time_step, field), deep.step(time_step, field)];
        assert!(outcomes.iter().all(|outcome| outcome.failed.is_none()), "{what}: {outcomes:?}");
        largest = (0..8).map(|dof| flat.force(dof / 2)[dof % 2].abs()).fold(largest, f64::max);
        for node in 0..4 {
            for i in 0..2 {
                let both = deep.force(node)[i] + deep.force(node + 4)[i];
                close(&format!("{what}: force in step {step}"), both, flat.force(node)[i], 1e-12 * largest);
            }
        }
    }
    // Of a size of 1, a force times a length is an energy.
    let solid_rows = crate::solver::elements::hexahedron::rows::INTERNAL_ENERGY;
    let energy = flat.state(rows::INTERNAL_ENERGY);
    let size = energy.abs().max(largest * 1e-2);
    close(&format!("{what}: energy"), deep.state(solid_rows), energy, 1e-12 * size);
    let of_modes = flat.state(rows::HOURGLASS_ENERGY);
    close(&format!("{what}: hourglass energy"), deep.state(solid_rows + 1), of_modes, 1e-12 * size);
}

#[test]
fn plane_strain_is_one_layer_of_hexahedra() {
    let law = Law::ElasticPlastic(ElasticPlastic {
        young: 200e9,
        poisson: 0.3,
        yield_stress: 4e8,
        hardening: 2e9,
        beta: 0.5,
    });
    let mut random = Random(3);
    for case in 0..6 {
        let hourglass = if case % 2 == 0 { ASSUMED } else { Hourglass::AssumedStrain { factor: 0.1 } };
        assert_one_layer("steel", &law, hourglass, &random.warped(0.2, 0.0), 1.0);
    }
}

/// All laws, those with an equation of state too. A fluid slows its hourglass modes by its stable step, which thickness has a part
/// in: they are left alone there.
#[test]
fn every_law_is_in_plane_strain_as_in_a_layer() {
    let deck = Source::new("materials.i", include_str!("../../../../../../decks/materials.i"));
    let Ok(problem) = examine(deck, None) else { panic!("the deck of all materials can be read") };
    let mut kinds = std::collections::BTreeSet::new();
    for material in &problem.model.materials {
        let modes = if material.law.is_fluid() { 0.0 } else { 1.0 };
        let corners = Random(9).warped(if modes == 0.0 { 0.1 } else { 0.2 }, 0.0);
        // Of an area of 1, whose root is the cube root of the layer's volume: explosives go by that.
        let corners = corners.map(|corner| corner.map(|x| x / plane::area(&corners).sqrt()));
        let what = format!("{} of block {}", material.law.entry().name, material.block);
        assert_one_layer(&what, &material.law, ASSUMED, &corners, modes);
        kinds.insert(material.law.entry().name);
    }
    assert_eq!(kinds.len(), crate::material::MATERIALS.len(), "every law is in the deck");
}

/// A body that turns in its plane and one that moves along its axis feel nothing new.
#[test]
fn rigid_motion_changes_nothing() {
    let corners = Random(4).warped(0.2, 0.0);
    let mut rig = Rig::flat(&corners, Law::Elastic(STEEL), ASSUMED, false);
    rig.step(1e-6, |node, x| [50.0 * x[0] + if node == 2 { 10.0 } else { 0.0 }, -20.0 * x[1], 0.0]);
    let before: Vec<f64> = (0..rows::HOURGLASS + 2).map(|row| rig.state(row)).collect();
    let (angle, mut turned) = (0.05, 0.0);
    let start: Vec<[f64; 3]> = rig.nodes.iter().map(|row| [row.0[0], row.0[1], 0.0]).collect();
    for _ in 0..12_566 {
        turned += angle;
        let (c, s) = (libm::cos(turned), libm::sin(turned));
        rig.step(1.0, |node, x| {
            [c * start[node][0] - s * start[node][1] - x[0], s * start[node][0] + c * start[node][1] - x[1], 0.0]
        });
    }
    let size = before[..4].iter().fold(0.0, |most: f64, s| most.max(s.abs()));
    for row in (0..4).chain(rows::HOURGLASS..rows::HOURGLASS + 2) {
        close("after a hundred turns", rig.state(row), before[row], 1e-9 * size);
    }
    let ring = Random(5).warped(0.2, 0.0);
    let mut rig = Rig::flat(&ring, Law::Elastic(STEEL), ASSUMED, true);
    rig.step(1.0, |_, _| [0.0, 1e3, 0.0]);
    assert!((0..4).all(|node| rig.force(node).iter().all(|f| f.abs() < 1e-10 * STEEL.young)), "{:?}", rig.forces);
}

/// The stable step is never above that of the exact highest frequency, hourglass resistance included, on and off the axis.
#[test]
fn the_stable_step_is_a_bound() {
    let mut random = Random(6);
    let mut nearest = f64::INFINITY;
    for case in 0..300 {
        let radius = [0.0, 0.0, 0.4, 5.0][case % 4];
        let (amplitude, about_axis) = (0.35 * f64::from(case as u32 % 3) / 2.0, case % 5 != 0);
        let mut corners = random.warped(amplitude, radius);
        let slender = [1.0, 0.1, 4.0][case / 7 % 3];
        corners.iter_mut().for_each(|corner| corner[1] *= slender);
        let poisson = [0.0, 0.3, 0.45][case / 11 % 3];
        let law = Law::Elastic(Elastic { poisson, ..STEEL });
        let held = |dof: usize| about_axis && dof.is_multiple_of(2) && corners[dof / 2][0] == 0.0;
        let h = 1e-7 * slender.min(1.0);
        let force = |dof: usize, h: f64| {
            let mut rig = Rig::flat(&corners, law.clone(), ASSUMED, about_axis);
            rig.step(1.0, |node, _| [0, 1, 2].map(|i| if i < 2 && 2 * node + i == dof { h } else { 0.0 }));
            rig
        };
        let element = quadrilateral(ASSUMED, about_axis);
        let mass = DENSITY * element.whole(&corners);
        let shares = plane::mass_shares(&[0, 1, 2, 3], &corners, about_axis);
        let mut k = DMatrix::zeros(8, 8);
        for dof in (0..8).filter(|&dof| !held(dof)) {
            let (plus, minus) = (force(dof, h), force(dof, -h));
            for other in (0..8).filter(|&other| !held(other)) {
                let f = (plus.force(other / 2)[other % 2] - minus.force(other / 2)[other % 2]) / (2.0 * h);
                k[(other, dof)] = f / (mass * (shares[other / 2] * shares[dof / 2]).sqrt());
            }
        }
        let symmetric = (&k + k.transpose()) * 0.5;
        assert!((&k - &symmetric).amax() < 1e-4 * k.amax(), "case {case}: the stiffness is not symmetric");
        let highest = symmetric.symmetric_eigenvalues().max();
        let exact = 2.0 / highest.sqrt();
        let ours = Rig::flat(&corners, law.clone(), ASSUMED, about_axis).step(0.0, |_, _| [0.0; 3]).stable_step;
        // A single warped element may be beyond it by a per cent, as a hexahedron: see docs/theory.md.
        let allowed = if amplitude == 0.0 { 1.000_001 } else { 1.01 };
        assert!(ours <= exact * allowed, "case {case}: {ours:e} above {exact:e}, ratio {}", ours / exact);
        nearest = nearest.min(exact / ours);
    }
    assert!(nearest < 1.2, "the bound is nowhere near: {nearest}");
}

/// The compatible form on shapes on and off the axis: no force along the axis in sum, whatever the stress and the hourglass
/// mode are; masses whose sum is the element's; and next to nothing of both on the axis, in the ratio of its neighbour's
/// radii.
#[test]
fn the_compatible_form_keeps_momentum_along_the_axis() {
    let mut random = Random(10);
    let law = Law::ElasticPlasticHydrodynamic(copper());
    for case in 0..20 {
        let corners = random.warped(0.2, if case % 2 == 0 { 0.0 } else { 2.0 });
        let element = Quadrilateral { hourglass: ASSUMED, section: Section::Compatible };
        let shares = element.section.mass_shares(&[0, 1, 2, 3], &corners);
        close("masses", shares.iter().sum(), 1.0, 1e-11);
        assert!((0..4).all(|i| shares[i] > 0.0 && (corners[i][0] > 0.0 || shares[i] < 1e-11)), "{shares:?}");
        let mass = DENSITY * element.whole(&corners);
        let mut rig = Rig::new(&corners, &[0, 1, 2, 3], Element::Quadrilateral(element), law.clone(), mass);
        for _ in 0..10 {
            let v: Vec<[f64; 3]> = (0..4).map(|_| [random.next(), random.next(), 0.0]).collect();
            let outcome = rig.step(1e-3, |node, x| if x[0] == 0.0 { [0.0, v[node][1], 0.0] } else { v[node] });
            assert!(outcome.failed.is_none() && outcome.stable_step > 0.0);
        }
        let size = (0..4).map(|node| rig.force(node)[1].abs()).fold(0.0, f64::max);
        close("force along the axis", (0..4).map(|node| rig.force(node)[1]).sum(), 0.0, 1e-11 * size);
        for node in (0..4).filter(|&node| corners[node][0] == 0.0) {
            assert!(rig.force(node)[1].abs() < 1e-10 * size, "{:?}", rig.force(node));
        }
    }
}

fn copper() -> crate::material::ElasticPlasticHydrodynamic {
    let deck = Source::new("materials.i", include_str!("../../../../../../decks/materials.i"));
    let Ok(problem) = examine(deck, None) else { panic!("the deck of all materials can be read") };
    let found = problem.model.materials.into_iter().find_map(|material| match material.law {
        Law::ElasticPlasticHydrodynamic(law) => Some(law),
        _ => None,
    });
    found.expect("it has a metal with an equation of state")
}

/// A triangle has three masses, no hourglass mode and a bound.
#[test]
fn triangles_have_no_hourglass_mode() {
    let corners = [[1.0, 0.0, 0.0], [2.0, 0.1, 0.0], [1.2, 0.9, 0.0], [1.2, 0.9, 0.0]];
    for about_axis in [false, true] {
        let element = quadrilateral(ASSUMED, about_axis);
        let mass = DENSITY * element.whole(&corners);
        let points = [corners[0], corners[1], corners[2]];
        let mut rig = Rig::new(&points, &[0, 1, 2, 2], Element::Quadrilateral(element), Law::Elastic(STEEL), mass);
        let outcome = rig.step(1e-6, |node, _| [[0.0, 0.0, 0.0], [3.0, -2.0, 0.0], [1.0, 4.0, 0.0]][node]);
        assert!(outcome.failed.is_none() && outcome.stable_step > 0.0);
        close("hourglass energy", rig.state(rows::HOURGLASS_ENERGY), 0.0, 1e-12 * rig.state(rows::INTERNAL_ENERGY));
        let along: f64 = (0..3).map(|node| rig.force(node)[1]).sum();
        close("axial momentum", along, 0.0, 1e-12 * STEEL.young);
    }
}

/// The frame is nearest to both axes: turned half as far as one of them is sheared, and no corner is the first.
#[test]
fn no_numbering_chooses_the_frame_of_a_skewed_element() {
    let [shear, height] = [0.4, 1.3];
    let corners: Corners = [[0.0; 3], [1.0, 0.0, 0.0], [1.0 + shear, height, 0.0], [shear, height, 0.0]];
    let whole = super::own_axis(&corners);
    // The rotation of the polar factor has the tangent (J₂₁ − J₁₂)/(J₁₁ + J₂₂).
    assert!((whole[1] / whole[0] + shear / (1.0 + height)).abs() < 1e-15, "{whole:?}");
    for first in 1..4 {
        let mut turned = corners;
        turned.rotate_left(first);
        let [c, s] = super::own_axis(&turned);
        let angle = libm::atan2(s, c) - libm::atan2(whole[1], whole[0]);
        let quarters = angle / std::f64::consts::FRAC_PI_2;
        assert!((quarters - quarters.round()).abs() < 1e-14, "{angle}");
    }
}
