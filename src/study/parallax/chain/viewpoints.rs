//! From where the texels of a bake see the room: away from the edges of the proxy and near them.

use super::measure::{Case, Row, all, gain, relative, shaded};
use super::{Parameters, texels};
use crate::effects::parallax::{Slant, Width};
use crate::effects::room::cubemap::{Bake, Integrated, Viewpoint};
use crate::effects::room::{Fan, Fetch, Lookup};
use crate::math::ops;
use crate::report::{BakePolicy, SlideLaw};
use crate::study::StudyError;

/// The laws compared, with how their widths change; the sliding ones over `widths` radii.
pub(super) fn policies(widths: f64) -> Vec<(&'static str, Viewpoint, Slant)> {
    let (sliding, fading) = (Viewpoint::Sliding { widths }, Slant::Fading { widths });
    vec![
        ("angular, ratio of distances", Viewpoint::Probe, Slant::Ignored),
        ("angular, ratio of areas", Viewpoint::Probe, Slant::Whole),
        ("angular, fading at edges", Viewpoint::Probe, fading),
        ("perpendicular, ratio of areas", Viewpoint::Perpendicular, Slant::Whole),
        ("sliding, ratio of areas", sliding, Slant::Whole),
        ("sliding, fading at edges", sliding, fading),
    ]
}

/// Every law in a room.
pub(super) fn compared(
    case: &Case,
    fan: &Fan,
    widths: f64,
    parameters: &Parameters,
) -> Result<Vec<BakePolicy>, StudyError> {
    let engine = texels::bake(parameters.first(), parameters);
    let mut chains = Vec::new();
    for viewpoint in [Viewpoint::Probe, Viewpoint::Perpendicular, Viewpoint::Sliding { widths }] {
        chains.push((viewpoint, Bake { viewpoint, ..engine.clone() }.chain(case.room)?));
    }
    let rival = case.baked(Viewpoint::Probe, Slant::Ignored, Width::Frostbite);
    let errors = |lookup: &dyn Lookup, fetch: &dyn Fetch, wanted: &dyn Fn(bool) -> bool| {
        let row = |row: &Row| relative(&shaded(row, lookup, fetch), &row.light, |i| wanted(row.near[i]));
        case.rows.iter().map(row).collect::<Vec<f64>>()
    };
    let exact = Integrated { room: case.room, proxy: &case.shape, viewpoint: Viewpoint::Probe, fan };
    let (published, stored) = (errors(&rival, &exact, &|_| true), errors(&rival, &chains[0].1, &|_| true));
    let mut found = Vec::new();
    for (name, viewpoint, slant) in policies(widths) {
        let lookup = case.baked(viewpoint, slant, Width::Rational);
        let exact = Integrated { viewpoint, ..exact };
        let whole = errors(&lookup, &exact, &|_| true);
        let chain = chains.iter().find(|(law, _)| *law == viewpoint).map(|(_, chain)| chain);
        let chain = chain.map_or_else(Vec::new, |chain| errors(&lookup, chain, &|_| true));
        found.push(BakePolicy {
            room: case.room.name.clone(),
            policy: name.into(),
            gain: gain(&published, &whole),
            gain_chain: gain(&stored, &chain),
            far: errors(&lookup, &exact, &|near| !near),
            near: errors(&lookup, &exact, &|near| near),
            whole,
            chain,
        });
    }
    Ok(found)
}

/// Geometric mean over roughness and rooms of what a sliding bake is off by.
fn loss(cases: &[Case], fan: &Fan, widths: f64) -> Vec<f64> {
    let of = |case: &Case| {
        let viewpoint = Viewpoint::Sliding { widths };
        let lookup = case.baked(viewpoint, Slant::Whole, Width::Rational);
        let exact = Integrated { room: case.room, proxy: &case.shape, viewpoint, fan };
        let logs =
            case.rows.iter().map(|row| ops::log(relative(&shaded(row, &lookup, &exact), &row.light, all)));
        ops::exp(logs.sum::<f64>() / case.rows.len() as f64)
    };
    cases.iter().map(of).collect()
}

/// Golden sections until the parameter is known to a few percent: the minimum is flat.
const SECTIONS: usize = 6;

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
