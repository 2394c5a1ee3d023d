//! A step of a grammar on its way: derived and drawn a slice at a time beside the plants, and laid down once it is whole.

use std::{mem, sync::Arc};

use espalier_grammar::{Derivation, Drawing, Progress, Stop, WoodOptions};
use espalier_growth::{Drawn, Parameters, Rewriting, Rewritten, Scene};

use super::{
    InForce, LIMITS, Source, Write, WriteError, Written, options,
    surroundings::{Asking, Told},
};

/// What a slice may cost: modules taken and made, and steps of computing.
const SLICE: u64 = 1_500_000;
/// Modules that are worked on before the cost is looked at.
const PART: usize = 20_000;

/// What grammars keep that follows from the rest.
#[derive(Clone, Debug, Default)]
pub(in crate::document) struct Grammars {
    /// The word of the grammar in force, so that it need not be derived again.
    at_hand: Option<(Arc<Written>, Arc<Derivation>)>,
    /// What is on its way.
    writing: Option<Box<Writing>>,
    /// Whether the last slice only derived again what had been derived before.
    pub was_again: bool,
    /// Why the last step could not be written.
    pub refusal: Option<WriteError>,
    /// Metamers that the last step moved.
    pub moved: usize,
}

/// What came of a slice.
pub(in crate::document) enum Wrote {
    /// The step goes on.
    InPart,
    /// It stands, and this is in force.
    Whole(InForce),
    /// It cannot be.
    Nothing,
}

/// A step on its way.
#[derive(Clone, Debug)]
struct Writing {
    source: Arc<Source>,
    /// What was written before, where that goes on.
    former: Option<Arc<Written>>,
    goes_on: bool,
    depth: u32,
    /// Whether hands have changed what was written before.
    is_edited: bool,
    /// What was drawn last, where hands have moved it since.
    before: Option<espalier_grammar::Drawn>,
    answers: Vec<Arc<[f64]>>,
    /// Answers in the step of derivation that is not at its end.
    asked: Vec<f64>,
    stage: Stage,
}

#[derive(Clone, Debug)]
enum Stage {
    /// The word of what was written before is derived again; so many answers of this step have been told.
    Again(Derivation, usize),
    /// That word is drawn again.
    Before(Derivation, Drawing),
    Deriving(Derivation),
    Drawing(Derivation, Drawing),
    Whole(Derivation, espalier_grammar::Drawn),
    /// It ended early.
    Ended,
}

impl Grammars {
    /// Writes a slice of a step, the first one if none is on its way.
    pub fn write(
        &mut self,
        scene: &mut Scene,
        parameters: &Parameters,
        now: &InForce,
        write: &Write,
    ) -> Wrote {
        match self.go_on(scene, parameters, now.0.as_ref(), write) {
            Ok(None) => Wrote::InPart,
            Ok(Some(written)) => {
                self.refusal = None;
                Wrote::Whole(InForce(Some(written)))
            }
            Err(error) => {
                (self.refusal, self.moved, self.writing) = (Some(error), 0, None);
                Wrote::Nothing
            }
        }
    }

    /// Whether a step is on its way.
    pub fn is_writing(&self) -> bool {
        self.writing.is_some()
    }

    /// Lets go of what is on its way.
    pub fn give_up(&mut self) {
        self.writing = None;
    }

    /// Bytes of words: that at hand, and what is on its way.
    pub fn bytes(&self) -> usize {
        let at_hand = self.at_hand.as_ref().map_or(0, |(_, derivation)| derivation.bytes());
        at_hand + self.writing.as_ref().map_or(0, |writing| writing.bytes())
    }

    fn go_on(
        &mut self,
        scene: &mut Scene,
        parameters: &Parameters,
        now: Option<&Arc<Written>>,
        write: &Write,
    ) -> Result<Option<Arc<Written>>, WriteError> {
        self.was_again = false;
        let options = options(scene, parameters);
        let mut writing = match self.writing.take() {
            Some(writing) => writing,
            None => Box::new(self.begin(scene, options, now, write)?),
        };
        self.was_again = matches!(writing.stage, Stage::Again(..));
        if !writing.slice(scene, options)? {
            self.writing = Some(writing);
            return Ok(None);
        }
        let (written, moved, derivation) = writing.lay_down(scene, parameters, write)?;
        self.moved = moved;
        self.at_hand = Some((Arc::clone(&written), Arc::new(derivation)));
        Ok(Some(written))
    }

