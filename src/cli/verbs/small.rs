//! The smaller verbs: explain, mesh, refine, diff, join, generate.

use crate::cli::options::{self, Generated};
use crate::cli::outputs::{ANOTHER_NAME, Inputs};
use crate::cli::terminal::{complain, print, say};
use crate::cli::{DONE, FAILED, Failure};
use crate::mesh::Mesh;
use crate::mesh::refine::refined;
use crate::output::GLOBAL_VARIABLES;
use crate::{deck, exodus, material, mesher};
use std::path::PathBuf;

/// `urto explain`
///
/// # Errors
///
/// Nothing is known by these words.
pub fn explain(options: &options::Explain) -> Result<u8, Failure> {
    if let [deck, block] = &options.curve[..] {
        return super::curve::curve(options, deck, block);
    }
    print(&explained(&options.words.join(" "))?);
    Ok(DONE)
}

/// The page or the list that these words ask for.
fn explained(words: &str) -> Result<String, Failure> {
    if words.trim().is_empty() {
        return Ok(overview());
    }
    let global = GLOBAL_VARIABLES.iter().find(|(name, _)| name.eq_ignore_ascii_case(words.trim()));
    if let Some((name, meaning)) = global {
        return Ok(format!("{name}\n   Global variable of the plot file, always written: {meaning}.\n"));
    }
    if let Some(text) = deck::explain_word(words, mesher::language(), &material::models()) {
        return Ok(text);
    }
    // A name that both languages have is most likely the deck's.
    let text = deck::explain(words, &material::models()).or_else(|unknown| {
        let recipe = deck::explain_in(mesher::language(), words);
        recipe.map_err(|other| if unknown.near.is_some() { unknown } else { other })
    });
    let found = |unknown: deck::UnknownTopic| match deck::search(words, mesher::language(), &material::models()) {
        Some(pages) => Ok(format!("{words} stands in\n{pages}")),
        None => Err(Failure::input(format_args!("error: {unknown}"))),
    };
    text.or_else(found)
}

/// All commands of decks, then those of recipes.
fn overview() -> String {
    let list = |text: Result<String, _>| text.unwrap_or_else(|e: deck::UnknownTopic| e.to_string());
    format!(
        "{}\nmesh recipes\n{}",
        list(deck::explain("", &material::models())),
        list(deck::explain_in(mesher::language(), ""))
    )
}

/// `urto mesh`
///
/// # Errors
///
/// The recipe cannot be read or has mistakes, or the mesh cannot be written.
pub fn mesh(options: &options::Mesh) -> Result<u8, Failure> {
    let recipe = &options.recipe;
    let given = crate::cli::input::definitions(&options.define)?;
    let (mut mesh, files) = crate::cli::input::read_or_make(recipe, options.refine, &given, options.ranks)?;
    crate::cli::input::all_used(&given)?;
    let mut ends = String::new();
    if let Some(how) = sweep_of(options)? {
        let swept = mesher::sweep(&mesh, how, options.cells.unwrap_or(1) as usize);
        let solid = "error: only a two-dimensional mesh becomes a solid: one of RECTANGLE, QUADRILATERAL, DISC or RING";
        let swept = swept.ok_or_else(|| Failure::input(format_args!("{solid}")))?;
        ends = swept.ends.map_or(ends, |[first, last]| format!("; sets {first} and {last} are its ends"));
        mesh = swept.mesh;
    }
    let output = options
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(recipe.file_name().unwrap_or_default()).with_extension("g"));
    Inputs::default().with("the recipe", files).spare(exodus::names_in_writing(&output), ANOTHER_NAME)?;
    exodus::write_mesh(&output, &mesh).map_err(|e| Failure::run(format_args!("error: {e}")))?;
    let (nodes, elements, blocks) = (mesh.coordinates.len(), mesh.element_count(), mesh.blocks.len());
    say(format_args!("{}: {nodes} nodes, {elements} elements in {blocks} block(s){ends}", output.display()));
    Ok(DONE)
}

/// `urto refine`
pub fn refine(options: &options::Refine) -> Result<u8, Failure> {
    let path = &options.mesh;
    if crate::cli::input::is_recipe(path) {
        let help = format_args!("help: `urto mesh {} --refine 2` makes the finer mesh", path.display()).to_string();
        return Err(Failure::input(format_args!("error: {} is a recipe, not a mesh\n{help}", path.display())));
    }
    let output = options.output.clone().unwrap_or_else(|| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        PathBuf::from(stem + "_fine.g")
    });
    Inputs::default().with("the mesh", [path]).spare(exodus::names_in_writing(&output), ANOTHER_NAME)?;
    let coarse = exodus::read_mesh(path).map_err(Failure::input)?;
    let mut fine = refined(&coarse).map_err(|e| Failure::input(format_args!("error: {}: {e}", path.display())))?;
    fine.share_out_as(&coarse);
    exodus::write_mesh(&output, &fine).map_err(|e| Failure::run(format_args!("error: {e}")))?;
    let counts = |mesh: &Mesh| format!("{} nodes, {} elements", mesh.coordinates.len(), mesh.element_count());
    say(format_args!("{}: {}; {} had {}", output.display(), counts(&fine), path.display(), counts(&coarse)));
    Ok(DONE)
}

