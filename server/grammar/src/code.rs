//! Expressions as short programmes for a stack, with what is constant computed beforehand.

use crate::{
    environment::{Environment, Stand},
    expression::{Binary, Expr},
    functions::{FUNCTIONS, Function, plain, power},
    grammar::Curve,
    keys::Chance,
};

/// Values that an expression holds at once at most: three for each level it may nest.
const STACK: usize = 160;

/// A compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Code {
    Constant(f64),
    Parameter(u8),
    Steps(Box<[Op]>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Op {
    Push(f64),
    Parameter(u8),
    Negate,
    Not,
    Binary(Binary),
    Choose,
    Call(Function, u8),
    Curve(u16),
}

/// What an expression may ask beside its parameters.
pub(crate) struct Moment<'a> {
    pub step: f64,
    pub age: f64,
    pub chance: Chance,
    pub stand: Option<&'a Stand>,
    pub environment: &'a dyn Environment,
    pub curves: &'a [Curve],
}

/// Runs compiled expressions, and counts the steps.
#[derive(Clone, Debug)]
pub(crate) struct Machine {
    stack: [f64; STACK],
    pub work: u64,
}

impl Machine {
    pub fn new() -> Self {
        Self { stack: [0.0; STACK], work: 0 }
    }

    /// The value; what is undefined is no number.
    pub fn run(&mut self, code: &Code, parameters: &[f64], moment: &mut Moment<'_>) -> f64 {
        match code {
            Code::Constant(value) => *value,
            Code::Parameter(at) => parameters[*at as usize],
            Code::Steps(ops) => self.run_steps(ops, parameters, moment),
        }
    }

    fn run_steps(&mut self, ops: &[Op], parameters: &[f64], moment: &mut Moment<'_>) -> f64 {
        self.work += ops.len() as u64;
        let stack = &mut self.stack;
        let mut top = 0;
        for op in ops {
            match *op {
                Op::Push(value) => {
                    stack[top] = value;
                    top += 1;
                }
                Op::Parameter(at) => {
                    stack[top] = parameters[at as usize];
                    top += 1;
                }
                Op::Negate => stack[top - 1] = -stack[top - 1],
                Op::Not => stack[top - 1] = not(stack[top - 1]),
                Op::Binary(operator) => {
                    top -= 1;
                    stack[top - 1] = binary(operator, stack[top - 1], stack[top]);
                }
                Op::Choose => {
                    top -= 2;
                    stack[top - 1] = choose(stack[top - 1], stack[top], stack[top + 1]);
                }
                Op::Call(function, count) => {
                    top -= usize::from(count);
                    let mut arguments = [0.0; 3];
                    let count = usize::from(count);
                    arguments[..count].copy_from_slice(&stack[top..top + count]);
                    stack[top] = call(function, arguments, moment);
                    top += 1;
                }
                Op::Curve(row) => {
                    stack[top - 1] = on_curve(&moment.curves[row as usize].points, stack[top - 1])
                }
            }
        }
        stack[0]
    }
}

/// Compiles an expression with the values of definitions.
pub(crate) fn compile(expr: &Expr, defines: &[f64], curves: &[Curve]) -> Code {
    let mut ops = Vec::new();
    emit(expr, defines, curves, &mut ops);
    match *ops {
        [Op::Push(value)] => Code::Constant(value),
        [Op::Parameter(at)] => Code::Parameter(at),
        _ => Code::Steps(ops.into()),
    }
}

fn emit(expr: &Expr, defines: &[f64], curves: &[Curve], ops: &mut Vec<Op>) {
    let begin = ops.len();
    let op = match expr {
        Expr::Number(value) => return ops.push(Op::Push(*value)),
        Expr::Define(row) => {
            return ops.push(Op::Push(defines.get(*row as usize).copied().unwrap_or(f64::NAN)));
        }
        Expr::Parameter(at) => return ops.push(Op::Parameter(*at)),
        Expr::Negative(inner) => {
            emit(inner, defines, curves, ops);
            Op::Negate
        }
        Expr::Not(inner) => {
            emit(inner, defines, curves, ops);
            Op::Not
        }
        Expr::Binary(operator, left, right) => {
            emit(left, defines, curves, ops);
            emit(right, defines, curves, ops);
            Op::Binary(*operator)
        }
        Expr::Choice(parts) => {
            parts.iter().for_each(|part| emit(part, defines, curves, ops));
            Op::Choose
        }
        Expr::Call(function, arguments) => {
            arguments.iter().for_each(|argument| emit(argument, defines, curves, ops));
            Op::Call(*function, arguments.len() as u8)
        }
        Expr::Curve(row, at) => {
            emit(at, defines, curves, ops);
            Op::Curve(*row)
        }
    };
    let is_push = |op: &Op| matches!(op, Op::Push(_));
    let is_constant =
        ops[begin..].iter().all(is_push) && !matches!(op, Op::Call(function, _) if !function.is_plain());
    if !is_constant {
        return ops.push(op);
    }
    let values: Vec<f64> =
        ops.drain(begin..).map(|op| if let Op::Push(value) = op { value } else { f64::NAN }).collect();
    let at = |at: usize| values.get(at).copied().unwrap_or(0.0);
    ops.push(Op::Push(match op {
        Op::Negate => -at(0),
        Op::Not => not(at(0)),
        Op::Binary(operator) => binary(operator, at(0), at(1)),
        Op::Choose => choose(at(0), at(1), at(2)),
        Op::Curve(row) => on_curve(&curves[row as usize].points, at(0)),
        Op::Call(function, _) => plain(function, [at(0), at(1), at(2)]),
        Op::Push(_) | Op::Parameter(_) => f64::NAN,
    }));
}

