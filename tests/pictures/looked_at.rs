//! A handful of pictures and curves against those that somebody has looked at. Fonts and shading are drawn by this program alone, so
//! that only round-off of another machine's library may differ: a few pixels at edges, by a little.
//!
//! `URTO_BLESS=1 cargo test --test pictures looked_at::` writes them anew; look at them then.

use crate::program::{Desk, project};
use tiny_skia::Pixmap;

/// A channel that differs by more than this, of 255, makes a pixel another one: an eye sees it beside the other.
const SEEN: u8 = 24;
/// Part of the pixels that may be others. A letter of the smallest caption is more than this.
const OTHERS: f64 = 2e-4;

/// A cube strikes a plate that lies on a floor, beside a sheet that stands on it and a mast of beams.
const DECK: &str = "TITLE\n A CUBE, A PLATE, A SHEET AND A MAST\nTERMINATION TIME, 40.E-6\nPLOT TIME, 4.E-6\nHISTORY TIME, 1.E-6\n\
     PLOT NODAL, VELOCITY, CONTACT\nPLOT ELEMENT, VONMISES, PRESSURE\nHISTORY, CONTACT, 1, 2\nHISTORY, RIGID SURFACE, 100\n\
     HISTORY, BLOCK\nCONTACT MATERIAL, 1, 2\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\n\
     INITIAL VELOCITY MATERIAL, 1, 0., 0., -60.\nINITIAL VELOCITY MATERIAL, 3, 100., 0., 0.\nINITIAL VELOCITY MATERIAL, 4, 100., 0., 0.\n\
     SHELL THICKNESS, 3, 0.002\nBEAM SECTION, 4, ROD, 0.0015\nNO DISPLACEMENT, X, 3\nNO DISPLACEMENT, Y, 3\nNO DISPLACEMENT, Z, 3\n";

/// The deck's materials, and its mesh.
fn ran() -> Desk {
    let desk = Desk::new();
    let steel =
        |block: i32| format!("MATERIAL, {block}, ELASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n");
    let materials: String = (1..=4).map(steel).collect();
    desk.put("scene.i", &(DECK.to_string() + &materials + "EXIT\n"));
    desk.put(
        "scene.mesh",
        "BOX, 1, 0.008, 0.005, 0.0101, 0.01, 0.01, 0.01, 4, 4, 4\nBOX, 2, 0., 0., 0., 0.03, 0.02, 0.01, 9, 6, 3\n\
         SHEET, 3, 0.04, 0., 0., 0., 0.02, 0.03, 5, 8\nLINE, 4, 0.05, 0.01, 0., 0.05, 0.01, 0.03, 8\n\
         SIDE SET FACE, 100, 2, BOTTOM\nNODE SET PLANE, 3, Z, 0., 3\n",
    );
    desk.urto(&["mesh", "scene.mesh", "-o", "scene.g"]).with(0);
    desk.urto(&["scene.i", "-q"]).with(0);
    desk
}

/// Pixels that differ visibly, over all.
fn others(one: &Pixmap, other: &Pixmap) -> f64 {
    if (one.width(), one.height()) != (other.width(), other.height()) {
        return 1.0;
    }
    let pairs = one.data().chunks_exact(4).zip(other.data().chunks_exact(4));
    let different = pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > SEEN));
    different.count() as f64 / f64::from(one.width() * one.height())
}

#[test]
fn pictures_are_those_that_were_looked_at() {
    let desk = ran();
    let cases: [(&str, &[&str]); 6] = [
        (
            "contact_status",
            &[
                "view",
                "scene.e",
                "-v",
                "CONTSTAT",
                "--thickness",
                "-t",
                "6.E-6",
                "--from",
                "-60,-25",
                "--size",
                "480x360",
            ],
        ),
        ("section", &["view", "scene.e", "-v", "VONMISES", "--cut", "y=0.01", "-t", "8.E-6", "--size", "480x360"]),
        (
            "row",
            &["view", "scene.e", "-v", "VEL", "-s", "1,4,last", "--arrows", "VEL", "--no-planes", "--size", "640x300"],
        ),
        ("blocks", &["view", "scene.e", "-v", "none", "--mirror", "y", "--from", "30,-20", "--size", "480x360"]),
        (
            "forces",
            &[
                "plot",
                "scene.h",
                "-v",
                "FZ_CONTACT1_2,FZ_WALL100,WORK1_CONTACT1_2",
                "--right",
                "WORK1_CONTACT1_2",
                "--size",
                "640x400",
            ],
        ),
        (
            "motion",
            &["plot", "scene.h", "-v", "VELZ_BLOCK1", "-v", "VELZ_BLOCK2", "-x", "DISPLZ_BLOCK1", "--size", "640x400"],
        ),
    ];
    let mut wrong = Vec::new();
    for (name, arguments) in cases {
        let made = format!("{name}.png");
        desk.urto(&[arguments, &["-o", &made]].concat()).with(0);
        let expected = project(&format!("tests/pictures/{made}"));
        if std::env::var_os("URTO_BLESS").is_some() {
            std::fs::copy(desk.path(&made), &expected).expect("a picture to be kept");
            continue;
        }
        let drawn = Pixmap::load_png(desk.path(&made)).expect("a picture");
        let part = others(&drawn, &Pixmap::load_png(&expected).expect("the picture that was looked at"));
        if part > OTHERS {
            let kept = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(&made);
            std::fs::copy(desk.path(&made), &kept).expect("a picture to be looked at");
            wrong.push(format!("{name}: {:.3} % of the pixels are others; see {}", 100.0 * part, kept.display()));
        }
    }
    assert!(wrong.is_empty(), "{}\nURTO_BLESS=1 takes the new ones over", wrong.join("\n"));
}
