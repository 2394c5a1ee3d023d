//! Triangle meshes as obstacles.

use glam::Vec3;

use super::{
    checks::{ObstacleError, check_place},
    triangle::{Edges, Triangle},
    triangle_grid::{Side, TriangleGrid, Walk},
};

/// Triangles a mesh may have.
pub const MAX_TRIANGLES: usize = 200_000;

/// Triangles with an area, checked; a solid if every edge is shared by an even number of them, else a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleMesh {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    is_closed: bool,
    grid: TriangleGrid,
}

impl TriangleMesh {
    /// Takes vertices and, for each triangle, the numbers of its corners. Triangles without area are left out.
    pub fn new(vertices: Vec<Vec3>, mut triangles: Vec<[u32; 3]>) -> Result<Self, ObstacleError> {
        if triangles.len() > MAX_TRIANGLES {
            return Err(ObstacleError::TooManyTriangles(triangles.len()));
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&corner| corner as usize >= vertices.len()) {
                return Err(ObstacleError::NoSuchVertex { triangle, index, vertices: vertices.len() });
            }
        }
        for &vertex in &vertices {
            check_place("place of a vertex", vertex)?;
        }
        // Asked first: a triangle without area may still join two that have one.
        let is_closed = is_closed(&vertices, &triangles);
        triangles.retain(|&corners| area_normal(&vertices, corners).length_squared() > 0.0);
        if triangles.is_empty() {
            return Err(ObstacleError::EmptyMesh);
        }
        let corners: Vec<Triangle> = triangles.iter().map(|&corners| placed(&vertices, corners)).collect();
        let mut mesh = Self { grid: TriangleGrid::new(&corners), vertices, triangles, is_closed };
        if is_closed {
            let mut grid = mesh.grid.clone();
            grid.tell_sides(|_, place| mesh.is_enclosed(place));
            mesh.grid = grid;
        }
        Ok(mesh)
    }

    /// Places of the vertices.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Corners of each triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Whether the mesh encloses a volume, which is then solid.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// The box along the axes that holds all of it.
    pub(super) fn bounds(&self) -> (Vec3, Vec3) {
        self.grid.bounds()
    }

    /// Whether a place lies in the solid.
    pub(super) fn contains(&self, place: Vec3) -> bool {
        self.is_closed
            && match self.grid.side(place) {
                Side::Inside => true,
                Side::Outside => false,
                Side::Mixed => self.is_enclosed(place),
            }
    }

    /// Whether two of three rays leave through an odd number of triangles; one may be misled by an edge.
    fn is_enclosed(&self, place: Vec3) -> bool {
        PROBES.iter().filter(|&&probe| self.passages(place, probe) % 2 == 1).count() >= 2
    }

    /// How many triangles a ray passes.
    fn passages(&self, from: Vec3, along: Vec3) -> usize {
        let mut passages = 0;
        self.grid.walk(from, along, f32::INFINITY, |list, since, until| {
            // A triangle is listed in many cells, but met in one.
            let span = f64::from(since)..f64::from(until);
            let met = |&&number: &&u32| {
                self.triangle(number).meets(from, along, Edges::Split).is_some_and(|t| span.contains(&t))
            };
            passages += list.iter().filter(met).count();
            Walk::Go
        });
        passages
    }

    /// Where a moving point first meets the surface, from 0 to 1, and the normal there; at once in the solid.
    pub(super) fn first_hit(&self, from: Vec3, along: Vec3) -> Option<(f32, Vec3)> {
        if self.contains(from) {
            return Some((0.0, along.try_normalize().map_or(Vec3::Y, |ahead| -ahead)));
        }
        let mut first: Option<(f64, u32)> = None;
        self.grid.walk(from, along, 1.0, |list, _, until| {
            for &number in list {
                if let Some(t) = self.triangle(number).meets(from, along, Edges::Belong)
                    && t <= 1.0
                    && first.is_none_or(|held| (t, number) < held)
                {
                    first = Some((t, number));
                }
            }
            if first.is_some_and(|(t, _)| t <= f64::from(until)) { Walk::Stop } else { Walk::Go }
        });
        first.map(|(t, number)| {
            let normal = self.triangle(number).normal();
            (t as f32, if normal.dot(along) > 0.0 { -normal } else { normal })
        })
    }

    /// Whether a ray meets the surface, or begins in the solid.
    pub(super) fn meets_ray(&self, from: Vec3, direction: Vec3) -> bool {
        let mut met = self.contains(from);
        if !met {
            self.grid.walk(from, direction, f32::INFINITY, |list, _, _| {
                let meets = |&number| self.triangle(number).meets(from, direction, Edges::Belong).is_some();
                met = list.iter().any(meets);
                if met { Walk::Stop } else { Walk::Go }
            });
        }
        met
    }

    /// The point of the surface nearest to a place, if it is no farther than `radius`.
    pub(super) fn nearest(&self, place: Vec3, radius: f32) -> Option<Vec3> {
        let mut nearest: Option<(f32, u32, Vec3)> = None;
        self.grid.near(place, radius, |number| {
            let point = self.triangle(number).nearest(place);
            let distance = point.distance_squared(place);
            if distance <= radius * radius && nearest.is_none_or(|(d, n, _)| (distance, number) < (d, n)) {
                nearest = Some((distance, number, point));
            }
        });
        nearest.map(|(.., point)| point)
    }

    fn triangle(&self, number: u32) -> Triangle {
        placed(&self.vertices, self.triangles[number as usize])
    }
}

