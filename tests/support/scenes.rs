//! Random confined scenes: bodies that press, pinch, hold and fold upon each other, where contact has most to do wrong.
//!
//! Every scene is a recipe and a deck that follow from a seed, small enough for thousands of runs.

use std::fmt::Write;
use std::ops::Range;

/// A scene to run.
pub struct Scene {
    /// What kind of scene it is.
    pub kind: &'static str,
    /// The mesh's recipe.
    pub recipe: String,
    /// The deck.
    pub deck: String,
    /// Whether there is friction.
    pub friction: bool,
}

impl Scene {
    /// The same scene whose mesh has the parts the other way round: nodes, faces and edges have other numbers, and nothing else is another.
    pub fn in_another_order(self) -> Scene {
        let makes = |line: &&str| ["BOX,", "SHEET", "LINE,"].iter().any(|verb| line.starts_with(verb));
        let (mut parts, rest): (Vec<&str>, Vec<&str>) = self.recipe.lines().partition(makes);
        parts.reverse();
        // The title comes first, and what moves or names parts stands behind them.
        let (title, rest) = rest.split_at(2);
        let lines = title.iter().chain(&parts).chain(rest);
        let recipe = lines.map(|line| format!("{line}\n")).collect();
        Scene { recipe, ..self }
    }
}

/// The seeds that `URTO_SCENES` asks for, or else these; and whether it asks.
pub fn asked_for(seeds: Range<u64>) -> (Range<u64>, bool) {
    let asked = std::env::var("URTO_SCENES").ok().and_then(|text| {
        let (from, to) = text.split_once("..")?;
        Some(from.parse().ok()?..to.parse().ok()?)
    });
    let is_asked = asked.is_some();
    (asked.unwrap_or(seeds), is_asked)
}

/// Numbers that look random and follow from a seed (splitmix64: Steele, Lea and Flood 2014).
pub struct Dice(u64);

impl Dice {
    /// Numbers of a seed.
    pub fn of(seed: u64) -> Dice {
        Dice(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ 0x5851_f42d_4c95_7f2d)
    }

    pub(super) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Evenly spread between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Evenly spread in its logarithm.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }

    /// A count between two, both of them possible.
    pub fn count(&mut self, low: usize, high: usize) -> usize {
        low + (self.next() * (high - low + 1) as f64) as usize
    }

    /// True with a probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.next() < probability
    }

    /// One of some choices.
    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.count(0, choices.len() - 1)]
    }
}

/// Steel, in metres, kilogrammes and seconds: what all stiffnesses and densities are told against.
pub(super) const YOUNG: f64 = 2e11;
const DENSITY: f64 = 7800.0;

/// Steps in which a notch closes and is pressed on.
const NOTCH_STEPS: f64 = 600.0;

pub(super) struct Builder {
    pub(super) dice: Dice,
    pub(super) recipe: String,
    deck: String,
    /// Largest wave speed and smallest thickness of an element: they set the step.
    pub(super) speed: f64,
    pub(super) thinnest: f64,
}

impl Builder {
    pub(super) fn boxed(&mut self, block: usize, corner: [f64; 3], size: [f64; 3], cells: [usize; 3]) {
        let ([x, y, z], [a, b, c], [l, m, n]) = (corner, size, cells);
        let _ = writeln!(self.recipe, "BOX, {block}, {x:?}, {y:?}, {z:?}, {a:?}, {b:?}, {c:?}, {l}, {m}, {n}");
        for (length, count) in size.iter().zip(cells) {
            self.thinnest = self.thinnest.min(length / count as f64);
        }
    }

