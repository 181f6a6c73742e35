//! What a shader gets between the texels: linear interpolation, with the table's own registration
//! and with that of a texture unit.

use lobefit_math::ops;
use rayon::prelude::*;
use serde::Serialize;

use super::AuditError;
use super::axis::{AxisReading, Registration};
use super::column::Column;
use super::convention::Convention;
use super::errors::rms;
use super::sample::{Tensor, assigned};
use super::table::{AuditedTable, flat, place};
use super::truth::{Truth, Values};
use lobefit::data::Place;

/// Places along every axis at which lookups are judged: of one axis, of two and of three.
const PLACES: [usize; 3] = [1024, 160, 16];

/// Most places along each of three axes that lie midway between texels, where straight lines err most.
const MIDWAY: usize = 15;

/// Share of the way from an outermost texel to the next at which its own line or slice is looked up.
const AT_ENDS: f64 = 1e-6;

/// Error of a lookup of one channel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LookupErrors {
    /// Largest magnitude over the domain, closed in on from the worst of the places that were sampled.
    pub max: f64,
    /// Root mean square over evenly spaced coordinates.
    pub rms: f64,
    /// Signed mean.
    pub mean: f64,
    /// Largest magnitude between the outermost texels, where nothing is extrapolated.
    pub inner: f64,
    /// Where that is.
    pub inner_at: Place,
    /// Where the largest of all is.
    pub at: Place,
}

impl LookupErrors {
    /// Of two the one with the larger error, and between the outermost texels the larger of both.
    fn worse(self, other: LookupErrors) -> LookupErrors {
        let (inner, inner_at) = match other.inner > self.inner {
            true => (other.inner, other.inner_at.clone()),
            false => (self.inner, self.inner_at.clone()),
        };
        let worse = if other.max > self.max { other } else { self };
        LookupErrors { inner, inner_at, ..worse }
    }

    /// Whether the largest lies beyond the outermost texels.
    pub(super) fn is_beyond(&self) -> bool {
        self.max > 1.01 * self.inner
    }
}

/// The worst of the sampled places that are closed in on, and of 2 axes or fewer and of 3 how: places along
/// every axis on each side of one, what is left of the distance after a round, and rounds.
const STARTS: usize = 3;
const BESIDE: [(usize, f64, usize); 2] = [(3, 0.34, 4), (1, 0.5, 9)];

/// Places of lookups: coordinates in the table's axes, with the truth.
struct Grid {
    /// Coordinates along every axis of the table.
    coordinates: Vec<Vec<f64>>,
    /// Inputs there.
    inputs: Vec<Vec<f64>>,
    /// Base values, the table's first axis fastest.
    base: Values,
}

/// What is looked up: the values of one channel, and where the reader takes its texels to be.
pub(super) struct Look<'a> {
    /// Size of the table.
    pub size: &'a [usize],
    /// Its values.
    pub values: &'a [f64],
    /// What they hold.
    pub column: Column,
    /// What the reader takes the texels to be at; the table's own for none.
    pub registration: Option<Registration>,
}

/// The points of all lookups of a table under a convention.
pub(super) struct Points<'a> {
    truth: &'a Truth<'a>,
    convention: &'a Convention,
    lobe: usize,
    grid: Grid,
    /// Places that crowd towards the ends of the axes, and of three axes those midway between texels.
    others: Vec<Grid>,
}

