//! The command language from outside: wrong decks with their whole messages, and right decks with what they mean.

use std::{fs, path::Path};

use crate::fixtures::{problem, two_blocks};
use crate::properties::with_a_neighbour;
use urto::{
    deck::{self, Deck, Source, Status, language},
    material::{self, ElasticPlastic, Law, MATERIALS, Origin},
    mesh::{Mesh, Shape},
    model::{
        self, Direction, ElementField, Hourglass, InitialVelocity, NodalField, PlotSchedule, Problem, StepModuli,
        examine,
    },
};

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

#[test]
fn wrong_decks_are_answered_as_written_down() {
    let decks = files("tests/language/wrong_decks", "i");
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

/// A model's own name is meant before another's alias that begins alike, and one that is built before one that is not.
#[test]
fn abbreviated_materials_are_those_that_are_meant() {
    for (word, asks_for) in [
        ("ELAST", "YOUNGS MODULUS and POISSONS RATIO are missing"),
        ("VISCO", "YOUNGS MODULUS, POISSONS RATIO, YIELD STRESS and GAMMA are missing"),
    ] {
        let deck = format!("TERMINATION TIME, 1.\nMATERIAL, 1, {word}, 1.\nEND\nEXIT\n");
        let wrong = examine(Source::from_bytes("deck", deck.as_bytes()), Some(&two_blocks())).err();
        let messages = wrong.map_or(String::new(), |messages| messages.render(false));
        assert!(messages.contains(asks_for), "{word}: {messages}");
    }
}

/// What is chosen for hexahedra is told to have no effect where there are none.
#[test]
fn choices_for_hexahedra_are_told_to_be_idle_in_the_plane() {
    let mesh = urto::mesher::make("RECTANGLE, 1, 0., 0., 1., 1., 1, 1\n", "recipe", 1);
    let mesh = mesh.unwrap_or_else(|found| panic!("{}", found.render(false)));
    let deck = "TERMINATION TIME, 1.\nPLANE STRAIN\nPRECISION, SINGLE\nTIME STEP ESTIMATE, GLOBAL\n\
                MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\nEXIT\n";
    let told = |mesh| {
        let problem = examine(Source::new("t.i", deck), Some(mesh));
        problem.unwrap_or_else(|messages| panic!("{}", messages.render(false))).diagnostics.render(false)
    };
    let of_plane = told(&mesh);
    for name in ["PRECISION", "TIME STEP ESTIMATE"] {
        assert!(of_plane.contains(&format!("warning: {name}: the mesh has no hexahedra")), "{of_plane}");
    }
}

/// Shapes that the grammar names are shapes of meshes: a misspelt one would warn of every block.
#[test]
fn commands_about_elements_name_shapes_that_there_are() {
    let kinds = Shape::ALL.map(Shape::kind);
    let named: Vec<&String> =
        language().entries.iter().filter_map(|entry| entry.shapes.as_ref()).flat_map(|(shapes, _)| shapes).collect();
    assert!(named.len() >= 6 && named.iter().all(|shape| kinds.contains(&shape.as_str())), "{named:?}");
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
/// What SANTOS adds, which is refused.
const SANTOS: &str = "STEP CONTROL/RESIDUAL TOLERANCE/MAXIMUM ITERATIONS/MAXIMUM TOLERANCE/PREDICTOR SCALE FACTOR/
    MINIMUM DAMPING FACTOR/INTERMEDIATE PRINT/ELASTIC SOLUTION/AUTO STEP/INITIAL STRESS";
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
    for (names, origin) in [(VERIFIED, Origin::Verified), (RECALLED, Origin::Recalled), (SANTOS, Origin::Recalled)] {
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
        assert!(
            [VERIFIED, RECALLED, SANTOS].into_iter().flat_map(list).any(|name| name == entry.name),
            "{}",
            entry.name
        );
    }
}

/// A deck in the manner of 1988: blanks for commas, remarks behind data, small and capital letters, no EXIT.
pub const OLD_MANNER: &str = "TITLE
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
pub const EXPRESSIONS: &str = "TITLE
 BAR OF {n = 4} BLOCKS {{length = 2.5}}
$ {E = 28.1e6}  {steps = 10}  {nu = 0.3}   steel
$ {include(\"tests/language/wrong_decks/include/expressions.inc\")}
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
pub const LEAST: &str = "TERM TIME 1\nMATERIAL 1 ELASTIC 1\nYOU MOD 1\nPOI RAT 0\nEND\n";

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
fn words_mean_what_analysts_mean() {
    let fields = |text: &str| problem(&format!("{LEAST}PLOT ELEMENT, {text}\n")).model.plot_requests.element;
    assert_eq!(fields("STRE"), [ElementField::Stress], "PRONTO has no other word that begins so");
    assert_eq!(fields("STRET, ROT"), [ElementField::Stretch, ElementField::Rotation]);
    assert_eq!(fields("STRA"), [ElementField::Strain]);
    for apostrophe in ["'", "\u{2019}"] {
        let deck = LEAST.replace("YOU MOD", &format!("Young{apostrophe}s modulus"));
        assert_eq!(problem(&deck).model.materials, problem(LEAST).model.materials);
    }
    let velocity = |fields: &str| problem(&format!("{LEAST}INITIAL VELOCITY MATERIAL, 1{fields}\n")).model;
    for (fields, expected) in
        [(",,,-5.", [0.0, 0.0, -5.0]), (",2.", [2.0, 0.0, 0.0]), (",,3.", [0.0, 3.0, 0.0]), (",0.", [0.0; 3])]
    {
        let given = InitialVelocity::Material { block: 1, velocity: expected };
        assert_eq!(velocity(fields).initial_velocities, [given], "{fields}");
    }
}

#[test]
fn distribution_factors_are_told_to_be_unused_where_they_would_matter() {
    let mut mesh = two_blocks();
    mesh.weighted = [vec![3], vec![200]];
    let head = with_a_neighbour("MATERIAL 1 ELASTIC 1\nYOUNGS MODULUS 1\nPOISSONS RATIO 0\nEND\n");
    let warnings = |commands: &str| -> Vec<String> {
        let problem = examine(Source::new("t.i", format!("{head}{commands}")), Some(&mesh));
        let problem = problem.unwrap_or_else(|messages| panic!("{messages}"));
        problem.diagnostics.warnings().map(|warning| warning.message.clone()).collect()
    };
    let told = "PRESSURE: the distribution factors of side set 200 are not used";
    assert_eq!(warnings("PRESSURE, 200, 1\nPRESSURE, 100, 1\nNO DISPLACEMENT, X, 3\n"), [told]);
    let told = "PRESCRIBED VELOCITY: the distribution factors of node set 3 are not used";
    assert_eq!(warnings("PRESCRIBED VELOCITY, X, 3, 1\n"), [told]);
    // Of forces they say how the nodes share what is given.
    assert_eq!(warnings("PRESCRIBED FORCE, X, 3, 1\n"), [""; 0]);
}

#[test]
fn a_pressure_on_edges_of_shells_is_told_to_do_nothing() {
    let triangles =
        "TITLE\n t\nSHEET, 1, 0., 0., 0., 1., 1., 0., 1, 1\nTRIANGLES, 1\nSIDE SET NORMAL, 100, 0., 0., 1.\n";
    let deck = "TITLE\n t\nTERMINATION TIME, 1.\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nSHELL THICKNESS, 1, 0.1\nPRESSURE, 100, 1\n\
                MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";
    let with_sides = |sides: [u8; 2]| {
        let mut mesh = urto::mesher::make(triangles, "t.mesh", 1).expect("a mesh");
        mesh.side_sets[0].sides.iter_mut().zip(sides).for_each(|((_, side), given)| *side = given);
        match examine(Source::new("t.i", deck.to_owned()), Some(&mesh)) {
            Ok(problem) => {
                Ok(problem.diagnostics.warnings().map(|warning| warning.message.clone()).collect::<Vec<_>>())
            }
            Err(messages) => Err(messages.to_string()),
        }
    };
    assert_eq!(with_sides([0, 0]), Ok(Vec::new()));
    let told = "PRESSURE: 1 of the 2 sides of side set 100 are edges or ends of elements";
    assert_eq!(with_sides([0, 4]), Ok(vec![told.to_owned()]));
    let refused = with_sides([2, 3]).expect_err("nothing is pressed");
    assert!(refused.contains("all 2 sides of side set 100 are edges"), "{refused}");
}

/// Nodes in an oblique plane are off it by round-off, which is no depth; a real one is told.
#[test]
fn nodes_in_an_oblique_plane_are_not_behind_it() {
    for degrees in [11.0_f64, 23.0, 37.0, 52.0, 71.0] {
        let recipe = format!(
            "BOX, 1, 0., 0., 0., 0.3, 0.7, 0.2, 3, 4, 2\nROTATE, 1, Y, {degrees}\nROTATE, 1, X, {degrees}\nSIDE SET FACE, 7, 1, BOTTOM\n"
        );
        let mesh = urto::mesher::make(&recipe, "t.mesh", 1).expect("a mesh");
        let (s, c) = degrees.to_radians().sin_cos();
        let told = |depth: f64| {
            let text = format!("{LEAST}RIGID SURFACE, 7, 0., 0., {depth:e}, {s:e}, {:e}, {:e}\n", -s * c, c * c);
            let problem = examine(Source::new("t.i", text), Some(&mesh)).expect("a problem");
            problem.diagnostics.warnings().map(|warning| warning.message.clone()).collect::<Vec<_>>()
        };
        assert_eq!(told(0.0), Vec::<String>::new(), "{degrees}");
        let behind = told(1e-6);
        assert!(behind.len() == 1 && behind[0].contains("20 of the 20 nodes of side set 7 begin behind"), "{behind:?}");
    }
}

/// A part that is in the mesh twice has its mass twice.
#[test]
fn elements_that_are_there_twice_are_told() {
    let told = |mesh: &Mesh| {
        let text = format!("{LEAST}MATERIAL, 2, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n");
        let problem = examine(Source::new("t.i", text), Some(mesh)).expect("a problem");
        problem.diagnostics.warnings().map(|warning| warning.message.clone()).collect::<Vec<_>>()
    };
    let mut mesh = two_blocks();
    assert_eq!(told(&mesh), Vec::<String>::new());
    let first = mesh.blocks[0].nodes[..8].to_vec();
    mesh.blocks[1].nodes.extend(first);
    mesh.element_ids.push(17);
    let words = "1 element has the same nodes as another one: element 17 of block 2 those of element 1 of block 1";
    assert_eq!(told(&mesh), [words]);
}

/// What is picked by where its nodes are holds both faces of a shell, on which pressures cancel.
#[test]
fn a_pressure_on_both_faces_of_shells_is_told_to_cancel() {
    let warnings = |set: &str, load: &str| {
        let sheet = "SHEET, 1, 0., 0., 0., 1., 1., 0., 2, 1\n";
        let mesh = urto::mesher::make(&format!("{sheet}SIDE SET {set}\n"), "t.mesh", 1).expect("a mesh");
        let deck = format!(
            "TERMINATION TIME, 1.\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nSHELL THICKNESS, 1, 0.1\nPRESSURE, 100, 1\n\
             {load}MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n"
        );
        let problem = examine(Source::new("t.i", deck), Some(&mesh)).expect("a problem");
        problem.diagnostics.warnings().map(|warning| warning.message.clone()).collect::<Vec<_>>()
    };
    let told = |command| format!("{command}: side set 100 holds both faces of 2 shells, element 1 first");
    assert_eq!(warnings("NORMAL, 100, 0., 0., 1.", ""), Vec::<String>::new());
    assert_eq!(warnings("NORMAL, 100, 0., 0., -1.", ""), Vec::<String>::new());
    assert_eq!(warnings("PLANE, 100, Z, 0.", ""), [told("PRESSURE")]);
    assert_eq!(warnings("BOX, 100, , , , , , 1.", "SILENT BC, 100\n"), [told("PRESSURE"), told("SILENT BC")]);
}

#[test]
fn all_stands_for_every_block_of_contact() {
    let blocks = "MATERIAL 2 ELASTIC 1\nYOU MOD 1\nPOI RAT 0\nEND\nMATERIAL 3 ELASTIC 1\nYOU MOD 1\nPOI RAT 0\nEND\n";
    let contact = |text: &str| problem(&format!("{LEAST}{blocks}{text}")).model.contact;
    assert_eq!(contact("CONTACT MATERIAL, ALL\n").materials, contact("CONTACT MATERIAL\n").materials);
    assert_ne!(contact("CONTACT MATERIAL, 1\n").materials, contact("CONTACT MATERIAL, ALL\n").materials);
    let coefficient = |text: &str, a: i64, b: i64| -> Option<f64> {
        let data = contact(&format!("CONTACT MATERIAL, ALL\n{text}")).data;
        let found: Vec<_> = data.iter().filter(|d| d.materials == [a, b] || d.materials == [b, a]).collect();
        assert!(found.len() < 2, "{a} and {b} are paired once");
        found.first().map(|data| data.friction.at_rest)
    };
    let all = "CONTACT DATA, ALL, ALL, 0.2\n";
    for (a, b) in [(1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3)] {
        assert_eq!(coefficient(all, a, b), Some(0.2));
    }
    for text in [format!("{all}CONTACT DATA, 3, 1, 0.5\n"), format!("CONTACT DATA, 3, 1, 0.5\n{all}")] {
        assert_eq!(coefficient(&text, 1, 3), Some(0.5), "what is said of a pair holds over what is said of all");
        assert_eq!(coefficient(&text, 1, 2), Some(0.2));
    }
    let one = "CONTACT DATA, 2, ALL, 0.3, 0.25\n";
    assert_eq!((coefficient(one, 2, 3), coefficient(one, 3, 1)), (Some(0.3), None));
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
