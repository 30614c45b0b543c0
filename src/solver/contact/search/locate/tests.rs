//! Candidates that sleep change nothing: small bodies fly, meet, slide and rest with sleep and without, and every
//! constraint, force and position must have the same bits.

use super::{Locator, SleepState};
use crate::comm::Serial;
use crate::deck::Source;
use crate::lanes::{Force, Row};
use crate::mesh::Mesh;
use crate::model::{Model, examine};
use crate::solver::Body;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::Contact;
use crate::solver::nodes::{Nodes, add, cross, dot, scaled, subtract};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use std::cell::Cell;

/// Mass of a node, length of a step, stiffness of the springs that hold a body's elements together: soft and well below the
/// step's stability limit.
const MASS: f64 = 1.0;
const STEP: StepTimes = StepTimes { time: 0.0, kick: 1.0, drift: 1.0 };
const STIFFNESS: f64 = 0.01;

/// Scenes, unless PROPTEST_CASES asks for more, and steps of each.
const SCENES: u32 = 150;
const STEPS: usize = 50;

impl Locator {
    /// Wakes every candidate and every pair, for one step; faces hold these points, ascending.
    fn wake(&mut self, held: &[u32]) {
        for (i, sleep) in self.sleep.iter_mut().enumerate() {
            let candidates = self.first[i + 1] - self.first[i];
            let awake = u64::MAX.checked_shr(64 - candidates.min(64)).unwrap_or(0);
            let held = held.binary_search(&self.slave_nodes[i]).is_ok();
            *sleep = SleepState { due: f64::INFINITY, awake, held };
        }
        self.quiet_until.fill(f64::NEG_INFINITY);
        self.pairs_due.fill(f64::NEG_INFINITY);
    }

    /// Candidates and pairs that sleep.
    fn asleep(&self) -> u64 {
        let awake = self.sleep.iter().map(|sleep| u64::from(sleep.awake.count_ones())).sum::<u64>();
        let pairs = (0..self.edge_pairs.len()).filter(|&i| !self.is_pair_due(i)).count();
        self.candidates.len() as u64 - awake.min(self.candidates.len() as u64) + pairs as u64
    }
}

/// A box of some elements that meets the one before it.
#[derive(Debug, Clone)]
struct Brick {
    size: [f64; 3],
    cells: [usize; 3],
    /// Axis and angle of its attitude; and whether its third axis is first put along `towards`.
    turned: ([f64; 3], f64),
    aligned: bool,
    /// Which way it lies from the one before, how far off that way, and how far away.
    towards: [f64; 3],
    beside: [f64; 3],
    away: f64,
    /// Speed of approach, velocity of sliding, of turning, and of each node for itself.
    speed: f64,
    slide: [f64; 3],
    spin: [f64; 3],
    jitter: f64,
    /// What pulls it back to where it came from or on, as a part of its speed a step.
    pull: f64,
    /// Whether the one before it comes as fast to meet it, as sleepers must fear.
    both: bool,
}

#[derive(Debug, Clone)]
struct Scene {
    bricks: Vec<Brick>,
    /// Whether the first brick is held where it is.
    held: bool,
    edges: &'static str,
    friction: f64,
    /// Steps that a search is to last.
    reach: f64,
    /// A node that is struck, at which step, and how fast it then goes.
    strike: (usize, usize, [f64; 3]),
    noise: u64,
}

fn vector(most: f64) -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-most..most)
}

/// Powers of ten.
fn power(range: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    range.prop_map(|x| 10f64.powf(x))
}

