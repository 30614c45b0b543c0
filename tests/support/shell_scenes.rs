//! Random confined scenes of shells: sheets that fold, tubes that are squeezed, boxes of sheet metal between plates.

use super::scenes::{Builder, Scene, builder};

/// The scene of a seed.
pub fn shell_scene(seed: u64) -> Scene {
    let builder = builder(seed);
    match seed % 6 {
        0 => rim(builder),
        1 => fold(builder),
        2 => tube(builder),
        3 => boxes(builder),
        4 => layers(builder),
        _ => bars(builder),
    }
}

/// The same scene with every sheet divided into triangles.
pub fn triangle_scene(seed: u64) -> Scene {
    let Scene { recipe, .. } = shell_scene(seed);
    let (mut text, mut sheets) = (recipe, Vec::new());
    for line in text.lines().filter(|line| line.starts_with("SHEET")) {
        let block = line.split(',').nth(1).unwrap_or_default().trim().to_string();
        sheets.push(block);
    }
    sheets.sort_unstable();
    sheets.dedup();
    let patterns = ["ALTERNATING", "DIAGONAL", "CROSS"];
    for block in sheets {
        text += &format!("TRIANGLES, {block}, {}\n", patterns[(seed / 6 % 3) as usize]);
    }
    Scene { recipe: text, ..shell_scene(seed) }
}

/// Steps of a scene.
const STEPS: f64 = 500.0;

impl Builder {
    /// A sheet of a block; one of its sizes is 0.
    fn sheet(&mut self, block: usize, [x, y, z]: [f64; 3], size: [f64; 3], [m, n]: [usize; 2]) {
        let [a, b, c] = size;
        self.mesh_line(&format!("SHEET, {block}, {x:?}, {y:?}, {z:?}, {a:?}, {b:?}, {c:?}, {m}, {n}"));
        let lengths = size.into_iter().filter(|length| *length > 0.0);
        self.thinnest = lengths.zip([m, n]).fold(self.thinnest, |least, (l, n)| least.min(0.7 * l / n as f64));
    }

    fn shells(&mut self, block: usize, thickness: f64) {
        self.line(&format!("SHELL THICKNESS, {block}, {thickness:?}"));
        let points = self.dice.one_of(&[2, 3, 5]);
        self.line(&format!("INTEGRATION POINTS, {block}, {points}"));
    }

    fn constant(&mut self) {
        self.line("FUNCTION, 1\n0., 1.\n1., 1.\nEND");
    }

    /// Two plates that are driven together by up to `most`, the lower one at rest.
    fn plates(&mut self, [first, second]: [usize; 2], [low, high]: [f64; 2], most: f64) {
        for (plate, z) in [(first, low - 0.1), (second, high)] {
            let cells = [self.dice.count(3, 6), self.dice.count(3, 6), 1];
            self.boxed(plate, [-0.6, -0.6, z], [1.2, 1.2, 0.1], cells);
            let stiffness = self.dice.magnitude(1e-1, 1e1);
            self.material(plate, stiffness, 1.0);
        }
        self.mesh_line(&format!("NODE SET PLANE, 91, Z, {:?}", low - 0.1));
        self.mesh_line(&format!("NODE SET PLANE, 92, Z, {:?}", high + 0.1));
        self.line("NO DISPLACEMENT, X, 91\nNO DISPLACEMENT, Y, 91\nNO DISPLACEMENT, Z, 91");
        let time = STEPS * 0.5 * self.thinnest / self.speed;
        let speed = self.dice.between(0.2, 1.0) * most / time;
        self.line(&format!("PRESCRIBED VELOCITY, Z, 92, 1, {:?}", -speed));
    }
}

