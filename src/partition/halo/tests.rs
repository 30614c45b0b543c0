//! Cut boxes against sums without ranks.

use super::*;
use crate::mesh::Shape;
use crate::partition::rcb;
use proptest::prelude::*;

/// Elements of `n[0]` × `n[1]` × `n[2]` cells and their centroids.
fn box_of_hexes(n: [usize; 3]) -> (Connectivity, Vec<[f64; 3]>) {
    let node = |i: usize, j: usize, k: usize| (i + (n[0] + 1) * (j + (n[1] + 1) * k)) as u32;
    let (mut nodes, mut centroids) = (Vec::new(), Vec::new());
    for (i, j, k) in (0..n[2]).flat_map(|k| (0..n[1]).flat_map(move |j| (0..n[0]).map(move |i| (i, j, k)))) {
        for (a, b, c) in [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)] {
            nodes.push(node(i + a, j + b, k + c));
        }
        centroids.push([i as f64, j as f64, k as f64]);
    }
    (Connectivity::of(Shape::Hexahedron, nodes), centroids)
}

/// A number per contributor and corner whose sums depend much on their order.
fn contribution(group: usize, member: u32, corner: usize) -> [f64; 2] {
    let seed = (group as u64) << 40 | u64::from(member) << 8 | corner as u64;
    let mixed = (seed + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (seed + 7).wrapping_mul(0xd1b5_4a32_d192_ed03) >> 17;
    let x = (mixed >> 11) as f64 / 2f64.powi(52) - 1.0;
    [x * 2f64.powi((mixed % 40) as i32), -x]
}

fn serial_sums(groups: &[Contributors], node_count: usize) -> Vec<[f64; 2]> {
    let mut sums = vec![[0.0; 2]; node_count];
    for (g, group) in groups.iter().enumerate() {
        for (member, (_, nodes)) in (0..).zip(group.iter()) {
            for (corner, node) in nodes.iter().enumerate() {
                let value = contribution(g, member, corner);
                (0..2).for_each(|i| sums[*node as usize][i] += value[i]);
            }
        }
    }
    sums
}

/// All slots of a share.
fn slots(share: &Share) -> Vec<[f64; 2]> {
    let group = |(g, group): (usize, &LocalGroup)| {
        let members = group.members.iter().zip(group.nodes.iter());
        let of_member = move |(&member, nodes): (&u32, &[u32])| {
            (0..nodes.len()).map(move |corner| contribution(g, member, corner)).collect::<Vec<_>>()
        };
        members.flat_map(of_member).collect::<Vec<_>>()
    };
    share.groups.iter().enumerate().flat_map(group).collect()
}

/// Those of elements at the border and of all later groups.
fn of_border(share: &Share, slots: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let elements = &share.groups[0];
    let at_border = elements.nodes.iter().zip(&elements.border).flat_map(|(nodes, border)| vec![*border; nodes.len()]);
    let later = std::iter::repeat(true);
    slots.iter().zip(at_border.chain(later)).filter(|(_, kept)| *kept).map(|(slot, _)| *slot).collect()
}

/// Scatter-adds in local order, as a solver does, then replaces the sums of shared nodes.
fn local_sums(share: &Share, slots: &[[f64; 2]], peers: &[Peer]) -> Vec<[f64; 2]> {
    let mut sums = vec![[0.0; 2]; share.nodes.len()];
    let nodes = share.groups.iter().flat_map(|group| group.nodes.nodes());
    nodes.zip(slots).for_each(|(node, value)| (0..2).for_each(|i| sums[*node as usize][i] += value[i]));
    share.sum(peers, |slot| slots[slot as usize], |node, sum| sums[node as usize] = sum);
    sums
}

/// Checks every rank's sums and ownership against one rank's.
fn check(groups: &[Contributors], node_count: usize, ranks: usize) {
    let decomposition = Decomposition::new(groups, node_count, ranks);
    let shares: Vec<Share> = (0..ranks).map(|rank| decomposition.share(rank)).collect();
    let slots: Vec<_> = shares.iter().map(slots).collect();
    let mut peers: Vec<_> = shares.iter().map(|share| share.peers(2)).collect();
    for rank in 0..ranks {
        shares[rank].pack(&mut peers[rank], |slot| slots[rank][slot as usize]);
    }
    let borders: Vec<Share> = shares.iter().map(|share| share.clone().with_border_alone()).collect();
    let border_slots: Vec<_> = shares.iter().zip(&slots).map(|(share, slots)| of_border(share, slots)).collect();
    for ((border, slots), peers) in borders.iter().zip(&border_slots).zip(&peers) {
        assert!(border.has_border_alone() && *border == border.clone().with_border_alone());
        let mut again = border.peers(2);
        border.pack(&mut again, |slot| slots[slot as usize]);
        assert!(again.iter().zip(peers).all(|(one, other)| one.send == other.send));
    }
    deliver(&mut peers);
    let expected = serial_sums(groups, node_count);
    let mut owners = vec![0; node_count];
    for (rank, share) in shares.iter().enumerate() {
        check_structure(share, groups, rank);
        let summed = |share: &Share, slots: &[[f64; 2]]| {
            let mut sums = Vec::new();
            share.sum(&peers[rank], |slot| slots[slot as usize], |node, sum| sums.push((node, sum.map(f64::to_bits))));
            sums
        };
        assert_eq!(summed(share, &slots[rank]), summed(&borders[rank], &border_slots[rank]));
        for (local, sum) in local_sums(share, &slots[rank], &peers[rank]).iter().enumerate() {
            let node = share.nodes[local] as usize;
            owners[node] += usize::from(share.owned[local]);
            assert_eq!(sum.map(f64::to_bits), expected[node].map(f64::to_bits), "rank {rank} node {node}");
        }
    }
    let used = |node: usize| groups.iter().any(|group| group.nodes.nodes().contains(&(node as u32)));
    assert!((0..node_count).all(|node| owners[node] == usize::from(used(node))));
}

fn deliver(peers: &mut [Vec<Peer>]) {
    for from in 0..peers.len() {
        for i in 0..peers[from].len() {
            let (to, message) = (peers[from][i].rank, peers[from][i].send.clone());
            let there = peers[to].iter_mut().find(|peer| peer.rank == from).expect("neighbours know each other");
            assert_eq!(there.receive.len(), message.len());
            there.receive = message;
        }
    }
}

fn check_structure(share: &Share, groups: &[Contributors], rank: usize) {
    assert!(share.neighbours.windows(2).all(|pair| pair[0].rank < pair[1].rank));
    let mut first_slot = 0;
    for (local, group) in share.groups.iter().zip(groups) {
        assert_eq!(local.first_slot, first_slot);
        first_slot += local.nodes.nodes().len() as u32;
        assert!(local.members.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(local.members.iter().all(|member| group.ranks[*member as usize] as usize == rank));
        let nodes = local.members.iter().flat_map(|member| &group.nodes[*member as usize]).copied();
        assert!(nodes.eq(local.nodes.nodes().iter().map(|node| share.nodes[*node as usize])));
        for (nodes, border) in local.nodes.iter().zip(&local.border) {
            assert_eq!(*border, nodes.iter().any(|node| share.sums.iter().any(|sum| sum.node == *node)));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn any_ownership_sums_as_one_rank(
        n in [1usize..5, 1usize..5, 1usize..4],
        ranks in prop::sample::select(vec![1, 2, 3, 5, 8, 64]),
        choices in prop::collection::vec(any::<u32>(), 64 + 30),
        faces in prop::collection::vec(any::<[prop::sample::Index; 4]>(), 0..30),
    ) {
        let (nodes, centroids) = box_of_hexes(n);
        let node_count = (n[0] + 1) * (n[1] + 1) * (n[2] + 1);
        let owners: Vec<u32> = choices.iter().map(|choice| choice % ranks).collect();
        // Any four nodes, even repeated ones, with any owner.
        let mut face_nodes = Connectivity::default();
        for face in &faces {
            face_nodes.push(Shape::Quadrilateral, face.iter().map(|i| i.index(node_count) as u32));
        }
        let groups = [
            Contributors { nodes: &nodes, ranks: &owners[..centroids.len()] },
            Contributors { nodes: &face_nodes, ranks: &owners[64..64 + faces.len()] },
        ];
        check(&groups, node_count, ranks as usize);
    }

    #[test]
    fn bisected_boxes_sum_as_one_rank(
        n in [1usize..7, 1usize..7, 1usize..7],
        ranks in prop::sample::select(vec![1, 2, 3, 5, 8, 64]),
    ) {
        let (nodes, centroids) = box_of_hexes(n);
        let owners = rcb(&centroids, &vec![1.0; centroids.len()], ranks);
        let groups = [Contributors { nodes: &nodes, ranks: &owners }];
        check(&groups, (n[0] + 1) * (n[1] + 1) * (n[2] + 1), ranks);
    }
}

#[test]
fn a_node_of_eight_ranks_has_eight_sources_everywhere() {
    let (nodes, _) = box_of_hexes([2, 2, 2]);
    let owners: Vec<u32> = (0..8).collect();
    let groups = [Contributors { nodes: &nodes, ranks: &owners }];
    let decomposition = Decomposition::new(&groups, 27, 8);
    for rank in 0..8 {
        let share = decomposition.share(rank);
        assert_eq!(share.neighbours.len(), 7);
        let centre = share.nodes.iter().position(|node| *node == 13).unwrap();
        let sum = share.sums.iter().find(|sum| sum.node as usize == centre).unwrap();
        assert_eq!(sum.sources.len(), 8);
        assert_eq!(share.owned[centre], rank == 0);
    }
}

/// A hexahedron of the first rank and a bar of the second that can turn: the second answers for the node of both, since the first knows
/// nothing of its rotation.
#[test]
fn who_answers_for_a_rotation_answers_for_its_node() {
    let mut nodes = Connectivity::default();
    nodes.push(Shape::Hexahedron, 0..8);
    nodes.push(Shape::Bar, [3, 8, 9, 10]);
    let groups = [Contributors { nodes: &nodes, ranks: &[0, 1] }];
    let decomposition = Decomposition::with_rotations(&groups, 9, &[3, 8], 2);
    let owned_of = |share: Share| -> Vec<u32> {
        let owned = share.nodes.iter().zip(&share.owned).filter(|(_, owned)| **owned);
        owned.map(|(node, _)| *node).collect()
    };
    assert_eq!(owned_of(decomposition.share(0)), [0, 1, 2, 4, 5, 6, 7]);
    assert_eq!(owned_of(decomposition.share(1)), [3, 8, 9, 10]);
}

#[test]
fn one_rank_shares_nothing() {
    let (nodes, centroids) = box_of_hexes([3, 2, 1]);
    let owners = vec![0; centroids.len()];
    let groups = [Contributors { nodes: &nodes, ranks: &owners }];
    let share = Decomposition::new(&groups, 24, 1).share(0);
    assert!(share.neighbours.is_empty() && share.sums.is_empty() && share.sources.is_empty());
    assert!(share.owned.iter().all(|owned| *owned) && share.groups[0].border.iter().all(|border| !border));
}
