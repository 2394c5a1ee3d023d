//! The living wood of a plant as files of structure write it: numbered without gaps, in metres.

use espalier_mesh::Style;
use espalier_plant::{AxisId, MetamerId, Plant, Widths, wood::as_written};
use glam::DVec3;

use crate::ExportError;

/// Digits after the first that a number is written with: a 32-bit number comes back bit by bit from as many, even
/// where it was multiplied on the way.
const DIGITS: usize = 9;
/// Metres that are written as 0.
const NOTHING: f64 = 1e-12;

/// What lives of a plant, and its numbers: files have no rows of the dead.
pub(crate) struct Structure<'a> {
    pub plant: &'a Plant,
    /// Living metamers, seeds included, in birth order: the place of each is its number.
    pub metamers: Vec<MetamerId>,
    /// Axes with a living bud or living wood; the place of each is its number.
    pub axes: Vec<AxisId>,
    numbers: Vec<u32>,
    axis_numbers: Vec<u32>,
    widths: Widths<'a>,
    wanted: Vec<(MetamerId, f32)>,
    scale: f64,
}

impl<'a> Structure<'a> {
    /// # Errors
    /// Where an internode cannot be as long as that.
    pub(crate) fn of(
        plant: &'a Plant,
        style: &'a Style,
        metres_per_internode: f32,
    ) -> Result<Self, ExportError> {
        if !(metres_per_internode.is_finite() && metres_per_internode > 0.0) {
            return Err(ExportError::Scale(metres_per_internode));
        }
        let living = (0..plant.metamer_count()).map(MetamerId::new).filter(|&id| plant.is_alive(id));
        let standing = (0..plant.axis_count()).map(AxisId::new).filter(|&axis| plant.is_standing(axis));
        let (metamers, axes): (Vec<_>, Vec<_>) = (living.collect(), standing.collect());
        let mut numbers = vec![0; plant.metamer_count()];
        for (&id, number) in metamers.iter().zip(0..) {
            numbers[id.index()] = number;
        }
        let mut axis_numbers = vec![0; plant.axis_count()];
        for (&axis, number) in axes.iter().zip(0..) {
            axis_numbers[axis.index()] = number;
        }
        let widths = Widths::of(plant, style.girth());
        let (wanted, scale) = (plant.widths().collect(), as_written(metres_per_internode));
        Ok(Self { plant, metamers, axes, numbers, axis_numbers, widths, wanted, scale })
    }

    /// The number of a living metamer.
    pub(crate) fn number(&self, id: MetamerId) -> u32 {
        self.numbers[id.index()]
    }

    /// The number of an axis that stands.
    pub(crate) fn axis_number(&self, axis: AxisId) -> u32 {
        self.axis_numbers[axis.index()]
    }

    /// A length in internodes as metres.
    pub(crate) fn metres(&self, internodes: f32) -> f64 {
        f64::from(internodes) * self.scale
    }

    /// Where the node of a metamer is, in metres, Y up.
    pub(crate) fn place(&self, id: MetamerId) -> DVec3 {
        self.plant.metamers().end(id).as_dvec3() * self.scale
    }

    /// The radius at the node of a metamer in internodes; 0 for a seed.
    pub(crate) fn radius(&self, id: MetamerId) -> f32 {
        if self.plant.is_seed(id) { 0.0 } else { self.widths.radius(id) }
    }

    /// The diameter in internodes that a width constraint asks of a metamer.
    pub(crate) fn wanted(&self, id: MetamerId) -> Option<f32> {
        let at = self.wanted.binary_search_by_key(&id, |&(id, _)| id).ok()?;
        Some(self.wanted[at].1)
    }

    /// Tips of twigs that were shed, for each living metamer those that it bore.
    pub(crate) fn shed(&self) -> Vec<u32> {
        self.plant.tips_of_shed(&self.metamers)
    }

    /// The living wood of each axis from its base to its tip, seeds left out.
    pub(crate) fn wood_of_axes(&self) -> Vec<Vec<MetamerId>> {
        let mut wood = vec![Vec::new(); self.axes.len()];
        for &id in self.metamers.iter().filter(|&&id| !self.plant.is_seed(id)) {
            wood[self.axis_number(self.plant.metamers().axis(id)) as usize].push(id);
        }
        wood
    }
}

/// A number with as many digits as it takes.
pub(crate) fn rounded(number: f64) -> f64 {
    if number.abs() < NOTHING {
        return 0.0;
    }
    // What was written is a number.
    format!("{number:.DIGITS$e}").parse().unwrap_or(number)
}

/// Turned as scanners and plant models have it: X to the right, Y to the back, Z up.
pub(crate) fn z_up(v: DVec3) -> DVec3 {
    DVec3::new(v.x, -v.z, v.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_comes_back_bit_by_bit() {
        for internodes in [1.0f32, 0.1, 123.456_78, 1e-3, -999.999_9, 3.402_823_5e-4] {
            for scale in [0.005f32, 0.1, 0.333_333_34, 1.0] {
                let metres = rounded(f64::from(internodes) * as_written(scale));
                assert_eq!((metres / as_written(scale)) as f32, internodes, "{internodes} by {scale}");
            }
        }
        assert_eq!(rounded(-1e-20).to_bits(), 0.0f64.to_bits());
    }

    #[test]
    fn z_is_up_and_nothing_is_mirrored() {
        assert_eq!(z_up(DVec3::Y), DVec3::Z);
        assert_eq!(z_up(DVec3::X).cross(z_up(DVec3::Y)), z_up(DVec3::Z));
    }
}
