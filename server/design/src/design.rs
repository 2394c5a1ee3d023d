//! A graph with the values of all its branches, edit by edit.

use crate::{
    edit::{Edit, Standing, Writing, standing},
    graph::Graph,
    node::NodeId,
    patch::Patch,
    refusal::{MAX_BATCH, Refusal},
    resolution::{Branch, Dirty, Overgrown, Reached, refresh, resolve},
};

/// A design: what was said, and what each branch has by it.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    graph: Graph,
    root: Branch,
}

/// What an edit has done.
#[derive(Clone, Debug, PartialEq)]
pub struct Applied {
    /// What undoes it; empty where it has changed nothing.
    pub undo: Patch,
    /// What it has reached.
    pub reached: Reached,
}

impl Default for Design {
    /// A plant of which nothing was said.
    fn default() -> Self {
        let mut graph = Graph::default();
        // Defaults make few branches.
        let root = resolve(&mut graph, &mut Patch::default());
        Self { root: root.unwrap_or_else(|Overgrown| unreachable!("defaults are small")), graph }
    }
}

impl Design {
    /// The design of a graph; slots that do not fit the laterals that there are now are laid out anew.
    ///
    /// # Errors
    /// Where the plant would have too many branches.
    pub fn of(mut graph: Graph) -> Result<Self, Refusal> {
        let root =
            resolve(&mut graph, &mut Patch::default()).map_err(|Overgrown| Refusal::TooManyBranches)?;
        Ok(Self { graph, root })
    }

    /// The graph, to change, and its branches, which do not follow.
    pub(crate) fn parts(&mut self) -> (&mut Graph, &Branch) {
        (&mut self.graph, &self.root)
    }

    /// What was said.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The plant's own axis and all that it bears.
    pub fn root(&self) -> &Branch {
        &self.root
    }

    /// A branch that stands.
    pub fn branch(&self, node: NodeId) -> Option<&Branch> {
        self.root.find(node)
    }

    /// How a branch stands.
    pub fn standing(&self, node: NodeId) -> Standing {
        standing(&self.graph, &self.root, node)
    }

    /// Branches that sleep, in order.
    pub fn asleep(&self) -> impl Iterator<Item = NodeId> {
        self.graph.slots.iter().flat_map(|(bearer, slots)| {
            let asleep = slots.iter().filter(|slot| slot.place.is_none());
            asleep.filter_map(|slot| bearer.child(slot.ordinal))
        })
    }

    /// Does an edit.
    ///
    /// # Errors
    /// Where it is refused; then nothing has changed.
    pub fn apply(&mut self, edit: &Edit) -> Result<Applied, Refusal> {
        let mut undo = Patch::default();
        let mut reached = Reached::default();
        match self.run(edit, &mut undo, &mut reached) {
            Ok(()) => {
                undo.without_what_is(&self.graph);
                Ok(Applied { undo, reached })
            }
            Err(refusal) => {
                self.graph.swap(undo);
                self.root = resolve(&mut self.graph, &mut Patch::default())
                    .unwrap_or_else(|Overgrown| unreachable!("it was small enough before"));
                Err(refusal)
            }
        }
    }

    /// Puts the patch of an earlier edit in place: undoes it, or does it again. The design must be as that edit left
    /// it.
    ///
    /// # Errors
    /// Where the plant would have too many branches, which it has not where the design is as it must be.
    pub fn restore(&mut self, patch: Patch) -> Result<Applied, Refusal> {
        let mut undo = self.graph.swap(patch);
        match self.follow(&mut undo) {
            Ok(reached) => Ok(Applied { undo, reached }),
            Err(Overgrown) => {
                self.graph.swap(undo);
                self.root = resolve(&mut self.graph, &mut Patch::default())
                    .unwrap_or_else(|Overgrown| unreachable!("it was small enough before"));
                Err(Refusal::TooManyBranches)
            }
        }
    }

    fn run(&mut self, edit: &Edit, undo: &mut Patch, reached: &mut Reached) -> Result<(), Refusal> {
        if let Edit::Batch(edits) = edit {
            if edits.len() > MAX_BATCH {
                return Err(Refusal::BatchTooLong { found: edits.len() });
            }
            for (at, edit) in edits.iter().enumerate() {
                let within = |refusal| Refusal::InBatch { at, refusal: Box::new(refusal) };
                self.run(edit, undo, reached).map_err(within)?;
            }
            return Ok(());
        }
        let mut own = Patch::default();
        let written = Writing { graph: &mut self.graph, root: &self.root, undo: &mut own }.write(edit);
        let followed = match written {
            Ok(()) => self.follow(&mut own).map_err(|Overgrown| Refusal::TooManyBranches),
            Err(refusal) => Err(refusal),
        };
        undo.after(own);
        let followed = followed?;
        reached.visited += followed.visited;
        reached.changed.extend(followed.changed);
        Ok(())
    }

    /// Brings the branches up to date with what a patch says has changed.
    fn follow(&mut self, undo: &mut Patch) -> Result<Reached, Overgrown> {
        if undo.is_empty() {
            return Ok(Reached::default());
        }
        let dirty = Dirty::of(undo, &self.graph);
        refresh(&mut self.root, &mut self.graph, &dirty, undo)
    }
}