    pub(super) fn material(&mut self, block: usize, stiffness: f64, density: f64) {
        let (young, density) = (YOUNG * stiffness, DENSITY * density);
        self.speed = self.speed.max((1.35 * young / density).sqrt());
        let _ = if self.dice.chance(0.3) {
            let strength = young * self.dice.magnitude(1e-3, 1e-2);
            writeln!(
                self.deck,
                "MATERIAL, {block}, ELASTIC PLASTIC, {density:?}\nYOUNGS MODULUS = {young:?}\nPOISSONS RATIO = 0.3\n\
                 YIELD STRESS = {strength:?}\nHARDENING MODULUS = {:?}\nBETA = 1.\nEND",
                0.05 * young
            )
        } else {
            let ratio = self.dice.one_of(&[0.0, 0.3, 0.45]);
            writeln!(
                self.deck,
                "MATERIAL, {block}, ELASTIC, {density:?}\nYOUNGS MODULUS = {young:?}\nPOISSONS RATIO = {ratio:?}\nEND"
            )
        };
    }

    pub(super) fn line(&mut self, text: &str) {
        let _ = writeln!(self.deck, "{text}");
    }

    pub(super) fn mesh_line(&mut self, text: &str) {
        let _ = writeln!(self.recipe, "{text}");
    }

    /// Contact of all blocks, with friction in a third of the scenes and now and then few passes.
    pub(super) fn contact(&mut self, blocks: usize) -> bool {
        self.line("CONTACT MATERIAL");
        let friction = self.dice.chance(0.33);
        if friction {
            let coefficient = self.dice.one_of(&[0.1, 0.5, 2.0]);
            for i in 1..=blocks {
                for j in i..=blocks {
                    self.line(&format!("CONTACT DATA, {i}, {j}, {coefficient:?}"));
                }
            }
        }
        if self.dice.chance(0.2) {
            let passes = self.dice.one_of(&[1, 3, 50]);
            self.line(&format!("CONTACT PASSES, {passes}"));
        }
        if self.dice.chance(0.15) {
            self.line("CONTACT EDGES, ON");
        }
        friction
    }

    /// The finished scene, which lasts so many steps of the thinnest element of the stiffest body.
    pub(super) fn finish(self, kind: &'static str, friction: bool, steps: f64) -> Scene {
        let time = steps * 0.5 * self.thinnest / self.speed;
        let deck = format!(
            "TITLE\n {kind}\nTERMINATION TIME, {time:?}\nOUTPUT TIME, {time:?}\nPLOT TIME, {time:?}\n{}EXIT\n",
            self.deck
        );
        Scene { kind, recipe: self.recipe, deck, friction }
    }
}

/// What the scene of a seed is built with.
pub(super) fn builder(seed: u64) -> Builder {
    Builder {
        dice: Dice::of(seed),
        recipe: "TITLE\n SCENE\n".into(),
        deck: String::new(),
        speed: 0.0,
        thinnest: f64::INFINITY,
    }
}

/// The scene of a seed.
pub fn scene(seed: u64) -> Scene {
    let builder = builder(seed);
    match seed % 8 {
        0 => stack(builder, false),
        1 => stack(builder, true),
        2 => lined_box(builder),
        3 => sheet(builder),
        4 => notch(builder),
        5 => fold(builder),
        6 => grains(builder),
        _ => perforated(builder),
    }
}

/// Steps in which a box falls and rebounds.
const BOX_STEPS: f64 = 700.0;

/// Steps in which bodies are pressed together.
const PRESS_STEPS: f64 = 600.0;

