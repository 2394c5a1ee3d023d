//! A binary range coder: bits at the cost of their surprise.

/// Parts of which a probability counts how many.
pub(super) const WHOLE: u32 = 1 << 12;
/// A range below this is widened by a byte.
const LEAST_RANGE: u32 = 1 << 24;
/// Bytes that a decoder takes before it knows the first bit, and so many an encoder writes after the last.
const FLUSHED_BYTES: usize = 4;

/// Writes bits.
#[derive(Debug)]
pub(super) struct Encoder {
    /// Where the range begins; a 33rd bit is a carry that the bytes before have not got yet.
    low: u64,
    range: u32,
    /// The last byte that a carry may still raise; none at the beginning, where there can be no carry.
    last: Option<u8>,
    /// So many bytes 255 follow it, through which a carry would go.
    full: usize,
    out: Vec<u8>,
}

impl Default for Encoder {
    fn default() -> Self {
        Self { low: 0, range: u32::MAX, last: None, full: 0, out: Vec::new() }
    }
}

impl Encoder {
    /// Writes a bit that is 0 in `zero` cases of [`WHOLE`].
    pub(super) fn bit(&mut self, zero: u32, bit: bool) {
        let bound = (self.range / WHOLE) * zero;
        if bit {
            self.low += u64::from(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        while self.range < LEAST_RANGE {
            self.range <<= 8;
            self.shift();
        }
    }

    /// Moves a byte out of `low`.
    fn shift(&mut self) {
        let carry = (self.low >> 32) as u8;
        let byte = (self.low >> 24) as u8;
        if carry == 0 && byte == u8::MAX {
            self.full += 1;
        } else {
            self.out.extend(self.last.map(|last| last + carry));
            self.out.extend(std::iter::repeat_n(u8::MAX.wrapping_add(carry), self.full));
            self.full = 0;
            self.last = Some(byte);
        }
        self.low = (self.low << 8) & 0xffff_ffff;
    }

    /// Ends with as few bytes as tell the bits from all others; those that are left out at the end are 0.
    pub(super) fn finish(mut self) -> Vec<u8> {
        let inside = self.low + u64::from(self.range - 1);
        self.low = inside & !u64::from(LEAST_RANGE - 1);
        for _ in 0..=FLUSHED_BYTES {
            self.shift();
        }
        for _ in 0..FLUSHED_BYTES {
            if self.out.last() == Some(&0) {
                self.out.pop();
            }
        }
        self.out
    }
}

/// Reads bits.
#[derive(Debug)]
pub(super) struct Decoder<'a> {
    code: u32,
    range: u32,
    bytes: &'a [u8],
    /// Bytes read, those behind the end included.
    read: usize,
}

impl<'a> Decoder<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let mut decoder = Self { code: 0, range: u32::MAX, bytes, read: 0 };
        for _ in 0..FLUSHED_BYTES {
            decoder.shift();
        }
        decoder
    }

    /// Reads a bit that is 0 in `zero` cases of [`WHOLE`].
    pub(super) fn bit(&mut self, zero: u32) -> bool {
        let bound = (self.range / WHOLE) * zero;
        let bit = self.code >= bound;
        if bit {
            self.code -= bound;
            self.range -= bound;
        } else {
            self.range = bound;
        }
        while self.range < LEAST_RANGE {
            self.range <<= 8;
            self.shift();
        }
        bit
    }

    fn shift(&mut self) {
        let byte = self.bytes.get(self.read).copied().unwrap_or(0);
        self.code = self.code << 8 | u32::from(byte);
        self.read += 1;
    }

    /// Whether no more bytes behind the end were read than an encoder leaves out.
    pub(super) fn is_within(&self) -> bool {
        self.read <= self.bytes.len() + FLUSHED_BYTES
    }

    /// Whether all bytes were read, and no more behind the end than an encoder leaves out.
    pub(super) fn is_at_end(&self) -> bool {
        self.is_within() && self.read >= self.bytes.len()
    }
}

#[cfg(test)]
mod tests {
    use proptest::{collection::vec, prelude::*};

    use super::*;

    proptest! {
        #[test]
        fn bits_come_back_and_nothing_is_left(bits in vec((1..WHOLE, any::<bool>()), 0..600)) {
            let mut encoder = Encoder::default();
            bits.iter().for_each(|&(zero, bit)| encoder.bit(zero, bit));
            let bytes = encoder.finish();
            let mut decoder = Decoder::new(&bytes);
            for &(zero, bit) in &bits {
                prop_assert_eq!(decoder.bit(zero), bit);
            }
            prop_assert!(decoder.is_at_end());
        }

        #[test]
        fn likely_bits_carry_through_full_bytes(bits in vec((prop_oneof![Just(1), Just(WHOLE - 1)], prop::bool::weighted(0.97)), 0..3000)) {
            let mut encoder = Encoder::default();
            bits.iter().for_each(|&(zero, bit)| encoder.bit(zero, bit));
            let bytes = encoder.finish();
            let mut decoder = Decoder::new(&bytes);
            for &(zero, bit) in &bits {
                prop_assert_eq!(decoder.bit(zero), bit);
            }
        }
    }

    #[test]
    fn bits_cost_what_they_surprise() {
        let mut encoder = Encoder::default();
        // A bit in 64 is 1: 0.116 bits each.
        (0..6400).for_each(|i| encoder.bit(WHOLE - WHOLE / 64, i % 64 == 0));
        assert_eq!(encoder.finish().len(), 93);
    }
}
