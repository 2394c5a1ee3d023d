//! The design in force (`DS`): what somebody said of branches, and wood that follows from it.
//!
//! A design is to its wood what parameters are to growth: a setting that operations hold, so that undo, travel and
//! futures put it back. Its wood was born in one step of its own. As long as that is the last step of the line, the
//! step is made anew whenever the design changes; what is recorded after it seals it.

mod dyeing;
pub(super) mod fitting;
mod hands;
mod placed;
mod wood;

use std::sync::Arc;

use espalier_design::{
    Design, Edit, Generated, Generator, MAX_INTERNODES, NodeId, Refusal, Standing, Template, hands as by_hand,
};
use espalier_growth::EditError;
use espalier_plant::{Future, MetamerId, hash::StableHash};
use espalier_proto::{BranchPath, DesignEdit, DesignInForce, DesignValue, Position, Problem, Reason, Slug};
use espalier_reading::Unread;
use glam::Vec3;

pub(super) use self::{
    dyeing::{MOST_LET_GO, let_go_after},
    placed::{rotation, rounded, vector},
};
use super::{
    Document,
    branches::said,
    history::{Kind, Operation, Setting},
};
use crate::cause::Cause;

/// Bytes of designs that the present line and all futures may hold as JSON (`LM11`).
pub(super) const MAX_HELD_BYTES: usize = 64 << 20;

/// A design as operations hold it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Designed {
    /// All that was said, as JSON: a change leaves a few thousand bytes behind, and not the tables of all branches.
    pub(super) text: String,
    /// Where its wood stands.
    pub(super) at: Vec3,
    /// The step that its wood was born in.
    pub(super) step: u32,
}

impl Designed {
    /// What it says, with the values of all branches.
    pub(super) fn read(&self) -> Result<Design, Unread> {
        Design::from_json(&self.text)
    }

    pub(super) fn hash(&self, hash: &mut StableHash) {
        for chunk in self.text.as_bytes().chunks(8) {
            hash.word(chunk.iter().fold(0, |word, &byte| word << 8 | u64::from(byte)));
        }
        hash.vector(self.at);
        hash.word(self.step.into());
    }
}

/// The wood of a design as the plants have it, and what it is made by.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    of: Arc<Designed>,
    design: Arc<Design>,
    generator: Generator,
    generated: Arc<Generated>,
    /// The first row of its step.
    first: u32,
}

/// What follows from the line of time and the plants, kept so that little is made anew.
#[derive(Clone, Debug, Default)]
pub(super) struct Designs {
    shown: Option<Shown>,
    /// Rows that the line has after the step of the design, while the step shows an earlier state of it than those rows
    /// stand on.
    aside: Option<Future>,
    /// The design that was fitted last, and how much of the silhouette of what grew it has.
    fitted: Option<(Arc<Designed>, f32)>,
    /// Colours of wood whose designs were let go.
    let_go: dyeing::LetGo,
}

impl Document {
    /// The design in force on the line.
    pub(super) fn design_in_force(&self) -> Option<&Arc<Designed>> {
        self.history.setting().design.as_ref()
    }

    /// What is told of the design in force (`DS4`).
    pub(crate) fn design_told(&mut self) -> Option<DesignInForce> {
        let design = Arc::clone(self.design_in_force()?);
        let now = self.plant().step();
        let shown = self.shown(&design)?;
        let asleep = shown.design.asleep();
        let root = shown.design.root();
        let bearers = std::iter::once(root).chain(root.laterals());
        let numbers = |bearer: &espalier_design::Branch| {
            let laterals = bearer.laterals().iter();
            laterals.filter_map(|lateral| Some(lateral.id().bearer()?.1)).collect()
        };
        Some(DesignInForce {
            at: Position::nearest(design.at),
            graph: serde_json::from_str::<serde_json::Value>(&design.text).unwrap_or_default().into(),
            values: shown.design.graph().values() as u32,
            branches: shown.design.root().count() as u32,
            laterals: bearers.map(|bearer| (bearer.id().to_string(), numbers(bearer))).collect(),
            asleep: asleep.filter_map(|node| BranchPath::try_from(node.to_string()).ok()).collect(),
            steps_on_top: now.saturating_sub(design.step),
            row: shown.first,
            overlap: self
                .designs
                .fitted
                .as_ref()
                .filter(|(of, _)| *of == design)
                .map(|(_, overlap)| *overlap),
        })
    }

