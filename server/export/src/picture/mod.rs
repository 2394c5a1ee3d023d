//! Pictures of plants, drawn without a graphics card: the front view, in the sun, on a light ground.

mod bark;
mod blades;
mod canvas;
pub(crate) mod leaf_look;
mod lettering;
mod ornaments;
mod palette;
mod png;
mod raster;
mod scene;
mod sheet;

pub use canvas::Canvas;
pub(crate) use canvas::linear;
pub use scene::{Look, draw};
pub use sheet::{Cell, sheet};
