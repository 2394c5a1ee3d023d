//! The table as it is defined: every row is made afresh and compared with the one that changes were sent of.

use espalier_mesh::{
    Changes, RingTable, Style, foliage,
    radius_code::{NOT_DRAWN, encode_log},
    ring_table::CHUNK_ROWS,
};
use espalier_plant::{MetamerId, Plant, Widths};

use crate::mirror::{Row, all_rows};

#[derive(Debug, Default)]
pub struct PlainTable {
    rows: Vec<Row>,
    generations: Vec<u32>,
}

impl PlainTable {
    pub fn sync(&mut self, plant: &Plant, style: &Style, generation: u32) -> Changes {
        let count = plant.metamer_count();
        let widths = Widths::of(plant, style.girth());
        let make = |id, held| row(plant, id, style, &widths, held);
        let mut changes = Changes::default();
        let mut sent = std::mem::take(&mut self.rows);
        for index in 0..count {
            let held = sent.get(index).copied();
            let row = make(MetamerId::new(index), held);
            let stays = |row: &Row| (row.parent, row.starts_axis, row.born);
            let same = held.filter(|held| stays(held) == stays(&row));
            if let Some(held) = same {
                let place = index as u32;
                if held.position != row.position {
                    changes.position.push(place);
                }
                if held.radius != row.radius {
                    changes.radius.push(place);
                    changes.former_radius.push(held.radius);
                }
                if held.foliage != row.foliage {
                    changes.foliage.push(place);
                    changes.former_foliage.push(held.foliage);
                }
                if held.light != row.light {
                    changes.light.push(place);
                    changes.former_light.push(held.light);
                }
                if held != row {
                    self.generations[index / CHUNK_ROWS] = generation;
                }
                self.rows.push(row);
                continue;
            }
            self.drop_from(index, &mut sent, generation, &mut changes);
            self.generations.truncate(index / CHUNK_ROWS);
            self.generations.push(generation);
            self.rows.push(make(MetamerId::new(index), None));
        }
        self.drop_from(count, &mut sent, generation, &mut changes);
        changes.appended = changes.appended.start.max(sent.len() as u32)..count as u32;
        changes
    }

    /// Nothing that was sent from this row on holds any more.
    fn drop_from(&mut self, kept: usize, sent: &mut Vec<Row>, generation: u32, changes: &mut Changes) {
        if sent.len() > kept {
            sent.truncate(kept);
            changes.truncated = Some(kept as u32);
            self.generations.truncate(kept.div_ceil(CHUNK_ROWS));
            if !kept.is_multiple_of(CHUNK_ROWS) {
                self.generations[kept / CHUNK_ROWS] = generation;
            }
        }
    }

    pub fn equals(&self, table: &RingTable) -> bool {
        let leaves: u32 = self.rows.iter().map(|row| u32::from(row.foliage & 0xf)).sum();
        (&self.rows[..], &self.generations[..], leaves)
            == (&all_rows(table)[..], table.generations(), table.leaves())
    }
}

fn row(plant: &Plant, id: MetamerId, style: &Style, widths: &Widths<'_>, held: Option<Row>) -> Row {
    let metamers = plant.metamers();
    let parent = metamers.parent(id);
    let is_drawn = parent.is_some() && plant.is_alive(id);
    let look = metamers.condition(id);
    // In 32 levels from 0 to 255, and in 8 from 0 to 15.
    let (light, vigor) = (look.light / 8, look.vigor / 32);
    let (mut light, mut vigor) = (light * 8 + light / 4, vigor * 2 + vigor / 4);
    if let Some(held) = held.filter(|_| !is_drawn) {
        (light, vigor) = (held.light, held.foliage >> 4);
    }
    Row {
        parent: parent.map(MetamerId::raw),
        starts_axis: parent
            .is_some_and(|below| plant.is_seed(below) || metamers.axis(below) != metamers.axis(id)),
        position: metamers.end(id).to_array().map(|length| (length * 256.0).round() as i32),
        radius: match widths.log_radius(id) {
            _ if !is_drawn => NOT_DRAWN,
            Some(log) => encode_log(log),
            None => style.radius_code(metamers.tips(id)),
        },
        foliage: vigor << 4 | foliage::leaves(plant, id, style),
        light,
        born: plant.age(MetamerId::new(0)) - plant.age(id),
    }
}
