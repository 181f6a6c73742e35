//! Samples for the report's pictures: the truth and every approximation over a grid of roughness
//! and mu.

use crate::approximate::{Fit, Region};
use crate::data::Smith;
use crate::effects::context::Context;
use crate::effects::grid::Grid;
use crate::effects::table::{self, BakedTable, Judged, Lookup, LookupError, LookupPoints, error_map};
use crate::effects::{Albedo, BakeError};
use crate::report::{Field, FitCurve, FurnaceRow};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::quantity::Reflection;

/// A lobe in a shadowing form.
pub type Shadowed = (&'static dyn Reflection, Smith);

/// Roughness of the curves.
const CURVES: [f64; 5] = [0.1, 0.3, 0.5, 0.75, 1.0];

/// Roughness of the furnace's spheres.
const SPHERES: [f64; 10] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// A grid with its truth.
pub struct Exact {
    /// The grid.
    pub grid: Grid,
    truth: Albedo,
    lobe: Shadowed,
}

impl Exact {
    /// The grid of the maps.
    pub fn map(
        lobe: Shadowed,
        region: &Region,
        split: bool,
        context: &Context,
    ) -> Result<Exact, IntegrateError> {
        Exact::new(lobe, Grid::map(region), split, context)
    }

    /// The grid of the curves.
    pub fn curves(lobe: Shadowed, region: &Region, context: &Context) -> Result<Exact, IntegrateError> {
        Exact::new(lobe, Grid::curves(region, &CURVES), false, context)
    }

    /// The grid of the furnace.
    pub fn furnace(lobe: Shadowed, region: &Region, context: &Context) -> Result<Exact, IntegrateError> {
        Exact::new(lobe, Grid::curves(region, &SPHERES), false, context)
    }

    fn new(lobe: Shadowed, grid: Grid, split: bool, context: &Context) -> Result<Exact, IntegrateError> {
        let truth = Albedo::of(lobe, &grid.points, split, &context.memo)?;
        Ok(Exact { grid, truth, lobe })
    }

    /// The same grid with B beside E.
    pub fn split_map(exact: &Exact, context: &Context) -> Result<Exact, IntegrateError> {
        Exact::new(exact.lobe, exact.grid.clone(), true, context)
    }

    /// The truth of E.
    pub fn albedo(&self) -> Field {
        self.grid.field("E", false, self.truth.e.iter().copied())
    }

    /// E N - 1 of a normalisation.
    pub fn furnace_error(&self, fit: &Fit) -> Result<Field, BakeError> {
        let values = self.grid.values(fit, 1.0)?;
        Ok(self.grid.field("E N - 1", true, values.iter().zip(&self.truth.e).map(|(n, e)| n * e - 1.0)))
    }

    /// Error of a fit of f0 A + B at f0 = 0 or 1, where it is larger.
    pub fn blend_error(&self, fit: &Fit) -> Result<Field, BakeError> {
        let (b, e) = (self.grid.values(fit, 0.0)?, self.grid.values(fit, 1.0)?);
        let errors = (0..e.len()).map(|i| {
            let (of_b, of_e) = (b[i] - self.truth.b[i], e[i] - self.truth.e[i]);
            if of_b.abs() > of_e.abs() { of_b } else { of_e }
        });
        Ok(self.grid.field("f0 A + B", true, errors))
    }

    /// f0 A + B and its fit over mu at one f0, one per roughness.
    pub fn blend_curves(&self, fit: &Fit, f0: f64) -> Result<Vec<FitCurve>, BakeError> {
        let truth = self.truth.e.iter().zip(&self.truth.b).map(|(e, b)| f0 * (e - b) + b);
        Ok(self.grid.lines(&truth.collect::<Vec<f64>>(), &self.grid.values(fit, f0)?))
    }

    /// Errors of a table's lookup: of E, and of B where it holds that.
    pub fn lookup_errors(&self, baked: &BakedTable) -> Result<Vec<Field>, LookupError> {
        let Some(table) = baked.table() else { return Ok(Vec::new()) };
        let lookup = Lookup::new(table, baked.decode)?;
        let (points, b) = (LookupPoints::isotropic(&self.grid.points), self.truth.b.as_slice());
        let truth = table::Truth { e: &self.truth.e, b: (!b.is_empty()).then_some(b) };
        let map = |name: &str, judged| {
            let values = error_map(&lookup, judged, &points, truth)?;
            Ok(self.grid.field(name, true, values.into_iter()))
        };
        let mut maps = vec![map("lookup error of E", Judged::E)?];
        if baked.decode.has_bias() {
            maps.push(map("lookup error of B", Judged::B)?);
        }
        Ok(maps)
    }

    /// 1/E and N over mu, one per roughness.
    pub fn fit_curves(&self, fit: &Fit) -> Result<Vec<FitCurve>, BakeError> {
        let truth: Vec<f64> = self.truth.e.iter().map(|e| 1.0 / e).collect();
        Ok(self.grid.lines(&truth, &self.grid.values(fit, 1.0)?))
    }

    /// The furnace of a lobe that is not compensated.
    pub fn uncompensated(&self) -> FurnaceRow {
        FurnaceRow { of: String::new(), ..self.row("uncompensated", self.truth.e.clone()) }
    }

    /// The furnace of a lobe divided by a table's E.
    pub fn furnace_of_table(&self, baked: &BakedTable) -> Result<Option<FurnaceRow>, LookupError> {
        let Some(table) = baked.table() else { return Ok(None) };
        let lookup = Lookup::new(table, baked.decode)?;
        let points = LookupPoints::isotropic(&self.grid.points).all;
        let factors = points.iter().zip(&self.truth.e).map(|(p, e)| e / f64::from(lookup.at(p).e));
        Ok(Some(self.row(&baked.approximation.name, factors.collect())))
    }

    /// The furnace of a lobe multiplied by a fit's N.
    pub fn furnace_of_fit(&self, fit: &Fit) -> Result<FurnaceRow, BakeError> {
        let values = self.grid.values(fit, 1.0)?;
        let factors = values.iter().zip(&self.truth.e).map(|(n, e)| n * e).collect();
        Ok(self.row(&fit.approximation.name, factors))
    }

    fn row(&self, name: &str, values: Vec<f64>) -> FurnaceRow {
        FurnaceRow { name: name.into(), of: name.into(), factors: self.grid.by_roughness(&values) }
    }
}
