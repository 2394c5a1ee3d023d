//! How much work a file may ask for. A few bytes of it can name the same large part again and again.

use super::{ImportError, Limits};

/// Numbers that may be read and triangles that may be placed for each triangle of the limit: three corners, as many
/// vertices, and room for parts that are read more than once.
const FOR_EACH: u64 = 16;

/// What a file may still ask for.
#[derive(Debug)]
pub(super) struct Budget {
    limits: Limits,
    left: u64,
}

impl Budget {
    pub(super) fn new(limits: &Limits) -> Self {
        // So many more make small limits practical.
        const LEAST: u64 = 10_000;
        Self { limits: *limits, left: LEAST + FOR_EACH * limits.most_triangles as u64 }
    }

    /// Takes so much work off the budget.
    pub(super) fn spend(&mut self, work: usize) -> Result<(), ImportError> {
        self.left = self.left.checked_sub(work as u64).ok_or_else(|| self.too_large())?;
        Ok(())
    }

    /// Allows so many vertices to be held.
    pub(super) fn check_vertices(&self, count: usize) -> Result<(), ImportError> {
        // No triangle has more than three.
        let most = self.limits.most_triangles.saturating_mul(3);
        if count > most { Err(self.too_large()) } else { Ok(()) }
    }

    /// Allows so many triangles to be held.
    pub(super) fn check_triangles(&self, count: usize) -> Result<(), ImportError> {
        if count > self.limits.most_triangles { Err(self.too_large()) } else { Ok(()) }
    }

    fn too_large(&self) -> ImportError {
        ImportError::TooLarge(self.limits)
    }
}
