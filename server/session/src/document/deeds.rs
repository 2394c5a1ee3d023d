//! Deeds: what one person did, taken back and brought back wherever it lies on the line of time (`UD`).
//!
//! A deed is an operation, or one person's part of an operation of several. Whether it is in force follows from the
//! operations after it that took deeds back and brought them back, so it travels in time as they do. What stands then, and
//! what holds of parameters, looks and obstacles, follows from the deeds in force alone.

use std::sync::Arc;

use espalier_plant::{Claim, Claims, MetamerId, Plant};
use espalier_proto::{OperationKind, Problem, Reason};

use super::{
    Document,
    bending::held,
    branches::said,
    designing::Designed,
    history::{History, Kind, Operation},
    parts::PartSet,
    travelling::nothing_to_redo,
};
use crate::{cause::Cause, principal::Principal};

/// What came of taking a deed back, or bringing one back (`UD7`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Switched {
    /// What the deed was.
    pub kind: OperationKind,
    /// Whether it is taken back now.
    pub away: bool,
    /// Metamers that fell.
    pub fell: u32,
    /// Metamers that rose.
    pub rose: u32,
    /// Metamers of a deed that is away which stay, since wood that others drew stands on them.
    pub held: u32,
    /// Later deeds of their author of which nothing could go.
    pub passed: u32,
}

/// Somebody who takes back what is theirs: the author of a command, under whatever keys they came (`UD8`).
pub(super) struct Person<'a> {
    author: &'a Principal,
    others: &'a [String],
}

impl<'a> Person<'a> {
    pub(super) fn new(author: &'a Principal, others: &'a [String]) -> Self {
        Self { author, others }
    }

    fn is(&self, author: &Principal) -> bool {
        author == self.author || self.others.iter().any(|key| key == author.name())
    }
}

impl Operation {
    /// What somebody did of it and may take back, the last first.
    fn deeds_of(&self, person: &Person<'_>) -> impl Iterator<Item = u8> {
        let is_deed = !self.kind.is_switch() && (!self.is_joint || self.parts.count() > 1);
        self.parts_where(|author| person.is(author)).filter(move |_| is_deed)
    }

    /// Whether a hand drew the wood that was born in it, rather than that it grew by itself.
    pub(super) fn is_drawn(&self) -> bool {
        self.is_chosen
            || matches!(
                self.kind,
                Kind::Stroke
                    | Kind::Lasso
                    | Kind::Seed
                    | Kind::Graft
                    | Kind::Design
                    | Kind::Grammar
                    | Kind::Refill
            )
    }
}

impl History {
    /// Which of the operations in force on the line have been taken back, all parts of them.
    pub(super) fn away(&self) -> Vec<bool> {
        let away = self.parts_away();
        self.operations.iter().zip(away).map(|(operation, away)| operation.is_all_in(away)).collect()
    }

    /// Which parts of each operation have been taken back.
    pub(super) fn parts_away(&self) -> Vec<PartSet> {
        let mut away = vec![PartSet::default(); self.operations.len()];
        for operation in &self.operations[..self.done] {
            let Some(deed) = operation.deed.and_then(|deed| away.get_mut(deed as usize)) else { continue };
            deed.put(operation.part, operation.kind == Kind::TakenBack);
        }
        away
    }

    /// What counts of each step up to the present, and of the metamers of parts.
    pub(super) fn claims(&self, plant: &Plant) -> Claims {
        let step = plant.step();
        let mut claims = Claims::from(vec![Claim::HAND; step as usize + 1]);
        for (operation, away) in self.operations[..self.done].iter().zip(self.parts_away()) {
            let steps = (operation.first + 1).min(step + 1)..(operation.last + 1).min(step + 1);
            let claim = Claim { in_force: !operation.is_all_in(away), by_hand: operation.is_drawn() };
            claims.steps[steps.start as usize..steps.end as usize].fill(claim);
            let runs = operation
                .runs_of(operation.born(plant))
                .into_iter()
                .map(|(rows, run)| (rows, Claim { in_force: !away.holds(run.part), by_hand: run.by_hand }));
            claims.rows.extend(runs);
        }
        claims
    }

    /// The deed that somebody took back last, if they did nothing since.
    fn taken_back_last(&self, person: &Person<'_>) -> Option<(usize, u8)> {
        let away = self.parts_away();
        let is_of = |one: &&Operation| one.parts_where(|author| person.is(author)).next().is_some();
        for operation in self.operations[..self.done].iter().rev().filter(is_of) {
            match operation.deed.map(|deed| deed as usize).filter(|_| operation.kind.is_switch()) {
                Some(deed) if away.get(deed).is_some_and(|away| away.holds(operation.part)) => {
                    return Some((deed, operation.part));
                }
                Some(_) => {}
                None => return None,
            }
        }
        None
    }
}

