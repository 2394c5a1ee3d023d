//! Numbers, texts and lists as bytes, all little-endian. What they mean stands in the modules beside.

use espalier_plant::{AxisId, MetamerId};
use glam::{Quat, Vec3};

use super::{DocumentError, damaged, later};

/// Items are made room for up to this number at a time, whatever length is announced.
const ROOM: usize = 1 << 20;

/// Bytes that grow.
#[derive(Debug, Default)]
pub(crate) struct Writer(Vec<u8>);

impl Writer {
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    pub(crate) fn u8(&mut self, value: u8) {
        self.0.push(value);
    }

    pub(crate) fn u32(&mut self, value: u32) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    pub(crate) fn u64(&mut self, value: u64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    pub(crate) fn f32(&mut self, value: f32) {
        self.u32(value.to_bits());
    }

    pub(crate) fn f64(&mut self, value: f64) {
        self.u64(value.to_bits());
    }

    pub(crate) fn vector(&mut self, v: Vec3) {
        v.to_array().into_iter().for_each(|c| self.f32(c));
    }

    pub(crate) fn rotation(&mut self, rotation: Quat) {
        rotation.to_array().into_iter().for_each(|c| self.f32(c));
    }

    pub(crate) fn option(&mut self, value: Option<u32>) {
        self.u8(u8::from(value.is_some()));
        self.u32(value.unwrap_or(0));
    }

    pub(crate) fn tagged(&mut self, tag: u8, row: u32) {
        self.u8(tag);
        self.u32(row);
    }

    pub(crate) fn numbers(&mut self, column: &[u32]) {
        self.u32(column.len() as u32);
        self.0.extend(column.iter().flat_map(|value| value.to_le_bytes()));
    }

    pub(crate) fn vectors(&mut self, column: &[Vec3]) {
        self.list(column, |out, &v| out.vector(v));
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        self.u32(bytes.len() as u32);
        self.0.extend_from_slice(bytes);
    }

    pub(crate) fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
    }

    pub(crate) fn list<T>(&mut self, items: &[T], mut write: impl FnMut(&mut Self, &T)) {
        self.u32(items.len() as u32);
        for item in items {
            write(self, item);
        }
    }
}

/// Bytes still to be read, in one version of their section.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'a> {
    rest: &'a [u8],
    version: u16,
}

