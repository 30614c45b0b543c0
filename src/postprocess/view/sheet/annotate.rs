//! What stands around the body: caption, colour bar, triad of axes.

use tiny_skia::{FillRule, LineCap, Paint, PathBuilder, Pixmap, Rect, Stroke, Transform};

use crate::postprocess::view::camera::{Axes, Rectangle};
use crate::postprocess::view::colour::{ColourMap, NO_VALUE, Rgb};
use crate::postprocess::view::numbers::{number, ticks};
use crate::postprocess::view::text::{Align, Style, Typeface};

const INK: Rgb = [0.13, 0.13, 0.15];
const FAINT: Rgb = [0.42, 0.42, 0.45];
/// Colours of the axes x, y, z.
pub const AXIS_COLOURS: [Rgb; 3] = [[0.78, 0.16, 0.16], [0.13, 0.55, 0.20], [0.14, 0.32, 0.78]];

/// The texts of a picture, and what its colours mean.
pub struct Notes {
    /// First line, in bold.
    pub title: String,
    /// Second line: variable, time, state.
    pub subtitle: String,
    /// Third line, fainter: what the picture does to the body.
    pub remarks: String,
    /// Lower right corner.
    pub origin: String,
    /// What the colours mean.
    pub key: Key,
    /// The body is a section turned about its y axis, which points up.
    pub turned: bool,
}

/// What the colours mean.
pub enum Key {
    /// A colour bar.
    Bar {
        /// The variable.
        label: String,
        /// Values at the ends of the bar.
        range: (f64, f64),
        /// Smallest and largest value on the surface, if it has any.
        extremes: Option<(f64, f64)>,
        /// Some of the surface has no value.
        gaps: bool,
    },
    /// Colours and what each stands for.
    Names(Vec<(Rgb, String)>),
}

/// Places and sizes, which all follow the picture's.
pub struct Layout {
    width: f32,
    height: f32,
    /// Pixels per pixel of a picture of 1200 by 900.
    unit: f32,
}

impl Layout {
    /// The layout of a picture of this size.
    pub fn new((width, height): (u32, u32)) -> Self {
        let (width, height) = (width as f32, height as f32);
        Layout { width, height, unit: (width / 1200.0).min(height / 900.0) }
    }

    /// Pixels per pixel of a picture of 1200 by 900.
    pub fn unit(&self) -> f64 {
        f64::from(self.unit)
    }

    /// Where the body is drawn.
    pub fn body(&self) -> Rectangle {
        let [left, _, right, bottom] = [130.0, 128.0, 215.0, 60.0].map(|margin| f64::from(margin * self.unit));
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let right = width - right.max(f64::from(self.beside()) + GAP * f64::from(self.unit).max(0.5));
        let bottom = bottom.max(f64::from(1.8 * self.letters(12.5)));
        let top = f64::from(self.below_caption()).max(f64::from(128.0 * self.unit));
        // On the smallest pictures the triad stands in the body's corner rather than beside it.
        let left = left.min(0.15 * width);
        Rectangle { left, top, right: right.max(left + 1.0), bottom: (height - bottom).max(top + 1.0) }
    }

    /// A size of letters as drawn: below nine pixels nobody can read them, however small the picture is.
    fn letters(&self, size: f32) -> f32 {
        (size * self.unit).max(9.0)
    }

    /// Baselines of the caption's lines: as planned, or as far apart as their letters need.
    fn caption(&self) -> [f32; 3] {
        let mut last = 0.0f32;
        CAPTION.map(|(baseline, size, _)| {
            last = (baseline * self.unit).max(last + 1.3 * self.letters(size));
            last
        })
    }

    fn below_caption(&self) -> f32 {
        self.caption()[2] + 0.6 * self.letters(CAPTION[2].1)
    }

    /// Width from the left edge of the colour bar to the right edge of the picture.
    fn beside(&self) -> f32 {
        let mark = (BAR.3 + 11.0) * self.unit + 6.2 * self.letters(15.5);
        // "min −1.234E+05" is the longest text there.
        (BAR.0 * self.unit).max(mark).max(9.0 * self.letters(14.5))
    }
}

