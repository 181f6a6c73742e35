//! Samples for the report's pictures: the truth and every approximation over a grid of roughness and mu.

use rayon::prelude::*;

use super::tables::BakedTable;
use crate::approximate::{Field as Truth, Fit, PointSet, Region};
use crate::data::{Decode, Smith};
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::table::{self, Judged, Lookup, LookupError, Points, error_map};
use crate::report::{AverageFinding, AverageFit, Field, FitCurve, FurnaceRow, Ruler};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::reflection::{TOLERANCE, average};

/// Side of the maps' grids.
const MAP: usize = 64;

/// Roughness of the curves.
const CURVES: [f64; 5] = [0.1, 0.3, 0.5, 0.75, 1.0];

/// Roughness of the furnace's spheres.
const SPHERES: [f64; 10] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Fewest of them that a range must hold; a narrower range is divided evenly instead.
const FEWEST: usize = 3;

/// Roughnesses of the curves of the average.
const AVERAGES: usize = 49;

/// Cosines per curve and per sphere.
const COSINES: usize = 64;

/// A grid with its truth.
pub struct Grid {
    /// Ruler of roughness.
    pub roughness: Ruler,
    /// Ruler of mu.
    pub mu: Ruler,
    points: PointSet,
    truth: Truth,
    smith: Smith,
}

impl Grid {
    /// The grid of the maps: even in roughness, mu quadratically denser towards grazing.
    pub fn map(smith: Smith, region: &Region, split: bool, context: &Context) -> Grid {
        let roughness = Ruler::even("roughness", region.roughness[0], region.roughness[1], MAP);
        Grid::new(smith, region, roughness, grazing(region, MAP), split, context)
    }

    /// The grid of the curves.
    pub fn curves(smith: Smith, region: &Region, context: &Context) -> Grid {
        Grid::new(smith, region, chosen(region, &CURVES), grazing(region, COSINES), false, context)
    }

    /// The grid of the furnace.
    pub fn furnace(smith: Smith, region: &Region, context: &Context) -> Grid {
        Grid::new(smith, region, chosen(region, &SPHERES), grazing(region, COSINES), false, context)
    }

    fn new(
        smith: Smith,
        region: &Region,
        roughness: Ruler,
        mu: Ruler,
        split: bool,
        context: &Context,
    ) -> Grid {
        let mut points = PointSet::default();
        for m in &mu.values {
            for r in &roughness.values {
                points.push(region, *r, *m);
            }
        }
        let truth = if split {
            Truth::split(smith, &points, &context.counter)
        } else {
            Truth::albedo(smith, &points, &context.counter)
        };
        Grid { roughness, mu, points, truth, smith }
    }

    /// The same grid with B beside E.
    pub fn split_map(grid: &Grid, context: &Context) -> Grid {
        Grid {
            roughness: grid.roughness.clone(),
            mu: grid.mu.clone(),
            points: grid.points.clone(),
            truth: Truth::split(grid.smith, &grid.points, &context.counter),
            smith: grid.smith,
        }
    }

    /// A field over the grid, roughness along x and mu along y.
    fn field(&self, name: &str, signed: bool, values: impl Iterator<Item = f64>) -> Field {
        Field {
            name: name.into(),
            unit: String::new(),
            signed,
            x: self.roughness.clone(),
            y: self.mu.clone(),
            values: values.map(|v| v as f32).collect(),
        }
    }

    /// The truth of E.
    pub fn albedo(&self) -> Field {
        self.field("E", false, self.truth.e.iter().copied())
    }

    /// E N - 1 of a normalisation.
    pub fn furnace_error(&self, fit: &Fit) -> Result<Field, BakeError> {
        let values = values(fit, &self.points)?;
        Ok(self.field("E N - 1", true, values.iter().zip(&self.truth.e).map(|(n, e)| n * e - 1.0)))
    }

    /// Error of a fit of f0 A + B at f0 = 0 or 1, where it is larger.
    pub fn blend_error(&self, fit: &Fit) -> Result<Field, BakeError> {
        let (b, e) = (values_for(fit, &self.points, 0.0)?, values_for(fit, &self.points, 1.0)?);
        let errors = (0..e.len()).map(|i| {
            let (of_b, of_e) = (b[i] - self.truth.b[i], e[i] - self.truth.e[i]);
            if of_b.abs() > of_e.abs() { of_b } else { of_e }
        });
        Ok(self.field("f0 A + B", true, errors))
    }

    /// f0 A + B and its fit over mu at one f0, one per roughness.
    pub fn blend_curves(&self, fit: &Fit, f0: f64) -> Result<Vec<FitCurve>, BakeError> {
        let values = values_for(fit, &self.points, f0 as f32)?;
        let columns = self.roughness.values.len();
        let truth: Vec<f64> = self.truth.e.iter().zip(&self.truth.b).map(|(e, b)| f0 * (e - b) + b).collect();
        let column = |all: &[f64], k: usize| all.iter().skip(k).step_by(columns).copied().collect();
        let curve = |k: usize| FitCurve {
            roughness: self.roughness.values[k],
            mu: self.mu.values.clone(),
            truth: column(&truth, k),
            fit: column(&values, k),
        };
        Ok((0..columns).map(curve).collect())
    }