fn brick() -> impl Strategy<Value = Brick> {
    let side = || prop::array::uniform3(prop_oneof![2 => 0.5..2.0, 1 => power(-2.0..-0.5)]);
    // Flat on each other, or edges and corners first.
    let turned = prop_oneof![
        Just(([0.0, 0.0, 1.0], 0.0)),
        (0.0..1.0).prop_map(|angle| ([0.0, 0.0, 1.0], angle)),
        (vector(1.0), 0.0..3.0),
    ];
    let towards = prop_oneof![3 => Just([0.0, 0.0, 1.0]), 1 => Just([1.0; 3]), 1 => vector(1.0)];
    let shape = (side(), prop::array::uniform3(1usize..3), (turned, any::<bool>()), towards, vector(0.6));
    // In steps at its speed.
    let away = prop_oneof![1 => Just(0.0), 3 => 0.0..90.0];
    let slide = (vector(1.0), power(-4.0..-0.7)).prop_map(|(way, size)| scaled(way, size));
    let jitter = prop_oneof![Just(0.0), power(-6.0..-1.3)];
    let slide = prop_oneof![Just([0.0; 3]), slide];
    let spin = prop_oneof![Just([0.0; 3]), vector(0.02)];
    let pull = prop_oneof![Just(0.0), -0.1..0.1];
    let motion = (away, power(-5.0..-0.7), slide, spin, jitter, pull, any::<bool>());
    (shape, motion).prop_map(
        |((size, cells, (turned, aligned), towards, beside), (away, speed, slide, spin, jitter, pull, both))| {
            let away = away * speed;
            Brick { size, cells, turned, aligned, towards, beside, away, speed, slide, spin, jitter, pull, both }
        },
    )
}

fn scene() -> impl Strategy<Value = Scene> {
    let strike = (0usize..1000, 0usize..2 * STEPS, vector(0.3));
    let edges = prop_oneof![Just("ON"), Just("ALL")];
    let rules = (any::<bool>(), edges, prop_oneof![Just(0.0), Just(0.3)], prop_oneof![Just(20.0), Just(150.0)]);
    (prop::collection::vec(brick(), 2..4), rules, strike, any::<u64>()).prop_map(
        |(bricks, (held, edges, friction, reach), strike, noise)| Scene {
            bricks,
            held,
            edges,
            friction,
            reach,
            strike,
            noise,
        },
    )
}

/// x turned around an axis, by Rodrigues' formula.
fn turn(x: [f64; 3], (axis, angle): ([f64; 3], f64)) -> [f64; 3] {
    let length = dot(axis, axis).sqrt();
    if length < 1e-3 {
        return x;
    }
    let axis = scaled(axis, 1.0 / length);
    let (sine, cosine) = angle.sin_cos();
    add(add(scaled(x, cosine), scaled(cross(axis, x), sine)), scaled(axis, dot(axis, x) * (1.0 - cosine)))
}

/// Numbers between −1 and 1 (Knuth's generator).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2f64.powi(52) - 1.0
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        [self.next() * size, self.next() * size, self.next() * size]
    }
}

/// What moves: nodes, the springs between them, and the pull on each node.
struct Stage {
    mesh: Mesh,
    model: Model,
    body: Body,
    velocity: Vec<[f64; 3]>,
    pull: Vec<[f64; 3]>,
    fixed: Vec<bool>,
    /// Two nodes and the length between them.
    springs: Vec<(usize, usize, f64)>,
}

impl Scene {
    /// The bricks as a mesh at the origin, from a recipe.
    fn mesh(&self) -> Mesh {
        let of = |(i, brick): (usize, &Brick)| {
            let ([x, y, z], [k, l, m]) = (brick.size, brick.cells);
            format!(
                "BOX, {}, {:?}, {:?}, {:?}, {x:?}, {y:?}, {z:?}, {k}, {l}, {m}\n",
                i + 1,
                -0.5 * x,
                -0.5 * y,
                -0.5 * z
            )
        };
        let recipe: String = self.bricks.iter().enumerate().map(of).collect();
        crate::mesher::make(&recipe, "scene", 1).unwrap_or_else(|found| panic!("{}", found.render(false)))
    }

    fn deck(&self) -> String {
        let material =
            |i: usize| format!("MATERIAL, {i}, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n");
        let materials: String = (1..=self.bricks.len()).map(material).collect();
        let friction: String =
            (2..=self.bricks.len()).map(|i| format!("CONTACT DATA, 1, {i}, {:?}\n", self.friction)).collect();
        format!(
            "TITLE\n scene\nTERMINATION TIME, 1.\nCONTACT MATERIAL\nCONTACT EDGES, {}\nCONTACT SEARCH, GRID, {:?}, 0.1\n{friction}{materials}EXIT\n",
            self.edges, self.reach
        )
    }

