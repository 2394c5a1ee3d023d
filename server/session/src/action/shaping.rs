//! Bends, widths, cuts and predictions, checked (`LM7` to `LM10`).

use espalier_proto::{
    Problem, ProblemCode,
    version::{MAX_BEND_TOUCHES, MAX_DIAMETER, MAX_PREDICTED_STEPS, MAX_PRUNED_ROWS, MIN_DIAMETER},
};
use glam::Quat;

use super::{Action, parse_position};

/// How far a quaternion's length may be from 1.
const UNIT_TOLERANCE: f32 = 0.01;

/// A prediction in good form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Prediction {
    /// Rows of branches to do without, up to 1024.
    pub rows: Vec<u32>,
    /// Up to 100; 0 with rows shows the cut alone.
    pub steps: u32,
}

impl Prediction {
    /// Checks a prediction's form; none is asked for without rows and steps.
    pub fn parse(rows: &[u32], steps: u32) -> Result<Option<Self>, Problem> {
        if steps > MAX_PREDICTED_STEPS {
            return Err(Problem::out_of_range("steps", steps, format!("0 to {MAX_PREDICTED_STEPS}")));
        }
        let rows = pruned_rows(rows, 0)?;
        Ok((steps > 0 || !rows.is_empty()).then_some(Self { rows, steps }))
    }
}

pub(super) fn bend_begin(
    bend: u32,
    base: u32,
    touches: &[u32],
    stretch: f32,
    gesture: Option<u32>,
) -> Result<Action, Problem> {
    counted("touches", touches.len(), 1, MAX_BEND_TOUCHES)?;
    if let Some(index) = (1..touches.len()).find(|&index| touches[..index].contains(&touches[index])) {
        let field = format!("touches[{index}]");
        return Err(Problem::out_of_range(field, touches[index], "a row that is touched once"));
    }
    if !(0.0..=1.0).contains(&stretch) {
        return Err(Problem::out_of_range("stretch", stretch, "0 to 1"));
    }
    Ok(Action::BendBegin { bend, base, touches: touches.to_vec(), stretch, gesture })
}

pub(super) fn bend_move(bend: u32, targets: &[[f32; 3]]) -> Result<Action, Problem> {
    counted("targets", targets.len(), 1, MAX_BEND_TOUCHES)?;
    let parse = |(index, target)| {
        let renamed = |field: String| field.replacen("position", &format!("targets[{index}]"), 1);
        parse_position(target).map_err(|problem: Problem| Problem {
            field: problem.field.map(renamed),
            message: renamed(problem.message),
            ..problem
        })
    };
    let targets = targets.iter().enumerate().map(parse).collect::<Result<_, _>>()?;
    Ok(Action::BendMove { bend, targets })
}

pub(super) fn set_width(row: u32, diameter: Option<f32>, gesture: Option<u32>) -> Result<Action, Problem> {
    match diameter {
        Some(diameter) if !(MIN_DIAMETER..=MAX_DIAMETER).contains(&diameter) => {
            let allowed = format!("{MIN_DIAMETER} to {MAX_DIAMETER}, or null");
            Err(Problem::out_of_range("diameter", diameter, allowed))
        }
        diameter => Ok(Action::SetWidth { row, diameter, gesture }),
    }
}

pub(super) fn prune_dim(exposure: f32) -> Result<Action, Problem> {
    if (0.0..=1.0).contains(&exposure) {
        Ok(Action::PruneDim { exposure })
    } else {
        Err(Problem::out_of_range("exposure", exposure, "0 to 1"))
    }
}

/// Rows of branches to be cut, at least so many.
pub(super) fn pruned_rows(rows: &[u32], fewest: usize) -> Result<Vec<u32>, Problem> {
    counted("rows", rows.len(), fewest, MAX_PRUNED_ROWS)?;
    Ok(rows.to_vec())
}

/// A rotation of length 1, within a hundredth.
pub(crate) fn parse_rotation(rotation: &[f32; 4]) -> Result<Quat, Problem> {
    let rotation = Quat::from_array(*rotation);
    let length = rotation.length();
    if ((1.0 - UNIT_TOLERANCE)..=(1.0 + UNIT_TOLERANCE)).contains(&length) {
        return Ok(rotation.normalize());
    }
    let allowed = "four finite numbers that make a quaternion of length 1";
    Err(Problem::out_of_range("rotation", format!("of length {length}"), allowed))
}