/// Layers of very different stiffness and density between two plates that are driven together; held at one end, by one
/// plane of nodes, in some or all directions, or not at all.
fn stack(mut b: Builder, held: bool) -> Scene {
    let layers = b.dice.count(2, 5);
    let (mut z, wide) = (0.0, b.dice.between(0.6, 1.5));
    let tilt = if b.dice.chance(0.3) { b.dice.between(-8.0, 8.0) } else { 0.0 };
    // What a held stack's load would have to close it would hardly touch.
    let gap = if held { 0.0 } else { b.dice.one_of(&[0.0, 0.0, 1e-5, 1e-3]) };
    for block in 1..=layers {
        let thick = b.dice.magnitude(0.02, 0.3);
        let cells = [b.dice.count(1, 4), b.dice.count(1, 4), b.dice.count(1, 2)];
        let (dx, dy) = if held { (0.0, 0.0) } else { (b.dice.between(-0.1, 0.1), b.dice.between(-0.1, 0.1)) };
        b.boxed(block, [dx, dy, z], [wide, wide, thick], cells);
        z += thick + gap;
        let (stiffness, density) = (b.dice.magnitude(1e-4, 1e4), b.dice.magnitude(1e-4, 1e4));
        // A wave speed within bounds, or no scene would last long enough for anything to happen.
        let density = density.clamp(stiffness * 1e-2, stiffness * 1e2);
        b.material(block, stiffness, density);
    }
    for block in 1..=layers {
        b.mesh_line(&format!("ROTATE, {block}, Y, {tilt:?}"));
    }
    let friction = b.contact(layers);
    if held {
        b.mesh_line("NODE SET PLANE, 1, X, 0.");
        b.mesh_line(&format!("SIDE SET PLANE, 10, Z, {:?}", z - gap));
        if tilt != 0.0 {
            // The planes of the sets are cut before the turn.
            b.recipe =
                b.recipe.lines().filter(|line| !line.starts_with("ROTATE")).map(|line| format!("{line}\n")).collect();
        }
        let directions: &[&str] = b.dice.one_of(&[&["X", "Y", "Z"][..], &["Z"][..], &["X", "Z"][..]]);
        for direction in directions {
            b.line(&format!("NO DISPLACEMENT, {direction}, 1"));
        }
        b.line("FUNCTION, 1\n0., 1.\n1., 1.\nEND");
        let pressure = YOUNG * b.dice.magnitude(1e-8, 1e-4);
        b.line(&format!("PRESSURE, 10, 1, {pressure:?}"));
    } else {
        let speed = b.speed * b.dice.magnitude(1e-5, 1e-2);
        let aside = b.dice.one_of(&[0.0, 0.3]) * speed;
        b.line(&format!("INITIAL VELOCITY MATERIAL, 1, {aside:?}, 0., {speed:?}"));
        b.line(&format!("INITIAL VELOCITY MATERIAL, {layers}, 0., 0., {:?}", -speed));
    }
    b.finish(if held { "stack held at one end" } else { "walled stack" }, friction, 400.0)
}

/// A box in a box with a lining, dropped on a plane.
fn lined_box(mut b: Builder) -> Scene {
    let (wall, lining) = (b.dice.between(0.02, 0.05), b.dice.between(0.1, 0.2));
    let core = 1.0 - 2.0 * (wall + lining);
    let cuts = [0.0, wall, wall + lining, wall + lining + core, 1.0 - wall];
    let lengths = [wall, lining, core, lining, wall];
    let cells = [1, b.dice.count(1, 2), b.dice.count(1, 3), 1, 1];
    for i in 0..5 {
        for j in 0..5 {
            for k in 0..5 {
                let at = [i, j, k];
                let block = if at.iter().any(|&c| c == 0 || c == 4) {
                    1
                } else if at == [2, 2, 2] {
                    3
                } else if at.iter().filter(|&&c| c == 2).count() == 2 {
                    2
                } else {
                    continue;
                };
                b.boxed(block, at.map(|c| cuts[c]), at.map(|c| lengths[c]), at.map(|c| cells[c]));
            }
        }
    }
    for block in [1, 2] {
        b.mesh_line(&format!("MERGE, {block}"));
    }
    b.material(1, 1.0, 1.0);
    let (stiffness, density) = (b.dice.magnitude(1e-4, 1.0), b.dice.magnitude(1e-2, 1.0));
    b.material(2, stiffness, density);
    b.material(3, 1.0, 1.0);
    let speed = b.speed * b.dice.magnitude(1e-4, 2e-2);
    // It meets the plane within the first tenth of the time.
    let travel = speed * BOX_STEPS * 0.5 * b.thinnest / b.speed;
    let (angle, gap) = (b.dice.between(0.0, 45.0), b.dice.between(0.0, 0.1) * travel);
    for block in 1..=3 {
        b.mesh_line(&format!("ROTATE, {block}, Y, {angle:?}"));
        b.mesh_line(&format!("TRANSLATE, {block}, 0., 0., {:?}", angle.to_radians().sin() + gap));
    }
    b.mesh_line("SIDE SET BLOCK, 1, 1");
    let friction = b.contact(3);
    b.line(&format!("RIGID SURFACE, 1, 0., 0., 0., 0., 0., 1., {}", if friction { 0.3 } else { 0.0 }));
    for block in 1..=3 {
        b.line(&format!("INITIAL VELOCITY MATERIAL, {block}, 0., 0., {:?}", -speed));
    }
    b.finish("lined box", friction, BOX_STEPS)
}

