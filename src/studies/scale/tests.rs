use super::*;
use crate::comm::Peer;
use crate::deck::Source;
use crate::mesher;
use crate::model::examine;

/// A bar of 24 x 2 x 3 cubes that flies.
fn bar(ranks: usize, steps: u64) -> Case {
    let recipe = "TITLE\n BAR\nBOX, 1, 0., 0., 0., 24., 2., 3., 24, 2, 3\n";
    let mesh = mesher::make(recipe, "bar.mesh", 1).unwrap();
    let deck = "TITLE\n BAR\nTERMINATION TIME, 1.\nMATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\n\
                POISSONS RATIO = 0.\nEND\nINITIAL VELOCITY MATERIAL, 1, 1., 0., 0.\nEXIT\n";
    let problem = examine(Source::new("bar.i", deck), Some(&mesh)).unwrap();
    let body = Body::new(&mesh, &problem.model).expect("materials");
    count(&mesh, &problem.model, &body, ranks, 1, steps).unwrap()
}

/// Slices across the bar share a cross-section with each neighbour: 6 elements on either side, whose 4 corners there
/// each send a force of 3 numbers of 8 bytes.
#[test]
fn slices_of_a_bar_talk_to_their_neighbours() {
    for ranks in [2, 4, 8] {
        let case = bar(ranks, 5);
        let section = 6 * 4 * 3 * 8;
        let mut ends = 0;
        for rank in &case.work {
            let elements = rank.counts.of(Traffic::Elements);
            assert_eq!(rank.elements, 144 / ranks as u64);
            assert_eq!(elements.sent.bytes, elements.sent.messages * section);
            assert_eq!(elements.received, elements.sent);
            ends += u64::from(elements.sent.messages == 5);
            assert!([5, 10].contains(&elements.sent.messages), "one or two neighbours in each of 5 steps");
            // The step itself, a request and a failure: three numbers in every round.
            let step = rank.counts.of(Traffic::Step);
            assert_eq!(step.collectives, 5);
            assert_eq!(step.collective_bytes, 5 * 3 * 8 * u64::from(crate::comm::rounds(ranks)));
            assert_eq!(rank.of_contact(), Count::default());
        }
        assert_eq!(ends, 2);
    }
}

#[test]
fn one_rank_says_nothing() {
    let case = bar(1, 2);
    assert_eq!(case.work[0].of_steps(), Count::default());
    assert_eq!(case.work[0].elements, 144);
}

/// The counts of `messages` messages of `numbers` numbers, sent and received, on each of two ranks.
fn counted(part: Traffic, messages: usize, numbers: usize, ranks_of_node: usize) -> Vec<Counts> {
    run_threads(2, |inner| {
        let comm = &mut Counted::on_nodes(inner, ranks_of_node);
        comm.enter(part);
        let peer = Peer { rank: 1 - comm.rank(), send: vec![0.0; numbers], receive: vec![0.0; numbers] };
        let mut peers = [peer];
        for _ in 0..messages {
            comm.start_exchange(&mut peers);
            comm.finish_exchange(&mut peers);
        }
        comm.enter(Traffic::Step);
        comm.all_min(&mut [0.0; 2]);
        Ok::<_, ()>(comm.counts())
    })
    .unwrap()
}

/// A machine on which everything costs a different power of ten.
const MACHINE: Machine = Machine {
    name: "test",
    element: 1.0,
    contact_point: 100.0,
    candidate: 1e4,
    correction: 1e6,
    latency: 0.01,
    bandwidth: 1e4,
    ranks_of_node: 2,
    node_bandwidth: 1e5,
};

#[test]
fn a_step_costs_what_the_slowest_rank_needs_in_each_part() {
    let counts = counted(Traffic::ContactPasses, 3, 125, 1);
    let rank = |elements, contact_points, counts| RankWork {
        elements,
        contact_points,
        candidates: 2 * contact_points,
        corrections: contact_points,
        counts,
    };
    // Summed over two steps: contact of the second rank 4 points, 8 pairs and 4 corrections.
    let case = Case { steps: 2, work: vec![rank(7, 2, counts[0]), rank(5, 4, counts[1])] };
    let price = MACHINE.price(&case);
    assert_eq!(price.elements, 7.0);
    // One call in two steps, one round, two numbers in it.
    assert!((price.agreement - (0.01 + 16e-4) / 2.0).abs() < 1e-12);
    let contact = (400.0 + 8e4 + 4e6) / 2.0;
    // Three messages of 1000 bytes in two steps.
    assert!((price.contact - contact - (0.03 + 0.3) / 2.0).abs() < 1e-6);
    assert_eq!(price.computing, 7.0 + contact);
    // Within a node they go ten times as fast.
    let near = counted(Traffic::ContactPasses, 3, 125, 2)[0].of(Traffic::ContactPasses);
    assert!((MACHINE.messages(near, 2) - 0.03 - 0.03).abs() < 1e-12);
}

#[test]
fn efficiency_is_relative_to_the_first_row() {
    let alone = |elements| RankWork { elements, ..RankWork::default() };
    let case = |work: &[u64]| Case { steps: 1, work: work.iter().map(|elements| alone(*elements)).collect() };
    // The same 12 elements evenly on two ranks, then unevenly on three; then a problem three times as large on three.
    let rows = rows(&[case(&[12]), case(&[6, 6]), case(&[3, 3, 6]), case(&[12, 12, 12])], &MACHINE);
    let found: Vec<_> = rows.iter().map(|row| (row.speed_up(), row.efficiency)).collect();
    assert_eq!(found, [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0 / 3.0), (3.0, 1.0)]);
    let lines = csv(&rows);
    let names = lines.lines().next().unwrap().split(',').count();
    assert!(lines.lines().count() == 5 && lines.lines().all(|line| line.split(',').count() == names));
    assert!(text(&rows, &MACHINE).lines().last().unwrap().ends_with("3.00   1.000"));
}

#[test]
fn contact_costs_as_much_slower_as_elements() {
    let slow = Machine::CLUSTER.with_element(80e-8);
    assert!((slow.candidate / Machine::CLUSTER.candidate - 10.0).abs() < 1e-12);
    assert_eq!((slow.latency, slow.bandwidth), (Machine::CLUSTER.latency, Machine::CLUSTER.bandwidth));
}
