//! Where pictures are taken from.

use glam::{Vec2, Vec3};

use super::raster::View;

/// Share of a picture's height below the foot of the plant.
pub(super) const FOOT: f32 = 0.1;
/// Share of a picture's width and height that the plant may take.
const ROOM: f32 = 0.94;
/// The nearest that an eye sees, as a share of its distance from what it looks at.
const NEAREST: f32 = 0.01;

/// Where a picture is taken from, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// How far the eye has gone around the plant, from the front to the right.
    pub turn: f32,
    /// How high it stands above the horizon, more than -90 and less than 90.
    pub rise: f32,
    /// How near it is; without, it is so far away that nothing is larger for being nearer.
    pub perspective: Option<Perspective>,
}

/// An eye that stands somewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perspective {
    /// The angle between the upper and the lower edge of the picture, in degrees, more than 0 and less than 180.
    pub field: f32,
    /// What is in the middle of the picture, in internodes; the middle of all there is if not given.
    pub target: Option<Vec3>,
    /// How far from that the eye is, in internodes; so far that all there is fits if not given.
    pub distance: Option<f32>,
}

impl Default for Camera {
    /// From the front, looking down a little.
    fn default() -> Self {
        Self { turn: 0.0, rise: 5.710_593, perspective: None }
    }
}

impl Camera {
    /// The unit vector to the eye.
    pub(super) fn eye(self) -> Vec3 {
        let [turn, rise] = [self.turn, self.rise].map(|degrees| libm::sincosf(degrees.to_radians()));
        Vec3::new(turn.0 * rise.1, rise.0, turn.1 * rise.1)
    }

    /// The unit vectors to so many eyes all around, beginning with this one.
    pub(super) fn around(self, frames: u16) -> Vec<Vec3> {
        let turned = |frame: u16| self.turn + 360.0 * f32::from(frame) / f32::from(frames);
        (0..frames).map(|frame| Self { turn: turned(frame), ..self }.eye()).collect()
    }
}

/// What pictures are to show, each as large as `size`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Framing {
    /// Samples across and down.
    pub size: Vec2,
    /// The height that the foot line shows, where nothing is larger for being nearer.
    pub base: f32,
    /// Whether the foot is in the middle then, so that it stays there when the eye goes around.
    pub is_steady: bool,
}

impl Framing {
    /// Views from directions, all in one scale, in which all points fit above the foot line.
    pub(super) fn distant(&self, points: impl Iterator<Item = Vec3> + Clone, eyes: &[Vec3]) -> Vec<View> {
        let (mut low, mut high) = (Vec3::new(-0.5, -1.0, 0.0), Vec3::new(0.5, 0.0, 0.0));
        let mut foot = f32::MAX;
        for &eye in eyes {
            let plain = View::new(eye, 1.0, Vec2::ZERO);
            foot = foot.min(plain.project(Vec3::Y * self.base).y);
            for point in points.clone() {
                let seen = plain.project(point);
                (low, high) = (low.min(seen), high.max(seen));
            }
        }
        if self.is_steady {
            high.x = high.x.max(-low.x);
            low.x = -high.x;
        }
        let size = self.size;
        let [room, above] = [ROOM, ROOM - FOOT].map(|share| share * size);
        let fits = (room.x / (high.x - low.x)).min(above.y / (foot - low.y));
        // Seen from high above, what is in front of the foot lies below it in the picture.
        let scale = fits.min(room.y / (high.y - low.y));
        let right = 0.5 * size.x - scale * 0.5 * (low.x + high.x);
        let down = (1.0 - FOOT) * size.y - scale * foot;
        let lowest = (1.0 - 0.5 * (1.0 - ROOM)) * size.y - scale * high.y;
        eyes.iter().map(|&eye| View::new(eye, scale, Vec2::new(right, down.min(lowest)))).collect()
    }

    /// Views from places, all as far from what they look at.
    pub(super) fn close(
        &self,
        points: impl Iterator<Item = Vec3> + Clone,
        eyes: &[Vec3],
        Perspective { field, target, distance }: Perspective,
    ) -> Vec<View> {
        let target = target.unwrap_or_else(|| middle(points.clone()));
        let tangent = libm::tanf(0.5 * field.to_radians());
        let across = tangent * self.size.x / self.size.y;
        let distance = distance.unwrap_or_else(|| {
            let mut distance = 1.0_f32;
            for &eye in eyes {
                let plain = View::new(eye, 1.0, Vec2::ZERO);
                for point in points.clone() {
                    let seen = plain.project(point - target);
                    let sides = (seen.x.abs() / across).max(seen.y.abs() / tangent);
                    distance = distance.max(seen.z + sides / ROOM);
                }
            }
            distance
        });
        let scale = 0.5 * self.size.y / tangent;
        let view =
            |&eye| View::new(eye, scale, 0.5 * self.size).from(target + distance * eye, NEAREST * distance);
        eyes.iter().map(view).collect()
    }
}

