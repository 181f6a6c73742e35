//! Which points a table of three axes needs, and its texels from their values.
//!
//! At a fixed column and slice the loss is a smooth function of ln(alpha), all the more since the
//! warps follow the layers that move with it. So the truth is wanted at a few Chebyshev nodes of
//! ln(alpha) only, for every column and slice of the lattice of samples, and interpolated to its
//! rows.

use rayon::prelude::*;

use crate::data::{AlphaMap, Axis, Surface};
use lobefit_fit::texels::{self, Lattice, Wanted};
use lobefit_math::chebyshev::{self, Chebyshev};
use lobefit_math::ops;

/// A point at which the truth is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Cosine of the view, in [a quarter of the region's smallest, 1].
    pub mu: f64,
    /// GGX width.
    pub alpha: f64,
    /// Physical value of the axis of the slices: anisotropy or ior.
    pub slice: f64,
}

/// A table of three axes: mu, roughness, and ior or anisotropy.
#[derive(Clone, Debug, PartialEq)]
pub struct TexelPlan {
    axes: [Axis; 3],
    lattice: Lattice,
    alpha_map: AlphaMap,
    smallest_mu: f64,
    nodes: Vec<f64>,
}

impl TexelPlan {
    /// Samples `per_cell` along each axis, of slices one or more; `nodes` Chebyshev nodes in ln(alpha), at
    /// least 2; lookups count from `smallest_mu` on.
    ///
    /// # Panics
    /// If the smallest roughness is not above 0, where ln(alpha) ends.
    pub fn new(
        axes: [Axis; 3],
        alpha_map: AlphaMap,
        per_cell: [usize; 3],
        nodes: usize,
        smallest_mu: f64,
    ) -> TexelPlan {
        assert!(axes[1].min > 0.0, "a table of three axes begins at a roughness above 0");
        let size = axes.iter().map(|axis| axis.size).collect();
        let lattice = Lattice { size, per_cell: per_cell.to_vec(), beyond: vec![0; 3] };
        let [low, high] = [axes[1].min, axes[1].max].map(|r| alpha_map.alpha(r));
        let ends = [low, high];
        let mut nodes: Vec<f64> =
            chebyshev::nodes(ops::log(low), ops::log(high), nodes).into_iter().map(ops::exp).collect();
        let last = nodes.len() - 1;
        (nodes[0], nodes[last]) = (ends[0], ends[1]);
        TexelPlan { axes, lattice, alpha_map, smallest_mu, nodes }
    }

    /// The points whose values [`TexelPlan::texels`] takes: columns fastest, then slices, then
    /// nodes of alpha.
    pub fn points(&self) -> Vec<Node> {
        let [columns, _, slices] = self.samples();
        let mut points = Vec::with_capacity(columns * slices * self.nodes.len());
        for alpha in &self.nodes {
            for slice in 0..slices {
                points.extend((0..columns).map(|column| self.point(column, slice, *alpha)));
            }
        }
        points
    }

    /// Texels from the losses at the points: optimised for the trilinear lookup in `rounds`, or
    /// exact at the texels with 0 rounds. Also the largest error over the lattice.
    ///
    /// # Panics
    /// If there are not as many losses as points.
    pub fn texels(&self, losses: &[f64], rounds: usize) -> (Vec<f64>, f64) {
        self.optimised(&self.targets(losses), rounds)
    }

    /// What the lattice should hold: the losses interpolated to its rows, columns fastest, then
    /// rows, then slices; and which samples count. [`check`](super::check) tells how far the
    /// interpolation is off.
    ///
    /// # Panics
    /// If there are not as many losses as points.
    pub fn targets(&self, losses: &[f64]) -> Wanted {
        let [columns, rows, slices] = self.samples();
        assert_eq!(losses.len(), columns * slices * self.nodes.len(), "a loss for each point");
        let alphas: Vec<f64> = (0..rows).map(|row| self.alpha(row)).collect();
        let ends = [self.nodes[0], self.nodes[self.nodes.len() - 1]].map(ops::log);
        let mut targets = vec![0.0; columns * rows * slices];
        let mut weights = vec![0.0; columns * rows * slices];
        let planes = targets.par_chunks_mut(columns * rows).zip(weights.par_chunks_mut(columns * rows));
        planes.enumerate().for_each(|(slice, (targets, weights))| {
            for column in 0..columns {
                let at = |node: usize| losses[(node * slices + slice) * columns + column];
                let along = Chebyshev::new(ends[0], ends[1], (0..self.nodes.len()).map(at).collect());
                for (row, alpha) in alphas.iter().enumerate() {
                    targets[row * columns + column] = along.at(ops::log(*alpha).clamp(ends[0], ends[1]));
                }
            }
            for (weights, alpha) in weights.chunks_exact_mut(columns).zip(&alphas) {
                weights[self.first_column(slice, *alpha)..].fill(1.0);
            }
        });
        Wanted { targets, weights }
    }

