//! Paper for the plotting library: it draws in tenths of a pixel, onto a PNG with smooth edges and the program's own
//! letters.

use std::convert::Infallible;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontStyle,
};
use tiny_skia::{FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform};

use crate::postprocess::view::text::{Align, Style, Typeface};

/// The library's whole numbers to a pixel.
pub const FINE: f64 = 10.0;
/// The library's SVG divides the sizes of letters by this; so does this paper, that both look alike.
pub const TEXT_SCALE: f64 = 1.24;
type Outcome = Result<(), DrawingErrorKind<Infallible>>;

/// A picture that the library draws on.
pub struct Sheet<'a> {
    picture: &'a mut Pixmap,
    typeface: Typeface,
}

impl<'a> Sheet<'a> {
    /// Paper of a picture's size.
    pub fn new(picture: &'a mut Pixmap) -> Self {
        Sheet { picture, typeface: Typeface::new() }
    }

    fn stroke(&mut self, spots: impl IntoIterator<Item = BackendCoord>, style: &impl BackendStyle) {
        let mut path = PathBuilder::new();
        for (place, (x, y)) in spots.into_iter().map(pixels).enumerate() {
            if place == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        let width = style.stroke_width() as f32 / FINE as f32;
        let stroke = Stroke { width, line_join: LineJoin::Round, line_cap: LineCap::Butt, ..Stroke::default() };
        if let Some(path) = path.finish() {
            self.picture.stroke_path(&path, &ink(style.color()), &stroke, Transform::identity(), None);
        }
    }

    fn fill(&mut self, path: PathBuilder, colour: BackendColor) {
        if let Some(path) = path.finish() {
            self.picture.fill_path(&path, &ink(colour), FillRule::Winding, Transform::identity(), None);
        }
    }
}

impl DrawingBackend for Sheet<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (self.picture.width() * FINE as u32, self.picture.height() * FINE as u32)
    }

    fn ensure_prepared(&mut self) -> Outcome {
        Ok(())
    }

    fn present(&mut self) -> Outcome {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, colour: BackendColor) -> Outcome {
        self.draw_rect(at, (at.0 + 1, at.1 + 1), &colour, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Outcome {
        self.stroke([from, to], style);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Outcome {
        self.stroke(path, style);
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S, fill: bool) -> Outcome {
        let corners = [a, (b.0, a.1), b, (a.0, b.1), a];
        if fill { self.fill_polygon(corners, style) } else { self.draw_path(corners, style) }
    }

    fn draw_circle<S: BackendStyle>(&mut self, centre: BackendCoord, radius: u32, style: &S, _: bool) -> Outcome {
        let ((x, y), radius) = (pixels(centre), radius as f32 / FINE as f32);
        let mut path = PathBuilder::new();
        path.push_circle(x, y, radius);
        self.fill(path, style.color());
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Outcome {
        let mut path = PathBuilder::new();
        for (place, (x, y)) in corners.into_iter().map(pixels).enumerate() {
            if place == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        self.fill(path, style.color());
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Outcome {
        let (x, y) = pixels(at);
        let size = (style.size() / TEXT_SCALE / FINE) as f32;
        let align = match style.anchor().h_pos {
            HPos::Left => Align::Left,
            HPos::Center => Align::Centre,
            HPos::Right => Align::Right,
        };
        // Capitals of this typeface are 0.73 of the size high.
        let drop = match style.anchor().v_pos {
            VPos::Top => 0.76 * size,
            VPos::Center => 0.36 * size,
            VPos::Bottom => 0.0,
        };
        let (red, green, blue) = style.color().rgb;
        let colour = [red, green, blue].map(|channel| f32::from(channel) / 255.0);
        let style = Style { size, bold: matches!(style.style(), FontStyle::Bold), colour };
        self.typeface.draw(self.picture, text, [x, y + drop], align, style);
        Ok(())
    }
}

fn pixels((x, y): BackendCoord) -> (f32, f32) {
    (x as f32 / FINE as f32, y as f32 / FINE as f32)
}

fn ink(colour: BackendColor) -> Paint<'static> {
    let (red, green, blue) = colour.rgb;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, (255.0 * colour.alpha).round() as u8);
    paint
}
