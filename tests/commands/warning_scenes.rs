//! Scenes of some elements that provoke the warnings of a run, one each.

use crate::program::Desk;

pub const STEEL: &str = "YOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";

/// A desk with a deck and the recipe of its mesh.
pub fn desk(deck: &str, recipe: &str) -> Desk {
    let desk = Desk::new();
    desk.put("case.i", &format!("TITLE\n case\n{deck}EXIT\n"));
    desk.put("case.mesh", &format!("TITLE\n case\n{recipe}"));
    desk
}

/// One of the warnings: a scene that provokes it, how it is called, and words of it with a number and a place.
pub struct Scene {
    pub desk: Desk,
    pub label: &'static str,
    pub words: &'static [&'static str],
}

/// A square block whose edge along z is pushed inwards: one corner of its section turns inside out, and the volume
/// stays positive. `to` is how far, of the block's edge.
pub fn dented(to: f64) -> Desk {
    let deck = format!(
        "TERMINATION TIME, 1.E-2\nPLOT TIME, 1.E-3\nOUTPUT TIME, 1.E-3\nPLOT ELEMENT, CORNERS\nFUNCTION, 1\n0., 0.\n1.E-2, 1.\nEND\n\
         PRESCRIBED DISPLACEMENT, X, 1, 1, {0}\nPRESCRIBED DISPLACEMENT, Y, 1, 1, {0}\nNO DISPLACEMENT, X, 2\n\
         NO DISPLACEMENT, Y, 2\nNO DISPLACEMENT, Z, 1\nNO DISPLACEMENT, Z, 2\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}",
        -to
    );
    desk(
        &deck,
        "BOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 2\nNODE SET EDGE, 1, X, 1., Y, 1.\nNODE SET PLANE, 2, X, 0.\n\
         NODE SET EDGE, 2, X, 1., Y, 0.\n",
    )
}

/// A beam of one layer that is bent: its elements resist by hourglass stiffness alone.
fn bent() -> Desk {
    let deck = format!(
        "TERMINATION TIME, 2.E-3\nOUTPUT TIME, 2.E-4\nPRESCRIBED FORCE, Z, 2, 1, 1.E4\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nMATERIAL, 4, ELASTIC, 7800.\n{STEEL}"
    );
    desk(&deck, "BOX, 4, 0., 0., 0., 1., 0.1, 0.1, 10, 1, 1\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 1.\n")
}

/// Water in a tank that begins to slosh when it is pulled sideways, with a factor on the resistance to hourglass modes, for half a
/// period.
pub fn sloshing(factor: f64) -> Desk {
    let deck = format!(
        "TERMINATION TIME, 0.588\nOUTPUT TIME, 0.098\nHISTORY TIME, 0.098\nHISTORY BLOCK, 1\nPLANE STRAIN\nGRAVITY, 0.2, -9.81\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 2\nHOURGLASS CONTROL, ASSUMED STRAIN, {factor}\n\
         MATERIAL, 1, HYDRODYNAMIC, 1000.\nPRESSURE CUTOFF = 1.E9\nEND\n\
         EQUATION OF STATE, 1, MG US-UP\nC0 = 1480.\nS = 1.92\nGAMMA = 0.1\nEND\n"
    );
    let sets = "NODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 1, X, 1.\nNODE SET PLANE, 2, Y, 0.\n";
    desk(&deck, &format!("RECTANGLE, 1, 0., 0., 1., 0.5, 10, 5\n{sets}"))
}

/// A block that is pressed on another with one pass in a step, which is never enough.
fn one_pass() -> Desk {
    let deck = format!(
        "TERMINATION TIME, 4.E-3\nOUTPUT TIME, 4.E-4\nCONTACT MATERIAL\nCONTACT PASSES, 1, 1.E-14\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
         PRESCRIBED VELOCITY, Z, 2, 1, -1.\nNO DISPLACEMENT, Z, 1\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}\
         MATERIAL, 2, ELASTIC, 7800.\n{STEEL}"
    );
    desk(
        &deck,
        "BOX, 1, 0., 0., 0., 1., 1., 0.5, 3, 3, 2\nBOX, 2, 0.1, 0.2, 0.5, 0.7, 0.7, 0.5, 4, 4, 2\n\
         NODE SET PLANE, 1, Z, 0.\nNODE SET PLANE, 2, Z, 1.\n",
    )
}

