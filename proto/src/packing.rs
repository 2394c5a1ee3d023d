//! Bodies of mesh deltas in few bytes: each of their numbers in models of its own field, and a range coder behind them
//! (`FR9`). Frames while somebody draws are so short that deflate finds nothing in them that comes twice.

mod bits;
mod field;
mod model;
mod range_coder;

use bits::{In, Out};
pub use field::{Field, Shape};
pub use model::{LETTERS, LEVELS, MOST_SEEN, PRIORS, SEEN_BEFORE, Tally, UNSEEN};
use model::{Models, contexts};
use range_coder::{Decoder, Encoder, WHOLE};

use crate::{
    envelope::FrameError,
    frame::layout::{Sink, Source},
};

/// Writes a body's numbers into a range coder.
#[derive(Debug)]
pub(crate) struct Packer {
    models: Models,
    coder: Encoder,
}

impl Default for Packer {
    fn default() -> Self {
        Self { models: Models::usual(), coder: Encoder::default() }
    }
}

impl Packer {
    pub(crate) fn finish(self) -> Vec<u8> {
        self.coder.finish()
    }
}

impl Out for Packer {
    fn bit(&mut self, context: usize, bit: bool) {
        self.coder.bit(self.models.zero(context), bit);
        self.models.learn(context, bit);
    }

    fn even(&mut self, bit: bool) {
        self.coder.bit(WHOLE / 2, bit);
    }
}

impl Sink for Packer {
    fn number(&mut self, field: Field, number: u32) {
        contexts().write_number(field, number, self);
    }

    fn byte(&mut self, field: Field, byte: u8) {
        contexts().write_byte(field, byte, self);
    }

    fn change(&mut self, field: Field, change: Option<u8>) {
        self.number(field, change.map_or(0, u32::from));
    }
}

/// Reads them again.
#[derive(Debug)]
pub(crate) struct Unpacker<'a> {
    models: Models,
    coder: Decoder<'a>,
}

impl<'a> Unpacker<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { models: Models::usual(), coder: Decoder::new(bytes) }
    }

    /// Nothing is left of the bytes, and no more was read than they tell.
    pub(crate) fn is_at_end(&self) -> bool {
        self.coder.is_at_end()
    }

    /// Behind the end there are zeros without end, and they mean something as well.
    fn within<T>(&self, value: T) -> Result<T, FrameError> {
        if self.coder.is_within() { Ok(value) } else { Err(FrameError::Truncated) }
    }
}

impl In for Unpacker<'_> {
    fn bit(&mut self, context: usize) -> bool {
        let bit = self.coder.bit(self.models.zero(context));
        self.models.learn(context, bit);
        bit
    }

    fn even(&mut self) -> bool {
        self.coder.bit(WHOLE / 2)
    }
}

impl Source for Unpacker<'_> {
    fn number(&mut self, field: Field) -> Result<u32, FrameError> {
        let number = contexts().read_number(field, self).ok_or(FrameError::Body)?;
        self.within(number)
    }

    fn byte(&mut self, field: Field) -> Result<u8, FrameError> {
        let byte = contexts().read_byte(field, self);
        self.within(byte)
    }

    fn change(&mut self, field: Field) -> Result<Option<u8>, FrameError> {
        match self.number(field)? {
            0 => Ok(None),
            change => u8::try_from(change).map(Some).map_err(|_| FrameError::Body),
        }
    }
}

impl Out for Tally {
    fn bit(&mut self, context: usize, bit: bool) {
        self.0[context][usize::from(bit)] += 1;
    }

    fn even(&mut self, _: bool) {}
}

impl Sink for Tally {
    fn number(&mut self, field: Field, number: u32) {
        contexts().write_number(field, number, self);
    }

    fn byte(&mut self, field: Field, byte: u8) {
        contexts().write_byte(field, byte, self);
    }

    fn change(&mut self, field: Field, change: Option<u8>) {
        self.number(field, change.map_or(0, u32::from));
    }
}
