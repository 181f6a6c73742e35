//! What a shader gets between the texels: linear interpolation, with the table's own registration
//! and with that of a texture unit.

use rayon::prelude::*;
use serde::Serialize;

use super::AuditError;
use super::axis::Registration;
use super::column::Column;
use super::convention::Convention;
use super::table::{AuditedTable, flat, place};
use super::truth::Truth;
use lobefit::data::Place;

/// Places along every axis at which lookups are judged: of one axis, of two and of three.
const PLACES: [usize; 3] = [1024, 160, 24];

/// Error of a lookup of one channel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LookupErrors {
    /// Largest magnitude over the domain.
    pub max: f64,
    /// Root mean square over evenly spaced coordinates.
    pub rms: f64,
    /// Signed mean.
    pub mean: f64,
    /// Largest magnitude between the outermost texels, where nothing is extrapolated.
    pub inner: f64,
    /// Where the largest is.
    pub at: Place,
}

/// The points of all lookups: coordinates in the table's axes, with the truth.
pub(super) struct Points {
    /// Coordinates along every axis of the table.
    coordinates: Vec<Vec<f64>>,
    /// Inputs there.
    inputs: Vec<Vec<f64>>,
    /// Base values, the table's first axis fastest.
    base: Vec<[f64; 2]>,
}

impl Points {
    /// Evenly spaced coordinates over the part of the domain where the truth can be had.
    pub(super) fn new(truth: &Truth, convention: &Convention, lobe: usize) -> Result<Points, AuditError> {
        let n = PLACES[convention.axes.len() - 1];
        let coordinate = |k: usize| (k as f64 + 0.5) / n as f64;
        let (mut coordinates, mut inputs) = (Vec::new(), Vec::new());
        for axis in &convention.axes {
            let input = axis.scale.input();
            let kept: Vec<(f64, f64)> = (0..n)
                .map(|k| (coordinate(k), axis.scale.input_at(coordinate(k)).max(axis.floor)))
                .filter(|(_, x)| truth.judges(lobe, input, *x))
                .collect();
            coordinates.push(kept.iter().map(|k| k.0).collect());
            inputs.push(kept.iter().map(|k| k.1).collect::<Vec<f64>>());
        }
        let order: Vec<usize> = truth
            .inputs()
            .iter()
            .map(|i| convention.axes.iter().position(|a| a.scale.input() == *i).unwrap_or(0))
            .collect();
        let at: Vec<&[f64]> = order.iter().map(|axis| inputs[*axis].as_slice()).collect();
        let values = truth.exact(lobe, &at)?;
        let lengths: Vec<usize> = at.iter().map(|a| a.len()).collect();
        let steps = super::sample::steps(&lengths, &order);
        let dims: Vec<usize> = inputs.iter().map(Vec::len).collect();
        let base = super::sample::View { values: &values, steps, start: 0 }.gather(&dims);
        Ok(Points { coordinates, inputs, base })
    }

    /// Errors of a channel's lookup; `registration` is what the reader takes the texels to be at,
    /// its own for none.
    pub(super) fn errors(
        &self,
        audited: &AuditedTable,
        channel: usize,
        column: Column,
        convention: &Convention,
        registration: Option<Registration>,
    ) -> Option<LookupErrors> {
        let dims: Vec<usize> = self.inputs.iter().map(Vec::len).collect();
        let positions: Vec<Vec<f64>> = convention
            .axes
            .iter()
            .enumerate()
            .map(|(k, axis)| {
                let n = audited.size[k];
                self.coordinates[k]
                    .iter()
                    .map(|x| axis.position(*x, n, registration.unwrap_or(axis.registration)))
                    .collect()
            })
            .collect();
        let values = &audited.channels[channel].values;
        let one = |i: usize| {
            let at: Vec<f64> = place(i, &dims).iter().zip(&positions).map(|(k, p)| p[*k]).collect();
            let inner = at.iter().zip(&audited.size).all(|(p, n)| *p > 0.0 && *p < (n - 1) as f64);
            (fetch(values, &audited.size, &at) - column.value(self.base[i]), inner)
        };
        let errors: Vec<(f64, bool)> = (0..self.base.len()).into_par_iter().map(one).collect();
        let worst =
            (0..errors.len()).reduce(|a, b| if errors[b].0.abs() > errors[a].0.abs() { b } else { a })?;
        let n = errors.len() as f64;
        Some(LookupErrors {
            max: errors[worst].0.abs(),
            at: self.place(worst, convention),
            rms: (errors.iter().map(|e| e.0 * e.0).sum::<f64>() / n).sqrt(),
            mean: errors.iter().map(|e| e.0).sum::<f64>() / n,
            inner: errors.iter().filter(|e| e.1).map(|e| e.0.abs()).fold(0.0, f64::max),
        })
    }

    fn place(&self, i: usize, convention: &Convention) -> Place {
        let dims: Vec<usize> = self.inputs.iter().map(Vec::len).collect();
        let places = place(i, &dims);
        let named = convention.axes.iter().enumerate();
        named.map(|(k, a)| (a.scale.input().name().to_string(), self.inputs[k][places[k]])).collect()
    }
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
