//! Light by shadow propagation (Pałubicki et al. 2009 §4.1; TreeSketch §3.2, Figure 4).
//!
//! Every metamer darkens its own voxel by `a` and a pyramid below it by `a·b^-q` at depth q. Shadows are kept
//! as whole numbers, so that taking one back leaves exactly what was there before.

use glam::Vec3;

use crate::{
    parameters::Parameters,
    voxel_grid::{EDGE, VoxelGrid, voxel_of},
};

/// Fixed-point steps of one unit of light.
const UNIT: f32 = 65536.0;

/// The shadows of all metamers.
#[derive(Clone, Debug)]
pub struct ShadowGrid {
    grid: VoxelGrid<u32>,
    /// Shadow at each depth below a metamer.
    strength: Vec<u32>,
    /// Half the width along x of each row of the pyramid's round layers: `half_width[q][|z|]`.
    half_width: Vec<Vec<i32>>,
}

impl ShadowGrid {
    /// No shadows yet.
    pub fn new(parameters: &Parameters) -> Self {
        let depth = parameters.shadow_depth;
        let mut fade = 1.0;
        let strength = (0..=depth)
            .map(|_| {
                let shadow = libm::roundf(parameters.shadow_strength * fade * UNIT) as u32;
                fade /= parameters.shadow_decay;
                shadow
            })
            .collect();
        Self { grid: VoxelGrid::new(), strength, half_width: (0..=depth).map(half_widths).collect() }
    }

    /// Adds the shadow of a metamer with its node at `position`.
    pub fn cast(&mut self, position: Vec3) {
        self.spread(position, u32::wrapping_add);
    }

    /// Takes the same shadow back.
    pub fn uncast(&mut self, position: Vec3) {
        self.spread(position, u32::wrapping_sub);
    }

    fn spread(&mut self, position: Vec3, change: impl Fn(u32, u32) -> u32) {
        let [x, y, z] = voxel_of(position);
        let reach = self.strength.len() as i32 - 1;
        let (strength, half_width) = (&self.strength, &self.half_width);
        let (low, high) = ([x - reach, y - reach, z - reach], [x + reach, y, z + reach]);
        self.grid.chunks_mut(low, high, |chunk, [left, bottom, back]| {
            for at_y in bottom.max(y - reach)..=(bottom + EDGE - 1).min(y) {
                let depth = y - at_y;
                let (shadow, widths) = (strength[depth as usize], &half_width[depth as usize]);
                for at_z in back.max(z - depth)..=(back + EDGE - 1).min(z + depth) {
                    let half = widths[(at_z - z).unsigned_abs() as usize];
                    let from = (x - half - left).max(0);
                    let to = (x + half - left).min(EDGE - 1);
                    if from > to {
                        continue;
                    }
                    let row = ((at_y - bottom) * EDGE + (at_z - back)) * EDGE;
                    for value in &mut chunk[(row + from) as usize..=(row + to) as usize] {
                        *value = change(*value, shadow);
                    }
                }
            }
        });
    }

    /// Light at a place, 0 to 1, as if the metamer whose node is there cast no shadow.
    ///
    /// Shadows are interpolated between voxel centres; read at one voxel they would come in blocks.
    pub fn exposure(&self, position: Vec3) -> f32 {
        let [x, y, z] = voxel_of(position - 0.5);
        let f = position - 0.5 - Vec3::new(x as f32, y as f32, z as f32);
        let octet = self.grid.octet([x, y, z]);
        let mut s = [0.0; 8];
        for (s, shadow) in s.iter_mut().zip(octet) {
            *s = shadow as f32;
        }
        let along_x = |i: usize| s[i] * (1.0 - f.x) + s[i + 1] * f.x;
        let along_z = |i: usize| along_x(i) * (1.0 - f.z) + along_x(i + 2) * f.z;
        let shadow = along_z(0) * (1.0 - f.y) + along_z(4) * f.y;
        let own = voxel_of(position);
        // The metamer's own shadow reaches the corners in its own voxel and those in the layer below.
        let share = |own: i32, base: i32, f: f32| if own == base { 1.0 - f } else { f };
        let at_own_height = share(own[1], y, f.y);
        let in_own_column = share(own[0], x, f.x) * share(own[2], z, f.z);
        let below = if own[1] == y { 0.0 } else { 1.0 - f.y };
        let first = self.strength[0] as f32 * at_own_height * in_own_column;
        let second = self.strength.get(1).map_or(0.0, |&s| s as f32) * below;
        (1.0 - (shadow - first - second) / UNIT).clamp(0.0, 1.0)
    }
}

/// A layer is a disc of radius q + ½ voxels: square layers would give square crowns.
fn half_widths(depth: u32) -> Vec<i32> {
    let radius_squared = (depth as f32 + 0.5) * (depth as f32 + 0.5);
    (0..=depth)
        .map(|dz| {
            let room = radius_squared - (dz * dz) as f32;
            (0..=depth as i32).rev().find(|dx| (dx * dx) as f32 <= room).unwrap_or(0)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::ParameterValues;
    use proptest::prelude::*;

    fn grid() -> ShadowGrid {
        ShadowGrid::new(&Parameters::default())
    }

    #[test]
    fn a_metamer_does_not_shade_itself() {
        for at in [Vec3::new(0.5, 9.5, 0.5), Vec3::new(0.1, 9.9, 0.7), Vec3::new(-3.3, 9.2, 4.8)] {
            let mut grid = grid();
            grid.cast(at);
            assert!((grid.exposure(at) - 1.0).abs() < 1e-4, "{at}: {}", grid.exposure(at));
        }
    }

    #[test]
    fn shade_falls_below_and_fades() {
        let shadow_at = |y: f32| {
            let mut grid = grid();
            grid.cast(Vec3::new(0.5, 20.5, 0.5));
            let reader = Vec3::new(0.5, y, 0.5);
            grid.cast(reader);
            1.0 - grid.exposure(reader)
        };
        assert!(shadow_at(22.5).abs() < 1e-4, "nothing above");
        assert!((shadow_at(19.5) - 0.06).abs() < 1e-3, "a/b one voxel below");
        assert!(shadow_at(18.5) < shadow_at(19.5) && shadow_at(16.5) < shadow_at(18.5));
        assert!(shadow_at(12.5).abs() < 1e-4, "nothing beyond the depth");
    }

    proptest! {
        #[test]
        fn uncast_leaves_no_trace(places in prop::collection::vec((-40f32..40.0, 0f32..60.0, -40f32..40.0), 1..60)) {
            let mut grid = grid();
            let places: Vec<Vec3> = places.into_iter().map(Vec3::from).collect();
            places.iter().for_each(|&p| grid.cast(p));
            places.iter().rev().for_each(|&p| grid.uncast(p));
            prop_assert!(grid.grid.values().all(|v| v == 0));
        }
    }

    #[test]
    fn no_depth_means_no_cast_below() {
        let values = ParameterValues { shadow_depth: 0, ..ParameterValues::default() };
        let mut grid = ShadowGrid::new(&Parameters::new(values).expect("in range"));
        grid.cast(Vec3::new(0.5, 9.5, 0.5));
        assert_eq!(grid.grid.values().filter(|&v| v > 0).count(), 1);
    }
}
