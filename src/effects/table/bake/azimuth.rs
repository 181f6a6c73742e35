//! What the azimuth of the view changes, and what tables make of it.

use super::BakedVolume;
use super::tables::Judge;
use crate::data::{Layout, Smith};
use crate::effects::BakeError;
use crate::effects::anisotropy;
use crate::effects::table::results::{AzimuthFinding, AzimuthWay};
use crate::effects::table::{Lookup, Region, measure};
use crate::report::{ErrorFigure, Field, Ruler};

/// Where the maps are drawn: roughness, and the number of azimuths and cosines.
const ROUGHNESS: f64 = 0.7;
const MAP: [usize; 2] = [46, 40];

/// A finding for each shadowing form and region in which tables of an anisotropic lobe are laid out in the scene's own roughness: a
/// table is judged where it must hold, and not beside it.
pub fn findings(tables: &[BakedVolume], judges: &[Judge]) -> Result<Vec<AzimuthFinding>, BakeError> {
    let own: Vec<&BakedVolume> =
        tables.iter().filter(|t| t.side.is_none() && t.layout != Layout::PathTracer).collect();
    let key = |t: &BakedVolume| (t.smith, t.region);
    let mut keys: Vec<(Smith, Region)> = Vec::new();
    for table in &own {
        if !keys.contains(&key(table)) {
            keys.push(key(table));
        }
    }
    let of = |wanted: (Smith, Region)| own.iter().copied().filter(move |t| key(t) == wanted);
    keys.into_iter().map(|(smith, region)| finding(smith, region, of((smith, region)), judges)).collect()
}

fn finding<'a>(
    smith: Smith,
    region: Region,
    own: impl Iterator<Item = &'a BakedVolume>,
    judges: &[Judge],
) -> Result<AzimuthFinding, BakeError> {
    let made;
    let judge = match judges.iter().find(|judge| judge.has_azimuths(smith, &region)) {
        Some(known) => known,
        None => {
            made = Judge::new(smith, &region, true)?;
            &made
        }
    };
    let roughness = ROUGHNESS.clamp(region.roughness[0], region.roughness[1]);
    let anisotropy = region.slices.range[1];
    let rulers = rulers(&region);
    let map = anisotropy::azimuth_map(
        smith,
        &region,
        roughness,
        anisotropy,
        [&rulers[0].values, &rulers[1].values],
    )?;
    let (mut fields, mut ways) = (Vec::new(), Vec::new());
    for baked in own {
        let Some(table) = baked.table() else { continue };
        let name = match baked.layout {
            Layout::Azimuth => "azimuth in the table",
            _ => "mean over the azimuth",
        };
        let errors = measure(table, baked.decode, &judge.points, judge.truth(None), 0.0)?;
        let lookup = Lookup::new(table, baked.decode)?;
        let values = map.points.all.iter().zip(&map.truth);
        fields.push(Field {
            name: name.into(),
            unit: String::new(),
            signed: true,
            x: rulers[0].clone(),
            y: rulers[1].clone(),
            values: values.map(|(p, e)| (f64::from(lookup.at(p).e) - e) as f32).collect(),
        });
        let a = &baked.approximation;
        ways.push(AzimuthWay {
            name: format!("{name}: {}", a.name),
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
    let ([r0, r1], [a0, a1]) = (region.roughness, region.slices.range);
    let domain = format!("roughness {r0} to {r1}, anisotropy {a0} to {a1}");
    Ok(AzimuthFinding { domain, at, fields, ways })
}

/// Azimuth in degrees, and mu.
fn rulers(region: &Region) -> [Ruler; 2] {
    [Ruler::even("azimuth of the view, degrees", 0.0, 90.0, MAP[0]), super::grid::grazing(region, MAP[1])]
}
