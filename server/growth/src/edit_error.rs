//! Why an edit of a scene cannot be made.

use espalier_plant::BadColumns;

use crate::world::WORLD_EXTENT;

/// An edit that cannot be made; nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// Wood would stand outside the world.
    #[error("the branch would leave the world, which ends {WORLD_EXTENT} internodes from the origin")]
    OutOfWorld,
    /// The scene may not hold so many metamers.
    #[error("the scene would hold more metamers than its budget")]
    OutOfBudget,
    /// Nodes and axes of wood do not fit together.
    #[error("the nodes and axes of this wood do not fit together")]
    Broken,
    /// Columns do not fit the plants.
    #[error(transparent)]
    Columns(#[from] BadColumns),
}