    /// Texels for targets of this plan, as [`TexelPlan::texels`] gives them.
    pub fn optimised(&self, wanted: &Wanted, rounds: usize) -> (Vec<f64>, f64) {
        let Lattice { size, per_cell, beyond } = &self.lattice;
        // One slice is no axis to look up along.
        let axes = size.iter().filter(|n| **n > 1).count();
        let [size, per_cell, beyond] = [size, per_cell, beyond].map(|all| all[..axes].to_vec());
        texels::optimise(
            &Lattice { size, per_cell, beyond },
            &self.at_texels(&wanted.targets),
            wanted,
            rounds,
        )
    }

    /// A function of every sample of the lattice, in the order of [`TexelPlan::targets`].
    pub fn of_samples(&self, value: impl Fn(&Node) -> f64 + Sync) -> Vec<f64> {
        let [columns, rows, slices] = self.samples();
        let at = |i: usize| value(&self.sample([i % columns, i / columns % rows, i / columns / rows]));
        (0..columns * rows * slices).into_par_iter().map(at).collect()
    }

    /// Columns, rows and slices of the lattice.
    pub fn samples(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| (self.axes[axis].size - 1) * self.lattice.per_cell[axis] + 1)
    }

    /// The point of a sample of the lattice: column, row, slice.
    pub fn sample(&self, [column, row, slice]: [usize; 3]) -> Node {
        // The sums of the axis round; the ends are nodes.
        let alpha = self.alpha(row).clamp(self.nodes[0], self.nodes[self.nodes.len() - 1]);
        self.point(column, slice, alpha)
    }

    /// The first column of samples near which a lookup of the region comes: mu rises along them.
    fn first_column(&self, slice: usize, alpha: f64) -> usize {
        let last = self.samples()[0] - 1;
        let (mut low, mut high) = (0, last + 1);
        while low < high {
            let middle = (low + high) / 2;
            if self.mu((middle + 1).min(last), slice, alpha) > self.smallest_mu {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        low
    }

    fn at_texels(&self, samples: &[f64]) -> Vec<f64> {
        let ([columns, rows, _], step) = (self.samples(), &self.lattice.per_cell);
        let [x, y, z] = [0, 1, 2].map(|axis| self.axes[axis].size);
        let at = |i: usize| {
            let (column, row, slice) = (i % x * step[0], i / x % y * step[1], i / x / y * step[2]);
            samples[(slice * rows + row) * columns + column]
        };
        (0..x * y * z).map(at).collect()
    }

    fn unit(&self, axis: usize, sample: usize) -> f64 {
        self.lattice.position(axis, sample) / (self.axes[axis].size - 1).max(1) as f64
    }

    fn alpha(&self, row: usize) -> f64 {
        let roughness = self.axes[1].physical(self.unit(1, row), Surface::<f64>::rough(0.0));
        self.alpha_map.alpha(roughness)
    }

    fn slice(&self, slice: usize, alpha: f64) -> f64 {
        self.axes[2].physical(self.unit(2, slice), Surface::<f64>::rough(alpha))
    }

    fn mu(&self, column: usize, slice: usize, alpha: f64) -> f64 {
        let slice = self.slice(slice, alpha);
        let ior = if self.axes[2].name == "ior" { slice } else { 1.0 };
        self.axes[0].physical(self.unit(0, column), Surface { ior, ..Surface::<f64>::rough(alpha) })
    }

    fn point(&self, column: usize, slice: usize, alpha: f64) -> Node {
        let mu = self.mu(column, slice, alpha).clamp(0.25 * self.smallest_mu, 1.0);
        Node { mu, alpha, slice: self.slice(slice, alpha) }
    }
}
