//! Bodies that fly while they touch or do not: neither what comes out nor what contact has to look at depends on who looks on.

use crate::support::between;
use crate::support::bodies::{mean_velocity, minus, nodes_of, velocities};
use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
use urto::mesh::Mesh;

/// A deck of steel blocks with these velocities.
fn deck(blocks: &[[f64; 3]], end: f64) -> String {
    let of = |(number, [x, y, z]): (usize, &[f64; 3])| {
        format!(
            "INITIAL VELOCITY MATERIAL, {number}, {x}, {y}, {z}\nMATERIAL, {number}, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\n\
             POISSONS RATIO = 0.3\nEND\n"
        )
    };
    let blocks: String = (1..).zip(blocks).map(of).collect();
    format!(
        "TITLE\n flying\nTERMINATION TIME, {end}\nOUTPUT TIME, {end}\nPLOT TIME, {end}\nPLOT NODAL, VELOCITY, MASS\nCONTACT MATERIAL\n{blocks}EXIT\n"
    )
}

/// A cube of 6 x 6 x 6 elements of 1 mm, and one in its way, none of whose nodes comes exactly onto the border of a face: there rounding
/// decides which face holds it.
fn cubes() -> Mesh {
    recipe(
        "TITLE\n cubes\nBOX, 1, 0., 0., 0., 0.006, 0.006, 0.006, 6, 6, 6\n\
         BOX, 2, 0.00605, 0.00113, 0.00047, 0.006, 0.006, 0.006, 5, 5, 5\n",
    )
}

/// A cube alone: at rest no node is a candidate of any face of it, and one search holds to the end, 120 steps. When it flies, boxes of a
/// step hold the way of that step: 0.1 of an element at 1000 m/s, which is within the room, and 0.4 at 4000 m/s, where nodes meet
/// faces beside their own. There it had all nodes and faces along 150 such ways for candidates, most pairs of the surface.
#[test]
fn a_cube_that_flies_searches_no_more_than_at_rest() {
    let mesh = recipe("TITLE\n cube\nBOX, 1, 0., 0., 0., 0.008, 0.008, 0.008, 8, 8, 8\n");
    let flown = |v: [f64; 3]| run(&deck(&[v], 12e-6), &mesh);
    let rest = flown([0.0; 3]);
    assert_eq!((rest.searches, rest.pairs), (1, 0));
    for v in [[1000.0, 0.0, 0.0], [-600.0, 500.0, 700.0]] {
        let flying = flown(v);
        assert!(flying.last().step > 50);
        assert_eq!((flying.searches, flying.pairs), (1, 0), "{v:?}");
    }
    let fast = flown([4000.0, 0.0, 0.0]);
    // Of 386 nodes and 384 faces each node may meet the faces of the nodes beside it along the way.
    println!("4000 m/s: {} pairs, {} searches in {} steps", fast.pairs, fast.searches, fast.last().step);
    assert!(fast.searches == 1 && fast.pairs < 386 * 4, "{} {}", fast.searches, fast.pairs);
}

/// Two cubes far from each other have as many candidates when one flies and the other rests as when each flies at half of the speed the
/// other way: the boxes of a search are seen from between them.
#[test]
fn a_cube_that_flies_and_one_that_rests_share_the_way() {
    let mesh = recipe(
        "TITLE\n cubes\nBOX, 1, 0., 0., 0., 0.004, 0.004, 0.004, 8, 8, 8\n\
         BOX, 2, 0.03, 0.00013, 0.00013, 0.004, 0.004, 0.004, 8, 8, 8\n",
    );
    let flown = |one: f64, other: f64| run(&deck(&[[one, 0.0, 0.0], [other, 0.0, 0.0]], 6e-6), &mesh);
    let both = flown(500.0, -500.0);
    for half in [flown(1000.0, 0.0), flown(0.0, -1000.0)] {
        assert!(both.pairs > 0 && half.last().step == both.last().step && half.searches == both.searches);
        let part = half.pairs as f64 / both.pairs as f64;
        between("one cube flies", "candidates over those where both do", part, 0.99, 1.01);
    }
}

fn collision(v: [f64; 3]) -> (String, Mesh) {
    (deck(&[[v[0] + 100.0, v[1], v[2]], v], 8e-6), cubes())
}

/// Two cubes that collide while both fly move, seen from between them, as if they did not: to what rounding of velocities a
/// hundred times as high takes away over a hundred steps, 1e-9 of that between them.
#[test]
fn a_collision_is_the_same_for_who_flies_along() {
    let of = |v: [f64; 3]| -> Run {
        let (deck, mesh) = collision(v);
        run(&deck, &mesh)
    };
    let rest = of([0.0; 3]);
    let pushed = mean_velocity(rest.end(), &nodes_of(&cubes(), 2))[0];
    assert!(pushed > 20.0, "they collide: {pushed}");
    for v in [[4000.0, 0.0, 0.0], [-2000.0, 3000.0, 1000.0]] {
        let flying = of(v);
        assert_eq!(flying.last().step, rest.last().step);
        let pairs = velocities(flying.end()).into_iter().zip(velocities(rest.end()));
        let off = pairs.fold(0.0f64, |most, (flying, rest)| {
            minus(minus(flying, v), rest).iter().fold(most, |most, off| most.max(off.abs()))
        });
        between(&format!("flying at {v:?}"), "largest difference of velocities, of 100", off, 0.0, 1e-7);
        println!(
            "at rest {} pairs, {} searches; flying {}, {}",
            rest.pairs, rest.searches, flying.pairs, flying.searches
        );
    }
}

/// All ranks carry their search boxes along alike, so that nothing is lost between them.
#[test]
fn a_collision_in_flight_is_the_same_on_any_number_of_ranks() {
    let (deck, mesh) = collision([3000.0, -1000.0, 500.0]);
    let one = run(&deck, &mesh);
    let bits = |run: &Run| -> Vec<[u64; 3]> { velocities(run.end()).iter().map(|v| v.map(f64::to_bits)).collect() };
    for ranks in [2, 3] {
        let several = run_on(ranks, &deck, &mesh);
        assert!(bits(&several) == bits(&one), "{ranks} ranks");
        assert_eq!(several.searches, one.searches, "{ranks} ranks");
    }
}
