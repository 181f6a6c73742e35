//! The tables of this effect, in all layouts.

use rayon::prelude::*;

use super::azimuth::Azimuth;
use super::path_tracer::{FLOOR, axes, grid};
use super::{QUANTITY, truth};
use crate::data::{Axis, Channel, Layout, Smith, Surface, Table, Warp};
use crate::effects::table::{BuildError, Made, Node, ROUNDS, Spec, TexelPlan, alpha_nodes, aspect, check};
use lobefit_truth::integrate::aniso::table::{Columns, Grid, Tabulated, mean, tabulate, tabulate_on};
use lobefit_truth::integrate::{IntegrateError, Path};

/// Largest error of a texel of the path tracer's layout.
const SAMPLED: f64 = 1e-6;

/// Largest error of the integrals that the targets of our layout are interpolated from, a hundredth
/// of what the lookup leaves. The targets' own error is measured.
const TARGETS: f64 = 1e-5;

/// Targets drawn for their check.
const CHECKED: usize = 1 << 13;

/// Tolerance of the integrals that targets are compared with.
const DIRECT: f64 = 1e-6;

/// Samples per cell that the texels of the azimuth mean are optimised on.
const SAMPLES: [usize; 3] = [2, 2, 2];

/// Axes of the azimuth mean over the given range of roughness and of anisotropy, in [0, 1]. All
/// register their end points: the ends of every range are texels.
///
/// The columns follow the layer mu ~ alpha, with alpha the geometric mean of alpha_x and alpha_y.
pub fn aniso_axes(size: [usize; 3], roughness: [f64; 2], anisotropy: [f64; 2]) -> [Axis; 3] {
    let axis = |i: usize, name: &str, warp: Warp, range| Axis::ends(name, size[i], warp, range);
    [
        axis(0, "mu", Warp::Homogeneous, [0.0, 1.0]),
        axis(1, "roughness", Warp::Linear, roughness),
        axis(2, "anisotropy", Warp::Aspect, anisotropy),
    ]
}

/// Axes of the table with the azimuth: those of [`aniso_axes`], the columns looked up with the
/// alpha towards the view, [`Azimuth::alpha`], in place of alpha. E at one column then hardly
/// depends on the azimuth for small alpha.
pub fn azimuth_axes(size: [usize; 3], roughness: [f64; 2], anisotropy: [f64; 2]) -> [Axis; 3] {
    let [_, rows, slices] = aniso_axes(size, roughness, anisotropy);
    [Axis::ends("mu", size[0], Warp::HomogeneousAzimuth, [0.0, 1.0]), rows, slices]
}

/// The table, its texels not yet rounded.
///
/// Errors: a truth that cannot be integrated.
pub fn build(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    match spec.layout {
        Layout::Optimised => optimised(spec),
        Layout::PathTracer => sampled(spec),
        Layout::Azimuth => with_azimuth(spec),
        Layout::Homogeneous | Layout::Plain | Layout::PlainSquared => Err(spec.no_layout()),
    }
}

/// Every texel of the path tracer's layout, within `tolerance`.
pub fn path_tracer(path: Path, smith: Smith, tolerance: f64) -> Result<Tabulated, IntegrateError> {
    let [mu, alphas, aspects] = grid();
    let grid = Grid { columns: Columns::Fixed(&mu), alphas: &alphas, aspects: &aspects, floor: FLOOR };
    tabulate_on(path, smith, &grid, tolerance)
}

fn sampled(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let texels = path_tracer(Path::Best, spec.smith, SAMPLED)?;
    let made = made(&texels);
    Ok((spec.tables(QUANTITY, &axes(), vec![vec![Channel::new("E", texels.e)]])?, made))
}

fn made(table: &Tabulated) -> Made {
    let evaluations = table.evaluations + table.checked.evaluations;
    Made { evaluations, integration: table.checked.worst }
}

