//! Cross sections of beams: area, moments, torsion, and fibres that have them.
//!
//! Fibres are chosen so that area, second moments and, to a per cent, the fully plastic moments are those of the section: two
//! points of Gauss in each half of a rectangle give both exactly, as do two rings in a rod and a thick tube, and three fibres
//! across a thick web. Thin walls have one ring, thin webs two fibres, where that is a per cent.

/// Fibres at most.
pub const MOST_FIBRES: usize = 28;

/// A cross section about its centre.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    /// Area, length².
    pub area: f64,
    /// Distance from its centre at which it touches others: the radius of what is round, of others half the smaller of width
    /// and height, a length.
    pub radius: f64,
    /// Second moments about y, ∫ z² dA, and about z, ∫ y² dA, length⁴.
    pub moments: [f64; 2],
    /// Torsion constant, length⁴.
    pub torsion: f64,
    /// Shear corrections along y and along z: the part of the area that carries the shear force.
    pub shear_corrections: [f64; 2],
    /// y, z and area of each fibre.
    pub fibres: Vec<[f64; 3]>,
}

/// Places of two points of Gauss in each half of [−½, ½], of equal weight.
fn halves() -> [f64; 4] {
    let a = 0.25 / 3f64.sqrt();
    [-0.25 - a, -0.25 + a, 0.25 - a, 0.25 + a]
}

/// Places of two points of Gauss in [−½, ½].
const PAIR: [f64; 2] = [-0.288_675_134_594_812_9, 0.288_675_134_594_812_9];

/// Places in [−½, ½] and weights of two points of Gauss, and of three whose mean |y|, too, is exact: 1/4.
const TWO: [[f64; 2]; 2] = [[PAIR[0], 0.5], [PAIR[1], 0.5]];
const THREE: [[f64; 2]; 3] = [[-1.0 / 3.0, 0.375], [0.0, 0.25], [1.0 / 3.0, 0.375]];

/// Shear correction of a rectangle, along either of its sides.
const OF_RECTANGLE: f64 = 5.0 / 6.0;

/// By how much the fully plastic moment of a section may be wrong where fibres can be spared.
const WRONG: f64 = 0.01;

impl Section {
    fn of_fibres(radius: f64, fibres: Vec<[f64; 3]>, torsion: f64, shear_corrections: [f64; 2]) -> Section {
        let sum = |f: fn(&[f64; 3]) -> f64| fibres.iter().map(f).sum::<f64>();
        let moments = [sum(|[_, z, a]| z * z * a), sum(|[y, _, a]| y * y * a)];
        Section { area: sum(|fibre| fibre[2]), radius, moments, torsion, shear_corrections, fibres }
    }

    /// A rectangle of width b along y and height h along z.
    pub fn rectangle(b: f64, h: f64) -> Section {
        let grid = halves().into_iter().flat_map(|y| halves().map(|z| [y * b, z * h, b * h / 16.0]));
        let (long, short) = (b.max(h), b.min(h));
        let ratio = short / long;
        // Roark's formula, right to half a per cent.
        let torsion = long * short.powi(3) * (1.0 / 3.0 - 0.21 * ratio * (1.0 - ratio.powi(4) / 12.0));
        Section::of_fibres(0.5 * short, grid.collect(), torsion, [OF_RECTANGLE; 2])
    }

    /// A solid rod of radius r.
    pub fn rod(r: f64) -> Section {
        let area = std::f64::consts::PI * r * r;
        Section::of_fibres(r, two_rings(8, [r, 0.0]), 0.5 * area * r * r, [0.9; 2])
    }

    /// A tube of outer radius r and wall t, which may be as thick as the radius.
    pub fn tube(r: f64, t: f64) -> Section {
        let inner = (r - t).max(0.0);
        let area = std::f64::consts::PI * (r * r - inner * inner);
        let ring = (0.5 * (r * r + inner * inner)).sqrt();
        let plastic = 4.0 / 3.0 * (r.powi(3) - inner.powi(3));
        let thin = area * ring * mean_height(16) < (1.0 + WRONG) * plastic;
        let fibres = if thin { ring_of(16, ring, area).collect() } else { two_rings(12, [r, inner]) };
        // The shear stress of a thin wall flows along it, which takes half of the area; that of a thick one less so (Cowper 1966, for
        // ν = 0; for greater ν it is up to 4 % more).
        let squares = r * r + inner * inner;
        let shear = 6.0 / (7.0 + 20.0 * (r * inner / squares).powi(2));
        Section::of_fibres(r, fibres, 0.5 * area * squares, [shear; 2])
    }

