//! Several states side by side in one picture, seen by one camera and with one meaning of the colours.

use std::path::Path;

use tiny_skia::{Color, Pixmap, PixmapPaint, Transform};

use super::annotate::{annotate, label};
use super::film::survey;
use crate::postprocess::view::camera::{Axes, Camera, Rectangle};
use crate::postprocess::view::numbers::rounded;
use crate::postprocess::view::subject::{Shot, Subject};
use crate::postprocess::view::{StateChoice, Studio, Summary, ViewError, ViewOptions, png, too_large, write};

/// Share of the room of a state that its label takes, in pixels of a picture 900 high, and the gap between two.
const LABEL: f64 = 34.0;
const GAP: f64 = 12.0;

/// Draws several states into one PNG. The state in `options` is not used.
///
/// # Errors
/// As [`draw`](crate::postprocess::view::draw).
pub fn draw_row(
    results: &Path,
    path: &Path,
    choices: &[StateChoice],
    options: &ViewOptions,
) -> Result<Vec<Summary>, ViewError> {
    let (bytes, shown) = picture_of_row(results, choices, options)?;
    write(path, &bytes)?;
    Ok(shown.into_iter().map(|summary| Summary { path: path.to_owned(), ..summary }).collect())
}

/// The same as the bytes of a PNG; the summaries have no path.
///
/// # Errors
/// As [`draw`](crate::postprocess::view::draw).
pub fn picture_of_row(
    results: &Path,
    choices: &[StateChoice],
    options: &ViewOptions,
) -> Result<(Vec<u8>, Vec<Summary>), ViewError> {
    options.check()?;
    let subject = Subject::open(results, options)?;
    let states = choices.iter().map(|&choice| subject.state(choice)).collect::<Result<Vec<_>, _>>()?;
    let axes = Axes::new(subject.from());
    let mut studio = Studio::new(&subject, options, survey(&subject, &states, &axes)?);
    let bounds = studio.bounds;
    let shots = states.iter().map(|&state| subject.shot(state)).collect::<Result<Vec<_>, _>>()?;
    let body = studio.layout.body();
    let unit = studio.layout.unit();
    let cells = cells(body, bounds.size(), shots.len(), unit);
    let inside = |cell: &Rectangle| Rectangle {
        left: 0.0,
        top: 0.0,
        right: cell.right - cell.left,
        bottom: (cell.bottom - cell.top - label_height(unit)).max(1.0),
    };
    if let Some(first) = cells.first() {
        let room = inside(first);
        let room = if options.arrows.is_some() { super::arrows::room(room, unit) } else { room };
        studio.camera = Camera::fit(axes, bounds, room);
    }
    studio.longest = shots.iter().map(|shot| super::arrows::longest(&shot.scene)).fold(0.0, f64::max);
    let mut sheet = studio.paper()?;
    for ((shot, state), cell) in shots.iter().zip(&states).zip(&cells) {
        let room = inside(cell);
        let size = ((room.right as u32).max(1), (room.bottom as u32).max(1));
        let mut part = Pixmap::new(size.0, size.1).ok_or_else(|| too_large(size))?;
        part.fill(Color::WHITE);
        studio.paint(&mut part, shot);
        let (left, top) = (cell.left as i32, cell.top as i32);
        sheet.draw_pixmap(left, top, part.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
        let middle = 0.5 * (cell.left + cell.right);
        let texts = match state {
            None => vec!["mesh".to_owned()],
            Some(state) => [4, 3, 2].map(|digits| rounded(subject.times()[*state], digits)).to_vec(),
        };
        label(
            &mut sheet,
            &studio.layout,
            &texts,
            [middle, cell.bottom - 0.35 * label_height(unit)],
            cell.right - cell.left,
        );
    }
    let notes = studio.notes(&shots.iter().zip(states.iter().copied()).collect::<Vec<(&Shot, _)>>());
    annotate(&mut sheet, &studio.layout, &notes, studio.camera.axes(), &studio.map);
    let unnamed = Path::new("");
    let shown = shots.iter().zip(states).map(|(shot, state)| studio.summary(unnamed, shot, state)).collect();
    Ok((png(&sheet, unnamed)?, shown))
}

fn label_height(unit: f64) -> f64 {
    (LABEL * unit).max(15.0)
}

/// Rooms for so many pictures of a body this wide and high, in as many columns as let it be largest.
fn cells(body: Rectangle, size: [f64; 2], count: usize, unit: f64) -> Vec<Rectangle> {
    let (width, height) = (body.right - body.left, body.bottom - body.top);
    let room = |columns: usize| {
        let rows = count.div_ceil(columns);
        let gap = GAP * unit;
        [(width - gap * (columns - 1) as f64) / columns as f64, (height - gap * (rows - 1) as f64) / rows as f64]
    };
    let scale = |columns: &usize| {
        let [wide, high] = room(*columns);
        let fits = |room: f64, size: f64| if size > 0.0 { room / size } else { f64::INFINITY };
        fits(wide, size[0]).min(fits(high - label_height(unit), size[1]))
    };
    let columns = (1..=count.max(1)).max_by(|a, b| scale(a).total_cmp(&scale(b))).unwrap_or(1);
    let [wide, high] = room(columns);
    let cell = |place: usize| {
        let (row, column) = ((place / columns) as f64, (place % columns) as f64);
        let (left, top) = (body.left + column * (wide + GAP * unit), body.top + row * (high + GAP * unit));
        Rectangle { left, top, right: left + wide, bottom: top + high }
    };
    (0..count).map(cell).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tall_bodies_stand_side_by_side_and_long_ones_above_each_other() {
        let body = Rectangle { left: 100.0, top: 100.0, right: 1100.0, bottom: 800.0 };
        let columns = |size| {
            let cells = cells(body, size, 6, 1.0);
            cells.iter().filter(|cell| cell.top == cells[0].top).count()
        };
        assert_eq!((columns([1.0, 9.0]), columns([9.0, 1.0]), columns([1.0, 1.0])), (6, 1, 3));
        let cells = cells(body, [1.0, 1.0], 5, 1.0);
        assert!(cells.iter().all(|cell| cell.right <= 1100.0 + 1e-9 && cell.bottom <= 800.0 + 1e-9));
    }
}
