//! What a parameter of a design can be.

use std::sync::Arc;

use espalier_plant::hash::StableHash;
use espalier_reading::NotAllowed;
use glam::Vec3;

use crate::{curve::Curve, envelope::Envelope, function::Function};

/// A value of some kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Scalar(f32),
    /// Two places along an axis, or any other first and last.
    Span(f32, f32),
    /// A direction with a strength, or a turn.
    Vector(Vec3),
    /// A function of the place along an axis.
    Function(Function),
    /// The course of an axis.
    Curve(Curve),
    /// The outline of a branching system.
    Envelope(Envelope),
    /// What wood and leaves look like.
    Material(Material),
}

/// Factors of the colours of bark and leaves, red, green and blue in linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Of bark.
    pub bark: [f32; 3],
    /// Of leaves.
    pub leaves: [f32; 3],
}

impl Material {
    /// Whether it changes no colour.
    pub fn is_plain(&self) -> bool {
        self.bark.iter().chain(&self.leaves).all(|&factor| factor == 1.0)
    }
}

/// What kind of value a parameter has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    Scalar,
    /// A whole number.
    Whole,
    /// First and last, both in [0, 1].
    Span,
    /// Three coordinates.
    Vector,
    /// A function of the place along an axis.
    Function,
    /// A curve in space.
    Curve,
    /// An envelope.
    Envelope,
    /// Colours.
    Material,
}

impl Kind {
    /// Whether a value can be said relative to an inherited one.
    pub fn is_relative(self) -> bool {
        matches!(self, Self::Scalar | Self::Function)
    }
}

/// How a value is combined with the inherited one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// An offset, or a sum of functions.
    Add,
    /// A fraction, or a product of functions.
    Multiply,
}

/// A value that many hold, with a hash of its bits.
#[derive(Clone, Debug)]
pub struct Held(Arc<(u64, Value)>);

impl PartialEq for Held {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || (self.hash() == other.hash() && self.0.1 == other.0.1)
    }
}

impl Held {
    /// Holds a value.
    pub fn new(value: Value) -> Self {
        let mut hash = StableHash::default();
        match &value {
            Value::Scalar(number) => hash.word(number.to_bits().into()),
            Value::Span(first, last) => {
                hash.word(u64::from(first.to_bits()) | u64::from(last.to_bits()) << 32);
            }
            Value::Vector(vector) => hash.vector(*vector),
            Value::Function(function) => function.hash(&mut hash),
            Value::Curve(curve) => curve.hash(&mut hash),
            Value::Envelope(envelope) => envelope.hash(&mut hash),
            Value::Material(Material { bark, leaves }) => {
                bark.iter().chain(leaves).for_each(|part| hash.word(part.to_bits().into()));
            }
        }
        Self(Arc::new((hash.finish(), value)))
    }

    /// The value.
    pub fn get(&self) -> &Value {
        &self.0.1
    }

    /// The hash of its bits.
    pub fn hash(&self) -> u64 {
        self.0.0
    }
}

/// What an inherited value becomes by a relative one, kept within a range; none where the kinds do not fit together.
pub fn combined(inherited: &Held, op: Op, with: &Held, (least, most): (f32, f32)) -> Option<Held> {
    let both = |a: f32, b: f32| {
        let value = match op {
            Op::Add => a + b,
            Op::Multiply => a * b,
        };
        value.clamp(least, most)
    };
    let value = match (inherited.get(), with.get()) {
        (&Value::Scalar(a), &Value::Scalar(b)) => Value::Scalar(both(a, b)),
        (Value::Function(a), Value::Function(b)) => Value::Function(a.combined(b, both)),
        _ => return None,
    };
    Some(Held::new(value))
}

/// Checks that all numbers of a value lie in a range, where its kind has one.
pub(crate) fn check(value: &Value, kind: Kind, (least, most): (f32, f32)) -> Result<(), NotAllowed> {
    let allowed = || match kind {
        Kind::Whole => format!("a whole number from {least} to {most}"),
        _ => format!("{least} to {most}"),
    };
    let is_in = |number: f32| (least..=most).contains(&number);
    let refused = |at: &str, found: f32| {
        Err(NotAllowed { at: at.to_owned(), ..NotAllowed::new(found.to_string(), allowed()) })
    };
    match (value, kind) {
        (&Value::Scalar(number), Kind::Scalar) if is_in(number) => Ok(()),
        (&Value::Scalar(number), Kind::Whole) if is_in(number) && number == number.trunc() => Ok(()),
        (&Value::Scalar(number), Kind::Scalar | Kind::Whole) => refused("", number),
        (&Value::Span(first, last), Kind::Span) => match (is_in(first), is_in(last) && first <= last) {
            (true, true) => Ok(()),
            (false, _) => refused("[0]", first),
            (true, false) => Err(NotAllowed {
                at: "[1]".to_owned(),
                ..NotAllowed::new(last.to_string(), format!("{first} to {most}"))
            }),
        },
        (Value::Vector(vector), Kind::Vector) => {
            match vector.to_array().into_iter().enumerate().find(|&(_, part)| !is_in(part)) {
                Some((at, part)) => refused(&format!("[{at}]"), part),
                None => Ok(()),
            }
        }
        (Value::Function(function), Kind::Function) => {
            match function.points().iter().enumerate().find(|(_, point)| !is_in(point.1)) {
                Some((at, point)) => refused(&format!("[{at}][1]"), point.1),
                None => Ok(()),
            }
        }
        (Value::Curve(_), Kind::Curve) => Ok(()),
        (Value::Envelope(envelope), Kind::Envelope) => envelope.check(),
        (Value::Material(Material { bark, leaves }), Kind::Material) => {
            for (name, colour) in [("bark", bark), ("leaves", leaves)] {
                if let Some((at, &part)) = colour.iter().enumerate().find(|&(_, &part)| !is_in(part)) {
                    return refused(&format!("{name}[{at}]"), part);
                }
            }
            Ok(())
        }
        (found, kind) => Err(NotAllowed::new(found.kind_name(), kind.described())),
    }
}

impl Value {
    fn kind_name(&self) -> &'static str {
        match self {
            Self::Scalar(_) => "a number",
            Self::Span(..) => "a pair",
            Self::Vector(_) => "a vector",
            Self::Function(_) => "a function",
            Self::Curve(_) => "a curve",
            Self::Envelope(_) => "an envelope",
            Self::Material(_) => "a material",
        }
    }
}

impl Kind {
    /// What stands for such a value.
    pub fn described(self) -> &'static str {
        match self {
            Self::Scalar => "a number",
            Self::Whole => "a whole number",
            Self::Span => "a list of 2 numbers, first and last",
            Self::Vector => "a list of 3 numbers",
            Self::Function => "a list of points [t, value]",
            Self::Curve => "a list of points [x, y, z]",
            Self::Envelope => "an object with top, bottom, radii, heights, upper, lower, tip",
            Self::Material => "an object with bark, leaves",
        }
    }
}
