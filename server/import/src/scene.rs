//! The triangles of a scene, where its nodes put them (glTF 2.0 specification, §3.5 and §3.7).

use espalier_growth::{MAX_TRIANGLES, ObstacleError};
use glam::{Mat3, Vec3};

use crate::{
    ImportError, accessor,
    container::File,
    damaged,
    document::{Node, Primitive},
};

const TRIANGLES: u32 = 4;
const TRIANGLE_STRIP: u32 = 5;
const TRIANGLE_FAN: u32 = 6;
/// Nodes and primitives visited at most. A node may only have one parent; files that break this could go on for
/// ever.
const MAX_PARTS: usize = 300_000;
/// Vertices of all meshes together at most, those included that no triangle uses.
const MAX_VERTICES: usize = 3 * MAX_TRIANGLES;

/// Vertices, and corners of triangles.
type Triangles = (Vec<Vec3>, Vec<[u32; 3]>);

/// Where a node puts what it holds.
#[derive(Clone, Copy)]
struct Pose {
    linear: Mat3,
    offset: Vec3,
}

/// All triangles of the scene the file opens with; of all nodes if it has no scene.
pub(crate) fn triangles(file: &File<'_>) -> Result<Triangles, ImportError> {
    let document = &file.document;
    let here = Pose { linear: Mat3::IDENTITY, offset: Vec3::ZERO };
    // Last in, first out: put in backwards, nodes come in the order of the file.
    let mut open: Vec<(usize, Pose)> = roots(file)?.into_iter().rev().map(|node| (node, here)).collect();
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    let mut visited = 0;
    while let Some((number, parent)) = open.pop() {
        visited += 1;
        let node = document.nodes.get(number).ok_or_else(|| damaged(format!("there is no node {number}")))?;
        let pose = parent.then(&Pose::of(node));
        if let Some(mesh) = node.mesh {
            let mesh =
                document.meshes.get(mesh).ok_or_else(|| damaged(format!("there is no mesh {mesh}")))?;
            visited += mesh.primitives.len();
            if visited > MAX_PARTS {
                return Err(too_many_parts());
            }
            for primitive in &mesh.primitives {
                add(file, primitive, &pose, &mut vertices, &mut triangles)?;
            }
        }
        open.extend(node.children.iter().rev().map(|&child| (child, pose)));
        if visited + open.len() > MAX_PARTS {
            return Err(too_many_parts());
        }
    }
    Ok((vertices, triangles))
}

fn too_many_parts() -> ImportError {
    damaged(format!("it has more than {MAX_PARTS} nodes and meshes, or nodes that bear each other"))
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

/// Adds the triangles of a primitive; points and lines have none.
fn add(
    file: &File<'_>,
    primitive: &Primitive,
    pose: &Pose,
    vertices: &mut Vec<Vec3>,
    triangles: &mut Vec<[u32; 3]>,
) -> Result<(), ImportError> {
    let mode = primitive.mode.unwrap_or(TRIANGLES);
    let Some(positions) = primitive.attributes.position else { return Ok(()) };
    if !(TRIANGLES..=TRIANGLE_FAN).contains(&mode) {
        return Ok(());
    }
    let positions = accessor::positions(file, positions)?;
    let corners = match primitive.indices {
        Some(indices) => accessor::indices(file, indices)?,
        None => (0..positions.len() as u32).collect(),
    };
    if let Some(&corner) = corners.iter().find(|&&corner| corner as usize >= positions.len()) {
        return Err(damaged(format!("an index names vertex {corner} of {}", positions.len())));
    }
    let count = match mode {
        TRIANGLES => corners.len() / 3,
        _ => corners.len().saturating_sub(2),
    };
    if triangles.len() + count > MAX_TRIANGLES {
        return Err(ObstacleError::TooManyTriangles(triangles.len() + count).into());
    }
    if vertices.len() + positions.len() > MAX_VERTICES {
        return Err(damaged(format!("it has more than {MAX_VERTICES} vertices")));
    }
    let first = vertices.len() as u32;
    vertices.extend(positions.into_iter().map(|place| pose.linear * place + pose.offset));
    let corner = |i: usize| first + corners[i];
    triangles.extend((0..count).map(|i| match mode {
        TRIANGLES => [corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)],
        TRIANGLE_STRIP => [corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)],
        _ => [corner(0), corner(i + 1), corner(i + 2)],
    }));
    Ok(())
}

impl Pose {
    /// A node's own pose.
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

    /// The pose of a child.
    fn then(&self, child: &Self) -> Self {
        Self { linear: self.linear * child.linear, offset: self.linear * child.offset + self.offset }
    }
}
