//! A table of one column of any quantity of alpha and mu.

use std::cell::Cell;

use super::{
    BakedTable, BuildError, Family, Further, LookupPoints, Made, Point, Region, Spec, TableJob, Truths, bake,
    flat,
};
use crate::approximate::Counter;
use crate::data::{Layout, Serves, Smith, Table, TexelFormat};
use crate::effects::context::Context;
use crate::effects::demand::Job;
use crate::effects::{Albedo, BakeError, JobSummary};
use crate::scene::limits::TABLE_MU;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points;
use lobefit_truth::quantity::{Choice, Quantity, Variant};

/// 2^14 uniform points, half as many in the layer mu ~ alpha, and the edges.
const LOG2_POINTS: u32 = 14;

/// What is tabulated. An effect of any crate declares it; texels, certificate, files, manifest
/// entry, shader code and what its page shows follow. A table beside a family of fits is a field of
/// [`ValueFits`](crate::effects::value::ValueFits); alone:
///
/// ```no_run
/// use lobefit::data::{Layout, TexelFormat};
/// use lobefit::effects::context::Context;
/// use lobefit::effects::table::ValueTable;
/// use lobefit::effects::{BakeError, Called, Made};
/// use lobefit_truth::quantity::GGX_REFLECTION;
///
/// const TABLE: ValueTable = ValueTable {
///     quantity: &GGX_REFLECTION,
///     column: "E",
///     name: "ggx",
///     role: "ggx_lookup",
///     layout: Layout::Homogeneous,
///     size: [32, 32],
///     format: TexelFormat::F16,
///     seconds: 1.0,
/// };
///
/// fn bake(called: &Called, context: &Context) -> Result<Made, BakeError> {
///     let (tables, broken) = TABLE.bake(called.only_job()?, context)?;
///     let error = tables.first().map(|table| table.errors.lookup.max);
///     let mut made = Made::new(called, error, "lookup error of E");
///     made.broken = broken;
///     made.tables(context, tables)?;
///     Ok(made)
/// }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ValueTable {
    /// A quantity whose inputs are alpha and mu.
    pub quantity: &'static dyn Quantity,
    /// The column that it holds. Its channel and its decoding call it E.
    pub column: &'static str,
    /// How its name begins; the size follows.
    pub name: &'static str,
    /// The name of its function: `minnaert_lookup`.
    pub role: &'static str,
    /// Coordinates over mu and roughness: `homogeneous`, `plain` or `plain-squared`.
    pub layout: Layout,
    /// Texels along mu and along roughness.
    pub size: [usize; 2],
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Seconds of it on one core.
    pub seconds: f64,
}

impl ValueTable {
    /// The table of a job whose ranges are of roughness and mu, and the limit of the job where it
    /// is not kept, in words.
    ///
    /// # Errors
    /// A job without these ranges; a truth that cannot be integrated; a layout with slices.
    pub fn bake(&self, job: &Job, context: &Context) -> Result<(Vec<BakedTable>, Vec<String>), BakeError> {
        let (smith, alpha_map) = (context.scene.smith, context.scene.alpha);
        let job = TableJob {
            names: vec![self.named()],
            smith,
            alpha_map,
            layout: self.layout,
            serves: Serves::Albedo,
            size: Some(self.size.to_vec()),
            max_bytes: None,
            format: self.format,
            roughness: job.range("roughness")?,
            mu: TABLE_MU,
            slices: None,
            max_error: job.goals.max_error,
            limited_by: job.limited_by(),
            unjudged_by: None,
            wanted_by: job.wanted_by(),
        };
        bake(self, &[job], context)
    }

