//! Thread ranks under stress, and failing ranks, which must not leave others waiting.

mod stress;

use std::sync::mpsc;
use std::time::Duration;
use stress::stress;
use urto::comm::{Communicator, RankFailure, run_threads};

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
