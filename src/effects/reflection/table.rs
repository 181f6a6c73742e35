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

use crate::approximate::{Counter, Region};
use crate::data::{
    AlphaMap, Axis, Channel, Layout, Registration, Serves, Smith, Surface, Table, TableError, TexelFormat,
    Warp,
};
use lobefit_fit::texels::{self, TexelSample};
use lobefit_truth::integrate::reflection::{Effort, albedo, split};

/// What to bake.
#[derive(Clone, Debug, PartialEq)]
pub struct TableSpec {
    /// Name of the table.
    pub name: String,
    /// Shadowing form.
    pub smith: Smith,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
    /// Texels along mu and along roughness, at least 2 each.
    pub size: [usize; 2],
    /// Texel format.
    pub format: TexelFormat,
    /// Coordinates.
    pub layout: Layout,
    /// Use.
    pub serves: Serves,
    /// Where the lookup must hold: roughness from the scene, mu in [0.001, 1].
    pub region: Region,
}

/// Samples per cell and axis that the texels are optimised on: fewer in large tables, whose cells hold less curvature and whose
/// samples would fill the memory (a 512 x 512 table has a million at 2).
fn per_cell(size: [usize; 2]) -> usize {
    match size[0] * size[1] {
        0..=20_000 => 4,
        20_001..=300_000 => 2,
        _ => 1,
    }
}

/// The table before its texels are rounded to their format.
pub fn build(spec: &TableSpec, counter: &Counter) -> Result<Table, TableError> {
    let axes = axes(spec);
    let channels = match spec.layout {
        Layout::Homogeneous => optimised(spec, &axes, counter),
        Layout::Plain | Layout::PlainSquared => sampled(spec, &axes, counter),
    };
    let table = Table {
        name: spec.name.clone(),
        quantity: "ggx-reflection".into(),
        smith: spec.smith,
        alpha_map: spec.alpha_map,
        axes: axes.to_vec(),
        channels,
        format: spec.format,
    };
    table.validate()?;
    Ok(table)
}

fn axes(spec: &TableSpec) -> [Axis; 2] {
    let (registration, warp) = match spec.layout {
        Layout::Homogeneous => (Registration::Endpoint, Warp::Homogeneous),
        Layout::Plain => (Registration::Centre, Warp::Linear),
        Layout::PlainSquared => (Registration::Centre, Warp::Sqrt),
    };
    let [low, high] = if spec.layout == Layout::Homogeneous { spec.region.roughness } else { [0.0, 1.0] };
    let axis =
        |name: &str, size, warp, min, max| Axis { name: name.into(), size, registration, warp, min, max };
    [axis("mu", spec.size[0], warp, 0.0, 1.0), axis("roughness", spec.size[1], Warp::Linear, low, high)]
}

/// A point of the domain with its position in texels and its truth; B is 0 where the table does not hold it.
struct Node {
    x: f64,
    y: f64,
    mu: f64,
    e: f64,
    b: f64,
}

impl Node {
    /// E and B at a position in texels.
    fn new(spec: &TableSpec, axes: &[Axis; 2], x: f64, y: f64) -> Node {
        let (u, v) = (unit(&axes[0], x), unit(&axes[1], y));
        let alpha = spec.alpha_map.alpha(axes[1].physical(v, Surface::<f64>::rough(0.0)));
        let mu = axes[0].physical(u, Surface::<f64>::rough(alpha)).clamp(0.0, 1.0);
        let effort = &Effort::ladder()[1];
        let (e, b) = match spec.serves {
            Serves::SplitSum => split(spec.smith, alpha, mu, effort),
            Serves::Albedo => (albedo(spec.smith, alpha, mu, &effort.outer), 0.0),
        };
        Node { x, y, mu, e, b }
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

fn sampled(spec: &TableSpec, axes: &[Axis; 2], counter: &Counter) -> Vec<Channel> {
    let nodes = lattice(spec, axes, 1, counter);
    match spec.serves {
        Serves::Albedo => vec![channel("E", nodes.iter().map(|n| n.e).collect())],
        Serves::SplitSum => vec![
            channel("A", nodes.iter().map(|n| n.e - n.b).collect()),
            channel("B", nodes.iter().map(|n| n.b).collect()),
        ],
    }
}

fn optimised(spec: &TableSpec, axes: &[Axis; 2], counter: &Counter) -> Vec<Channel> {
    let columns = spec.size[0];
    let nodes = lattice(spec, axes, 1, counter);
    let mut dense = lattice(spec, axes, per_cell(spec.size), counter);
    dense.retain(|n| n.mu >= spec.region.mu[0]);
    let start: Vec<f64> = nodes.iter().map(|n| 1.0 - n.e).collect();
    let samples = |f: &dyn Fn(&Node) -> (f64, f64)| -> Vec<TexelSample> {
        let sample = |n: &Node| {
            let (target, weight) = f(n);
            TexelSample { x: n.x, y: n.y, target, weight }
        };
        dense.iter().map(sample).collect()
    };
    let (loss, _) = texels::optimise(columns, &start, &samples(&|n| (1.0 - n.e, 1.0)));
    let mut channels = vec![channel("loss", loss)];
    if spec.serves == Serves::SplitSum {
        // The bias is fitted to the albedo as looked up, so that their errors cancel in B where they can.
        let albedo = |n: &Node| 1.0 - bilinear(&channels[0].texels, columns, n.x, n.y);
        let start: Vec<f64> = nodes.iter().map(|n| n.bias(n.e)).collect();
        let (bias, _) = texels::optimise(columns, &start, &samples(&|n| (n.bias(albedo(n)), albedo(n))));
        channels.push(channel("bias", bias));
    }
    channels
}

fn channel(name: &str, texels: Vec<f64>) -> Channel {
    Channel { name: name.into(), texels }
}

/// Truths at the texels and at `per_cell` - 1 points between neighbours along each axis.
fn lattice(spec: &TableSpec, axes: &[Axis; 2], per_cell: usize, counter: &Counter) -> Vec<Node> {
    let [columns, rows] = [0, 1].map(|k| (axes[k].size - 1) * per_cell + 1);
    counter.add(columns * rows);
    let row = |j: usize| -> Vec<Node> {
        let y = j as f64 / per_cell as f64;
        (0..columns).map(|i| Node::new(spec, axes, i as f64 / per_cell as f64, y)).collect()
    };
    let parts: Vec<Vec<Node>> = (0..rows).into_par_iter().map(row).collect();
    parts.into_iter().flatten().collect()
}

fn bilinear(texels: &[f64], columns: usize, x: f64, y: f64) -> f64 {
    let rows = texels.len() / columns;
    let (x0, y0) = ((x.floor() as usize).min(columns - 2), (y.floor() as usize).min(rows - 2));
    let (fx, fy) = (x - x0 as f64, y - y0 as f64);
    let t = &texels[y0 * columns + x0..];
    (t[0] * (1.0 - fx) + t[1] * fx) * (1.0 - fy) + (t[columns] * (1.0 - fx) + t[columns + 1] * fx) * fy
}
