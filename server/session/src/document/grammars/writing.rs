//! A step of a grammar on its way: derived and drawn a slice at a time beside the plants, and laid down once it is whole.

use std::{mem, sync::Arc};

use espalier_grammar::{Derivation, Drawing, Progress, Stop, WoodOptions};
use espalier_growth::{Drawn, Growth, Rewriting, Rewritten, Scene};

use super::{
    InForce, LIMITS, Source, Write, WriteError, Written,
    anew::Anew,
    options,
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
    /// Metamers that the last step moved, or gave other organs.
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
    /// Where it grows from its axiom on, if what it asks for would be in the way of itself.
    anew: Option<Box<Anew>>,
    stage: Stage,
}

/// What a slice goes by.
#[derive(Clone, Copy)]
struct Around<'a> {
    scene: &'a Scene,
    growth: &'a Growth,
    options: WoodOptions,
}

#[derive(Clone, Debug)]
enum Stage {
    /// The word of what was written before is derived again; so many answers of this step have been told.
    Again(Derivation, usize),
    /// That word is drawn again.
    Before(Derivation, Drawing),
    Deriving(Derivation),
    /// The word is drawn where it grows anew, to be asked of in the next step.
    Standing(Derivation, Drawing),
    Drawing(Derivation, Drawing),
    Whole(Derivation, espalier_grammar::Drawn),
    /// It ended early.
    Ended,
}

