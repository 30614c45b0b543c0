//! Thread ranks under stress, and failing ranks, which must not leave others waiting.

use crate::stress::stress;
use std::sync::mpsc;
use std::time::Duration;
use urto::comm::{Communicator, Peer, RankFailure, Traffic, run_threads};
use urto::deck::Source;
use urto::partition::Decomposition;
use urto::solver::{Body, Request, Solver};

/// Runs `body` on ranks, but fails if they have not ended within a minute: a defect here is a hang.
fn run<T, E>(
    ranks: usize,
    body: impl Fn(&mut dyn Communicator) -> Result<T, E> + Send + Sync + 'static,
) -> Result<Vec<T>, RankFailure<E>>
where
    T: Send + 'static,
    E: Send + 'static,
{
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || sender.send(run_threads(ranks, body)));
    receiver.recv_timeout(Duration::from_secs(60)).expect("ranks hang")
}

#[test]
fn every_call_answers_right_on_any_number_of_ranks() {
    for ranks in [1, 2, 3, 5, 8, 64] {
        let rounds = if ranks == 64 { 60 } else { 300 };
        run(ranks, move |communicator| {
            stress(communicator, rounds, ranks);
            Ok::<_, ()>(())
        })
        .expect("stress");
    }
}

#[test]
fn a_steady_exchange_stays_right_over_many_steps() {
    let sums = run(4, |communicator| {
        let (rank, size) = (communicator.rank(), communicator.size());
        let peer = |rank| urto::comm::Peer { rank, send: vec![0.0; 100], receive: vec![0.0; 100] };
        let mut peers: Vec<_> = (0..size).filter(|other| *other != rank).map(peer).collect();
        let mut value = rank as f64;
        for _ in 0..2000 {
            peers.iter_mut().for_each(|peer| peer.send.fill(value));
            communicator.start_exchange(&mut peers);
            communicator.finish_exchange(&mut peers);
            value = (value + peers.iter().map(|peer| peer.receive[99]).sum::<f64>()) % 1000.0;
        }
        Ok::<_, ()>(value)
    });
    let sums = sums.expect("exchange");
    assert!(sums.iter().all(|sum| *sum == sums[0]));
}

#[test]
fn no_rank_waits_for_one_that_panicked() {
    for (ranks, call) in [2, 3, 8, 64].into_iter().flat_map(|ranks| (0..6).map(move |call| (ranks, call))) {
        let failed = run(ranks, move |communicator| {
            stress(communicator, 5, 1);
            if communicator.rank() == ranks - 1 {
                // Silent: the payload alone, without the hook that prints.
                std::panic::resume_unwind(Box::new("broken"));
            }
            let peer = |rank| urto::comm::Peer { rank, send: vec![1.0], receive: vec![0.0] };
            match call {
                0 => communicator.barrier(),
                1 => communicator.all_min(&mut [1.0]),
                2 => drop(communicator.sparse_exchange(vec![(0, vec![1])])),
                3 => drop(communicator.gather(vec![])),
                4 => communicator.broadcast(&mut vec![]),
                _ => {
                    let size = communicator.size();
                    // A ring: only one rank waits for the failed one, the others for those that wait.
                    let mut peers = vec![peer((communicator.rank() + size - 1) % size)];
                    if size > 2 {
                        peers.push(peer((communicator.rank() + 1) % size));
                    }
                    communicator.start_exchange(&mut peers);
                    communicator.finish_exchange(&mut peers);
                }
            }
            communicator.barrier();
            Ok::<_, ()>(())
        });
        match failed {
            Err(RankFailure::Panicked { rank, message }) => assert_eq!((rank, &message[..]), (ranks - 1, "broken")),
            other => panic!("{ranks} ranks, call {call}: {other:?}"),
        }
    }
}

/// Breaks at a call of one part of a run; all else it passes on.
struct Breaking<'a> {
    inner: &'a mut dyn Communicator,
    part: Traffic,
    now: Traffic,
    /// Calls of the part that still go through; `None` on ranks that do not break.
    left: Option<u32>,
}

impl Breaking<'_> {
    fn call(&mut self) -> &mut dyn Communicator {
        if let Some(left) = self.left.as_mut().filter(|_| self.now == self.part) {
            if *left == 0 {
                // Silent: the payload alone, without the hook that prints.
                std::panic::resume_unwind(Box::new("broken"));
            }
            *left -= 1;
        }
        &mut *self.inner
    }
}

