//! What an analyst may ask of a picture.

use std::str::FromStr;

use super::ViewError;

/// How a picture is to look. The default is the whole body at the last state, seen obliquely from above.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewOptions {
    /// A nodal or element variable, or the stem of a vector's three components (`VEL`, `DISPL`), which shows its
    /// length. Without a name the first of the customary ones that the file has; `none` colours by block.
    pub variable: Option<String>,
    /// Which state is drawn.
    pub state: StateChoice,
    /// Where the eye is.
    pub from: Direction,
    /// Width and height of the picture in pixels.
    pub size: (u32, u32),
    /// Displacements are drawn this many times as large as they are.
    pub magnify: f64,
    /// The body is repeated behind planes across x, y, z at these places, as quarter models need.
    pub mirror: [Option<f64>; 3],
    /// Values at the two ends of the colour bar; without it those of the surface drawn.
    pub range: Option<(f64, f64)>,
    /// Element edges are drawn.
    pub edges: bool,
    /// Numbers of the blocks that are drawn; without any, all are.
    pub blocks: Vec<i64>,
    /// Numbers of blocks that are not drawn.
    pub hide: Vec<i64>,
    /// Planes across an axis (0 to 2) at a place; what is between them and the eye is taken off.
    pub cuts: Vec<(usize, f64)>,
    /// The box, along x, y and z, that the centres of the elements drawn are in, in the body as it is drawn; infinite where
    /// nothing is said.
    pub region: [Option<(f64, f64)>; 3],
    /// Variables, and the ranges that they are in in the elements drawn.
    pub criteria: Vec<(String, (f64, f64))>,
    /// Which colours mean which values.
    pub map: MapChoice,
    /// Stem of a nodal vector that is drawn as arrows.
    pub arrows: Option<String>,
    /// Degrees by which a two-dimensional body is turned about its y axis; without it its plane is drawn.
    pub revolve: Option<f64>,
    /// Shells are drawn as thick as they are.
    pub thickness: bool,
    /// Rigid planes of the deck are drawn.
    pub planes: bool,
}

/// Which colours mean which values.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum MapChoice {
    /// By the values: those of both signs diverge from zero, others rise.
    #[default]
    Suited,
    /// From dark to light.
    Sequential,
    /// From zero both ways.
    Diverging,
}

impl Default for ViewOptions {
    fn default() -> Self {
        ViewOptions {
            variable: None,
            state: StateChoice::Last,
            from: Direction::ISOMETRIC,
            size: (1200, 900),
            magnify: 1.0,
            mirror: [None; 3],
            range: None,
            edges: true,
            blocks: Vec::new(),
            hide: Vec::new(),
            cuts: Vec::new(),
            region: [None; 3],
            criteria: Vec::new(),
            map: MapChoice::default(),
            arrows: None,
            revolve: None,
            thickness: false,
            planes: true,
        }
    }
}

/// Which of a file's states is drawn. As text: `last`, a number counted from 1, `t=` and a time, or `mesh`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StateChoice {
    /// The last one.
    Last,
    /// The one with this number, counted from 1 as an analyst does.
    Number(usize),
    /// The one nearest this time.
    Nearest(f64),
    /// None: the mesh as it was before the run, coloured by block.
    Mesh,
}

impl FromStr for StateChoice {
    type Err = ViewError;

    fn from_str(text: &str) -> Result<Self, ViewError> {
        let wrong = || ViewError::option("state", text, "last, mesh, a number from 1 on, or t=TIME");
        match text.to_ascii_lowercase().as_str() {
            "last" => Ok(StateChoice::Last),
            "mesh" => Ok(StateChoice::Mesh),
            lower => match lower.strip_prefix("t=") {
                Some(time) => finite(time).map(StateChoice::Nearest).ok_or_else(wrong),
                None => lower.parse().ok().filter(|&n| n > 0).map(StateChoice::Number).ok_or_else(wrong),
            },
        }
    }
}

/// Where the eye is, seen from the body, in degrees. As text: a name of [`Direction::NAMED`] or `AZIMUTH,ELEVATION`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Angle from the x axis towards the y axis.
    pub azimuth: f64,
    /// Angle above the x-y plane, -90 to 90. At the poles y points up, or whatever the azimuth turns it to.
    pub elevation: f64,
}

impl Direction {
    /// From +x, -y and +z alike: x to the lower right, y to the upper right, z up.
    pub const ISOMETRIC: Direction = Direction { azimuth: -45.0, elevation: 35.264_389_682_754_654 };

    /// The directions that have a name. z points up, except from top and bottom, where y does.
    pub const NAMED: [(&str, Direction); 7] = [
        ("front", Direction { azimuth: -90.0, elevation: 0.0 }),
        ("back", Direction { azimuth: 90.0, elevation: 0.0 }),
        ("left", Direction { azimuth: 180.0, elevation: 0.0 }),
        ("right", Direction { azimuth: 0.0, elevation: 0.0 }),
        ("top", Direction { azimuth: -90.0, elevation: 90.0 }),
        ("bottom", Direction { azimuth: 90.0, elevation: -90.0 }),
        ("iso", Direction::ISOMETRIC),
    ];
}

impl FromStr for Direction {
    type Err = ViewError;

    fn from_str(text: &str) -> Result<Self, ViewError> {
        let named = Direction::NAMED.iter().find(|(name, _)| name.eq_ignore_ascii_case(text.trim()));
        if let Some(&(_, direction)) = named {
            return Ok(direction);
        }
        let angles = text.split_once(',').and_then(|(a, e)| Some((finite(a)?, finite(e)?)));
        match angles {
            Some((azimuth, elevation)) if elevation.abs() <= 90.0 => Ok(Direction { azimuth, elevation }),
            _ => {
                let expected = "front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION in degrees";
                Err(ViewError::option("direction of view", text, expected))
            }
        }
    }
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|value: &f64| value.is_finite())
}

impl ViewOptions {
    /// Refuses numbers that no picture can be made with.
    pub(super) fn check(&self) -> Result<(), ViewError> {
        let (width, height) = self.size;
        if !(200..=16_384).contains(&width) || !(150..=16_384).contains(&height) {
            let expected = "200x150 to 16384x16384 pixels";
            return Err(ViewError::option("size", format!("{width}x{height}"), expected));
        }
        if !self.magnify.is_finite() {
            return Err(ViewError::option("magnification", self.magnify.to_string(), "a finite number"));
        }
        if let Some(angle) = self.revolve.filter(|angle| !(*angle > 0.0 && *angle <= 360.0)) {
            return Err(ViewError::option(
                "angle of revolution",
                angle.to_string(),
                "more than 0, 360 degrees at most",
            ));
        }
        match self.range {
            Some((low, high)) if !(low.is_finite() && high.is_finite() && low < high) => {
                Err(ViewError::option("range", format!("{low},{high}"), "two finite numbers, the smaller one first"))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_and_states_read_as_an_analyst_writes_them() {
        assert_eq!("Front".parse::<Direction>().unwrap(), Direction { azimuth: -90.0, elevation: 0.0 });
        assert_eq!("30, -15".parse::<Direction>().unwrap(), Direction { azimuth: 30.0, elevation: -15.0 });
        assert!("30,95".parse::<Direction>().is_err() && "sideways".parse::<Direction>().is_err());
        assert_eq!("t=1.5e-3".parse::<StateChoice>().unwrap(), StateChoice::Nearest(1.5e-3));
        assert_eq!("12".parse::<StateChoice>().unwrap(), StateChoice::Number(12));
        assert!("0".parse::<StateChoice>().is_err() && "t=nan".parse::<StateChoice>().is_err());
    }
}