/// A sheet of one or two layers of elements whose rim is pulled, pushed and twisted.
fn sheet(mut b: Builder) -> Scene {
    let (cells, layers) = (b.dice.count(4, 8), b.dice.count(1, 2));
    let thick = b.dice.between(0.02, 0.08);
    b.boxed(1, [0.0, 0.0, 0.0], [1.0, 1.0, thick], [cells, cells, layers]);
    b.mesh_line("NODE SET PLANE, 1, X, 0.");
    b.mesh_line("NODE SET PLANE, 2, X, 1.");
    b.material(1, 1.0, 1.0);
    let friction = b.contact(1);
    b.line("FUNCTION, 1\n0., 1.\n1., 1.\nEND");
    let speed = b.speed * b.dice.magnitude(1e-2, 6e-2);
    for set in 1..=2 {
        for axis in ["X", "Y", "Z"] {
            let part = b.dice.between(-1.0, 1.0);
            b.line(&format!("PRESCRIBED VELOCITY, {axis}, {set}, 1, {:?}", part * speed));
        }
    }
    b.finish("sheet", friction, 1200.0)
}

/// A body with a notch that closes, or a fold of two leaves, pressed together.
fn notch(mut b: Builder) -> Scene {
    let (gap, leaf) = (b.dice.magnitude(0.005, 0.1), b.dice.between(0.08, 0.25));
    let cells = b.dice.count(3, 6);
    // Two leaves and the bend that joins them.
    b.boxed(1, [0.0, 0.0, 0.0], [1.0, 0.3, leaf], [cells, 2, 1]);
    b.boxed(1, [0.0, 0.0, leaf + gap], [1.0, 0.3, leaf], [cells, 2, 1]);
    let first = 1.0 / cells as f64;
    b.boxed(1, [0.0, 0.0, leaf], [first, 0.3, gap], [1, 2, 1]);
    b.mesh_line("MERGE, 1");
    b.mesh_line(&format!("NODE SET PLANE, 2, Z, {:?}", 2.0 * leaf + gap));
    b.mesh_line("NODE SET PLANE, 1, Z, 0.");
    let (stiffness, density) = (b.dice.magnitude(1e-2, 1e2), b.dice.magnitude(1e-1, 1e1));
    b.material(1, stiffness, density);
    // Something between the leaves.
    let (filled, thick) = (b.dice.chance(0.5), gap * b.dice.between(0.5, 1.0));
    if filled {
        let cells = [b.dice.count(1, 5), 2, 1];
        b.boxed(2, [first + 0.02, 0.0, leaf], [0.9 - first, 0.3, thick], cells);
        let (stiffness, density) = (b.dice.magnitude(1e-4, 1e2), b.dice.magnitude(1e-3, 1e1));
        b.material(2, stiffness, density);
    }
    let friction = b.contact(1 + usize::from(filled));
    b.line("NO DISPLACEMENT, Z, 1");
    // It closes within a third of the time, and what is between the leaves is squeezed by up to a fifth of its thickness.
    let time = NOTCH_STEPS * 0.5 * b.thinnest / b.speed;
    let squeezed = if filled { gap - thick + b.dice.between(0.0, 0.2) * thick } else { 1.02 * gap };
    let speed = (squeezed / (0.3 * time)).min(0.05 * b.speed);
    b.line(&format!("FUNCTION, 1\n0., 1.\n{0:?}, 1.\n{1:?}, 0.\n{2:?}, 0.\nEND", 0.3 * time, 0.31 * time, 2.0 * time));
    b.line(&format!("PRESCRIBED VELOCITY, Z, 2, 1, {:?}", -speed));
    b.finish("notch", friction, NOTCH_STEPS)
}

