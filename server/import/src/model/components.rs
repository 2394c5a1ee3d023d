//! What of a mesh hangs together.

use glam::Vec3;

use super::Triangles;

/// The components of a mesh: vertices that triangles join, directly or by way of others.
pub(super) struct Components {
    /// The component of each vertex.
    pub(super) of: Vec<u32>,
    /// In the order of their first vertices.
    pub(super) all: Vec<Component>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Component {
    pub(super) vertices: u32,
    low: Vec3,
    high: Vec3,
}

impl Component {
    /// The middle of the box that holds it.
    pub(super) fn middle(&self) -> Vec3 {
        0.5 * self.low + 0.5 * self.high
    }

    /// The diagonal of that box.
    pub(super) fn extent(&self) -> f32 {
        self.low.distance(self.high)
    }
}

impl Components {
    pub(super) fn of(mesh: &Triangles) -> Self {
        let mut parents: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
        for &[a, b, c] in &mesh.corners {
            for (one, other) in [(a, b), (b, c)] {
                let (one, other) = (root(&mut parents, one), root(&mut parents, other));
                // The lesser one leads, so that roots are the first vertices.
                parents[one.max(other) as usize] = one.min(other);
            }
        }
        let mut all: Vec<Component> = Vec::new();
        let mut of = vec![0; parents.len()];
        for vertex in 0..parents.len() as u32 {
            let place = mesh.vertices[vertex as usize];
            let root = root(&mut parents, vertex);
            if root == vertex {
                of[vertex as usize] = all.len() as u32;
                all.push(Component { vertices: 0, low: place, high: place });
            }
            let number = of[root as usize];
            of[vertex as usize] = number;
            let component = &mut all[number as usize];
            component.vertices += 1;
            (component.low, component.high) = (component.low.min(place), component.high.max(place));
        }
        Self { of, all }
    }
}

/// The first vertex of the component of a vertex; the way there is shortened.
fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let above = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = above;
        vertex = above;
    }
    vertex
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_triangles_join_is_one() {
        let vertices = (0..8).map(|i| Vec3::X * i as f32).collect();
        let mesh = Triangles { vertices, corners: vec![[0, 6, 2], [3, 1, 4], [7, 5, 4]] };
        let Components { of, all } = Components::of(&mesh);
        assert_eq!(of, [0, 1, 0, 1, 1, 1, 0, 1]);
        assert_eq!(all.iter().map(|one| one.vertices).collect::<Vec<_>>(), [3, 5]);
        assert_eq!((all[1].middle(), all[1].extent()), (Vec3::X * 4.0, 6.0));
    }
}
