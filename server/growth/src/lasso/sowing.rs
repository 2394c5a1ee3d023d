//! Markers of an envelope, laid tile by tile as growth comes near.
//!
//! Markers lie evenly in the body's volume, closer where nodes lie closer: it is cut into as many slices of equal weight,
//! along a curve that keeps what is near together, and each gets one. That is evener than chance, which leaves clusters and
//! holes. Each tile is a piece of the curve, so that it can be laid without the others.

use glam::{Vec2, Vec3};

use super::Envelope;
use crate::random::Draw;

/// Codes of the curve to a tile: 8 × 8 pixels.
const TILE: u32 = 64;
/// Pixels to the edge of a tile.
const EDGE: usize = 8;
/// Places keep to this share of a pixel's column, so that rounding does not carry them out of it.
const WITHIN: f32 = 0.999;

/// How many markers an envelope holds, and which of its tiles have theirs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sowing {
    draw: Draw,
    count: usize,
    /// The weight of a slice.
    slice: f64,
    /// The weight before each tile along the curve.
    before: Vec<f64>,
    is_laid: Vec<bool>,
}

impl Sowing {
    /// `count` markers, none of them laid yet.
    pub(crate) fn new(envelope: &Envelope, count: usize, draw: Draw) -> Self {
        let side = envelope.width.max(envelope.rows()).next_power_of_two().max(EDGE) as u32;
        let tiles = side * side / TILE;
        let mut weight = 0.0;
        let before = (0..tiles).map(|tile| {
            let before = weight;
            weight = envelope.pixels_of(tile).fold(weight, |sum, pixel| sum + envelope.weight(pixel));
            before
        });
        let before = before.collect();
        Self { draw, count, slice: weight / count as f64, before, is_laid: vec![false; tiles as usize] }
    }

    /// Calls `lay` with the markers of all tiles that come within `reach` of a place.
    pub(crate) fn come_near(
        &mut self,
        envelope: &Envelope,
        place: Vec3,
        reach: f32,
        mut lay: impl FnMut(Vec3),
    ) {
        let at = envelope.in_pixels(place).truncate() / EDGE as f32;
        let reach = reach / (envelope.pixel * EDGE as f32);
        let tiles = |at: f32, pixels: usize| {
            let last = pixels.div_ceil(EDGE) as f32;
            (at - reach).clamp(0.0, last) as usize..(at + reach + 1.0).clamp(0.0, last) as usize
        };
        for y in tiles(at.y, envelope.rows()) {
            for x in tiles(at.x, envelope.width) {
                let tile = spread(x as u32) | spread(y as u32) << 1;
                if !core::mem::replace(&mut self.is_laid[tile as usize], true) {
                    self.places(envelope, tile, &mut lay);
                }
            }
        }
    }

    fn places(&self, envelope: &Envelope, tile: u32, mut lay: impl FnMut(Vec3)) {
        let jittered = |i: usize| (i as f64 + f64::from(self.draw.unit(3 * i as u32))) * self.slice;
        let mut filled = self.before[tile as usize];
        let mut i = (filled / self.slice) as usize;
        if jittered(i) < filled {
            i += 1;
        }
        let normal = envelope.plane.right.cross(envelope.plane.up);
        for pixel in envelope.pixels_of(tile) {
            filled += envelope.weight(pixel);
            while jittered(i) < filled && i < self.count {
                let number = i as u32;
                let unit = |nth| self.draw.unit(3 * number + nth);
                let jitter = Vec2::new(unit(1), unit(2)) - 0.5;
                let at = Vec2::new((pixel % envelope.width) as f32, (pixel / envelope.width) as f32);
                let in_plane = envelope.corner + (at + jitter * WITHIN) * envelope.pixel;
                // Depths follow the golden ratio, so that neighbours along the curve lie far apart in depth.
                let share = (number.wrapping_mul(0x9e37_79b9) >> 8) as f32 * (1.0 / 16_777_216.0);
                let depth =
                    envelope.middle(pixel) + envelope.half_depth(pixel) * (2.0 * share - 1.0) * WITHIN;
                let plane = envelope.plane;
                lay(plane.origin + plane.right * in_plane.x + plane.up * in_plane.y + normal * depth);
                i += 1;
            }
        }
    }
}

impl Envelope {
    /// How many markers the body holds at a density, in markers to the cubic internode where nodes keep a whole zone apart.
    pub(crate) fn marker_count(&self, density: f32) -> f64 {
        f64::from(density) * (0..self.height.len()).map(|pixel| self.weight(pixel)).sum::<f64>()
    }

    /// The volume of a pixel's column, times the cube of how much closer nodes lie in it than elsewhere.
    fn weight(&self, pixel: usize) -> f64 {
        let closer = f64::from(self.zone / self.zone_in(pixel));
        let column = 2.0 * f64::from(self.pixel) * f64::from(self.pixel);
        column * f64::from(self.half_depth(pixel)) * closer * closer * closer
    }

    /// The pixels of a tile, along the curve.
    fn pixels_of(&self, tile: u32) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.width, self.rows());
        let places = (tile * TILE..(tile + 1) * TILE)
            .map(|code| (every_other_bit(code) as usize, every_other_bit(code >> 1) as usize));
        places.filter(move |&(x, y)| x < width && y < height).map(move |(x, y)| y * width + x)
    }
}

/// Bits 0, 2, 4, … packed together.
fn every_other_bit(code: u32) -> u32 {
    let mut bits = code & 0x5555_5555;
    bits = (bits | bits >> 1) & 0x3333_3333;
    bits = (bits | bits >> 2) & 0x0f0f_0f0f;
    bits = (bits | bits >> 4) & 0x00ff_00ff;
    (bits | bits >> 8) & 0x0000_ffff
}

/// The other way around: bits become bits 0, 2, 4, …
fn spread(bits: u32) -> u32 {
    (0..16).fold(0, |code, bit| code | (bits >> bit & 1) << (2 * bit))
}
