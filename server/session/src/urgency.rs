//! What slices of work are for.

use espalier_proto::Action;

/// In a tree of more rows than this, dead ones and those beyond the present included, what is done in one piece is long, whoever waits for it: no
/// slice can be interrupted, and those who draw do not wait for it.
pub(crate) const LONG_ROWS: usize = 20_000;

/// What a slice of work is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Urgency {
    /// Somebody's hand is on the tree, or somebody waits to see it.
    Drawing,
    /// The tree grows alone.
    Growing,
    /// The tree is read or kept as a whole.
    Keeping,
}

/// Whether trees grow alone by a command, or a design is fitted to one, for as long as it takes.
pub(crate) fn grows_alone(action: &Action) -> bool {
    matches!(
        action,
        Action::Grow { .. }
            | Action::Lasso { .. }
            | Action::Derive { .. }
            | Action::FitDesign { .. }
            | Action::Refill { .. }
    )
}

/// Whether an action takes the whole tree from one state to another in one piece: journeys in time and grammars; of a design
/// for what grew what goes before the first trial and after the last.
pub(crate) fn is_in_one_piece(action: &Action) -> bool {
    matches!(
        action,
        Action::GoTo { .. }
            | Action::Ungrow { .. }
            | Action::Undo {}
            | Action::Redo {}
            | Action::TakeBack { .. }
            | Action::BringBack { .. }
            | Action::TakeFuture { .. }
            | Action::FitDesign { .. }
            | Action::SetGrammar { .. }
            | Action::SetGrammarBody { .. }
            | Action::SetGrammarValues { .. }
    )
}