impl Document {
    /// Takes back the newest deed of somebody that is in force and of which anything can go (`UD1`). A stroke or bend of
    /// theirs ends first; where nothing else can be taken back, that is all.
    pub(super) fn take_back(&mut self, cause: Cause<'_>, person: &Person<'_>) -> Result<(), Problem> {
        let has_ended = self.end_gestures_of(person);
        let done =
            if self.is_alone(person) { self.travel_back() } else { self.take_back_newest(cause, person) };
        if has_ended { Ok(()) } else { done }
    }

    fn take_back_newest(&mut self, cause: Cause<'_>, person: &Person<'_>) -> Result<(), Problem> {
        let away = self.history.parts_away();
        let (mut passed, mut refused) = (0, None);
        // Steps of designs of which something was said that is in force no more, for they were let go.
        let mut let_go = Vec::new();
        for deed in (0..self.history.done).rev() {
            let (parts, kind) = {
                let operation = &self.history.operations[deed];
                (operation.deeds_of(person).collect::<Vec<u8>>(), operation.kind)
            };
            for part in parts.into_iter().filter(|&part| !away[deed].holds(part)) {
                let is_sealed = |problem: &Problem| problem.reason == Reason::DesignSealed;
                if kind == Kind::Design && refused.as_ref().is_some_and(is_sealed) {
                    // Nobody wants the whole design gone whose last change cannot go.
                    passed += 1;
                    continue;
                }
                let begun = self.begun_by(deed);
                if begun.is_some_and(|step| let_go.contains(&step)) {
                    refused = refused.or_else(|| Some(design_let_go()));
                    passed += 1;
                    continue;
                }
                match self.switch(cause, person, Kind::TakenBack, (deed, part)) {
                    Ok(true) => {
                        self.switched = self.switched.map(|switched| Switched { passed, ..switched });
                        return Ok(());
                    }
                    // It can be taken back as soon as the bend has ended.
                    Err(problem) if problem.reason == Reason::BeingBent => return Err(problem),
                    Err(problem) => refused = refused.or(Some(problem)),
                    Ok(false) => let_go.extend(self.let_go_since(deed)),
                }
                passed += 1;
            }
        }
        // What kept the newest from going says most.
        Err(refused.unwrap_or_else(|| {
            let message = "nothing that you did can be taken back; what others did is theirs";
            Problem::new(Reason::NothingOfYours, message)
                .at("kind", "what some deed of yours is in force for")
        }))
    }

    /// The step of the design that an operation planted, if it did.
    fn begun_by(&self, deed: usize) -> Option<u32> {
        let (before, after) = self.designs_about(deed);
        after.filter(|after| before.is_none_or(|before| before.step != after.step)).map(|after| after.step)
    }

    /// The step of the design that an operation changed, if that is in force no more.
    fn let_go_since(&self, deed: usize) -> Option<u32> {
        let (before, after) = self.designs_about(deed);
        let changed = after.filter(|after| before.is_some_and(|before| before.step == after.step));
        let in_force = self.design_in_force().map(|design| design.step);
        changed.map(|design| design.step).filter(|&step| in_force != Some(step))
    }

    /// The designs before an operation and after it.
    fn designs_about(&self, deed: usize) -> (Option<&Arc<Designed>>, Option<&Arc<Designed>>) {
        let before = deed.checked_sub(1).map(|before| &self.history.operations[before].after);
        let before = before.unwrap_or(&self.history.initial);
        (before.design.as_ref(), self.history.operations[deed].after.design.as_ref())
    }

    /// Takes back what was done last on the line, whoever did it, by going back in time.
    pub(super) fn travel_back(&mut self) -> Result<(), Problem> {
        let before = (self.history.done, self.figures().metamers);
        self.undo()?;
        // Otherwise parameters are again what the line says.
        let has_travelled = self.history.done < before.0;
        let set_back =
            Switched { kind: OperationKind::Parameters, away: true, fell: 0, rose: 0, held: 0, passed: 0 };
        let travelled = self.travelled(self.history.done, before.1);
        self.switched = if has_travelled { travelled } else { Some(set_back) };
        Ok(())
    }

    /// Does again what was taken back last on the line, by going forth in time.
    pub(super) fn travel_forth(&mut self) -> Result<(), Problem> {
        let before = self.figures().metamers;
        self.redo()?;
        self.switched = self.history.done.checked_sub(1).and_then(|last| self.travelled(last, before));
        Ok(())
    }

    /// What came of a journey past an operation, before which so many metamers lived.
    fn travelled(&self, operation: usize, before: u32) -> Option<Switched> {
        let kind = self.history.operations.get(operation)?.kind.into();
        let living = self.figures().metamers;
        let (fell, rose) = (before.saturating_sub(living), living.saturating_sub(before));
        Some(Switched { kind, away: operation >= self.history.done, fell, rose, held: 0, passed: 0 })
    }

    /// What came of the last deed that was taken back or brought back, if it was not told yet.
    pub(crate) fn take_switched(&mut self) -> Option<Switched> {
        self.switched.take()
    }

