//! A symmetric system of 6 × 6 blocks, each coupled to the next: for each prism its shift, then its turn.

use glam::{DMat3, DVec3};

/// Of one prism: shift, turn.
pub(super) type Vector = [f64; 6];
type Block = [Vector; 6];

/// What is left of a number on the diagonal when no more than rounding is.
const SINGULAR: f64 = 1e-15;

/// Half the second derivatives, and half the gradient.
#[derive(Debug)]
pub(super) struct Tridiagonal {
    rows: Vec<Row>,
}

/// What couples one prism to itself and to the one before.
#[derive(Clone, Debug)]
struct Row {
    /// Lower triangle of the block on the diagonal.
    diagonal: Block,
    /// The block to the left of it.
    left: Block,
    gradient: Vector,
}

impl Tridiagonal {
    pub fn new(blocks: usize) -> Self {
        let row = Row { diagonal: [[0.0; 6]; 6], left: [[0.0; 6]; 6], gradient: [0.0; 6] };
        Self { rows: vec![row; blocks] }
    }

    pub fn gradients(&self) -> impl Iterator<Item = &Vector> {
        self.rows.iter().map(|row| &row.gradient)
    }

    pub fn add_gradient(&mut self, row: usize, weight: f64, shift: DVec3, turn: DVec3) {
        let gradient = &mut self.rows[row].gradient;
        for i in 0..3 {
            gradient[i] += weight * shift[i];
            gradient[3 + i] += weight * turn[i];
        }
    }

    /// weight·JᵀJ for J = (1, -[arm]×).
    pub fn add_square(&mut self, row: usize, weight: f64, arm: DVec3) {
        let block = &mut self.rows[row].diagonal;
        let cross = cross_matrix(weight * arm);
        let square = weight * arm.length_squared();
        for i in 0..3 {
            block[i][i] += weight;
            for j in 0..3 {
                block[3 + i][j] += cross[i][j];
            }
            for j in 0..=i {
                block[3 + i][3 + j] -= weight * arm[i] * arm[j];
            }
            block[3 + i][3 + i] += square;
        }
    }

    /// Resistance of an arm to turning across itself.
    pub fn add_tension(&mut self, row: usize, tension: f64, arm: DVec3) {
        let block = &mut self.rows[row].diagonal;
        let along = tension / arm.length_squared();
        for i in 0..3 {
            for j in 0..=i {
                block[3 + i][3 + j] -= along * arm[i] * arm[j];
            }
            block[3 + i][3 + i] += tension;
        }
    }

    /// weight·J₂ᵀJ₁, with J₁ of the prism before and J₂ of this one.
    pub fn add_product(&mut self, row: usize, weight: f64, arms: [DVec3; 2]) {
        let block = &mut self.rows[row].left;
        let [before, here] = arms;
        let (below, right) = (cross_matrix(weight * here), cross_matrix(weight * before));
        let product = weight * before.dot(here);
        for i in 0..3 {
            block[i][i] += weight;
            for j in 0..3 {
                block[3 + i][j] += below[i][j];
                block[i][3 + j] -= right[i][j];
                block[3 + i][3 + j] -= weight * before[i] * here[j];
            }
            block[3 + i][3 + i] += product;
        }
    }

    pub fn add_turn_square(&mut self, row: usize, weight: f64) {
        for i in 3..6 {
            self.rows[row].diagonal[i][i] += weight;
        }
    }

    pub fn add_turn_product(&mut self, row: usize, weight: f64, product: DMat3) {
        let block = &mut self.rows[row].left;
        for i in 0..3 {
            for j in 0..3 {
                block[3 + i][3 + j] += weight * product.col(j)[i];
            }
        }
    }

    /// Where the model is least. None if rounding has made the system singular.
    pub fn solve(&self) -> Option<Vec<Vector>> {
        let mut factors: Vec<Factor> = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let factor = row.factor(factors.last())?;
            factors.push(factor);
        }
        // What the prism above does; the last one has none.
        let mut above: Option<Vector> = None;
        let mut solution = vec![[0.0; 6]; factors.len()];
        for at in (0..factors.len()).rev() {
            let mut rhs = factors[at].rhs;
            if let Some(above) = above {
                let left = &factors[at + 1].left;
                for i in 0..6 {
                    for (k, row) in left.iter().enumerate() {
                        rhs[i] -= row[i] * above[k];
                    }
                }
            }
            let lower = &factors[at].lower;
            for i in (0..6).rev() {
                for k in i + 1..6 {
                    rhs[i] -= lower[k][i] * rhs[k];
                }
                rhs[i] *= lower[i][i];
            }
            solution[at] = rhs;
            above = Some(rhs);
        }
        Some(solution)
    }
}

/// A block row of Cholesky's factor.
struct Factor {
    left: Block,
    /// Lower triangle, with the reciprocals of its diagonal.
    lower: Block,
    rhs: Vector,
}

impl Row {
    fn factor(&self, before: Option<&Factor>) -> Option<Factor> {
        let (mut lower, mut left) = (self.diagonal, self.left);
        let mut rhs = self.gradient.map(|number| -number);
        if let Some(before) = before {
            for row in &mut left {
                forward(&before.lower, row);
            }
            for i in 0..6 {
                for j in 0..=i {
                    lower[i][j] -= dot(&left[i], &left[j]);
                }
                rhs[i] -= dot(&left[i], &before.rhs);
            }
        }
        for i in 0..6 {
            for j in 0..i {
                lower[i][j] = (lower[i][j] - dot(&lower[i][..j], &lower[j][..j])) * lower[j][j];
            }
            let square = lower[i][i] - dot(&lower[i][..i], &lower[i][..i]);
            if square.is_nan() || square <= SINGULAR * self.diagonal[i][i] {
                return None;
            }
            lower[i][i] = 1.0 / square.sqrt();
        }
        forward(&lower, &mut rhs);
        Some(Factor { left, lower, rhs })
    }
}

/// Solves L·x = b in place.
fn forward(lower: &Block, b: &mut Vector) {
    for i in 0..6 {
        b[i] = (b[i] - dot(&lower[i][..i], &b[..i])) * lower[i][i];
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}

/// The matrix that multiplies by `v` ×.
fn cross_matrix(v: DVec3) -> [[f64; 3]; 3] {
    [[0.0, -v.z, v.y], [v.z, 0.0, -v.x], [-v.y, v.x, 0.0]]
}
