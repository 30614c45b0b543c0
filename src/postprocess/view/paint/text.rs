//! Letters in a picture.

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};
use tiny_skia::Pixmap;

use super::colour::Rgb;

/// The typeface's height from the deepest to the highest point of a letter, per size.
const HEIGHT_PER_SIZE: f32 = 1.164;

/// Which side of a text is at the place given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Align {
    /// The text begins there.
    Left,
    /// The text's middle is there.
    Centre,
    /// The text ends there.
    Right,
}

/// How a text looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// Size in pixels.
    pub size: f32,
    /// Bold letters.
    pub bold: bool,
    /// Colour.
    pub colour: Rgb,
}

/// The letters there are.
pub struct Typeface {
    regular: FontRef<'static>,
    bold: FontRef<'static>,
}

impl Typeface {
    /// The built-in typeface.
    pub fn new() -> Self {
        let font = |bytes| FontRef::try_from_slice(bytes).expect("the font in the program is whole");
        Typeface {
            regular: font(include_bytes!("font/DejaVuSans.ttf")),
            bold: font(include_bytes!("font/DejaVuSans-Bold.ttf")),
        }
    }

    /// Width of a text in pixels.
    pub fn width(&self, text: &str, style: Style) -> f32 {
        let font = self.font(style).as_scaled(PxScale::from(style.size * HEIGHT_PER_SIZE));
        text.chars().map(|letter| font.h_advance(font.glyph_id(letter))).sum()
    }

    /// The text, shortened with an ellipsis if it is wider than `width` pixels.
    pub fn fit(&self, text: &str, width: f32, style: Style) -> String {
        let mut fitted = text.to_owned();
        while self.width(&fitted, style) > width && fitted != "…" {
            let kept = fitted.chars().count().saturating_sub(if fitted.ends_with('…') { 2 } else { 1 });
            fitted = fitted.chars().take(kept).collect::<String>() + "…";
        }
        fitted
    }

    /// Draws a text whose baseline runs through `at`.
    pub fn draw(&self, picture: &mut Pixmap, text: &str, at: [f32; 2], align: Align, style: Style) {
        let scale = PxScale::from(style.size * HEIGHT_PER_SIZE);
        let font = self.font(style);
        let width = self.width(text, style);
        let mut x = match align {
            Align::Left => at[0],
            Align::Centre => at[0] - 0.5 * width,
            Align::Right => at[0] - width,
        };
        for letter in text.chars() {
            let id = font.glyph_id(letter);
            if let Some(outline) = font.outline_glyph(id.with_scale_and_position(scale, point(x, at[1].round()))) {
                let corner = outline.px_bounds().min;
                outline.draw(|column, row, cover| {
                    blend(picture, corner.x as i32 + column as i32, corner.y as i32 + row as i32, cover, style.colour);
                });
            }
            x += font.as_scaled(scale).h_advance(id);
        }
    }

    fn font(&self, style: Style) -> &FontRef<'static> {
        if style.bold { &self.bold } else { &self.regular }
    }
}

/// Covers a part of a pixel of an opaque picture.
fn blend(picture: &mut Pixmap, x: i32, y: i32, cover: f32, colour: Rgb) {
    let (width, height) = (picture.width() as i32, picture.height() as i32);
    if (0..width).contains(&x) && (0..height).contains(&y) {
        let start = 4 * (y as usize * width as usize + x as usize);
        let cover = cover.clamp(0.0, 1.0);
        for (byte, ink) in picture.data_mut()[start..start + 3].iter_mut().zip(colour) {
            *byte = (f32::from(*byte) * (1.0 - cover) + 255.0 * ink * cover + 0.5) as u8;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_shortened_to_the_width() {
        let typeface = Typeface::new();
        let style = Style { size: 20.0, bold: false, colour: [0.0; 3] };
        assert_eq!(typeface.fit("short", 500.0, style), "short");
        let fitted = typeface.fit(&"much too long ".repeat(20), 300.0, style);
        assert!(fitted.starts_with("much too long") && fitted.ends_with('…'));
        assert!(typeface.width(&fitted, style) <= 300.0);
    }

    #[test]
    fn letters_leave_ink_above_the_baseline() {
        let mut picture = Pixmap::new(40, 40).unwrap();
        picture.fill(tiny_skia::Color::WHITE);
        let style = Style { size: 30.0, bold: true, colour: [0.0; 3] };
        Typeface::new().draw(&mut picture, "H", [20.0, 30.0], Align::Centre, style);
        let dark = |y: u32| (0..40).filter(|&x| picture.pixel(x, y).unwrap().red() < 128).count();
        assert_eq!(dark(31), 0);
        assert!(dark(20) > 12, "the bar of the H");
    }
}
