//! Blocks that abut, of meshes that need not match and at whatever angle the model stands: they touch, and overlap nowhere. Beside each other
//! they slide without a force.

use crate::support::meshes::recipe;
use crate::support::run::{model, run};
use crate::support::scenes::{Dice, asked_for};
use std::fmt::Write;
use urto::solver::Body;

/// A block by its lowest and its highest corner.
type Block = [[f64; 3]; 2];

/// Law of each of so many blocks of steel.
pub fn laws(blocks: usize) -> String {
    let law = |block: usize| {
        format!("MATERIAL, {block}, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n")
    };
    (1..=blocks).map(law).collect()
}

/// The lines that turn a block about z and then about x, by angles in degrees.
fn turns(block: usize, [about_z, about_x]: [f64; 2]) -> String {
    format!("ROTATE, {block}, Z, {about_z:?}\nROTATE, {block}, X, {about_x:?}\n")
}

/// Checks that the blocks of a recipe touch and no more.
fn check_that_none_overlaps(seed: u64, text: &str, blocks: usize) {
    let mesh = recipe(text);
    let deck = format!("TITLE\n abutting\nTERMINATION TIME, 1.E-6\nCONTACT MATERIAL\n{}", laws(blocks));
    let overlap = Body::new(&mesh, &model(&deck, &mesh)).expect("materials").overlap;
    assert_eq!((overlap.refusal(&mesh), overlap.nodes), (None, 0), "seed {seed}: {overlap:?}\n{text}");
}

/// A box that is cut in two again and again, most of the pieces with meshes of their own, turned about two axes.
fn pieces(seed: u64) -> (String, usize) {
    let mut dice = Dice::of(seed);
    let mut blocks: Vec<Block> = vec![[[0.0; 3], [dice.one_of(&[0.5, 1.0, 2.0]), 1.0, dice.one_of(&[0.2, 1.0, 2.0])]]];
    for _ in 0..dice.count(1, 6) {
        let [low, high] = blocks.swap_remove(dice.count(0, blocks.len() - 1));
        let (axis, part) = (dice.count(0, 2), dice.one_of(&[0.1, 0.25, 0.37, 0.5, 0.9]));
        let (mut middle_high, mut middle_low) = (high, low);
        middle_high[axis] = low[axis] + part * (high[axis] - low[axis]);
        middle_low[axis] = middle_high[axis];
        blocks.extend([[low, middle_high], [middle_low, high]]);
    }
    let angles = [dice.between(0.0, 90.0), dice.between(0.0, 90.0)];
    let mut text = String::from("TITLE\n abutting\n");
    for (number, [low, high]) in (1..).zip(&blocks) {
        let [x, y, z] = low;
        let [a, b, c] = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        let [l, m, n] = [0; 3].map(|_| dice.count(1, 5));
        let _ = writeln!(text, "BOX, {number}, {x:?}, {y:?}, {z:?}, {a:?}, {b:?}, {c:?}, {l}, {m}, {n}");
        text += &turns(number, angles);
    }
    (text, blocks.len())
}

/// Round-off turned faces beside each other at the rim of a flat side towards each other, and took for behind them what touches the body around that rim: of 300 such
/// scenes 66 were refused, and in 15 nodes were moved by parts of a block.
#[test]
fn blocks_that_abut_do_not_overlap() {
    let (seeds, _) = asked_for(0..300);
    for seed in seeds {
        let (text, blocks) = pieces(seed);
        check_that_none_overlaps(seed, &text, blocks);
    }
}

/// A tube whose bore ends over the wall of the one on which it stands, as a flange on a pipe: what touches its end is behind the seams of the bore, but below the
/// bore. Of 22 such scenes 16 were refused, and 2 had nodes moved by up to 0.17.
#[test]
fn tubes_that_stand_on_each_other_do_not_overlap() {
    let (seeds, _) = asked_for(0..100);
    for seed in seeds {
        let mut dice = Dice::of(seed);
        let (part, around) = (dice.one_of(&["FULL", "HALF", "QUARTER"]), dice.one_of(&[6, 8, 12]));
        let (height, inner) = (dice.one_of(&[0.05, 0.3, 1.0]), dice.one_of(&[0.9, 1.0, 1.1, 1.2]));
        let angles = [dice.between(0.0, 90.0), dice.between(0.0, 90.0)];
        let turned = dice.chance(0.7);
        let mut tube = |block: usize, [inner, outer]: [f64; 2], around: usize, lift: f64| {
            let (through, along) = (dice.count(1, 3), dice.count(1, 6));
            let made = format!(
                "TUBE, {block}, {inner:?}, {outer:?}, {height:?}, {through}, {around}, {along}, {part}\n\
                 TRANSLATE, {block}, 0., 0., {lift:?}\n"
            );
            if turned { made + &turns(block, angles) } else { made }
        };
        let lower = tube(1, [1.0, 1.3], around, 0.0);
        let upper = tube(2, [inner, 1.5], if seed % 2 == 0 { around } else { 2 * around }, height);
        check_that_none_overlaps(seed, &format!("TITLE\n tubes\n{lower}{upper}"), 2);
    }
}