    /// Whether another design is in force than this one, or more stands on it; costs little.
    pub(crate) fn design_mark(&self) -> DesignMark {
        let steps = |design: &Arc<Designed>| self.plant().step().saturating_sub(design.step);
        let first = |design: &Arc<Designed>| wood::first_of(self.plant(), design.step);
        let design = self.design_in_force();
        let design = design.map(|design| (Arc::clone(design), steps(design), first(design)));
        DesignMark { design, let_go: self.let_go() }
    }

    pub(super) fn begin_design(
        &mut self,
        cause: Cause<'_>,
        position: Option<Position>,
        template: Option<&Slug>,
        graph: Option<&DesignValue>,
    ) -> Result<(), Problem> {
        let design = begun(template, graph)?;
        let Some(position) = position else {
            return self.change_design(cause, |_, _| Ok(design));
        };
        let at = position.get();
        if self.simulation.scene().is_solid(at) {
            let value = format!("{at}, in an obstacle");
            let problem = Problem::out_of_range("position", value, "a place outside all obstacles");
            return Err(Problem { reason: Reason::InObstacle, ..problem });
        }
        self.plant_design(cause, design, at, &[]).map(|_| ())
    }

    /// Plants the wood of a design in place of what is cut off, in a step of its own.
    fn plant_design(
        &mut self,
        cause: Cause<'_>,
        design: Design,
        at: Vec3,
        cuts: &[MetamerId],
    ) -> Result<Arc<Designed>, Problem> {
        self.require_nobody_draws()?;
        self.require_room()?;
        let text = design.to_json();
        self.require_design_bytes(text.len())?;
        let recorded = self.record(Kind::Design, cause);
        let now = self.plant().step();
        let mut generator = Generator::default();
        let generated = generator.generate(&design, MAX_INTERNODES);
        let first = self.plant().metamer_count() as u32;
        if let Err(error) = self.simulation.replant(cuts, &generated.wood, at) {
            self.refuse(recorded);
            return Err(of_wood(error));
        }
        let of = Arc::new(Designed { text, at, step: now + 1 });
        self.designs.shown = Some(Shown {
            of: Arc::clone(&of),
            design: Arc::new(design),
            generator,
            generated: Arc::new(generated),
            first,
        });
        let setting = self.setting();
        let let_go = let_go_after(&setting.let_go, setting.design.as_ref(), Some(&of));
        self.history.settle(Setting { design: Some(Arc::clone(&of)), let_go, ..setting });
        self.reach();
        self.release_lost_bends();
        Ok(of)
    }

    pub(super) fn edit_design(&mut self, cause: Cause<'_>, edits: &[DesignEdit]) -> Result<(), Problem> {
        let stands = self.design_in_force().map_or(Vec3::ZERO, |design| design.at);
        self.change_design(cause, |design, generated| {
            let mut changed = design.clone();
            for (at, edit) in edits.iter().enumerate() {
                let within = |problem: Problem| problem.within(&format!("edits[{at}]"));
                let edit = match edit {
                    DesignEdit::Aim { node, tip } if at == 0 => {
                        aimed(&changed, generated, node, tip.get() - stands)
                    }
                    DesignEdit::Aim { node, tip } => {
                        let generated = Generator::default().generate(&changed, MAX_INTERNODES);
                        aimed(&changed, &generated, node, tip.get() - stands)
                    }
                    edit => read_edit(edit, &changed),
                };
                let edit = edit.map_err(within)?;
                changed.apply(&edit).map_err(|refusal| refused(&refusal)).map_err(within)?;
            }
            Ok(changed)
        })
    }

    pub(super) fn release_design(&mut self, cause: Cause<'_>) -> Result<(), Problem> {
        if self.design_in_force().is_none() {
            return Err(no_design());
        }
        self.record(Kind::Design, cause);
        let setting = self.setting();
        let let_go = let_go_after(&setting.let_go, setting.design.as_ref(), None);
        self.history.settle(Setting { design: None, let_go, ..setting });
        self.note_state();
        Ok(())
    }

