//! Markers of free space that outlive a step: those of the brush and of the lasso (TreeSketch §3.2).

use glam::Vec3;

use crate::brush::StrokeId;

/// What sowed a marker, which says how long it stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkerSource {
    /// The brush of a stroke: gone once it is older than `marker_max_age`.
    Brush(StrokeId),
    /// The lasso: stays until it is occupied or guidance is dropped.
    Lasso,
}

/// A point that says: here is room to grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// Where, in internodes.
    pub position: Vec3,
    /// The tick in which it was sown.
    pub born: u32,
    /// What sowed it.
    pub source: MarkerSource,
}

/// All markers of the brush and the lasso, oldest first.
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

    /// Keeps those for which `is_free` holds, of the brush's only those not older than `max_age` ticks.
    pub(crate) fn clear(&mut self, tick: u32, max_age: u32, is_free: impl Fn(&Marker) -> bool) {
        self.markers.retain(|marker| {
            let lasts = match marker.source {
                MarkerSource::Brush(_) => tick.wrapping_sub(marker.born) <= max_age,
                MarkerSource::Lasso => true,
            };
            lasts && is_free(marker)
        });
    }

    /// Removes those of the lasso.
    pub(crate) fn remove_lasso(&mut self) {
        self.markers.retain(|marker| marker.source != MarkerSource::Lasso);
    }

    /// The stroke of each; none for those of the lasso.
    pub(crate) fn strokes(&self) -> impl Iterator<Item = Option<StrokeId>> + '_ {
        self.markers.iter().map(|marker| match marker.source {
            MarkerSource::Brush(stroke) => Some(stroke),
            MarkerSource::Lasso => None,
        })
    }

    /// Removes all.
    pub(crate) fn remove_all(&mut self) {
        self.markers.clear();
    }
}
