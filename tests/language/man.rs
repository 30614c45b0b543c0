//! The man pages are made from the option table and the grammars. `URTO_BLESS=1 cargo test --test language man::` rewrites them.

/// What `urto generate` calls each page, its file, and its text.
fn pages() -> [(&'static str, &'static str, String); 3] {
    [
        ("man", "man/urto.1", urto::cli::manual()),
        ("man-deck", "man/urto-deck.5", urto::deck::manual(&urto::material::models())),
        ("man-mesh", "man/urto-mesh.5", urto::mesher::manual()),
    ]
}

#[test]
fn the_man_pages_are_current() {
    for (_, file, made) in pages() {
        let path = crate::program::project(file);
        if std::env::var_os("URTO_BLESS").is_some() {
            std::fs::write(&path, &made).expect("the page can be written");
        }
        let kept = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(made == kept, "{file} is stale: run `make man`");
    }
}

#[test]
fn the_program_prints_the_pages_and_installs_them() {
    let desk = crate::program::Desk::new();
    let makefile = std::fs::read_to_string(crate::program::project("Makefile")).expect("the project's Makefile");
    for (name, file, made) in pages() {
        assert!(desk.urto(&["generate", name]).with(0).out == made, "{name}");
        assert!(makefile.contains(&format!("install -D -m 644 {file} ")), "{file}");
        assert!(makefile.contains(&format!("generate {name} > {file}")), "{file}");
    }
}

#[test]
fn the_page_on_recipes_has_every_command() {
    let page = urto::mesher::manual();
    for entry in &urto::mesher::language().entries {
        assert!(page.contains(&format!("\n.SS {}\n", entry.name)), "{}", entry.name);
    }
}

#[test]
fn every_verb_and_option_is_on_the_page() {
    let page = urto::cli::manual().replace("\\-", "-");
    for verb in urto::cli::command().get_subcommands().filter(|verb| !verb.is_hide_set()) {
        assert!(page.contains(verb.get_name()), "{}", verb.get_name());
        for long in verb.get_arguments().filter_map(|argument| argument.get_long()) {
            assert!(page.contains(&format!("--{long}")), "--{long} of {}", verb.get_name());
        }
    }
    for section in
        ["SYNOPSIS", "THE PRINT LOG", "GLOBAL VARIABLES", "FILES", "EXIT STATUS", "ENVIRONMENT", "EXAMPLES", "SEE ALSO"]
    {
        assert!(page.contains(&format!(".SH \"{section}\"")) || page.contains(&format!(".SH {section}")), "{section}");
    }
}