/// Two blocks that begin with an overlap of `depth`.
pub fn overlapping(depth: f64) -> Desk {
    let deck = format!(
        "TERMINATION TIME, 4.E-5\nCONTACT MATERIAL\nCONTACT OVERLAP, REMOVE\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}MATERIAL, 2, ELASTIC, 7800.\n{STEEL}"
    );
    let upper = 1.0 - depth;
    desk(&deck, &format!("BOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\nBOX, 2, 0.3, 0.3, {upper}, 0.4, 0.4, 1., 2, 2, 2\n"))
}

/// The same of blocks that the deck holds both: none of their nodes can be moved.
fn held_overlap() -> Desk {
    let desk = overlapping(0.01);
    let held = ["X", "Y", "Z"].map(|axis| format!("NO DISPLACEMENT, {axis}, 1\n")).concat();
    desk.put("case.i", &desk.text("case.i").replace("CONTACT MATERIAL\n", &format!("CONTACT MATERIAL\n{held}")));
    desk.put("case.mesh", &format!("{}NODE SET BLOCK, 1, 1\nNODE SET BLOCK, 1, 2\n", desk.text("case.mesh")));
    desk
}

/// A sheet that begins going through another, with no node of either in the other.
pub fn crossed(commands: &str) -> Desk {
    let deck = format!(
        "TERMINATION TIME, 4.E-5\nCONTACT MATERIAL\n{commands}SHELL THICKNESS, 1, 0.01\nSHELL THICKNESS, 2, 0.01\n\
         MATERIAL, 1, ELASTIC, 7800.\n{STEEL}MATERIAL, 2, ELASTIC, 7800.\n{STEEL}"
    );
    desk(&deck, "SHEET, 1, -1., -1., 0., 2., 2., 0., 4, 4\nSHEET, 2, -0.7, 0.13, -0.4, 1.4, 0., 1., 2, 2\n")
}

/// The same block twice at one place.
fn twice() -> Desk {
    let deck = format!(
        "TERMINATION TIME, 4.E-5\nCONTACT MATERIAL\nCONTACT OVERLAP, KEEP\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}MATERIAL, 2, ELASTIC, 7800.\n{STEEL}"
    );
    desk(&deck, "BOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\nBOX, 2, 0., 0., 0., 1., 1., 1., 2, 2, 2\n")
}

/// A block that is driven into another: nothing gives way.
fn driven() -> Desk {
    let deck = format!(
        "TERMINATION TIME, 1.E-2\nOUTPUT TIME, 1.E-3\nCONTACT MATERIAL\nCONTACT ENERGY LIMIT, 1.E9\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
         PRESCRIBED VELOCITY, Z, 2, 1, -80.\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
         NO DISPLACEMENT, X, 2\nNO DISPLACEMENT, Y, 2\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}MATERIAL, 2, ELASTIC, 7800.\n{STEEL}"
    );
    desk(
        &deck,
        "BOX, 1, 0., 0., 0., 1., 1., 1., 3, 3, 2\nBOX, 2, 0.4, 0.4, 1.1, 0.2, 0.2, 0.4, 1, 1, 1\n\
         NODE SET BLOCK, 1, 1\nNODE SET BLOCK, 2, 2\n",
    )
}

/// A driven block that goes into a held one: contact can move no node of either, whose elements are one thick.
pub fn driven_and_held() -> Desk {
    let held = |set: u32, axes: &[char]| -> String {
        axes.iter().map(|axis| format!("NO DISPLACEMENT, {axis}, {set}\n")).collect()
    };
    let deck = format!(
        "TERMINATION TIME, 1.E-4\nOUTPUT TIME, 1.E-5\nCONTACT MATERIAL\nFUNCTION, 1\n0., 0.\n1., 1.\nEND\n\
         PRESCRIBED DISPLACEMENT, Z, 1, 1, -20.\n{}{}MATERIAL, 1, ELASTIC, 7800.\n{STEEL}MATERIAL, 2, ELASTIC, 7800.\n{STEEL}",
        held(1, &['X', 'Y']),
        held(2, &['X', 'Y', 'Z'])
    );
    desk(
        &deck,
        "BOX, 1, 0., 0., 1.E-4, 0.01, 0.01, 0.004, 3, 3, 1\nBOX, 2, -0.002, -0.002, -0.004, 0.014, 0.014, 0.004, 4, 4, 1\n\
         NODE SET BLOCK, 1, 1\nNODE SET BLOCK, 2, 2\n",
    )
}

