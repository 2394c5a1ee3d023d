//! What hands do to designed wood: it is said in the design, and so survives the next change of it.

use espalier_design::{Design, Edit, Generated, Generator, Key, MAX_INTERNODES, NodeId, Owner, hands};
use espalier_plant::Motion;
use espalier_proto::{Problem, Reason};
use glam::{Quat, Vec3};

use super::{Document, refused};
use crate::{cause::Cause, document::history::Kind};

impl Document {
    /// The rows of a design's wood for rows of the plants, where the design is open and all of them are of it.
    pub(in crate::document) fn designed(&mut self, rows: &[u32]) -> Option<Vec<u32>> {
        let open = self.open_design().ok()?;
        let shown = self.shown(&open)?;
        let end = shown.first + shown.generated.wood.nodes.len() as u32;
        let of_design = |&row: &u32| (shown.first < row && row < end).then(|| row - shown.first);
        rows.iter().map(of_design).collect()
    }

    /// Whether a row is wood of an open design.
    pub(in crate::document) fn is_designed(&mut self, row: u32) -> bool {
        self.designed(&[row]).is_some_and(|rows| !rows.is_empty())
    }

    /// Gives designed wood a width; without one it follows its bearer again.
    pub(in crate::document) fn widen_designed(
        &mut self,
        cause: Cause<'_>,
        row: u32,
        diameter: Option<f32>,
    ) -> Result<(), Problem> {
        self.change_by_hand(cause, "row", |_, generated| {
            let (node, t) = generated.at(row)?;
            Some(match diameter {
                Some(diameter) => hands::widen(generated, node, t, 0.5 * diameter),
                None => {
                    let key = if node == NodeId::ROOT { Key::Stem } else { Key::Girth };
                    Ok(Edit::Clear { owner: Owner::Node(node), key })
                }
            })
        })
    }

    /// Cuts designed branches, each at the branching point below its row (`PR1`).
    pub(in crate::document) fn cut_designed(
        &mut self,
        cause: Cause<'_>,
        lowest: &[u32],
    ) -> Result<(), Problem> {
        self.change_by_hand(cause, "rows", |_, generated| {
            let mut edits = Vec::new();
            for &row in lowest {
                let (node, _) = generated.at(row)?;
                // What stays ends where the wood below the cut does.
                let below = generated.wood.nodes[row as usize].parent.and_then(|below| generated.at(below));
                let t = below.filter(|(below, _)| *below == node).map_or(0.0, |(_, t)| t);
                match hands::cut(generated, node, t) {
                    Ok(edit) => edits.push(edit),
                    Err(untouched) => return Some(Err(untouched)),
                }
            }
            Some(Ok(Edit::Batch(edits)))
        })
    }

    /// Turns the branch that begins with a row of designed wood. Within a gesture it is turned from where it was when
    /// the gesture began.
    pub(in crate::document) fn turn_designed(
        &mut self,
        cause: Cause<'_>,
        row: u32,
        rotation: Quat,
    ) -> Result<(), Problem> {
        let now = self.plant().step();
        let continues = self.history.continues(&[Kind::Design], cause, now);
        let former = self.history.former().design.clone().filter(|former| continues && former.step == now);
        let former = former.and_then(|former| former.read().ok());
        let (base, places) = (self.base_of_designed(row), self.rows_of_designed(row));
        if former.is_some() || places.is_none() {
            return self.change_design(cause, |design, generated| {
                let node = generated.at(row).map(|(node, _)| node).ok_or_else(|| lost("row"))?;
                let design = former.unwrap_or_else(|| design.clone());
                let generated = Generator::default().generate(&design, MAX_INTERNODES);
                let edit = hands::turn(&design, &generated, node, rotation).map_err(of_hand("rotation"))?;
                applied(design, &edit)
            });
        }
        let (base, (node, places)) = (base.unwrap_or_default(), places.unwrap_or((NodeId::ROOT, Vec::new())));
        self.change_by_hand(cause, "rotation", |design, generated| {
            let is_whole = generated.rows(node).next() == Some(row);
            if is_whole && node != NodeId::ROOT {
                return Some(hands::turn(design, generated, node, rotation));
            }
            let turned = places
                .iter()
                .map(|&(row_of, place)| if row_of < row { place } else { base + rotation * (place - base) });
            Some(hands::bend(design, generated, node, &turned.collect::<Vec<_>>()))
        })
    }

    /// Bends designed wood: the rows of a path move, and what stands on them with them. The axis that holds the path's
    /// end, and those that bear it, keep the new course.
    pub(in crate::document) fn bend_designed(
        &mut self,
        cause: Cause<'_>,
        path: &[u32],
        motions: &[Motion],
    ) -> Result<(), Problem> {
        let Some(at) = self.design_in_force().map(|design| design.at) else { return Err(super::no_design()) };
        self.change_design(cause, |design, generated| {
            let mut design = design.clone();
            let mut generator = Generator::default();
            let mut now = generated.clone();
            let mut nodes: Vec<NodeId> = Vec::new();
            for &row in path {
                let (node, _) = generated.at(row).ok_or_else(|| lost("bend"))?;
                if nodes.last() != Some(&node) {
                    nodes.push(node);
                }
            }
            for node in nodes {
                let mut last = None;
                let mut places = Vec::new();
                for row in generated.rows(node) {
                    let on_path = path.iter().position(|&of_path| of_path == row);
                    last = on_path.map(|at| motions[at]).or(last);
                    let place = generated.wood.nodes[row as usize].end;
                    places.push(last.map_or(place, |motion: Motion| motion.apply(place + at) - at));
                }
                if last.is_none() {
                    continue;
                }
                let edit = hands::bend(&design, &now, node, &places).map_err(of_hand("bend"))?;
                design = applied(design, &edit)?;
                now = generator.generate(&design, MAX_INTERNODES);
            }
            Ok(design)
        })
    }

    fn change_by_hand(
        &mut self,
        cause: Cause<'_>,
        field: &'static str,
        edit: impl FnOnce(&Design, &Generated) -> Option<Result<Edit, hands::Untouched>>,
    ) -> Result<(), Problem> {
        self.change_design(cause, |design, generated| {
            let edit = edit(design, generated).ok_or_else(|| lost(field))?.map_err(of_hand(field))?;
            applied(design.clone(), &edit)
        })
    }

    /// Where the wood of a row begins.
    fn base_of_designed(&mut self, row: u32) -> Option<Vec3> {
        let generated = &self.designs.shown.as_ref()?.generated;
        let below = generated.wood.nodes.get(row as usize)?.parent?;
        Some(generated.wood.nodes[below as usize].end)
    }

    /// The branch of a row, and all rows of its axis with their places.
    fn rows_of_designed(&mut self, row: u32) -> Option<(NodeId, Vec<(u32, Vec3)>)> {
        let generated = &self.designs.shown.as_ref()?.generated;
        let (node, _) = generated.at(row)?;
        let place = |row: u32| (row, generated.wood.nodes[row as usize].end);
        Some((node, generated.rows(node).map(place).collect()))
    }
}

fn applied(mut design: Design, edit: &Edit) -> Result<Design, Problem> {
    design.apply(edit).map_err(|refusal| refused(&refusal))?;
    Ok(design)
}

fn lost(field: &str) -> Problem {
    Problem::new(Reason::BranchGone, "the design has no such wood").at(field, "the row of designed wood")
}

fn of_hand(field: &'static str) -> impl Fn(hands::Untouched) -> Problem {
    move |untouched| {
        Problem::new(Reason::DesignRefused, untouched.to_string()).at(field, "what the design takes")
    }
}
