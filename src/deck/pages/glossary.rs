//! Texts beside the commands: words that people look for first, variables, and formulas of the laws. They are data, in
//! `grammar/*.txt`.

use std::sync::OnceLock;

/// An entry of a glossary.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::deck) struct Term {
    /// The name and its other spellings, in capitals.
    pub names: Vec<String>,
    /// What there is to say: paragraphs, and lines that stay as they are, which begin with two blanks.
    pub text: Vec<String>,
    /// Numbers worked through.
    pub worked: Vec<String>,
    /// What else to read.
    pub see: Vec<String>,
}

/// Words of other codes.
pub(in crate::deck) fn words() -> &'static [Term] {
    static WORDS: OnceLock<Vec<Term>> = OnceLock::new();
    WORDS.get_or_init(|| read(include_str!("../../../grammar/words.txt")))
}

/// Variables of results and histories.
pub(in crate::deck) fn variables() -> &'static [Term] {
    static VARIABLES: OnceLock<Vec<Term>> = OnceLock::new();
    VARIABLES.get_or_init(|| read(include_str!("../../../grammar/variables.txt")))
}

/// The formulas of a law, by the name of its material model or equation of state.
pub(in crate::deck) fn law(name: &str) -> Option<&'static Term> {
    static LAWS: OnceLock<Vec<Term>> = OnceLock::new();
    find(LAWS.get_or_init(|| read(include_str!("../../../grammar/laws.txt"))), name)
}

/// The entry with this name, in any case.
pub(in crate::deck) fn find<'a>(terms: &'a [Term], name: &str) -> Option<&'a Term> {
    let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
    terms.iter().find(|term| term.names.iter().any(|known| known.eq_ignore_ascii_case(&name)))
}

/// Entries of a text: `=` names, `>` what else to read, `%` numbers worked through, `#` remarks; other lines are text.
fn read(text: &str) -> Vec<Term> {
    let mut terms: Vec<Term> = Vec::new();
    let list = |rest: &str| rest.split(',').map(|name| name.trim().to_owned()).collect::<Vec<_>>();
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty()) {
        if let Some(names) = line.strip_prefix("= ") {
            terms.push(Term { names: list(names), ..Term::default() });
            continue;
        }
        let Some(term) = terms.last_mut() else { continue };
        if let Some(see) = line.strip_prefix("> ") {
            term.see = list(see);
        } else if let Some(worked) = line.strip_prefix("% ") {
            term.worked.push(worked.to_owned());
        } else {
            // A line goes on with the paragraph before, unless one of the two stays as it is.
            match term.text.last_mut().filter(|last| !last.starts_with("  ") && !line.starts_with("  ")) {
                Some(last) => *last += &format!(" {line}"),
                None => term.text.push(line.to_owned()),
            }
        }
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::language;
    use crate::material::{EQUATIONS_OF_STATE, MATERIALS};

    #[test]
    fn entries_have_names_and_texts_and_lead_somewhere() {
        let known = |name: &str| {
            let commands = [language(), crate::mesher::language()].into_iter().flat_map(|grammar| &grammar.entries);
            commands.flat_map(|entry| entry.spellings()).any(|command| command == name)
                || MATERIALS.iter().any(|entry| entry.name == name)
                || EQUATIONS_OF_STATE.iter().any(|entry| entry.name == name)
                || find(variables(), name).is_some()
                || crate::output::GLOBAL_VARIABLES.iter().any(|(global, _)| *global == name)
        };
        assert!(words().len() >= 20 && variables().len() > 10);
        for term in words().iter().chain(variables()) {
            assert!(!term.text.is_empty() && !term.see.is_empty(), "{:?}", term.names);
            assert!(term.names.iter().all(|name| !name.is_empty() && *name == name.to_uppercase()), "{:?}", term.names);
            for see in &term.see {
                assert!(known(see), "{:?} leads to {see}", term.names);
            }
        }
    }

    #[test]
    fn every_law_has_its_formula() {
        let laws = MATERIALS.iter().map(|entry| entry.name).chain(EQUATIONS_OF_STATE.iter().map(|entry| entry.name));
        for name in laws {
            assert!(law(name).is_some_and(|term| term.text.iter().any(|line| line.starts_with("  "))), "{name}");
        }
    }
}
