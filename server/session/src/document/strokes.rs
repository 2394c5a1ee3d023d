//! Strokes in progress, cut into the pieces that guide single steps.

use espalier_growth::{BrushPiece, BrushSample, StepInput, StrokeId};
use espalier_plant::{MetamerId, hash::StableHash};
use espalier_proto::{Problem, Reason, StrokeSample};

use crate::{principal::Principal, stroke_pieces::pieces};

/// Strokes open at once; more fingers than this on one tree are a mistake or an attack.
pub(super) const MAX_OPEN: usize = 32;

/// One stroke between its begin and its end.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OpenStroke {
    pub author: Principal,
    /// The author's number for it.
    pub number: u32,
    /// The document's own name for it.
    pub id: StrokeId,
    /// The axis that alone grows; all of them without one.
    pub chosen: Option<MetamerId>,
    /// Where the brush was last.
    pub last: Option<BrushSample>,
}

/// All strokes in progress.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct OpenStrokes {
    pub open: Vec<OpenStroke>,
    /// Strokes ever begun: names them, and keys their randomness.
    pub begun: u32,
}

impl OpenStrokes {
    pub fn is_empty(&self) -> bool {
        self.open.is_empty()
    }

    pub fn of(&self, author: &Principal) -> Vec<u32> {
        self.open.iter().filter(|s| s.author == *author).map(|s| s.number).collect()
    }

    pub fn open(
        &mut self,
        author: &Principal,
        number: u32,
        chosen: Option<MetamerId>,
    ) -> Result<StrokeId, Problem> {
        if self.find(author, number).is_some() {
            let message = format!("stroke {number} has begun already");
            return Err(Problem::new(Reason::NumberTaken, message)
                .at("stroke", "a number that no stroke in progress has"));
        }
        if self.open.len() >= MAX_OPEN {
            let message = format!("{MAX_OPEN} strokes are in progress; end one first");
            return Err(Problem::new(Reason::StrokesFull, message)
                .at("stroke", format!("up to {MAX_OPEN} strokes in progress")));
        }
        self.begun = self.begun.wrapping_add(1);
        let id = StrokeId(self.begun);
        self.open.push(OpenStroke { author: author.clone(), number, id, chosen, last: None });
        Ok(id)
    }

    /// Ends a stroke.
    pub fn close(&mut self, author: &Principal, number: u32) -> Result<OpenStroke, Problem> {
        let index = self.find(author, number).ok_or_else(|| unknown(number))?;
        Ok(self.open.remove(index))
    }

    pub fn close_all(&mut self) {
        self.open.clear();
    }

    /// Takes in more of a stroke and cuts it into steps: as many as its path is long in shoots of
    /// `longest` internodes.
    pub fn extend(
        &mut self,
        author: &Principal,
        number: u32,
        samples: &[StrokeSample],
        longest: u32,
    ) -> Result<Vec<StepInput>, Problem> {
        let index = self.find(author, number).ok_or_else(|| unknown(number))?;
        let stroke = &mut self.open[index];
        let new = samples.iter().map(|s| BrushSample { position: s.position.get(), radius: s.radius.get() });
        let path: Vec<BrushSample> = stroke.last.into_iter().chain(new).collect();
        stroke.last = path.last().copied();
        let (id, chosen) = (stroke.id, stroke.chosen);
        let piece = |samples| StepInput {
            pieces: vec![BrushPiece { stroke: id, samples }],
            autonomous: false,
            chosen,
        };
        Ok(pieces(path, longest).into_iter().map(piece).collect())
    }

    pub fn hash(&self, hash: &mut StableHash) {
        hash.word(u64::from(self.begun));
        for stroke in &self.open {
            hash.word(u64::from(stroke.number) | u64::from(stroke.id.0) << 32);
            hash.word(stroke.chosen.map_or(u64::MAX, |metamer| u64::from(metamer.raw())));
            if let Some(last) = stroke.last {
                hash.vector(last.position);
                hash.word(u64::from(last.radius.to_bits()));
            }
        }
    }

    fn find(&self, author: &Principal, number: u32) -> Option<usize> {
        self.open.iter().position(|s| s.number == number && s.author == *author)
    }
}

fn unknown(number: u32) -> Problem {
    Problem::new(Reason::StrokeGone, format!("there is no stroke {number} in progress"))
        .at("stroke", "the number of a stroke in progress")
}

#[cfg(test)]
mod tests {
    use super::*;
    use espalier_proto::{BrushRadius, Position};
    use glam::Vec3;

    fn sample(x: f32) -> StrokeSample {
        StrokeSample {
            position: Position::nearest(Vec3::new(x, 10.0, 0.0)),
            radius: BrushRadius::nearest(1.0),
        }
    }

    fn extend(strokes: &mut OpenStrokes, xs: &[f32]) -> Vec<StepInput> {
        let samples: Vec<StrokeSample> = xs.iter().map(|&x| sample(x)).collect();
        strokes.extend(&Principal::visitor(), 1, &samples, 4).expect("the stroke is open")
    }

    #[test]
    fn cm6_a_path_runs_a_step_per_shoot() {
        let mut strokes = OpenStrokes::default();
        strokes.open(&Principal::visitor(), 1, None).expect("nothing is open");
        assert_eq!(extend(&mut strokes, &[0.0]).len(), 1);
        assert_eq!(extend(&mut strokes, &[0.0]).len(), 1);
        assert_eq!(extend(&mut strokes, &[3.0, 9.0]).len(), 3);
        assert_eq!(extend(&mut strokes, &[999.0]).len(), 16);
    }

    #[test]
    fn pieces_join_without_a_gap() {
        let mut strokes = OpenStrokes::default();
        strokes.open(&Principal::visitor(), 1, None).expect("nothing is open");
        extend(&mut strokes, &[0.0]);
        let steps = extend(&mut strokes, &[1.0, 2.5, 7.0, 7.0, 30.0]);
        let mut end = 0.0;
        for step in &steps {
            let samples = &step.pieces[0].samples;
            assert!((samples[0].position.x - end).abs() < 1e-4);
            end = samples[samples.len() - 1].position.x;
        }
        assert!((end - 30.0).abs() < 1e-4);
    }
}
