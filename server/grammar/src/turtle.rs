//! The turtle: a place and a frame that modules move.

use glam::DVec3;

use crate::{environment::Stand, symbols::Action};

/// What one change of width without a parameter multiplies by.
const THINNER: f64 = 0.7;
/// Where turtles begin they face up, their left to the west, their up towards who looks from the south.
const HEADING: DVec3 = DVec3::Y;
const LEFT: DVec3 = DVec3::NEG_X;
const UP: DVec3 = DVec3::Z;

/// Where the turtle stands, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub place: DVec3,
    pub heading: DVec3,
    pub left: DVec3,
    pub up: DVec3,
    pub width: f64,
    pub scale: f64,
    pub tropism: DVec3,
    pub elasticity: f64,
    pub below: u32,
    pub order: u16,
    /// The key of the bracket that it went through last.
    pub branch: u64,
}

/// What a move means for wood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Moved {
    /// Nothing.
    No,
    /// It drew.
    Drew,
    /// It went elsewhere without drawing.
    Jumped,
}

/// A turtle, and where it will go back to.
#[derive(Clone, Debug)]
pub(crate) struct Turtle {
    pub state: State,
    stack: Vec<State>,
    /// Degrees that turns without parameter turn by.
    angle: f64,
    /// The last few angles with their sines and cosines: most grammars have few.
    known: [(f64, f64, f64); 8],
}

impl Turtle {
    pub fn new(angle: f64, scale: f64) -> Self {
        let state = State {
            place: DVec3::ZERO,
            heading: HEADING,
            left: LEFT,
            up: UP,
            width: 1.0,
            scale,
            tropism: DVec3::NEG_Y,
            elasticity: 0.0,
            below: 0,
            order: 0,
            branch: 0,
        };
        Self { state, stack: Vec::new(), angle, known: [(0.0, 0.0, 1.0); 8] }
    }

    pub fn stand(&self) -> Stand {
        let State { place, heading, order, below, branch, .. } = self.state;
        Stand { place, heading, order, below, branch }
    }

    pub fn push(&mut self, key: u64) {
        self.stack.push(self.state);
        self.state.order = self.state.order.saturating_add(1);
        self.state.branch = key;
    }

    pub fn pop(&mut self) {
        if let Some(state) = self.stack.pop() {
            self.state = state;
        }
    }

    /// Does what a symbol says; brackets, cuts and what the turtle is asked are for whoever reads the word.
    pub fn act(&mut self, action: Action, parameters: &[f64]) -> Moved {
        let first = parameters.first().copied();
        let degrees = first.unwrap_or(self.angle);
        match action {
            Action::Draw => {
                self.advance(first.unwrap_or(1.0));
                self.state.below = self.state.below.saturating_add(1);
                self.bend();
                return Moved::Drew;
            }
            Action::Move => {
                self.advance(first.unwrap_or(1.0));
                return Moved::Jumped;
            }
            Action::Turn(sign) => {
                let (sin, cos) = self.sin_cos(sign * degrees);
                let State { heading, left, .. } = self.state;
                self.state.heading = heading * cos + left * sin;
                self.state.left = left * cos - heading * sin;
            }
            Action::Pitch(sign) => {
                let (sin, cos) = self.sin_cos(sign * degrees);
                let State { heading, up, .. } = self.state;
                self.state.heading = heading * cos - up * sin;
                self.state.up = up * cos + heading * sin;
            }
            Action::Roll(sign) => {
                let (sin, cos) = self.sin_cos(sign * degrees);
                let State { left, up, .. } = self.state;
                self.state.left = left * cos + up * sin;
                self.state.up = up * cos - left * sin;
            }
            Action::TurnAbout => {
                self.state.heading = -self.state.heading;
                self.state.left = -self.state.left;
            }
            Action::Level => {
                if let Some(left) = DVec3::Y.cross(self.state.heading).try_normalize() {
                    self.state.left = left;
                    self.state.up = self.state.heading.cross(left);
                }
            }
            Action::SetHeading => self.head(parameters),
            Action::SetPlace => {
                self.state.place = vector(parameters) * self.state.scale;
                return Moved::Jumped;
            }
            Action::Thinner => self.state.width = first.unwrap_or(self.state.width * THINNER),
            Action::Thicker => self.state.width = first.unwrap_or(self.state.width / THINNER),
            Action::SetScale => self.state.scale = first.unwrap_or(1.0),
            Action::MultiplyScale => self.state.scale *= first.unwrap_or(1.0),
            Action::DivideScale => self.state.scale /= first.unwrap_or(1.0),
            Action::SetTropism => {
                self.state.tropism = vector(parameters).try_normalize().unwrap_or(DVec3::ZERO);
            }
            Action::SetElasticity => self.state.elasticity = first.unwrap_or(0.0),
            _ => {}
        }
        Moved::No
    }

    fn advance(&mut self, length: f64) {
        self.state.place += self.state.heading * (length * self.state.scale);
    }

    /// Turns the heading towards the tropism, by an angle that grows with how far it stands across.
    fn bend(&mut self) {
        if self.state.elasticity == 0.0 {
            return;
        }
        let across = self.state.heading.cross(self.state.tropism);
        let (Some(about), sine) = (across.try_normalize(), across.length()) else { return };
        let (sin, cos) = libm::sincos(self.state.elasticity * sine);
        let turned = |v: DVec3| v * cos + about.cross(v) * sin + about * (about.dot(v) * (1.0 - cos));
        let State { heading, left, up, .. } = self.state;
        (self.state.heading, self.state.left, self.state.up) = (turned(heading), turned(left), turned(up));
        self.straighten();
    }

