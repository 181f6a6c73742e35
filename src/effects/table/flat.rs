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
//! The plain layouts hold what engines hold today, E or (A, B) at texel centres over the whole of
//! roughness [0, 1]. Their texels are optimised too: before the first texel and after the last a
//! lookup clamps, and E changes fast at grazing views, so that sampled texels leave twice the
//! error.

use super::{BuildError, Spec};
use crate::data::{Axis, Channel, Layout, Registration, Serves, Surface, Table, Warp};
use lobefit_fit::texels::{self, Lattice, Wanted};
use lobefit_truth::integrate::IntegrateError;

/// E and B at places of alpha and mu; B is not read where the table does not hold it.
pub type Truth<'a> = dyn Fn(&[(f64, f64)]) -> Result<Vec<(f64, f64)>, IntegrateError> + 'a;

/// Samples per cell and axis that the texels are optimised on: fewer in large tables, whose cells
/// hold less curvature and whose samples would fill the memory (a 512 x 512 table has a million at
/// 2). Even in the plain layouts, whose ends lie half a cell beyond the texels.
pub fn per_cell(spec: &Spec, rounds: usize) -> usize {
    match spec.size.iter().product::<usize>() {
        _ if rounds == 0 => 1,
        0..=20_000 => 4,
        20_001..=300_000 => 2,
        _ if spec.layout == Layout::Homogeneous => 1,
        _ => 2,
    }
}

/// Rounds of relaxation after which the error of these tables stands still.
pub const ROUNDS: usize = 100;

/// The lattice of samples that texels are made from: with 0 rounds the texels themselves. It ends
/// where the axes end: at the texels, or in the plain layouts half a cell beyond them.
fn lattice(spec: &Spec, rounds: usize) -> Lattice {
    let per_cell = per_cell(spec, rounds);
    let beyond = if spec.layout == Layout::Homogeneous { 0 } else { per_cell / 2 };
    Lattice { size: spec.size.clone(), per_cell: vec![per_cell; 2], beyond: vec![beyond; 2] }
}

/// Number of the samples.
pub fn samples(spec: &Spec, rounds: usize) -> usize {
    lattice(spec, rounds).samples().iter().product()
}

/// The table of a quantity, texels not yet rounded: optimised in so many rounds, or with 0 rounds
/// exact at the texels.
///
/// # Errors
/// A layout with slices; a truth that cannot be integrated; texels that are not finite.
pub fn build(quantity: &str, spec: &Spec, rounds: usize, truth: &Truth) -> Result<Vec<Table>, BuildError> {
    let (registration, warp, roughness) = match spec.layout {
        Layout::Homogeneous => (Registration::Endpoint, Warp::Homogeneous, spec.region.roughness),
        Layout::Plain => (Registration::Centre, Warp::Linear, [0.0, 1.0]),
        Layout::PlainSquared => (Registration::Centre, Warp::Sqrt, [0.0, 1.0]),
        _ => return Err(spec.no_layout()),
    };
    let [columns, rows] = spec.sizes()?;
    let axes =
        [Axis::ends("mu", columns, warp, [0.0, 1.0]), Axis::ends("roughness", rows, Warp::Linear, roughness)]
            .map(|axis| Axis { registration, ..axis });
    let lattice = lattice(spec, rounds);
    let nodes = nodes(spec, &axes, &lattice, truth)?;
    let channels = match spec.layout {
        Layout::Homogeneous => losses(spec, (&lattice, rounds), &nodes),
        _ => albedos(spec, (&lattice, rounds), &nodes),
    };
    spec.tables(quantity, &axes, vec![channels])
}

