//! The outline of a lasso and the plane it lies on, checked (`LM5`).

use espalier_proto::{
    DrawingPlane, Problem, ProblemCode,
    version::{MAX_OUTLINE_POINTS, MIN_OUTLINE_POINTS},
};
use glam::{Vec2, Vec3};

use super::{FARTHEST, parse_position};

/// How far a direction's length may be from 1, and the cosine of two that should be perpendicular from 0.
const TOLERANCE: f32 = 0.01;

/// An outline on a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Lasso {
    /// Points in the plane's own coordinates, 3 to 4096.
    pub outline: Vec<Vec2>,
    /// Where the plane's (0, 0) lies.
    pub origin: Vec3,
    /// The direction of its x axis, of unit length.
    pub right: Vec3,
    /// The direction of its y axis, of unit length and perpendicular to `right`.
    pub up: Vec3,
    /// How deep the body is against its width, 0.1 to 1.
    pub depth: f32,
}

impl Lasso {
    pub(super) fn parse(outline: &[[f32; 2]], plane: &DrawingPlane, depth: f32) -> Result<Self, Problem> {
        let points = outline.len();
        if !(MIN_OUTLINE_POINTS..=MAX_OUTLINE_POINTS).contains(&points) {
            let allowed = format!("{MIN_OUTLINE_POINTS} to {MAX_OUTLINE_POINTS}");
            let code =
                if points < MIN_OUTLINE_POINTS { ProblemCode::OutOfRange } else { ProblemCode::TooMany };
            let message = format!("outline has {points} points; allowed: {allowed}");
            return Err(Problem { code, field: Some("outline".into()), allowed: Some(allowed), message });
        }
        for (index, point) in outline.iter().enumerate() {
            for (axis, value) in point.iter().enumerate() {
                if !(-FARTHEST..=FARTHEST).contains(value) {
                    let field = format!("outline[{index}][{axis}]");
                    return Err(Problem::out_of_range(field, value, format!("-{FARTHEST} to {FARTHEST}")));
                }
            }
        }
        if !(0.1..=1.0).contains(&depth) {
            return Err(Problem::out_of_range("depth", depth, "0.1 to 1"));
        }
        let (origin, right, up) = parse_plane(plane).map_err(|problem| problem.within("plane"))?;
        let outline = outline.iter().copied().map(Vec2::from_array).collect();
        Ok(Self { outline, origin, right, up, depth })
    }
}

fn parse_plane(plane: &DrawingPlane) -> Result<(Vec3, Vec3, Vec3), Problem> {
    let origin = parse_position(&plane.origin).map_err(|mut problem| {
        problem.field = problem.field.map(|field| field.replace("position", "origin"));
        problem.message = problem.message.replace("position", "origin");
        problem
    })?;
    let right = parse_direction("right", plane.right)?;
    let up = parse_direction("up", plane.up)?;
    let slant = right.dot(up);
    if slant.abs() > TOLERANCE {
        let value = format!("off by a cosine of {slant}");
        return Err(Problem::out_of_range("up", value, "perpendicular to right"));
    }
    // What is left of the tolerance goes: the plane's axes are exactly perpendicular from here on.
    Ok((origin, right, (up - right * slant).normalize()))
}

fn parse_direction(field: &str, direction: [f32; 3]) -> Result<Vec3, Problem> {
    let direction = Vec3::from_array(direction);
    let length = direction.length();
    if ((1.0 - TOLERANCE)..=(1.0 + TOLERANCE)).contains(&length) {
        return Ok(direction / length);
    }
    Err(Problem::out_of_range(field, format!("of length {length}"), "three finite numbers of length 1"))
}