/// A block that is driven through a rigid plane.
pub fn driven_through_a_plane() -> Desk {
    let deck = format!(
        "TERMINATION TIME, 0.015\nOUTPUT TIME, 1.5E-3\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nRIGID SURFACE, 2, 0., 0., 0.1, 0., 0., 1.\n\
         PRESCRIBED VELOCITY, Z, 1, 1, -10.\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}"
    );
    desk(&deck, "BOX, 1, 0., 0., 0.12, 0.06, 0.06, 0.1, 2, 2, 1\nNODE SET BLOCK, 1, 1\nSIDE SET BLOCK, 2, 1\n")
}

/// A free rigid block on a held one under a driven one, which goes farther than there is room and tilts it.
pub fn rigid_without_room() -> Desk {
    let held = ["X", "Y", "Z"].map(|axis| format!("NO DISPLACEMENT, {axis}, 5\n")).concat();
    let materials = [1, 2, 3, 4].map(|block| format!("MATERIAL, {block}, ELASTIC, 1000.\n{STEEL}")).concat();
    let deck = format!(
        "TERMINATION TIME, 0.015\nOUTPUT TIME, 1.5E-3\nTIME STEP MAXIMUM, 1.E-4\nCONTACT MATERIAL\nRIGID BODY, 1\nRIGID BODY, 2\n\
         RIGID BODY, 3\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESCRIBED VELOCITY, Z, 2, 1, -10.\n{held}{materials}"
    );
    desk(
        &deck,
        "BOX, 1, 0., 0., 0., 0.2, 0.2, 0.1, 2, 2, 1\nBOX, 2, 0.05, 0.05, 0.12, 0.06, 0.06, 0.1, 1, 1, 1\nNODE SET BLOCK, 2, 2\n\
         BOX, 3, 0., 0., -0.05, 0.2, 0.2, 0.03, 1, 1, 1\nNODE SET BLOCK, 5, 3\nBOX, 4, 9., 9., 9., 10., 10., 10., 1, 1, 1\n",
    )
}

/// A plate that flies and falls to pieces: every node goes on by itself.
fn dust() -> Desk {
    let deck = format!(
        "TERMINATION TIME, 1.E-4\nOUTPUT TIME, 1.E-5\nINITIAL VELOCITY MATERIAL, 1, 100., 0., 0.\nDEATH, 1, VOLUME, MAX, 0.5\n\
         MATERIAL, 1, ELASTIC, 7800.\n{STEEL}"
    );
    desk(&deck, "BOX, 1, 0., 0., 0., 1., 1., 0.1, 3, 3, 1\n")
}

/// A cube of a law that is pressed by a part of its height, in steps of this size.
fn pressed(part: f64, step: &str, law: &str) -> Desk {
    let deck = format!(
        "TERMINATION TIME, 1.\nTIME STEP MAXIMUM, {step}\nOUTPUT TIME, 0.1\nFUNCTION, 1\n0., 0.\n1., -{part}\nEND\nNO DISPLACEMENT, X, 1\n\
         NO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nNO DISPLACEMENT, Y, 2\nNO DISPLACEMENT, Z, 2\n\
         PRESCRIBED DISPLACEMENT, X, 2, 1, 1.\n{law}"
    );
    desk(&deck, "BOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 1.\n")
}

/// A solid with a steep Hugoniot that is pressed to half of its volume, beyond 0.95/2.5.
fn pressed_beyond_its_hugoniot() -> Desk {
    let law = "MATERIAL, 1, HYDRODYNAMIC, 1.E6\nPRESSURE CUTOFF = -3.\nEND\n\
               EQUATION OF STATE, 1, MG US-UP\nC0 = 0.014\nS = 2.5\nGAMMA = 0.\nEND\n";
    pressed(0.5, "5.E-3", law)
}

/// A foam, a tenth of it solid, that is pressed to less than a tenth of its volume.
fn pressed_beyond_its_solid() -> Desk {
    let law = "MATERIAL, 1, LOW DEN FOAM, 1.E6\nYOUNGS MODULUS = 100.\nA = 1.\nB = 5.\nC = -3.\nNAIR = 0\nP0 = 1.\nPHI = 0.1\nEND\n";
    pressed(0.92, "2.E-3", law)
}