/// Whether an expression calls one of these functions.
pub(crate) fn calls(expr: &Expr, which: fn(Function) -> bool) -> bool {
    match expr {
        Expr::Number(_) | Expr::Define(_) | Expr::Parameter(_) => false,
        Expr::Negative(inner) | Expr::Not(inner) | Expr::Curve(_, inner) => calls(inner, which),
        Expr::Binary(_, left, right) => calls(left, which) || calls(right, which),
        Expr::Choice(parts) => parts.iter().any(|part| calls(part, which)),
        Expr::Call(function, arguments) => {
            which(*function) || arguments.iter().any(|argument| calls(argument, which))
        }
    }
}

/// The name of the first function in an expression that is not one of numbers alone.
pub(crate) fn unsteady(expr: &Expr) -> Option<&'static str> {
    match expr {
        Expr::Number(_) | Expr::Define(_) | Expr::Parameter(_) => None,
        Expr::Negative(inner) | Expr::Not(inner) | Expr::Curve(_, inner) => unsteady(inner),
        Expr::Binary(_, left, right) => unsteady(left).or_else(|| unsteady(right)),
        Expr::Choice(parts) => parts.iter().find_map(unsteady),
        Expr::Call(function, arguments) => {
            let name = || FUNCTIONS.iter().find(|row| row.2 == *function).map(|row| row.0);
            if function.is_plain() { arguments.iter().find_map(unsteady) } else { name() }
        }
    }
}

fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}

fn not(value: f64) -> f64 {
    if value.is_nan() { value } else { truth(value == 0.0) }
}

fn choose(condition: f64, yes: f64, no: f64) -> f64 {
    match condition {
        condition if condition.is_nan() => condition,
        0.0 => no,
        _ => yes,
    }
}

/// What is no number stays none, in comparisons as well: a condition does not hide it.
fn binary(operator: Binary, a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        return f64::NAN;
    }
    match operator {
        Binary::Or => truth(a != 0.0 || b != 0.0),
        Binary::And => truth(a != 0.0 && b != 0.0),
        Binary::Equal => truth(a == b),
        Binary::NotEqual => truth(a != b),
        Binary::Less => truth(a < b),
        Binary::LessOrEqual => truth(a <= b),
        Binary::Greater => truth(a > b),
        Binary::GreaterOrEqual => truth(a >= b),
        Binary::Add => a + b,
        Binary::Subtract => a - b,
        Binary::Multiply => a * b,
        Binary::Divide if b == 0.0 => f64::NAN,
        Binary::Divide => a / b,
        Binary::Remainder => a % b,
        Binary::Power => power(a, b),
    }
}

fn call(function: Function, arguments: [f64; 3], moment: &mut Moment<'_>) -> f64 {
    let [a, b, _] = arguments;
    if function.is_plain() {
        return plain(function, arguments);
    }
    let surroundings = moment.environment;
    match (function, moment.stand) {
        (Function::Random, _) => a * moment.chance.unit(),
        (Function::Normal, _) => a + b * moment.chance.normal(),
        (Function::Step, _) => moment.step,
        (Function::Age, _) => moment.age,
        (Function::Light, Some(stand)) => surroundings.light(stand),
        (Function::BrighterX, Some(stand)) => surroundings.brighter(stand).x,
        (Function::BrighterY, Some(stand)) => surroundings.brighter(stand).y,
        (Function::BrighterZ, Some(stand)) => surroundings.brighter(stand).z,
        (Function::Free, Some(stand)) => truth(surroundings.is_free(stand, a)),
        (Function::Inside, Some(stand)) => {
            body(a).map_or(f64::NAN, |body| truth(surroundings.is_inside(stand, body)))
        }
        (Function::Exists, Some(_)) => body(a).map_or(f64::NAN, |body| truth(surroundings.has_body(body))),
        (Function::Vigor, Some(stand)) => surroundings.vigor(stand),
        (Function::Order, Some(stand)) => f64::from(stand.order),
        (Function::Below, Some(stand)) => f64::from(stand.below),
        // Whoever asks for a place is asked only where one is known.
        _ => f64::NAN,
    }
}

/// The number of a body.
fn body(number: f64) -> Option<u32> {
    let is_number = number.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(&number);
    is_number.then_some(number as u32)
}

/// A curve's value; beyond its ends it goes on level.
fn on_curve(points: &[(f64, f64)], at: f64) -> f64 {
    if at.is_nan() {
        return at;
    }
    let next = points.partition_point(|point| point.0 <= at);
    let Some(before) = next.checked_sub(1).map(|before| points[before]) else { return points[0].1 };
    let Some(&after) = points.get(next) else { return before.1 };
    before.1 + (after.1 - before.1) * (at - before.0) / (after.0 - before.0)
}
