//! Overlaps of the mesh that contact does not see, as evidence.

use crate::solver::contact::unheld::Told;
use crate::solver::health::finding::{Evidence, Spot};

/// What is told as evidence: its share is the number of pairs of blocks, and it is of the second of those at the worst place.
pub fn evidence(told: &Told) -> Evidence {
    let Told { count, pairs, blocks: [block, other], deepest, nodes: [a, b], element, at } = *told;
    let spot = |node: i64| Some(Spot { node: Some(node), element: Some(element), at });
    let spots = [spot(a), spot(b), None];
    Evidence { share: pairs as f64, amount: deepest, count, of: other as f64, block, spots }
}

/// The way back.
pub fn told(evidence: &Evidence) -> Told {
    let Evidence { share, amount, count, of, block, spots } = *evidence;
    let [a, b] = [0, 1].map(|i| spots[i].unwrap_or_default());
    Told {
        count,
        pairs: share as u64,
        blocks: [block, of as i64],
        deepest: amount,
        nodes: [a, b].map(|spot| spot.node.unwrap_or_default()),
        element: a.element.unwrap_or_default(),
        at: a.at,
    }
}
