//! The triangles of a scene, where its nodes put them (glTF 2.0 specification, §3.5 and §3.7).

use std::collections::BTreeMap;

use glam::{Mat3, Vec3};

use crate::{
    ImportError, Limits, Triangles,
    accessor::{Indices, Positions},
    container::File,
    damaged,
    document::{Node, Primitive},
};

const TRIANGLES: u32 = 4;
const TRIANGLE_STRIP: u32 = 5;
const TRIANGLE_FAN: u32 = 6;
/// Nodes and primitives visited at most. A node may only have one parent; files that break this could double the visits
/// with each node.
const MAX_PARTS: usize = 300_000;

/// Where a node puts what it holds.
#[derive(Clone, Copy)]
struct Transform {
    linear: Mat3,
    offset: Vec3,
}

/// All triangles of the scene the file opens with; of all nodes if it has no scene.
pub(crate) fn triangles(file: &File<'_>, limits: Limits) -> Result<Triangles, ImportError> {
    let document = &file.document;
    if let Some(node) = bears_itself(&document.nodes) {
        return Err(ImportError::Member {
            field: format!("nodes[{node}].children"),
            what: "leads back to the node itself".into(),
            allowed: "nodes that do not bear this one".into(),
        });
    }
    let here = Transform { linear: Mat3::IDENTITY, offset: Vec3::ZERO };
    // Last in, first out: put in backwards, nodes come in the order of the file.
    let mut open: Vec<(usize, Transform)> = roots(file)?.into_iter().rev().map(|node| (node, here)).collect();
    let mut welded = Welded { limits, numbers: BTreeMap::new(), triangles: Triangles::default() };
    let mut visited = 0;
    while let Some((number, parent)) = open.pop() {
        visited += 1;
        let node = document.nodes.get(number).ok_or_else(|| damaged(format!("there is no node {number}")))?;
        let transform = parent.then(&Transform::of(node));
        if let Some(mesh) = node.mesh {
            let mesh =
                document.meshes.get(mesh).ok_or_else(|| damaged(format!("there is no mesh {mesh}")))?;
            visited += mesh.primitives.len();
            if visited > MAX_PARTS {
                return Err(too_many_parts());
            }
            for primitive in &mesh.primitives {
                welded.add(file, primitive, &transform)?;
            }
        }
        open.extend(node.children.iter().rev().map(|&child| (child, transform)));
        if visited + open.len() > MAX_PARTS {
            return Err(too_many_parts());
        }
    }
    Ok(welded.triangles)
}

/// A node that is borne by a node which it bears, directly or by way of others.
fn bears_itself(nodes: &[Node]) -> Option<usize> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        /// On the way from a root to the node that is looked at, with as many of its children done.
        Open(usize),
        Done,
    }
    let mut states = vec![State::New; nodes.len()];
    let mut way = Vec::new();
    for root in 0..nodes.len() {
        if states[root] == State::New {
            states[root] = State::Open(0);
            way.push(root);
        }
        while let Some(&node) = way.last() {
            let State::Open(done) = states[node] else { break };
            let Some(&child) = nodes[node].children.get(done) else {
                states[node] = State::Done;
                way.pop();
                continue;
            };
            states[node] = State::Open(done + 1);
            match states.get(child) {
                Some(State::Open(_)) => return Some(child),
                Some(State::New) => {
                    states[child] = State::Open(0);
                    way.push(child);
                }
                // A child that is not there is found where nodes are visited.
                Some(State::Done) | None => {}
            }
        }
    }
    None
}

fn too_many_parts() -> ImportError {
    damaged(format!("it has more than {MAX_PARTS} nodes and meshes"))
}

fn roots(file: &File<'_>) -> Result<Vec<usize>, ImportError> {
    let document = &file.document;
    if document.scenes.is_empty() {
        let mut is_child = vec![false; document.nodes.len()];
        for &child in document.nodes.iter().flat_map(|node| &node.children) {
            if let Some(is_child) = is_child.get_mut(child) {
                *is_child = true;
            }
        }
        return Ok((0..document.nodes.len()).filter(|&node| !is_child[node]).collect());
    }
    let number = document.scene.unwrap_or(0);
    let scene = document.scenes.get(number).ok_or_else(|| damaged(format!("there is no scene {number}")))?;
    Ok(scene.nodes.clone())
}

