//! The command language from outside: wrong decks with their whole messages, right decks, and a hundred thousand
//! mutilated ones.

use std::{fs, path::Path};

use proptest::prelude::*;
use urto::{
    deck::{self, Deck, Source, Status, language},
    material::{self, ElasticPlastic, Law, MATERIALS, Origin},
    mesh::{Block, Mesh, NodeSet, SideSet},
    model::{self, Direction, Hourglass, InitialVelocity, NodalField, PlotSchedule, Problem, StepModuli, examine},
};

/// Two blocks of 1 × 1 × 2 hexahedra along z: node sets 1 (x = 0), 2 (y = 0), 3 (z = 0), 4 (top) and an empty 9;
/// side sets 100 (bottom) and 200 (top).
fn two_blocks() -> Mesh {
    let coordinates: Vec<[f64; 3]> =
        (0..20).map(|i| [f64::from(i % 2), f64::from(i / 2 % 2), f64::from(i / 4)]).collect();
    let hex = |layer: u32| [0, 1, 3, 2, 4, 5, 7, 6].map(|corner| 4 * layer + corner);
    let nodes = |keep: fn([f64; 3]) -> bool| -> Vec<u32> {
        (0..20).filter(|&i| keep([f64::from(i % 2), f64::from(i / 2 % 2), f64::from(i / 4)])).collect()
    };
    let node_set = |id, nodes| NodeSet { id, name: String::new(), nodes };
    let side_set = |id, sides| SideSet { id, name: String::new(), sides };
    Mesh {
        blocks: vec![
            Block { name: "lower".into(), ..Block::hexahedra_of(1, [hex(0), hex(1)]) },
            Block::hexahedra_of(2, [hex(2), hex(3)]),
        ],
        node_sets: vec![
            node_set(1, nodes(|x| x[0] == 0.0)),
            node_set(2, nodes(|x| x[1] == 0.0)),
            node_set(3, nodes(|x| x[2] == 0.0)),
            node_set(4, nodes(|x| x[2] == 4.0)),
            node_set(9, Vec::new()),
        ],
        side_sets: vec![side_set(100, vec![(0, 4)]), side_set(200, vec![(3, 5)])],
        node_ids: (1..=20).collect(),
        element_ids: (1..=4).collect(),
        coordinates,
        ..Mesh::default()
    }
}

/// Compares a text with a file; with URTO_BLESS=1 in the environment, writes the file instead.
fn golden(path: &Path, text: &str) -> Result<(), String> {
    if std::env::var_os("URTO_BLESS").is_some() {
        return fs::write(path, text).map_err(|e| e.to_string());
    }
    let expected = fs::read_to_string(path).unwrap_or_default();
    if expected == text {
        return Ok(());
    }
    Err(format!("{}: expected\n{expected}\ngot\n{text}\nURTO_BLESS=1 accepts this", path.display()))
}

fn files(folder: &str, extension: &str) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut files: Vec<_> = entries.filter(|path| path.extension().is_some_and(|e| e == extension)).collect();
    files.sort();
    files
}

fn name(path: &Path) -> String {
    path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}

fn problem(text: &str) -> Problem {
    examine(Source::new("t.i", text), None).unwrap_or_else(|messages| panic!("{messages}"))
}

