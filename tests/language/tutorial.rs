//! The tutorial is typed as it stands, into an empty folder.

use crate::program::{Desk, project};

fn text(name: &str) -> String {
    std::fs::read_to_string(project(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The words of a line of the shell; single quotes keep words together.
fn words(line: &str) -> Vec<String> {
    let parts = line.split('\'').enumerate();
    parts
        .flat_map(|(place, part)| match place % 2 {
            1 => vec![part.to_owned()],
            _ => part.split_whitespace().map(str::to_owned).collect(),
        })
        .collect()
}

#[test]
fn every_command_of_the_tutorial_does_what_it_says() {
    let page = text("docs/tutorial.md");
    let desk = Desk::new();
    // The page shows deck and recipe as they are in the project.
    for (name, file) in [("lined_box.mesh", "meshes/lined_box.mesh"), ("lined_box.i", "decks/lined_box.i")] {
        let shown: String = text(file).lines().map(|line| format!("    {line}").trim_end().to_owned() + "\n").collect();
        assert!(page.contains(&shown), "the page has another {file}");
        desk.put(name, &text(file));
    }
    let commands: Vec<&str> = page.lines().filter_map(|line| line.strip_prefix("    urto ")).collect();
    assert!(commands.len() > 10);
    for command in commands {
        let words = words(command);
        let arguments: Vec<&str> = words.iter().map(String::as_str).collect();
        let left = desk.urto(&arguments).with(0);
        if command.contains("ACCLZ_BLOCK3") && command.starts_with("plot") {
            left.says(&["2.2364e+00"]);
        }
        if let Some(output) = arguments.iter().position(|word| *word == "-o").map(|place| arguments[place + 1]) {
            assert!(desk.has(output), "{command}");
        }
    }
    for file in [
        "lined_box.json",
        "lined_box.o",
        "lined_box_sweep/table.txt",
        "lined_box_sweep/ACCLZ_BLOCK3.png",
        "lined_box.html",
    ] {
        assert!(desk.has(file), "{file}");
    }
    for part in page.split("](figures/").skip(1) {
        let name = part.split(')').next().unwrap_or("");
        assert!(project("docs/figures").join(name).exists(), "{name}");
    }
}