    fn begin(
        &mut self,
        scene: &Scene,
        options: WoodOptions,
        now: Option<&Arc<Written>>,
        write: &Write,
    ) -> Result<Writing, WriteError> {
        let (source, former, goes_on) = match write {
            Write::Derive => {
                let now = now.ok_or(WriteError::NoGrammar)?;
                (&now.source, Some(now), true)
            }
            Write::Set { source, is_new, .. } => (source, now.filter(|_| !is_new), false),
        };
        let is_edited = former.is_some_and(|now| now.is_edited || now.step != scene.plant().step());
        let mut writing = Writing {
            source: Arc::clone(source),
            former: former.cloned(),
            goes_on,
            depth: match write {
                Write::Derive => former.map_or(0, |now| now.depth) + 1,
                Write::Set { depth, .. } => *depth,
            },
            is_edited,
            before: None,
            answers: former.filter(|_| goes_on).map(|now| now.answers.clone()).unwrap_or_default(),
            asked: Vec::new(),
            stage: Stage::Ended,
        };
        writing.stage = match former.filter(|_| goes_on || is_edited) {
            None => Stage::Deriving(begun(source)?),
            Some(of) => match self.at_hand.take_if(|(at_hand, _)| Arc::ptr_eq(at_hand, of)) {
                Some((_, derivation)) => writing.after_last(Arc::unwrap_or_clone(derivation), options)?,
                None => Stage::Again(begun(&of.source)?, 0),
            },
        };
        Ok(writing)
    }
}

fn begun(source: &Source) -> Result<Derivation, Stop> {
    Derivation::new(Arc::clone(&source.program), source.seed, LIMITS)
}

impl Writing {
    fn keys(&self) -> Option<Vec<u64>> {
        let former = self.former.as_ref()?;
        Some(former.rows.iter().map(|&(key, _)| key).collect())
    }

    fn bytes(&self) -> usize {
        match &self.stage {
            Stage::Again(derivation, _)
            | Stage::Before(derivation, _)
            | Stage::Deriving(derivation)
            | Stage::Drawing(derivation, _)
            | Stage::Whole(derivation, _) => derivation.bytes(),
            Stage::Ended => 0,
        }
    }

    /// What comes when the word of what was written before is there.
    fn after_last(&self, last: Derivation, options: WoodOptions) -> Result<Stage, Stop> {
        match self.keys().filter(|_| self.is_edited) {
            Some(keys) => {
                let drawing = last.drawing_on(options, &keys);
                Ok(Stage::Before(last, drawing))
            }
            None => self.after_before(last),
        }
    }

    fn after_before(&self, last: Derivation) -> Result<Stage, Stop> {
        Ok(Stage::Deriving(if self.goes_on { last } else { begun(&self.source)? }))
    }