    /// An I of height h along z, flanges of width b along y and thickness f, and a web of thickness w.
    pub fn i_beam(h: f64, b: f64, f: f64, w: f64) -> Section {
        let web = h - 2.0 * f;
        let mut fibres = Vec::new();
        for side in [-0.5, 0.5] {
            let middle = side * (h - f);
            fibres.extend(halves().into_iter().flat_map(|y| PAIR.map(|z| [y * b, middle + z * f, b * f / 8.0])));
        }
        // About z the flanges have the fully plastic moment b² f/2, and the web w² web/4.
        let of_web = web * w * w;
        let thin = (PAIR[1] - 0.25) * of_web < WRONG * (0.5 * b * b * f + 0.25 * of_web);
        let across: &[[f64; 2]] = if thin { &TWO } else { &THREE };
        for z in halves() {
            fibres.extend(across.iter().map(|[y, share]| [y * w, z * web, share * web * w / 4.0]));
        }
        let torsion = (2.0 * b * f.powi(3) + web * w.powi(3)) / 3.0;
        // Along z the web carries the shear. Along y the flanges do, each a rectangle; where the web is so thick that it has more than
        // they, the rectangle of its thickness does, through the whole height.
        let area = 2.0 * b * f + web * w;
        let shear = [OF_RECTANGLE * (2.0 * b * f).max(h * w) / area, web * w / area];
        Section::of_fibres(0.5 * h.min(b), fibres, torsion, shear)
    }
}

/// Mean of |sin| over fibres that stand evenly, none of them at 0.
fn mean_height(count: usize) -> f64 {
    2.0 / (count as f64 * libm::sin(std::f64::consts::PI / count as f64))
}

/// Two rings of half the area each that have the second moments and the fully plastic moment of a tube exactly: the sum of their radii
/// is (8/3)(r³ − r′³)/(A m) with the mean height m of their fibres, that of their squares r² + r′².
fn two_rings(count: usize, [r, inner]: [f64; 2]) -> Vec<[f64; 3]> {
    let squares = r * r + inner * inner;
    let area = std::f64::consts::PI * (r * r - inner * inner);
    let sum = 8.0 / 3.0 * (r.powi(3) - inner.powi(3)) / (area * mean_height(count));
    let half = 0.5 * (2.0 * squares - sum * sum).max(0.0).sqrt();
    let radii = [0.5 * sum - half, 0.5 * sum + half];
    radii.into_iter().flat_map(|ring| ring_of(count, ring, 0.5 * area)).collect()
}