    /// What a plan says of it.
    pub fn expects(&self, job: &Job) -> JobSummary {
        let [columns, rows] = self.size;
        let (format, layout) = (self.format.name(), self.layout.name());
        JobSummary {
            name: self.named(),
            approximation: format!("table {columns}x{rows} {format}, {layout} layout, of {}", self.column),
            ranges: job.ranges.clone(),
            bytes: (columns * rows) as u64 * self.format.bytes(),
            bytes_at_most: false,
            expected_error: job.goals.max_error,
            recommended: None,
            seconds: self.seconds,
            merging: None,
        }
    }

    fn named(&self) -> String {
        let [columns, rows] = self.size;
        format!("{}-{columns}x{rows}", self.name)
    }

    /// The values at places of alpha and mu, and how far they may be off.
    fn truth(
        &self,
        smith: Smith,
        [alpha, mu]: [Vec<f64>; 2],
        counter: &Counter,
    ) -> Result<(Vec<f64>, f64), IntegrateError> {
        let has = self.quantity.has(Choice::Smith);
        let variant = if has { Variant::from(smith) } else { Variant::default() };
        // A texel at the end of its axis may lie beyond the quantity's domain: it has the nearest
        // value that there is.
        let domain = |name| self.quantity.inputs().iter().find(|input| input.name == name);
        let inside = |name: &'static str, column: Vec<f64>| {
            let [low, high] = domain(name).map_or([0.0, 1.0], |input| input.domain);
            (name, column.into_iter().map(|x| x.clamp(low, high)).collect::<Vec<f64>>())
        };
        let points = points::Points::new([inside("alpha", alpha), inside("mu", mu)]);
        let tolerance = self.quantity.tolerance_of_many(&variant);
        let truth = self.quantity.truth(&variant, &points, &[self.column], tolerance)?;
        counter.add(points.len());
        let (error, [values]) = (truth.error.max(tolerance), truth.arrays());
        Ok((values, error))
    }
}

impl Family for ValueTable {
    fn prefix(&self, _: Layout) -> &'static str {
        self.name
    }

    fn role(&self, _: Layout, _: Serves) -> &'static str {
        self.role
    }

    fn described(&self, _: &TableJob, _: Option<Side>) -> String {
        format!("of {}", self.column)
    }

    fn seconds(&self, _: usize, _: &[TableJob]) -> f64 {
        self.seconds
    }

    fn build(&self, spec: &Spec, counter: &Counter) -> Result<(Vec<Table>, Made), BuildError> {
        let integration = Cell::new(0.0);
        let mut tables = flat::build(self.quantity.name(), spec, flat::ROUNDS, &|places| {
            let (alpha, mu) = places.iter().copied().unzip();
            let (values, error) = self.truth(spec.smith, [alpha, mu], counter)?;
            integration.set(error);
            Ok(values.into_iter().map(|e| (e, 0.0)).collect())
        })?;
        if !self.quantity.has(Choice::Smith) {
            tables.iter_mut().for_each(|table| table.smith = None);
        }
        Ok((tables, Made { evaluations: 0, integration: integration.get() }))
    }

    fn points(&self, region: &Region, _: bool) -> Result<LookupPoints, BuildError> {
        Ok(LookupPoints::certification(region, LOG2_POINTS))
    }

    fn truths(
        &self,
        smith: Smith,
        points: &LookupPoints,
        _: bool,
        counter: &Counter,
    ) -> Result<Truths, IntegrateError> {
        let table = *self;
        let at = move |points: &LookupPoints, counter: &Counter| {
            let [alpha, mu] = [|p: &Point| p.alpha, |p: &Point| p.mu.min(1.0)]
                .map(|input| points.all.iter().map(|p| f64::from(input(p))).collect());
            let (e, integration) = table.truth(smith, [alpha, mu], counter)?;
            Ok((Albedo { e, b: Vec::new() }, integration))
        };
        let (albedo, integration) = at(points, counter)?;
        Ok(Truths {
            sides: vec![albedo],
            made: Made { evaluations: 0, integration },
            further: Further::new(move |_, points, counter| Ok(at(points, counter)?.0)),
        })
    }
}
