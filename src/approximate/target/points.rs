//! Points of a target's axes: lattices to fit on, and others to measure at.

use super::spec::{ROUGHNESS, Span};
use crate::approximate::{Region, certification, edged, layer_mu, uniform};
use crate::data::{AlphaMap, Place};
use lobefit_math::chebyshev;
use lobefit_math::recurrence::Recurrence;
use lobefit_truth::points::Points;

/// How many points there are, by what a truth costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Effort {
    /// Points of a lattice, about.
    pub lattice: usize,
    /// Binary logarithm of the number of uniform points to measure at.
    pub log2: u32,
}

/// The points in the order given, every axis with its value as a shader has it; alpha is added
/// where roughness is an axis that makes it.
pub(super) fn of(axes: &[Span], alpha: Option<AlphaMap>, places: &[Vec<f64>]) -> Points {
    let column = |k: usize| places.iter().map(|place| f64::from(place[k] as f32)).collect();
    let points = Points::new(axes.iter().enumerate().map(|(k, axis)| (axis.name.as_str(), column(k))));
    match (alpha, points.column_f32(ROUGHNESS)) {
        (Some(map), Some(roughness)) => {
            let alpha = roughness.iter().map(|r| f64::from(map.alpha_f32(*r))).collect();
            points.with("alpha", alpha)
        }
        _ => points,
    }
}

/// The region of a target whose axes are roughness and mu, both of more than one value.
fn region(axes: &[Span], alpha: Option<AlphaMap>) -> Option<Region> {
    match axes {
        [r, m] if r.name == ROUGHNESS && m.name == "mu" && r.is_spanned() && m.is_spanned() => {
            Some(Region { roughness: r.range, mu: m.range, alpha_map: alpha? })
        }
        _ => None,
    }
}

/// Centres of equal cells: their mean square is the midpoint rule of the uniform RMS.
pub(super) fn even(axes: &[Span], alpha: Option<AlphaMap>, effort: Effort) -> Points {
    let n = per_axis(axes, effort);
    if let Some(region) = region(axes, alpha) {
        return uniform(&region, n);
    }
    let nodes = |axis: &Span| -> Vec<f64> {
        let n = if axis.is_spanned() { n } else { 1 };
        (0..n).map(|i| axis.at((i as f64 + 0.5) / n as f64)).collect()
    };
    of(axes, alpha, &product(&axes.iter().map(nodes).collect::<Vec<_>>()))
}

/// A lattice with the edges, denser towards them; where there is a layer mu ~ alpha, half of it in
/// the homogeneous coordinate.
pub(super) fn with_edges(axes: &[Span], alpha: Option<AlphaMap>, effort: Effort) -> Points {
    let n = per_axis(axes, effort);
    if let Some(region) = region(axes, alpha) {
        return edged(&region, n);
    }
    let mut places = product(&axes.iter().map(|axis| ends_and_between(axis, n)).collect::<Vec<_>>());
    if let Some(layer) = Layer::of(axes, alpha) {
        let half = |k: usize, axis: &Span| match k == layer.mu {
            true => (0..n.div_ceil(2)).map(|i| (i as f64 + 0.5) / n.div_ceil(2) as f64).collect(),
            false => ends_and_between(axis, n),
        };
        let mut inside = product(&axes.iter().enumerate().map(|(k, a)| half(k, a)).collect::<Vec<_>>());
        inside.iter_mut().for_each(|place| layer.move_into(axes, place));
        places.extend(inside);
    }
    of(axes, alpha, &places)
}

/// Binary logarithm of the number of points where a truth costs a microsecond or less.
pub(super) const MANY: u32 = 20;