/// What --revolve and --extrude ask for.
fn sweep_of(options: &options::Mesh) -> Result<Option<mesher::Sweep>, Failure> {
    let wrong = |name: &str, value: f64, expected: &str| {
        Failure::input(format_args!("error: --{name} is {value}; expected {expected}"))
    };
    match (options.revolve, options.extrude) {
        (Some(angle), _) if angle > 0.0 && angle <= 360.0 => Ok(Some(mesher::Sweep::Revolve(angle))),
        (Some(angle), _) => Err(wrong("revolve", angle, "more than 0 degrees, 360 at most")),
        (_, Some(length)) if length > 0.0 && length.is_finite() => Ok(Some(mesher::Sweep::Extrude(length))),
        (_, Some(length)) => Err(wrong("extrude", length, "a length greater than 0")),
        _ => Ok(None),
    }
}

/// `urto diff`
///
/// # Errors
///
/// A file cannot be read. That files differ is no error but an exit code.
pub fn diff(options: &options::Diff) -> Result<u8, Failure> {
    let tolerance = exodus::Tolerance { relative: options.tolerance, floor: options.floor };
    let comparison = exodus::compare(&options.first, &options.second, &tolerance).map_err(Failure::input_error)?;
    say(&comparison);
    Ok(if comparison.is_same() { DONE } else { FAILED })
}

/// `urto join`
///
/// # Errors
///
/// Pieces are missing or do not belong together, or the file cannot be written.
pub fn join(options: &options::Join) -> Result<u8, Failure> {
    use exodus::pieces;
    let (whole, found) = pieces::pieces_of(&options.pieces).map_err(Failure::input_error)?;
    let output = options.output.as_ref().unwrap_or(&whole);
    Inputs::default().with("one of the pieces", &found).spare(exodus::names_in_writing(output), ANOTHER_NAME)?;
    let joined = pieces::join(&found, output).map_err(|error| match &error {
        pieces::JoinError::File(file) if file.is_of_writing() => Failure::run(format_args!("error: {error}")),
        _ => Failure::input_error(error),
    })?;
    if joined.most > joined.states {
        complain(format_args!(
            "warning: some pieces have {} states, others {}: the run ended while it wrote; the {} that all have are joined",
            joined.most, joined.states, joined.states
        ));
    }
    say(format_args!("{}: {} states from {} pieces", output.display(), joined.states, joined.pieces));
    Ok(DONE)
}

/// `urto generate`
///
/// # Errors
///
/// None; the result has the type of those of all verbs.
pub fn generate(options: &options::Generate) -> Result<u8, Failure> {
    let mut out = Vec::new();
    let mut complete = |shell| clap_complete::generate(shell, &mut crate::cli::command(), "urto", &mut out);
    match options.what {
        Generated::Man => out = crate::cli::manual().into_bytes(),
        Generated::ManDeck => out = deck::manual(&material::models()).into_bytes(),
        Generated::ManMesh => out = mesher::manual().into_bytes(),
        Generated::Bash => complete(clap_complete::Shell::Bash),
        Generated::Zsh => complete(clap_complete::Shell::Zsh),
        Generated::Fish => complete(clap_complete::Shell::Fish),
    }
    print(&String::from_utf8_lossy(&out));
    Ok(DONE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{Status, language};

    /// A text in one line, as pages are broken into lines.
    fn flat(text: &str) -> String {
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    fn page(name: &str) -> String {
        explained(name).map(|text| flat(&text)).unwrap_or_default()
    }

    /// No word of the glossary, variable or other language hides the page of a command or of a model.
    #[test]
    fn every_name_shows_its_page() {
        let (deck, recipe) = (language(), mesher::language());
        let of_deck = |name: &str| deck.entries.iter().any(|entry| entry.spellings().any(|known| known == name));
        let of_recipes = recipe.entries.iter().filter(|entry| !of_deck(&entry.name));
        for entry in deck.entries.iter().chain(of_recipes) {
            for name in entry.spellings() {
                let page = page(name);
                assert!(page.contains(&flat(&entry.does)), "{name}: {page}");
                assert!(entry.status != Status::Built || page.contains(&flat(&entry.syntax())), "{name}: {page}");
            }
        }
        for model in material::models().iter().flat_map(|kind| &kind.models) {
            assert!(page(model.name).contains(&flat(model.summary)), "{}", model.name);
        }
    }

    #[test]
    fn words_come_before_the_commands_that_they_name() {
        let page = page("RIGID BODY");
        assert!(page.contains("one rigid body, with the mass and inertia of its elements"), "{page}");
        assert!(page.contains("Form RIGID BODY, block, ..."), "{page}");
    }
}
