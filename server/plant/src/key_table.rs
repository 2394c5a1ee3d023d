//! A table from keys that are hashes already to their places in a list.

/// Where a key stands, in a table of twice as many places as keys or more: from the place that its bits say onwards.
#[derive(Clone, Debug, Default)]
pub struct KeyTable {
    slots: Vec<(u64, u32)>,
}

/// No key stands here.
const FREE: u32 = u32::MAX;

impl KeyTable {
    /// A table of keys, fewer than 2³¹. Of equal ones the first counts.
    pub fn new(keys: impl ExactSizeIterator<Item = u64>) -> Self {
        let size = (keys.len() * 2).next_power_of_two().max(2);
        let mut table = Self { slots: vec![(0, FREE); size] };
        for (number, key) in (0..).zip(keys) {
            let slot = table.slot(key);
            if table.slots[slot].1 == FREE {
                table.slots[slot] = (key, number);
            }
        }
        table
    }

    /// The place of a key in the list.
    pub fn get(&self, key: u64) -> Option<usize> {
        if self.slots.is_empty() {
            return None;
        }
        let (_, number) = self.slots[self.slot(key)];
        (number != FREE).then_some(number as usize)
    }

    /// Where a key stands, or would.
    fn slot(&self, key: u64) -> usize {
        let mask = self.slots.len() - 1;
        let mut at = key as usize & mask;
        while self.slots[at].1 != FREE && self.slots[at].0 != key {
            at = (at + 1) & mask;
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_found_where_the_list_has_them_first() {
        // Those that want the same place stand behind each other, also around the end.
        let keys = [7, 15, 23, 7, 0, u64::MAX, 31, 8];
        let table = KeyTable::new(keys.into_iter());
        for key in keys {
            assert_eq!(table.get(key), keys.iter().position(|&other| other == key));
        }
        assert_eq!((table.get(39), table.get(1)), (None, None));
        assert_eq!(KeyTable::new([].into_iter()).get(0), None);
        assert_eq!(KeyTable::default().get(0), None);
    }
}