    /// Works for a slice; whether all is derived and drawn. What derives again has slices of its own, for whether it is
    /// needed depends on what is at hand, and everything else is to come in the same slices.
    fn slice(&mut self, scene: &Scene, options: WoodOptions) -> Result<bool, Stop> {
        let mut left = SLICE;
        let mut spend = |cost: u64| {
            left = left.saturating_sub(cost + 1);
            left > 0
        };
        loop {
            let mut goes_on = true;
            self.stage = match mem::replace(&mut self.stage, Stage::Ended) {
                Stage::Again(mut last, mut told) => {
                    let depth = self.former.as_ref().map_or(0, |former| former.depth);
                    while goes_on && last.depth() < depth {
                        let before = last.work();
                        told = self.derive_again(&mut last, told)?;
                        goes_on = spend(last.work() - before);
                    }
                    self.stage = match last.depth() < depth {
                        true => Stage::Again(last, told),
                        false => self.after_last(last, options)?,
                    };
                    return Ok(false);
                }
                Stage::Before(last, mut drawing) => {
                    let source = self.former.as_ref().map_or(&self.source, |former| &former.source);
                    let asking = Asking::new(scene, Arc::clone(source));
                    if draw(&mut drawing, &last, &asking, &mut spend)? {
                        self.before = Some(drawing.finish()?);
                        self.after_before(last)?
                    } else {
                        goes_on = false;
                        Stage::Before(last, drawing)
                    }
                }
                Stage::Deriving(mut derivation) => {
                    while goes_on && derivation.depth() < self.depth {
                        let before = derivation.work();
                        self.derive(&mut derivation, scene)?;
                        goes_on = spend(derivation.work() - before);
                    }
                    if derivation.depth() < self.depth {
                        Stage::Deriving(derivation)
                    } else {
                        let drawing = match self.keys() {
                            Some(keys) => derivation.drawing_on(options, &keys),
                            None => derivation.drawing(options),
                        };
                        Stage::Drawing(derivation, drawing)
                    }
                }
                Stage::Drawing(derivation, mut drawing) => {
                    let asking = Asking::new(scene, Arc::clone(&self.source));
                    if draw(&mut drawing, &derivation, &asking, &mut spend)? {
                        self.stage = Stage::Whole(derivation, drawing.finish()?);
                        return Ok(true);
                    }
                    goes_on = false;
                    Stage::Drawing(derivation, drawing)
                }
                whole @ Stage::Whole(..) => {
                    self.stage = whole;
                    return Ok(true);
                }
                Stage::Ended => return Err(Stop::Broken),
            };
            if !goes_on {
                return Ok(false);
            }
        }
    }

    fn derive(&mut self, derivation: &mut Derivation, scene: &Scene) -> Result<(), Stop> {
        let asking = Asking::new(scene, Arc::clone(&self.source));
        let came = derivation.advance(&asking, PART)?;
        if self.source.asks {
            self.asked.extend_from_slice(&asking.answers());
            if came == Progress::Stepped {
                self.answers.push(mem::take(&mut self.asked).into());
            }
        }
        Ok(())
    }

    /// Returns how many answers of the step in progress have been told then.
    fn derive_again(&self, last: &mut Derivation, told: usize) -> Result<usize, Stop> {
        let step = last.depth() as usize;
        let answers = self.former.as_ref().and_then(|former| former.answers.get(step)).cloned();
        let surroundings = Told::new(answers.unwrap_or_default(), told);
        match last.advance(&surroundings, PART)? {
            Progress::Stepped => Ok(0),
            Progress::Working => Ok(surroundings.told()),
        }
    }

    /// Lets the plants be as it is drawn, and says what is written then, how many metamers moved, and the word.
    fn lay_down(
        self,
        scene: &mut Scene,
        parameters: &Parameters,
        write: &Write,
    ) -> Result<(Arc<Written>, usize, Derivation), WriteError> {
        let Stage::Whole(derivation, drawn) = self.stage else { return Err(Stop::Broken.into()) };
        let former = self.former.as_ref();
        let rewriting = Rewriting {
            now: Drawn { wood: &drawn.wood, keys: &drawn.keys },
            before: self.before.as_ref().map(|drawn| Drawn { wood: &drawn.wood, keys: &drawn.keys }),
            rows: former.map_or(&[], |now| now.rows.as_slice()),
            at: self.source.at,
        };
        rewriting.check(scene)?;
        let begun = scene.plant().step();
        let is_edit = matches!(write, Write::Set { is_new: false, .. });
        let Rewritten { rows, moved } = match is_edit {
            true => scene.record_edit(|step| rewriting.write(step, parameters)),
            false => scene.record_growth(|step| rewriting.write(step, parameters)),
        }?;
        let written = Arc::new(Written {
            depth: self.depth,
            answers: self.answers,
            rows,
            step: scene.plant().step(),
            is_edited: self.is_edited,
            begun: former.map_or(begun, |now| now.begun),
            source: self.source,
        });
        Ok((written, moved, derivation))
    }
}

/// Draws until all is drawn, which it says, or the slice is spent.
fn draw(
    drawing: &mut Drawing,
    derivation: &Derivation,
    asking: &Asking<'_>,
    spend: &mut impl FnMut(u64) -> bool,
) -> Result<bool, Stop> {
    loop {
        let before = drawing.work();
        if drawing.advance(derivation, asking, PART)? {
            return Ok(true);
        }
        if !spend(drawing.work() - before) {
            return Ok(false);
        }
    }
}
