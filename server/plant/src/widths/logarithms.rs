//! Natural logarithms of counts.

use std::sync::LazyLock;

/// Nearly all metamers carry fewer tips than this.
const TABLE_LEN: u32 = 4096;

/// Looks logarithms up.
pub(super) struct Logarithms(Vec<f32>);

impl Logarithms {
    pub(super) fn get() -> &'static Self {
        static TABLE: LazyLock<Logarithms> =
            LazyLock::new(|| Logarithms((0..TABLE_LEN).map(compute).collect()));
        &TABLE
    }

    /// ln of a count; of 0, which only the dead carry, as of 1.
    pub(super) fn of(&self, count: u32) -> f32 {
        self.0.get(count as usize).copied().unwrap_or_else(|| compute(count))
    }
}

fn compute(count: u32) -> f32 {
    libm::log(f64::from(count.max(1))) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_counts_continue_the_table() {
        let logs = Logarithms::get();
        assert_eq!([0, 1, TABLE_LEN - 1, TABLE_LEN, u32::MAX].map(|n| logs.of(n)), {
            [0.0, 0.0, 8.317_522, 8.317_766, 22.180_71]
        });
    }
}
