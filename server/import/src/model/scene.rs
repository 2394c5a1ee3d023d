//! The triangles of a scene, where its nodes put them (glTF 2.0 specification, §3.5 and §3.7).

use glam::Vec3;

use super::{
    ImportError,
    accessor::{count, indices, vectors},
    budget::Budget,
    container::File,
    damaged,
    document::{Document, Node, Primitive},
    instances::{Instances, Transform},
    levels,
    weld::Gathered,
};

const TRIANGLES: u32 = 4;
const TRIANGLE_STRIP: u32 = 5;
const TRIANGLE_FAN: u32 = 6;
/// Nodes and primitives visited at most. A node may only have one parent; files that break this could double the visits
/// with each node.
const MAX_PARTS: usize = 300_000;

/// All triangles of the scene the file opens with; of all nodes if it has no scene.
pub(super) fn triangles(mut file: File<'_>, budget: &mut Budget) -> Result<Gathered, ImportError> {
    if let Some(node) = bears_itself(&file.document.nodes) {
        return Err(ImportError::Member {
            field: format!("nodes[{node}].children"),
            what: "leads back to the node itself".into(),
            allowed: "nodes that do not bear this one".into(),
        });
    }
    let has_levels = file.document.nodes.iter().any(|node| levels::level(&node.name) == Some(0));
    // Last in, first out: put in backwards, nodes come in the order of the file.
    let mut open: Vec<(usize, Transform)> =
        roots(&file.document)?.into_iter().rev().map(|node| (node, Transform::NONE)).collect();
    let (mut gathered, mut positions) = (Gathered::default(), Positions::default());
    let mut visited = 0;
    while let Some((number, parent)) = open.pop() {
        visited += 1;
        let nodes = &file.document.nodes;
        let node = nodes.get(number).ok_or_else(|| damaged(format!("there is no node {number}")))?;
        if has_levels && levels::level(&node.name).is_some_and(|level| level > 0) {
            continue;
        }
        let transform = parent.then(&Transform::of(node));
        open.extend(node.children.iter().rev().map(|&child| (child, transform)));
        if let Some(mesh) = node.mesh {
            let primitives = file.document.meshes.get(mesh).map(|mesh| mesh.primitives.len());
            let primitives = primitives.ok_or_else(|| damaged(format!("there is no mesh {mesh}")))?;
            visited += primitives;
            if visited > MAX_PARTS {
                return Err(too_many_parts());
            }
            let instances = Instances::of(&mut file, number, budget)?;
            for primitive in 0..primitives {
                let Some(part) =
                    Part::read(&mut file, [mesh, primitive], &mut positions, &instances, &gathered, budget)?
                else {
                    continue;
                };
                for instance in 0..instances.count() {
                    part.show(&transform.then(&instances.get(instance)), &mut gathered, budget)?;
                }
            }
        }
        if visited + open.len() > MAX_PARTS {
            return Err(too_many_parts());
        }
    }
    Ok(gathered)
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

fn roots(document: &Document) -> Result<Vec<usize>, ImportError> {
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

/// The positions that were read last: parts that follow each other often share them.
#[derive(Default)]
struct Positions {
    /// Their accessor.
    of: Option<usize>,
    places: Vec<Vec3>,
}

impl Positions {
    fn read(
        &mut self,
        file: &mut File<'_>,
        accessor: usize,
        budget: &mut Budget,
    ) -> Result<&[Vec3], ImportError> {
        if self.of != Some(accessor) {
            // Given back first, so that two are never held.
            *self = Self::default();
            self.places = vectors(file, accessor, budget)?.into_iter().map(Vec3::from).collect();
            self.of = Some(accessor);
        }
        Ok(&self.places)
    }
}

/// A primitive by itself: triangles, and the places that they name.
struct Part {
    places: Vec<Vec3>,
    corners: Vec<[u32; 3]>,
}

impl Part {
    /// Reads a primitive; points and lines are none.
    fn read(
        file: &mut File<'_>,
        [mesh, number]: [usize; 2],
        positions: &mut Positions,
        instances: &Instances,
        gathered: &Gathered,
        budget: &mut Budget,
    ) -> Result<Option<Self>, ImportError> {
        let Primitive { attributes, indices: numbers, mode } = &file.document.meshes[mesh].primitives[number];
        let (mode, numbers) = (mode.unwrap_or(TRIANGLES), *numbers);
        let Some(accessor) = attributes.position else { return Ok(None) };
        if !(TRIANGLES..=TRIANGLE_FAN).contains(&mode) {
            return Ok(None);
        }
        let named = count(&file.document, numbers.unwrap_or(accessor))?;
        let triangles = if mode == TRIANGLES { named / 3 } else { named.saturating_sub(2) };
        if triangles == 0 {
            return Ok(None);
        }
        // Before anything is read.
        gathered.check_room(triangles.saturating_mul(instances.count()), budget)?;
        let numbers = numbers.map(|numbers| indices(file, numbers, budget)).transpose()?;
        let positions = positions.read(file, accessor, budget)?;
        let corner = |corner: usize| -> Result<u32, ImportError> {
            let number = numbers.as_ref().map_or(corner, |numbers| numbers[corner] as usize);
            if number < positions.len() {
                return Ok(number as u32);
            }
            Err(damaged(format!("there is no vertex {number} of {}", positions.len())))
        };
        let mut corners = Vec::with_capacity(triangles);
        for i in 0..triangles {
            let [a, b, c] = match mode {
                TRIANGLES => [3 * i, 3 * i + 1, 3 * i + 2],
                TRIANGLE_STRIP => [i, i + 1 + i % 2, i + 2 - i % 2],
                _ => [0, i + 1, i + 2],
            };
            corners.push([corner(a)?, corner(b)?, corner(c)?]);
        }
        let places = only_used(positions, &mut corners);
        Ok(Some(Self { places, corners }))
    }

    /// Adds its triangles where a transform puts them.
    fn show(
        &self,
        transform: &Transform,
        gathered: &mut Gathered,
        budget: &mut Budget,
    ) -> Result<(), ImportError> {
        let first = gathered.vertices().len() as u32;
        // A node that mirrors turns its triangles inside out.
        let is_mirrored = transform.linear.determinant() < 0.0;
        for &place in &self.places {
            gathered.vertex(transform.place(place), budget)?;
        }
        for &corners in &self.corners {
            let [a, b, c] = corners.map(|corner| first + corner);
            gathered.triangle(if is_mirrored { [a, c, b] } else { [a, b, c] }, budget)?;
        }
        Ok(())
    }
}

/// The places that corners name, which are numbered anew.
fn only_used(places: &[Vec3], corners: &mut [[u32; 3]]) -> Vec<Vec3> {
    let mut used: Vec<u32> = corners.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    if used.len() == places.len() {
        return places.to_vec();
    }
    for corner in corners.iter_mut().flatten() {
        *corner = used.partition_point(|&other| other < *corner) as u32;
    }
    used.iter().map(|&number| places[number as usize]).collect()
}