/// Triangles whose corners at one place are one vertex.
struct Welded {
    limits: Limits,
    /// The vertex at each place, by the bits of its coordinates.
    numbers: BTreeMap<[u32; 3], u32>,
    triangles: Triangles,
}

impl Welded {
    /// Adds the triangles of a primitive; points and lines have none.
    fn add(
        &mut self,
        file: &File<'_>,
        primitive: &Primitive,
        transform: &Transform,
    ) -> Result<(), ImportError> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        let Some(positions) = primitive.attributes.position else { return Ok(()) };
        if !(TRIANGLES..=TRIANGLE_FAN).contains(&mode) {
            return Ok(());
        }
        let positions = Positions::open(file, positions)?;
        let indices = primitive.indices.map(|indices| Indices::open(file, indices)).transpose()?;
        let corners = indices.as_ref().map_or(positions.count, |indices| indices.count);
        let count = if mode == TRIANGLES { corners / 3 } else { corners.saturating_sub(2) };
        // Before anything is read: until here, what a file says of itself has cost nothing.
        if count > self.limits.triangles - self.triangles.corners.len() {
            return Err(ImportError::TooLarge(self.limits));
        }
        let is_mirrored = transform.linear.determinant() < 0.0;
        for i in 0..count {
            let [a, mut b, mut c] = match mode {
                TRIANGLES => [3 * i, 3 * i + 1, 3 * i + 2],
                TRIANGLE_STRIP => [i, i + 1 + i % 2, i + 2 - i % 2],
                _ => [0, i + 1, i + 2],
            };
            // A node that mirrors turns its triangles inside out.
            if is_mirrored {
                (b, c) = (c, b);
            }
            let mut triangle = [0; 3];
            for (number, corner) in triangle.iter_mut().zip([a, b, c]) {
                let corner = indices.as_ref().map_or(Ok(corner), |indices| indices.get(corner))?;
                *number = self.vertex(transform.linear * positions.get(corner)? + transform.offset)?;
            }
            let [a, b, c] = triangle;
            if a != b && b != c && c != a {
                self.triangles.corners.push(triangle);
            }
        }
        Ok(())
    }

    /// The number of the vertex at a place.
    fn vertex(&mut self, place: Vec3) -> Result<u32, ImportError> {
        if !place.is_finite() {
            return Err(ImportError::NotFinite);
        }
        let vertices = &mut self.triangles.vertices;
        // Adding zero makes the negative zero a positive one.
        let place = place + Vec3::ZERO;
        let number = *self.numbers.entry(place.to_array().map(f32::to_bits)).or_insert(vertices.len() as u32);
        if number as usize == vertices.len() {
            if vertices.len() == self.limits.vertices {
                return Err(ImportError::TooLarge(self.limits));
            }
            vertices.push(place);
        }
        Ok(number)
    }
}

impl Transform {
    /// The transform of a node itself.
    fn of(node: &Node) -> Self {
        if let Some(m) = node.matrix {
            let column = |i: usize| Vec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
            return Self { linear: Mat3::from_cols(column(0), column(1), column(2)), offset: column(3) };
        }
        let scale = Vec3::from(node.scale.unwrap_or([1.0; 3]));
        let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let rotation = Mat3::from_cols(
            Vec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
            Vec3::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
            Vec3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)),
        );
        Self {
            linear: rotation * Mat3::from_diagonal(scale),
            offset: Vec3::from(node.translation.unwrap_or([0.0; 3])),
        }
    }

    /// The transform of a child.
    fn then(&self, child: &Self) -> Self {
        Self { linear: self.linear * child.linear, offset: self.linear * child.offset + self.offset }
    }
}