/// A sheet of one or two layers whose ends come together while its middle rises, until its leaves meet and are pressed.
fn fold(mut b: Builder) -> Scene {
    let (half, layers) = (b.dice.count(3, 7), b.dice.count(1, 2));
    let thick = b.dice.between(0.03, 0.1);
    b.boxed(1, [-0.5, 0.0, 0.0], [1.0, 0.3, thick], [2 * half, 2, layers]);
    b.mesh_line("NODE SET PLANE, 1, X, -0.5");
    b.mesh_line("NODE SET PLANE, 2, X, 0.5");
    b.mesh_line("NODE SET PLANE, 3, X, 0.");
    let soft = b.dice.magnitude(1e-2, 1.0);
    b.material(1, soft, 1.0);
    // A stiff core around which the sheet is laid.
    let (core, wide) = (b.dice.chance(0.4), b.dice.between(0.5, 2.0) * thick);
    if core {
        let cells = [b.dice.count(1, 2), 2, b.dice.count(1, 3)];
        b.boxed(2, [-0.5 * wide, 0.0, -0.3], [wide, 0.3, 0.3 - 1e-3], cells);
        let (stiffness, density) = (b.dice.magnitude(1e-1, 1e1), b.dice.magnitude(1e-1, 1e1));
        b.material(2, stiffness, density);
    }
    let friction = b.contact(1 + usize::from(core));
    let time = PRESS_STEPS * 0.5 * b.thinnest / b.speed;
    b.line(&format!("FUNCTION, 1\n0., 1.\n{:?}, 1.\nEND", 2.0 * time));
    // The leaves meet when each end is half a thickness from the middle; what is between them is met before.
    let apart = if core { 0.5 * (wide + thick) } else { 0.5 * thick };
    let way = 0.5 - b.dice.between(0.6, 1.0) * apart;
    let rise = if core { 0.0 } else { b.dice.between(0.3, 0.5) };
    for (set, axis, distance) in [(1, "X", way), (2, "X", -way), (3, "Z", rise)] {
        b.line(&format!("PRESCRIBED VELOCITY, {axis}, {set}, 1, {:?}", distance / time));
    }
    let low = if core { -b.dice.between(0.1, 0.3) } else { 0.0 };
    for set in 1..=2 {
        b.line(&format!("PRESCRIBED VELOCITY, Z, {set}, 1, {:?}", low / time));
    }
    b.finish("fold", friction, PRESS_STEPS)
}

/// Boxes of all sorts, turned at random, one upon the other between two plates that squeeze them: corners, edges and faces
/// meet.
fn grains(mut b: Builder) -> Scene {
    let count = b.dice.count(2, 5);
    let mut height = 0.0;
    for block in 1..=count {
        let size = [0, 1, 2].map(|_| b.dice.between(0.15, 0.28));
        let cells = [0, 1, 2].map(|_| b.dice.count(1, 3));
        b.boxed(block, size.map(|length| -0.5 * length), size, cells);
        let turns =
            [0, 1, 2].map(|_| if b.dice.chance(0.5) { b.dice.one_of(&[0.0, 45.0]) } else { b.dice.between(0.0, 90.0) });
        for (axis, turn) in ["X", "Y", "Z"].iter().zip(turns) {
            b.mesh_line(&format!("ROTATE, {block}, {axis}, {turn:?}"));
        }
        let half = half_height(size, turns);
        let aside = [0.1 * b.dice.next(), 0.1 * b.dice.next()];
        b.mesh_line(&format!("TRANSLATE, {block}, {:?}, {:?}, {:?}", aside[0], aside[1], height + half));
        height += 2.0 * half + 1e-3;
        let (stiffness, density) = (b.dice.magnitude(1e-2, 1e2), b.dice.magnitude(1e-1, 1e1));
        b.material(block, stiffness, density);
    }
    let plates = [count + 1, count + 2];
    for (plate, z) in plates.into_iter().zip([-0.101, height]) {
        let cells = [b.dice.count(1, 4), b.dice.count(1, 4), 1];
        b.boxed(plate, [-0.5, -0.5, z], [1.0, 1.0, 0.1], cells);
        let stiffness = b.dice.magnitude(1e-1, 1e2);
        b.material(plate, stiffness, 1.0);
    }
    b.mesh_line("NODE SET PLANE, 1, Z, -0.101");
    b.mesh_line(&format!("NODE SET PLANE, 2, Z, {:?}", height + 0.1));
    let friction = b.contact(count + 2);
    let time = PRESS_STEPS * 0.5 * b.thinnest / b.speed;
    b.line("NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1");
    b.line(&format!("FUNCTION, 1\n0., 1.\n{:?}, 1.\nEND", 2.0 * time));
    let speed = b.dice.magnitude(0.002, 0.05) * height / time;
    b.line(&format!("PRESCRIBED VELOCITY, Z, 2, 1, {:?}", -speed));
    let falls = if b.dice.chance(0.5) { speed } else { 0.0 };
    for block in 1..=count {
        b.line(&format!("INITIAL VELOCITY MATERIAL, {block}, 0., 0., {:?}", -falls));
    }
    b.finish("grains", friction, PRESS_STEPS)
}

