//! `ggx-dfg`: the table of E, or of E and B, that a shader looks up.
//!
//! The homogeneous layout. Near the smooth, grazing corner E depends on mu/alpha alone, so its columns run along
//! u = sqrt(mu (1 + alpha)/(mu + alpha)), which resolves that layer at every roughness. B does not suit that coordinate: for a
//! smooth lobe it falls with (1-mu)^5, all of it inside the last texel. So the table keeps, beside the loss 1 - E, the part of
//! B/E that Schlick's weight at the macro normal does not explain,
//!
//!   bias = B/E - (1 - mu)^5,   E = 1 - loss,   B = E (bias + (1 - mu)^5),
//!
//! which vanishes with alpha away from the layer and depends on mu/alpha alone inside it. The texels are not samples: they are
//! optimised so that the largest error of the bilinear lookup is smallest ([`lobefit_fit::texels`]).
//!
//! The plain layouts hold what engines hold today, E or (A, B) sampled at texel centres over the whole of roughness [0, 1].

use rayon::prelude::*;

use super::demand::table_seconds;
use crate::approximate::{Counter, certification};
use crate::data::{Axis, Channel, Layout, Registration, Serves, Smith, Surface, Table, Warp};
use crate::effects::Albedo;
use crate::effects::table::{BuildError, Family, Judge, Made, Points, Region, Spec, TableJob};
use lobefit_fit::texels::{self, Lattice, Wanted};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::reflection::{Effort, Interpolant, albedo, split};
use lobefit_truth::optics::distribution::Ggx;
use lobefit_truth::quantity::{GGX_REFLECTION, TRUTH_ERROR};

/// Samples per cell and axis that the texels are optimised on: fewer in large tables, whose cells hold less curvature and whose
/// samples would fill the memory (a 512 x 512 table has a million at 2).
fn per_cell(size: &[usize]) -> usize {
    match size.iter().product::<usize>() {
        0..=20_000 => 4,
        20_001..=300_000 => 2,
        _ => 1,
    }
}

/// 2^17 uniform points, half as many in the layer mu ~ alpha, and the edges.
const LOG2_POINTS: u32 = 17;

/// Rounds of relaxation after which the error of these tables stands still.
const ROUNDS: usize = 100;

/// The tables of this effect.
pub struct Dfg;

impl Family for Dfg {
    fn prefix(&self, _: Layout) -> &'static str {
        "ggx-dfg"
    }

    fn described(&self, job: &TableJob, _: Option<Side>) -> String {
        format!("for {}", job.serves.name())
    }

    fn seconds(&self, i: usize, jobs: &[TableJob]) -> f64 {
        table_seconds(i, jobs)
    }

    fn build(&self, spec: &Spec, counter: &Counter) -> Result<(Vec<Table>, Made), BuildError> {
        Ok((vec![build(spec, counter)?], Made { evaluations: 0, integration: TRUTH_ERROR }))
    }

    /// With B where a table that is judged in the same region holds it.
    fn finer(&self, job: &TableJob, jobs: &[TableJob]) -> bool {
        let same = |other: &&TableJob| other.smith == job.smith && other.region() == job.region();
        jobs.iter().filter(same).any(|other| other.serves == Serves::SplitSum)
    }

    fn judge(
        &self,
        smith: Smith,
        region: &Region,
        split: bool,
        counter: &Counter,
    ) -> Result<Judge, BuildError> {
        let points = certification(&region.flat(), LOG2_POINTS);
        let truths = vec![Albedo::new(smith, &points, split, counter)?];
        let made = Made { evaluations: 0, integration: TRUTH_ERROR };
        Ok(Judge { points: Points::isotropic(&points), truths, made })
    }
}

/// The table before its texels are rounded to their format.
///
/// # Errors
/// A layout with slices; texels that are not finite.
pub fn build(spec: &Spec, counter: &Counter) -> Result<Table, BuildError> {
    let (axes, channels) = match spec.layout {
        Layout::Homogeneous => {
            let axes = axes(spec, Registration::Endpoint, Warp::Homogeneous, spec.region.roughness)?;
            let channels = optimised(spec, &axes, counter);
            (axes, channels)
        }
        Layout::Plain | Layout::PlainSquared => {
            let warp = if spec.layout == Layout::Plain { Warp::Linear } else { Warp::Sqrt };
            let axes = axes(spec, Registration::Centre, warp, [0.0, 1.0])?;
            let channels = sampled(spec, &axes, counter);
            (axes, channels)
        }
        Layout::Optimised | Layout::PathTracer | Layout::Azimuth => return Err(spec.no_layout()),
    };
    let tables = spec.tables("ggx-reflection", &axes, vec![channels])?;
    tables.into_iter().next().ok_or_else(|| spec.no_layout())
}

fn axes(
    spec: &Spec,
    registration: Registration,
    warp: Warp,
    roughness: [f64; 2],
) -> Result<[Axis; 2], BuildError> {
    let [columns, rows] = spec.sizes()?;
    let axes =
        [Axis::ends("mu", columns, warp, [0.0, 1.0]), Axis::ends("roughness", rows, Warp::Linear, roughness)];
    Ok(axes.map(|axis| Axis { registration, ..axis }))
}

