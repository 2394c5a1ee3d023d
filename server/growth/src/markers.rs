//! Markers of free space that outlive a step: those the brush has sown (TreeSketch §3.2).

use glam::Vec3;

/// A point that says: here is room to grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// Where, in internodes.
    pub position: Vec3,
    /// The tick in which it was sown.
    pub born: u32,
}

/// All brush markers, oldest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Markers {
    markers: Vec<Marker>,
}

impl Markers {
    /// The markers.
    pub fn as_slice(&self) -> &[Marker] {
        &self.markers
    }

    /// The markers as they were written down once.
    pub fn from_vec(markers: Vec<Marker>) -> Self {
        Self { markers }
    }

    /// Sows one.
    pub(crate) fn sow(&mut self, marker: Marker) {
        self.markers.push(marker);
    }

    /// Keeps those for which `free` holds and that are not older than `max_age` ticks.
    pub(crate) fn clear(&mut self, tick: u32, max_age: u32, free: impl Fn(Vec3) -> bool) {
        self.markers.retain(|marker| tick.wrapping_sub(marker.born) <= max_age && free(marker.position));
    }

    /// Removes all.
    pub(crate) fn remove_all(&mut self) {
        self.markers.clear();
    }
}
