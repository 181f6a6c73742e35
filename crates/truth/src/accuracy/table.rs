//! Tables as ways to compute a quantity: texels each integrated by itself or by work that neighbours share,
//! and the error of the linear lookup between them.

use serde::{Deserialize, Serialize};

use super::{Clock, Study};
use crate::integrate::IntegrateError;
use crate::points::Points;
use crate::quantity::Input;
use lobefit_math::recurrence::Recurrence;

/// Square tables of an output over two inputs, the others as at the easy point. Texels are f32.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tables {
    /// The inputs; of a width alpha its root is even.
    pub axes: Vec<String>,
    /// Texels a side.
    pub sides: Vec<usize>,
    /// Largest error of the lookup.
    pub error: Vec<f64>,
    /// Seconds of one thread for texels each integrated by itself, by those of some.
    pub direct: Vec<f64>,
    /// Seconds of one thread for all texels together, which share their work where the quantity has a way.
    pub shared: Vec<f64>,
}

/// Texels a side.
const SIDES: [usize; 5] = [8, 16, 32, 64, 128];

/// Texels that are timed by themselves, and lookups that are judged.
const TIMED: usize = 16;
const JUDGED: usize = 4096;

/// The places of a texture coordinate along an input.
fn place(input: &Input, t: f64, smallest_alpha: f64) -> f64 {
    let [low, high] = input.usual;
    if input.name.starts_with("alpha") {
        let low = low.max(smallest_alpha);
        let root = low.sqrt() + (high.sqrt() - low.sqrt()) * t;
        return (root * root).clamp(low, high);
    }
    low + (high - low) * t
}

/// The tables of a study's quantity over its first input and `mu`; none where it lacks `mu`.
///
/// # Errors
/// A truth that cannot be integrated.
pub fn tables(study: &Study, clock: Clock) -> Result<Option<Tables>, IntegrateError> {
    let inputs = study.quantity.inputs();
    let Some(mu) = inputs.iter().position(|input| input.name == "mu").filter(|k| *k > 0) else {
        return Ok(None);
    };
    let axes = [0, mu];
    let mut found = Tables {
        axes: axes.map(|k| inputs[k].name.into()).into(),
        sides: SIDES.into(),
        error: Vec::new(),
        direct: Vec::new(),
        shared: Vec::new(),
    };
    let sequence = Recurrence::new(2);
    let judged: Vec<[f64; 2]> = (0..JUDGED).map(|i| [0, 1].map(|k| sequence.coordinate(i, k))).collect();
    let exact = study.values(axes, &judged)?;
    for side in SIDES {
        let t = |i: usize| i as f64 / (side - 1) as f64;
        let nodes: Vec<[f64; 2]> = (0..side * side).map(|i| [t(i % side), t(i / side)]).collect();
        let texels: Vec<f64> = study.values(axes, &nodes)?.iter().map(|x| f64::from(*x as f32)).collect();
        let off = judged.iter().zip(&exact).map(|(at, exact)| (lookup(&texels, side, *at) - exact).abs());
        found.error.push(off.fold(0.0, f64::max));
        found.shared.push(clock(&mut || {
            let _ = std::hint::black_box(study.values(axes, &nodes));
        }));
        let step = side * side / TIMED;
        let some: Vec<Vec<f64>> = nodes.iter().step_by(step).map(|at| study.place(axes, *at)).collect();
        let tolerance = study.quantity.tolerance_of_many(&study.variant);
        let seconds = clock(&mut || {
            for x in &some {
                let _ = std::hint::black_box(study.quantity.at(&study.variant, x, tolerance));
            }
        });
        found.direct.push(seconds * nodes.len() as f64 / some.len() as f64);
    }
    Ok(Some(found))
}

/// The bilinear lookup.
fn lookup(texels: &[f64], side: usize, at: [f64; 2]) -> f64 {
    let [(i, u), (j, v)] = at.map(|t| {
        let x = t * (side - 1) as f64;
        let cell = (x as usize).min(side - 2);
        (cell, x - cell as f64)
    });
    let row = |j: usize| texels[j * side + i] * (1.0 - u) + texels[j * side + i + 1] * u;
    row(j) * (1.0 - v) + row(j + 1) * v
}

impl Study {
    fn place(&self, axes: [usize; 2], at: [f64; 2]) -> Vec<f64> {
        let mut x = self.x.clone();
        axes.iter()
            .zip(at)
            .for_each(|(k, t)| x[*k] = place(&self.quantity.inputs()[*k], t, self.quantity.smallest_alpha()));
        x
    }

    /// The output at many places, as makers of tables ask for it.
    fn values(&self, axes: [usize; 2], at: &[[f64; 2]]) -> Result<Vec<f64>, IntegrateError> {
        let rows: Vec<Vec<f64>> = at.iter().map(|at| self.place(axes, *at)).collect();
        let column = |(k, input): (usize, &Input)| (input.name, rows.iter().map(|row| row[k]).collect());
        let points = Points::new(self.quantity.inputs().iter().enumerate().map(column));
        let tolerance = self.quantity.tolerance_of_many(&self.variant);
        let mut truth = self.quantity.truth(&self.variant, &points, &[self.output()], tolerance)?;
        Ok(truth.columns.swap_remove(0))
    }
}
