//! Small tables made for the furnace: sampled, not optimised, in the layouts for the trilinear
//! lookup.

use lobefit::data::{AlphaMap, Axis, Channel, Smith, Surface, Table, TexelFormat};
use lobefit::effects::anisotropy::{Azimuth, aniso_axes, azimuth_axes};
use lobefit::effects::glass::glass_axes;
use lobefit::effects::table::aspect;
use lobefit_math::ops;
use lobefit_truth::integrate::glass::table::{self as glass, GlassGrid};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{GgxReflectionAniso, Quantity};

const ROUGHNESS: [f64; 2] = [0.02, 1.0];

/// Smallest cosine and alpha that the texels are integrated at.
const SMALLEST_MU: f64 = 1e-3;
const SMALLEST_ALPHA: f64 = 4e-4;

/// Of a texel.
const TOLERANCE: f64 = 1e-5;

fn nodes(axis: &Axis) -> Vec<f64> {
    (0..axis.size).map(|i| axis.node(i, Surface::<f64>::rough(1.0))).collect()
}

fn alphas(axis: &Axis) -> Vec<f64> {
    nodes(axis).into_iter().map(|r| AlphaMap::RoughnessSquared.alpha(r).max(SMALLEST_ALPHA)).collect()
}

/// The cosine of a column.
fn cosine(axis: &Axis, column: usize, surface: Surface<f64>) -> f64 {
    axis.node(column, surface).clamp(SMALLEST_MU, 1.0)
}

fn halves(
    name: String,
    quantity: &str,
    smith: Smith,
    axes: [Axis; 3],
    channels: Vec<(&str, Vec<f64>)>,
) -> Table {
    let channel = |(name, texels): (&str, Vec<f64>)| Channel { name: name.into(), texels };
    let table = Table {
        name,
        quantity: quantity.into(),
        smith: Some(smith),
        alpha_map: AlphaMap::RoughnessSquared,
        axes: axes.to_vec(),
        channels: channels.into_iter().map(channel).collect(),
        format: TexelFormat::F16,
    };
    table.validate().expect("a table");
    table.quantised()
}

fn losses(e: &[f64]) -> Vec<f64> {
    e.iter().map(|e| 1.0 - e).collect()
}

/// E at views (alpha, aspect, mu and azimuth), or in the mean over the azimuth.
fn metal(smith: Smith, views: &[(f64, f64, f64, f64)], azimuth: bool) -> Vec<f64> {
    let column = |of: fn(&(f64, f64, f64, f64)) -> f64| views.iter().map(of).collect::<Vec<f64>>();
    let inputs =
        [("alpha_x", column(|v| v.0 / v.1)), ("alpha_y", column(|v| v.0 * v.1)), ("mu", column(|v| v.2))];
    let phi = azimuth.then(|| ("phi", column(|v| v.3)));
    let points = Points::new(inputs.into_iter().chain(phi));
    let truth = GgxReflectionAniso.truth(&smith.into(), &points, &["E"], TOLERANCE).expect("E");
    let [e] = truth.arrays();
    e
}

/// The azimuth mean of the anisotropic lobe.
pub fn of_mean(smith: Smith) -> Table {
    let axes = aniso_axes([32, 32, 16], ROUGHNESS, [0.0, 1.0]);
    let mut views = Vec::new();
    for aspect in nodes(&axes[2]).into_iter().map(aspect) {
        for alpha in alphas(&axes[1]) {
            let surface = Surface::<f64>::rough(alpha);
            views.extend((0..axes[0].size).map(|x| (alpha, aspect, cosine(&axes[0], x, surface), 0.0)));
        }
    }
    let e = metal(smith, &views, false);
    let name = format!("furnace-mean-{}", smith.name());
    halves(name, "ggx-reflection-aniso", smith, axes, vec![("loss", losses(&e))])
}

/// The anisotropic lobe with the azimuth of the view, four channels.
pub fn of_azimuth(smith: Smith) -> Table {
    let axes = azimuth_axes([32, 16, 16], ROUGHNESS, [0.0, 1.0]);
    let mut views = Vec::new();
    for anisotropy in nodes(&axes[2]) {
        for alpha in alphas(&axes[1]) {
            let lobe = Azimuth { alpha, aspect: aspect(anisotropy) };
            for column in 0..axes[0].size {
                views.extend(Azimuth::samples().into_iter().map(|t| {
                    let phi = lobe.phi(t);
                    let cosine_phi = ops::cos(phi);
                    let surface = Surface { alpha, ior: 1.0, anisotropy, cos2_phi: cosine_phi * cosine_phi };
                    (alpha, lobe.aspect, cosine(&axes[0], column, surface), phi)
                }));
            }
        }
    }
    let cubics = losses(&metal(smith, &views, true));
    let cubics: Vec<[f64; 4]> = cubics.chunks(Azimuth::samples().len()).map(Azimuth::cubic).collect();
    let channel = |k: usize| cubics.iter().map(|cubic| cubic[k]).collect();
    let channels = [("c0", 0), ("c1", 1), ("c2", 2), ("c3", 3)].map(|(name, k)| (name, channel(k)));
    halves(format!("furnace-azimuth-{}", smith.name()), "ggx-reflection-aniso", smith, axes, channels.into())
}

/// Both sides of glass, outside first.
pub fn of_glass(smith: Smith) -> [Table; 2] {
    let axes = glass_axes([32, 32, 32], ROUGHNESS, [1.0, 2.0]);
    let alphas = alphas(&axes[1]);
    // The slices' ior depends on alpha, the texels' grid does not: one grid a row.
    let rows: Vec<glass::Tabulated> = alphas
        .iter()
        .map(|alpha| {
            let rough = Surface::<f64>::rough(*alpha);
            let iors: Vec<f64> = (0..axes[2].size).map(|z| axes[2].node(z, rough)).collect();
            let mu = |column: usize, alpha: f64, ior: f64| {
                cosine(&axes[0], column, Surface { alpha, ior, ..rough })
            };
            glass::tabulate(&GlassGrid {
                smith,
                alphas: &[*alpha],
                columns: axes[0].size,
                iors: &iors,
                mu: &mu,
                tolerance: TOLERANCE,
            })
            .expect("a row")
        })
        .collect();
    let columns = axes[0].size;
    let texels = |of: fn(&glass::Tabulated) -> &Vec<f64>| -> Vec<f64> {
        let line = |z: usize| rows.iter().flat_map(move |row| of(row)[z * columns..(z + 1) * columns].iter());
        (0..axes[2].size).flat_map(line).copied().collect()
    };
    let sides = [("outside", texels(|row| &row.outside)), ("inside", texels(|row| &row.inside))];
    sides.map(|(side, e)| {
        let name = format!("furnace-glass-{}-{side}", smith.name());
        halves(name, "ggx-glass", smith, axes.clone(), vec![("loss", losses(&e))])
    })
}