/// A column of water that flies at a wall at its speed of sound, and is stopped within a step.
fn struck_at_the_speed_of_sound() -> Desk {
    let deck = "TERMINATION TIME, 4.E-6\nOUTPUT TIME, 5.E-7\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
         RIGID SURFACE, 10, -1.E-4, 0., 0., 1., 0., 0.\nINITIAL VELOCITY MATERIAL, 1, -1480., 0., 0.\n\
         MATERIAL, 1, HYDRODYNAMIC, 1000.\nPRESSURE CUTOFF = 1.E5\nEND\n\
         EQUATION OF STATE, 1, MG US-UP\nC0 = 1480.\nS = 1.92\nGAMMA = 0.5\nEND\n";
    let sets = ["Y, 0.", "Y, 0.001", "Z, 0.", "Z, 0.001"].map(|plane| format!("NODE SET PLANE, 1, {plane}\n")).concat();
    desk(deck, &format!("BOX, 1, 0., 0., 0., 0.02, 0.001, 0.001, 20, 1, 1\n{sets}SIDE SET FACE, 10, 1, LEFT\n"))
}

/// Every warning that a scene of some elements provokes.
pub fn scenes() -> [Scene; 16] {
    let scene = |desk, label, words| Scene { desk, label, words };
    [
        scene(
            dented(0.7),
            "corners inside out in block 1",
            &["corners of 2 elements of block 1, of 2,", "worst in element 1 at ("],
        ),
        scene(
            bent(),
            "hourglass energy of block 4",
            &["hourglass energy of block 4 is", "times of its internal", "in element"],
        ),
        scene(
            one_pass(),
            "passes of contact run out",
            &["the passes of contact have run out in", "now the deepest is at node"],
        ),
        scene(
            overlapping(0.01),
            "nodes moved out of initial overlaps",
            &["nodes were moved out of faces", ": node", "at ("],
        ),
        scene(
            overlapping(0.75),
            "nodes begin deep inside elements",
            &["nodes of contact surfaces begin deep inside", "on element"],
        ),
        scene(
            held_overlap(),
            "overlaps that could not be taken out",
            &["10 nodes stay behind faces", "the deepest by 1.0000e-2: node", "at ("],
        ),
        scene(
            crossed(""),
            "edges that go through faces in the mesh",
            &[
                "edges of contact surfaces begin going through faces",
                "of blocks 1 and 2",
                "the edge between nodes",
                "at (",
            ],
        ),
        scene(
            twice(),
            "elements inside other bodies in the mesh",
            &["16 elements begin inside another body, of blocks 1 and 2", "the middle of element 1 at ("],
        ),
        scene(
            driven(),
            "nodes deep inside elements",
            &["4 nodes are deeper than half an element", "node", "on element 14 at ("],
        ),
        scene(
            driven_and_held(),
            "contact between nodes that the deck moves",
            &["nodes have gone into faces out of which contact cannot move them", "% of a face", "the deepest: node"],
        ),
        scene(
            dust(),
            "elements of block 1 that are gone from the start",
            &["DEATH takes 9 elements of block 1 away at the first state"],
        ),
        scene(
            pressed_beyond_its_hugoniot(),
            "compression of block 1 beyond its Hugoniot",
            &["1 element of block 1 has been", "beyond 1 - V/V0 = 0.3800", "element 1 at ("],
        ),
        scene(
            pressed_beyond_its_solid(),
            "compression of block 1 beyond the data of its law",
            &["1 element of block 1 has been", "beyond 1 - V/V0 = 0.9000", "element 1 at ("],
        ),
        scene(
            struck_at_the_speed_of_sound(),
            "negative internal energy in block 1",
            &["an element of block 1 has the specific internal energy -", "in a single step", "element 1 at ("],
        ),
        scene(
            dust(),
            "debris carries energy",
            &["32 free nodes", "carry a kinetic energy of", "100 % of the largest", "at node"],
        ),
        scene(
            sloshing(1.0),
            "hourglass damping of block 1, a fluid",
            &[
                "has made heat of",
                "its factor is 1, and with HOURGLASS CONTROL, ASSUMED STRAIN, 0.01",
                "of the energy supplied",
                "in element",
            ],
        ),
    ]
}
