//! Residuals and their derivatives, refused where the formula leaves its branch.

use rayon::prelude::*;

use super::reduce::{Triangle, reduce};
use super::samples::Samples;
use crate::FitError;
use lobefit_shade::Tape;
use lobefit_shade::tape::{BLOCK, BinaryOp, Node, Op, Workspace};

/// Samples per parallel task.
const TASK: usize = 16 * BLOCK;

/// A formula beside the samples it is fitted to.
#[derive(Clone)]
pub(super) struct Objective<'a> {
    pub tape: &'a Tape,
    pub samples: &'a Samples,
    /// Divisors that depend on parameters: one that changes sign among the samples has a pole
    /// between them.
    divisors: Vec<Node>,
}

/// Why a set of coefficients is refused: the residual of a sample or the length of its gradient is
/// not finite, or a divisor has the other sign there than at sample 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Refused {
    pub sample: usize,
}

/// Residuals and Jacobian at a set of coefficients.
pub(super) struct Linear {
    pub residuals: Vec<f64>,
    /// Row by row.
    pub jacobian: Vec<f64>,
    /// The triangular factor of [Jacobian | residuals].
    pub triangle: Triangle,
}

impl Linear {
    /// In some of the parameters, the others fixed.
    pub fn only(&self, parameters: &[usize]) -> Linear {
        let jacobian = columns(&self.jacobian, self.triangle.r.ncols(), parameters);
        let triangle = reduce(&jacobian, &self.residuals, parameters.len());
        Linear { residuals: self.residuals.clone(), jacobian, triangle }
    }
}

/// Some columns of a matrix that is stored row by row.
pub(super) fn columns(matrix: &[f64], width: usize, chosen: &[usize]) -> Vec<f64> {
    matrix.chunks_exact(width).flat_map(|row| chosen.iter().map(|&i| row[i])).collect()
}

