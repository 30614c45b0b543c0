//! Curves on paper, as a PNG or an SVG.

use std::path::Path;

use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{Circle, DrawingArea, IntoDrawingArea, IntoFont, PathElement, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, RGBColor, ShapeStyle, TextStyle, WHITE};
use plotters_backend::DrawingBackend;
use tiny_skia::Pixmap;

use super::layout::{Layout, SAMPLE, Texts};
use super::legend::{Pen, pens};
use super::sheet::{FINE, Sheet, TEXT_SCALE};
use super::stroke::{Spot, clipped, dashed, thinned, unbroken};
use crate::postprocess::plot::PlotError;
use crate::postprocess::plot::curve::Curve;
use crate::postprocess::plot::options::PlotOptions;
use crate::postprocess::view::text::Typeface;

const INK: RGBColor = RGBColor(34, 34, 38);
const FAINT: RGBColor = RGBColor(107, 107, 115);
const GRID: RGBColor = RGBColor(228, 228, 231);
const ZERO: RGBColor = RGBColor(170, 170, 176);
const LINE_WIDTH: f64 = 2.0;
/// A curve with fewer points than this shows them, if it is one that does.
const FEW_POINTS: usize = 60;
/// Letters of an SVG, where the viewer has them: widths were measured with the first.
const FAMILY: &str = "DejaVu Sans, Verdana, Arial, sans-serif";

/// The picture's bytes; the suffix of its name tells the kind.
///
/// # Errors
/// When nothing can be drawn, or the suffix is neither `.png` nor `.svg`.
pub fn draw(picture: &Path, curves: &[Curve], texts: &Texts, options: &PlotOptions) -> Result<Vec<u8>, PlotError> {
    let layout = Layout::new(curves, texts, options, &Typeface::new())?;
    let suffix = picture.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let refused = |reason: String| PlotError::Draw { path: picture.to_owned(), reason };
    let (width, height) = options.size;
    match suffix.as_deref() {
        Some("png") => {
            let too_large = || refused("the picture does not fit into memory".to_owned());
            let mut pixels = Pixmap::new(width, height).ok_or_else(too_large)?;
            compose(Sheet::new(&mut pixels).into_drawing_area(), &layout, curves)
                .map_err(|e| refused(e.to_string()))?;
            pixels.encode_png().map_err(|error| refused(error.to_string()))
        }
        Some("svg") => {
            let mut text = String::new();
            let fine = (width * FINE as u32, height * FINE as u32);
            let area = SVGBackend::with_string(&mut text, fine).into_drawing_area();
            compose(area, &layout, curves).map_err(|error| refused(error.to_string()))?;
            let size = |width: u32, height: u32| format!("width=\"{width}\" height=\"{height}\"");
            Ok(text.replacen(&size(fine.0, fine.1), &size(width, height), 1).into_bytes())
        }
        _ => Err(PlotError::option("the picture's name", picture.display().to_string(), "a name with .png or .svg")),
    }
}

type Drawing<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

fn compose<DB: DrawingBackend>(area: DrawingArea<DB, Shift>, layout: &Layout, curves: &[Curve]) -> Drawing<DB> {
    area.fill(&WHITE)?;
    let paper = Paper { area, layout };
    let pens = pens(curves);
    paper.grid()?;
    for (curve, pen) in curves.iter().zip(&pens) {
        paper.curve(curve, pen)?;
    }
    paper.frame()?;
    paper.marks()?;
    paper.legend(&pens)?;
    paper.texts()?;
    paper.area.present()
}

struct Paper<'a, DB: DrawingBackend> {
    area: DrawingArea<DB, Shift>,
    layout: &'a Layout,
}