/// A point of the domain with its truth.
struct Node {
    roughness: f64,
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

/// Weight of an error where no lookup is judged, in plain layouts, whose rows span all roughness:
/// texels there stay close to the truth, and yield where a judged lookup reads them too.
const UNJUDGED: f64 = 1e-3;

/// How much the error at a sample counts.
fn weight(spec: &Spec, node: &Node) -> f64 {
    let inside = |x: f64, [low, high]: [f64; 2]| (low - 1e-9..=high + 1e-9).contains(&x);
    let seen = inside(node.mu, spec.region.mu) && inside(node.roughness, spec.region.roughness);
    match (seen, spec.layout) {
        (true, _) => 1.0,
        (false, Layout::Homogeneous) => 0.0,
        (false, _) => UNJUDGED,
    }
}

/// The texels that leave the smallest largest error of weight |lookup - target|, beginning with
/// those of the exact values.
fn channel(name: &str, (lattice, rounds): (&Lattice, usize), exact: &[f64], wanted: &Wanted) -> Channel {
    let columns = lattice.samples()[0];
    let [x, y] = [0, 1].map(|axis| lattice.beyond[axis]);
    let step = lattice.per_cell[0];
    let rows = exact.chunks_exact(columns).skip(y).step_by(step).take(lattice.size[1]);
    let start: Vec<f64> =
        rows.flat_map(|row| row.iter().copied().skip(x).step_by(step).take(lattice.size[0])).collect();
    Channel::new(name, texels::optimise(lattice, &start, wanted, rounds).0)
}

/// The channels of the homogeneous layout.
fn losses(spec: &Spec, lattice: (&Lattice, usize), dense: &[Node]) -> Vec<Channel> {
    let weights: Vec<f64> = dense.iter().map(|n| weight(spec, n)).collect();
    let wanted = Wanted { targets: dense.iter().map(|n| 1.0 - n.e).collect(), weights };
    let loss = channel("loss", lattice, &wanted.targets, &wanted);
    if spec.serves == Serves::Albedo {
        return vec![loss];
    }
    // The bias is fitted to the albedo as looked up, so that their errors cancel in B where they
    // can.
    let looked_up = texels::looked_up(lattice.0, &loss.texels);
    let albedos = || looked_up.iter().map(|loss| 1.0 - loss);
    let exact: Vec<f64> = dense.iter().map(|n| n.bias(n.e)).collect();
    let wanted = Wanted {
        targets: dense.iter().zip(albedos()).map(|(n, e)| n.bias(e)).collect(),
        weights: wanted.weights.iter().zip(albedos()).map(|(weight, e)| weight * e).collect(),
    };
    vec![loss, channel("bias", lattice, &exact, &wanted)]
}

/// The channels of the plain layouts.
fn albedos(spec: &Spec, lattice: (&Lattice, usize), dense: &[Node]) -> Vec<Channel> {
    let wanted = |targets: Vec<f64>| {
        let weights = dense.iter().map(|n| weight(spec, n)).collect();
        Wanted { targets, weights }
    };
    if spec.serves == Serves::Albedo {
        let e = wanted(dense.iter().map(|n| n.e).collect());
        return vec![channel("E", lattice, &e.targets, &e)];
    }
    let of_b = wanted(dense.iter().map(|n| n.b).collect());
    let b = channel("B", lattice, &of_b.targets, &of_b);
    // A is fitted to what the lookup of B leaves of E, so that E = A + B is as good as B.
    let looked_up = texels::looked_up(lattice.0, &b.texels);
    let exact: Vec<f64> = dense.iter().map(|n| n.e - n.b).collect();
    let rest = wanted(dense.iter().zip(looked_up).map(|(n, b)| n.e - b).collect());
    vec![channel("A", lattice, &exact, &rest), b]
}

/// Smallest alpha and mu of samples in the plain layouts, whose axes begin at 0: the smallest that
/// integrals at a fixed number of nodes are good for. Nothing smaller is judged.
const SMALLEST: f64 = 1e-4;

/// The value that a sample of an axis stands for. Before the first texel of a plain layout a lookup
/// does not change: what is judged there begins at the end of the judged range.
fn judged(axis: &Axis, [low, _]: [f64; 2], x: f64) -> f64 {
    let clamps = axis.registration == Registration::Centre;
    let first = axis.node(0, Surface::<f64>::rough(0.0));
    if clamps && x < low && low <= first { low } else { x }
}

/// Truths at the samples of a lattice.
fn nodes(
    spec: &Spec,
    axes: &[Axis; 2],
    lattice: &Lattice,
    truth: &Truth,
) -> Result<Vec<Node>, IntegrateError> {
    let [columns, rows] = [0, 1].map(|axis| lattice.samples()[axis]);
    let plain = spec.layout != Layout::Homogeneous;
    let place = |i: usize| {
        let [u, v] =
            [(0, i % columns), (1, i / columns)].map(|(k, i)| unit(&axes[k], lattice.position(k, i)));
        let roughness = axes[1].physical(v, Surface::<f64>::rough(0.0));
        let roughness = judged(&axes[1], spec.region.roughness, roughness);
        let alpha = spec.region.alpha_map.alpha(roughness);
        let mu = axes[0].physical(u, Surface::<f64>::rough(alpha)).clamp(0.0, 1.0);
        let place = (alpha, judged(&axes[0], spec.region.mu, mu));
        (roughness, if plain { (place.0.max(SMALLEST), place.1.max(SMALLEST)) } else { place })
    };
    let (roughness, places): (Vec<f64>, Vec<(f64, f64)>) = (0..columns * rows).map(place).unzip();
    let truths = roughness.into_iter().zip(&places).zip(truth(&places)?);
    Ok(truths.map(|((roughness, &(_, mu)), (e, b))| Node { roughness, mu, e, b }).collect())
}