impl<'a> Reader<'a> {
    /// Bytes of what has one version alone.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self::of_version(bytes, 1)
    }

    /// Bytes of a section in this version.
    pub(crate) fn of_version(bytes: &'a [u8], version: u16) -> Self {
        Self { rest: bytes, version }
    }

    /// The version to be read. Whoever reads knows all versions up to one; a later program wrote any other.
    pub(crate) fn up_to(&self, newest: u16) -> Result<u16, DocumentError> {
        if self.version > newest {
            return Err(later(format!("it has version {}", self.version)));
        }
        Ok(self.version)
    }

    /// What has not been read.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// Nothing may be left.
    pub(crate) fn end(&self) -> Result<(), DocumentError> {
        if self.rest.is_empty() { Ok(()) } else { Err(damaged("something follows its end")) }
    }

    /// So many bytes.
    pub(crate) fn slice(&mut self, len: usize) -> Result<&'a [u8], DocumentError> {
        let (taken, rest) = self.rest.split_at_checked(len).ok_or_else(cut_short)?;
        self.rest = rest;
        Ok(taken)
    }

    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N], DocumentError> {
        let (taken, rest) = self.rest.split_first_chunk::<N>().ok_or_else(cut_short)?;
        self.rest = rest;
        Ok(*taken)
    }

    pub(crate) fn u8(&mut self) -> Result<u8, DocumentError> {
        self.array::<1>().map(|[byte]| byte)
    }

    pub(crate) fn u32(&mut self) -> Result<u32, DocumentError> {
        self.array().map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self) -> Result<u64, DocumentError> {
        self.array().map(u64::from_le_bytes)
    }

    pub(crate) fn f32(&mut self) -> Result<f32, DocumentError> {
        let value = f32::from_bits(self.u32()?);
        if value.is_finite() { Ok(value) } else { Err(damaged("a number is not finite")) }
    }

    pub(crate) fn f64(&mut self) -> Result<f64, DocumentError> {
        let value = f64::from_bits(self.u64()?);
        if value.is_finite() { Ok(value) } else { Err(damaged("a number is not finite")) }
    }

    pub(crate) fn vector(&mut self) -> Result<Vec3, DocumentError> {
        Ok(Vec3::new(self.f32()?, self.f32()?, self.f32()?))
    }

    pub(crate) fn rotation(&mut self) -> Result<Quat, DocumentError> {
        Ok(Quat::from_array([self.f32()?, self.f32()?, self.f32()?, self.f32()?]))
    }

    pub(crate) fn option(&mut self) -> Result<Option<u32>, DocumentError> {
        let (is_some, value) = (self.u8()?, self.u32()?);
        Ok((is_some != 0).then_some(value))
    }

    /// A row, which is never the greatest number.
    pub(crate) fn row(&mut self) -> Result<u32, DocumentError> {
        Some(self.u32()?).filter(|&row| row != u32::MAX).ok_or_else(|| damaged("a row is none"))
    }

    /// An axis, or none; whether the plant has it is for others to say.
    pub(crate) fn axis(&mut self) -> Result<Option<AxisId>, DocumentError> {
        self.option_row().map(|axis| axis.map(AxisId::new))
    }

    /// A metamer, or none; whether the plant has it is for others to say.
    pub(crate) fn metamer(&mut self) -> Result<Option<MetamerId>, DocumentError> {
        self.option_row().map(|metamer| metamer.map(MetamerId::new))
    }

    fn option_row(&mut self) -> Result<Option<usize>, DocumentError> {
        match self.option()? {
            Some(u32::MAX) => Err(damaged("a row is none")),
            row => Ok(row.map(|row| row as usize)),
        }
    }

    pub(crate) fn numbers(&mut self) -> Result<Vec<u32>, DocumentError> {
        let len = self.u32()? as usize;
        let column = self.slice(len.checked_mul(4).ok_or_else(cut_short)?)?;
        let (values, _) = column.as_chunks();
        Ok(values.iter().map(|&value| u32::from_le_bytes(value)).collect())
    }

    pub(crate) fn vectors(&mut self) -> Result<Vec<Vec3>, DocumentError> {
        self.list(Self::vector)
    }

    pub(crate) fn bytes(&mut self) -> Result<&'a [u8], DocumentError> {
        let len = self.u32()? as usize;
        self.slice(len)
    }

    pub(crate) fn text(&mut self) -> Result<&'a str, DocumentError> {
        std::str::from_utf8(self.bytes()?).map_err(|_| damaged("a text is not UTF-8"))
    }

    /// A list of so many items at most.
    pub(crate) fn list_up_to<T>(
        &mut self,
        most: usize,
        read: impl FnMut(&mut Self) -> Result<T, DocumentError>,
    ) -> Result<Vec<T>, DocumentError> {
        let len = self.clone().u32()? as usize;
        if len > most {
            return Err(damaged(format!("a list has {len} items, and at most {most} are possible")));
        }
        self.list(read)
    }

    pub(crate) fn list<T>(
        &mut self,
        mut read: impl FnMut(&mut Self) -> Result<T, DocumentError>,
    ) -> Result<Vec<T>, DocumentError> {
        let len = self.u32()? as usize;
        // Every item takes a byte at least, so a length beyond the rest is damage; no memory is allocated for it.
        if len > self.rest.len() {
            return Err(damaged("a list is longer than what is left"));
        }
        let mut items = Vec::with_capacity(len.min(ROOM));
        for _ in 0..len {
            items.push(read(self)?);
        }
        Ok(items)
    }
}

fn cut_short() -> DocumentError {
    damaged("it is cut short")
}