fn counted(field: &str, count: usize, fewest: usize, most: usize) -> Result<(), Problem> {
    if (fewest..=most).contains(&count) {
        return Ok(());
    }
    Err(Problem {
        code: if count < fewest { ProblemCode::OutOfRange } else { ProblemCode::TooMany },
        field: Some(field.into()),
        allowed: Some(format!("{fewest} to {most}")),
        message: format!("{field} has {count} entries; allowed: {fewest} to {most}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lm7_a_bend_in_bad_form_names_its_field() {
        for (text, field, allowed) in [
            (r#"{"kind":"bend_begin","bend":1,"base":1,"touches":[],"stretch":0}"#, "touches", "1 to 8"),
            (
                r#"{"kind":"bend_begin","bend":1,"base":1,"touches":[2,3,2],"stretch":0}"#,
                "touches[2]",
                "a row that is touched once",
            ),
            (r#"{"kind":"bend_begin","bend":1,"base":1,"touches":[2],"stretch":1.5}"#, "stretch", "0 to 1"),
            (r#"{"kind":"bend_begin","bend":1,"base":1,"touches":[2],"stretch":1e99}"#, "stretch", "0 to 1"),
            (r#"{"kind":"bend_begin","bend":1,"base":1,"touches":[2],"stretch":NaN}"#, "stretch", "0 to 1"),
            (r#"{"kind":"bend_move","bend":1,"targets":[]}"#, "targets", "1 to 8"),
            (
                r#"{"kind":"bend_move","bend":1,"targets":[[0,1,0],[0,1e39,0]]}"#,
                "targets[1][1]",
                "-10 to 1000",
            ),
            (
                r#"{"kind":"bend_move","bend":1,"targets":[[0,1,0],[0,Infinity,0]]}"#,
                "targets[1]",
                "three numbers, x and z -1000 to 1000, y -10 to 1000",
            ),
            (r#"{"kind":"bend_move","bend":1,"targets":[[-1001,1,0]]}"#, "targets[0][0]", "-1000 to 1000"),
            (r#"{"kind":"set_width","row":1,"diameter":0}"#, "diameter", "0.01 to 100, or null"),
            (r#"{"kind":"set_width","row":1,"diameter":-1e60}"#, "diameter", "0.01 to 100, or null"),
            (r#"{"kind":"set_width","row":1,"diameter":NaN}"#, "diameter", "0.01 to 100, or null"),
            (r#"{"kind":"prune","rows":[]}"#, "rows", "1 to 1024"),
            (r#"{"kind":"prune","rows":[1,-1]}"#, "rows[1]", "a whole number from 0 to 4294967295"),
            (r#"{"kind":"prune_dim","exposure":2}"#, "exposure", "0 to 1"),
            (
                r#"{"kind":"turn_branch","row":1,"rotation":[0,0,0,0]}"#,
                "rotation",
                "four finite numbers that make a quaternion of length 1",
            ),
            (
                r#"{"kind":"turn_branch","row":1,"rotation":[0,0,1e99,1]}"#,
                "rotation",
                "four finite numbers that make a quaternion of length 1",
            ),
            (
                r#"{"kind":"graft","row":1,"onto":2,"rotation":[0,0,1],"keep":true}"#,
                "rotation",
                "four numbers that make a quaternion of length 1",
            ),
            (r#"{"kind":"graft","row":1,"onto":2,"rotation":[0,0,0,1],"keep":"no"}"#, "keep", "true, false"),
            (r#"{"kind":"go_to","step":-1}"#, "step", "a whole number from 0 to 4294967295"),
            (r#"{"kind":"take_future","future":1.5}"#, "future", "a whole number from 0 to 4294967295"),
        ] {
            let problem = Action::from_json(text).expect_err(text);
            let found = (problem.field.as_deref(), problem.allowed.as_deref());
            assert_eq!(found, (Some(field), Some(allowed)), "{text}: {}", problem.message);
            assert!(problem.message.contains(allowed), "{}", problem.message);
        }
    }

    #[test]
    fn lm9_rows_and_steps_are_counted() {
        let rows = vec![1; MAX_PRUNED_ROWS + 1];
        assert_eq!(pruned_rows(&rows, 1).map_err(|problem| problem.code), Err(ProblemCode::TooMany));
        assert_eq!(pruned_rows(&rows[1..], 1).map(|rows| rows.len()), Ok(MAX_PRUNED_ROWS));
        assert!(Prediction::parse(&rows, 1).is_err());
        assert_eq!(Prediction::parse(&[], 0), Ok(None));
        assert!(Prediction::parse(&[], MAX_PREDICTED_STEPS).is_ok());
        let problem = Prediction::parse(&[], MAX_PREDICTED_STEPS + 1).expect_err("LM10: too many steps");
        assert_eq!(problem.field.as_deref(), Some("steps"));
    }
}
