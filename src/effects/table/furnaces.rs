//! Spheres under every condition: what each layout gives, and what the path tracer's reading of its
//! own gives.

use super::findings::{roughness_text, shown_slices};
use super::grid::Grid;
use super::results::FurnaceFinding;
use super::{BakedTable, Lookup, Sliced};
use crate::approximate;
use crate::data::{Axis, Layout, Registration, Table, Warp};
use crate::effects::BakeError;
use crate::effects::grid::{self, chosen, grazing};
use crate::report::{Furnace, FurnaceRow};
use lobefit_truth::integrate::glass::Side;

/// How often the furnace's departure from white is amplified.
const AMPLIFICATION: f64 = 20.0;

/// Roughness of the furnace's spheres, and cosines of each.
const SPHERES: [f64; 7] = [0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0];
const COSINES: usize = 64;

/// Fewest spheres of a picture that several tables share.
const SHARED: usize = 3;

/// Tables of one side that hold the same roughnesses, at one slice.
struct Group<'a> {
    /// Roughness that all of them hold.
    roughness: [f64; 2],
    tables: Vec<&'a BakedTable>,
}

/// A picture for each slice, each side, and each group of tables that hold them: no lookup is drawn
/// where its table would be clamped.
pub fn findings<F: Sliced>(family: &F, tables: &[BakedTable]) -> Result<Vec<FurnaceFinding>, BakeError> {
    // With the azimuth in the table there is no mean to compensate by.
    let means = || tables.iter().filter(|t| !t.layout.has_azimuth());
    let mut values: Vec<f64> = means().flat_map(|t| shown_slices(family, &t.region)).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let mut found = Vec::new();
    for slice in values {
        for &side in family.sides() {
            let inside = |[low, high]: [f64; 2]| (low..=high).contains(&slice);
            let holds = |t: &&BakedTable| {
                t.side == side && t.region.slices.is_some_and(|slices| inside(slices.range))
            };
            let groups = groups(means().filter(holds));
            for group in &groups {
                found.push(furnace(family, group, (slice, side), groups.len() > 1)?);
            }
        }
    }
    Ok(found)
}

/// Each table in the first group whose spheres it shares.
fn groups<'a>(tables: impl Iterator<Item = &'a BakedTable>) -> Vec<Group<'a>> {
    let mut groups: Vec<Group> = Vec::new();
    for table in tables {
        let [low, high] = table.region.roughness;
        let common = |g: &Group| [low.max(g.roughness[0]), high.min(g.roughness[1])];
        let shares = |g: &Group| g.roughness == [low, high] || inside(common(g)).len() >= SHARED;
        match groups.iter_mut().find(|group| shares(group)) {
            Some(group) => {
                group.roughness = common(group);
                group.tables.push(table);
            }
            None => groups.push(Group { roughness: [low, high], tables: vec![table] }),
        }
    }
    groups
}

fn furnace<F: Sliced>(
    family: &F,
    group: &Group,
    (slice, side): (f64, Option<Side>),
    told_apart: bool,
) -> Result<FurnaceFinding, BakeError> {
    let first = group.tables.first().ok_or_else(|| BakeError::Internal("a furnace without tables".into()))?;
    let flat = approximate::Region { roughness: group.roughness, ..first.region.flat() };
    let over = grid::Grid::new(&flat, chosen(&flat, &SPHERES), grazing(&flat, COSINES));
    let mut rows: Vec<FurnaceRow> = Vec::new();
    for baked in &group.tables {
        let Some(table) = baked.table() else { continue };
        let (Some(smith), region) = (table.smith, &baked.region) else { continue };
        let grids = Grid::all(family, (smith, region), &over, &[slice])?;
        let (grid, alpha) = (&grids[0], region.alpha_map.name());
        let uncompensated = format!("uncompensated ({} Smith, alpha = {alpha})", smith.name());
        if rows.iter().all(|row| row.name != uncompensated) {
            rows.push(FurnaceRow { name: uncompensated, of: String::new(), factors: grid.furnace(side) });
        }
        let compensated = |name: String, lookup: &Lookup| FurnaceRow {
            name,
            of: String::new(),
            factors: grid.compensated(lookup, side),
        };
        let name = called(group, baked);
        let own = compensated(name.clone(), &Lookup::new(table, baked.decode)?);
        rows.push(FurnaceRow { of: baked.approximation.name.clone(), ..own });
        if baked.layout == Layout::PathTracer {
            let misread = misread(table, family.layer(slice));
            rows.push(compensated(
                format!("{name}, as the path tracer reads it"),
                &Lookup::new(&misread, baked.decode)?,
            ));
        }
    }
    let range = if told_apart { roughness_text(group.roughness) } else { String::new() };
    let title = family.title(slice, side) + &range;
    let furnace =
        Furnace { roughness: over.roughness.values, mu: over.mu.values, rows, amplification: AMPLIFICATION };
    Ok(FurnaceFinding { title, furnace })
}

/// The layout, or where another table of the group has the same one, the table's name.
fn called(group: &Group, baked: &BakedTable) -> String {
    match group.tables.iter().filter(|t| t.layout == baked.layout).count() {
        1 => format!("{} layout", baked.layout.name()),
        _ => baked.approximation.name.clone(),
    }
}

/// The roughnesses of the spheres that lie in a range.
fn inside([low, high]: [f64; 2]) -> Vec<f64> {
    SPHERES.into_iter().filter(|r| (low..=high).contains(r)).collect()
}

/// The table as the path tracer's shader sees it at one slice: mu (its root for glass) and
/// roughness as texture coordinates, which a texture unit takes for texel centres; the slice
/// rounded to the nearest layer, not interpolated.
///
/// The result has two equal slices, so that a trilinear lookup returns that layer.
fn misread(table: &Table, place: f64) -> Table {
    let [columns, rows, slices] = table.size();
    let layer = ((place * slices as f64).round() as usize).min(slices - 1);
    let mut read = table.clone();
    for channel in &mut read.channels {
        let plane = &channel.texels[layer * columns * rows..(layer + 1) * columns * rows];
        channel.texels = [plane, plane].concat();
    }
    let centred =
        |axis: &Axis| Axis { registration: Registration::Centre, min: 0.0, max: 1.0, ..axis.clone() };
    let slices = Axis { size: 2, warp: Warp::Linear, min: 0.0, max: 4.0, ..centred(&table.axes[2]) };
    read.axes = vec![centred(&table.axes[0]), centred(&table.axes[1]), slices];
    read
}