impl Grammars {
    /// Writes a slice of a step, the first one if none is on its way.
    pub fn write(&mut self, scene: &mut Scene, growth: &Growth, now: &InForce, write: &Write) -> Wrote {
        match self.go_on(scene, growth, now.0.as_ref(), write) {
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
        growth: &Growth,
        now: Option<&Arc<Written>>,
        write: &Write,
    ) -> Result<Option<Arc<Written>>, WriteError> {
        self.was_again = false;
        let around = Around { scene, growth, options: options(scene, growth.parameters()) };
        let mut writing = match self.writing.take() {
            Some(writing) => writing,
            None => Box::new(self.begin(around, now, write)?),
        };
        self.was_again = matches!(writing.stage, Stage::Again(..));
        if !writing.slice(around)? {
            self.writing = Some(writing);
            return Ok(None);
        }
        let (written, moved, derivation) = writing.lay_down(scene, growth, write)?;
        self.moved = moved;
        self.at_hand = Some((Arc::clone(&written), Arc::new(derivation)));
        Ok(Some(written))
    }

    fn begin(
        &mut self,
        around: Around<'_>,
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
        let is_edited = former.is_some_and(|now| now.is_edited || now.step != around.scene.plant().step());
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
            anew: None,
            stage: Stage::Ended,
        };
        writing.stage = match former.filter(|_| goes_on || is_edited) {
            None => writing.after_before(None, around)?,
            Some(of) => match self.at_hand.take_if(|(at_hand, _)| Arc::ptr_eq(at_hand, of)) {
                Some((_, derivation)) => writing.after_last(Arc::unwrap_or_clone(derivation), around)?,
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
            | Stage::Standing(derivation, _)
            | Stage::Drawing(derivation, _)
            | Stage::Whole(derivation, _) => derivation.bytes(),
            Stage::Ended => 0,
        }
    }

    /// What comes when the word of what was written before is there.
    fn after_last(&mut self, last: Derivation, around: Around<'_>) -> Result<Stage, Stop> {
        match self.keys().filter(|_| self.is_edited) {
            Some(keys) => {
                let drawing = last.drawing_on(around.options, &keys);
                Ok(Stage::Before(last, drawing))
            }
            None => self.after_before(Some(last), around),
        }
    }

    /// What comes when it is known how that stands.
    fn after_before(&mut self, last: Option<Derivation>, around: Around<'_>) -> Result<Stage, Stop> {
        if let Some(last) = last.filter(|_| self.goes_on) {
            return Ok(Stage::Deriving(last));
        }
        let axiom = begun(&self.source)?;
        match self.former.as_ref().filter(|_| self.source.asks_of_wood && self.depth > 0) {
            Some(former) => {
                let anew = Box::new(Anew::new(around.scene, around.growth, &self.source, former));
                let drawing = axiom.drawing_on(around.options, &anew.keys());
                self.anew = Some(anew);
                Ok(Stage::Standing(axiom, drawing))
            }
            None => Ok(Stage::Deriving(axiom)),
        }
    }

    /// Whom the grammar asks.
    fn asking<'a>(&'a self, around: Around<'a>) -> Asking<'a> {
        match &self.anew {
            Some(anew) => Asking::new(&anew.scene, &anew.growth, &self.source),
            None => Asking::new(around.scene, around.growth, &self.source),
        }
    }

    /// Works for a slice; whether all is derived and drawn. What derives again has slices of its own, for whether it is
    /// needed depends on what is at hand, and everything else is to come in the same slices.
    fn slice(&mut self, around: Around<'_>) -> Result<bool, WriteError> {
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
                        false => self.after_last(last, around)?,
                    };
                    return Ok(false);
                }
                Stage::Before(last, mut drawing) => {
                    let source = self.former.as_ref().map_or(&self.source, |former| &former.source);
                    let asking = Asking::new(around.scene, around.growth, source);
                    if draw(&mut drawing, &last, &asking, &mut spend)? {
                        self.before = Some(drawing.finish()?);
                        let next = self.after_before(Some(last), around)?;
                        goes_on = spend(self.anew.as_ref().map_or(0, |anew| anew.cost()));
                        next
                    } else {
                        goes_on = false;
                        Stage::Before(last, drawing)
                    }
                }
                Stage::Deriving(mut derivation) => {
                    // Where it grows anew it stands as it was derived before it is derived further.
                    let until = match self.anew.as_ref().map(|anew| anew.depth) {
                        Some(stands) => stands.map_or(0, |stands| stands + 1).min(self.depth),
                        None => self.depth,
                    };
                    while goes_on && derivation.depth() < until {
                        let before = derivation.work();
                        self.derive(&mut derivation, around)?;
                        goes_on = spend(derivation.work() - before);
                    }
                    match (&self.anew, self.keys()) {
                        _ if derivation.depth() < until => Stage::Deriving(derivation),
                        (Some(anew), _) if until < self.depth => {
                            let drawing = derivation.drawing_on(around.options, &anew.keys());
                            Stage::Standing(derivation, drawing)
                        }
                        (_, Some(keys)) => {
                            let drawing = derivation.drawing_on(around.options, &keys);
                            Stage::Drawing(derivation, drawing)
                        }
                        (_, None) => {
                            let drawing = derivation.drawing(around.options);
                            Stage::Drawing(derivation, drawing)
                        }
                    }
                }
                Stage::Standing(derivation, mut drawing) => {
                    if draw(&mut drawing, &derivation, &self.asking(around), &mut spend)? {
                        let drawn = drawing.finish()?;
                        let anew = self.anew.as_mut().ok_or(Stop::Broken)?;
                        anew.lay_down(&self.source, &drawn, derivation.depth())?;
                        goes_on = spend(anew.cost());
                        Stage::Deriving(derivation)
                    } else {
                        goes_on = false;
                        Stage::Standing(derivation, drawing)
                    }
                }
                Stage::Drawing(derivation, mut drawing) => {
                    if draw(&mut drawing, &derivation, &self.asking(around), &mut spend)? {
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
                Stage::Ended => return Err(Stop::Broken.into()),
            };
            if !goes_on {
                return Ok(false);
            }
        }
    }

    fn derive(&mut self, derivation: &mut Derivation, around: Around<'_>) -> Result<(), Stop> {
        let asking = self.asking(around);
        let came = derivation.advance(&asking, PART)?;
        let answers = asking.answers();
        if self.source.asks {
            self.asked.extend_from_slice(&answers);
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
        growth: &Growth,
        write: &Write,
    ) -> Result<(Arc<Written>, usize, Derivation), WriteError> {
        let Stage::Whole(derivation, drawn) = self.stage else { return Err(Stop::Broken.into()) };
        let former = self.former.as_ref();
        let rewriting = Rewriting {
            now: Drawn { wood: &drawn.wood, keys: &drawn.keys },
            before: self.before.as_ref().map(|drawn| Drawn { wood: &drawn.wood, keys: &drawn.keys }),
            rows: former.map_or(&[], |now| now.rows.as_slice()),
            ends: former.map_or(&[], |now| now.ends.as_slice()),
            at: self.source.at,
        };
        rewriting.check(scene)?;
        let begun = scene.plant().step();
        let is_edit = matches!(write, Write::Set { is_new: false, .. });
        let parameters = growth.parameters();
        let Rewritten { rows, ends, moved } = match is_edit {
            true => scene.record_edit(|step| rewriting.write(step, parameters)),
            false => scene.record_growth(|step| rewriting.write(step, parameters)),
        }?;
        let written = Arc::new(Written {
            depth: self.depth,
            answers: self.answers,
            rows,
            ends,
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
