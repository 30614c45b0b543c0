//! From places and values to pixels: the camera, colours, lines, faces, letters and numbers.

pub mod camera;
pub mod colour;
pub mod lines;
pub mod numbers;
pub mod palette;
pub mod raster;
pub mod text;
