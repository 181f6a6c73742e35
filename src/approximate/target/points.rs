//! Points of a target's axes: lattices to fit on, and others to measure at.

use super::spec::{ROUGHNESS, Span};
use crate::approximate::{PointSet, Region, certification, edged, layer_mu, uniform};
use crate::data::{AlphaMap, Place, shortest};
use lobefit_math::chebyshev;
use lobefit_math::recurrence::Recurrence;

/// Inputs as a shader has them, in f32, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// Names and values; all columns are as long.
    pub columns: Vec<(String, Vec<f32>)>,
    /// The first `uniform` points are uniform in the axes: RMS and mean are taken over them.
    pub uniform: usize,
}

/// How many points there are, by what a truth costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Effort {
    /// Points of a lattice, about.
    pub lattice: usize,
    /// Binary logarithm of the number of uniform points to measure at.
    pub log2: u32,
}

impl Points {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The column of an input.
    pub fn column(&self, name: &str) -> Option<&[f32]> {
        self.columns.iter().find(|(n, _)| n == name).map(|(_, column)| column.as_slice())
    }

    /// Point `i` by input name, each in the shortest decimal that reads back to its f32.
    pub fn place(&self, i: usize) -> Place {
        self.columns.iter().map(|(name, column)| (name.clone(), shortest(column[i]))).collect()
    }

    /// The points in the order given, every axis with its value; alpha is added where roughness is an axis that makes it.
    pub(super) fn of(axes: &[Span], alpha: Option<AlphaMap>, places: &[Vec<f64>]) -> Points {
        let column = |k: usize| places.iter().map(|place| place[k] as f32).collect();
        let columns = axes.iter().enumerate().map(|(k, axis)| (axis.name.clone(), column(k)));
        Points { columns: columns.collect(), uniform: places.len() }.with_alpha(alpha)
    }

    fn with_alpha(mut self, map: Option<AlphaMap>) -> Points {
        if let (Some(map), Some(roughness)) = (map, self.column(ROUGHNESS)) {
            let alpha = roughness.iter().map(|r| map.alpha_f32(*r)).collect();
            self.columns.push(("alpha".into(), alpha));
        }
        self
    }

    /// The points that are kept, in order.
    pub(super) fn kept(self, keep: &[bool]) -> Points {
        let of = |column: Vec<f32>| {
            column.into_iter().zip(keep).filter(|(_, keep)| **keep).map(|(x, _)| x).collect()
        };
        let uniform = keep[..self.uniform].iter().filter(|keep| **keep).count();
        Points {
            columns: self.columns.into_iter().map(|(name, column)| (name, of(column))).collect(),
            uniform,
        }
    }

    fn of_set(set: PointSet) -> Points {
        let uniform = set.uniform;
        let columns = [(ROUGHNESS, set.roughness), ("mu", set.mu), ("alpha", set.alpha)];
        Points { columns: columns.map(|(name, column)| (name.to_string(), column)).to_vec(), uniform }
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
        return Points::of_set(uniform(&region, n));
    }
    let nodes = |axis: &Span| -> Vec<f64> {
        let n = if axis.is_spanned() { n } else { 1 };
        (0..n).map(|i| axis.at((i as f64 + 0.5) / n as f64)).collect()
    };
    Points::of(axes, alpha, &product(&axes.iter().map(nodes).collect::<Vec<_>>()))
}

/// A lattice with the edges, denser towards them; where there is a layer mu ~ alpha, half of it in the homogeneous coordinate.
pub(super) fn with_edges(axes: &[Span], alpha: Option<AlphaMap>, effort: Effort) -> Points {
    let n = per_axis(axes, effort);
    if let Some(region) = region(axes, alpha) {
        return Points::of_set(edged(&region, n));
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
    Points::of(axes, alpha, &places)
}

/// Binary logarithm of the number of points where a truth costs a microsecond or less.
pub(super) const MANY: u32 = 20;

/// Uniform points, half as many in the layer mu ~ alpha, and points on every face: none inside the box that is fitted on.
pub(super) fn measured(axes: &[Span], alpha: Option<AlphaMap>, effort: Effort) -> Points {
    if let Some(region) = region(axes, alpha) {
        return Points::of_set(certification(&region, effort.log2));
    }
    if let ([axis], Some(alpha_map)) = (axes, alpha)
        && axis.name == ROUGHNESS
        && axis.is_spanned()
        && effort.log2 == MANY
    {
        // The points of two axes, without mu: an average is measured where the albedo is.
        let region = Region { roughness: axis.range, mu: [1.0, 1.0], alpha_map };
        let mut points = Points::of_set(certification(&region, effort.log2));
        points.columns.retain(|(name, _)| name != "mu");
        return points;
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
    Points { uniform, ..Points::of(axes, alpha, &places) }
}

/// Nodes of each axis that is spanned, so that the lattice has about as many points as the effort says; 1 where none is.
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
