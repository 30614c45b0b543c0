//! Pictures of results: the deformed outer surface of the body, coloured by a variable, as a PNG; many states as
//! numbered PNGs or one moving GIF.
//!
//! Data flows one way: a results file and [`ViewOptions`] become a `scene` (`subject`, `skin`, `section`, `field`); a
//! `camera` and a `raster` (in `paint`) turn it into pixels; `arrows` are drawn on it; `annotate` writes around it what it
//! shows. `film` and `row` show many states.

mod body;
mod error;
mod options;
mod paint;
mod sheet;

use crate::common::files;
use std::path::{Path, PathBuf};

pub use error::ViewError;
pub use options::{Direction, MapChoice, StateChoice, ViewOptions};
pub use sheet::film::draw_many;
pub use sheet::row::{draw_row, picture_of_row};

use body::{field, scene, subject};
use paint::{camera, colour, lines, palette, raster};
pub(crate) use paint::{numbers, text};
use sheet::{annotate, arrows, planes};

use annotate::{Key, Layout, Notes, annotate};
use camera::{Axes, Bounds, Camera};
use colour::{BLOCK_COLOURS, ColourMap, STATUS_COLOURS};
use field::{Field, Place};
use lines::Pen;
use planes::Patch;
use raster::Paint;
use scene::{Scene, Values};
use subject::{Shot, Subject};
use tiny_skia::{Color, Pixmap};

/// Share of the larger side of zero below which the smaller one does not make a field signed.
const TRACE: f64 = 0.05;

/// What the status of contact stands for.
const STATUS_NAMES: [&str; 3] = ["free", "pushed", "touches a face"];

/// What a picture shows, for the line that is printed about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// The picture.
    pub path: PathBuf,
    /// The variable as it is called in the picture; `None` if blocks are shown.
    pub variable: Option<String>,
    /// The state drawn, counted from 1; `None` if it is the mesh alone.
    pub state: Option<usize>,
    /// Its time.
    pub time: Option<f64>,
    /// Smallest and largest value on the surface, in the variable's unit.
    pub extremes: Option<(f64, f64)>,
    /// Number of element faces drawn, reflections included.
    pub faces: usize,
    /// Number of faces that could not be drawn because their coordinates are not finite.
    pub dropped: usize,
}

/// Draws one state of a results file into a PNG.
///
/// # Errors
/// [`ViewError`], when the file cannot be read, lacks the variable, state or block asked for, an option cannot be
/// used, or the picture cannot be written.
pub fn draw(results: &Path, path: &Path, options: &ViewOptions) -> Result<Summary, ViewError> {
    let (bytes, summary) = picture(results, options)?;
    write(path, &bytes)?;
    Ok(Summary { path: path.to_owned(), ..summary })
}

/// The same as the bytes of a PNG; the summary has no path.
///
/// # Errors
/// As [`draw`].
pub fn picture(results: &Path, options: &ViewOptions) -> Result<(Vec<u8>, Summary), ViewError> {
    options.check()?;
    let subject = Subject::open(results, options)?;
    let state = subject.state(options.state)?;
    let shot = subject.shot(state)?;
    let studio = Studio::new(&subject, options, Survey::of(&shot.scene, &Axes::new(subject.from())).of_all(&subject)?);
    let image = studio.picture(&shot, state)?;
    let unnamed = Path::new("");
    Ok((png(&image, unnamed)?, studio.summary(unnamed, &shot, state)))
}

/// Everything that the pictures of a film have in common.
struct Studio<'a> {
    subject: &'a Subject<'a>,
    options: &'a ViewOptions,
    layout: Layout,
    camera: Camera,
    map: ColourMap,
    range: (f64, f64),
    /// Length of the longest vector that arrows show.
    longest: f64,
    /// Rigid planes.
    patches: Vec<Patch>,
    /// The box around body and planes as the eye sees it.
    bounds: Bounds,
}

/// Where one or several scenes are, and their values.
struct Survey {
    /// The box around them as the eye sees it.
    seen: Bounds,
    /// The box around them along the axes.
    body: Bounds,
    /// The smallest and the largest value.
    extremes: Option<(f64, f64)>,
}