/// A sheet whose rim is pulled, pushed and twisted.
fn rim(mut b: Builder) -> Scene {
    let cells = b.dice.count(4, 8);
    b.sheet(1, [0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [cells, cells]);
    b.mesh_line("NODE SET PLANE, 1, X, 0.");
    b.mesh_line("NODE SET PLANE, 2, X, 1.");
    let thickness = b.dice.magnitude(1e-3, 0.08);
    b.shells(1, thickness);
    b.material(1, 1.0, 1.0);
    let friction = b.contact(1);
    b.constant();
    let speed = b.speed * b.dice.magnitude(1e-2, 3e-2);
    for set in 1..=2 {
        for axis in ["X", "Y", "Z"] {
            let part = b.dice.between(-1.0, 1.0);
            b.line(&format!("PRESCRIBED VELOCITY, {axis}, {set}, 1, {:?}", part * speed));
        }
    }
    b.finish("shell rim", friction, STEPS)
}

/// A sheet whose ends come together while its middle rises, until its leaves meet and are pressed.
fn fold(mut b: Builder) -> Scene {
    let half = b.dice.count(7, 12);
    b.sheet(1, [-0.5, 0.0, 0.0], [1.0, 0.3, 0.0], [2 * half, 3]);
    let thickness = b.dice.magnitude(5e-3, 0.08);
    b.shells(1, thickness);
    b.mesh_line("NODE SET PLANE, 1, X, -0.5");
    b.mesh_line("NODE SET PLANE, 2, X, 0.5");
    b.mesh_line("NODE SET PLANE, 3, X, 0.");
    b.material(1, 1.0, 1.0);
    let friction = b.contact(1);
    let time = STEPS * 0.5 * b.thinnest / b.speed;
    b.constant();
    // The ends stop where their thickness leaves no room.
    let (way, rise) = (0.5 - b.dice.between(0.55, 1.0) * thickness, b.dice.between(0.3, 0.45));
    for (set, axis, distance) in [(1, "X", way), (2, "X", -way), (3, "Z", rise)] {
        b.line(&format!("PRESCRIBED VELOCITY, {axis}, {set}, 1, {:?}", distance / time));
    }
    b.finish("shell fold", friction, STEPS)
}

/// A tube, lying or standing, between plates.
fn tube(mut b: Builder) -> Scene {
    let (around, along) = (b.dice.count(16, 26), b.dice.count(4, 7));
    b.mesh_line(&format!("SHEET TUBE, 1, 0.3, 0.6, {around}, {along}"));
    b.thinnest = (0.6 / along as f64).min(1.8 / around as f64) * 0.7;
    let thickness = b.dice.magnitude(3e-3, 0.05);
    let lies = b.dice.chance(0.6);
    if lies {
        b.mesh_line("ROTATE, 1, X, 90.");
        b.mesh_line("TRANSLATE, 1, 0., 0.3, 0.");
    }
    b.shells(1, thickness);
    let soft = b.dice.magnitude(1e-2, 1.0);
    b.material(1, soft, 1.0);
    let friction = b.contact(3);
    b.constant();
    let room = 0.5 * thickness + 1e-3;
    let (heights, most) = if lies { ([-0.3 - room, 0.3 + room], 0.4) } else { ([-room, 0.6 + room], 0.3) };
    b.plates([2, 3], heights, most);
    b.finish("shell tube", friction, STEPS)
}

/// Boxes of sheet metal, turned at random, between plates.
fn boxes(mut b: Builder) -> Scene {
    let count = b.dice.count(1, 2);
    let mut height = 0.0;
    for block in 1..=count {
        let a: f64 = b.dice.between(0.2, 0.4);
        let n = b.dice.count(2, 3);
        let thickness = b.dice.magnitude(2e-3, 0.02);
        for side in [0.0, a] {
            let from = side - 0.5 * a;
            b.sheet(block, [from, -0.5 * a, -0.5 * a], [0.0, a, a], [n, n]);
            b.sheet(block, [-0.5 * a, from, -0.5 * a], [a, 0.0, a], [n, n]);
            b.sheet(block, [-0.5 * a, -0.5 * a, from], [a, a, 0.0], [n, n]);
        }
        b.mesh_line(&format!("MERGE, {block}"));
        let turn = if b.dice.chance(0.5) { 45.0 } else { b.dice.between(0.0, 90.0) };
        let axis = b.dice.one_of(&["X", "Y"]);
        b.mesh_line(&format!("ROTATE, {block}, {axis}, {turn:?}"));
        let half = 0.5 * a * (turn.to_radians().sin() + turn.to_radians().cos()) + 0.5 * thickness + 1e-3;
        let aside = 0.1 * b.dice.next();
        b.mesh_line(&format!("TRANSLATE, {block}, {aside:?}, 0., {:?}", height + half));
        height += 2.0 * half;
        b.shells(block, thickness);
        let stiffness = b.dice.magnitude(1e-1, 1e1);
        b.material(block, stiffness, 1.0);
    }
    let friction = b.contact(count + 2);
    b.constant();
    b.plates([count + 1, count + 2], [-1e-3, height + 1e-3], 0.4 * height);
    b.finish("shell boxes", friction, STEPS)
}

/// Sheets between plates, at the distance of their thickness or nearer.
fn layers(mut b: Builder) -> Scene {
    let count = b.dice.count(2, 4);
    let crowded = b.dice.one_of(&[1.0, 1.01, 0.5]);
    let mut z = 0.0;
    for block in 1..=count {
        let thickness = b.dice.magnitude(3e-3, 0.05);
        z += 0.5 * crowded * thickness;
        let wide = b.dice.between(0.5, 1.0);
        let cells = [b.dice.count(2, 5), b.dice.count(2, 5)];
        b.sheet(block, [-0.5 * wide, -0.5 * wide, z], [wide, wide, 0.0], cells);
        z += 0.5 * crowded * thickness;
        b.shells(block, thickness);
        let stiffness = b.dice.magnitude(1e-1, 1e1);
        b.material(block, stiffness, 1.0);
    }
    let friction = b.contact(count + 2);
    b.constant();
    b.plates([count + 1, count + 2], [0.0, z], 0.004);
    b.finish("shell layers", friction, STEPS)
}

/// Bars of trusses or beams that fall between a sheet and a plate that comes down on them.
fn bars(mut b: Builder) -> Scene {
    b.sheet(1, [-0.5, -0.5, 0.0], [1.0, 1.0, 0.0], [5, 5]);
    let thickness = b.dice.magnitude(3e-3, 0.03);
    b.shells(1, thickness);
    b.material(1, 1.0, 1.0);
    let radius = b.dice.magnitude(2e-3, 0.02);
    let beams = b.dice.chance(0.5);
    for block in 2..=3 {
        let (x, y) = (b.dice.between(-0.4, 0.4), b.dice.between(-0.4, 0.4));
        let z = 0.5 * thickness + radius + 1e-3;
        b.mesh_line(&format!("LINE, {block}, {x:?}, -0.4, {z:?}, {y:?}, 0.4, {z:?}, 8"));
        match beams {
            true => b.line(&format!("BEAM SECTION, {block}, ROD, {radius:?}")),
            false => b.line(&format!("TRUSS AREA, {block}, {:?}", std::f64::consts::PI * radius * radius)),
        }
        b.material(block, 1.0, 1.0);
    }
    b.thinnest = b.thinnest.min(0.07);
    let friction = b.contact(5);
    b.constant();
    let high = 0.5 * thickness + 2.0 * radius + 2e-3;
    b.plates([4, 5], [-0.5 * thickness - 1e-3, high], 0.004);
    b.finish("bars", friction, STEPS)
}