impl<DB: DrawingBackend> Paper<'_, DB> {
    /// Lines at the marks of the lower and the left axis, or the right one where it is alone, and at zero.
    fn grid(&self) -> Drawing<DB> {
        let Layout { field, marks: [lower, left, right], axes, unit, .. } = self.layout;
        let (marks, axis) = if axes.1.is_some() { (left, &axes.1) } else { (right, &axes.2) };
        let width = unit.max(0.7);
        for (x, _) in lower {
            self.path(&[[*x, field.top], [*x, field.bottom]], shape(GRID, width))?;
        }
        for (y, _) in marks {
            self.path(&[[field.left, *y], [field.right, *y]], shape(GRID, width))?;
        }
        let zero = axis.as_ref().map(|axis| axis.fraction(0.0)).filter(|zero| *zero > 0.0 && *zero < 1.0);
        zero.map_or(Ok(()), |zero| {
            let y = field.bottom + zero * (field.top - field.bottom);
            self.path(&[[field.left, y], [field.right, y]], shape(ZERO, width))
        })
    }

    fn curve(&self, curve: &Curve, pen: &Pen) -> Drawing<DB> {
        let layout = self.layout;
        let spots: Vec<Spot> = curve.x.iter().zip(&curve.y).map(|(&x, &y)| layout.spot(x, y, curve.right)).collect();
        let [red, green, blue] = pen.colour;
        let colour = RGBColor(red, green, blue);
        let width = LINE_WIDTH * layout.unit.max(0.6);
        let pattern: Vec<f64> = pen.pattern.iter().map(|length| length * width).collect();
        let few = curve.points && curve.x.len() <= FEW_POINTS;
        for run in unbroken(&spots) {
            for line in clipped(&thinned(run, 1.0), layout.field) {
                for dash in dashed(&line, &pattern) {
                    self.path(&dash, shape(colour, width))?;
                }
            }
            for &spot in run.iter().filter(|spot| few || run.len() == 1 && inside(layout, spot)) {
                if inside(layout, &spot) {
                    self.dot(spot, 1.6 * width, colour)?;
                }
            }
        }
        Ok(())
    }

    fn frame(&self) -> Drawing<DB> {
        let (field, unit) = (self.layout.field, self.layout.unit.max(0.7));
        let pen = shape(INK, 1.2 * unit);
        let corners = [field.left, field.right].map(|x| [[x, field.top], [x, field.bottom]]);
        self.path(&[[field.left, field.bottom], [field.right, field.bottom]], pen)?;
        if self.layout.axes.1.is_some() {
            self.path(&corners[0], pen)?;
        }
        if self.layout.axes.2.is_some() {
            self.path(&corners[1], pen)?;
        }
        Ok(())
    }

    fn marks(&self) -> Drawing<DB> {
        let (field, unit) = (self.layout.field, self.layout.unit);
        let size = self.layout.letters.mark;
        let pen = shape(INK, 1.2 * unit.max(0.7));
        let [lower, left, right] = &self.layout.marks;
        for (x, text) in lower {
            self.path(&[[*x, field.bottom], [*x, field.bottom + 5.0 * unit]], pen)?;
            self.text(text, [*x, field.bottom + 5.0 * unit + 0.9 * size], HPos::Center, size, false, INK)?;
        }
        for (y, text) in left {
            self.path(&[[field.left - 5.0 * unit, *y], [field.left, *y]], pen)?;
            self.text(text, [field.left - 10.0 * unit, *y], HPos::Right, size, false, INK)?;
        }
        for (y, text) in right {
            self.path(&[[field.right, *y], [field.right + 5.0 * unit, *y]], pen)?;
            self.text(text, [field.right + 10.0 * unit, *y], HPos::Left, size, false, INK)?;
        }
        Ok(())
    }

    fn legend(&self, pens: &[Pen]) -> Drawing<DB> {
        let layout = self.layout;
        let width = LINE_WIDTH * layout.unit.max(0.6);
        for (([x, y], text), pen) in layout.legend.iter().zip(pens) {
            let [red, green, blue] = pen.colour;
            let pattern: Vec<f64> = pen.pattern.iter().map(|length| length * width).collect();
            for dash in dashed(&[[*x, *y], [x + SAMPLE * layout.unit, *y]], &pattern) {
                self.path(&dash, shape(RGBColor(red, green, blue), 1.3 * width))?;
            }
            let at = [x + (SAMPLE + 8.0) * layout.unit, *y];
            self.text(text, at, HPos::Left, layout.letters.text, false, INK)?;
        }
        match &layout.more {
            Some((at, text)) => self.text(text, *at, HPos::Left, layout.letters.text, false, FAINT),
            None => Ok(()),
        }
    }

    fn texts(&self) -> Drawing<DB> {
        let Layout { field, texts, letters, head, unit, .. } = self.layout;
        let (width, height) = self.area.dim_in_pixel();
        let (width, height) = (f64::from(width) / FINE, f64::from(height) / FINE);
        let edge = 26.0 * unit;
        self.text(&texts.title, [edge, edge + 0.5 * letters.title], HPos::Left, letters.title, true, INK)?;
        self.text(&texts.left, [edge, *head], HPos::Left, letters.text, true, INK)?;
        self.text(&texts.right, [width - edge, *head], HPos::Right, letters.text, true, INK)?;
        let below = field.bottom + 1.9 * letters.mark + 0.8 * letters.text;
        self.text(&texts.below, [0.5 * (field.left + field.right), below], HPos::Center, letters.text, true, INK)?;
        let corner = [width - edge, height - edge];
        self.text(&texts.origin, corner, HPos::Right, letters.small, false, FAINT)
    }

    fn path(&self, spots: &[Spot], style: ShapeStyle) -> Drawing<DB> {
        let fine: Vec<(i32, i32)> = spots.iter().map(fine).collect();
        self.area.draw(&PathElement::new(fine, style))
    }

    fn dot(&self, spot: Spot, radius: f64, colour: RGBColor) -> Drawing<DB> {
        self.area.draw(&Circle::new(fine(&spot), (FINE * radius).round() as i32, shape(colour, 1.0).filled()))
    }

    fn text(&self, text: &str, at: Spot, side: HPos, size: f64, bold: bool, colour: RGBColor) -> Drawing<DB> {
        if text.is_empty() {
            return Ok(());
        }
        let style = if bold { FontStyle::Bold } else { FontStyle::Normal };
        let font = (FAMILY, FINE * TEXT_SCALE * size, style).into_font();
        let style = TextStyle::from(font).color(&colour).pos(Pos::new(side, VPos::Center));
        self.area.draw_text(text, &style, fine(&at))
    }
}

fn fine([x, y]: &Spot) -> (i32, i32) {
    ((FINE * x).round() as i32, (FINE * y).round() as i32)
}

fn shape(colour: RGBColor, width: f64) -> ShapeStyle {
    ShapeStyle::from(&colour).stroke_width((FINE * width).round().max(1.0) as u32)
}

fn inside(layout: &Layout, [x, y]: &Spot) -> bool {
    let field = layout.field;
    (field.left..=field.right).contains(x) && (field.top..=field.bottom).contains(y)
}
