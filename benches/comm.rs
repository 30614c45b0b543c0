//! What communication and its companions cost: exact sums, collective calls and exchanges of thread ranks, and the
//! planning of a decomposition. `cargo bench --bench comm`.

use std::hint::black_box;
use std::time::Instant;
use urto::comm::{Communicator, Counted, ExactSum, Peer, run_threads};
use urto::mesh::{Connectivity, Shape};
use urto::partition::{Contributors, Decomposition, rcb, space_filling_order};

fn main() {
    exact_sum();
    for ranks in [1, 2, 8, 64] {
        rank_calls(ranks);
    }
    decomposition(100);
}

/// Seconds per call of `body`, over `count` calls.
fn seconds(count: u32, mut body: impl FnMut()) -> f64 {
    let start = Instant::now();
    (0..count).for_each(|_| body());
    start.elapsed().as_secs_f64() / f64::from(count)
}

fn exact_sum() {
    let alike: Vec<f64> = (0..10_000).map(|i| 1.0 + f64::from(i) * 1e-4).collect();
    let wild: Vec<f64> =
        (0..10_000).map(|i| f64::from(i * 7919 % 10_007 - 5000) * 2f64.powi(i * 31 % 200 - 100)).collect();
    for (name, numbers) in [("alike", alike), ("wild", wild)] {
        let mut sum = ExactSum::new();
        let time = seconds(1000, || black_box(&numbers).iter().for_each(|x| sum.add(*x)));
        println!("exact sum of {name:5} numbers {:10.2} ns per addition", time / numbers.len() as f64 * 1e9);
        println!("exact sum rounded         {:10.2} ns", seconds(10_000, || _ = black_box(sum.value())) * 1e9);
    }
}

fn rank_calls(ranks: usize) {
    let count = if ranks > 2 { 2_000 } else { 200_000 };
    let times = run_threads(ranks, |communicator| {
        let mut values = [1.0, 2.0];
        let minimum = seconds(count, || communicator.all_min(&mut values));
        let halos = [300, 3_000, 30_000].map(|length| halo(communicator, length, count));
        let counted = &mut Counted::new(communicator);
        let counted = [seconds(count, || counted.all_min(&mut values)), halo(counted, 300, count)];
        Ok::<_, ()>((minimum, halos, counted))
    });
    if let Ok(times) = times {
        let (minimum, halos, [counted_minimum, counted_halo]) = times[0];
        println!("{ranks:2} ranks: all_min {:8.2} us, counted {:8.2} us", minimum * 1e6, counted_minimum * 1e6);
        println!("{ranks:2} ranks: exchange of 2.4 kB counted {:8.2} us", counted_halo * 1e6);
        let [small, medium, large] = halos.map(|time| time * 1e6);
        println!(
            "{ranks:2} ranks: exchange with 2 neighbours, 2.4 kB {small:8.2} us, 24 kB {medium:8.2} us, 240 kB {large:8.2} us"
        );
    }
}

/// Seconds per exchange of `length` numbers with each neighbour in a ring.
fn halo(communicator: &mut dyn Communicator, length: usize, count: u32) -> f64 {
    let (rank, size) = (communicator.rank(), communicator.size());
    let peer = |rank| Peer { rank, send: vec![1.0; length], receive: vec![0.0; length] };
    let mut ring = vec![(rank + 1) % size, (rank + size - 1) % size];
    ring.dedup();
    let mut peers: Vec<Peer> = ring.into_iter().filter(|other| *other != rank).map(peer).collect();
    seconds(count, || {
        communicator.start_exchange(&mut peers);
        communicator.finish_exchange(&mut peers);
    })
}

/// Curve, bisection and plan of a cube of `n`³ elements for 64 ranks.
fn decomposition(n: usize) {
    let cell = |e: usize| [e % n, e / n % n, e / n / n];
    let node = |i: usize, j: usize, k: usize| (i + (n + 1) * (j + (n + 1) * k)) as u32;
    let centroids: Vec<[f64; 3]> = (0..n * n * n).map(|e| cell(e).map(|i| i as f64)).collect();
    let corners = |e: usize| {
        let [i, j, k] = cell(e);
        [0, 1, 2, 3, 4, 5, 6, 7].map(|c| node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)))
    };
    let mut order = Vec::new();
    let curve = seconds(1, || order = space_filling_order(&centroids));
    let centroids: Vec<[f64; 3]> = order.iter().map(|e| centroids[*e as usize]).collect();
    let nodes: Vec<u32> = order.iter().flat_map(|e| corners(*e as usize)).collect();
    let mut ranks = Vec::new();
    let bisection = seconds(1, || ranks = rcb(&centroids, &vec![1.0; centroids.len()], 64));
    let nodes = Connectivity::of(Shape::Hexahedron, nodes);
    let groups = [Contributors { nodes: &nodes, ranks: &ranks }];
    let start = Instant::now();
    let plan = Decomposition::new(&groups, (n + 1).pow(3), 64);
    let planned = start.elapsed().as_secs_f64();
    let share = seconds(64, || drop(black_box(plan.share(7))));
    let ns = 1e9 / (n * n * n) as f64;
    println!(
        "{n}³ elements: curve {:.0}, bisection into 64 {:.0}, plan {:.0} ns per element",
        curve * ns,
        bisection * ns,
        planned * ns
    );
    println!("one of 64 shares {:.2} ms", share * 1e3);
}