/// The middle of the box around all points.
fn middle(points: impl Iterator<Item = Vec3>) -> Vec3 {
    let boxed = points.fold(None, |boxed: Option<(Vec3, Vec3)>, point| {
        let (low, high) = boxed.unwrap_or((point, point));
        Some((low.min(point), high.max(point)))
    });
    boxed.map_or(Vec3::ZERO, |(low, high)| 0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec2 = Vec2::new(400.0, 300.0);
    const FRAMING: Framing = Framing { size: SIZE, base: 0.0, is_steady: false };

    fn camera(turn: f32, rise: f32) -> Camera {
        Camera { turn, rise, perspective: None }
    }

    fn corners() -> impl Iterator<Item = Vec3> + Clone {
        (0..8).map(|at| Vec3::new((at & 1) as f32 * 6.0 - 3.0, (at & 2) as f32 * 4.0, (at & 4) as f32 - 2.0))
    }

    #[test]
    fn ex6_a_known_point_is_at_a_known_pixel() {
        // An eye 10 in front of (1, 2, 3) that sees 10 above and 10 below it.
        let near = Perspective { field: 90.0, target: Some(Vec3::new(1.0, 2.0, 3.0)), distance: Some(10.0) };
        let view = |turn, rise| FRAMING.close(corners(), &[camera(turn, rise).eye()], near)[0];
        let pixel = |view: View, at: [f32; 3]| view.project(Vec3::from_array(at)).truncate();
        let is_at = |seen: Vec2, x: f32, y: f32| {
            assert!(seen.distance(Vec2::new(x, y)) < 1e-2, "{seen} is not {x}, {y}");
        };
        is_at(pixel(view(0.0, 0.0), [1.0, 2.0, 3.0]), 200.0, 150.0);
        is_at(pixel(view(0.0, 0.0), [1.0, 12.0, 3.0]), 200.0, 0.0);
        is_at(pixel(view(0.0, 0.0), [6.0, -3.0, 3.0]), 275.0, 225.0);
        // Half as far away, it is twice as far from the middle.
        is_at(pixel(view(0.0, 0.0), [3.0, 3.0, 8.0]), 260.0, 120.0);
        // From the right, what was in front is on the left.
        is_at(pixel(view(90.0, 0.0), [1.0, 2.0, 8.0]), 125.0, 150.0);
        // From 30° below, what is upright is shortened, and its upper end is further away.
        let (up, away) = (10.0 * libm::sqrtf(0.75), 15.0);
        is_at(pixel(view(0.0, -30.0), [1.0, 12.0, 3.0]), 200.0, 150.0 - 150.0 * up / away);
    }

    #[test]
    fn all_there_is_fits_unless_more_is_said() {
        for (turn, rise, field) in [(0.0, 5.0, 32.0), (40.0, -60.0, 80.0), (200.0, 89.0, 5.0)] {
            let near = Perspective { field, target: None, distance: None };
            let eyes = Camera { perspective: Some(near), ..camera(turn, rise) }.around(5);
            for views in [FRAMING.close(corners(), &eyes, near), FRAMING.distant(corners(), &eyes)] {
                let seen =
                    views.iter().flat_map(|view| corners().map(|point| view.project(point).truncate()));
                let (low, high) =
                    seen.fold((SIZE, Vec2::ZERO), |(low, high), at| (low.min(at), high.max(at)));
                assert!(low.min_element() >= 0.0 && (SIZE - high).min_element() >= 0.0, "{low} {high}");
                assert!((high - low).max_element() > 150.0, "it is seen as large as it can be: {low} {high}");
            }
        }
    }

    #[test]
    fn what_there_is_none_of_has_a_view_too() {
        let near = Perspective { field: 30.0, target: None, distance: None };
        let view = FRAMING.close(std::iter::empty(), &[Vec3::Z], near)[0];
        assert_eq!(view.project(Vec3::ZERO).truncate(), 0.5 * SIZE);
    }
}
