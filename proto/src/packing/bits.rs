//! Numbers and bytes as bits, each in a context of its field.

use super::field::{Field, NUMBER_CONTEXTS, Shape};

/// Contexts for the length of a number; longer ones share the last.
const LENGTHS: u32 = 16;

/// Takes bits.
pub(super) trait Out {
    /// A bit in a context.
    fn bit(&mut self, context: usize, bit: bool);
    /// A bit that is 0 as often as 1.
    fn even(&mut self, bit: bool);
}

/// Gives bits.
pub(super) trait In {
    /// The next bit, which is in this context.
    fn bit(&mut self, context: usize) -> bool;
    /// The next bit, which is 0 as often as 1.
    fn even(&mut self) -> bool;
}

/// Where the contexts of each field begin.
#[derive(Clone, Debug)]
pub(super) struct Contexts {
    starts: Vec<usize>,
    pub(super) count: usize,
}

impl Contexts {
    pub(super) fn new() -> Self {
        let mut count = 0;
        let begin = |field: &Field| {
            let start = count;
            count += field.contexts();
            start
        };
        Self { starts: Field::ALL.iter().map(begin).collect(), count }
    }

    fn of(&self, field: Field) -> usize {
        self.starts[field as usize]
    }

    /// A number as one more than it, so that there is a highest bit: as many ones as there are bits below that, a zero,
    /// and those bits from the highest on.
    pub(super) fn write_number(&self, field: Field, number: u32, out: &mut impl Out) {
        debug_assert_eq!(field.shape(), Shape::Number, "{field:?}");
        let base = self.of(field);
        let number = u64::from(number) + 1;
        let length = number.ilog2();
        for counted in 0..length {
            out.bit(base + counted.min(LENGTHS - 1) as usize, true);
        }
        out.bit(base + length.min(LENGTHS - 1) as usize, false);
        for place in (0..length).rev() {
            let bit = number >> place & 1 == 1;
            match below_highest(base, length, place, number) {
                Some(context) => out.bit(context, bit),
                None => out.even(bit),
            }
        }
    }

    /// None if it has more than 32 bits.
    pub(super) fn read_number(&self, field: Field, bits: &mut impl In) -> Option<u32> {
        let base = self.of(field);
        let mut length = 0;
        while bits.bit(base + length.min(LENGTHS - 1) as usize) {
            length += 1;
            if length > u32::BITS {
                return None;
            }
        }
        let mut number = 1u64 << length;
        for place in (0..length).rev() {
            let bit = match below_highest(base, length, place, number) {
                Some(context) => bits.bit(context),
                None => bits.even(),
            };
            number |= u64::from(bit) << place;
        }
        u32::try_from(number - 1).ok()
    }

    /// A byte from its highest bit on; what is known of it already is the context.
    pub(super) fn write_byte(&self, field: Field, byte: u8, out: &mut impl Out) {
        debug_assert_eq!(field.shape(), Shape::Byte, "{field:?}");
        let base = self.of(field);
        let mut known = 1;
        for place in (0..u8::BITS).rev() {
            let bit = byte >> place & 1 == 1;
            out.bit(base + known, bit);
            known = known << 1 | usize::from(bit);
        }
    }

    pub(super) fn read_byte(&self, field: Field, bits: &mut impl In) -> u8 {
        let base = self.of(field);
        let mut known = 1;
        for _ in 0..u8::BITS {
            known = known << 1 | usize::from(bits.bit(base + known));
        }
        known as u8
    }
}

/// The context of one of the two bits below the highest; those below these are even.
fn below_highest(base: usize, length: u32, place: u32, number: u64) -> Option<usize> {
    let first = base + LENGTHS as usize + 3 * (length.min(LENGTHS) as usize - 1);
    debug_assert!(first + 3 <= base + NUMBER_CONTEXTS, "there is a context");
    match length - place {
        1 => Some(first),
        2 => Some(first + 1 + (number >> (place + 1) & 1) as usize),
        _ => None,
    }
}