impl Communicator for Breaking<'_> {
    fn rank(&self) -> usize {
        self.inner.rank()
    }

    fn size(&self) -> usize {
        self.inner.size()
    }

    fn enter(&mut self, part: Traffic) {
        self.now = part;
    }

    fn start_exchange(&mut self, peers: &mut [Peer]) {
        self.call().start_exchange(peers);
    }

    fn finish_exchange(&mut self, peers: &mut [Peer]) {
        self.call().finish_exchange(peers);
    }

    fn all_min(&mut self, values: &mut [f64]) {
        self.call().all_min(values);
    }

    fn all_sum(&mut self, values: &mut [u64]) {
        self.call().all_sum(values);
    }

    fn sparse_exchange(&mut self, outgoing: Vec<(usize, Vec<u8>)>) -> Vec<(usize, Vec<u8>)> {
        self.call().sparse_exchange(outgoing)
    }

    fn gather(&mut self, bytes: Vec<u8>) -> Option<Vec<Vec<u8>>> {
        self.call().gather(bytes)
    }

    fn broadcast(&mut self, bytes: &mut Vec<u8>) {
        self.call().broadcast(bytes);
    }

    fn barrier(&mut self) {
        self.call().barrier();
    }
}

/// Two bars that touch from the first step on, on four ranks, the third of which panics in a call of `part` after so many
/// others; whether it did, or the steps came to their end.
fn breaks(part: Traffic, after: u32) -> bool {
    const BROKEN: usize = 2;
    let project = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = |name: &str| std::fs::read_to_string(project.join(name)).expect(name);
    let recipe = text("meshes/two_bars.mesh");
    let mesh = urto::mesher::make(&recipe, "two_bars.mesh", 1).unwrap_or_else(|m| panic!("{}", m.render(false)));
    let deck = text("decks/two_bars.i").replace("EXIT", "CONTACT SEARCH, GRID, 2., 0.\nEXIT");
    let problem = urto::model::examine(Source::new("two_bars.i", &deck), Some(&mesh));
    let model = problem.unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false))).model;
    let ended = run(4, move |inner| {
        let body = Body::new(&mesh, &model).expect("materials");
        let cut = body.cut(inner.size());
        let contributors = body.contributors(&cut);
        let decomposition = Decomposition::new(&contributors, mesh.coordinates.len(), inner.size());
        let left = (inner.rank() == BROKEN).then_some(after);
        let comm = &mut Breaking { inner, part, now: Traffic::Setup, left };
        let mut solver = Solver::new(&mesh, &model, &body, &decomposition.share(comm.rank()), comm);
        for _ in 0..12 {
            solver.prepare(Request::Continue, comm)?;
            solver.advance();
        }
        Ok::<_, urto::solver::Stop>(())
    });
    match ended {
        Ok(_) => false,
        Err(RankFailure::Panicked { rank, message }) => {
            assert_eq!((rank, &message[..]), (BROKEN, "broken"));
            true
        }
        Err(other) => panic!("{part:?}, {after} calls: {other}"),
    }
}

/// Wherever a rank breaks in a search, in a pass or on the way there and back, the others end too, for its reason.
#[test]
fn a_rank_that_breaks_within_contact_brings_all_down() {
    for part in [Traffic::ContactSearch, Traffic::ContactMotion, Traffic::ContactPasses] {
        // The first calls one by one: every kind of message of a search and of a pass is among them.
        for after in (0..30).chain([60, 90]) {
            let done = breaks(part, after);
            assert!(done || after >= 30, "{part:?} has fewer than {after} calls");
        }
        assert!(!breaks(part, u32::MAX), "{part:?}");
    }
}

#[test]
fn what_a_rank_sent_before_it_ended_arrives() {
    let received = run(2, |communicator| {
        let other = 1 - communicator.rank();
        let mut peers = [urto::comm::Peer { rank: other, send: vec![7.0], receive: vec![0.0] }];
        communicator.start_exchange(&mut peers);
        if communicator.rank() == 1 {
            std::thread::sleep(Duration::from_millis(20));
        }
        communicator.finish_exchange(&mut peers);
        Ok::<_, ()>(peers[0].receive[0])
    });
    assert_eq!(received.expect("exchange"), [7.0, 7.0]);
}