    fn head(&mut self, parameters: &[f64]) {
        let Some(heading) = vector(parameters).try_normalize() else { return };
        let wanted = parameters.get(3..).filter(|rest| rest.len() >= 3).map(vector);
        let up = wanted.unwrap_or(self.state.up).reject_from_normalized(heading);
        self.state.heading = heading;
        self.state.up = up.try_normalize().unwrap_or_else(|| heading.any_orthonormal_vector());
        self.state.left = self.state.up.cross(heading);
    }

    /// Takes off the frame what rounding has added.
    pub fn straighten(&mut self) {
        let heading = self.state.heading.normalize_or(HEADING);
        let left = self.state.left.reject_from_normalized(heading);
        self.state.left = left.try_normalize().unwrap_or_else(|| heading.any_orthonormal_vector());
        self.state.heading = heading;
        self.state.up = heading.cross(self.state.left);
    }

    fn sin_cos(&mut self, degrees: f64) -> (f64, f64) {
        let at = (degrees.to_bits() >> 45) as usize % self.known.len();
        let (known, sin, cos) = self.known[at];
        if known == degrees {
            return (sin, cos);
        }
        let (sin, cos) = libm::sincos(degrees.to_radians());
        self.known[at] = (degrees, sin, cos);
        (sin, cos)
    }
}

fn vector(parameters: &[f64]) -> DVec3 {
    let at = |at: usize| parameters.get(at).copied().unwrap_or(0.0);
    DVec3::new(at(0), at(1), at(2))
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::*;

    /// A turn about one of the turtle's own axes, as a matrix that its frame is multiplied with.
    fn turned(before: &State, about: DVec3, degrees: f64) -> [DVec3; 3] {
        let turn = DMat3::from_axis_angle(about, degrees.to_radians());
        [turn * before.heading, turn * before.left, turn * before.up]
    }

    #[test]
    fn each_turn_is_a_rotation_about_an_axis_of_the_turtle() {
        let mut turtle = Turtle::new(30.0, 1.0);
        // A frame that stands askew.
        for (action, degrees) in
            [(Action::Turn(1.0), 20.0), (Action::Pitch(1.0), 50.0), (Action::Roll(1.0), 70.0)]
        {
            let _ = turtle.act(action, &[degrees]);
        }
        let before = turtle.state;
        assert!((before.heading.cross(before.left) - before.up).length() < 1e-12);
        // Left turns from the heading to the left; down from up's opposite; a roll to the right lifts the left wing.
        let cases = [
            (Action::Turn(1.0), before.up, 33.0, 33.0),
            (Action::Turn(-1.0), before.up, -33.0, 33.0),
            (Action::Pitch(1.0), before.left, 33.0, 33.0),
            (Action::Pitch(-1.0), before.left, -33.0, 33.0),
            (Action::Roll(1.0), before.heading, 33.0, 33.0),
            (Action::Roll(-1.0), before.heading, -33.0, 33.0),
        ];
        for (action, about, wanted, degrees) in cases {
            let mut turtle = turtle.clone();
            assert_eq!(turtle.act(action, &[degrees]), Moved::No);
            let after = [turtle.state.heading, turtle.state.left, turtle.state.up];
            for (found, wanted) in after.iter().zip(turned(&before, about, wanted)) {
                assert!((*found - wanted).length() < 1e-12, "{action:?}: {found} is not {wanted}");
            }
        }
        let mut about = turtle.clone();
        assert_eq!(about.act(Action::TurnAbout, &[]), Moved::No);
        for (found, wanted) in
            [about.state.heading, about.state.left].iter().zip(turned(&before, before.up, 180.0))
        {
            assert!((*found - wanted).length() < 1e-12);
        }
    }

    #[test]
    fn turns_have_the_sides_that_their_names_say() {
        let turned = |action| {
            let mut turtle = Turtle::new(90.0, 1.0);
            let _ = turtle.act(action, &[]);
            (turtle.state.heading.round(), turtle.state.left.round())
        };
        assert_eq!(turned(Action::Turn(1.0)).0, LEFT);
        assert_eq!(turned(Action::Pitch(1.0)).0, -UP);
        // A turtle that rolls to the right has its left wing up.
        assert_eq!(turned(Action::Roll(1.0)), (HEADING, UP));
    }

    #[test]
    fn level_turtles_have_their_left_level() {
        let mut turtle = Turtle::new(30.0, 1.0);
        for action in [Action::Pitch(1.0), Action::Roll(1.0)] {
            let _ = turtle.act(action, &[50.0]);
        }
        let heading = turtle.state.heading;
        let _ = turtle.act(Action::Level, &[]);
        assert_eq!(turtle.state.heading, heading);
        assert!(turtle.state.left.y.abs() < 1e-12 && turtle.state.up.y > 0.0);
    }

    #[test]
    fn wood_bends_towards_its_tropism() {
        let mut turtle = Turtle::new(30.0, 1.0);
        let _ = turtle.act(Action::SetTropism, &[1.0, 0.0, 0.0]);
        let _ = turtle.act(Action::SetElasticity, &[0.2]);
        assert_eq!(turtle.act(Action::Draw, &[]), Moved::Drew);
        assert_eq!(turtle.state.place, DVec3::Y);
        // It stands square to its tropism, so that it turns by the whole elasticity.
        assert!((turtle.state.heading.x - libm::sin(0.2)).abs() < 1e-12);
        for _ in 0..200 {
            let _ = turtle.act(Action::Draw, &[]);
        }
        assert!(turtle.state.heading.x > 0.999_999);
    }
}
