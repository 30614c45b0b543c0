//! What sharing out moving points costs: time and collective calls of a dynamic bisection, from nothing and after a
//! small motion, with other numbers of ranks. `cargo bench --bench rcb`.

use std::time::Instant;
use urto::comm::{Communicator, run_threads};
use urto::partition::dynamic::{Axes, Balanced, Bisection, Earlier, balance};

/// Points in all.
const COUNT: u32 = 100_000;

fn main() {
    for (name, place) in [("scattered", scattered as fn(u32) -> [f64; 3]), ("in a lattice", lattice)] {
        for ranks in [1, 2, 16, 64] {
            bisections(name, place, ranks);
        }
    }
}

/// Fractions of a sequence that fills the unit cube evenly (R3, by powers of the root of x⁴ = x + 1).
fn scattered(i: u32) -> [f64; 3] {
    [0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3].map(|a| (a * f64::from(i)).fract())
}

/// Nodes of a brick of 100 × 50 × 20.
fn lattice(i: u32) -> [f64; 3] {
    [i % 100, i / 100 % 50, i / 5000].map(|k| f64::from(k) * 0.01)
}

/// A turn about z and a stretch that make neighbours change their order, as a step does, and a flight.
fn moved(at: [f64; 3], amount: f64) -> [f64; 3] {
    let [x, y, z] = at;
    [x + amount * (1.0 - y), y + amount * x, z + amount * (z + 3.0)]
}

fn bisections(name: &str, place: fn(u32) -> [f64; 3], ranks: usize) {
    let outcome = run_threads(ranks, |comm| {
        let ids: Vec<u32> = (0..COUNT).filter(|i| *i as usize * ranks / COUNT as usize == comm.rank()).collect();
        let mut report = Vec::new();
        let mut cuts: Option<Bisection> = None;
        for amount in [0.0, 0.0, 1e-6, 1e-4, 1e-2] {
            let points: Vec<_> = ids.iter().map(|i| moved(place(*i), amount)).collect();
            let (balanced, time) = timed(&points, &ids, cuts.as_ref(), comm);
            report.push(format!("{:.2} ms {} calls", time * 1e3, balanced.collectives));
            cuts = Some(balanced.bisection);
        }
        Ok::<_, ()>(report)
    });
    if let Ok(reports) = outcome {
        let [fresh, same, motions @ ..] = &reports[0][..] else { return };
        println!("{name:12} {ranks:2} ranks: fresh {fresh}, again {same}, moved {}", motions.join(", "));
    }
}

/// The least time of a few.
fn timed(points: &[[f64; 3]], ids: &[u32], cuts: Option<&Bisection>, comm: &mut dyn Communicator) -> (Balanced, f64) {
    let earlier = cuts.map(|cuts| Earlier { cuts, slack: 0.0 });
    let mut once = || {
        comm.barrier();
        let start = Instant::now();
        let balanced = balance(points, ids, &[], Axes::Widest, earlier, comm);
        (balanced, start.elapsed().as_secs_f64())
    };
    let first = once();
    (0..4).map(|_| once()).fold(first, |best, other| if other.1 < best.1 { other } else { best })
}
