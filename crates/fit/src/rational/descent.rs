//! From level to level by differential correction, and the proof that the last one is the lowest.

use super::columns::{Columns, NOISE};
use super::level::{Id, Level};
use super::simplex::Failure;
use super::{Optimum, Row};
use crate::error::in_the_way;
use crate::{FitError, Termination};

/// Programs of one descent.
const PROGRAMS: usize = 80;

/// A level that falls by less than this part has converged.
const CONVERGED: f64 = 1e-10;

/// How far below the level reached a proof is tried, in parts of it.
const PROOFS: [f64; 7] = [1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-2, 1e-1];

/// The largest gap of an optimum.
const GAP: f64 = 1e-4;

/// A descent through levels.
pub(crate) struct Descent<'a> {
    columns: &'a Columns,
    /// The caller's rows, homogeneous and scaled: a x <= 0.
    extra: Vec<Row>,
    /// Homogeneous coefficients.
    x: Vec<f64>,
    /// Denominators at x.
    divisor: Vec<f64>,
    /// Largest residual at x, in units of the columns' magnitude.
    level: f64,
    /// Active rows of the last program.
    active: Vec<Id>,
    programs: usize,
    capped: bool,
}

impl<'a> Descent<'a> {
    /// Starts at `start` if its denominators are positive, else at 0, else where they are largest.
    pub fn new(columns: &'a Columns, rows: &[Row], start: Option<&[f64]>) -> Result<Descent<'a>, FitError> {
        let scaled = |row: &Row| {
            let all = std::iter::once(-row.bound).chain(row.coefficients.iter().copied());
            let coefficients = all.zip(&columns.unit).map(|(a, unit)| a / unit).collect();
            Row { coefficients, bound: 0.0, equal: row.equal }
        };
        let mut descent = Descent {
            columns,
            extra: rows.iter().map(scaled).collect(),
            x: Vec::new(),
            divisor: Vec::new(),
            level: f64::INFINITY,
            active: Vec::new(),
            programs: 0,
            capped: false,
        };
        let zero = vec![0.0; columns.unit.len() - 1];
        for coefficients in start.into_iter().chain([zero.as_slice()]) {
            if descent.move_to(columns.homogeneous(coefficients)).is_ok() {
                return Ok(descent);
            }
        }
        let x = descent.largest_denominators()?;
        // The program has found positive denominators that its own solution does not have: the
        // margin is one of rounding.
        descent.move_to(x).map_err(|_| descent.refused(Failure::Unproven))?;
        Ok(descent)
    }

    /// Starts at homogeneous coefficients, scaled, without constraints; none if a denominator is
    /// not positive there.
    pub fn at(columns: &'a Columns, x: Vec<f64>) -> Option<Descent<'a>> {
        let mut descent = Descent {
            columns,
            extra: Vec::new(),
            x: Vec::new(),
            divisor: Vec::new(),
            level: f64::INFINITY,
            active: Vec::new(),
            programs: 0,
            capped: false,
        };
        descent.move_to(x).ok().map(|()| descent)
    }

    /// One program: whether there are coefficients with residuals below a level. They are taken if
    /// so.
    pub fn falls_below(&mut self, level: f64) -> bool {
        if self.level <= level {
            return true;
        }
        let solved = self.program(level).solve(&self.active);
        self.programs += 1;
        let Ok(mut vertex) = solved else { return false };
        self.active = vertex.active.iter().map(|(id, _)| *id).collect();
        let z = vertex.x.pop();
        z.is_some_and(|z| z < 0.0) && self.move_to(vertex.x).is_ok()
    }

    /// The homogeneous coefficients reached, scaled, and the largest residual there in units of the
    /// columns' magnitude.
    pub fn reached(&self) -> (&[f64], f64) {
        (&self.x, self.level)
    }

    /// Takes coefficients whose denominators are all positive; else says where one is not.
    fn move_to(&mut self, x: Vec<f64>) -> Result<(), usize> {
        let (mut residual, mut divisor) = (Vec::new(), Vec::new());
        self.columns.at(&x, &mut residual, &mut divisor);
        if let Some(sample) = divisor.iter().position(|d| !(*d > 0.0 && d.is_finite())) {
            return Err(sample);
        }
        self.level = residual.iter().zip(&divisor).fold(0.0_f64, |t, (r, d)| t.max(r.abs() / d));
        (self.x, self.divisor) = (x, divisor);
        Ok(())
    }

    /// Homogeneous coefficients where the smallest denominator is largest, in units of the samples'
    /// sizes.
    fn largest_denominators(&mut self) -> Result<Vec<f64>, FitError> {
        let mut program = Level::new(self.columns, &[], None, self.columns.size.clone());
        let solved = program.solve(&[]);
        self.programs += 1;
        let mut vertex = match solved {
            // No denominators of mean 1, whatever their signs.
            Err(Failure::Infeasible) => return Err(FitError::NoDenominator { sample: None }),
            solved => solved.map_err(|failure| self.refused(failure))?,
        };
        if vertex.x.last().is_none_or(|z| *z >= 0.0) {
            let sample = vertex.active.iter().find_map(|(id, y)| match id {
                Id::Above(sample) if *y > 0.0 => Some(*sample),
                _ => None,
            });
            if vertex.proven(&program) > 0.0 {
                return Err(FitError::NoDenominator { sample });
            }
            let message = format!(
                "every choice of the coefficients has a denominator that is 0, to rounding, or less at some sample{}",
                in_the_way(sample)
            );
            return Err(FitError::Solver { message });
        }
        vertex.x.pop();
        Ok(vertex.x)
    }

    fn refused(&self, failure: Failure) -> FitError {
        match failure {
            Failure::Infeasible => FitError::Infeasible { rows: self.extra.len() },
            Failure::Unproven => {
                let message = "whether any coefficients keep every denominator positive (and the constraints) could not be decided in \
                               floating point: the columns are nearly dependent, or of very different sizes";
                FitError::Solver { message: message.to_string() }
            }
            Failure::Numerical => {
                let message = "a linear program of the minimax failed in floating point: the columns are nearly dependent";
                FitError::Solver { message: message.to_string() }
            }
        }
    }

    /// Whether the coefficients keep the caller's rows.
    fn admissible(&self) -> bool {
        self.extra.iter().all(|row| {
            let value = row.coefficients.iter().zip(&self.x).map(|(a, x)| a * x).sum::<f64>();
            let top = row.coefficients.iter().zip(&self.x).fold(0.0_f64, |t, (a, x)| t.max((a * x).abs()));
            (if row.equal { value.abs() } else { value }) <= 1e-9 * top
        })
    }

    /// The program of a level, with the denominators reached as weights.
    fn program(&self, level: f64) -> Level<'_> {
        Level::new(self.columns, &self.extra, Some(level), self.divisor.clone())
    }

    /// Descends until the programs find nothing better.
    pub fn run(&mut self) -> Result<(), FitError> {
        let mut admissible = self.admissible();
        if !admissible {
            // A level from inadmissible coefficients may lie below every admissible one; a program
            // at any level finds those.
            self.level = self.level.max(NOISE).max(f64::MIN_POSITIVE);
        }
        while !admissible || self.level > NOISE {
            if self.programs >= PROGRAMS {
                self.capped = true;
                break;
            }
            let solved = self.program(self.level).solve(&self.active);
            self.programs += 1;
            let mut vertex = match solved {
                Ok(vertex) => vertex,
                Err(failure) if !admissible => return Err(self.refused(failure)),
                // Close to the optimum a program may fail to say what the proof will: that nothing
                // is left to gain.
                Err(_) => break,
            };
            self.active = vertex.active.iter().map(|(id, _)| *id).collect();
            let (before, old) = (self.level, (self.x.clone(), self.divisor.clone()));
            vertex.x.pop();
            let moved = self.move_to(vertex.x).is_ok();
            if admissible && (!moved || self.level >= before) {
                ((self.x, self.divisor), self.level) = (old, before);
                break;
            }
            if !moved {
                return Err(self.refused(Failure::Numerical));
            }
            if admissible && before - self.level <= CONVERGED * before {
                break;
            }
            admissible = true;
        }
        Ok(())
    }

    /// The optimum with the highest level that is proven to be out of reach.
    pub fn prove(&mut self) -> Result<Optimum, FitError> {
        let coefficients = self.columns.coefficients(&self.x);
        let (max, mut bound) = (self.level, 0.0);
        if max > NOISE {
            for part in PROOFS {
                let level = max * (1.0 - part);
                self.programs += 1;
                if self.program(level).solve(&self.active).is_ok_and(|v| v.x.last().is_some_and(|z| *z > 0.0))
                {
                    bound = level;
                    break;
                }
            }
        }
        let gap = if max > 0.0 { (max - bound) / max } else { 0.0 };
        let termination = match () {
            () if coefficients.is_empty() => Termination::NoParameters,
            () if max <= NOISE => Termination::ZeroResidual,
            () if gap <= GAP => Termination::Minimax,
            () if self.capped => Termination::IterationCap,
            () => Termination::Stalled,
        };
        let (max, bound) = (max * self.columns.magnitude, bound * self.columns.magnitude);
        Ok(Optimum { coefficients, max, bound, gap, programs: self.programs, termination })
    }
}
