//! From where the texels of a bake see the room: away from the edges of the proxy and near them.

use super::super::measures::{gain, geometric_mean, relative, relative_where};
use super::measure::{Case, shaded};
use super::{Parameters, texels};
use crate::effects::parallax::{Faded, Slant, Width};
use crate::effects::room::cubemap::{Bake, Chain, Integrated, Viewpoint};
use crate::effects::room::{Fan, Fetch, Lookup};
use crate::math::ops;
use crate::report::{BakePolicy, SlideLaw};
use crate::study::StudyError;

/// The law of a bake with how the widths of its fetches change.
pub(super) type Policy = (String, Viewpoint, Slant);

/// Those compared; a viewpoint is half way at `widths` radii, ratios fade over so many as `fades` says.
pub(super) fn policies(widths: f64, fades: &[f64]) -> Vec<Policy> {
    let mut all = vec![("angular, ratio of distances".to_string(), Viewpoint::Probe, Slant::Ignored)];
    let laws = [
        ("angular", Viewpoint::Probe),
        ("perpendicular", Viewpoint::Perpendicular),
        ("sliding", Viewpoint::Sliding { widths }),
    ];
    for (name, viewpoint) in laws {
        all.push((format!("{name}, ratio of areas"), viewpoint, Slant::Whole));
        // fading heals no seam of a bake
        let fades = if viewpoint == Viewpoint::Perpendicular { &[] } else { fades };
        let fading = |widths: &f64| {
            let unit = if *widths == 1.0 { "radius" } else { "radii" };
            (format!("{name}, fading over {widths} {unit}"), viewpoint, Slant::Fading { widths: *widths })
        };
        all.extend(fades.iter().map(fading));
    }
    all
}

/// Errors of a lookup by roughness: over all points, those far from edges, those near them.
fn errors(case: &Case, lookup: &dyn Lookup, fetch: &dyn Fetch) -> [Vec<f64>; 3] {
    let mut errors = [const { Vec::new() }; 3];
    for row in &case.rows {
        let found = shaded(row, lookup, fetch);
        let over =
            |wanted: &dyn Fn(bool) -> bool| relative_where(&found, &row.light, |i| wanted(row.near[i]));
        errors[0].push(over(&|_| true));
        errors[1].push(over(&|near| !near));
        errors[2].push(over(&|near| near));
    }
    errors
}

/// Every law in a room.
pub(super) fn compared(
    case: &Case,
    fan: &Fan,
    policies: &[Policy],
    parameters: &Parameters,
) -> Result<Vec<BakePolicy>, StudyError> {
    let engine = texels::bake(parameters.first(), parameters);
    let mut chains: Vec<(Viewpoint, Chain)> = Vec::new();
    for (_, viewpoint, _) in policies {
        if chains.iter().all(|(law, _)| law != viewpoint) {
            chains.push((*viewpoint, Bake { viewpoint: *viewpoint, ..engine.clone() }.chain(case.room)?));
        }
    }
    let both = |viewpoint: Viewpoint, lookup: &Faded| {
        let exact = Integrated { room: case.room, proxy: &case.shape, viewpoint, fan };
        let chain = chains.iter().find(|(law, _)| *law == viewpoint).map(|(_, chain)| chain);
        let stored = chain.map(|chain| errors(case, lookup, chain)).unwrap_or_default();
        (errors(case, lookup, &exact), stored)
    };
    let rival = case.lookup(Slant::Ignored, Width::Frostbite);
    let ([published, ..], [published_chain, ..]) = both(Viewpoint::Probe, &rival);
    let one = |(name, viewpoint, slant): &Policy| {
        let lookup = case.lookup(*slant, Width::Rational);
        let ([whole, far, near], [chain, ..]) = both(*viewpoint, &lookup);
        BakePolicy {
            room: case.room.name.clone(),
            policy: name.clone(),
            gain: gain(&published, &whole),
            gain_chain: gain(&published_chain, &chain),
            whole,
            far,
            near,
            chain,
        }
    };
    Ok(policies.iter().map(one).collect())
}

/// Geometric mean over roughness and rooms of what a sliding bake is off by.
fn loss(cases: &[Case], fan: &Fan, widths: f64) -> Vec<f64> {
    let of = |case: &Case| {
        let viewpoint = Viewpoint::Sliding { widths };
        let lookup = case.lookup(Slant::Whole, Width::Rational);
        let exact = Integrated { room: case.room, proxy: &case.shape, viewpoint, fan };
        geometric_mean(case.rows.iter().map(|row| relative(&shaded(row, &lookup, &exact), &row.light)))
    };
    cases.iter().map(of).collect()
}

/// Golden sections until the parameter is known to a few percent: the minimum is flat.
const SECTIONS: usize = 5;

/// The law's parameter: the best of a grid over all rooms, and then between its neighbours.
pub(super) fn slide(cases: &[Case], fan: &Fan, grid: &[f64]) -> SlideLaw {
    let by_room: Vec<Vec<f64>> = grid.iter().map(|widths| loss(cases, fan, *widths)).collect();
    let joint = |losses: &[f64]| losses.iter().map(|loss| ops::log(*loss)).sum::<f64>();
    let best =
        (0..grid.len()).min_by(|a, b| joint(&by_room[*a]).total_cmp(&joint(&by_room[*b]))).unwrap_or(0);
    let ends = [grid[best.saturating_sub(1)], grid[(best + 1).min(grid.len() - 1)]];
    let (mut low, mut high) = (ops::log(ends[0]), ops::log(ends[1]));
    let at = |log: f64| joint(&loss(cases, fan, ops::exp(log)));
    let golden = 0.618_033_988_749_895;
    for _ in 0..SECTIONS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if at(a) < at(b) { high = b } else { low = a }
    }
    SlideLaw {
        widths: grid.to_vec(),
        rooms: cases.iter().map(|case| case.room.name.clone()).collect(),
        loss: (0..cases.len()).map(|room| by_room.iter().map(|losses| losses[room]).collect()).collect(),
        best: ops::exp(0.5 * (low + high)),
    }
}