/// A block that flies along the side of another one, past its rim or to it, keeps its energy to round-off: what it meets of the other is upright on its way.
#[test]
fn blocks_beside_each_other_slide_without_a_force() {
    let (seeds, _) = asked_for(0..40);
    for seed in seeds {
        let mut dice = Dice::of(seed);
        let mut cells = || [0; 3].map(|_| dice.count(1, 4)).map(|count| count.to_string()).join(", ");
        let (first, second) = (cells(), cells());
        let (ahead, angle) = (dice.one_of(&[-0.2, 0.0, 0.3]), dice.between(0.0, 90.0));
        let mesh = recipe(&format!(
            "TITLE\n beside\nBOX, 1, 0.25, 0., 0., 0.125, 1., 1., {first}\nROTATE, 1, Z, {angle:?}\n\
             BOX, 2, 0.375, {:?}, 0., 0.125, 0.5, 1., {second}\nROTATE, 2, Z, {angle:?}\n",
            0.5 + ahead
        ));
        let (sine, cosine) = angle.to_radians().sin_cos();
        let speed = 20.0 * dice.one_of(&[-1.0, 1.0]);
        let deck = format!(
            "TITLE\n beside\nTERMINATION TIME, 1.E-3\nOUTPUT TIME, 1.E-3\nCONTACT MATERIAL\n\
             INITIAL VELOCITY MATERIAL, 2, {:?}, {:?}, 0.\n{}",
            -sine * speed,
            cosine * speed,
            laws(2)
        );
        let run = run(&deck, &mesh).whole();
        let totals = &run.last().totals;
        // Half of the mass of 0.125 × 0.5 × 1 m³ times the square of the speed; what round-off of places a metre from the origin strains steel by is
        // 10⁻¹⁰ of it.
        let kinetic = 0.5 * 7850.0 * 0.0625 * speed * speed;
        let off = (totals.kinetic / kinetic - 1.0).abs();
        assert!(off < 1e-9 && totals.contact.abs() < 1e-9 * kinetic, "seed {seed}: {off:.1e}, {:.1e}", totals.contact);
    }
}

/// A sleeve on a tube of the same facets flies along it at 20 m/s, out over its end, and keeps its energy to round-off. Nodes in the seams of its facets were taken
/// to be behind the side at its end, which rises over the facet beside: of twelve such scenes eight lost up to 28 % in a millisecond.
#[test]
fn a_sleeve_slides_on_a_tube_of_the_same_facets() {
    let (seeds, _) = asked_for(0..24);
    for seed in seeds {
        let mut dice = Dice::of(seed);
        let (around, angles) = (dice.one_of(&[4, 6, 8, 12]), [dice.between(0.0, 90.0), dice.between(0.0, 90.0)]);
        let turned = dice.chance(0.7);
        let mut tube = |block: usize, inner: f64| {
            let (through, along) = (dice.count(1, 3), dice.count(1, 6));
            let made = format!("TUBE, {block}, {inner:?}, {:?}, 1., {through}, {around}, {along}\n", inner + 0.1);
            if turned { made + &turns(block, angles) } else { made }
        };
        let mesh = recipe(&format!("TITLE\n sleeve\n{}{}", tube(1, 0.5), tube(2, 0.6)));
        let (sine, cosine) = if turned { angles[1].to_radians().sin_cos() } else { (0.0, 1.0) };
        let deck = format!(
            "TITLE\n sleeve\nTERMINATION TIME, 1.E-3\nOUTPUT TIME, 1.E-5\nCONTACT MATERIAL\n\
             INITIAL VELOCITY MATERIAL, 2, 0., {:?}, {:?}\n{}",
            -20.0 * sine,
            20.0 * cosine,
            laws(2)
        );
        let run = run(&deck, &mesh).whole();
        let (first, last) = (run.lines[0].totals.kinetic, &run.last().totals);
        let off = (last.kinetic / first - 1.0).abs();
        // To round-off, as above.
        assert!(off < 1e-9 && last.contact.abs() < 1e-9 * first, "seed {seed}: {off:.1e}, {:.1e}", last.contact);
    }
}
