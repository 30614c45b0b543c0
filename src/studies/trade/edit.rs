//! A deck with one command changed.

use crate::deck::Deck;

/// The text of a deck, its expressions evaluated, without the commands of these names and with some lines before all others.
pub fn with_command(deck: &Deck, without: &[&str], lines: &[String]) -> String {
    let text = deck.source.text();
    let mut out: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let mut place = 0;
    let mut gone: Vec<(usize, usize)> = deck
        .cards
        .iter()
        .filter(|card| without.contains(&card.name.as_str()))
        .map(|card| (card.record.start, card.record.end))
        .collect();
    gone.sort_unstable();
    for (start, end) in gone {
        out += text.get(place..start).unwrap_or_default();
        place = place.max(end);
    }
    out + text.get(place..).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{Source, language};

    #[test]
    fn a_command_is_put_in_the_place_of_another() {
        let text = "TITLE\n T\nTERMINATION TIME, {a = 2}\nTIME STEP SCALE, 0.9 $ safe\n\
                    MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\nEXIT\n";
        let (deck, _) = Deck::read(Source::new("t.i", text), language());
        let other = with_command(&deck, &["TIME STEP SCALE"], &["TIME STEP SCALE, 0.5".into()]);
        assert!(
            other.starts_with("TIME STEP SCALE, 0.5\nTITLE\n T\n") && other.contains("TERMINATION TIME, 2"),
            "{other}"
        );
        assert_eq!(other.matches("TIME STEP SCALE").count(), 1, "{other}");
        let (again, found) = Deck::read(Source::new("t.i", other), language());
        assert!(
            found.is_empty() && again.cards.len() == deck.cards.len(),
            "{found:?}, {} of {}",
            again.cards.len(),
            deck.cards.len()
        );
    }
}
