//! The 256 colours of a GIF: one set for all its frames, made for what these pictures show, so that a colour means the
//! same from the first frame to the last and nothing flickers.

use std::collections::HashMap;

use super::colour::{BLOCK_COLOURS, ColourMap, NO_VALUE, Rgb};
use crate::postprocess::view::annotate::AXIS_COLOURS;

/// Steps of the colour map, and the brightness that light and lines leave of a colour.
const MAP_STEPS: usize = 46;
const BRIGHTNESS: [f32; 4] = [1.0, 0.9, 0.78, 0.5];
const GREYS: usize = 24;

/// Up to 256 colours and which of them is nearest to a colour met before.
pub struct Palette {
    colours: Vec<[u8; 3]>,
    nearest: HashMap<[u8; 3], u8>,
}

impl Palette {
    /// Greys for letters and lines, the axes, and the colours of values and blocks in light and shade.
    pub fn new(map: &ColourMap) -> Self {
        let shaded = |colour: Rgb| BRIGHTNESS.map(|brightness| colour.map(|channel| channel * brightness));
        let greys = (0..GREYS).map(|i| [i as f32 / (GREYS - 1) as f32; 3]);
        let values = (0..MAP_STEPS).map(|i| map.at(i as f32 / (MAP_STEPS - 1) as f32));
        let lit = values.chain(BLOCK_COLOURS).chain([NO_VALUE]).flat_map(shaded);
        let colours = greys.chain(AXIS_COLOURS).chain(lit).map(|colour| colour.map(|c| (255.0 * c + 0.5) as u8));
        Palette { colours: colours.take(256).collect(), nearest: HashMap::new() }
    }

    /// The colours, red, green and blue in turn.
    pub fn bytes(&self) -> Vec<u8> {
        self.colours.concat()
    }

    /// For each pixel of RGBA bytes, the number of the colour nearest to it.
    pub fn indices(&mut self, rgba: &[u8]) -> Vec<u8> {
        let Palette { colours, nearest } = self;
        let mut index = |pixel: [u8; 3]| *nearest.entry(pixel).or_insert_with(|| nearest_of(colours, pixel));
        rgba.chunks_exact(4).map(|pixel| index([pixel[0], pixel[1], pixel[2]])).collect()
    }
}

fn nearest_of(colours: &[[u8; 3]], pixel: [u8; 3]) -> u8 {
    let distance = |colour: &[u8; 3]| -> u32 {
        // Eyes are about as much more sensitive to green, and less to blue.
        let weights = [3, 4, 2];
        (0..3).map(|i| weights[i] * u32::from(colour[i].abs_diff(pixel[i])).pow(2)).sum()
    };
    let nearest = (0..colours.len()).min_by_key(|&i| distance(&colours[i]));
    nearest.unwrap_or(0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_of_the_pictures_are_kept_closely() {
        let map = ColourMap::sequential();
        let mut palette = Palette::new(&map);
        assert!(palette.colours.len() <= 256 && palette.colours.len() > 240);
        for i in 0..=100 {
            let colour = map.at(i as f32 / 100.0).map(|c| (255.0 * c) as u8);
            let index = palette.indices(&[colour[0], colour[1], colour[2], 255])[0];
            let kept = palette.colours[usize::from(index)];
            assert!((0..3).all(|c| kept[c].abs_diff(colour[c]) <= 10), "{colour:?} {kept:?}");
        }
        let white = palette.indices(&[255; 4])[0];
        assert_eq!(palette.colours[usize::from(white)], [255; 3]);
    }
}