impl Survey {
    /// Of nothing.
    const NOTHING: Survey = Survey { seen: Bounds::EMPTY, body: Bounds::EMPTY, extremes: None };

    fn of(scene: &Scene, axes: &Axes) -> Survey {
        let mut survey = Survey { extremes: scene.extremes(), ..Survey::NOTHING };
        for node in scene.drawn_nodes() {
            survey.seen.include(axes.turn(scene.positions[node]));
            survey.body.include(scene.positions[node]);
        }
        survey
    }

    /// Itself, if there is anything to be seen.
    fn of_all(self, subject: &Subject) -> Result<Survey, ViewError> {
        match self.body == Bounds::EMPTY {
            true => Err(subject.nothing("no element is in the region and fulfils the conditions asked for")),
            false => Ok(self),
        }
    }

    fn and(mut self, other: Survey) -> Survey {
        self.seen.join(other.seen);
        self.body.join(other.body);
        self.extremes = match (self.extremes, other.extremes) {
            (Some((low, high)), Some((l, h))) => Some((low.min(l), high.max(h))),
            (known, new) => known.or(new),
        };
        self
    }
}

impl<'a> Studio<'a> {
    fn new(subject: &'a Subject<'a>, options: &'a ViewOptions, survey: Survey) -> Self {
        let layout = Layout::new(options.size);
        let axes = Axes::new(subject.from());
        let Survey { seen: mut bounds, body, extremes } = survey;
        let patches = planes::patches(&subject.planes_told(), body, &axes);
        patches.iter().flat_map(|patch| patch.corners).for_each(|corner| bounds.include(axes.turn(corner)));
        let room = if options.arrows.is_some() { arrows::room(layout.body(), layout.unit()) } else { layout.body() };
        let camera = Camera::fit(axes, bounds, room);
        let is_status = subject.field.as_ref().is_some_and(Field::is_status);
        let signed = is_signed(options, options.range.or(extremes));
        let found = || match (spread(extremes.unwrap_or((0.0, 0.0))), signed) {
            ((low, high), true) => (-low.abs().max(high.abs()), low.abs().max(high.abs())),
            (range, false) => range,
        };
        let range = options.range.unwrap_or_else(found);
        let (map, range) = match (is_status, signed) {
            (true, _) => (ColourMap::steps(&STATUS_COLOURS), (-0.5, 2.5)),
            (_, true) => (ColourMap::diverging(range), range),
            _ => (ColourMap::sequential(), range),
        };
        Studio { subject, options, layout, camera, map, range, longest: 0.0, patches, bounds }
    }

    /// White paper of the size asked for.
    fn paper(&self) -> Result<Pixmap, ViewError> {
        let (width, height) = self.options.size;
        let mut picture = Pixmap::new(width, height).ok_or_else(|| too_large(self.options.size))?;
        picture.fill(Color::WHITE);
        Ok(picture)
    }

    /// Paints the body and its arrows.
    fn paint(&self, picture: &mut Pixmap, shot: &Shot) {
        let unit = self.layout.unit();
        let pen = Pen { mesh: self.options.edges, scale: unit.max(0.7) };
        let paint = Paint { camera: &self.camera, map: &self.map, range: self.range, pen };
        planes::draw_behind(picture, &self.patches, &self.camera, unit.max(0.5));
        raster::paint(picture, &shot.scene, &paint);
        planes::draw_before(picture, &self.patches, &self.camera, unit.max(0.5));
        arrows::draw(picture, &shot.scene, &self.camera, self.most(shot), self.arrow_unit());
    }

    /// Pixels per pixel of a picture of 1200 by 900 in arrows: the longest fits into the room around the body.
    fn arrow_unit(&self) -> f64 {
        let (all, body) = (self.layout.body(), arrows::room(self.layout.body(), self.layout.unit()));
        ((body.left - all.left).min(body.top - all.top) / arrows::LONGEST).max(0.2)
    }

