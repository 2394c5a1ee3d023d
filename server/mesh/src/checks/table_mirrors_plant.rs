//! Every metamer of the present has its row, and the row says what the metamer is, as exactly as it can.

use espalier_plant::{MetamerId, Plant, Widths};
use glam::Vec3;

use super::{Failure, require};
use crate::{
    foliage, radius_code,
    ring_table::{self, CHUNK_ROWS, POSITION_STEPS, RingTable},
    style::Style,
};

const CHECK: &str = "table_mirrors_plant";

pub(super) fn check(table: &RingTable, plant: &Plant, style: &Style) -> Result<(), Failure> {
    let rows = table.rows();
    require(CHECK, rows == plant.metamer_count(), || {
        format!("{rows} rows for {} metamers", plant.metamer_count())
    })?;
    require(CHECK, table.generations().len() == rows.div_ceil(CHUNK_ROWS), || {
        format!("{} chunks for {rows} rows", table.generations().len())
    })?;
    let widths = Widths::of(plant, style.girth());
    // The seed has lived through all steps of growth.
    let grown = plant.age(MetamerId::new(0));
    let mut leaves = 0;
    for index in 0..rows {
        let id = MetamerId::new(index);
        check_row(table, &widths, plant, style, id)?;
        require(CHECK, table.born(index as u32) + plant.age(id) == grown, || {
            format!("row {index} was born at another time")
        })?;
        leaves += u32::from(foliage::leaves(plant, id, style));
    }
    require(CHECK, leaves == table.leaves(), || {
        format!("{leaves} leaves, but {} are counted", table.leaves())
    })
}

fn check_row(
    table: &RingTable,
    widths: &Widths<'_>,
    plant: &Plant,
    style: &Style,
    id: MetamerId,
) -> Result<(), Failure> {
    let (row, metamers) = (id.raw(), plant.metamers());
    let parent = metamers.parent(id);
    require(CHECK, table.parent(row) == parent.map(MetamerId::raw), || {
        format!("row {row} has another parent")
    })?;
    let begins = parent.is_some_and(|p| plant.is_seed(p) || metamers.axis(p) != metamers.axis(id));
    require(CHECK, table.starts_axis(row) == begins, || format!("row {row} is elsewhere on its axis"))?;

    let position = Vec3::from_array(table.position(row).map(|steps| steps as f32 / POSITION_STEPS));
    let astray = (position - metamers.end(id)).abs().max_element();
    // Half a step, and what rounding adds far from the origin.
    require(CHECK, astray <= 0.501 / POSITION_STEPS, || format!("row {row} is {astray} astray"))?;

    let drawn = plant.is_alive(id) && !plant.is_seed(id);
    let radius = radius_code::decode(table.radius(row));
    let wanted = if drawn { widths.radius(id) } else { 0.0 };
    let fits = (radius - wanted).abs() <= 0.0051 * wanted.max(radius_code::MIN_RADIUS);
    require(CHECK, fits && (radius > 0.0) == drawn, || {
        format!("row {row} has radius {radius}, not {wanted}")
    })?;

    let leaves = foliage::leaves(plant, id, style);
    require(CHECK, table.foliage(row) & 0xf == leaves, || {
        format!("row {row} bears other than {leaves} leaves")
    })?;
    let look = ring_table::seen(metamers.condition(id));
    let is_same = (table.light(row), table.foliage(row) & 0xf0) == (look.light, look.vigor);
    require(CHECK, !drawn || is_same, || format!("row {row} looks otherwise"))
}

#[cfg(test)]
mod tests {
    use espalier_plant::Plant;

    use crate::{RingTable, Style, checks};

    #[test]
    fn synced_table_passes() {
        let (mut table, plant, style) = (RingTable::new(), Plant::new(glam::Vec3::ZERO), Style::default());
        table.sync(&plant, &style, 1);
        assert_eq!(checks::table(&table, &plant, &style), Ok(()));
    }

    #[test]
    fn stale_table_fails() {
        let (mut table, mut plant, style) =
            (RingTable::new(), Plant::new(glam::Vec3::ZERO), Style::default());
        table.sync(&plant, &style, 1);
        plant.begin_step();
        plant.sow(glam::Vec3::X);
        plant.end_step();
        assert_eq!(checks::table(&table, &plant, &style).map_err(|f| f.check), Err("table_mirrors_plant"));
    }
}