/// Draws everything that stands around the body.
pub fn annotate(picture: &mut Pixmap, layout: &Layout, notes: &Notes, axes: &Axes, map: &ColourMap) {
    let mut sheet = Sheet { picture, layout, typeface: Typeface::new() };
    sheet.caption(notes);
    match &notes.key {
        Key::Bar { label, range, extremes, gaps } => {
            sheet.bar(label, *range, map);
            sheet.extremes(*extremes, *gaps);
        }
        Key::Names(names) => sheet.names(names),
    }
    sheet.triad(axes, notes.turned);
}

/// Writes the first of some texts that fits into a width in the middle of a place; the last one is shortened.
pub fn label(picture: &mut Pixmap, layout: &Layout, texts: &[String], [x, y]: [f64; 2], width: f64) {
    let sheet = Sheet { picture, layout, typeface: Typeface::new() };
    let style = sheet.style(15.0, false, INK);
    let fits = |text: &&String| sheet.typeface.width(text, style) <= width as f32;
    let text = texts.iter().find(fits).or(texts.last()).map_or("", String::as_str);
    let text = sheet.typeface.fit(text, width as f32, style);
    sheet.typeface.draw(sheet.picture, &text, [x as f32, y as f32], Align::Centre, style);
}

/// Room between the body and what stands beside it, in pixels of a picture of 1200 by 900.
const GAP: f64 = 14.0;

/// Pixels per pixel of a picture of 1200 by 900 below which there is no room for the axes.
const SMALLEST_TRIAD: f32 = 0.33;

/// Lines of the caption: baseline, size of letters, bold.
const CAPTION: [(f32, f32, bool); 3] = [(52.0, 23.0, true), (84.0, 17.5, false), (110.0, 14.5, false)];

/// Left edge, upper and lower end of the colour bar, and its width: pixels of a picture of 1200 by 900, the first from
/// the right edge, the lower end from the lower edge.
const BAR: (f32, f32, f32, f32) = (165.0, 200.0, 200.0, 24.0);

/// A picture being annotated. Places are given in pixels of a picture of 1200 by 900.
struct Sheet<'a> {
    picture: &'a mut Pixmap,
    layout: &'a Layout,
    typeface: Typeface,
}