fn ring_of(count: usize, radius: f64, area: f64) -> impl Iterator<Item = [f64; 3]> {
    (0..count).map(move |i| {
        let angle = 2.0 * std::f64::consts::PI * (i as f64 + 0.5) / count as f64;
        [radius * libm::cos(angle), radius * libm::sin(angle), area / count as f64]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plastic(section: &Section) -> f64 {
        section.fibres.iter().map(|[_, z, area]| z.abs() * area).sum()
    }

    fn close(what: &str, a: f64, b: f64, part: f64) {
        assert!((a / b - 1.0).abs() < part, "{what}: {a} instead of {b}");
    }

    #[test]
    fn fibres_have_the_moments_of_their_sections() {
        let [b, h] = [0.02, 0.05];
        let section = Section::rectangle(b, h);
        close("area", section.area, b * h, 1e-12);
        close("I about y", section.moments[0], b * h.powi(3) / 12.0, 1e-12);
        close("I about z", section.moments[1], h * b.powi(3) / 12.0, 1e-12);
        close("plastic moment", plastic(&section), b * h * h / 4.0, 1e-12);
        let rod = Section::rod(0.01);
        close("area", rod.area, std::f64::consts::PI * 1e-4, 1e-12);
        close("I", rod.moments[1], std::f64::consts::PI * 1e-8 / 4.0, 1e-12);
        close("plastic moment", plastic(&rod), 4e-6 / 3.0, 1e-12);
        for inner in [0.8, 0.95] {
            let tube = Section::tube(1.0, 1.0 - inner);
            close("area", tube.area, std::f64::consts::PI * (1.0 - inner * inner), 1e-12);
            close("I", tube.moments[0], std::f64::consts::PI / 4.0 * (1.0 - f64::powi(inner, 4)), 1e-12);
            close("plastic moment", plastic(&tube), 4.0 / 3.0 * (1.0 - f64::powi(inner, 3)), 0.01);
        }
        let [h, b, f, w] = [0.2, 0.1, 0.01, 0.006];
        let section = Section::i_beam(h, b, f, w);
        let exact = (b * h.powi(3) - (b - w) * (h - 2.0 * f).powi(3)) / 12.0;
        close("I", section.moments[0], exact, 1e-12);
        close("plastic moment", plastic(&section), b * f * (h - f) + w * (h - 2.0 * f).powi(2) / 4.0, 1e-12);
        close("torsion of a square", Section::rectangle(1.0, 1.0).torsion, 0.1406, 0.01);
        for (section, fibres) in
            [(Section::rectangle(1.0, 1.0), 16), (Section::rod(1.0), 16), (Section::tube(1.0, 0.1), 16), (section, 24)]
        {
            assert_eq!(section.fibres.len(), fibres);
        }
    }

    /// Shear areas along y and z: 5/6 of rectangles, half of a thin tube, the flanges of an I as two rectangles and its web. A tube without
    /// a hole is a rod, whose correction is 0.86 to 0.9 by the theory that one asks, an I with a web as wide as its flanges a rectangle.
    #[test]
    fn shear_areas_go_by_the_direction() {
        let areas = |section: Section| section.shear_corrections.map(|correction| correction * section.area);
        let [h, b, f, w] = [0.2, 0.3, 0.02, 0.01];
        for (what, section, expected, part) in [
            ("rectangle", Section::rectangle(b, h), [5.0 / 6.0 * b * h; 2], 1e-12),
            ("thin tube", Section::tube(1.0, 1e-3), [std::f64::consts::PI * 1e-3; 2], 1e-3),
            ("tube without a hole", Section::tube(1.0, 1.0), areas(Section::rod(1.0)), 0.05),
            ("I", Section::i_beam(h, b, f, w), [5.0 / 6.0 * 2.0 * b * f, w * (h - 2.0 * f)], 1e-12),
        ] {
            let found = areas(section);
            (0..2).for_each(|axis| close(&format!("{what}, axis {axis}"), found[axis], expected[axis], part));
        }
        let along_y = areas(Section::i_beam(h, b, 1e-3, b))[0];
        close("I with a web as wide, along y", along_y, 5.0 / 6.0 * b * h, 1e-12);
    }

    /// Tubes of any wall and sections of any web have their plastic moments about both axes to a per cent, and no fibre far outside.
    #[test]
    fn thick_walls_and_webs_have_their_plastic_moments() {
        let about_z = |section: &Section| section.fibres.iter().map(|[y, _, area]| y.abs() * area).sum::<f64>();
        for wall in (1..=100).map(|percent| f64::from(percent) / 100.0) {
            let (tube, inner) = (Section::tube(1.0, wall), 1.0 - wall);
            close("area", tube.area, std::f64::consts::PI * (1.0 - inner * inner), 1e-12);
            close("I", tube.moments[0], std::f64::consts::PI / 4.0 * (1.0 - inner.powi(4)), 1e-12);
            for moment in [plastic(&tube), about_z(&tube)] {
                close("plastic moment of a tube", moment, 4.0 / 3.0 * (1.0 - inner.powi(3)), WRONG);
            }
            assert!(tube.fibres.iter().all(|[y, z, _]| y.hypot(*z) < 1.03), "{wall}: {tube:?}");
            let [h, b, f] = [2.0, 1.0, 0.2];
            let (section, w, web) = (Section::i_beam(h, b, f, wall), wall, h - 2.0 * f);
            close("I about z", section.moments[1], (2.0 * f * b.powi(3) + web * w.powi(3)) / 12.0, 1e-12);
            close("strong", plastic(&section), b * f * (h - f) + w * web * web / 4.0, 1e-12);
            close("weak", about_z(&section), b * b * f / 2.0 + web * w * w / 4.0, WRONG);
            assert!(tube.fibres.len().max(section.fibres.len()) <= MOST_FIBRES);
        }
    }
}
