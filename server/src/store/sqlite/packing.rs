//! How the bytes of a part are packed, one row of the store each.

use std::io::{self, Read as _};

use flate2::read::DeflateDecoder;
use zstd::bulk::{Compressor, Decompressor};

/// What the column `packing` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    /// Raw deflate (RFC 1951), as earlier programs packed.
    Deflate = 0,
    /// One frame of Zstandard (RFC 8878).
    Zstandard = 1,
}

impl Packing {
    /// How parts are packed now.
    pub(super) const NOW: Self = Self::Zstandard;

    pub(super) fn of_column(column: i64) -> Option<Self> {
        [Self::Deflate, Self::Zstandard].into_iter().find(|&packing| column == packing.column())
    }

    pub(super) const fn column(self) -> i64 {
        self as i64
    }
}

/// Packs parts one after the other as [`Packing::NOW`] says.
pub(super) struct Packer(Compressor<'static>);

impl Packer {
    /// Higher levels take longer and save 0.3 % (docs/performance.md).
    const LEVEL: i32 = 1;

    pub(super) fn new() -> io::Result<Self> {
        Compressor::new(Self::LEVEL).map(Self)
    }

    pub(super) fn pack(&mut self, bytes: &[u8]) -> io::Result<Vec<u8>> {
        self.0.compress(bytes)
    }
}

/// Unpacks parts one after the other.
pub(super) struct Unpacker {
    zstandard: Decompressor<'static>,
    /// No part is longer.
    most: usize,
}

impl Unpacker {
    pub(super) fn new(most: usize) -> io::Result<Self> {
        Ok(Self { zstandard: Decompressor::new()?, most })
    }

    /// Appends what a part holds to `bytes`.
    pub(super) fn unpack(&mut self, packing: Packing, packed: &[u8], bytes: &mut Vec<u8>) -> io::Result<()> {
        match packing {
            Packing::Deflate => {
                DeflateDecoder::new(packed).take(self.most as u64).read_to_end(bytes)?;
            }
            Packing::Zstandard => bytes.extend(self.zstandard.decompress(packed, self.most)?),
        }
        Ok(())
    }
}
