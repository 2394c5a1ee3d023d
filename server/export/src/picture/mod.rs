//! Pictures of plants, drawn without a graphics card: the front view, in the sun, on a light ground.

mod camera;
mod canvas;
#[cfg(test)]
mod given_up;
mod lettering;
mod palette;
pub(crate) mod raster;
mod scene;
mod sheet;
mod swaying;
mod turntable;

pub use camera::{Camera, Perspective};
pub use canvas::Canvas;
pub use scene::{Look, draw};
pub use sheet::{Cell, sheet};
pub use swaying::swaying;
pub use turntable::{strip, turntable};