    /// Puts in force again what somebody took back last (`UD3`).
    pub(super) fn bring_back(&mut self, cause: Cause<'_>, person: &Person<'_>) -> Result<(), Problem> {
        if self.is_alone(person) {
            return self.travel_forth();
        }
        let deed = self.history.taken_back_last(person).ok_or_else(nothing_to_redo)?;
        if self.switch(cause, person, Kind::BroughtBack, deed)? { Ok(()) } else { Err(nothing_to_redo()) }
    }

    /// Whether nobody else has done anything on the line, or is about to: then going back in time takes nothing from
    /// anybody. What was done elsewhere is nobody's here.
    fn is_alone(&self, person: &Person<'_>) -> bool {
        let is_own = |author: &Principal| person.is(author) || author.is_elsewhere();
        let is_free = |operation: &Operation| match operation.is_joint {
            false => is_own(&operation.author),
            true => operation.authors().all(Principal::is_elsewhere),
        };
        self.history.operations.iter().all(is_free)
            && self.strokes.open.iter().all(|open| is_own(&open.author))
            && self.bends.open.iter().all(|open| is_own(&open.author))
    }

    /// Ends the strokes of somebody where they are, and gives their bends up; whether there were any.
    fn end_gestures_of(&mut self, person: &Person<'_>) -> bool {
        let open = (self.strokes.open.len(), self.bends.open.len());
        for open in self.strokes.open.extract_if(.., |open| person.is(&open.author)) {
            self.simulation.end_stroke(open.id);
        }
        self.bends.open.retain(|bend| !person.is(&bend.author));
        let has_ended = open != (self.strokes.open.len(), self.bends.open.len());
        if has_ended && self.strokes.is_empty() {
            self.simulation.drop_guidance();
            self.forget_idle();
        }
        has_ended
    }

    /// Records that a deed is in force no more, or again; whether that changed anything.
    fn switch(
        &mut self,
        cause: Cause<'_>,
        person: &Person<'_>,
        kind: Kind,
        (deed, part): (usize, u8),
    ) -> Result<bool, Problem> {
        let recorded = self.record(kind, Cause { gesture: None, ..cause });
        self.history.concern(deed, part);
        let claims = self.history.claims(self.plant());
        let settled = self.history.folded(&self.setting()).and_then(|setting| {
            self.require_design_open_for(&setting)?;
            self.require_bends_kept(&claims, person)?;
            let settled = self.simulation.settle(&claims).map_err(said("kind"))?;
            Ok((setting, settled))
        });
        let (setting, settled) = match settled {
            Ok((setting, settled)) if settled.is_recorded || setting != self.setting() => (setting, settled),
            unchanged => {
                self.refuse(recorded);
                return unchanged.map(|_| false);
            }
        };
        let operation = &self.history.operations[deed];
        let (what, away, born) = (operation.kind, kind == Kind::TakenBack, operation.born(self.plant()));
        let runs = operation.runs_of(born.clone());
        let is_of_part = |row: u32| runs.iter().all(|(rows, run)| run.part == part || !rows.contains(&row));
        let is_of_it = |row: &&MetamerId| away && born.contains(&row.raw()) && is_of_part(row.raw());
        let held = settled.held.iter().filter(is_of_it).count() as u32;
        let (fell, rose) = (settled.falls.len() as u32, settled.rises.len() as u32);
        self.switched = Some(Switched { kind: what.into(), away, fell, rose, held, passed: 0 });
        self.set(&setting);
        self.history.settle(setting);
        self.keep_grammar_to(deed, away);
        self.history.keep_places(settled.falls.len() + settled.rises.len());
        self.reach();
        self.release_lost_bends();
        Ok(true)
    }

    /// Refuses what would fell or move wood that somebody else is bending.
    fn require_bends_kept(&self, claims: &Claims, person: &Person<'_>) -> Result<(), Problem> {
        let mut bent = self.bends.open.iter().filter(|bend| !person.is(&bend.author)).peekable();
        if bent.peek().is_none() {
            return Ok(());
        }
        let (now, mut then) = (self.plant(), self.plant().clone());
        then.stash_future();
        then.settle(claims);
        then.go_to(then.last_step());
        let is_kept =
            |&id: &MetamerId| then.is_alive(id) && then.metamers().end(id) == now.metamers().end(id);
        match bent.flat_map(|bend| &bend.path).find(|id| !is_kept(id)) {
            Some(&row) => Err(held("kind", row)),
            None => Ok(()),
        }
    }

    /// Refuses what would end a bend of somebody else.
    pub(super) fn require_no_bend_but_of(&self, is_own: impl Fn(&Principal) -> bool) -> Result<(), Problem> {
        if self.bends.open.iter().all(|bend| is_own(&bend.author)) {
            return Ok(());
        }
        let message = "somebody else is bending a branch";
        Err(Problem::new(Reason::BeingBent, message).at("kind", "what nobody else's bend is in the way of"))
    }
}

fn design_let_go() -> Problem {
    let message = "the design that you changed is in force no more, for somebody let it go or began another one; what you \
                   said in it stays with its wood";
    Problem::new(Reason::DesignGone, message).at("kind", "a deed beside that design")
}
