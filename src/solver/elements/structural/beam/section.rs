//! Cross sections of beams: area, moments, torsion, and fibres that have them.
//!
//! Fibres are chosen so that area, second moments and, to a per cent, the fully plastic moments are those of the section: two
//! points of Gauss in each half of a rectangle give both exactly, as do two rings of eight in a rod.

/// Fibres at most.
pub const MOST_FIBRES: usize = 24;

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
    /// Shear correction.
    pub shear_correction: f64,
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

impl Section {
    fn of_fibres(radius: f64, fibres: Vec<[f64; 3]>, torsion: f64, shear_correction: f64) -> Section {
        let sum = |f: fn(&[f64; 3]) -> f64| fibres.iter().map(f).sum::<f64>();
        let moments = [sum(|[_, z, a]| z * z * a), sum(|[y, _, a]| y * y * a)];
        Section { area: sum(|fibre| fibre[2]), radius, moments, torsion, shear_correction, fibres }
    }

    /// A rectangle of width b along y and height h along z.
    pub fn rectangle(b: f64, h: f64) -> Section {
        let grid = halves().into_iter().flat_map(|y| halves().map(|z| [y * b, z * h, b * h / 16.0]));
        let (long, short) = (b.max(h), b.min(h));
        let ratio = short / long;
        // Roark's formula, right to half a per cent.
        let torsion = long * short.powi(3) * (1.0 / 3.0 - 0.21 * ratio * (1.0 - ratio.powi(4) / 12.0));
        Section::of_fibres(0.5 * short, grid.collect(), torsion, 5.0 / 6.0)
    }

    /// A solid rod of radius r.
    pub fn rod(r: f64) -> Section {
        let area = std::f64::consts::PI * r * r;
        // Mean of |sin| over eight fibres that stand evenly.
        let mean = 0.5 * ((std::f64::consts::PI / 8.0).sin() + (3.0 * std::f64::consts::PI / 8.0).sin());
        let sum = 8.0 / 3.0 / (std::f64::consts::PI * mean);
        let half = 0.5 * (2.0 - sum * sum).sqrt();
        let radii = [0.5 * sum - half, 0.5 * sum + half];
        let rings = radii.into_iter().flat_map(|ring| ring_of(8, ring * r, 0.5 * area));
        Section::of_fibres(r, rings.collect(), 0.5 * area * r * r, 0.9)
    }

    /// A tube of outer radius r and wall t, which may be as thick as the radius.
    pub fn tube(r: f64, t: f64) -> Section {
        let inner = (r - t).max(0.0);
        let area = std::f64::consts::PI * (r * r - inner * inner);
        let ring = (0.5 * (r * r + inner * inner)).sqrt();
        Section::of_fibres(r, ring_of(16, ring, area).collect(), 0.5 * area * (r * r + inner * inner), 0.5)
    }

    /// An I of height h along z, flanges of width b along y and thickness f, and a web of thickness w.
    pub fn i_beam(h: f64, b: f64, f: f64, w: f64) -> Section {
        let web = h - 2.0 * f;
        let mut fibres = Vec::new();
        for side in [-0.5, 0.5] {
            let middle = side * (h - f);
            fibres.extend(halves().into_iter().flat_map(|y| PAIR.map(|z| [y * b, middle + z * f, b * f / 8.0])));
        }
        fibres.extend(halves().into_iter().flat_map(|z| PAIR.map(|y| [y * w, z * web, web * w / 8.0])));
        let torsion = (2.0 * b * f.powi(3) + web * w.powi(3)) / 3.0;
        let shear = web * w / (2.0 * b * f + web * w);
        Section::of_fibres(0.5 * h.min(b), fibres, torsion, shear)
    }
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
        assert!(
            [Section::rectangle(1.0, 1.0), Section::rod(1.0), Section::tube(1.0, 0.1), section]
                .iter()
                .all(|section| section.fibres.len() <= MOST_FIBRES)
        );
    }
}