impl<'a> Objective<'a> {
    pub fn new(tape: &'a Tape, samples: &'a Samples) -> Result<Objective<'a>, FitError> {
        samples.check(tape)?;
        let mut free = vec![false; tape.ops().len()];
        for (node, op) in tape.ops().iter().enumerate() {
            free[node] = matches!(op, Op::Parameter(_)) || op.operands().any(|n| free[n as usize]);
        }
        let divisor = |op: &Op| match *op {
            Op::Binary(BinaryOp::Divide, _, b) if free[b as usize] => Some(b),
            _ => None,
        };
        let divisors = tape.ops().iter().filter_map(divisor).collect();
        Ok(Objective { tape, samples, divisors })
    }

    /// Residuals at a set of coefficients.
    pub fn residuals(&self, p: &[f64]) -> Result<Vec<f64>, Refused> {
        let parts = self.tasks(p, |_, _, _| {});
        let (values, _) = self.join(parts)?;
        Ok(values)
    }

    /// Residuals and Jacobian at a set of coefficients.
    pub fn linearise(&self, p: &[f64]) -> Result<Linear, Refused> {
        let n = p.len();
        let parts = self.tasks(p, |workspace, scale, rows| {
            let mut gradient = vec![[0.0; BLOCK]; n];
            self.tape.reverse(workspace, &mut gradient);
            for (lane, scale) in scale.iter().enumerate() {
                rows.extend(gradient.iter().map(|g| scale * g[lane]));
            }
        });
        let (residuals, jacobian) = self.join(parts)?;
        if let Some(bad) = jacobian.iter().position(|x| !x.is_finite()) {
            return Err(Refused { sample: bad / n.max(1) });
        }
        let triangle = reduce(&jacobian, &residuals, n);
        // Rows beyond the root of the largest double have no length.
        if !triangle.is_finite() {
            let rows = jacobian.chunks_exact(n.max(1)).enumerate();
            let longest = rows.map(|(i, row)| (i, row.iter().fold(0.0_f64, |top, x| top.max(x.abs()))));
            let worst = longest.max_by(|a, b| a.1.total_cmp(&b.1));
            return Err(Refused { sample: worst.map_or(0, |(i, _)| i) });
        }
        Ok(Linear { residuals, jacobian, triangle })
    }

    /// A divisor that has another sign at some sample than at the first, or is 0 there, and the
    /// sample.
    pub fn pole(&self, p: &[f64]) -> Option<(Node, usize)> {
        let mut workspace = Workspace::new(self.tape);
        let mut first: Vec<f64> = Vec::new();
        for block in (0..self.samples.len()).step_by(BLOCK) {
            let count = BLOCK.min(self.samples.len() - block);
            self.tape.forward(&self.samples.inputs, block, count, p, &mut workspace);
            let at = |node: &Node, lane: usize| workspace.values_of(*node)[lane];
            if first.is_empty() {
                first = self.divisors.iter().map(|node| at(node, 0)).collect();
            }
            for (node, first) in self.divisors.iter().zip(&first) {
                let changed = |lane: &usize| at(node, *lane) * first.signum() <= 0.0;
                if let Some(lane) = (0..count).find(changed) {
                    return Some((*node, block + lane));
                }
            }
        }
        None
    }

    /// Evaluates all samples; `then` may append to the second list of its task.
    fn tasks(
        &self,
        p: &[f64],
        then: impl Fn(&mut Workspace<f64>, &[f64], &mut Vec<f64>) + Sync,
    ) -> Vec<Result<Part, Refused>> {
        let all = self.samples.len();
        let task = |index: usize| {
            let (start, end) = (index * TASK, all.min((index + 1) * TASK));
            let mut workspace = Workspace::new(self.tape);
            let mut part = Part { residuals: Vec::new(), rows: Vec::new(), signs: None };
            for block in (start..end).step_by(BLOCK) {
                let count = BLOCK.min(end - block);
                self.tape.forward(&self.samples.inputs, block, count, p, &mut workspace);
                self.watch(&workspace, block, count, &mut part)?;
                let scale = &self.samples.scale[block..block + count];
                for (lane, scale) in scale.iter().enumerate() {
                    let residual = scale * workspace.result()[lane] - self.samples.target[block + lane];
                    if !residual.is_finite() {
                        return Err(Refused { sample: block + lane });
                    }
                    part.residuals.push(residual);
                }
                then(&mut workspace, scale, &mut part.rows);
            }
            Ok(part)
        };
        (0..all.div_ceil(TASK)).into_par_iter().map(task).collect()
    }

    /// Refuses a block where a divisor has another sign than before in its task, or is 0.
    fn watch(
        &self,
        workspace: &Workspace<f64>,
        start: usize,
        count: usize,
        part: &mut Part,
    ) -> Result<(), Refused> {
        let first = |&node: &Node| workspace.values_of(node)[0] > 0.0;
        let signs = part.signs.get_or_insert_with(|| self.divisors.iter().map(first).collect());
        for (node, positive) in self.divisors.iter().zip(signs) {
            let values = &workspace.values_of(*node)[..count];
            let wrong = |x: &f64| if *positive { *x <= 0.0 } else { *x >= 0.0 };
            if let Some(lane) = values.iter().position(wrong) {
                return Err(Refused { sample: start + lane });
            }
        }
        Ok(())
    }

    /// All tasks' residuals and rows, if no divisor changes sign between tasks.
    fn join(&self, parts: Vec<Result<Part, Refused>>) -> Result<(Vec<f64>, Vec<f64>), Refused> {
        let (mut residuals, mut rows) = (Vec::new(), Vec::new());
        let mut signs = None;
        for part in parts {
            let part = part?;
            if *signs.get_or_insert_with(|| part.signs.clone()) != part.signs {
                return Err(Refused { sample: residuals.len() });
            }
            residuals.extend(part.residuals);
            rows.extend(part.rows);
        }
        Ok((residuals, rows))
    }
}

/// What one task has computed.
struct Part {
    residuals: Vec<f64>,
    rows: Vec<f64>,
    signs: Option<Vec<bool>>,
}

/// Root of the mean square.
pub(super) fn rms(residuals: &[f64]) -> f64 {
    (residuals.chunks(4096).map(|c| c.iter().map(|r| r * r).sum::<f64>()).sum::<f64>()
        / residuals.len().max(1) as f64)
        .sqrt()
}

/// Largest magnitude.
pub(super) fn largest(residuals: &[f64]) -> f64 {
    residuals.iter().fold(0.0, |max, r| r.abs().max(max))
}