    /// Makes the design another one, and its wood with it; one operation for each gesture.
    fn change_design(
        &mut self,
        cause: Cause<'_>,
        change: impl FnOnce(&Design, &Generated) -> Result<Design, Problem>,
    ) -> Result<(), Problem> {
        let open = self.open_design()?;
        let continues = self.history.continues(&[Kind::Design], cause, open.step);
        let recorded = (!continues).then(|| self.record(Kind::Design, cause));
        let changed = self.try_change(&open, change);
        match changed {
            Ok(Some(of)) => {
                self.history.settle(Setting { design: Some(of), ..self.setting() });
                // Back where the gesture began, there is nothing to undo.
                if continues && self.history.changes_nothing() {
                    self.unrecord();
                }
                self.note_state();
                Ok(())
            }
            unchanged => {
                if let Some(recorded) = recorded {
                    self.refuse(recorded);
                }
                unchanged.map(|_| ())
            }
        }
    }

    /// Puts other wood in place; the design as operations hold it, or none where nothing has changed.
    fn try_change(
        &mut self,
        open: &Arc<Designed>,
        change: impl FnOnce(&Design, &Generated) -> Result<Design, Problem>,
    ) -> Result<Option<Arc<Designed>>, Problem> {
        let Some(shown) = self.shown(open) else { return Err(no_design()) };
        let design = change(&shown.design, &shown.generated)?;
        let text = design.to_json();
        if text == open.text {
            return Ok(None);
        }
        self.require_design_bytes(text.len())?;
        let of = Arc::new(Designed { text, ..Designed::clone(open) });
        self.put_wood(&of, design).map_err(of_wood)?;
        Ok(Some(of))
    }

    /// The design in force, if it can change: nothing stands on its wood, and nobody is drawing.
    fn open_design(&self) -> Result<Arc<Designed>, Problem> {
        let design = self.design_in_force().ok_or_else(no_design)?;
        let steps = self.plant().step().saturating_sub(design.step);
        if steps > 0 {
            return Err(sealed(design.step, steps));
        }
        self.require_nobody_draws()?;
        Ok(Arc::clone(design))
    }

    pub(super) fn require_nobody_draws(&self) -> Result<(), Problem> {
        if self.strokes.is_empty() {
            return Ok(());
        }
        let message = "somebody is drawing; wait until the brush is lifted";
        Err(Problem::new(Reason::BeingDrawn, message).at("kind", "a change of the design while nobody draws"))
    }

    /// Refuses to settle deeds so that a design changes whose wood bears later steps.
    pub(super) fn require_design_open_for(&self, setting: &Setting) -> Result<(), Problem> {
        let (Some(present), Some(wanted)) = (self.design_in_force(), &setting.design) else { return Ok(()) };
        let steps = self.plant().step().saturating_sub(present.step);
        if present == wanted || steps == 0 {
            return Ok(());
        }
        Err(sealed(present.step, steps))
    }

    /// Whether the history can hold so many bytes of designs more, if need be in place of futures (`LM11`).
    fn require_design_bytes(&self, more: usize) -> Result<(), Problem> {
        if held_bytes(&self.history.operations) + more <= MAX_HELD_BYTES {
            return Ok(());
        }
        let message = "the history keeps as many changes of designs as it may; undo something, or save the tree and go on with the saved one";
        let allowed = format!("{MAX_HELD_BYTES} bytes of designs in all");
        Err(Problem::new(Reason::HistoryFull, message).at("kind", allowed))
    }
}

/// Bytes of the designs of operations, each once.
pub(super) fn held_bytes(operations: &[Operation]) -> usize {
    let mut before: Option<&Arc<Designed>> = None;
    let mut held = 0;
    for design in operations.iter().map(|operation| operation.after.design.as_ref()) {
        let is_same = matches!((before, design), (Some(a), Some(b)) if Arc::ptr_eq(a, b));
        held += design.filter(|_| !is_same).map_or(0, |design| design.text.len());
        before = design;
    }
    held
}

/// A design with what another one changed of that before it.
pub(super) fn fold_design(
    folded: Option<Arc<Designed>>,
    before: Option<&Arc<Designed>>,
    after: Option<&Arc<Designed>>,
) -> Option<Arc<Designed>> {
    let (was, is) = match (before, after) {
        (was, is) if was == is => return folded,
        (Some(was), Some(is)) if was.step == is.step => (was, is),
        (_, after) => return after.cloned(),
    };
    let now = folded.filter(|now| now.step == is.step)?;
    if now == *was {
        return Some(Arc::clone(is));
    }
    let (Ok(of_now), Ok(of_was), Ok(of_is)) = (now.read(), was.read(), is.read()) else { return Some(now) };
    let merged = of_now.graph().with_changes(of_was.graph(), of_is.graph());
    // What several said may be too much together; then it stays as it is.
    match Design::of_merged(merged) {
        Ok(design) => Some(Arc::new(Designed { text: design.to_json(), ..Designed::clone(&now) })),
        Err(_) => Some(now),
    }
}

