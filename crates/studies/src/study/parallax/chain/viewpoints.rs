//! From where the texels of a bake see the room: away from the edges of the proxy and near them.

use super::super::measures::{gain, geometric_mean, relative, relative_where};
use super::super::rooms::methods::{Method, Taken, smooth};
use super::measure::{Case, shaded};
use super::{Parameters, texels};
use crate::study::StudyError;
use crate::study::parallax::findings::{BakePolicy, SlideLaw};
use crate::study::parallax::room::cubemap::{Bake, Chain, Integrated, Viewpoint};
use crate::study::parallax::room::{Fetch, Lookup, Slant};
use lobefit::effects::parallax::Width;
use lobefit_math::ops;

/// How a bake is looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fetches {
    /// By one fetch through the planes, whose width changes so.
    Slanted(Slant),
    /// By so many, the ratio that of areas.
    Ruled {
        /// Their number.
        count: usize,
        /// Through planes or the smooth proxy.
        taken: Taken,
    },
}

/// The law of a bake with how it is looked up.
pub(super) struct Policy {
    pub name: String,
    pub viewpoint: Viewpoint,
    fetches: Fetches,
}

impl Policy {
    /// Its lookup in a room.
    pub fn lookup(&self, case: &Case) -> Result<Box<dyn Lookup>, StudyError> {
        match self.fetches {
            Fetches::Slanted(slant) => Ok(Box::new(case.lookup(slant, Width::EMITTED))),
            Fetches::Ruled { count, taken } => Method { taken, ..smooth(count) }.lookup(case.room),
        }
    }
}

/// Those compared; a viewpoint is half way at `widths` radii, ratios fade over so many as `fades`
/// says.
pub(super) fn policies(widths: f64, fades: &[f64]) -> Vec<Policy> {
    let policy = |name: String, viewpoint, fetches| Policy { name, viewpoint, fetches };
    let slanted = |name: String, viewpoint, slant| policy(name, viewpoint, Fetches::Slanted(slant));
    let mut all = vec![slanted("angular, ratio of distances".into(), Viewpoint::Probe, Slant::Ignored)];
    let laws = [
        ("angular", Viewpoint::Probe),
        ("perpendicular", Viewpoint::Perpendicular),
        ("sliding", Viewpoint::Sliding { widths }),
    ];
    for (name, viewpoint) in laws {
        all.push(slanted(format!("{name}, ratio of areas"), viewpoint, Slant::Whole));
        // fading heals no seam of a bake
        if viewpoint == Viewpoint::Perpendicular {
            continue;
        }
        for &widths in fades {
            let unit = if widths == 1.0 { "radius" } else { "radii" };
            let name = format!("{name}, fading over {widths} {unit}");
            all.push(slanted(name, viewpoint, Slant::Fading { widths }));
        }
        let ruled = [
            ("smooth", 1, Taken::Smooth),
            ("2 fetches", 2, Taken::Planes),
            ("3 fetches", 3, Taken::Planes),
            ("2 fetches, smooth", 2, Taken::Smooth),
            ("3 fetches, smooth", 3, Taken::Smooth),
        ];
        let ruled = ruled.map(|(what, count, taken)| {
            policy(format!("{name}, {what}"), viewpoint, Fetches::Ruled { count, taken })
        });
        all.extend(ruled);
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
    policies: &[Policy],
    parameters: &Parameters,
) -> Result<Vec<BakePolicy>, StudyError> {
    let engine = texels::bake(parameters.first(), parameters);
    let mut chains: Vec<(Viewpoint, Chain)> = Vec::new();
    for Policy { viewpoint, .. } in policies {
        if chains.iter().all(|(law, _)| law != viewpoint) {
            chains.push((*viewpoint, Bake { viewpoint: *viewpoint, ..engine.clone() }.chain(case.room)?));
        }
    }
    let both = |viewpoint: Viewpoint, lookup: &dyn Lookup| {
        let exact = Integrated { probe: case.room.probe, proxy: &case.shape, viewpoint, exact: &case.exact };
        let chain = chains.iter().find(|(law, _)| *law == viewpoint).map(|(_, chain)| chain);
        let stored = chain.map(|chain| errors(case, lookup, chain)).unwrap_or_default();
        (errors(case, lookup, &exact), stored)
    };
    let rival = case.lookup(Slant::Ignored, Width::Frostbite);
    let ([published, ..], [published_chain, ..]) = both(Viewpoint::Probe, &rival);
    let one = |policy: &Policy| {
        let ([whole, far, near], [chain, ..]) = both(policy.viewpoint, policy.lookup(case)?.as_ref());
        Ok(BakePolicy {
            room: case.room.name.clone(),
            policy: policy.name.clone(),
            gain: gain(&published, &whole),
            gain_chain: gain(&published_chain, &chain),
            whole,
            far,
            near,
            chain,
        })
    };
    policies.iter().map(one).collect()
}

/// Geometric mean over roughness of what a sliding bake is off by.
fn loss(case: &Case, widths: f64) -> f64 {
    let viewpoint = Viewpoint::Sliding { widths };
    let lookup = case.lookup(Slant::Whole, Width::EMITTED);
    let exact = Integrated { probe: case.room.probe, proxy: &case.shape, viewpoint, exact: &case.exact };
    geometric_mean(case.rows.iter().map(|row| relative(&shaded(row, &lookup, &exact), &row.light)))
}

/// Golden sections until the parameter is known to a few percent: the minimum is flat.
const SECTIONS: usize = 5;

/// The law's parameter: the best of a grid, and then between its neighbours.
pub(super) fn slide(case: &Case, grid: &[f64]) -> SlideLaw {
    let losses: Vec<f64> = grid.iter().map(|widths| loss(case, *widths)).collect();
    let best = (0..grid.len()).min_by(|a, b| losses[*a].total_cmp(&losses[*b])).unwrap_or(0);
    let ends = [grid[best.saturating_sub(1)], grid[(best + 1).min(grid.len() - 1)]];
    let (mut low, mut high) = (ops::log(ends[0]), ops::log(ends[1]));
    let at = |log: f64| loss(case, ops::exp(log));
    let golden = 0.618_033_988_749_895;
    for _ in 0..SECTIONS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if at(a) < at(b) { high = b } else { low = a }
    }
    SlideLaw {
        widths: grid.to_vec(),
        room: case.room.name.clone(),
        loss: losses,
        best: ops::exp(0.5 * (low + high)),
    }
}