    /// Puts the bricks where they begin, each against those before it, and gives them their velocities.
    fn stage(&self) -> Stage {
        let mut mesh = self.mesh();
        let nodes = mesh.coordinates.len();
        let (mut velocity, mut pull, mut fixed) = (vec![[0.0; 3]; nodes], vec![[0.0; 3]; nodes], vec![false; nodes]);
        let mut noise = Noise(self.noise);
        let (mut placed, mut last): (Vec<usize>, Vec<usize>) = Default::default();
        for (i, brick) in self.bricks.iter().enumerate() {
            let mut own: Vec<usize> = mesh.blocks[i].nodes.iter().map(|&n| n as usize).collect();
            own.sort_unstable();
            own.dedup();
            let length = dot(brick.towards, brick.towards).sqrt().max(1e-3);
            let way = scaled(brick.towards, 1.0 / length);
            let upright = if brick.aligned { (cross([0.0, 0.0, 1.0], way), way[2].acos()) } else { brick.turned };
            own.iter().for_each(|&n| mesh.coordinates[n] = turn(mesh.coordinates[n], upright));
            let height = |&n: &usize| dot(mesh.coordinates[n], way);
            let top = placed.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
            let foot = own.iter().map(height).fold(f64::INFINITY, f64::min);
            let lift = if placed.is_empty() { 0.0 } else { top - foot + brick.away };
            let beside = subtract(brick.beside, scaled(way, dot(brick.beside, way)));
            for &n in &own {
                let spin = cross(brick.spin, mesh.coordinates[n]);
                mesh.coordinates[n] = add(mesh.coordinates[n], add(scaled(way, lift), beside));
                let own = add(spin, noise.vector(brick.jitter));
                velocity[n] = add(add(brick.slide, own), scaled(way, -brick.speed));
                pull[n] = scaled(way, brick.pull * brick.speed);
                fixed[n] = self.held && i == 0;
            }
            if brick.both {
                for &n in &last {
                    velocity[n] = add(velocity[n], scaled(way, brick.speed));
                    pull[n] = subtract(pull[n], scaled(way, brick.pull * brick.speed));
                }
            }
            placed.extend(&own);
            last = own;
        }
        self.hold_together(mesh, velocity, pull, fixed)
    }

    fn hold_together(&self, mesh: Mesh, velocity: Vec<[f64; 3]>, pull: Vec<[f64; 3]>, fixed: Vec<bool>) -> Stage {
        let model = match examine(Source::new("scene", self.deck()), Some(&mesh)) {
            Ok(problem) => problem.model,
            Err(found) => panic!("{}", found.render(false)),
        };
        let body = Body::new(&mesh, &model).expect("materials");
        let at = |n: usize| body.positions[n];
        let mut springs: Vec<(usize, usize)> = Vec::new();
        for corners in mesh.hexahedra() {
            let corners = corners.map(|n| n as usize);
            springs.extend(
                (0..8).flat_map(|i| (0..i).map(move |j| (corners[i].min(corners[j]), corners[i].max(corners[j])))),
            );
        }
        springs.sort_unstable();
        springs.dedup();
        let length = |(a, b): (usize, usize)| (a, b, dot(subtract(at(b), at(a)), subtract(at(b), at(a))).sqrt());
        let springs = springs.into_iter().map(length).collect();
        Stage { mesh, model, body, velocity, pull, fixed, springs }
    }
}

impl Stage {
    fn nodes(&self) -> Nodes {
        let row = |n: usize| {
            let ([x, y, z], [u, v, w]) = (self.body.positions[n], self.velocity[n]);
            Row(if self.fixed[n] { [x, y, z, MASS, 0.0, 0.0, 0.0, 0.0] } else { [x, y, z, MASS, u, v, w, 1.0 / MASS] })
        };
        let count = self.mesh.coordinates.len();
        Nodes {
            rows: (0..count).map(row).collect(),
            forces: vec![Force::default(); count],
            mesh: self.body.positions.clone(),
            beside: Vec::new(),
            places: count,
            file: (0..count as u32).collect(),
            owned: vec![true; count],
            rates: Default::default(),
            passive: Vec::new(),
        }
    }

    fn contact(&self, nodes: &Nodes) -> Contact {
        let local: Vec<u32> = (0..nodes.len() as u32).collect();
        let elements: Vec<u32> = (0..self.mesh.element_count() as u32).collect();
        let held = vec![[crate::solver::contact::ABSENT; 3]; nodes.len()];
        let surfaces = crate::solver::contact::surfaces(&self.mesh, &self.model, &self.body);
        let contact = Contact::new(
            &self.mesh,
            &self.model,
            (&self.body, surfaces),
            (nodes, held),
            (&local, &elements),
            &mut Serial,
        );
        contact.expect("the deck asks for contact")
    }

