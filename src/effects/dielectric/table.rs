//! Texels of R over mu, roughness and the index of refraction.
//!
//! A smooth surface reflects Fresnel's F, which rises to 1 over a range of mu that no axis made for the layer
//! mu ~ alpha resolves. Away from that layer a rough lobe reflects nearly as much, and inside it a part
//! that depends on mu/alpha alone. So the table holds
//!
//!   deficit = 1 - R/F(mu, ior),   R = (1 - deficit) F,
//!
//! along the columns of the homogeneous layout: of 32^3 exact texels a twentieth of the error of R itself
//! over mu (0.0041 and 0.075 over roughness 0.02 to 1, mu from 0.001, ior 1.1 to 2.5). It is below 0 where
//! facets that are seen at grazing reflect more than the surface as a whole.

use crate::data::{Axis, Channel, Table, Warp};
use crate::effects::table::{
    BuildError, Node, ROUNDS, Spec, TexelPlan, Values, alpha_nodes, check, ior_axis,
};
use lobefit_fit::texels::Wanted;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::fresnel::dielectric;

/// Targets drawn for their check.
const CHECKED: usize = 1 << 13;

/// Samples per cell that the texels are optimised on: four from row to row, where the error is; fewer in
/// tables of more texels than `LARGE`, whose cells hold less curvature and whose samples would fill the
/// memory.
const SAMPLES: [[usize; 3]; 2] = [[2, 4, 2], [2, 2, 1]];
const LARGE: usize = 1 << 18;

/// Least index of refraction of a texel: at 1 nothing is reflected, and a part of nothing has no value.
/// Below it a lookup may be off by all of R at grazing, as the certificate of such a table says.
const LEAST_IOR: f64 = 1.0001;

/// The table of a spec.
///
/// # Errors
/// A truth that cannot be integrated; a size of another number of axes; a region without slices.
pub fn texels(quantity: &'static str, spec: &Spec, values: &Values) -> Result<(Vec<Table>, f64), BuildError> {
    let [columns, rows, slices] = spec.sizes()?;
    let region = &spec.region;
    let axes = [
        Axis::ends("mu", columns, Warp::Homogeneous, [0.0, 1.0]),
        Axis::ends("roughness", rows, Warp::Linear, region.roughness),
        ior_axis(slices, region.slices()?.range),
    ];
    let nodes = 2 * alpha_nodes(region.roughness.map(|r| region.alpha_map.alpha(r)));
    let samples = SAMPLES[usize::from(columns * rows * slices > LARGE)];
    let plan = TexelPlan::new(axes.clone(), region.alpha_map, samples, nodes, region.mu[0]);
    let reflected = |nodes: &[Node]| {
        let places: Vec<[f64; 3]> = nodes.iter().map(|p| [p.alpha, p.mu, p.slice.max(LEAST_IOR)]).collect();
        values(&places)
    };
    let points = plan.points();
    let deficits: Vec<f64> =
        reflected(&points)?.iter().zip(&points).map(|(r, node)| 1.0 - r / smooth(node)).collect();
    let Wanted { targets, weights } = plan.targets(&deficits);
    let parts = plan.of_samples(smooth);
    // What a lookup returns is the deficit times the smooth surface's part.
    let counted = weights.iter().zip(&parts).map(|(weight, part)| weight * part).collect();
    let of_r = targets.iter().zip(&parts).map(|(deficit, part)| (1.0 - deficit) * part).collect();
    let (wanted, of_r) = (Wanted { targets, weights: counted }, Wanted { targets: of_r, weights });
    let checked = check(quantity, &plan, CHECKED, [&of_r], |nodes| {
        Ok::<_, IntegrateError>((reflected(nodes)?.into_iter().map(|r| [r]).collect(), 0))
    })?;
    let channels = vec![Channel::new("deficit", plan.optimised(&wanted, ROUNDS).0)];
    Ok((spec.tables(quantity, &axes, vec![channels])?, checked.worst))
}

/// What a smooth surface reflects.
fn smooth(node: &Node) -> f64 {
    dielectric(node.slice.max(LEAST_IOR), node.mu)
}
