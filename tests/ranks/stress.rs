//! Random interleavings of all calls of a communicator, the same for every transport. Every number sent follows from
//! the round and the ranks, so each rank knows what it must receive.

use urto::comm::{Communicator, ExactSum, Peer};

/// A well-mixed number for some numbers.
fn mix(numbers: &[usize]) -> u64 {
    numbers.iter().fold(0x243f_6a88_85a3_08d3, |state, number| {
        let state = (state ^ *number as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        state ^ state >> 29
    })
}

fn pick(numbers: &[usize], choices: usize) -> usize {
    (mix(numbers) >> 8) as usize % choices
}

fn bytes(numbers: &[usize], longest: usize) -> Vec<u8> {
    (0..pick(numbers, longest + 1)).map(|i| mix(numbers) as u8 ^ i as u8).collect()
}

/// `rounds` calls, each chosen by `seed` and its number. Panics at the first wrong answer.
pub fn stress(communicator: &mut dyn Communicator, rounds: usize, seed: usize) {
    for round in (0..rounds).map(|round| round + seed * rounds) {
        match pick(&[round], 8) {
            0 | 1 => exchange(communicator, round),
            2 => minimum(communicator, round),
            3 => sum(communicator, round),
            4 => sparse(communicator, round),
            5 => gather(communicator, round),
            6 => broadcast(communicator, round),
            _ => exact_sum(communicator, round),
        }
    }
    communicator.barrier();
}

/// Several exchanges of one pattern, with other calls while they are under way.
fn exchange(communicator: &mut dyn Communicator, round: usize) {
    let (rank, size) = (communicator.rank(), communicator.size());
    let linked = |a: usize, b: usize| a != b && pick(&[round, a.min(b), a.max(b)], size.min(6)) < 2;
    let length = |from: usize, to: usize| pick(&[round, from, to], 300);
    let number = |from: usize, to: usize, i: usize, time: usize| mix(&[round, from, to, i, time]) as f64;
    let peer = |to: usize| Peer { rank: to, send: vec![0.0; length(rank, to)], receive: vec![0.0; length(to, rank)] };
    let mut peers: Vec<Peer> = (0..size).filter(|other| linked(rank, *other)).map(peer).collect();
    for time in 0..pick(&[round, 1], 5) {
        for peer in &mut peers {
            assert_eq!(peer.send.len(), length(rank, peer.rank));
            (0..).zip(&mut peer.send).for_each(|(i, x)| *x = number(rank, peer.rank, i, time));
        }
        communicator.start_exchange(&mut peers);
        match pick(&[round, time, 2], 4) {
            0 => minimum(communicator, round + time),
            1 => sparse(communicator, round + time),
            _ => (),
        }
        communicator.finish_exchange(&mut peers);
        for peer in &peers {
            assert_eq!(peer.receive.len(), length(peer.rank, rank));
            assert!((0..).zip(&peer.receive).all(|(i, x)| *x == number(peer.rank, rank, i, time)));
        }
    }
}

fn minimum(communicator: &mut dyn Communicator, round: usize) {
    let count = pick(&[round, 1], 4);
    let value = |rank: usize, i: usize| match mix(&[round, rank, i]) {
        x if x % 97 == 0 => f64::NAN,
        x if x % 31 == 0 => f64::NEG_INFINITY,
        x => x as i64 as f64,
    };
    let mut values: Vec<f64> = (0..count).map(|i| value(communicator.rank(), i)).collect();
    communicator.all_min(&mut values);
    for (i, result) in values.iter().enumerate() {
        let all = || (0..communicator.size()).map(|rank| value(rank, i));
        let expected = if all().any(f64::is_nan) { f64::NAN } else { all().fold(f64::INFINITY, f64::min) };
        assert!(*result == expected || result.is_nan() && expected.is_nan(), "{result} for {expected}");
    }
}

fn sum(communicator: &mut dyn Communicator, round: usize) {
    let mut values: Vec<u64> = (0..pick(&[round], 200)).map(|i| mix(&[round, communicator.rank(), i])).collect();
    communicator.all_sum(&mut values);
    let total = |i: usize| (0..communicator.size()).fold(0u64, |sum, rank| sum.wrapping_add(mix(&[round, rank, i])));
    assert!(values.iter().enumerate().all(|(i, sum)| *sum == total(i)));
}

fn exact_sum(communicator: &mut dyn Communicator, round: usize) {
    let number = |rank: usize| mix(&[round, rank]) as i64 as f64 * 2f64.powi(pick(&[rank, round], 100) as i32 - 50);
    let mut mine = ExactSum::new();
    mine.add(number(communicator.rank()));
    ExactSum::merge_ranks(std::slice::from_mut(&mut mine), communicator);
    let mut all = ExactSum::new();
    (0..communicator.size()).rev().for_each(|rank| all.add(number(rank)));
    assert_eq!(mine.value().to_bits(), all.value().to_bits());
}

/// What one rank sends in a sparse exchange: to some ranks, itself perhaps, several messages or empty ones.
fn outgoing(round: usize, from: usize, size: usize) -> Vec<(usize, Vec<u8>)> {
    let message = |i: usize| (pick(&[round, from, i, 1], size), bytes(&[round, from, i], 2000));
    (0..pick(&[round, from], 5)).map(message).collect()
}

fn sparse(communicator: &mut dyn Communicator, round: usize) {
    let (rank, size) = (communicator.rank(), communicator.size());
    let received = communicator.sparse_exchange(outgoing(round, rank, size));
    let to_me = |from: usize| {
        outgoing(round, from, size).into_iter().filter(|(to, _)| *to == rank).map(move |(_, bytes)| (from, bytes))
    };
    let expected: Vec<_> = (0..size).flat_map(to_me).collect();
    assert_eq!(received, expected);
}

fn gather(communicator: &mut dyn Communicator, round: usize) {
    let received = communicator.gather(bytes(&[round, communicator.rank()], 5000));
    let expected = || (0..communicator.size()).map(|rank| bytes(&[round, rank], 5000)).collect();
    assert_eq!(received, (communicator.rank() == 0).then(expected));
}

fn broadcast(communicator: &mut dyn Communicator, round: usize) {
    let mut message = bytes(&[round, communicator.rank()], 5000);
    communicator.broadcast(&mut message);
    assert_eq!(message, bytes(&[round, 0], 5000));
}
