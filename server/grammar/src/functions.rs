//! The functions of expressions.

/// A function of numbers, of chance, or of the place where a module stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    Abs,
    Sign,
    Floor,
    Ceil,
    Round,
    Trunc,
    Min,
    Max,
    Sqrt,
    Exp,
    Ln,
    Log10,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Pow,
    Lerp,
    Clamp,
    Smooth,
    Random,
    Normal,
    Step,
    Age,
    Light,
    BrighterX,
    BrighterY,
    BrighterZ,
    Free,
    Inside,
    Exists,
    Vigor,
    Order,
    Below,
}

impl Function {
    /// Whether its value follows from its parameters alone.
    pub fn is_plain(self) -> bool {
        !matches!(self, Self::Random | Self::Normal | Self::Step | Self::Age) && !self.asks_place()
    }

    /// Whether it needs to know where the turtle stands.
    pub fn asks_place(self) -> bool {
        use Function::{Below, BrighterX, BrighterY, BrighterZ, Exists, Free, Inside, Light, Order, Vigor};
        matches!(
            self,
            Light | BrighterX | BrighterY | BrighterZ | Free | Inside | Exists | Vigor | Order | Below
        )
    }

    /// Whether its value depends on what wood stands there.
    pub fn asks_of_wood(self) -> bool {
        use Function::{BrighterX, BrighterY, BrighterZ, Free, Light, Vigor};
        matches!(self, Light | BrighterX | BrighterY | BrighterZ | Free | Vigor)
    }
}

/// Names, how many parameters each takes, and what it is.
pub(crate) const FUNCTIONS: &[(&str, u8, Function)] = &[
    ("abs", 1, Function::Abs),
    ("sign", 1, Function::Sign),
    ("floor", 1, Function::Floor),
    ("ceil", 1, Function::Ceil),
    ("round", 1, Function::Round),
    ("trunc", 1, Function::Trunc),
    ("min", 2, Function::Min),
    ("max", 2, Function::Max),
    ("sqrt", 1, Function::Sqrt),
    ("exp", 1, Function::Exp),
    ("ln", 1, Function::Ln),
    ("log", 1, Function::Ln),
    ("log10", 1, Function::Log10),
    ("sin", 1, Function::Sin),
    ("cos", 1, Function::Cos),
    ("tan", 1, Function::Tan),
    ("asin", 1, Function::Asin),
    ("acos", 1, Function::Acos),
    ("atan", 1, Function::Atan),
    ("atan2", 2, Function::Atan2),
    ("pow", 2, Function::Pow),
    ("lerp", 3, Function::Lerp),
    ("clamp", 3, Function::Clamp),
    ("smooth", 3, Function::Smooth),
    ("ran", 1, Function::Random),
    ("nran", 2, Function::Normal),
    ("step", 0, Function::Step),
    ("age", 0, Function::Age),
    ("light", 0, Function::Light),
    ("towards_light_x", 0, Function::BrighterX),
    ("towards_light_y", 0, Function::BrighterY),
    ("towards_light_z", 0, Function::BrighterZ),
    ("free", 1, Function::Free),
    ("inside", 1, Function::Inside),
    ("exists", 1, Function::Exists),
    ("vigor", 0, Function::Vigor),
    ("order", 0, Function::Order),
    ("below", 0, Function::Below),
];

/// The value of a plain function; angles are in degrees. What is undefined is no number.
pub(crate) fn plain(function: Function, [a, b, c]: [f64; 3]) -> f64 {
    match function {
        Function::Abs => a.abs(),
        Function::Sign => f64::from(i8::from(a > 0.0) - i8::from(a < 0.0)),
        Function::Floor => a.floor(),
        Function::Ceil => a.ceil(),
        Function::Round => a.round(),
        Function::Trunc => a.trunc(),
        Function::Min => a.min(b),
        Function::Max => a.max(b),
        Function::Sqrt => a.sqrt(),
        Function::Exp => libm::exp(a),
        Function::Ln => libm::log(a),
        Function::Log10 => libm::log10(a),
        Function::Sin => libm::sin(a.to_radians()),
        Function::Cos => libm::cos(a.to_radians()),
        Function::Tan => libm::tan(a.to_radians()),
        Function::Asin => libm::asin(a).to_degrees(),
        Function::Acos => libm::acos(a).to_degrees(),
        Function::Atan => libm::atan(a).to_degrees(),
        Function::Atan2 => libm::atan2(a, b).to_degrees(),
        Function::Pow => power(a, b),
        Function::Lerp => a + (b - a) * c,
        Function::Clamp => a.max(b.min(c)).min(c.max(b)),
        Function::Smooth => {
            let t = if b > a { ((c - a) / (b - a)).clamp(0.0, 1.0) } else { f64::from(u8::from(c >= b)) };
            t * t * (3.0 - 2.0 * t)
        }
        // The others are not plain.
        _ => f64::NAN,
    }
}

/// A power; small whole ones by multiplication, which is many times as fast.
pub(crate) fn power(base: f64, exponent: f64) -> f64 {
    const BY_MULTIPLICATION: f64 = 16.0;
    if exponent.fract() == 0.0 && exponent.abs() <= BY_MULTIPLICATION {
        let power = (0..exponent.abs() as u32).fold(1.0, |power, _| power * base);
        return if exponent < 0.0 { 1.0 / power } else { power };
    }
    libm::pow(base, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_what_they_are_called() {
        let of = |name: &str, a: f64, b: f64, c: f64| {
            let row = FUNCTIONS.iter().find(|row| row.0 == name).expect("it is there");
            plain(row.2, [a, b, c])
        };
        let cases = [
            (of("abs", -2.0, 0.0, 0.0), 2.0),
            (of("sign", -0.5, 0.0, 0.0), -1.0),
            (of("sign", 0.0, 0.0, 0.0), 0.0),
            (of("round", 2.5, 0.0, 0.0), 3.0),
            (of("trunc", -2.5, 0.0, 0.0), -2.0),
            (of("min", 2.0, 1.0, 0.0), 1.0),
            (of("sin", 30.0, 0.0, 0.0), 0.5),
            (of("atan2", 1.0, 1.0, 0.0), 45.0),
            (of("acos", 0.5, 0.0, 0.0), 60.0),
            (of("pow", 2.0, -3.0, 0.0), 0.125),
            (of("pow", 2.0, 0.5, 0.0), 2f64.sqrt()),
            (of("log10", 1000.0, 0.0, 0.0), 3.0),
            (of("ln", 1.0, 0.0, 0.0), 0.0),
            (of("lerp", 1.0, 3.0, 0.25), 1.5),
            (of("clamp", 9.0, 0.0, 4.0), 4.0),
            (of("clamp", -9.0, 0.0, 4.0), 0.0),
            (of("smooth", 0.0, 2.0, 1.0), 0.5),
            (of("smooth", 0.0, 2.0, 5.0), 1.0),
        ];
        for (at, (found, wanted)) in cases.into_iter().enumerate() {
            assert!((found - wanted).abs() < 1e-12, "{at}: {found} is not {wanted}");
        }
        assert!(of("sqrt", -1.0, 0.0, 0.0).is_nan());
    }
}
