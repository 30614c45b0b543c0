//! Curves as lines on paper: cut at gaps and at the edges, thinned to what can be seen, dashed.

/// A place on the picture in pixels, y downwards.
pub type Spot = [f64; 2];

/// A rectangle of the picture in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Box2 {
    /// Left, upper, right and lower edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Right edge.
    pub right: f64,
    /// Lower edge.
    pub bottom: f64,
}

/// The runs of spots that have finite coordinates.
pub fn unbroken(spots: &[Spot]) -> impl Iterator<Item = &[Spot]> {
    spots.split(|[x, y]| !(x.is_finite() && y.is_finite())).filter(|run| !run.is_empty())
}

/// The same line with at most four spots in a column of `width` pixels: first, lowest, highest, last. What is drawn is the
/// same; a file of a million states becomes a picture of some kilobytes. Lines that go back and forth keep their spots but
/// for those that do not move by a tenth of `width`.
pub fn thinned(spots: &[Spot], width: f64) -> Vec<Spot> {
    if spots.windows(2).any(|pair| pair[1][0] < pair[0][0]) {
        let mut kept: Vec<Spot> = Vec::new();
        for (i, &spot) in spots.iter().enumerate() {
            let near = |other: &Spot| (other[0] - spot[0]).abs().max((other[1] - spot[1]).abs()) < 0.1 * width;
            if i + 1 == spots.len() || !kept.last().is_some_and(near) {
                kept.push(spot);
            }
        }
        return kept;
    }
    let column = |spot: &Spot| (spot[0] / width).floor();
    let mut kept = Vec::new();
    for group in spots.chunk_by(|a, b| column(a) == column(b)) {
        let by_height = |&a: &usize, &b: &usize| group[a][1].total_cmp(&group[b][1]);
        let ends = [(0..group.len()).min_by(by_height), (0..group.len()).max_by(by_height)];
        let mut places: Vec<usize> = [Some(0), Some(group.len() - 1)].into_iter().chain(ends).flatten().collect();
        places.sort_unstable();
        places.dedup();
        kept.extend(places.into_iter().map(|place| group[place]));
    }
    kept
}

/// The parts of a line inside a rectangle.
pub fn clipped(spots: &[Spot], inside: Box2) -> Vec<Vec<Spot>> {
    let mut lines: Vec<Vec<Spot>> = Vec::new();
    for pair in spots.windows(2) {
        let Some([from, to]) = clip(pair[0], pair[1], inside) else { continue };
        match lines.last_mut() {
            Some(line) if line.last() == Some(&from) => line.push(to),
            _ => lines.push(vec![from, to]),
        }
    }
    lines
}

/// The part of a segment inside a rectangle (Liang and Barsky, 1984).
fn clip(a: Spot, b: Spot, inside: Box2) -> Option<[Spot; 2]> {
    let step = [b[0] - a[0], b[1] - a[1]];
    let (mut enter, mut leave) = (0.0, 1.0);
    for (move_, room) in [
        (-step[0], a[0] - inside.left),
        (step[0], inside.right - a[0]),
        (-step[1], a[1] - inside.top),
        (step[1], inside.bottom - a[1]),
    ] {
        if move_ == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if move_ < 0.0 {
            enter = f64::max(enter, room / move_);
        } else {
            leave = f64::min(leave, room / move_);
        }
    }
    let at = |t: f64| {
        if t == 0.0 {
            a
        } else if t == 1.0 {
            b
        } else {
            [a[0] + t * step[0], a[1] + t * step[1]]
        }
    };
    (enter <= leave).then(|| [at(enter), at(leave)])
}

/// A line in dashes: `pattern` has the lengths of dash and gap in turn, in pixels; without any the line stays whole.
pub fn dashed(line: &[Spot], pattern: &[f64]) -> Vec<Vec<Spot>> {
    if pattern.is_empty() {
        return vec![line.to_vec()];
    }
    let (mut dashes, mut place, mut left) = (Vec::new(), 0, pattern[0]);
    let mut dash: Vec<Spot> = line.first().copied().into_iter().collect();
    for pair in line.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let at = done / length;
            let spot = [a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])];
            if place % 2 == 0 {
                dash.push(spot);
                dashes.push(std::mem::take(&mut dash));
            } else {
                dash = vec![spot];
            }
            place = (place + 1) % pattern.len();
            left = pattern[place];
        }
        left -= length - done;
        if place % 2 == 0 {
            dash.push(b);
        }
    }
    if dash.len() > 1 {
        dashes.push(dash);
    }
    dashes
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAPER: Box2 = Box2 { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn lines_end_at_the_edge_and_come_back() {
        let lines = clipped(&[[5.0, 5.0], [5.0, 15.0], [8.0, 15.0], [8.0, 0.0]], PAPER);
        assert_eq!(lines, [vec![[5.0, 5.0], [5.0, 10.0]], vec![[8.0, 10.0], [8.0, 0.0]]]);
        assert!(clipped(&[[-1.0, -1.0], [-1.0, 20.0]], PAPER).is_empty());
    }

    #[test]
    fn a_dense_line_keeps_its_peaks() {
        let mut spots: Vec<Spot> = (0..10_000).map(|i| [f64::from(i) / 1000.0, 5.0]).collect();
        spots[4567][1] = -3.0;
        let kept = thinned(&spots, 1.0);
        assert!(kept.len() <= 40 && kept.contains(&spots[4567]));
        assert_eq!((kept[0], kept[kept.len() - 1]), (spots[0], spots[9999]));
    }

    #[test]
    fn dashes_have_their_length_across_corners() {
        let dashes = dashed(&[[0.0, 0.0], [3.0, 0.0], [3.0, 7.0]], &[4.0, 2.0]);
        assert_eq!(dashes, [vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0]], vec![[3.0, 3.0], [3.0, 7.0]]]);
    }

    #[test]
    fn gaps_are_where_there_are_no_numbers() {
        let spots = [[0.0, 1.0], [1.0, f64::NAN], [2.0, 1.0], [3.0, 1.0]];
        assert_eq!(unbroken(&spots).map(<[Spot]>::len).collect::<Vec<_>>(), [1, 2]);
    }
}
