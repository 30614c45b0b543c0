//! What ranks are made of, for as long as they are being made.

use crate::partition::Share;
use crate::solver::Body;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// What one rank is made of.
type Part = (Arc<Body>, Share);

/// The body and the shares of some ranks. Each rank takes its own; when all have let go of the body, its memory is free.
pub struct Parts {
    first: usize,
    left: Mutex<Vec<Option<Part>>>,
}

impl Parts {
    /// Cuts a body for so many ranks, of which those in `here` are ranks of this process.
    pub fn new(body: Body, ranks: usize, here: Range<usize>) -> Parts {
        let first = here.start;
        let shares: Vec<Share> = {
            let cut = body.cut(ranks);
            let contributors = body.contributors(&cut);
            let decomposition = body.decomposition(&contributors, ranks);
            here.map(|rank| decomposition.share(rank).with_border_alone()).collect()
        };
        let body = Arc::new(body);
        Parts { first, left: Mutex::new(shares.into_iter().map(|share| Some((body.clone(), share))).collect()) }
    }

    /// What a rank of this process is made of; each takes it once.
    pub(super) fn take(&self, rank: usize) -> Part {
        let mut left = self.left.lock().unwrap_or_else(PoisonError::into_inner);
        left[rank - self.first].take().expect("a rank is made once")
    }
}
