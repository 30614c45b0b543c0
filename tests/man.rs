//! The man page urto.1 is made from the option table. `URTO_BLESS=1 cargo test --test man` rewrites it.

mod program;

#[test]
fn the_man_page_is_current() {
    let path = program::project("man/urto.1");
    let made = urto::cli::manual();
    if std::env::var_os("URTO_BLESS").is_some() {
        std::fs::write(&path, &made).expect("the page can be written");
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(made == kept, "man/urto.1 is stale: run `make man`");
}

#[test]
fn the_program_prints_the_page() {
    let desk = program::Desk::new();
    let left = desk.urto(&["generate", "man"]).with(0);
    assert!(left.out == urto::cli::manual());
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