/// The design that is begun with.
fn begun(template: Option<&Slug>, graph: Option<&DesignValue>) -> Result<Design, Problem> {
    match (template, graph) {
        (Some(_), Some(_)) => {
            Err(Problem::out_of_range("graph", "given beside template", "a template or a graph, not both"))
        }
        (None, None) => Ok(Design::default()),
        (Some(name), None) => Template::named(name.as_str()).map(Template::design).ok_or_else(|| {
            let names: Vec<_> = espalier_design::TEMPLATES.iter().map(|template| template.name).collect();
            let message = format!("there is no template {}", name.as_str());
            Problem::new(Reason::NoTemplate, message).at("template", names.join(", "))
        }),
        (None, Some(graph)) => match Design::from_json(&graph.get().to_string()) {
            Ok(design) => Ok(design),
            Err(Unread::Refused(refusal)) => Err(Problem::from(refusal).within("graph")),
            Err(Unread::NotJson { what, .. }) => {
                Err(Problem::new(Reason::Malformed, what).at("graph", "a design as JSON"))
            }
        },
    }
}

fn node_of(path: &BranchPath) -> Result<NodeId, Problem> {
    path.as_str().parse().map_err(|fault: espalier_reading::NotAllowed| {
        Problem::out_of_range("node", fault.found, fault.allowed)
    })
}

/// What lets the tip of a branch come to lie at a place from the base of the plant.
fn aimed(design: &Design, generated: &Generated, node: &BranchPath, tip: Vec3) -> Result<Edit, Problem> {
    let node = node_of(node)?;
    if design.branch(node).is_none() {
        return Err(refused(&match design.standing(node) {
            Standing::Asleep(asleep) => Refusal::Asleep(asleep),
            Standing::Awake | Standing::Unknown => Refusal::Unknown(node),
        }));
    }
    by_hand::aim(design, generated, node, tip).map_err(|untouched| {
        Problem::new(Reason::DesignRefused, untouched.to_string())
            .at("tip", "a place that the branch can reach")
    })
}

fn read_edit(edit: &DesignEdit, design: &Design) -> Result<Edit, Problem> {
    if let DesignEdit::Wake { node } = edit {
        let node = node_of(node)?;
        return by_hand::wake(design, node).map_err(|untouched| {
            Problem::new(Reason::DesignRefused, untouched.to_string()).at("node", "a branch that sleeps")
        });
    }
    let json = serde_json::to_value(edit).unwrap_or_default();
    Edit::from_json(&json, design.graph()).map_err(Problem::from)
}

/// A refusal of the design in words for people.
fn refused(refusal: &Refusal) -> Problem {
    let message = refusal.to_string();
    match refusal {
        Refusal::Unknown(_) | Refusal::Asleep(_) => {
            Problem::new(Reason::DesignBranchGone, message).at("node", "a branch that stands")
        }
        Refusal::NotAllowed { fault, .. } => {
            Problem::new(Reason::OutOfRange, message).at("value", fault.allowed.clone())
        }
        Refusal::InBatch { refusal, .. } => refused(refusal),
        _ => Problem::new(Reason::DesignRefused, message).at("edit", "what the design takes"),
    }
}

fn of_wood(error: EditError) -> Problem {
    said("graph")(error)
}

fn no_design() -> Problem {
    let message = "there is no design here; begin one with new_design";
    Problem::new(Reason::DesignGone, message).at("kind", "a change of a design that is there")
}

fn sealed(step: u32, steps: u32) -> Problem {
    let message = format!(
        "{steps} later steps stand on the wood of the design, which can change only where nothing does: undo back to \
         step {step}; or let the design go (release_design), and all of it is wood like any other; or have a design \
         of all that stands there (fit_design); or begin another one with its graph (new_design)"
    );
    let allowed =
        format!("undo back to step {step}, release_design, fit_design, or new_design at another place");
    Problem::new(Reason::DesignSealed, message).at("kind", allowed)
}

/// Designs at one time, to be compared.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct DesignMark {
    /// With how many steps stand on it, and the first row of its wood: on another line it may be another one.
    design: Option<(Arc<Designed>, u32, u32)>,
    let_go: Vec<(Arc<Designed>, u32)>,
}
