//! A picture in memory.

use glam::Vec3;

use super::palette;
use crate::{colour::encoded, png};

/// Pixels in rows from the top, in linear light from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<Vec3>,
}

impl Canvas {
    /// A canvas of one colour.
    pub fn new(width: usize, height: usize, colour: Vec3) -> Self {
        Self { width, height, pixels: vec![colour; width * height] }
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// One pixel.
    pub fn get(&self, x: usize, y: usize) -> Vec3 {
        self.pixels[y * self.width + x]
    }

    /// Sets one pixel.
    pub fn set(&mut self, x: usize, y: usize, colour: Vec3) {
        self.pixels[y * self.width + x] = colour;
    }

    /// Lays a colour over a pixel, which it covers by `cover`; outside of the canvas nothing happens.
    pub(crate) fn blend(&mut self, x: i32, y: i32, colour: Vec3, cover: f32) {
        if (0..self.width as i32).contains(&x) && (0..self.height as i32).contains(&y) {
            let pixel = &mut self.pixels[y as usize * self.width + x as usize];
            *pixel = pixel.lerp(colour, cover);
        }
    }

    /// Puts another canvas with its upper left corner at a place; all of it must fit.
    pub(crate) fn paste(&mut self, other: &Self, x: usize, y: usize) {
        for row in 0..other.height {
            let to = (y + row) * self.width + x;
            let from = row * other.width;
            self.pixels[to..to + other.width].copy_from_slice(&other.pixels[from..from + other.width]);
        }
    }

    /// The middle of each square of `factor` times `factor` pixels.
    pub(crate) fn reduced(&self, factor: usize) -> Self {
        let mut small = Self::new(self.width / factor, self.height / factor, Vec3::ZERO);
        let share = 1.0 / (factor * factor) as f32;
        for y in 0..small.height {
            for x in 0..small.width {
                let inside =
                    (0..factor * factor).map(|i| self.get(x * factor + i % factor, y * factor + i / factor));
                small.set(x, y, inside.fold(Vec3::ZERO, |sum, pixel| sum + pixel) * share);
            }
        }
        small
    }

    /// What each pixel shows on a screen.
    pub(crate) fn pixels(&self) -> Vec<[u8; 3]> {
        self.pixels.iter().map(|&pixel| encoded(pixel)).collect()
    }

    /// The picture as a PNG file of at most 256 colours.
    pub fn png(&self) -> Vec<u8> {
        let pixels = self.pixels();
        let (colours, indices) = palette::reduce(self.width, &pixels);
        png::indexed(self.width, self.height, &colours, &indices)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reducing_takes_the_mean() {
        let mut canvas = Canvas::new(4, 2, Vec3::ZERO);
        canvas.set(0, 0, Vec3::ONE);
        let small = canvas.reduced(2);
        assert_eq!((small.width(), small.height()), (2, 1));
        assert_eq!((small.get(0, 0), small.get(1, 0)), (Vec3::splat(0.25), Vec3::ZERO));
    }

    #[test]
    fn what_lies_outside_is_not_painted() {
        let mut canvas = Canvas::new(2, 2, Vec3::ZERO);
        canvas.blend(-1, 0, Vec3::ONE, 1.0);
        canvas.blend(0, 2, Vec3::ONE, 1.0);
        assert_eq!(canvas, Canvas::new(2, 2, Vec3::ZERO));
    }
}