    /// The longest vector of a scene, or of all of them.
    fn most(&self, shot: &Shot) -> f64 {
        if self.longest > 0.0 { self.longest } else { arrows::longest(&shot.scene) }
    }

    fn picture(&self, shot: &Shot, state: Option<usize>) -> Result<Pixmap, ViewError> {
        let mut picture = self.paper()?;
        self.paint(&mut picture, shot);
        annotate(&mut picture, &self.layout, &self.notes(&[(shot, state)]), self.camera.axes(), &self.map);
        Ok(picture)
    }

    /// What is written around one or several states.
    fn notes(&self, shown: &[(&Shot, Option<usize>)]) -> Notes {
        let subject = self.subject;
        let field = subject.field.as_ref();
        let place = |place| if place == Place::Nodes { "at nodes" } else { "in elements" };
        let mut said: Vec<String> = field.iter().map(|f| format!("{} {}", f.label, place(f.place))).collect();
        match shown {
            [(_, Some(state))] => {
                said.push(format!("time {}", numbers::number(subject.times()[*state])));
                said.push(format!("state {} of {}", state + 1, subject.times().len()));
            }
            [(_, None)] => said.push("mesh before the run".to_owned()),
            several => said.push(format!("{} states by their times", several.len())),
        }
        let key = match field {
            Some(field) if field.is_status() => {
                Key::Names(STATUS_COLOURS.into_iter().zip(STATUS_NAMES.map(str::to_owned)).collect())
            }
            Some(field) => {
                let all = shown.iter().filter_map(|(shot, _)| shot.scene.extremes());
                let extremes = all.reduce(|(low, high), (l, h)| (low.min(l), high.max(h)));
                let gaps = shown.iter().any(|(shot, _)| has_gaps(&shot.scene));
                Key::Bar { label: field.label.clone(), range: self.range, extremes, gaps }
            }
            None => {
                let colour = |block: usize| BLOCK_COLOURS[block % BLOCK_COLOURS.len()];
                Key::Names(subject.blocks().into_iter().map(|(block, name)| (colour(block), name)).collect())
            }
        };
        let title = if subject.title().is_empty() { file_name(subject.path()) } else { subject.title().to_owned() };
        let origin = format!("urto {} · {}", env!("CARGO_PKG_VERSION"), file_name(subject.path()));
        Notes {
            title,
            subtitle: said.join("  ·  "),
            remarks: self.remarks(shown),
            origin,
            key,
            turned: subject.turned(),
        }
    }

    /// What the picture does to the body, so that nobody takes it for the body itself.
    fn remarks(&self, shown: &[(&Shot, Option<usize>)]) -> String {
        let options = self.options;
        let mut remarks = Vec::new();
        if let (Some(stem), Some((shot, Some(_)))) = (&options.arrows, shown.first()) {
            remarks.push(format!("longest arrow: |{}| = {}", stem.to_uppercase(), numbers::number(self.most(shot))));
        }
        if options.magnify != 1.0 && shown.iter().any(|(_, state)| state.is_some()) {
            remarks.push(format!("displacements × {}", options.magnify));
        }
        let plane = |axis: usize, place: f64| format!("{} = {place}", ["x", "y", "z"][axis]);
        let planes: Vec<String> =
            options.mirror.iter().enumerate().filter_map(|(axis, place)| Some(plane(axis, (*place)?))).collect();
        if !planes.is_empty() {
            remarks.push(format!("mirrored in {}", planes.join(", ")));
        }
        if let Some(angle) = options.revolve {
            remarks.push(format!("turned by {angle} degrees about its axis"));
        }
        if !options.cuts.is_empty() {
            let cuts: Vec<String> = options.cuts.iter().map(|&(axis, place)| plane(axis, place)).collect();
            remarks.push(format!("cut at {}", cuts.join(", ")));
        }
        remarks.extend(options.region.iter().zip(["x", "y", "z"]).filter_map(|(ends, axis)| between(axis, (*ends)?)));
        remarks.extend(options.criteria.iter().filter_map(|(name, ends)| between(&name.to_uppercase(), *ends)));
        if !options.blocks.is_empty() {
            let ids: Vec<String> = options.blocks.iter().map(i64::to_string).collect();
            remarks.push(format!("block {} only", ids.join(", ")));
        }
        if !options.hide.is_empty() {
            let ids: Vec<String> = options.hide.iter().map(i64::to_string).collect();
            remarks.push(format!("without block {}", ids.join(", ")));
        }
        if !self.patches.is_empty() {
            let mut sets: Vec<i64> = self.patches.iter().map(|patch| patch.side_set).collect();
            sets.sort_unstable();
            sets.dedup();
            let sets: Vec<String> = sets.iter().map(i64::to_string).collect();
            remarks.push(format!("grey: rigid surface of side set {}", sets.join(", ")));
        }
        if options.thickness {
            remarks.push("shells as thick as they are".to_owned());
        }
        let dropped: usize = shown.iter().map(|(shot, _)| shot.dropped).sum();
        if dropped > 0 {
            remarks.push(format!("{dropped} faces without finite coordinates are not drawn"));
        }
        remarks.join("  ·  ")
    }