/// Half of the height of a box that is turned by so many degrees about x, then y, then z.
fn half_height(size: [f64; 3], turns: [f64; 3]) -> f64 {
    let [(sx, cx), (sy, cy), _] = turns.map(|turn| turn.to_radians().sin_cos());
    // The last row of the product of the turns.
    let row = [-sy, sx * cy, cx * cy];
    0.5 * size.iter().zip(row).map(|(length, part)| length * part.abs()).sum::<f64>()
}

/// A block that is driven through a plate whose elements fail.
fn perforated(mut b: Builder) -> Scene {
    let thick = b.dice.between(0.1, 0.3);
    let (cells, layers) = (b.dice.count(5, 7), b.dice.count(1, 2));
    b.boxed(1, [-0.5, -0.5, 0.0], [1.0, 1.0, thick], [cells, cells, layers]);
    let (wide, long) = (b.dice.between(0.2, 0.4), b.dice.between(0.3, 0.8));
    b.boxed(2, [-0.5 * wide, -0.5 * wide, thick], [wide, wide, long], [2, 2, 3]);
    let turn = if b.dice.chance(0.5) { b.dice.between(0.0, 20.0) } else { 0.0 };
    b.mesh_line(&format!("ROTATE, 2, Y, {turn:?}"));
    b.mesh_line(&format!("TRANSLATE, 2, 0., 0., {:?}", 0.6 * wide * turn.to_radians().sin() + 1e-3));
    b.mesh_line("NODE SET PLANE, 1, X, -0.5");
    b.mesh_line("NODE SET PLANE, 1, X, 0.5");
    let _ = write!(
        b.deck,
        "MATERIAL, 1, ELASTIC PLASTIC, {DENSITY:?}\nYOUNGS MODULUS = {YOUNG:?}\nPOISSONS RATIO = 0.3\n\
         YIELD STRESS = 4.E8\nHARDENING MODULUS = 1.E9\nBETA = 1.\nEND\n"
    );
    b.speed = (1.35 * YOUNG / DENSITY).sqrt();
    let density = b.dice.magnitude(0.3, 3.0);
    b.material(2, 1.0, density);
    let friction = b.contact(2);
    let strain = b.dice.between(0.1, 0.5);
    b.line(&format!("DEATH, 1, EQPS, MAX, {strain:?}"));
    b.line("DEATH, 1, VOLUME, MIN, 0.2");
    b.line("NO DISPLACEMENT, Z, 1");
    let speed = b.dice.between(100.0, 400.0);
    let aside = b.dice.one_of(&[0.0, 0.2]) * speed;
    b.line(&format!("INITIAL VELOCITY MATERIAL, 2, {aside:?}, 0., {:?}", -speed));
    b.finish("perforation", friction, 700.0)
}
