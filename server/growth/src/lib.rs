//! The self-organising simulation of TreeSketch: buds that compete for light and space.
//!
//! A [`Simulation`] is a [`Scene`] (plants, obstacles, light, space) and the [`Generator`] that grows it step by step.
//! [`Growth`] is the first; what guides a step of it comes in as [`StepInput`]: the brush, or nothing (autonomous growth). All randomness is keyed ([`random`]), all sums have one order,
//! so the same inputs give the same plant bit for bit, on any number of threads.

mod brush;
mod canopy;
mod cells;
mod claims;
mod direction;
mod directory;
mod edit_error;
mod edits;
mod enclosure;
mod field;
mod flush;
mod generator;
mod gravimorphism;
mod growth;
mod guide;
mod lasso;
mod light;
mod markers;
mod nearby_order;
mod newcomers;
mod observer;
mod obstacles;
mod parameter_table;
mod parameters;
mod place_grid;
pub mod random;
#[cfg(test)]
mod reference;
mod rewriting;
mod rules;
mod scene;
mod schematic;
mod selection;
mod shares;
mod shedding;
mod shoot;
mod side_by_side;
mod simulation;
mod space;
pub mod species;
mod state;
mod step;
mod sweep;
mod transplant;
mod vigor;
mod voxel_grid;
mod world;

pub use espalier_settings::{ParameterValues, VigorModel};

pub use brush::{BrushPiece, BrushSample, StrokeId};
pub use edit_error::EditError;
pub use edits::Original;
pub use enclosure::Enclosure;
pub use generator::{Change, Generator, Share, StepOutcome};
pub use gravimorphism::propensity;
pub use growth::Growth;
pub use guide::{Guide, REACH, Waypoint};
pub use lasso::{Envelope, LassoError, MAX_OUTLINE, Plane};
pub use light::ShadowGrid;
pub use markers::{Marker, MarkerSource, Markers};
pub use observer::{NoObserver, Observer, Phase};
pub use obstacles::{MAX_TRIANGLES, Obstacle, ObstacleError, Obstacles, Shape, TriangleMesh};
pub use parameter_table::ParameterTable;
pub use parameters::Parameters;
pub use rewriting::{Drawn, Rewriting, Rewritten};
#[cfg(feature = "next-simulation")]
pub use rules::use_next_simulation;
pub use rules::{SIMULATION_VERSION, simulation_version};
pub use scene::{DEFAULT_METAMER_BUDGET, Recording, Scene};
pub use schematic::{SCHEMATIC_METAMERS, schematic};
pub use side_by_side::use_clock;
pub use simulation::Simulation;
pub use space::Space;
pub use state::SimulationState;
pub use step::StepInput;
pub use sweep::Sweep;
pub use transplant::transplant;
pub use world::WORLD_EXTENT;
