//! A programme worked out: its parameters as whole sets, its strokes cut into steps.

use std::{ops::Range, sync::Arc};

use espalier_growth::{BrushPiece, BrushSample, StepInput, StrokeId};
use espalier_proto::{Problem, Programme, Stage, version::MAX_AGE};
use espalier_settings::ParameterValues;
use glam::Vec3;

use crate::{form::on_ground, stroke_pieces::pieces};

/// A programme, and what follows from it.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    programme: Arc<Programme>,
    /// Its parameters from an age on; the first from 0.
    values: Vec<(u32, ParameterValues)>,
    strokes: Vec<Stroke>,
    seeds: Vec<(u32, Vec3)>,
}

/// A stroke of a programme.
#[derive(Clone, Debug, PartialEq)]
struct Stroke {
    /// The ages at which it moves or its markers still live.
    ages: Range<u32>,
    /// What it does, age by age.
    pieces: Vec<Vec<BrushSample>>,
}

/// What a plant does in a step of its age.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ScheduledAction {
    /// It grows without guidance.
    Alone,
    /// It follows a brush.
    Follow(BrushPiece),
    /// The brush is lifted, and buds find what it has left, until that is used up or this age is reached.
    Settle(StrokeId, u32),
}

impl Plan {
    /// Works a programme out.
    ///
    /// # Errors
    ///
    /// A parameter is out of its range, or stages are out of order.
    pub(crate) fn new(programme: Programme) -> Result<Self, Problem> {
        let base = ParameterValues::default().patched(&programme.parameters);
        base.check().map_err(|error| error.within("parameters"))?;
        let programme = Arc::new(programme);
        let mut plan = Self {
            programme: Arc::clone(&programme),
            values: vec![(0, base.clone())],
            strokes: Vec::new(),
            seeds: Vec::new(),
        };
        let mut last = 0;
        for (index, stage) in programme.stages.iter().enumerate() {
            let at = format!("stages[{index}]");
            let age = stage.age();
            if age < last {
                return Err(Problem::out_of_range("age", age, format!("{last} to {MAX_AGE}")).within(&at));
            }
            last = age;
            match stage {
                Stage::Change { parameters, .. } => {
                    let values = base.patched(parameters);
                    values.check().map_err(|error| error.within("parameters").within(&at))?;
                    plan.values.push((age, values));
                }
                Stage::Seed { position, .. } => {
                    let place = on_ground(*position).map_err(|problem| problem.within(&at))?;
                    plan.seeds.push((age, place));
                }
                Stage::Stroke { samples, .. } => {
                    let begun = plan.strokes.last().map_or(age, |before| before.ages.end.max(age));
                    let places = samples
                        .iter()
                        .map(|s| BrushSample { position: s.position.get(), radius: s.radius.get() });
                    let values = values_at(&plan.values, begun);
                    let pieces = stroke(places, values.max_shoot_length);
                    let end = begun + span(pieces.len(), values);
                    plan.strokes.push(Stroke { ages: begun..end, pieces });
                }
            }
        }
        Ok(plan)
    }

    /// The programme as it was given.
    pub(crate) fn programme(&self) -> &Arc<Programme> {
        &self.programme
    }

    /// Its parameters from an age on; the first from 0.
    pub(crate) fn values(&self) -> &[(u32, ParameterValues)] {
        &self.values
    }

    /// The places of seeds that are sown at an age.
    pub(crate) fn seeds_at(&self, age: u32) -> impl Iterator<Item = Vec3> + '_ {
        self.seeds.iter().filter(move |(at, _)| *at == age).map(|&(_, place)| place)
    }

    /// What is done at an age.
    pub(crate) fn action_at(&self, age: u32) -> ScheduledAction {
        let Some(index) = self.strokes.iter().position(|stroke| stroke.ages.contains(&age)) else {
            return ScheduledAction::Alone;
        };
        let (name, Stroke { ages, pieces }) = (StrokeId::of_programme(index as u32), &self.strokes[index]);
        match pieces.get((age - ages.start) as usize) {
            Some(samples) => ScheduledAction::Follow(BrushPiece { stroke: name, samples: samples.clone() }),
            None => ScheduledAction::Settle(name, ages.end),
        }
    }

    /// How long a stroke takes that begins under these parameters, in steps of age.
    pub(crate) fn span_of(samples: &[BrushSample], values: &ParameterValues) -> u32 {
        span(stroke(samples.iter().copied(), values.max_shoot_length).len(), values)
    }
}

impl PartialEq for Plan {
    /// Everything else follows from the programme.
    fn eq(&self, other: &Self) -> bool {
        self.programme == other.programme
    }
}

impl ScheduledAction {
    /// What the plant does in a step of it.
    pub(crate) fn input(&self) -> StepInput {
        match self {
            Self::Alone => StepInput { autonomous: true, ..StepInput::default() },
            Self::Follow(piece) => StepInput { pieces: vec![piece.clone()], ..StepInput::default() },
            Self::Settle(..) => StepInput::default(),
        }
    }

    /// The stroke it is part of.
    pub(crate) fn stroke(&self) -> Option<StrokeId> {
        match self {
            Self::Alone => None,
            Self::Follow(piece) => Some(piece.stroke),
            Self::Settle(stroke, _) => Some(*stroke),
        }
    }
}

/// A stroke whose brush reaches one place after the other, in steps.
fn stroke(places: impl Iterator<Item = BrushSample>, longest: u32) -> Vec<Vec<BrushSample>> {
    let mut last = None;
    places
        .flat_map(|place| pieces(last.replace(place).into_iter().chain([place]).collect(), longest))
        .collect()
}

/// How many ages so many steps of a brush take, and the markers that it leaves live.
fn span(steps: usize, values: &ParameterValues) -> u32 {
    steps as u32 + values.marker_max_age
}

fn values_at(values: &[(u32, ParameterValues)], age: u32) -> &ParameterValues {
    let passed = values.partition_point(|(from, _)| *from <= age);
    &values[passed.max(1) - 1].1
}