fn optimised(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let Spec { smith, region, .. } = spec;
    let axes = aniso_axes(spec.sizes()?, region.roughness, region.slices()?.range);
    let nodes = alpha_nodes(region.roughness.map(|r| region.alpha_map.alpha(r)));
    let plan = TexelPlan::new(axes.clone(), region.alpha_map, SAMPLES, nodes, region.mu[0]);
    // Columns fastest, then slices, then nodes of alpha.
    let points = plan.points();
    let columns =
        points.iter().take_while(|p| (p.alpha, p.slice) == (points[0].alpha, points[0].slice)).count();
    let per_node = points.iter().take_while(|p| p.alpha == points[0].alpha).count();
    let alphas: Vec<f64> = points.iter().step_by(per_node).map(|p| p.alpha).collect();
    let aspects: Vec<f64> = points[..per_node].iter().step_by(columns).map(|p| aspect(p.slice)).collect();
    let mu = |column: usize, row: usize, _: f64| points[row * per_node + column].mu;
    let grid = Grid {
        columns: Columns::Varying { count: columns, mu: &mu },
        alphas: &alphas,
        aspects: &aspects,
        floor: 0.0,
    };
    let table = tabulate(*smith, &grid, TARGETS)?;
    let loss = |i: usize, _: &Node| {
        let (column, slice, node) = (i % columns, i / columns % aspects.len(), i / per_node);
        1.0 - table.e[(slice * alphas.len() + node) * columns + column]
    };
    let losses: Vec<f64> = points.iter().enumerate().map(|(i, p)| loss(i, p)).collect();
    let wanted = plan.targets(&losses);
    let checked = check(QUANTITY, &plan, CHECKED, [&wanted], |nodes| direct(*smith, nodes))?;
    let texels = plan.optimised(&wanted, ROUNDS).0;
    let made = Made {
        evaluations: made(&table).evaluations + checked.evaluations,
        integration: checked.worst + DIRECT,
    };
    Ok((spec.tables(QUANTITY, &axes, vec![vec![Channel::new("loss", texels)]])?, made))
}

/// Losses, within [`DIRECT`], and the evaluations that they took.
fn direct(smith: Smith, nodes: &[Node]) -> Result<(Vec<[f64; 1]>, u64), IntegrateError> {
    let loss = |node: &Node| {
        let aspect = aspect(node.slice);
        let work = mean(smith, [node.alpha / aspect, node.alpha * aspect], node.mu, DIRECT)?;
        Ok(([1.0 - work.value], work.evaluations))
    };
    let all: Vec<([f64; 1], u64)> = nodes.par_iter().map(loss).collect::<Result<_, IntegrateError>>()?;
    let evaluations = all.iter().map(|(_, n)| n).sum();
    Ok((all.into_iter().map(|(losses, _)| losses).collect(), evaluations))
}

/// The cubic of the azimuth at every texel, from exact values.
fn with_azimuth(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let (Spec { smith, region, .. }, size) = (spec, spec.sizes::<3>()?);
    let axes = azimuth_axes(size, region.roughness, region.slices()?.range);
    let surface = Surface::<f64>::rough(0.0);
    let rows: Vec<f64> = (0..size[1]).map(|i| region.alpha_map.alpha(axes[1].node(i, surface))).collect();
    let aspects: Vec<f64> = (0..size[2]).map(|i| aspect(axes[2].node(i, surface))).collect();
    // Below the region's mu a lookup at its edge still blends with a texel.
    let mu = [0.25 * region.mu[0], 1.0];
    let ends = [aspects[aspects.len() - 1], aspects[0]];
    let truth = truth::azimuthal(*smith, [rows[0], rows[rows.len() - 1]], ends, mu)?;
    let mut channels = [0, 1, 2, 3].map(|k| Channel::new(&format!("c{k}"), Vec::new()));
    for &aspect in &aspects {
        for &alpha in &rows {
            let (pinned, lobe) = (truth.pinned(alpha, aspect), Azimuth { alpha, aspect });
            for column in 0..size[0] {
                let losses: Vec<f64> = Azimuth::samples()
                    .into_iter()
                    .map(|t| {
                        let mu = node(&axes[0], column, lobe.alpha(t)).clamp(mu[0], mu[1]);
                        1.0 - pinned.at(mu, lobe.phi(t))
                    })
                    .collect();
                for (channel, coefficient) in channels.iter_mut().zip(Azimuth::cubic(&losses)) {
                    channel.texels.push(coefficient);
                }
            }
        }
    }
    let made = Made { evaluations: truth.evaluations(), integration: truth.worst() };
    Ok((spec.tables(QUANTITY, &axes, vec![channels.to_vec()])?, made))
}

/// mu of a column where the alpha towards the view is `towards`.
fn node(columns: &Axis, column: usize, towards: f64) -> f64 {
    columns.node(column, Surface::<f64>::rough(towards))
}