    /// Errors of a table's lookup: of E, and of B where it holds that.
    pub fn lookup_errors(&self, baked: &BakedTable) -> Result<Vec<Field>, LookupError> {
        let Some(table) = baked.table() else { return Ok(Vec::new()) };
        let decode = Decode::of(baked.layout, baked.serves);
        let lookup = Lookup::new(table, decode)?;
        let (points, b) = (Points::isotropic(&self.points), self.truth.b.as_slice());
        let truth = table::Truth { e: &self.truth.e, b: (!b.is_empty()).then_some(b) };
        let map = |name: &str, judged| {
            let values = error_map(&lookup, judged, &points, truth)?;
            Ok(self.field(name, true, values.into_iter()))
        };
        let mut maps = vec![map("lookup error of E", Judged::E)?];
        if decode.has_bias() {
            maps.push(map("lookup error of B", Judged::B)?);
        }
        Ok(maps)
    }

    /// 1/E and N over mu, one per roughness.
    pub fn fit_curves(&self, fit: &Fit) -> Result<Vec<FitCurve>, BakeError> {
        let values = values(fit, &self.points)?;
        let columns = self.roughness.values.len();
        let curve = |column: usize| FitCurve {
            roughness: self.roughness.values[column],
            mu: self.mu.values.clone(),
            truth: self.truth.e.iter().skip(column).step_by(columns).map(|e| 1.0 / e).collect(),
            fit: values.iter().skip(column).step_by(columns).copied().collect(),
        };
        Ok((0..columns).map(curve).collect())
    }

    /// The furnace of a lobe that is not compensated.
    pub fn uncompensated(&self) -> FurnaceRow {
        self.row("uncompensated", self.truth.e.clone())
    }

    /// The furnace of a lobe divided by a table's E.
    pub fn furnace_of_table(&self, baked: &BakedTable) -> Result<Option<FurnaceRow>, LookupError> {
        let Some(table) = baked.table() else { return Ok(None) };
        let lookup = Lookup::new(table, Decode::of(baked.layout, baked.serves))?;
        let points = Points::isotropic(&self.points).all;
        let factors = points.iter().zip(&self.truth.e).map(|(p, e)| e / f64::from(lookup.at(p).e));
        Ok(Some(self.row(&baked.approximation.name, factors.collect())))
    }

    /// The furnace of a lobe multiplied by a fit's N.
    pub fn furnace_of_fit(&self, fit: &Fit) -> Result<FurnaceRow, BakeError> {
        let values = values(fit, &self.points)?;
        let factors = values.iter().zip(&self.truth.e).map(|(n, e)| n * e).collect();
        Ok(self.row(&fit.approximation.name, factors))
    }

    fn row(&self, name: &str, values: Vec<f64>) -> FurnaceRow {
        let columns = self.roughness.values.len();
        let column = |c: usize| values.iter().skip(c).step_by(columns).copied().collect();
        FurnaceRow { name: name.into(), factors: (0..columns).map(column).collect() }
    }
}

/// E_avg and its fits over the roughness of a region, even steps.
pub fn averages(
    smith: Smith,
    region: &Region,
    fits: &[&Fit],
    context: &Context,
) -> Result<AverageFinding, BakeError> {
    let roughness = Ruler::even("roughness", region.roughness[0], region.roughness[1], AVERAGES);
    let mut points = PointSet::default();
    for r in &roughness.values {
        points.push(region, *r, 1.0);
    }
    context.counter.add(points.len());
    let truth: Vec<Result<f64, IntegrateError>> = points
        .alpha
        .par_iter()
        .map(|alpha| average(smith, f64::from(*alpha), TOLERANCE).map(|v| v.e_avg))
        .collect();
    let fit = |f: &&Fit| Ok(AverageFit { name: f.approximation.name.clone(), values: values(f, &points)? });
    Ok(AverageFinding {
        name: "E_avg".into(),
        truth: truth.into_iter().collect::<Result<_, _>>()?,
        fits: fits.iter().map(fit).collect::<Result<_, BakeError>>()?,
        roughness,
    })
}

fn values(fit: &Fit, points: &PointSet) -> Result<Vec<f64>, BakeError> {
    values_for(fit, points, 1.0)
}

fn values_for(fit: &Fit, points: &PointSet, f0: f32) -> Result<Vec<f64>, BakeError> {
    let values = fit.values_for(points, f0).map_err(crate::approximate::FitStageError::from)?;
    Ok(values.into_iter().map(f64::from).collect())
}

pub fn grazing(region: &Region, n: usize) -> Ruler {
    let [low, high] = region.mu;
    let at = |i: usize| {
        let t = i as f64 / (n - 1) as f64;
        low + (high - low) * t * t
    };
    Ruler { name: "mu".into(), values: (0..n).map(at).collect() }
}

/// The wanted roughnesses that lie in the region, or an even division of a range that holds too few.
pub fn chosen(region: &Region, wanted: &[f64]) -> Ruler {
    let [low, high] = region.roughness;
    let values: Vec<f64> = wanted.iter().copied().filter(|r| (low..=high).contains(r)).collect();
    if values.len() < FEWEST {
        Ruler::even("roughness", low, high, 5)
    } else {
        Ruler { name: "roughness".into(), values }
    }
}
