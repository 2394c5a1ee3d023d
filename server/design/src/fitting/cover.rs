//! How much the silhouettes of two crowns have in common.

use glam::{Vec2, Vec3};

/// Side of a pixel in internodes.
const PIXEL: f32 = 0.25;
/// What a twig's leaves cover around its node.
const FOLIAGE: f32 = 0.75;
/// Half of the widest gap that is closed.
const GAP: f32 = 1.0;
/// Most pixels along a side; larger crowns are seen through coarser ones.
const MOST: f32 = 1024.0;

/// A crown, to be compared with others.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Crown {
    low: Vec3,
    pixel: f32,
    /// Seen from the front and from the side.
    views: [Picture; 2],
}

impl Crown {
    /// The crown of these nodes, with room around it.
    pub(super) fn of(nodes: &[Vec3]) -> Self {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for &node in nodes {
            (low, high) = (low.min(node), high.max(node));
        }
        let room = 0.25 * (high - low).max_element() + FOLIAGE + 2.0 * GAP;
        let (low, high) = (low - room, high + room);
        let pixel = PIXEL.max((high - low).max_element() / MOST);
        let size = ((high - low) / pixel).ceil();
        let new = |width: f32| Picture::new(width as usize + 1, size.y as usize + 1);
        let mut crown = Self { low, pixel, views: [new(size.x), new(size.z)] };
        crown.views = crown.drawn(nodes);
        crown
    }

    /// Area common to both crowns over the area of either, both views together.
    pub(super) fn overlap(&self, nodes: &[Vec3]) -> f32 {
        let (mut both, mut either) = (0u32, 0u32);
        for (this, other) in self.views.iter().zip(&self.drawn(nodes)) {
            for (&a, &b) in this.covered.iter().zip(&other.covered) {
                both += u32::from(a && b);
                either += u32::from(a || b);
            }
        }
        both as f32 / either.max(1) as f32
    }

    /// What it covers in one view, in square internodes.
    pub(super) fn area(&self) -> f32 {
        let pixels: usize =
            self.views.iter().map(|view| view.covered.iter().filter(|&&covered| covered).count()).sum();
        0.5 * pixels as f32 * self.pixel * self.pixel
    }

    fn drawn(&self, nodes: &[Vec3]) -> [Picture; 2] {
        let mut views = [0, 1].map(|view| Picture::new(self.views[view].width, self.views[view].height));
        for &node in nodes {
            let at = (node - self.low) / self.pixel;
            views[0].mark(Vec2::new(at.x, at.y));
            views[1].mark(Vec2::new(at.z, at.y));
        }
        for view in &mut views {
            // Foliage, and then whatever no disc as wide as a gap fits into.
            view.grow((FOLIAGE + GAP) / self.pixel, true);
            view.grow(GAP / self.pixel, false);
        }
        views
    }
}

/// Which pixels are covered.
#[derive(Clone, Debug, PartialEq)]
struct Picture {
    width: usize,
    height: usize,
    covered: Vec<bool>,
}

impl Picture {
    fn new(width: usize, height: usize) -> Self {
        Self { width, height, covered: vec![false; width * height] }
    }

    fn mark(&mut self, at: Vec2) {
        // What is far outside stands at the rim: it counts as what the other crown has not.
        let at = at.round().clamp(Vec2::ZERO, Vec2::new(self.width as f32, self.height as f32) - 1.0);
        self.covered[at.y as usize * self.width + at.x as usize] = true;
    }

    /// Lets what is covered, or what is not, grow by a distance in pixels.
    fn grow(&mut self, by: f32, covered: bool) {
        let reach = by as usize;
        // How far the nearest such pixel of the same line is.
        let far = reach as u32 + 1;
        let mut along = vec![far; self.covered.len()];
        for (line, along) in self.covered.chunks(self.width).zip(along.chunks_mut(self.width)) {
            let mut last = far;
            for (&here, near) in line.iter().zip(along.iter_mut()) {
                last = if here == covered { 0 } else { (last + 1).min(far) };
                *near = last;
            }
            last = far;
            for (&here, near) in line.iter().zip(along.iter_mut()).rev() {
                last = if here == covered { 0 } else { (last + 1).min(far) };
                *near = last.min(*near);
            }
        }
        // How far along another line it may be.
        let spans: Vec<u32> =
            (0..=reach).map(|off| (by * by - (off * off) as f32).max(0.0).sqrt() as u32).collect();
        for y in 0..self.height {
            let (from, to) = (y.saturating_sub(reach), (y + reach).min(self.height - 1));
            for x in 0..self.width {
                let at = y * self.width + x;
                if self.covered[at] == covered {
                    continue;
                }
                if (from..=to).any(|other| along[other * self.width + x] <= spans[other.abs_diff(y)]) {
                    self.covered[at] = covered;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(height: u16, x: f32) -> Vec<Vec3> {
        (0..height).map(|y| Vec3::new(x, f32::from(y), 0.0)).collect()
    }

    #[test]
    fn a_crown_covers_itself_and_half_of_one_twice_as_tall() {
        let crown = Crown::of(&column(40, 0.0));
        assert_eq!(crown.overlap(&column(40, 0.0)), 1.0);
        let half = crown.overlap(&column(20, 0.0));
        assert!((half - 0.5).abs() < 0.03, "{half}");
    }

    #[test]
    fn gaps_of_two_internodes_are_closed_and_wider_ones_are_not() {
        let wall = |gap: f32| [column(40, 0.0), column(40, 1.5 + gap)].concat();
        let closed = |gap: f32| {
            let crown = Crown::of(&wall(gap));
            let middle = Vec3::new(0.75 + 0.5 * gap, 20.0, 0.0);
            let at = ((middle - crown.low) / crown.pixel).round();
            crown.views[0].covered[at.y as usize * crown.views[0].width + at.x as usize]
        };
        assert!(closed(1.5) && !closed(2.5));
    }
}