/// Directions without a pattern that a mesh could share.
const PROBES: [Vec3; 3] = [
    Vec3::new(0.373_1, 0.853_7, 0.363_3),
    Vec3::new(-0.711_9, 0.241_7, 0.659_3),
    Vec3::new(0.283_7, -0.463_9, -0.839_1),
];

fn placed(vertices: &[Vec3], corners: [u32; 3]) -> Triangle {
    Triangle(corners.map(|corner| vertices[corner as usize]))
}

/// The normal of a triangle, as long as twice its area.
fn area_normal(vertices: &[Vec3], corners: [u32; 3]) -> Vec3 {
    let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
    (b - a).cross(c - a)
}

/// Vertices nearer than this, over the mesh's size, may count as one.
const WELD: f32 = 1.0e-5;

/// Whether every edge belongs to an even number of triangles. Vertices at one place count as one, for exporters
/// repeat them where normals or textures change, and seldom close the pole of a sphere to the last bit.
fn is_closed(vertices: &[Vec3], triangles: &[[u32; 3]]) -> bool {
    let used = || triangles.iter().flatten().map(|&corner| vertices[corner as usize]);
    let low = used().fold(Vec3::INFINITY, Vec3::min);
    let grain = WELD * (used().fold(Vec3::NEG_INFINITY, Vec3::max) - low).max_element();
    if grain.is_nan() || grain <= 0.0 {
        return false;
    }
    let middle = low + 0.5e5 * grain;
    let key = |corner: u32| {
        ((vertices[corner as usize] - middle) / grain).to_array().map(|x| libm::roundf(x) as i32)
    };
    let mut edges: Vec<[[i32; 3]; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[from, to]| [key(from), key(to)])
        .filter(|[from, to]| from != to)
        .map(|[from, to]| if from < to { [from, to] } else { [to, from] })
        .collect();
    edges.sort_unstable();
    edges.chunk_by(|a, b| a == b).all(|same| same.len() % 2 == 0)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A box from corner to corner, of twelve triangles.
    pub(in crate::obstacles) fn cuboid(low: Vec3, high: Vec3) -> TriangleMesh {
        let vertices = (0..8)
            .map(|i| {
                let pick = |bit: i32, low: f32, high: f32| if i >> bit & 1 == 0 { low } else { high };
                Vec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
            })
            .collect();
        let faces: [[u32; 4]; 6] =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        TriangleMesh::new(vertices, triangles).expect("a box is a mesh")
    }

    #[test]
    fn a_box_is_closed_and_a_lidless_one_is_not() {
        let solid = cuboid(Vec3::ZERO, Vec3::ONE);
        assert!(solid.is_closed());
        let open =
            TriangleMesh::new(solid.vertices().to_vec(), solid.triangles()[2..].to_vec()).expect("a mesh");
        assert!(!open.is_closed());
    }

    #[test]
    fn repeated_vertices_still_close_a_mesh() {
        let solid = cuboid(-Vec3::ONE, Vec3::ONE);
        let corners = solid.triangles().iter().flatten();
        let vertices: Vec<Vec3> = corners.map(|&corner| solid.vertices()[corner as usize]).collect();
        let triangles = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        assert!(TriangleMesh::new(vertices, triangles).expect("a mesh").is_closed());
    }

    #[test]
    fn a_sphere_with_ragged_poles_is_closed() {
        let (rings, sides) = (12, 24);
        let mut vertices = Vec::new();
        for ring in 0..=rings {
            for side in 0..sides {
                let (sin, cos) = libm::sincosf(core::f32::consts::PI * ring as f32 / rings as f32);
                let (z, x) = libm::sincosf(core::f32::consts::TAU * side as f32 / sides as f32);
                vertices.push(Vec3::new(sin * x, cos, sin * z) * 15.0 + Vec3::new(3.0, 30.0, 7.0));
            }
        }
        let at = |ring: u32, side: u32| ring * sides + side % sides;
        let triangles = (0..rings)
            .flat_map(|i| (0..sides).map(move |j| (i, j)))
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
                [[a, b, c], [c, b, d]]
            })
            .collect();
        let ball = TriangleMesh::new(vertices, triangles).expect("a mesh");
        assert!(ball.is_closed() && ball.contains(Vec3::new(3.0, 30.0, 7.0)));
        assert!(!ball.contains(Vec3::new(3.0, 45.1, 7.0)));
    }

    #[test]
    fn broken_meshes_are_named() {
        let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X * 2.0];
        let mesh = |triangles| TriangleMesh::new(corners.clone(), triangles);
        assert_eq!(mesh(vec![]), Err(ObstacleError::EmptyMesh));
        assert_eq!(mesh(vec![[0, 1, 3]]), Err(ObstacleError::EmptyMesh));
        assert_eq!(
            mesh(vec![[0, 1, 2], [0, 1, 9]]),
            Err(ObstacleError::NoSuchVertex { triangle: 1, index: 9, vertices: 4 })
        );
        let too_many = vec![[0, 1, 2]; MAX_TRIANGLES + 1];
        assert_eq!(mesh(too_many), Err(ObstacleError::TooManyTriangles(MAX_TRIANGLES + 1)));
        assert_eq!(mesh(vec![[0, 1, 2], [0, 1, 3]]).expect("one has an area").triangles().len(), 1);
        let mut broken = corners.clone();
        broken[2].y = f32::NAN;
        assert_eq!(
            TriangleMesh::new(broken, vec![[0, 1, 2]]),
            Err(ObstacleError::NotFinite("place of a vertex"))
        );
    }
}
