//! Commands and fields that are allowed, and from which nothing follows with this mesh or beside the rest of the deck.

use super::{Hourglass, Model, Precision, Problem, Spin, StepEstimate, StepModuli, check::takes_part};
use crate::deck::{Card, Diagnostic, Diagnostics};
use crate::mesh::{Block, Mesh, Shape};

/// Elements that a choice is for, and what they are called.
type Wanted = (fn(&Model, &Block) -> bool, &'static str);

const HEXAHEDRA: Wanted = (|_, block| block.shape == Shape::Hexahedron, "hexahedra");
const SOLIDS: Wanted = (|_, block| is_solid(block), "solids");
const ONE_POINT_HEXAHEDRA: Wanted = (Model::has_one_point_hexahedra, "hexahedra with one point of integration");
const ONE_POINT: Wanted = (Model::has_hourglass_modes, "solids with one point of integration");

fn is_solid(block: &Block) -> bool {
    matches!(block.shape, Shape::Hexahedron | Shape::Plane)
}

impl Model {
    /// Whether a deck asks for eight points of integration in the hexahedra of a block, by its number.
    pub fn has_eight_points(&self, block: i64) -> bool {
        self.section("ELEMENT", block).is_some_and(|section| section.word("formulation") == Some("EIGHT POINTS"))
    }

    /// Whether a block is of hexahedra with one point of integration.
    pub fn has_one_point_hexahedra(&self, block: &Block) -> bool {
        block.shape == Shape::Hexahedron && !self.has_eight_points(block.id)
    }

    /// Whether elements of a block have one point of integration, and so modes for hourglass control.
    pub fn has_hourglass_modes(&self, block: &Block) -> bool {
        is_solid(block) && !self.has_eight_points(block.id)
    }
}

/// Warns of all of them.
pub(in crate::model) fn check(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    elements_not_there(problem, mesh, found);
    softening(problem, found);
    estimate_beside_viscosity(problem, mesh, found);
    contact_not_there(problem, found);
    thickness_of_no_contact(problem, mesh, found);
    blocks_of_no_contact(problem, mesh, found);
    side_sets_before_blocks(problem, mesh, found);
}

/// That nothing follows from a command, and why; `lacks` is a sentence.
fn nothing_follows(card: &Card, lacks: &str) -> Diagnostic {
    Diagnostic::warning(format!("{}: {lacks}, so that nothing follows from this", card.name))
}

/// Choices for elements of which the mesh has none.
fn elements_not_there(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let Model { precision, step_estimate, spin, time_step, .. } = &problem.model;
    let choices = [
        ("PRECISION", *precision == Precision::Single, ONE_POINT_HEXAHEDRA),
        ("SPIN", *spin == Spin::SecondOrder, ONE_POINT_HEXAHEDRA),
        ("TIME STEP ESTIMATE", *step_estimate == StepEstimate::Global, HEXAHEDRA),
        ("TIME STEP MODULI", time_step.moduli == StepModuli::Effective, SOLIDS),
        ("HOURGLASS CONTROL", true, ONE_POINT),
        ("HOURGLASS STIFFENING", true, ONE_POINT),
    ];
    for (name, _, (is_wanted, called)) in choices.into_iter().filter(|(_, is_made, _)| *is_made) {
        if mesh.blocks.iter().any(|block| is_wanted(&problem.model, block)) {
            continue;
        }
        for card in problem.deck.cards_of(name) {
            let warning = nothing_follows(card, &format!("the mesh has no {called}"));
            found.push(warning.at(card.record, format!("this is for {called}")));
        }
    }
}

/// PRONTO's factor for strain softening, which is read for its old decks.
fn softening(problem: &Problem, found: &mut Diagnostics) {
    for card in problem.deck.cards_of("TIME STEP SCALE").filter(|card| card.number("softening") < 1.0) {
        found.push(
            nothing_follows(card, "no law needs a factor for strain softening")
                .at(card.place("softening"), "read for decks of PRONTO, and not used")
                .help("leave it out; the first number alone scales the time step"),
        );
    }
}

/// TIME STEP ESTIMATE, GLOBAL where hourglass control has a viscosity, and so all hexahedra keep their own bounds, or those of some blocks.
fn estimate_beside_viscosity(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let model = &problem.model;
    let is_viscous = matches!(model.hourglass, Hourglass::FlanaganBelytschko { viscosity, .. } if viscosity > 0.0);
    if !is_viscous || model.step_estimate != StepEstimate::Global {
        return;
    }
    let hexahedra = || mesh.blocks.iter().filter(|block| block.shape == Shape::Hexahedron);
    let (eight, one): (Vec<&Block>, Vec<&Block>) = hexahedra().partition(|block| model.has_eight_points(block.id));
    let stiffening = problem.deck.cards_of("HOURGLASS STIFFENING").next();
    for card in problem.deck.cards_of("TIME STEP ESTIMATE").filter(|_| !one.is_empty()) {
        let lacks = "hourglass modes have a viscosity, whose damping no frequency tells";
        let warning = if eight.is_empty() {
            nothing_follows(card, lacks)
        } else {
            Diagnostic::warning(format!("{}: {lacks}: hexahedra with one point take no part", card.name))
        };
        let warning = warning
            .at(card.record, "the bounds of the elements alone hold")
            .help("leave the viscosity out, or choose HOURGLASS CONTROL, ASSUMED STRAIN");
        found.push(match stiffening {
            Some(stiffening) => warning.at(stiffening.place("viscosity"), "this is the viscosity"),
            None => warning,
        });
    }
}

/// Choices of contact where there is none. Nodes at rigid surfaces alone need passes, and nothing that meets something else.
fn contact_not_there(problem: &Problem, found: &mut Diagnostics) {
    let (contact, planes) = (&problem.model.contact, !problem.model.rigid_surfaces.is_empty());
    let (any, none) = (contact.is_some(), "there is no contact");
    let between = "there is no contact between bodies";
    let choices = [
        ("CONTACT PASSES", any || planes, none),
        ("CONTACT ENERGY LIMIT", any || planes, none),
        ("CONTACT DECOMPOSITION", any || planes, none),
        ("CONTACT THICKNESS", any || planes, none),
        ("CONTACT SEARCH", any, between),
        ("CONTACT OVERLAP", any, between),
        ("CONTACT EDGES", contact.materials.is_some(), "there is no CONTACT MATERIAL"),
    ];
    for (name, _, lacks) in choices.into_iter().filter(|(_, is_there, _)| !is_there) {
        for card in problem.deck.cards_of(name) {
            found.push(
                nothing_follows(card, lacks)
                    .at(card.record, "about contact that was not asked for")
                    .help("CONTACT MATERIAL, 1, 2 lets blocks 1 and 2 touch; CONTACT MATERIAL, ALL all of them"),
            );
        }
    }
}

/// Thicknesses of blocks that touch nothing, where others do.
fn thickness_of_no_contact(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let model = &problem.model;
    if !model.contact.is_some() || !model.rigid_surfaces.is_empty() {
        return;
    }
    for card in problem.deck.cards_of("CONTACT THICKNESS").filter(|card| card.complete) {
        let id = card.integer("block");
        let Some(block) = mesh.block_index(id) else { continue };
        if !takes_part(&model.contact, id, block, mesh) {
            found.push(
                nothing_follows(card, &format!("block {id} touches nothing"))
                    .at(card.place("block"), "no CONTACT MATERIAL or CONTACT SURFACE lets it touch anything"),
            );
        }
    }
}

/// CONTACT DATA and CONTACT EXCLUSION about blocks that neither CONTACT MATERIAL names nor CONTACT NODE SET has nodes of. Without such sets the
/// deck alone tells.
fn blocks_of_no_contact(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let contact = &problem.model.contact;
    if contact.materials.is_none() || contact.node_sets.is_empty() {
        return;
    }
    let mut touching: Vec<u32> = contact.node_sets.iter().flat_map(|(set, _)| mesh.distinct_nodes(*set)).collect();
    touching.sort_unstable();
    let touches = |id: i64| {
        let nodes = mesh.block_index(id).map_or(&[][..], |index| &mesh.blocks[index].nodes);
        contact.names(id) || nodes.iter().any(|node| touching.binary_search(node).is_ok())
    };
    for card in ["CONTACT DATA", "CONTACT EXCLUSION"].into_iter().flat_map(|name| problem.deck.cards_of(name)) {
        for field in ["first", "second"] {
            let Some(block) = card.maybe_integer(field).filter(|block| !touches(*block)) else { continue };
            if field == "second" && Some(block) == card.maybe_integer("first") {
                continue;
            }
            found.push(
                nothing_follows(card, &format!("block {block} touches nothing"))
                    .at(card.place(field), "neither CONTACT MATERIAL nor CONTACT NODE SET lets it touch")
                    .help(format!("CONTACT MATERIAL, {block} does; CONTACT SURFACE has friction of its own")),
            );
        }
    }
}

/// Side sets of CONTACT SURFACE on blocks that CONTACT MATERIAL lets touch too: what is said of the sets holds between them.
fn side_sets_before_blocks(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let contact = &problem.model.contact;
    if contact.materials.is_none() || contact.surfaces.is_empty() {
        return;
    }
    let block_of: Vec<i64> = mesh.elements().map(|(block, _)| mesh.blocks[block].id).collect();
    let blocks = |set: i64| {
        let sides = mesh.side_set(set).map_or(&[][..], |set| &set.sides);
        let of_sides = sides.iter().filter_map(|(element, _)| block_of.get(*element as usize).copied());
        of_sides.filter(|block| contact.names(*block)).collect::<std::collections::BTreeSet<i64>>()
    };
    for pair in &contact.surfaces {
        let [first, second] = pair.side_sets;
        let (masters, others) = (blocks(first), blocks(second));
        if masters.is_empty() || others.is_empty() {
            continue;
        }
        let apart = masters.iter().flat_map(|a| others.iter().map(move |b| (*a, *b)));
        let apart = apart.filter(|(a, b)| a != b).find(|(a, b)| contact.keeps_apart(*a, *b));
        let but = apart.map_or(String::new(), |(a, b)| {
            format!("; they touch, though CONTACT EXCLUSION keeps blocks {a} and {b} from touching elsewhere")
        });
        found.push(Diagnostic::note(format!(
            "CONTACT MATERIAL names the blocks of side sets {first} and {second}, too: between these sets the friction and partition of \
             CONTACT SURFACE hold, not those of CONTACT DATA{but}"
        )));
    }
}

#[cfg(test)]
mod tests {
    use crate::deck::Source;
    use crate::mesher::make;
    use crate::model::examine;

    /// What is said of a deck with these lines and a mesh of this recipe, whose block 1 is elastic.
    fn told(recipe: &str, lines: &str) -> String {
        let mesh = make(recipe, "recipe", 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
        let deck = format!(
            "TERMINATION TIME, 1.\nINITIAL VELOCITY MATERIAL, 1, 1.\n{lines}\n\
             MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\nEXIT\n"
        );
        match examine(Source::new("t.i", &deck), Some(&mesh)) {
            Ok(problem) => problem.diagnostics.render(false),
            Err(found) => panic!("{}", found.render(false)),
        }
    }

    const CUBE: &str = "BOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1\nSIDE SET FACE, 1, 1, BOTTOM";
    const SHEET: &str = "SHEET, 1, 0., 0., 0., 1., 1., 0., 1, 1\nSIDE SET FACE, 1, 1, BOTTOM";
    const SQUARE: &str = "RECTANGLE, 1, 0., 0., 1., 1., 1, 1";
    const EIGHT: &str = "ELEMENT, 1, EIGHT POINTS\n";

    #[track_caller]
    fn says(recipe: &str, lines: &str, name: &str, why: &str) {
        let said = told(recipe, lines);
        assert!(said.contains(&format!("{name}: {why}, so that nothing follows from this")), "{lines}: {said}");
    }

    #[track_caller]
    fn is_silent(recipe: &str, lines: &str) {
        let said = told(recipe, lines);
        assert!(!said.contains("nothing follows"), "{lines}: {said}");
    }

    #[test]
    fn choices_for_elements_that_are_not_there_are_told() {
        let shells = |lines: &str| format!("SHELL THICKNESS, 1, 0.1\n{lines}");
        let choices = [
            ("PRECISION, SINGLE", "hexahedra with one point of integration"),
            ("SPIN, SECOND ORDER", "hexahedra with one point of integration"),
            ("TIME STEP ESTIMATE, GLOBAL", "hexahedra"),
            ("TIME STEP MODULI, EFFECTIVE", "solids"),
            ("HOURGLASS CONTROL, ASSUMED STRAIN", "solids with one point of integration"),
            ("HOURGLASS STIFFENING, 0.05", "solids with one point of integration"),
        ];
        for (line, called) in choices {
            let (name, lacks) = (line.split(',').next().unwrap_or(line), format!("the mesh has no {called}"));
            says(SHEET, &shells(line), name, &lacks);
            is_silent(CUBE, line);
            let of_one_point = called.contains("one point");
            let eight = format!("{EIGHT}{line}");
            if of_one_point { says(CUBE, &eight, name, &lacks) } else { is_silent(CUBE, &eight) }
        }
        is_silent(SHEET, &shells("TIME STEP MODULI, ELASTIC"));
        is_silent(SQUARE, "PLANE STRAIN\nHOURGLASS STIFFENING, 0.05");
        is_silent(SQUARE, "PLANE STRAIN\nTIME STEP MODULI, EFFECTIVE");
    }

    #[test]
    fn fields_and_estimates_from_which_nothing_follows_are_told() {
        says(CUBE, "TIME STEP SCALE, 0.9, 0.5", "TIME STEP SCALE", "no law needs a factor for strain softening");
        is_silent(CUBE, "TIME STEP SCALE, 0.9, 1.");
        let viscous = "TIME STEP ESTIMATE, GLOBAL\nHOURGLASS STIFFENING, 0.05, 0.03";
        let why = "hourglass modes have a viscosity, whose damping no frequency tells";
        says(CUBE, viscous, "TIME STEP ESTIMATE", why);
        is_silent(CUBE, "TIME STEP ESTIMATE, GLOBAL\nHOURGLASS STIFFENING, 0.05");
        let both = format!("{CUBE}\nBOX, 2, 3., 0., 0., 1., 1., 1., 1, 1, 1");
        let law = "MATERIAL, 2, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";
        let said = told(&both, &format!("{law}{EIGHT}{viscous}"));
        assert!(said.contains("hexahedra with one point take no part"), "{said}");
    }

    #[test]
    fn choices_of_contact_that_is_not_there_are_told() {
        let lines = [
            "PASSES, 5",
            "ENERGY LIMIT, 0.1",
            "DECOMPOSITION, RCB",
            "THICKNESS, 1, 0.5",
            "SEARCH, TREE",
            "OVERLAP, KEEP",
        ];
        let shell = "SHELL THICKNESS, 1, 0.1\n";
        for line in lines.into_iter().chain(["EDGES, OFF"]) {
            let name = format!("CONTACT {}", line.split(',').next().unwrap_or(line));
            let why = match &name[..] {
                "CONTACT EDGES" => "there is no CONTACT MATERIAL",
                "CONTACT SEARCH" | "CONTACT OVERLAP" => "there is no contact between bodies",
                _ => "there is no contact",
            };
            says(SHEET, &format!("{shell}CONTACT {line}"), &name, why);
            is_silent(SHEET, &format!("{shell}CONTACT {line}\nCONTACT MATERIAL, ALL"));
        }
        let plane = "RIGID SURFACE, 1, 0., 0., -1., 0., 0., 1.";
        is_silent(SHEET, &format!("{shell}{plane}\nCONTACT PASSES, 5\nCONTACT THICKNESS, 1, 0.5"));
        says(SHEET, &format!("{shell}{plane}\nCONTACT EDGES, OFF"), "CONTACT EDGES", "there is no CONTACT MATERIAL");
    }

    /// Two boxes, one on the other; nodes and sides between them are sets.
    const BOXES: &str = "BOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1\nBOX, 2, 0., 0., 1., 1., 1., 1., 1, 1, 1\n\
                         NODE SET FACE, 7, 1, TOP\nSIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM";
    const LAW: &str = "MATERIAL, 2, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";

    #[test]
    fn blocks_touch_by_the_nodes_of_sets() {
        let data = "CONTACT MATERIAL, 2\nCONTACT DATA, 1, 2, 0.2";
        says(BOXES, &format!("{LAW}{data}"), "CONTACT DATA", "block 1 touches nothing");
        is_silent(BOXES, &format!("{LAW}{data}\nCONTACT NODE SET, 7"));
        let other = format!("{LAW}CONTACT MATERIAL, 1\nCONTACT NODE SET, 7\nCONTACT EXCLUSION, 1, 2");
        says(BOXES, &other, "CONTACT EXCLUSION", "block 2 touches nothing");
    }

    #[test]
    fn side_sets_on_blocks_that_touch_are_told() {
        let notes = |lines: &str| {
            let mesh = make(BOXES, "recipe", 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
            let deck = format!(
                "TERMINATION TIME, 1.\nINITIAL VELOCITY MATERIAL, 1, 1.\n{lines}\n{LAW}\
                 MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\nEXIT\n"
            );
            match examine(Source::new("t.i", &deck), Some(&mesh)) {
                Ok(problem) => problem.diagnostics.notes().map(|note| note.message.clone()).collect::<String>(),
                Err(found) => panic!("{}", found.render(false)),
            }
        };
        let sets = "CONTACT SURFACE, 100, 200, 0.3";
        assert_eq!(notes(sets), "");
        assert_eq!(notes(&format!("{sets}\nCONTACT MATERIAL, 2")), "");
        let both = notes(&format!("{sets}\nCONTACT MATERIAL, 1, 2\nCONTACT DATA, 1, 2, 0.1"));
        assert!(both.contains("side sets 100 and 200") && both.contains("CONTACT SURFACE hold"), "{both}");
        assert!(!both.contains("CONTACT EXCLUSION"), "{both}");
        let apart = notes(&format!("{sets}\nCONTACT MATERIAL\nCONTACT EXCLUSION, 2, 1"));
        assert!(apart.contains("though CONTACT EXCLUSION keeps blocks 1 and 2"), "{apart}");
    }
}
