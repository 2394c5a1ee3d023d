//! Where a node shows its mesh: once, or many times (`EXT_mesh_gpu_instancing`).

use glam::{Mat3, Vec3};

use super::{
    ImportError,
    accessor::{count, vectors},
    budget::Budget,
    container::File,
    damaged,
    document::{InstanceAttributes, Node},
};

/// Where a node puts what it holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transform {
    pub(super) linear: Mat3,
    offset: Vec3,
}

impl Transform {
    pub(super) const NONE: Self = Self { linear: Mat3::IDENTITY, offset: Vec3::ZERO };

    /// The transform of a node itself.
    pub(super) fn of(node: &Node) -> Self {
        if let Some(m) = node.matrix {
            let column = |i: usize| Vec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
            return Self { linear: Mat3::from_cols(column(0), column(1), column(2)), offset: column(3) };
        }
        Self::made_of(node.translation, node.rotation, node.scale)
    }

    fn made_of(translation: Option<[f32; 3]>, rotation: Option<[f32; 4]>, scale: Option<[f32; 3]>) -> Self {
        let scale = Vec3::from(scale.unwrap_or([1.0; 3]));
        let [x, y, z, w] = rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let rotation = Mat3::from_cols(
            Vec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
            Vec3::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
            Vec3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)),
        );
        Self {
            linear: rotation * Mat3::from_diagonal(scale),
            offset: Vec3::from(translation.unwrap_or([0.0; 3])),
        }
    }

    /// The transform of a child.
    pub(super) fn then(&self, child: &Self) -> Self {
        Self { linear: self.linear * child.linear, offset: self.place(child.offset) }
    }

    /// Where it puts a place.
    pub(super) fn place(&self, place: Vec3) -> Vec3 {
        self.linear * place + self.offset
    }
}

/// Where a node shows its mesh, below its own transform.
pub(super) enum Instances {
    Once,
    Many {
        count: usize,
        translations: Option<Vec<[f32; 3]>>,
        rotations: Option<Vec<[f32; 4]>>,
        scales: Option<Vec<[f32; 3]>>,
    },
}

impl Instances {
    /// The instances of a node.
    pub(super) fn of(file: &mut File<'_>, node: usize, budget: &mut Budget) -> Result<Self, ImportError> {
        let Some(instancing) = file.document.nodes.get(node).and_then(Node::instancing) else {
            return Ok(Self::Once);
        };
        let &InstanceAttributes { translation, rotation, scale } = &instancing.attributes;
        let mut all = None;
        for accessor in [translation, rotation, scale].into_iter().flatten() {
            let count = count(&file.document, accessor)?;
            if all.is_some_and(|all| all != count) {
                return Err(damaged(format!("node {node} has instances without a place, a turn or a size")));
            }
            all = Some(count);
        }
        let Some(count) = all else { return Ok(Self::Once) };
        // Each shows a triangle at least.
        budget.check_triangles(count)?;
        let translations = translation.map(|number| vectors(file, number, budget)).transpose()?;
        let rotations = rotation.map(|number| vectors(file, number, budget)).transpose()?;
        let scales = scale.map(|number| vectors(file, number, budget)).transpose()?;
        Ok(Self::Many { count, translations, rotations, scales })
    }

    pub(super) fn count(&self) -> usize {
        match self {
            Self::Once => 1,
            Self::Many { count, .. } => *count,
        }
    }

    /// The transform of one of them.
    pub(super) fn get(&self, number: usize) -> Transform {
        match self {
            Self::Once => Transform::NONE,
            Self::Many { translations, rotations, scales, .. } => Transform::made_of(
                translations.as_ref().and_then(|all| all.get(number)).copied(),
                rotations.as_ref().and_then(|all| all.get(number)).copied(),
                scales.as_ref().and_then(|all| all.get(number)).copied(),
            ),
        }
    }
}