    /// Forces of springs and pull.
    fn load(&self, nodes: &mut Nodes) {
        for (force, pull) in nodes.forces.iter_mut().zip(&self.pull) {
            force.0[..3].copy_from_slice(pull);
        }
        for &(a, b, length) in &self.springs {
            let way = subtract(nodes.position(b as u32), nodes.position(a as u32));
            let now = dot(way, way).sqrt().max(1e-9);
            let pull = scaled(way, STIFFNESS * (now - length) / now);
            for i in 0..3 {
                nodes.forces[a].0[i] += pull[i];
                nodes.forces[b].0[i] -= pull[i];
            }
        }
    }
}

/// One step on one rank, with everything awake if asked.
fn step(contact: &mut Contact, nodes: &mut Nodes, awake: bool) {
    contact.bring_motion(nodes, &STEP, &mut Serial);
    if awake {
        // On one rank the points of the local problem are those of the layout.
        let held: Vec<u32> = contact.problem.history().points.iter().map(|(point, _)| *point).collect();
        contact.problem.locator.wake(&held);
    }
    contact.enforce(&STEP, &mut Serial);
    contact.bring_forces(nodes, &mut Serial);
    contact.contact_nodes.hand_over(nodes, |_, _| ());
    nodes.integrate(STEP.kick, STEP.drift);
}

/// What scenes have shown: constraints of faces and of edges, and candidates that slept.
#[derive(Default)]
struct Seen([Cell<u64>; 3]);

impl Seen {
    fn add(&self, contact: &Contact) {
        let faces = contact
            .problem
            .constraints
            .iter()
            .filter(|c| c.count == crate::solver::contact::enforcement::constraint::MEMBERS)
            .count() as u64;
        let edges = contact.problem.constraints.len() as u64 - faces;
        let now = [faces, edges, contact.problem.locator.asleep()];
        self.0.iter().zip(now).for_each(|(sum, now)| sum.set(sum.get() + now));
    }
}

fn plays_the_same(scene: &Scene, seen: &Seen) -> Result<(), TestCaseError> {
    let stage = scene.stage();
    let mut nodes = [stage.nodes(), stage.nodes()];
    let mut contacts = [0, 1].map(|i| stage.contact(&nodes[i]));
    let (struck, when, velocity) = scene.strike;
    for number in 0..STEPS {
        for (i, (nodes, contact)) in nodes.iter_mut().zip(&mut contacts).enumerate() {
            stage.load(nodes);
            let struck = struck % nodes.len();
            if number == when && !stage.fixed[struck] {
                // A blow is a force: what moves a node otherwise than by its velocity is not seen by those that sleep.
                let inverse = nodes.rows[struck].0[7];
                (0..3).for_each(|axis| nodes.forces[struck].0[axis] += velocity[axis] / (STEP.kick * inverse));
            }
            step(contact, nodes, i == 1);
        }
        let [sleeping, awake] = &contacts;
        prop_assert_eq!(&sleeping.problem.constraints, &awake.problem.constraints, "step {}", number);
        let [a, b] = &nodes;
        let bits = |nodes: &Nodes| nodes.rows.iter().flat_map(|row| row.0.map(f64::to_bits)).collect::<Vec<u64>>();
        prop_assert!(bits(a) == bits(b), "bits in step {}", number);
        seen.add(sleeping);
    }
    Ok(())
}

#[test]
fn sleep_loses_no_contact() {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(SCENES);
    let seen = Seen::default();
    let mut runner = TestRunner::new(Config { cases, failure_persistence: None, ..Config::default() });
    if let Err(failure) = runner.run(&scene(), |scene| plays_the_same(&scene, &seen)) {
        panic!("{failure}");
    }
    let [faces, edges, asleep] = seen.0.map(|sum| sum.get() / u64::from(cases));
    println!("in each scene {faces} constraints of faces, {edges} of edges, {asleep} candidates asleep over all steps");
    assert!(faces > 0 && asleep > 0, "scenes without contact or without sleep show nothing");
}
