//! The constraint of two edges that touch: which nodes it moves, and their weights.

use super::lines::{Crossing, Line};
use super::{EdgeCheck, EdgeContact};
use crate::common::vector::{add, cross, dot, scaled, subtract};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::constraint::{Constraint, MEMBERS, Origin};
use crate::solver::contact::surface::pairings::Pairing;

impl EdgeCheck<'_> {
    /// Places where the edges see each other at the beginning of the step, along the normal of its end: forces there have
    /// no moment.
    fn places_along(&self, [a, b]: [Line; 2], end: &Crossing) -> [f64; 2] {
        let (u, v, r) = (subtract(a[1], a[0]), subtract(b[1], b[0]), subtract(b[0], a[0]));
        let volume = dot(end.normal, cross(u, v));
        let places = [dot(end.normal, cross(r, v)) / volume, dot(end.normal, cross(r, u)) / volume];
        if places.iter().all(|place| (-0.5..=1.5).contains(place)) { places } else { end.places }
    }

    /// Three corners of a face and their shares in the point at `place` of the way from an end of ridges to the middle. Seen
    /// along the normal it is the point that all four would have: forces there have no moment.
    fn shares_on_ridge(&self, ridge: u32, half: usize, place: f64, normal: [f64; 3]) -> [(u32, f64); 3] {
        let edge = &self.edges[ridge as usize];
        let (end, across) = (edge.ends[half], edge.ends[1 - half]);
        let at = |point: u32| subtract(self.motion.start(point), self.motion.start(end));
        let corners = edge.points(self.faces);
        let third = |half: usize| corners.iter().copied().filter(|corner| !edge.ends.contains(corner)).nth(half);
        let others = [third(0).unwrap_or(end), third(1).unwrap_or(end)];
        let to_place = scaled(add(at(across), add(at(others[0]), at(others[1]))), 0.25 * place);
        let shares = |other: u32| {
            let volume = dot(normal, cross(at(other), at(across)));
            (dot(normal, cross(to_place, at(across))) / volume, dot(normal, cross(at(other), to_place)) / volume)
        };
        let found = others.map(|other| (other, shares(other)));
        // The point lies in one of the two triangles, or on the line between them.
        let (other, (own, beyond)) = if found[0].1.0 >= 0.0 { found[0] } else { found[1] };
        if !(0.0..=1.0).contains(&own) || !(-0.5..=1.5).contains(&beyond) {
            return [(end, 1.0 - 0.5 * place), (across, 0.5 * place), (end, 0.0)];
        }
        [(end, 1.0 - own - beyond), (across, beyond), (other, own)]
    }

    /// The constraint of a pair, by a gap that is counted from where they may stay, a length.
    pub(super) fn constraint(
        &self,
        (pair, half): ([u32; 2], usize),
        end: &Crossing,
        now: &EdgeContact,
        gap: f64,
        pairing: Pairing,
    ) -> Constraint {
        let [a, b] = [self.edges[pair[0] as usize].ends, self.edges[pair[1] as usize].ends];
        let [s, t] = self.places_along(self.starts(pair, half), end);
        let is_ridge = self.edges[pair[1] as usize].is_ridge();
        let [(c, w), (d, v), (e, u)] = if is_ridge {
            self.shares_on_ridge(pair[1], half, if half == 0 { t } else { 1.0 - t }, end.normal)
        } else {
            [(b[0], 1.0 - t), (b[1], t), (a[0], 0.0)]
        };
        Constraint {
            members: [a[0], a[1], c, d, e],
            weights: [1.0 - s, s, -w, -v, -u],
            count: if is_ridge { MEMBERS } else { MEMBERS - 1 },
            normal: scaled(end.normal, now.sense),
            gap,
            growth: 0.0,
            persists: now.carried != Carried::NOTHING,
            yields: false,
            is_thick: self.distance(pair) > 0.0,
            size: end.shorter(),
            share: pairing.share,
            friction: pairing.friction,
            carried: now.carried,
            origin: Origin::Edges(pair[0], pair[1]),
        }
    }
}
