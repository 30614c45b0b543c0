//! Many states, seen by one camera and with one meaning of the colours.

use std::borrow::Cow;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use gif::{Encoder, Frame, Repeat};
use tiny_skia::Pixmap;

use crate::postprocess::view::camera::Axes;
use crate::postprocess::view::colour::ColourMap;
use crate::postprocess::view::palette::Palette;
use crate::postprocess::view::subject::Subject;
use crate::postprocess::view::{Studio, Summary, Survey, ViewError, ViewOptions, png, write};

/// How long a GIF shows each state, in hundredths of a second.
const DELAY: u16 = 10;

/// Draws every `every`-th state of a results file, beginning with the first and ending with the last.
///
/// `picture` names the pictures: `film.gif` becomes one moving GIF, anything else numbered PNGs (`run.png` gives
/// `run_0001.png` for state 1, and so on). All are seen by one camera that shows the body whole in each of them, and
/// their colours mean the same values. The state in `options` is not used.
///
/// # Errors
/// As [`draw`](crate::postprocess::view::draw).
pub fn draw_many(
    results: &Path,
    picture: &Path,
    every: NonZeroUsize,
    options: &ViewOptions,
) -> Result<Vec<Summary>, ViewError> {
    options.check()?;
    let subject = Subject::open(results, options)?;
    let last = subject.times().len().checked_sub(1).ok_or_else(|| ViewError::NoStates { path: results.to_owned() })?;
    let mut states: Vec<usize> = (0..last).step_by(every.get()).collect();
    states.push(last);
    let survey = survey(&subject, &states.iter().copied().map(Some).collect::<Vec<_>>(), &Axes::new(subject.from()))?;
    let studio = Studio::new(&subject, options, survey);
    let mut reel = Reel::new(picture, options.size, &studio.map)?;
    let mut summaries = Vec::with_capacity(states.len());
    for state in states {
        let shot = subject.shot(Some(state))?;
        let path = reel.add(&studio.picture(&shot, Some(state))?, state)?;
        summaries.push(studio.summary(&path, &shot, Some(state)));
    }
    reel.finish()?;
    Ok(summaries)
}

/// Where the body is in all states, and its values.
pub(in crate::postprocess::view) fn survey(
    subject: &Subject,
    states: &[Option<usize>],
    axes: &Axes,
) -> Result<Survey, ViewError> {
    let mut all = Survey::NOTHING;
    for &state in states {
        all = all.and(Survey::of(&subject.shot(state)?.scene, axes));
    }
    all.of_all(subject)
}

/// Where the pictures go.
enum Reel {
    Numbered(PathBuf),
    Gif(PathBuf, Encoder<Vec<u8>>, Palette),
}

impl Reel {
    fn new(path: &Path, (width, height): (u32, u32), map: &ColourMap) -> Result<Self, ViewError> {
        if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gif")) {
            return Ok(Reel::Numbered(path.to_owned()));
        }
        let failed = |error: gif::EncodingError| refused(path, &error);
        // Sizes were checked: they are far below what 16 bits hold.
        let palette = Palette::new(map);
        let mut encoder = Encoder::new(Vec::new(), width as u16, height as u16, &palette.bytes()).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        Ok(Reel::Gif(path.to_owned(), encoder, palette))
    }

    /// Adds a picture and says in which file it is.
    fn add(&mut self, picture: &Pixmap, state: usize) -> Result<PathBuf, ViewError> {
        match self {
            Reel::Numbered(pattern) => {
                let path = numbered(pattern, state + 1);
                write(&path, &png(picture, &path)?)?;
                Ok(path)
            }
            Reel::Gif(path, encoder, palette) => {
                let (width, height) = (picture.width() as u16, picture.height() as u16);
                let buffer = Cow::Owned(palette.indices(picture.data()));
                let frame = Frame { delay: DELAY, width, height, buffer, ..Frame::default() };
                encoder.write_frame(&frame).map_err(|error| refused(path, &error))?;
                Ok(path.clone())
            }
        }
    }

    fn finish(self) -> Result<(), ViewError> {
        match self {
            Reel::Numbered(_) => Ok(()),
            Reel::Gif(path, encoder, _) => {
                let bytes = encoder.into_inner().map_err(|error| refused(&path, &error))?;
                write(&path, &bytes)
            }
        }
    }
}

fn refused(path: &Path, reason: &dyn std::fmt::Display) -> ViewError {
    ViewError::Write { path: path.to_owned(), reason: reason.to_string() }
}

/// `run.png` and 7 give `run_0007.png`.
fn numbered(path: &Path, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_{number:04}.png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_numbered_by_their_states() {
        assert_eq!(numbered(Path::new("out/run.png"), 7), Path::new("out/run_0007.png"));
        assert_eq!(numbered(Path::new("run"), 12345), Path::new("run_12345.png"));
    }
}