impl<'a> Points<'a> {
    /// Evenly spaced coordinates over the part of the domain where the truth can be had.
    pub(super) fn new(
        truth: &'a Truth<'a>,
        convention: &'a Convention,
        lobe: usize,
        size: &[usize],
    ) -> Result<Points<'a>, AuditError> {
        let axes = &convention.axes;
        let is_solid = axes.len() == 3;
        // Of n even places some are centres of m texels if both have as many factors of 2: all of 16 in 16.
        let meets = |n: &usize| {
            let centred = axes.iter().zip(size).filter(|(axis, _)| axis.registration == Registration::Centre);
            centred.map(|(_, m)| m.trailing_zeros()).any(|twos| is_solid && twos == n.trailing_zeros())
        };
        let least = PLACES[axes.len() - 1];
        let n = (least..).find(|n| !meets(n)).unwrap_or(least);
        let even: Vec<f64> = (0..n).map(|k| (k as f64 + 0.5) / n as f64).collect();
        let of = |coordinates| Grid::new(truth, convention, lobe, coordinates);
        let grid = of(vec![even; axes.len()])?;
        let mut others = vec![of(vec![edges(usize::from(is_solid)); axes.len()])?];
        if is_solid {
            others.push(of(axes.iter().zip(size).map(|(axis, n)| midway(axis, *n)).collect())?);
        }
        Ok(Points { truth, convention, lobe, grid, others })
    }

    /// Errors of a lookup, the largest closed in on from the worst of the places; none where no
    /// place has a truth.
    pub(super) fn errors(&self, look: &Look) -> Result<Option<LookupErrors>, AuditError> {
        let errors = self.grid.errors(self.convention, look);
        let n = errors.len() as f64;
        let Some((max, at)) = self.largest(look, &errors, false)? else { return Ok(None) };
        let (inner, inner_at) = self.largest(look, &errors, true)?.unwrap_or_else(|| (0.0, at.clone()));
        Ok(Some(LookupErrors {
            max,
            at,
            inner,
            inner_at,
            rms: rms(errors.iter().map(|e| e.0)),
            mean: errors.iter().map(|e| e.0).sum::<f64>() / n,
        }))
    }

    /// Largest magnitude and root mean square at the even places alone.
    pub(super) fn even(&self, look: &Look) -> [f64; 2] {
        let errors = self.grid.errors(self.convention, look);
        let most = errors.iter().map(|e| e.0.abs()).fold(0.0, f64::max);
        [most, rms(errors.iter().map(|e| e.0))]
    }

    /// The largest magnitude, or the largest between the outermost texels, with its place; `errors` are
    /// those of the even places.
    fn largest(
        &self,
        look: &Look,
        errors: &[(f64, bool)],
        inner: bool,
    ) -> Result<Option<(f64, Place)>, AuditError> {
        let at_others: Vec<_> = self.others.iter().map(|grid| grid.errors(self.convention, look)).collect();
        let mut found: Option<(f64, Place)> = None;
        let others = self.others.iter().zip(at_others.iter().map(Vec::as_slice));
        for (grid, errors) in others.chain([(&self.grid, errors)]) {
            for start in worst(grid, errors, inner, STARTS) {
                let climbed = self.climbed(look, inner, (grid, start, errors[start].0.abs()))?;
                found = found.into_iter().chain([climbed]).reduce(|a, b| if b.0 > a.0 { b } else { a });
            }
        }
        Ok(found)
    }

    /// The largest magnitude about a place of a grid, which has one already.
    fn climbed(
        &self,
        look: &Look,
        inner: bool,
        (grid, start, error): (&Grid, usize, f64),
    ) -> Result<(f64, Place), AuditError> {
        let (beside, left, rounds) = BESIDE[usize::from(look.size.len() == 3)];
        let mut found = (error, grid.place(start, self.convention));
        let (mut centre, mut width) = grid.about(start);
        for _ in 0..rounds {
            let along = |(c, width): (&f64, &f64)| -> Vec<f64> {
                let at = |k: usize| c + width * (k as f64 / beside as f64 - 1.0);
                let mut list: Vec<f64> = (0..=2 * beside).map(|k| at(k).clamp(0.0, 1.0)).collect();
                list.dedup();
                list
            };
            let grid = self.at(centre.iter().zip(&width).map(along).collect())?;
            let errors = grid.errors(self.convention, look);
            if let [worst] = worst(&grid, &errors, inner, 1)[..]
                && errors[worst].0.abs() >= found.0
            {
                found = (errors[worst].0.abs(), grid.place(worst, self.convention));
                centre = grid.about(worst).0;
            }
            width.iter_mut().for_each(|width| *width *= left);
        }
        Ok(found)
    }

    /// The places of a product of coordinates.
    fn at(&self, coordinates: Vec<Vec<f64>>) -> Result<Grid, AuditError> {
        Grid::new(self.truth, self.convention, self.lobe, coordinates)
    }
}

/// Coordinates that crowd towards both ends, where lobes change most; fewer of three axes.
fn edges(class: usize) -> Vec<f64> {
    let half = [16, 4][class];
    let at = |k: usize| ops::pow(k as f64 / half as f64, 4.0) / 2.0;
    (0..=half).map(at).chain((0..half).rev().map(|k| 1.0 - at(k))).collect()
}

/// Coordinates midway between the texels of an axis, of many at some of them, and beside the outermost.
fn midway(axis: &AxisReading, n: usize) -> Vec<f64> {
    let mut texels: Vec<f64> = (0..n).map(|i| axis.coordinate(i, n)).collect();
    texels.sort_by(f64::total_cmp);
    texels.dedup();
    let between = |share: f64, k: usize| texels[k] + share * (texels[k + 1] - texels[k]);
    let cells = texels.len() - 1;
    let places = cells.min(MIDWAY);
    let cell = |k: usize| k * (cells - 1) / (places - 1).max(1);
    let inside = (0..places).map(|k| between(0.5, cell(k)));
    [between(AT_ENDS, 0)].into_iter().chain(inside).chain([between(1.0 - AT_ENDS, cells - 1)]).collect()
}

/// Places of the largest, the first of them largest, no two of them neighbours.
fn worst(grid: &Grid, errors: &[(f64, bool)], inner: bool, most: usize) -> Vec<usize> {
    let dims = grid.dims();
    let mut found: Vec<usize> = Vec::new();
    for _ in 0..most {
        let apart = |i: &usize| {
            let near =
                |j: &usize| place(*i, &dims).iter().zip(place(*j, &dims)).all(|(a, b)| a.abs_diff(b) <= 2);
            (!inner || errors[*i].1) && !found.iter().any(near)
        };
        let larger = |a: usize, b: usize| if errors[b].0.abs() > errors[a].0.abs() { b } else { a };
        found.extend((0..errors.len()).filter(apart).reduce(larger));
    }
    found
}

