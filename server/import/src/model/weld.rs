//! Triangles as they are gathered, and corners at one place made one vertex.

use glam::Vec3;

use super::{ImportError, Triangles, budget::Budget};

/// Triangles as they come, vertices perhaps repeated and perhaps not used.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    vertices: Vec<Vec3>,
    corners: Vec<[u32; 3]>,
}

impl Gathered {
    /// Adds a place, and gives its number.
    pub(super) fn vertex(&mut self, place: Vec3, budget: &Budget) -> Result<u32, ImportError> {
        if !place.is_finite() {
            return Err(ImportError::NotFinite);
        }
        budget.check_vertices(self.vertices.len() + 1)?;
        // Adding zero makes the negative zero a positive one.
        self.vertices.push(place + Vec3::ZERO);
        Ok((self.vertices.len() - 1) as u32)
    }

    /// Adds a triangle of vertices that are there.
    pub(super) fn triangle(&mut self, corners: [u32; 3], budget: &mut Budget) -> Result<(), ImportError> {
        budget.check_triangles(self.corners.len() + 1)?;
        budget.spend(1)?;
        self.corners.push(corners);
        Ok(())
    }

    /// Allows so many triangles more, before anything of them is read.
    pub(super) fn check_room(&self, more: usize, budget: &Budget) -> Result<(), ImportError> {
        budget.check_triangles(self.corners.len().saturating_add(more))
    }

    pub(super) fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Corners at one place become one vertex, in the order in which triangles name them; triangles that have one place
    /// twice go.
    pub(super) fn weld(self) -> Triangles {
        let Self { vertices: places, mut corners } = self;
        let first = first_at_each_place(&places);
        const NONE: u32 = u32::MAX;
        let mut numbers = vec![NONE; places.len()];
        let mut vertices = Vec::new();
        for corner in corners.iter_mut() {
            *corner = corner.map(|corner| first[corner as usize]);
        }
        corners.retain(|&[a, b, c]| a != b && b != c && c != a);
        for corner in corners.iter_mut().flatten() {
            let number = &mut numbers[*corner as usize];
            if *number == NONE {
                *number = vertices.len() as u32;
                vertices.push(places[*corner as usize]);
            }
            *corner = *number;
        }
        Triangles { vertices, corners }
    }
}

/// The first vertex at the place of each. By sorting, for no file can make that slow, as it could a table.
fn first_at_each_place(places: &[Vec3]) -> Vec<u32> {
    let bits = |number: u32| places[number as usize].to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..places.len() as u32).collect();
    order.sort_unstable_by_key(|&number| (bits(number), number));
    let mut first = vec![0; places.len()];
    for same in order.chunk_by(|&a, &b| bits(a) == bits(b)) {
        same.iter().for_each(|&number| first[number as usize] = same[0]);
    }
    first
}
