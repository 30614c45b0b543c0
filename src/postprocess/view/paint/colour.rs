//! The colours of values: a map whose lightness rises evenly, so that equal steps of a value look equally large, and
//! stay apart in black and white and for colour-blind eyes.

/// Red, green, blue in sRGB, each 0 to 1.
pub type Rgb = [f32; 3];

/// Faces whose value is missing or not a number.
pub const NO_VALUE: Rgb = [0.72, 0.72, 0.72];

/// Muted colours that tell blocks apart, repeated if there are more blocks.
pub const BLOCK_COLOURS: [Rgb; 8] = [
    [0.47, 0.61, 0.76],
    [0.85, 0.62, 0.38],
    [0.53, 0.70, 0.49],
    [0.76, 0.50, 0.53],
    [0.62, 0.55, 0.74],
    [0.80, 0.74, 0.45],
    [0.45, 0.68, 0.70],
    [0.68, 0.60, 0.53],
];

/// Nodes that nothing touches, that are pushed, and that touch a face themselves.
pub const STATUS_COLOURS: [Rgb; 3] = [[0.88, 0.88, 0.87], [0.90, 0.62, 0.10], [0.10, 0.42, 0.70]];

/// Lightness (OKLab) at the two ends: dark enough and light enough to show shading and edges.
const LIGHTNESS: [f64; 2] = [0.38, 0.92];
/// Hue (degrees, OKLab) at the two ends: from violet through blue, teal and green to yellow.
const HUE: [f64; 2] = [295.0, 106.0];
/// Chroma (OKLab) at the two ends, and the least one and where it is: sRGB has no strong teal. The parabolas between
/// stay inside sRGB, where following its border would make bright and dull bands.
const CHROMA: [f64; 2] = [0.2018, 0.1897];
const LEAST_CHROMA: (f64, f64) = (0.105, 0.44);
const STEPS: usize = 512;
/// Hues of negative and positive values, which also colour-blind eyes tell apart; lightness (OKLab) at zero and at the
/// ends; largest chroma.
const SIGNED_HUE: [f64; 2] = [255.0, 35.0];
const SIGNED_LIGHTNESS: [f64; 2] = [0.95, 0.45];
const SIGNED_CHROMA: f64 = 0.135;

/// A table of colours between the smallest and the largest value.
pub struct ColourMap {
    table: Vec<Rgb>,
}

impl ColourMap {
    /// For values of one sign: lightness rises from the smallest to the largest.
    pub fn sequential() -> Self {
        ColourMap { table: (0..STEPS).map(|i| colour(i as f64 / (STEPS - 1) as f64)).collect() }
    }

    /// For values of both signs between these ends: white at zero, blue below, red above, and equally strong at equal
    /// distances from zero.
    pub fn diverging((low, high): (f64, f64)) -> Self {
        let most = low.abs().max(high.abs());
        let value = |i: usize| (low + (high - low) * i as f64 / (STEPS - 1) as f64) / most;
        ColourMap { table: (0..STEPS).map(|i| signed(value(i))).collect() }
    }

    /// For numbers that stand for something: equal parts of the range with a colour each.
    pub fn steps(colours: &[Rgb]) -> Self {
        ColourMap { table: (0..STEPS).filter_map(|i| colours.get(i * colours.len() / STEPS)).copied().collect() }
    }

    /// The colour at `fraction` of the range, 0 to 1; what lies outside gets the colour of the end.
    pub fn at(&self, fraction: f32) -> Rgb {
        if fraction.is_nan() {
            return NO_VALUE;
        }
        // A float cast to an integer saturates: values below the range give the first entry.
        let index = (fraction * (STEPS - 1) as f32 + 0.5) as usize;
        self.table[index.min(STEPS - 1)]
    }
}

fn colour(fraction: f64) -> Rgb {
    let between = |ends: [f64; 2]| ends[0] + fraction * (ends[1] - ends[0]);
    let (lightness, hue) = (between(LIGHTNESS), between(HUE).to_radians());
    let (least, place) = LEAST_CHROMA;
    let (end, side) = if fraction < place { (CHROMA[0], place) } else { (CHROMA[1], 1.0 - place) };
    let chroma = least + (end - least) * ((fraction - place) / side).powi(2);
    linear_rgb([lightness, chroma * hue.cos(), chroma * hue.sin()]).map(|channel| gamma(channel) as f32)
}

/// The colour of a value between -1 and 1.
fn signed(value: f64) -> Rgb {
    let strength = value.abs().min(1.0);
    let hue = (if value < 0.0 { SIGNED_HUE[0] } else { SIGNED_HUE[1] }).to_radians();
    let lightness = SIGNED_LIGHTNESS[0] + strength * (SIGNED_LIGHTNESS[1] - SIGNED_LIGHTNESS[0]);
    // Full chroma some way before the end, where darkness takes over.
    let chroma = SIGNED_CHROMA * (1.25 * strength.powf(0.9)).min(1.0);
    linear_rgb([lightness, chroma * hue.cos(), chroma * hue.sin()]).map(|channel| gamma(channel) as f32)
}

/// OKLab (B. Ottosson, 2020) to linear sRGB.
fn linear_rgb([lightness, a, b]: [f64; 3]) -> [f64; 3] {
    let cube = |x: f64| x * x * x;
    let l = cube(lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let m = cube(lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let s = cube(lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ]
}

/// The transfer function of sRGB (IEC 61966-2-1).
fn gamma(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of sRGB (IEC 61966-2-1) and the CIE 1976 lightness of it.
    fn cie_lightness(rgb: Rgb) -> f64 {
        let linear = rgb.map(f64::from).map(|c| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) });
        let y = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
        116.0 * y.cbrt() - 16.0
    }

    #[test]
    fn lightness_rises_steadily() {
        let map = ColourMap::sequential();
        let lightness: Vec<f64> = (0..=16).map(|i| cie_lightness(map.at(i as f32 / 16.0))).collect();
        let mean = (lightness[16] - lightness[0]) / 16.0;
        for pair in lightness.windows(2) {
            let step = pair[1] - pair[0];
            assert!(step > 0.6 * mean && step < 1.4 * mean, "{step} against {mean}");
        }
    }

    #[test]
    fn all_colours_can_be_shown() {
        for map in [ColourMap::sequential(), ColourMap::diverging((-1.0, 1.0)), ColourMap::diverging((-0.2, 3.0))] {
            assert!((0..=1000).flat_map(|i| map.at(i as f32 / 1000.0)).all(|c| (0.0..=1.0).contains(&c)));
        }
    }

    #[test]
    fn signed_values_are_white_at_zero_and_equally_light_on_both_sides() {
        let map = ColourMap::diverging((-1.0, 3.0));
        assert!(map.at(0.25).iter().all(|c| *c > 0.9), "{:?}", map.at(0.25));
        let (below, above) = (cie_lightness(map.at(0.0)), cie_lightness(map.at(0.5)));
        assert!((below - above).abs() < 6.0, "{below} {above}");
        assert!(map.at(0.0)[2] > map.at(0.0)[0] && map.at(1.0)[0] > map.at(1.0)[2]);
    }

    #[test]
    fn values_outside_the_range_get_the_colour_of_the_end() {
        let map = ColourMap::sequential();
        assert_eq!(map.at(-3.0), map.at(0.0));
        assert_eq!(map.at(7.0), map.at(1.0));
        assert_eq!(map.at(f32::NAN), NO_VALUE);
    }
}
