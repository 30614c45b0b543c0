//! Random scenes of parts that are no bodies of elements alone, rigid blocks and blocks that are tied, and with settings
//! that are not the default.

use super::scenes::{Scene, builder, scene};

/// The confined scene of a seed with one of its blocks, if it has several, as a rigid body.
pub fn rigid_scene(seed: u64) -> Scene {
    let mut scene = scene(seed);
    let of_block = |line: &str| line.strip_prefix("MATERIAL, ")?.split(',').next()?.parse().ok();
    let blocks: Vec<usize> = scene.deck.lines().filter_map(of_block).collect();
    if blocks.len() > 1 {
        let rigid = blocks[seed as usize % blocks.len()];
        // What is rigid does not fail.
        let dies = format!("DEATH, {rigid},");
        let kept = scene.deck.lines().filter(|line| !line.starts_with(&dies) && *line != "EXIT");
        let kept: String = kept.map(|line| format!("{line}\n")).collect();
        scene.deck = format!("{kept}RIGID BODY, {rigid}\nEXIT\n");
    }
    scene
}

/// The confined scene of a seed with the step of the mesh as a whole, in single precision, or both; and with either kind of
/// hourglass control.
pub fn settings_scene(seed: u64) -> Scene {
    let mut scene = scene(seed);
    let mut settings = match (seed / 8) % 3 {
        0 => "TIME STEP ESTIMATE, GLOBAL\n".to_string(),
        1 => "PRECISION, SINGLE\n".to_string(),
        _ => "TIME STEP ESTIMATE, GLOBAL\nPRECISION, SINGLE\n".to_string(),
    };
    if (seed / 24) % 2 == 1 {
        settings += "HOURGLASS STIFFENING, 0.05, 0.\n";
    }
    scene.deck = scene.deck.replace("EXIT\n", &(settings + "EXIT\n"));
    scene
}

/// Two blocks that are tied where they lie upon each other, with meshes that do not match, and a third that hits them; the
/// joint covers faces in part, and coarse faces follow finer ones as often as the other way round.
pub fn tied_scene(seed: u64) -> Scene {
    let mut b = builder(seed);
    let dice = &mut b.dice;
    let [below, above, thrown] = [dice.count(2, 6), dice.count(2, 6), dice.count(1, 3)];
    let heights = [dice.between(0.2, 0.6), dice.between(0.1, 0.5)];
    let (place, width) = ([dice.between(-0.4, 0.5), dice.between(-0.4, 0.5)], dice.between(0.5, 1.2));
    let layers = [dice.count(1, 3), dice.count(1, 3)];
    let stiffness = [1.0, dice.magnitude(1e-2, 1e2), dice.magnitude(0.1, 10.0)];
    let density = [1.0, dice.magnitude(0.1, 10.0), dice.magnitude(0.1, 10.0)];
    let speed = dice.magnitude(1.0, 100.0);
    let side = dice.between(0.2, 0.6);
    let at = [place[0] + dice.between(0.0, 0.5) * width, place[1] + dice.between(0.0, 0.5) * width];
    b.boxed(1, [0.0; 3], [1.0, 1.0, heights[0]], [below, below, layers[0]]);
    b.boxed(2, [place[0], place[1], heights[0]], [width, width, heights[1]], [above, above, layers[1]]);
    b.boxed(3, [at[0], at[1], heights[0] + heights[1] + 1e-3], [side; 3], [thrown; 3]);
    b.mesh_line("SIDE SET FACE, 100, 1, TOP");
    b.mesh_line("SIDE SET FACE, 200, 2, BOTTOM");
    b.mesh_line("NODE SET FACE, 1, 1, BOTTOM");
    for block in 0..3 {
        b.material(block + 1, stiffness[block], density[block]);
    }
    let friction = b.contact(3);
    let sets = b.dice.one_of(&[[100, 200], [200, 100]]);
    b.line(&format!("TIED CONTACT, {}, {}", sets[0], sets[1]));
    if b.dice.chance(0.5) {
        b.line("NO DISPLACEMENT, Z, 1");
    }
    b.line(&format!("INITIAL VELOCITY MATERIAL, 3, {:?}, 0., {:?}", 0.3 * speed, -speed));
    b.finish("tied blocks that are hit", friction, 1500.0)
}

/// Two tied blocks whose meshes do not match, thrown with the rim of their joint against a wall: a rigid plane, a held rigid block, a
/// heavy free one, or a plane and contact beside it.
pub fn struck_joint_scene(seed: u64) -> Scene {
    let mut b = builder(seed);
    let dice = &mut b.dice;
    let [below, above, across] = [dice.count(1, 6), dice.count(1, 8), dice.count(1, 5)];
    let (stiffness, density) = (dice.magnitude(1e-2, 1e2), dice.magnitude(0.1, 10.0));
    let (speed, tilt, lift) = (dice.magnitude(1.0, 50.0), dice.one_of(&[0.0, 0.0, 10.0]), dice.one_of(&[0.0, 0.01]));
    let kind = dice.count(0, 3);
    let high = dice.between(0.3, 1.2);
    b.boxed(1, [0.0; 3], [1.0, 1.0, 1.0], [below, across, below]);
    b.boxed(2, [0.0, 0.0, 1.0], [1.0, 1.0, high], [above, above, above]);
    b.mesh_line("SIDE SET FACE, 100, 1, TOP");
    b.mesh_line("SIDE SET FACE, 200, 2, BOTTOM");
    b.mesh_line("SIDE SET PLANE, 400, X, 0.");
    b.material(1, 1.0, 1.0);
    b.material(2, stiffness, density);
    let has_wall = kind == 1 || kind == 2;
    if has_wall {
        b.boxed(3, [-0.6 - lift, -0.5, -0.5], [0.6, 2.0, 3.0], [2, 5, 7]);
        b.mesh_line("NODE SET BLOCK, 9, 3");
        b.material(3, 100.0, if kind == 1 { 1.0 } else { 300.0 });
    }
    let friction = kind != 0 && b.contact(if has_wall { 3 } else { 2 });
    if kind == 1 {
        b.line("RIGID BODY, 3");
        ["X", "Y", "Z"].iter().for_each(|axis| b.line(&format!("NO DISPLACEMENT, {axis}, 9")));
    }
    if !has_wall {
        let slope = f64::to_radians(tilt);
        b.line(&format!("RIGID SURFACE, 400, {:?}, 0., 0., {:?}, 0., {:?}", -lift, slope.cos(), slope.sin()));
    }
    let sets = b.dice.one_of(&[[100, 200], [200, 100]]);
    b.line(&format!("TIED CONTACT, {}, {}", sets[0], sets[1]));
    b.line(&format!("INITIAL VELOCITY MATERIAL, 1, {:?}", -speed));
    b.line(&format!("INITIAL VELOCITY MATERIAL, 2, {:?}", -speed));
    b.finish("tied blocks thrown against a wall", friction, 1000.0)
}