/// A point of the domain with its truth; B is 0 where the table does not hold it.
struct Node {
    mu: f64,
    e: f64,
    b: f64,
}

impl Node {
    /// E and B at alpha and mu; from the interpolant where it is given and holds.
    fn new(spec: &Spec, known: Option<&Interpolant<Ggx>>, (alpha, mu): (f64, f64)) -> Node {
        let effort = &Effort::ladder()[1];
        let known = known.and_then(|known| known.at(alpha, mu));
        let (e, b) = match spec.serves {
            Serves::SplitSum => known.unwrap_or_else(|| split(spec.smith, alpha, mu, effort)),
            Serves::Albedo => (albedo(spec.smith, alpha, mu, &effort.outer), 0.0),
        };
        Node { mu, e, b }
    }

    /// The encoded bias for a lookup whose albedo is `e`.
    fn bias(&self, e: f64) -> f64 {
        self.b / e - lobefit_truth::optics::fresnel::schlick_weight(1.0 - self.mu)
    }
}

/// Unit coordinate of a position in texels.
fn unit(axis: &Axis, position: f64) -> f64 {
    match axis.registration {
        Registration::Centre => (position + 0.5) / axis.size as f64,
        Registration::Endpoint => position / (axis.size - 1) as f64,
    }
}

fn sampled(spec: &Spec, axes: &[Axis; 2], counter: &Counter) -> Vec<Channel> {
    let texels = Lattice { size: spec.size.clone(), per_cell: vec![1; 2] };
    let nodes = nodes(spec, axes, &texels, counter);
    match spec.serves {
        Serves::Albedo => vec![Channel::new("E", nodes.iter().map(|n| n.e).collect())],
        Serves::SplitSum => vec![
            Channel::new("A", nodes.iter().map(|n| n.e - n.b).collect()),
            Channel::new("B", nodes.iter().map(|n| n.b).collect()),
        ],
    }
}

fn optimised(spec: &Spec, axes: &[Axis; 2], counter: &Counter) -> Vec<Channel> {
    let lattice = Lattice { size: spec.size.clone(), per_cell: vec![per_cell(&spec.size); 2] };
    let dense = nodes(spec, axes, &lattice, counter);
    let columns = lattice.samples()[0];
    let at_texels = |values: &[f64]| -> Vec<f64> {
        let step = lattice.per_cell[0];
        let rows = values.chunks_exact(columns).step_by(step);
        rows.flat_map(|row| row.iter().copied().step_by(step)).collect()
    };
    // Below the region's mu nothing is looked up.
    let seen = |n: &Node| if n.mu >= spec.region.mu[0] { 1.0 } else { 0.0 };
    let losses: Vec<f64> = dense.iter().map(|n| 1.0 - n.e).collect();
    let start = at_texels(&losses);
    let wanted = Wanted { targets: losses, weights: dense.iter().map(seen).collect() };
    let (loss, _) = texels::optimise(&lattice, &start, &wanted, ROUNDS);
    let mut channels = vec![Channel::new("loss", loss)];
    if spec.serves == Serves::SplitSum {
        // The bias is fitted to the albedo as looked up, so that their errors cancel in B where they can.
        let albedos: Vec<f64> =
            texels::looked_up(&lattice, &channels[0].texels).into_iter().map(|loss| 1.0 - loss).collect();
        let start = at_texels(&dense.iter().map(|n| n.bias(n.e)).collect::<Vec<_>>());
        let pairs = || dense.iter().zip(&albedos);
        let wanted = Wanted {
            targets: pairs().map(|(n, e)| n.bias(*e)).collect(),
            weights: pairs().map(|(n, e)| seen(n) * e).collect(),
        };
        let (bias, _) = texels::optimise(&lattice, &start, &wanted, ROUNDS);
        channels.push(Channel::new("bias", bias));
    }
    channels
}

/// Truths at the samples of a lattice.
fn nodes(spec: &Spec, axes: &[Axis; 2], lattice: &Lattice, counter: &Counter) -> Vec<Node> {
    let samples = lattice.samples();
    counter.add(samples.iter().product());
    let place = |i: usize| {
        let (u, v) = (
            unit(&axes[0], lattice.position(0, i % samples[0])),
            unit(&axes[1], lattice.position(1, i / samples[0])),
        );
        let alpha = spec.region.alpha_map.alpha(axes[1].physical(v, Surface::<f64>::rough(0.0)));
        (alpha, axes[0].physical(u, Surface::<f64>::rough(alpha)).clamp(0.0, 1.0))
    };
    let places: Vec<(f64, f64)> = (0..samples[0] * samples[1]).map(place).collect();
    let many = lattice.per_cell.iter().any(|n| *n > 1) && spec.serves == Serves::SplitSum;
    let known = many.then(|| GGX_REFLECTION.interpolant(spec.smith, true));
    known.inspect(|known| known.cover(&places));
    places.into_par_iter().map(|place| Node::new(spec, known, place)).collect()
}