impl Sheet<'_> {
    fn style(&self, size: f32, bold: bool, colour: Rgb) -> Style {
        Style { size: self.layout.letters(size), bold, colour }
    }

    fn write(&mut self, text: &str, at: [f32; 2], align: Align, style: Style) {
        self.typeface.draw(self.picture, text, at, align, style);
    }

    fn caption(&mut self, notes: &Notes) {
        let unit = self.layout.unit;
        let (left, room) = (36.0 * unit, self.layout.width - 72.0 * unit);
        let texts = [&notes.title, &notes.subtitle, &notes.remarks];
        for ((text, baseline), (_, size, bold)) in texts.into_iter().zip(self.layout.caption()).zip(CAPTION) {
            let style = self.style(size, bold, if size < 15.0 { FAINT } else { INK });
            let text = self.typeface.fit(text, room, style);
            self.write(&text, [left, baseline], Align::Left, style);
        }
        let style = self.style(12.5, false, FAINT);
        let origin = self.typeface.fit(&notes.origin, 0.6 * room, style);
        let baseline = self.layout.height - (24.0 * unit).max(4.0);
        self.write(&origin, [self.layout.width - left, baseline], Align::Right, style);
    }

    /// Left, top, right and bottom of the colour bar on whole pixels.
    fn bar_place(&self) -> [f32; 4] {
        let (_, top, bottom, width) = BAR;
        let layout = self.layout;
        let unit = layout.unit;
        let left = layout.width - layout.beside();
        // Label and largest value above it, least value, gaps and the origin below it.
        let above = layout.below_caption() + 1.3 * layout.letters(18.0) + 1.5 * layout.letters(14.5);
        let below = 3.4 * layout.letters(14.5) + 1.5 * layout.letters(12.5);
        let (top, bottom) = ((top * unit).max(above), layout.height - (bottom * unit).max(below));
        [left, top, left + width * unit, bottom.max(top + 1.0)].map(f32::round)
    }

    fn bar(&mut self, label: &str, (low, high): (f64, f64), map: &ColourMap) {
        let [left, top, right, bottom] = self.bar_place();
        let unit = self.layout.unit;
        for row in top as u32..bottom as u32 {
            let colour = map.at((bottom - row as f32 - 0.5) / (bottom - top));
            self.rectangle([left, row as f32, right, row as f32 + 1.0], colour);
        }
        self.frame([left, top, right, bottom]);
        let style = self.style(18.0, true, INK);
        let label = self.typeface.fit(label, self.layout.width - left - 12.0 * unit, style);
        let value = self.layout.letters(14.5);
        self.write(&label, [left, top - (40.0 * unit).max(1.7 * value)], Align::Left, style);
        let style = self.style(15.5, false, INK);
        let wanted = (((bottom - top) / (2.0 * style.size)) as usize).clamp(1, 7);
        for (value, text) in ticks(low, high, wanted) {
            let y = bottom - ((value - low) / (high - low)) as f32 * (bottom - top);
            self.line([right, y], [right + 6.0 * unit, y], 1.2 * unit, INK);
            self.write(&text, [right + 11.0 * unit, y + 0.36 * style.size], Align::Left, style);
        }
    }

    /// The values that occur, above and below the bar.
    fn extremes(&mut self, extremes: Option<(f64, f64)>, gaps: bool) {
        let [left, top, _, bottom] = self.bar_place();
        let unit = self.layout.unit;
        let style = self.style(14.5, false, FAINT);
        if let Some((low, high)) = extremes {
            let room = self.layout.width - left - 2.0;
            let [high, low] = [("max", high), ("min", low)]
                .map(|(what, value)| self.typeface.fit(&format!("{what} {}", number(value)), room, style));
            self.write(&high, [left, top - (14.0 * unit).max(0.4 * style.size)], Align::Left, style);
            self.write(&low, [left, bottom + (26.0 * unit).max(1.3 * style.size)], Align::Left, style);
        }
        if gaps {
            let y = bottom + (44.0 * unit).max(1.9 * style.size);
            self.swatch([left, y], NO_VALUE, "no value", style);
        }
    }

    fn names(&mut self, names: &[(Rgb, String)]) {
        let [left, top, _, bottom] = self.bar_place();
        let style = self.style(15.5, false, INK);
        let pitch = 1.9 * style.size;
        let places = (((bottom - top) / pitch) as usize).max(1);
        for (place, (colour, name)) in names.iter().take(places).enumerate() {
            let y = top + place as f32 * pitch;
            self.swatch([left, y], *colour, name, style);
        }
        if names.len() > places {
            let text = format!("and {} more", names.len() - places);
            self.write(&text, [left, top + (places as f32 + 0.7) * pitch], Align::Left, style);
        }
    }

    /// A field of colour and what it stands for.
    fn swatch(&mut self, [left, top]: [f32; 2], colour: Rgb, text: &str, style: Style) {
        let side = 1.1 * style.size;
        self.rectangle([left, top, left + side, top + side], colour);
        self.frame([left, top, left + side, top + side]);
        let text = self.typeface.fit(text, self.layout.width - left - 2.2 * side, style);
        self.write(&text, [left + 1.6 * side, top + 0.9 * style.size], Align::Left, style);
    }

    /// The directions of x, y and z; those that point at the viewer are drawn last.
    /// The axes; of a turned body its own, radius and axis.
    fn triad(&mut self, axes: &Axes, turned: bool) {
        if self.layout.unit < SMALLEST_TRIAD {
            return;
        }
        // Its names need their room, however small the picture is.
        let unit = self.layout.unit.max(1.5 * SMALLEST_TRIAD);
        let origin = [88.0 * unit, self.layout.height - 88.0 * unit];
        let style = self.style(15.0, true, INK);
        let shown: &[(usize, usize)] = if turned { &[(0, 0), (1, 2)] } else { &[(0, 0), (1, 1), (2, 2)] };
        let unit_vector = |along: usize| [0, 1, 2].map(|i| f64::from(u8::from(i == along)));
        let mut arms: Vec<(usize, [f64; 3])> =
            shown.iter().map(|&(axis, along)| (axis, axes.turn(unit_vector(along)))).collect();
        arms.sort_by(|a, b| a.1[2].total_cmp(&b.1[2]));
        for (axis, [right, up, _]) in arms {
            let (right, up) = (right as f32, up as f32);
            // An axis along the line of sight is a dot without a name: nothing to point at.
            let length = right.hypot(up);
            let at = |reach: f32| [origin[0] + reach * unit * right, origin[1] - reach * unit * up];
            let colour = AXIS_COLOURS[axis];
            if length < 0.05 {
                self.disc(origin, 3.5 * unit, colour);
                continue;
            }
            self.line(origin, at(38.0), 2.6 * unit, colour);
            self.arrow_head(at(46.0), [right / length, -up / length], unit * (6.0 + 4.0 * length), colour);
            let beyond = 46.0 + 13.0 / length.max(0.35);
            let [x, y] = at(beyond);
            let name = ["x", "y", "z"][axis];
            self.write(name, [x, y + 0.33 * style.size], Align::Centre, Style { colour, ..style });
        }
        self.disc(origin, 2.6 * unit, INK);
    }

    fn arrow_head(&mut self, tip: [f32; 2], along: [f32; 2], length: f32, colour: Rgb) {
        let at = |back: f32, aside: f32| {
            (
                tip[0] - back * length * along[0] - aside * length * along[1],
                tip[1] - back * length * along[1] + aside * length * along[0],
            )
        };
        let mut path = PathBuilder::new();
        let (start, left, right) = (at(0.0, 0.0), at(1.0, 0.42), at(1.0, -0.42));
        path.move_to(start.0, start.1);
        path.line_to(left.0, left.1);
        path.line_to(right.0, right.1);
        path.close();
        self.fill(path, colour);
    }

    fn disc(&mut self, at: [f32; 2], radius: f32, colour: Rgb) {
        let mut path = PathBuilder::new();
        path.push_circle(at[0], at[1], radius);
        self.fill(path, colour);
    }

    fn fill(&mut self, path: PathBuilder, colour: Rgb) {
        if let Some(path) = path.finish() {
            self.picture.fill_path(&path, &ink(colour), FillRule::Winding, Transform::identity(), None);
        }
    }

    fn line(&mut self, from: [f32; 2], to: [f32; 2], width: f32, colour: Rgb) {
        let mut path = PathBuilder::new();
        path.move_to(from[0], from[1]);
        path.line_to(to[0], to[1]);
        if let Some(path) = path.finish() {
            let stroke = Stroke { width, line_cap: LineCap::Butt, ..Stroke::default() };
            self.picture.stroke_path(&path, &ink(colour), &stroke, Transform::identity(), None);
        }
    }

    fn rectangle(&mut self, [left, top, right, bottom]: [f32; 4], colour: Rgb) {
        if let Some(rectangle) = Rect::from_ltrb(left, top, right, bottom) {
            self.picture.fill_rect(rectangle, &ink(colour), Transform::identity(), None);
        }
    }

    fn frame(&mut self, [left, top, right, bottom]: [f32; 4]) {
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        for (i, &corner) in corners.iter().enumerate() {
            self.line(corner, corners[(i + 1) % 4], 1.2 * self.layout.unit, INK);
        }
    }
}

fn ink(colour: Rgb) -> Paint<'static> {
    let [red, green, blue] = colour.map(|channel| (255.0 * channel + 0.5) as u8);
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, 255);
    paint
}
