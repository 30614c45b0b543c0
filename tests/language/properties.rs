//! Properties of materials and equations of state that a deck forgets or misspells: no block may be without the law that the deck names.

use crate::fixtures::{problem, two_blocks};
use urto::{
    deck::Source,
    material::{self, MATERIALS, Property, Range},
    model::examine,
};

/// A value that a property takes.
fn some_value(range: Range) -> f64 {
    let likely = [1.0, 0.3, 0.5 * (low(range) + high(range))];
    likely.into_iter().find(|&value| range.contains(value)).expect("a value in the range")
}

fn low(range: Range) -> f64 {
    if let Range::Between { low, .. } = range { low.0 } else { 0.0 }
}

fn high(range: Range) -> f64 {
    if let Range::Between { high, .. } = range { high.0 } else { 2.0 }
}

/// A group of a block with lines for all these properties but one, which may stand there misspelt.
fn group(head: &str, properties: &[Property], left_out: Option<&str>, instead: &str) -> String {
    let line = |p: &Property| match left_out {
        Some(keyword) if keyword == p.keyword => instead.to_string(),
        _ => format!("{} = {}\n", p.keyword, some_value(p.range)),
    };
    format!("{head}\n{}END\n", properties.iter().map(line).collect::<String>())
}

/// A deck with a sound material for block 2, so that block 1 could take it.
pub fn with_a_neighbour(groups: &str) -> String {
    format!(
        "TERMINATION TIME 1\nFUNCTION 1\n0 0\n1 1\nEND\n{groups}\
         MATERIAL 2 ELASTIC 1\nYOUNGS MODULUS 1\nPOISSONS RATIO 0\nEND\n"
    )
}

/// The groups of block 1 for every law and every equation of state: what goes before, its head, its properties, what
/// goes after.
fn groups_of_all_laws() -> Vec<(String, String, &'static [Property])> {
    let gas = "EQUATION OF STATE 1 IDEAL GAS\nGAMMA 1.4\nINITIAL ENERGY 1\nEND\n";
    let laws = MATERIALS.iter().map(|law| {
        let before = if law.name.contains("HYDRO") { gas } else { "" };
        (before.to_string(), format!("MATERIAL 1, {}, 1.", law.name), law.properties)
    });
    let fluid = MATERIALS.iter().find(|law| law.name == "HYDRODYNAMIC").expect("the law of fluids").properties;
    let equations = material::EQUATIONS_OF_STATE.iter().map(move |equation| {
        let before = group("MATERIAL 1 HYDRODYNAMIC 1.", fluid, None, "");
        (before, format!("EQUATION OF STATE 1, {}", equation.name), equation.properties)
    });
    laws.chain(equations).collect()
}

/// Errors of a deck that must have some; what it would compute, if it has none.
fn errors_of(text: &str) -> Vec<String> {
    match examine(Source::new("t.i", text), Some(&two_blocks())) {
        Ok(problem) => panic!("taken:\n{text}\n{:?}", problem.model.materials),
        Err(messages) => messages.errors().map(|d| d.message.clone()).collect(),
    }
}

#[test]
fn every_forgotten_property_is_named_and_no_block_gets_another_law() {
    let mut tried = 0;
    for (before, head, properties) in groups_of_all_laws() {
        for property in properties.iter().filter(|p| p.default.is_none()) {
            let deck = with_a_neighbour(&format!("{before}{}", group(&head, properties, Some(property.keyword), "")));
            let errors = errors_of(&deck);
            let said = errors.iter().any(|e| e.ends_with(&format!("{} is missing", property.keyword)));
            assert!(said, "{}: {errors:?}\n{deck}", property.keyword);
            tried += 1;
        }
        // All of them forgotten.
        let required: Vec<&str> = properties.iter().filter(|p| p.default.is_none()).map(|p| p.keyword).collect();
        if !required.is_empty() {
            let deck = with_a_neighbour(&format!("{before}{head}\nEND\n"));
            let errors = errors_of(&deck);
            assert!(errors.iter().any(|e| required.iter().all(|keyword| e.contains(keyword))), "{errors:?}\n{deck}");
        }
    }
    assert!(tried > 60, "{tried} lines of all laws");
}

#[test]
fn every_misspelt_property_is_an_error() {
    for (before, head, properties) in groups_of_all_laws() {
        for property in properties {
            let keyword = property.keyword;
            let value = some_value(property.range);
            // A letter too much, no value, a word for a value, another line's keyword.
            let mut lines = vec![format!("{keyword}QQQ {value}\n"), format!("{keyword} ROUGHLY\n")];
            if property.default.is_none() {
                lines.push(format!("{keyword}\n"));
            }
            lines
                .extend(properties.iter().filter(|p| p.keyword != keyword).map(|p| format!("{} {value}\n", p.keyword)));
            for line in lines {
                errors_of(&with_a_neighbour(&format!("{before}{}", group(&head, properties, Some(keyword), &line))));
            }
        }
    }
}

#[test]
fn a_body_without_a_law_for_every_block_is_refused() {
    let (mesh, mut model) = (two_blocks(), problem(&with_a_neighbour("")).model);
    let missing = urto::solver::Body::new(&mesh, &model).err().map(|e| e.to_string());
    assert_eq!(missing.as_deref(), Some("element block 1 has no MATERIAL"));
    model.materials.clear();
    assert!(urto::solver::Body::new(&mesh, &model).is_err());
}
