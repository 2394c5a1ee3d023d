//! Rectangles side by side in a square.

use glam::Vec2;

/// The lower left corners of boxes in a square of this side, on shelves from its foot upwards: as high as the first on
/// each, so the highest should come first. None where they do not fit.
pub(super) fn shelves(boxes: impl Iterator<Item = Vec2>, side: f32) -> Option<Vec<Vec2>> {
    let (mut at, mut above) = (Vec2::ZERO, 0.0);
    boxes
        .map(|size| {
            if at.x + size.x > side {
                (at, above) = (Vec2::new(0.0, at.y + above), 0.0);
            }
            above = size.y.max(above);
            let place = at;
            at.x += size.x;
            (place.x + size.x <= side && place.y + size.y <= side).then_some(place)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_stand_on_shelves() {
        let boxes = [Vec2::new(2.0, 3.0), Vec2::new(2.0, 2.0), Vec2::new(2.0, 1.0)];
        let places = shelves(boxes.into_iter(), 4.0).expect("they fit");
        assert_eq!(places, [Vec2::ZERO, Vec2::new(2.0, 0.0), Vec2::new(0.0, 3.0)]);
        assert_eq!(shelves(boxes.into_iter(), 3.9), None);
        assert_eq!(shelves([Vec2::new(5.0, 1.0)].into_iter(), 4.0), None);
    }
}