#[test]
fn wrong_decks_are_answered_as_written_down() {
    let decks = files("tests/wrong_decks", "i");
    assert!(decks.len() >= 60, "only {} wrong decks", decks.len());
    let mut failures = Vec::new();
    for path in decks {
        let bytes = fs::read(&path).expect("the file was listed");
        let text = match examine(Source::from_bytes(name(&path), &bytes), Some(&two_blocks())) {
            Ok(problem) => problem.diagnostics.render(false),
            Err(messages) => messages.render(false),
        };
        assert!(text.is_ascii() || !bytes.is_ascii(), "{}: plain messages are ASCII", path.display());
        assert!(!text.is_empty(), "{}: nothing to say about it", path.display());
        failures.extend(golden(&path.with_extension("expected"), &text).err());
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_command_that_is_built_is_used_by_a_deck() {
    let mut used: Vec<String> = Vec::new();
    for path in files("decks", "i") {
        let (deck, found) = Deck::read(Source::open(&path).expect("the file was listed"), language());
        assert!(!found.has_errors(), "{found}");
        used.extend(deck.cards.iter().map(|card| card.name.clone()));
    }
    for entry in language().commands().filter(|e| e.status == Status::Built && e.name != "EXIT") {
        assert!(used.contains(&entry.name), "no deck in decks/ uses {}", entry.name);
    }
}

#[test]
fn the_language_is_described_in_full() {
    for entry in &language().entries {
        assert!(!entry.does.is_empty(), "{} does nothing", entry.name);
        for name in &entry.see {
            assert!(language().entry(name).is_some(), "{} refers to {name}", entry.name);
        }
        let example = entry.example.join("\n");
        if entry.status != Status::Built || example.is_empty() {
            assert_ne!(entry.status, Status::Built, "{} has no example", entry.name);
            continue;
        }
        let (deck, found) = Deck::read(Source::new(entry.name.as_str(), example), language());
        let real = found.errors().filter(|e| !e.labels.is_empty()).count();
        assert!(real == 0, "the example of {}: {found}", entry.name);
        assert!(entry.name == "EXIT" || deck.cards[0].name == entry.name);
    }
}

/// What PRONTO's language has for solids of hexahedra, as far as it is known, and where each form comes from; `V` is seen in
/// a deck or a print file of PRONTO, `R` recalled.
const VERIFIED: &str = "TITLE/TERMINATION TIME/OUTPUT TIME/PLOT TIME/WRITE RESTART/AXISYMMETRIC/NO DISPLACEMENT/
    INITIAL VELOCITY MATERIAL/CONTACT SURFACE/PLOT NODAL/PLOT ELEMENT/PLOT STATE/MATERIAL";
const RECALLED: &str = "PLANE STRAIN/READ RESTART/TIME STEP SCALE/HOURGLASS STIFFENING/BULK VISCOSITY/FUNCTION/EXIT/
    EQUATION OF STATE/DETONATION POINT/NO ROTATION/PRESCRIBED DISPLACEMENT/PRESCRIBED VELOCITY/PRESCRIBED ACCELERATION/
    PRESCRIBED FORCE/PRESSURE/ADAPTIVE PRESSURE/DISTRIBUTED LOAD/THERMAL STRESS/SILENT BC/INITIAL VELOCITY NODESET/
    INITIAL VELOCITY ANGULAR/CONTACT MATERIAL/CONTACT DATA/CONTACT NODE SET/RIGID SURFACE/DELETE MATERIAL/DEATH/ACTIVE LIMITS/
    MATERIAL POINT/INTEGRATION POINTS/SHELL/THICKNESS SCALE/SPH";
/// Material models with their spellings.
const MODELS: &str =
    "ELASTIC/ELASTIC PLASTIC/LOW DEN FOAM/LOW DENSITY FOAM/SOIL N FOAMS/SOILS AND FOAMS/SOIL AND CRUSHABLE FOAM/
    VISCOPLASTIC/EP POWER HARD/DAMAGE/JOINTED ROCK/ORTHOTROPIC CRUSH/BAMMANN/VISCOELASTIC/CRUSHED SALT/THERMOELASTIC/
    HYDRODYNAMIC/EP HYDRODYNAMIC/EP HYDRO/JOHNSON COOK/MOONEY RIVLIN/FOAM PLASTICITY/CONCRETE";
const EQUATIONS: &str = "MG US-UP/MG POWER SERIES/JWL/IDEAL GAS";

/// Every command and model of PRONTO's is either built, or refused or idle with a reason; what is of shells and particles
/// waits for them. Nothing is left that only says that it is not there.
#[test]
fn the_language_of_pronto_is_known() {
    let list = |names: &'static str| names.split('/').map(str::trim);
    for (names, origin) in [(VERIFIED, Origin::Verified), (RECALLED, Origin::Recalled)] {
        for name in list(names) {
            let entry = language().entry(name).unwrap_or_else(|| panic!("{name} is not in the grammar"));
            assert_eq!(entry.from, origin, "{name}");
            let later = entry.family == "element";
            assert!(later || !matches!(entry.status, Status::Planned { .. }), "{name} is neither built nor refused");
        }
    }
    let has = |entry: &material::Entry, name: &str| entry.name == name || entry.aliases.contains(&name);
    for name in list(MODELS) {
        let refused = language().entry(name).is_some_and(|entry| matches!(entry.status, Status::Refused(_)));
        assert!(refused || MATERIALS.iter().any(|entry| has(entry, name)), "{name} is neither built nor refused");
    }
    for name in list(EQUATIONS) {
        let known = material::EQUATIONS_OF_STATE.iter().any(|e| e.name == name || e.aliases.contains(&name));
        assert!(known, "there is no {name}");
    }
    // What is neither in these lists nor ours has come from nowhere.
    for entry in language().commands().filter(|entry| entry.from != Origin::Ours) {
        assert!([VERIFIED, RECALLED].into_iter().flat_map(list).any(|name| name == entry.name), "{}", entry.name);
    }
}

/// A deck in the manner of 1988: blanks for commas, remarks behind data, small and capital letters, no EXIT.
const OLD_MANNER: &str = "TITLE
 CASK - 10\" PUNCH, I = 1-4, O = 3-8  (5/1/88)
TERMINATION TIME 40.0D-3
PLOT TIME         1.0E-3
plot nod       DISPL, REACTION, VELOCITY
PLOT ELEMENT   STRESS, STRAIN, PRESSURE, *  $ goes on
               VONMISES, ENERGY, DENSITY
PLOT STATE     EQPS
$
$     #   MATERIAL
$     1   OUTER SHELL
$
INITIAL VELOCITY MATERIAL  1 0, -175.8
NO DISPLACEMENT X 1
NO DISPLACEMENT X 1
NO DISPLACEMENT Y 11

MATERIAL, 1, ELASTIC PLASTIC, 7.324E-4   $ STEEL -- ROOM TEMPERATURE
YOUNGS MODULUS, 28.1+6
POISSONS RATIO,  0.3
YIELD STRESS    34.0E3
HARDENING MODULUS 3.12E5
BETA, 0.0
END
";

#[test]
fn a_deck_in_the_old_manner() {
    let Problem { model, diagnostics, .. } = problem(OLD_MANNER);
    assert_eq!(diagnostics.render(false), "");
    assert_eq!(model.title, " CASK - 10\" PUNCH, I = 1-4, O = 3-8  (5/1/88)");
    assert_eq!(model.termination_time, 0.04);
    assert_eq!(model.plot, PlotSchedule { interval: Some(1e-3), start: 0.0, stop: 0.08 });
    assert_eq!(model.plot_requests.nodal, [NodalField::Displacement, NodalField::Reaction, NodalField::Velocity]);
    assert_eq!(model.plot_requests.element.len(), 6);
    assert_eq!(model.plot_requests.state, ["EQPS"]);
    let velocity = [0.0, -175.8, 0.0];
    assert_eq!(model.initial_velocities, [InitialVelocity::Material { block: 1, velocity }]);
    assert_eq!(model.no_displacements.len(), 3); // repeating a card is legal
    let law = ElasticPlastic { young: 28.1e6, poisson: 0.3, yield_stress: 34e3, hardening: 3.12e5, beta: 0.0 };
    assert_eq!(model.materials[0].law, Law::ElasticPlastic(law));
    assert_eq!(model.materials[0].density, 7.324e-4);
    let notes: Vec<&str> = diagnostics.notes().map(|note| note.message.as_str()).collect();
    assert_eq!(notes, ["assumed PLOT NODAL for `plot nod`", "assumed DISPLACEMENT for `DISPL`"]);
}

/// Every kind of expression and block.
const EXPRESSIONS: &str = "TITLE
 BAR OF {n = 4} BLOCKS {{length = 2.5}}
$ {E = 28.1e6}  {steps = 10}  {nu = 0.3}   steel
$ {include(\"tests/wrong_decks/include/expressions.inc\")}
TERMINATION TIME {end = 40.0E-3}
{if(n > 2 && nu < 0.5)}
PLOT TIME {end / 40}
{elseif(n == 1)}
PLOT TIME 7
{else}
PLOT TIME {undefined}
{endif}
{loop(2, i, 1)}
NO DISPLACEMENT {i == 1 ? \"X\" : 'Y'} {10 * i + 1}
{endloop}
$ {ECHO(OFF)}
{c = sqrt(E / 7.324e-4)}
$ {ECHO(ON)}
{ifdef(length)}
INITIAL VELOCITY MATERIAL  1 0, {-hypot(3, 4) * length}
{endif}
MATERIAL, 1, ELASTIC, {7.324e-4}
YOUNGS MODULUS = {E}
POISSONS RATIO = {nu}
END
";

#[test]
fn a_deck_of_expressions_means_what_it_evaluates_to() {
    let Problem { model, diagnostics, .. } = problem(EXPRESSIONS);
    assert_eq!(diagnostics.render(false), "");
    assert_eq!((model.title.as_str(), model.termination_time), (" BAR OF 4 BLOCKS", 0.04));
    assert_eq!((model.plot.interval, model.output_interval), (Some(1e-3), 1e-4));
    let held: Vec<_> = model.no_displacements.iter().map(|held| (held.direction, held.node_set)).collect();
    assert_eq!(held, [(Direction::X, 11), (Direction::Y, 21)]);
    let velocity = [0.0, -12.5, 0.0];
    assert_eq!(model.initial_velocities, [InitialVelocity::Material { block: 1, velocity }]);
    assert_eq!(model.materials[0].law, Law::Elastic(urto::material::Elastic { young: 28.1e6, poisson: 0.3 }));
}

/// The least that a deck must say.
const LEAST: &str = "TERM TIME 1\nMATERIAL 1 ELASTIC 1\nYOU MOD 1\nPOI RAT 0\nEND\n";

#[test]
fn defaults_of_a_deck_that_says_little() {
    let model = problem(LEAST).model;
    assert_eq!((model.time_step.scale, model.time_step.growth), (1.0, 1.1));
    assert_eq!(model.time_step.moduli, StepModuli::Elastic);
    assert_eq!((model.bulk_viscosity.linear, model.bulk_viscosity.quadratic), (0.06, 1.2));
    assert_eq!(model.hourglass, model::DEFAULT_HOURGLASS);
    assert_eq!((model.output_interval, model.plot.interval, model.plot.stop), (0.01, None, 2.0));
    assert_eq!(model.plot_requests.nodal, [NodalField::Displacement]);
}

#[test]
fn hourglass_commands_in_either_order() {
    let hourglass = |text: &str| problem(&format!("{LEAST}{text}")).model.hourglass;
    let flanagan = |stiffness, viscosity| Hourglass::FlanaganBelytschko { stiffness, viscosity };
    assert_eq!(hourglass("HOURGLASS STIFFENING"), flanagan(0.05, 0.0));
    assert_eq!(hourglass("HOURGLASS STIFFENING, 0.01, 0.03"), flanagan(0.01, 0.03));
    assert_eq!(hourglass("HOURGLASS STIFFENING,, 0.03"), flanagan(0.05, 0.03));
    assert_eq!(hourglass("HOURGLASS CONTROL, FLAN BELY"), flanagan(0.05, 0.0));
    let both = "HOURGLASS STIFFENING, 0.02\nHOURGLASS CONTROL, FLANAGAN BELYTSCHKO, 0.5";
    assert_eq!(hourglass(both), flanagan(0.01, 0.0));
    let reversed = "HOURGLASS CONTROL, FLANAGAN BELYTSCHKO, 0.5\nHOURGLASS STIFFENING, 0.02";
    assert_eq!(hourglass(reversed), flanagan(0.01, 0.0));
    assert_eq!(hourglass("HOURGLASS CONTROL, ASSUMED STRAIN, 0.3"), Hourglass::AssumedStrain { factor: 0.3 });
}

#[test]
fn loads_refer_to_functions_wherever_they_stand() {
    let text = format!(
        "{LEAST}PRESSURE 7 20 3.0\nGRAVITY 0 0 -9.81\nPRES VELO z 4 10\nRIGID SURFACE 7 0 0 0 0 0 -2\n\
         FUNCTION 10\n0 1\nEND\nFUNCTION 20\n0 0\n1 5\nEND\n"
    );
    let model = problem(&text).model;
    assert_eq!(model.functions[model.pressures[0].function].points, [(0.0, 0.0), (1.0, 5.0)]);
    assert_eq!(model.gravities[0].function, None);
    let motion = model.prescribed_motions[0];
    assert_eq!((motion.direction, motion.node_set, motion.function, motion.scale), (Direction::Z, 4, 0, 1.0));
    assert_eq!(model.rigid_surfaces[0].normal, [0.0, 0.0, -1.0]);
}

#[test]
fn commands_that_are_not_built_stop_or_warn() {
    for entry in language().commands().filter(|e| e.status != Status::Built) {
        let fields = if entry.name == "NO ROTATION" { "X, 2" } else { "1, 2" };
        let end = if entry.form == deck::Form::Group { "\nEND" } else { "" };
        let result = examine(Source::new("t.i", format!("{LEAST}{}, {fields}{end}", entry.name)), None);
        match entry.status {
            Status::Planned { physics: false } | Status::Idle(_) => {
                let problem = result.unwrap_or_else(|messages| panic!("{messages}"));
                assert_eq!(problem.diagnostics.warnings().count(), 1, "{}", entry.name);
            }
            _ => assert_eq!(result.map_err(|d| d.errors().count()).err(), Some(1), "{}", entry.name),
        }
    }
}

/// Pieces that a mutation puts into a deck.
const PIECES: &[&str] = &[
    "\n",
    ",",
    "=",
    " ",
    "*",
    "$",
    "'",
    "''",
    "END",
    "\nEND\n",
    "MATERIAL",
    "FUNCTION",
    "TITLE",
    "\nTITLE",
    "PLOT",
    "1E999",
    "-1",
    "0",
    "1.5+3",
    "99999999999999999999",
    "\u{2212}1",
    "\u{fffd}",
    "\0",
    "\r\n",
    "\t",
    "\u{feff}",
    "\u{df}",
    "{x}",
    "XYZ",
    "{",
    "}",
    "{{",
    "}}",
    "\\{",
    "{x = 2}",
    "{x++}",
    "{1/0}",
    "{\"a\"//'b'}",
    "(",
    ")",
    "?",
    ":",
    "++",
    "\n{if(x > 1)}\n",
    "\n{else}\n",
    "\n{endif}\n",
    "\n{loop(3)}\n",
    "\n{endloop}\n",
    "{include(\"tests/wrong_decks/include/times.inc\")}",
    "{ECHO(OFF)}",
    "\n{VERBATIM(ON)}\n",
];

/// Applies one mutation: deletes, repeats or cuts a stretch, or puts a piece in. Positions are taken modulo the length.
fn mutate(text: &mut Vec<char>, (kind, at, length, piece): (u8, usize, usize, usize)) {
    let at = at % (text.len() + 1);
    let end = (at + length).min(text.len());
    match kind % 4 {
        0 => drop(text.drain(at..end)),
        1 => text.extend_from_within(at..end),
        2 => text.truncate(text.len() - length.min(text.len()) / 8),
        _ => drop(text.splice(at..at, PIECES[piece % PIECES.len()].chars())),
    }
}

#[test]
fn a_hundred_thousand_mutilated_decks_are_answered() {
    let seeds = [OLD_MANNER, &fs::read_to_string("decks/commands.i").expect("a deck of ours"), EXPRESSIONS];
    let mesh = two_blocks();
    let mutations = prop::collection::vec((any::<u8>(), any::<usize>(), 0usize..60, any::<usize>()), 1..8);
    let mut cases = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(100_000));
    let outcome = cases.run(&(0usize..3, mutations), |(seed, mutations)| {
        let mut text: Vec<char> = seeds[seed].chars().collect();
        mutations.into_iter().for_each(|mutation| mutate(&mut text, mutation));
        let text: String = text.into_iter().collect();
        let messages = match examine(Source::new("t.i", text), Some(&mesh)) {
            Ok(problem) => problem.diagnostics,
            Err(messages) => messages,
        };
        for label in messages.errors().flat_map(|diagnostic| &diagnostic.labels) {
            let (file, span) = messages.source().origin_of(label.span);
            prop_assert!(file.text().get(span.start..span.end).is_some(), "a span cuts a character");
        }
        messages.render(false);
        Ok(())
    });
    outcome.unwrap_or_else(|why| panic!("{why}"));
}