impl Grid {
    /// The places of a product of coordinates at which the truth can be had.
    fn new(
        truth: &Truth,
        convention: &Convention,
        lobe: usize,
        all: Vec<Vec<f64>>,
    ) -> Result<Grid, AuditError> {
        let (mut coordinates, mut inputs) = (Vec::new(), Vec::new());
        for (axis, list) in convention.axes.iter().zip(all) {
            let input = axis.scale.input();
            let kept: Vec<(f64, f64)> = list
                .into_iter()
                .map(|u| (u, axis.scale.input_at(u).max(axis.floor)))
                .filter(|(_, x)| truth.judges(lobe, input, *x))
                .collect();
            coordinates.push(kept.iter().map(|k| k.0).collect());
            inputs.push(kept.iter().map(|k| k.1).collect::<Vec<f64>>());
        }
        if inputs.iter().any(Vec::is_empty) {
            return Ok(Grid { coordinates, inputs, base: Vec::new() });
        }
        let assigned = assigned(truth, &convention.axes);
        let at: Vec<&Vec<f64>> = assigned.iter().map(|axis| &inputs[*axis]).collect();
        let dims: Vec<usize> = inputs.iter().map(Vec::len).collect();
        let base = Tensor::new(truth, lobe, &at, &assigned, Truth::ranked)?.gathered(0, &dims);
        Ok(Grid { coordinates, inputs, base })
    }

    /// Signed errors at all places, and whether each lies between the outermost texels.
    fn errors(&self, convention: &Convention, look: &Look) -> Vec<(f64, bool)> {
        let dims = self.dims();
        let position = |(k, axis): (usize, &AxisReading)| -> Vec<f64> {
            let registration = look.registration.unwrap_or(axis.registration);
            self.coordinates[k].iter().map(|x| axis.position(*x, look.size[k], registration)).collect()
        };
        let positions: Vec<Vec<f64>> = convention.axes.iter().enumerate().map(position).collect();
        let one = |i: usize| {
            let at: Vec<f64> = place(i, &dims).iter().zip(&positions).map(|(k, p)| p[*k]).collect();
            let inner = at.iter().zip(look.size).all(|(p, n)| *p > 0.0 && *p < (n - 1) as f64);
            (fetch(look.values, look.size, &at) - look.column.value(self.base[i]), inner)
        };
        (0..self.base.len()).into_par_iter().map(one).collect()
    }

    fn dims(&self) -> Vec<usize> {
        self.inputs.iter().map(Vec::len).collect()
    }

    /// The coordinates of a place, and how far its neighbours lie along every axis.
    fn about(&self, i: usize) -> (Vec<f64>, Vec<f64>) {
        let gap = |list: &[f64], k: usize| {
            let below = k.checked_sub(1).map(|b| list[k] - list[b]);
            let above = list.get(k + 1).map(|above| above - list[k]);
            below.into_iter().chain(above).fold(0.0, f64::max)
        };
        let places = place(i, &self.dims());
        let along = places.iter().zip(&self.coordinates);
        along.map(|(k, list)| (list[*k], gap(list, *k))).unzip()
    }

    fn place(&self, i: usize, convention: &Convention) -> Place {
        let places = place(i, &self.dims());
        let named = convention.axes.iter().enumerate();
        named.map(|(k, a)| (a.scale.input().name().to_string(), self.inputs[k][places[k]])).collect()
    }
}

/// The lookup of f0 A + B at the worst f0 in [0, 1], of a table of A and B: it is linear in f0, so that
/// the worst is that of B or that of their sum.
pub(super) fn blended(
    points: &Points,
    table: &AuditedTable,
    convention: &Convention,
) -> Result<Option<LookupErrors>, AuditError> {
    let channel = |wanted: Column| convention.columns.iter().position(|c| *c == Some(wanted));
    let (Some(a), Some(b)) = (channel(Column::A), channel(Column::B)) else { return Ok(None) };
    let [a, b] = [a, b].map(|k| &table.channels[k].values);
    let sum: Vec<f64> = a.iter().zip(b.iter()).map(|(a, b)| a + b).collect();
    let look = |values, column| Look { size: &table.size, values, column, registration: None };
    let [bias, all] = [look(b, Column::B), look(&sum, Column::E)].map(|look| points.errors(&look));
    Ok(bias?.into_iter().chain(all?).reduce(LookupErrors::worse))
}

/// Linear interpolation at a position in texels.
pub(super) fn fetch(values: &[f64], size: &[usize], at: &[f64]) -> f64 {
    let mut sum = 0.0;
    for corner in 0..1_usize << size.len() {
        let (mut weight, mut texel) = (1.0, vec![0; size.len()]);
        for k in 0..size.len() {
            let base = (at[k].floor() as usize).min(size[k] - 1);
            let share = at[k] - base as f64;
            let up = corner >> k & 1;
            weight *= if up == 1 { share } else { 1.0 - share };
            texel[k] = (base + up).min(size[k] - 1);
        }
        if weight > 0.0 {
            sum += weight * values[flat(&texel, size)];
        }
    }
    sum
}