    fn summary(&self, path: &Path, shot: &Shot, state: Option<usize>) -> Summary {
        Summary {
            path: path.to_owned(),
            variable: self.subject.field.as_ref().map(|field| field.label.clone()),
            state: state.map(|state| state + 1),
            time: state.map(|state| self.subject.times()[state]),
            extremes: shot.scene.extremes(),
            faces: shot.scene.quads.len(),
            dropped: shot.dropped,
        }
    }
}

/// Whether values between these ends are to be seen as of both signs: where the smaller side is not a mere trace.
fn is_signed(options: &ViewOptions, ends: Option<(f64, f64)>) -> bool {
    match (options.map, ends) {
        (MapChoice::Diverging, _) => true,
        (MapChoice::Suited, Some((low, high))) => {
            low < 0.0 && high > 0.0 && low.abs().min(high) >= TRACE * low.abs().max(high)
        }
        _ => false,
    }
}

/// A range in words; none if it has no ends.
fn between(name: &str, (low, high): (f64, f64)) -> Option<String> {
    match (low.is_finite(), high.is_finite()) {
        (true, true) => Some(format!("{name} from {low} to {high}")),
        (true, false) => Some(format!("{name} from {low}")),
        (false, true) => Some(format!("{name} up to {high}")),
        (false, false) => None,
    }
}

fn too_large((width, height): (u32, u32)) -> ViewError {
    ViewError::option("size", format!("{width}x{height}"), "a picture that fits into memory")
}

/// A range for a colour bar: the extremes, opened a little if the value is the same everywhere.
fn spread((low, high): (f64, f64)) -> (f64, f64) {
    // Differences below this are rounding errors of single-precision files, not a field.
    let least = 1e-6 * low.abs().max(high.abs());
    match high - low {
        difference if difference > least => (low, high),
        _ if low == 0.0 && high == 0.0 => (-1.0, 1.0),
        _ => (low - 0.5 * low.abs(), high + 0.5 * high.abs()),
    }
}

fn has_gaps(scene: &Scene) -> bool {
    match &scene.values {
        Values::Nodes(values) => scene.drawn_nodes().any(|node| !values[node].is_finite()),
        Values::Faces(values) => values.iter().any(|value| !value.is_finite()),
        Values::Blocks(_) => false,
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

fn png(picture: &Pixmap, path: &Path) -> Result<Vec<u8>, ViewError> {
    picture.encode_png().map_err(|error| ViewError::Write { path: path.to_owned(), reason: error.to_string() })
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), ViewError> {
    files::replace(path, bytes).map_err(|error| ViewError::Write { path: path.to_owned(), reason: error.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uniform_field_still_has_a_bar() {
        assert_eq!(spread((1.0, 3.0)), (1.0, 3.0));
        assert_eq!(spread((0.0, 0.0)), (-1.0, 1.0));
        assert_eq!(spread((4.0, 4.0)), (2.0, 6.0));
        assert_eq!(spread((-4.0, -4.0)), (-6.0, -2.0));
    }
}
