//! What the azimuth of the view changes, and what tables make of it.

use std::sync::Arc;

use super::{Anisotropy, truth};
use crate::approximate::Memo;
use crate::data::{Layout, Smith};
use crate::effects::BakeError;
use crate::effects::grid::grazing;
use crate::effects::table::{BakedTable, Judge, Lookup, Region, Way, WaysFinding, measure};
use crate::report::{ErrorFigure, Field, Ruler};

/// Where the maps are drawn: roughness, and the number of azimuths and cosines.
const ROUGHNESS: f64 = 0.7;
const MAP: [usize; 2] = [46, 40];

/// A finding for each shadowing form and region in which tables of an anisotropic lobe are laid out
/// in the scene's own roughness: a table is judged where it must hold, and not beside it.
pub fn findings(tables: &[BakedTable]) -> Result<Vec<WaysFinding>, BakeError> {
    let own = tables.iter().filter(|t| t.layout != Layout::PathTracer);
    let key = |baked: &&BakedTable| Some((baked.table()?.smith?, baked.region));
    let groups = lobefit_math::groups(own, key).into_iter().filter_map(|(key, group)| Some((key?, group)));
    groups.map(|((smith, region), group)| finding(smith, region, &group)).collect()
}

fn finding(smith: Smith, region: Region, own: &[&BakedTable]) -> Result<WaysFinding, BakeError> {
    let judge = match own.iter().find(|table| table.layout == Layout::Azimuth) {
        Some(table) => table.judge.clone(),
        None => Arc::new(Judge::new(&Anisotropy, smith, region, true, &Memo::default())?),
    };
    let span = region.slices()?.range;
    let roughness = ROUGHNESS.clamp(region.roughness[0], region.roughness[1]);
    let anisotropy = span[1];
    let rulers = rulers(&region);
    let map = truth::map(&region, roughness, anisotropy, [&rulers[0].values, &rulers[1].values]);
    let (e, ..) = truth::truths(smith, &map)?;
    let (mut fields, mut ways) = (Vec::new(), Vec::new());
    for baked in own {
        let Some(table) = baked.table() else { continue };
        let name = match baked.layout {
            Layout::Azimuth => "azimuth in the table",
            _ => "mean over the azimuth",
        };
        let errors = measure(table, baked.decode, &judge.points, judge.truth(0), 0.0)?;
        let lookup = Lookup::new(table, baked.decode)?;
        let values = map.all.iter().zip(&e);
        fields.push(Field {
            name: name.into(),
            unit: String::new(),
            signed: true,
            x: rulers[0].clone(),
            y: rulers[1].clone(),
            values: values.map(|(p, e)| (f64::from(lookup.at(p).e) - e) as f32).collect(),
        });
        let a = &baked.approximation;
        ways.push(Way {
            name: format!("{name}: {}", a.name),
            table: a.name.clone(),
            function: baked.names.lookup.clone(),
            resolved: baked.layout == Layout::Azimuth,
            error: ErrorFigure {
                max: errors.lookup.max,
                rms: Some(errors.lookup.rms),
                at: errors.lookup.at.clone(),
            },
            bytes: a.cost.bytes,
            ops: a.cost.ops,
        });
    }
    let at = format!("roughness {roughness}, anisotropy {anisotropy}");
    let ([r0, r1], [a0, a1]) = (region.roughness, span);
    let domain = format!("roughness {r0} to {r1}, anisotropy {a0} to {a1}");
    Ok(WaysFinding { domain, at, fields, ways })
}

/// Azimuth in degrees, and mu.
fn rulers(region: &Region) -> [Ruler; 2] {
    [Ruler::even("azimuth of the view, degrees", 0.0, 90.0, MAP[0]), grazing(&region.flat(), MAP[1])]
}