/// Uniform points, half as many in the layer mu ~ alpha, and points on every face: none inside the
/// box that is fitted on.
pub(super) fn measured(axes: &[Span], alpha: Option<AlphaMap>, effort: Effort) -> Points {
    if let Some(region) = region(axes, alpha) {
        return certification(&region, effort.log2);
    }
    if let ([axis], Some(alpha_map)) = (axes, alpha)
        && axis.name == ROUGHNESS
        && axis.is_spanned()
        && effort.log2 == MANY
    {
        // The points of two axes, without mu: an average is measured where the albedo is.
        let region = Region { roughness: axis.range, mu: [1.0, 1.0], alpha_map };
        return certification(&region, effort.log2).without("mu");
    }
    let count = 1_usize << effort.log2;
    let sequence = Recurrence::new(axes.len());
    let place = |i: usize| -> Vec<f64> {
        axes.iter().enumerate().map(|(k, axis)| axis.at(sequence.coordinate(i, k))).collect()
    };
    let mut places: Vec<Vec<f64>> = (0..count).map(place).collect();
    let uniform = places.len();
    if let Some(layer) = Layer::of(axes, alpha) {
        places.extend((count..count + count / 2).map(|i| {
            let mut place = place(i);
            place[layer.mu] = sequence.coordinate(i, layer.mu);
            layer.move_into(axes, &mut place);
            place
        }));
    }
    let faces = (count / 16).max(1);
    for (k, axis) in axes.iter().enumerate().filter(|(_, axis)| axis.is_spanned()) {
        for (side, end) in axis.range.into_iter().enumerate() {
            let start = 2 * count + (2 * k + side) * faces;
            places.extend((start..start + faces).map(|i| {
                let mut place = place(i);
                place[k] = end;
                place
            }));
        }
    }
    places.extend(product(&axes.iter().map(|a| a.range.to_vec()).collect::<Vec<_>>()));
    let mut points = of(axes, alpha, &places);
    points.uniform = uniform;
    points
}

/// Points in a box about a place, as wide as a part of each axis and cut at its ends, and the place
/// itself.
pub(super) fn near(
    axes: &[Span],
    alpha: Option<AlphaMap>,
    place: &Place,
    (width, count): (f64, usize),
) -> Points {
    let sequence = Recurrence::new(axes.len());
    let centre: Vec<f64> = axes.iter().map(|axis| axis.part(place[&axis.name])).collect();
    let part = |i: usize, k: usize| (centre[k] + width * (sequence.coordinate(i, k) - 0.5)).clamp(0.0, 1.0);
    let about =
        |i: usize| -> Vec<f64> { axes.iter().enumerate().map(|(k, axis)| axis.at(part(i, k))).collect() };
    let itself = axes.iter().map(|axis| place[&axis.name]).collect();
    of(axes, alpha, &std::iter::once(itself).chain((0..count).map(about)).collect::<Vec<_>>())
}

/// Nodes of each axis that is spanned, so that the lattice has about as many points as the effort
/// says; 1 without a weight.
fn per_axis(axes: &[Span], effort: Effort) -> usize {
    let spanned = axes.iter().filter(|axis| axis.is_spanned()).count();
    if spanned == 0 {
        return 1;
    }
    let fits = |n: usize| {
        (0..spanned).try_fold(1_usize, |all, _| all.checked_mul(n)).is_some_and(|all| all <= effort.lattice)
    };
    (2..=effort.lattice).take_while(|n| fits(*n)).last().unwrap_or(2)
}

fn ends_and_between(axis: &Span, n: usize) -> Vec<f64> {
    if !axis.is_spanned() {
        return vec![axis.range[0]];
    }
    let [low, high] = axis.coordinates();
    chebyshev::nodes(low, high, n.max(2)).into_iter().map(|x| axis.value(x)).collect()
}

/// All combinations, the last axis fastest.
fn product(axes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    axes.iter().fold(vec![Vec::new()], |places, axis| {
        let longer = |place: &Vec<f64>| {
            axis.iter().map(|x| place.iter().copied().chain([*x]).collect()).collect::<Vec<Vec<f64>>>()
        };
        places.iter().flat_map(longer).collect()
    })
}

/// Where mu and alpha are inputs, values change fastest about mu ~ alpha.
struct Layer {
    mu: usize,
    roughness: usize,
    map: AlphaMap,
}

impl Layer {
    fn of(axes: &[Span], alpha: Option<AlphaMap>) -> Option<Layer> {
        let find = |name: &str| axes.iter().position(|a| a.name == name && a.is_spanned());
        Some(Layer {
            mu: find("mu")?,
            roughness: axes.iter().position(|a| a.name == ROUGHNESS)?,
            map: alpha?,
        })
    }

    /// Takes a place's mu for a fraction of the range of the homogeneous coordinate.
    fn move_into(&self, axes: &[Span], place: &mut [f64]) {
        let alpha = self.map.alpha(place[self.roughness]);
        place[self.mu] = layer_mu(axes[self.mu].range, alpha, place[self.mu]);
    }
}
