//! The example of `docs/adding-a-material.md`, built as that page says: its file, and its line in a list of laws.

use super::*;

#[path = "../../../docs/examples/drucker_prager.rs"]
mod drucker_prager;

use drucker_prager::DruckerPrager;

/// In a list of its own laws are of another type.
type Entry = super::Entry<Law>;

laws! { drucker_prager::DruckerPrager }

#[test]
fn the_page_shows_what_is_built() {
    let page = include_str!("../../../docs/adding-a-material.md");
    assert!(
        page.contains(include_str!("../../../docs/examples/drucker_prager.rs")),
        "docs/adding-a-material.md is stale"
    );
}

#[test]
fn the_entry_is_all_that_a_deck_needs() {
    let entry = MATERIALS[0];
    let law = (entry.build)(&Given::new(&[30e9, 0.2, 10e6, 1.5], 2400.0)).expect("values in range");
    assert_eq!(law.entry().name, "DRUCKER PRAGER");
    assert_eq!(law.values(), [30e9, 0.2, 10e6, 1.5]);
    assert_eq!(law.moduli(), Moduli::from_young(30e9, 0.2));
    let start = Start { centre: [0.0; 3], length: 1.0, frame: point::IDENTITY };
    assert_eq!(law.state(&law.start(&start), &start.frame), [0.0]);
    assert!(matches!(law, Law::DruckerPrager(DruckerPrager { friction: 1.5, .. })));
}
