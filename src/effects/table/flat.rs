//! Texels of a table over mu and roughness.
//!
//! The homogeneous layout. Near the smooth, grazing corner the albedo E of a lobe depends on
//! mu/alpha alone, so the columns run along u = sqrt(mu (1 + alpha)/(mu + alpha)), which resolves
//! that layer at every roughness. Schlick's bias B does not suit that coordinate: for a smooth lobe
//! it falls with (1-mu)^5, all of it inside the last texel. So the table holds, beside the loss
//! 1 - E, the part of B/E that Schlick's weight at the macro normal does not explain,
//!
//!   bias = B/E - (1 - mu)^5,   E = 1 - loss,   B = E (bias + (1 - mu)^5),
//!
//! which vanishes with alpha away from the layer and depends on mu/alpha alone inside it. The
//! texels are not samples: they are optimised so that the largest error of the bilinear lookup is
//! smallest ([`lobefit_fit::texels`]).
//!
//! The plain layouts hold what engines hold today, E or (A, B) sampled at texel centres over the
//! whole of roughness [0, 1].

use super::{BuildError, Spec};
use crate::data::{Axis, Channel, Layout, Registration, Serves, Surface, Table, Warp};
use lobefit_fit::texels::{self, Lattice, Wanted};
use lobefit_truth::integrate::IntegrateError;

/// E and B at places of alpha and mu; B is not read where the table does not hold it.
pub type Truth<'a> = dyn Fn(&[(f64, f64)]) -> Result<Vec<(f64, f64)>, IntegrateError> + 'a;

/// Samples per cell and axis that the texels are optimised on: fewer in large tables, whose cells
/// hold less curvature and whose samples would fill the memory (a 512 x 512 table has a million at
/// 2).
pub fn per_cell(spec: &Spec) -> usize {
    match spec.size.iter().product::<usize>() {
        _ if spec.layout != Layout::Homogeneous => 1,
        0..=20_000 => 4,
        20_001..=300_000 => 2,
        _ => 1,
    }
}

/// Rounds of relaxation after which the error of these tables stands still.
const ROUNDS: usize = 100;

/// The lattice of samples that texels are made from: the texels themselves in the plain layouts.
fn lattice(spec: &Spec) -> Lattice {
    Lattice { size: spec.size.clone(), per_cell: vec![per_cell(spec); 2] }
}

/// Number of the samples.
pub fn samples(spec: &Spec) -> usize {
    lattice(spec).samples().iter().product()
}

/// The table of a quantity, texels not yet rounded.
///
/// # Errors
/// A layout with slices; a truth that cannot be integrated; texels that are not finite.
pub fn build(quantity: &str, spec: &Spec, truth: &Truth) -> Result<Vec<Table>, BuildError> {
    let (registration, warp, roughness) = match spec.layout {
        Layout::Homogeneous => (Registration::Endpoint, Warp::Homogeneous, spec.region.roughness),
        Layout::Plain => (Registration::Centre, Warp::Linear, [0.0, 1.0]),
        Layout::PlainSquared => (Registration::Centre, Warp::Sqrt, [0.0, 1.0]),
        Layout::Optimised | Layout::PathTracer | Layout::Azimuth => return Err(spec.no_layout()),
    };
    let [columns, rows] = spec.sizes()?;
    let axes =
        [Axis::ends("mu", columns, warp, [0.0, 1.0]), Axis::ends("roughness", rows, Warp::Linear, roughness)]
            .map(|axis| Axis { registration, ..axis });
    let lattice = lattice(spec);
    let nodes = nodes(spec, &axes, &lattice, truth)?;
    let channels = match (spec.layout, spec.serves) {
        (Layout::Homogeneous, _) => optimised(spec, &lattice, &nodes),
        (_, Serves::Albedo) => vec![Channel::new("E", nodes.iter().map(|n| n.e).collect())],
        (_, Serves::SplitSum) => vec![
            Channel::new("A", nodes.iter().map(|n| n.e - n.b).collect()),
            Channel::new("B", nodes.iter().map(|n| n.b).collect()),
        ],
    };
    spec.tables(quantity, &axes, vec![channels])
}

/// A point of the domain with its truth.
struct Node {
    mu: f64,
    e: f64,
    b: f64,
}

impl Node {
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

fn optimised(spec: &Spec, lattice: &Lattice, dense: &[Node]) -> Vec<Channel> {
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
    let (loss, _) = texels::optimise(lattice, &start, &wanted, ROUNDS);
    let mut channels = vec![Channel::new("loss", loss)];
    if spec.serves == Serves::SplitSum {
        // The bias is fitted to the albedo as looked up, so that their errors cancel in B where
        // they can.
        let albedos: Vec<f64> =
            texels::looked_up(lattice, &channels[0].texels).into_iter().map(|loss| 1.0 - loss).collect();
        let start = at_texels(&dense.iter().map(|n| n.bias(n.e)).collect::<Vec<_>>());
        let pairs = || dense.iter().zip(&albedos);
        let wanted = Wanted {
            targets: pairs().map(|(n, e)| n.bias(*e)).collect(),
            weights: pairs().map(|(n, e)| seen(n) * e).collect(),
        };
        let (bias, _) = texels::optimise(lattice, &start, &wanted, ROUNDS);
        channels.push(Channel::new("bias", bias));
    }
    channels
}

/// Truths at the samples of a lattice.
fn nodes(
    spec: &Spec,
    axes: &[Axis; 2],
    lattice: &Lattice,
    truth: &Truth,
) -> Result<Vec<Node>, IntegrateError> {
    let [columns, rows] = [0, 1].map(|axis| lattice.samples()[axis]);
    let place = |i: usize| {
        let [u, v] =
            [(0, i % columns), (1, i / columns)].map(|(k, i)| unit(&axes[k], lattice.position(k, i)));
        let alpha = spec.region.alpha_map.alpha(axes[1].physical(v, Surface::<f64>::rough(0.0)));
        (alpha, axes[0].physical(u, Surface::<f64>::rough(alpha)).clamp(0.0, 1.0))
    };
    let places: Vec<(f64, f64)> = (0..columns * rows).map(place).collect();
    let truths = truth(&places)?;
    Ok(places.iter().zip(truths).map(|(&(_, mu), (e, b))| Node { mu, e, b }).collect())
}
