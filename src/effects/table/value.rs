//! A table of one column of any quantity of alpha and mu.

use std::cell::Cell;

use super::job::{AUTO_SIDE, OPEN_SIZE, shape, size_text};
use super::{
    BakedTable, BuildError, Family, Further, LookupPoints, Made, Point, Region, Spec, TableJob, Truths, bake,
    flat,
};
use crate::approximate::{self, Memo};
use crate::data::{Layout, Serves, Smith, Table};
use crate::effects::context::Context;
use crate::effects::demand::{Job, Span};
use crate::effects::{Albedo, BakeError, JobSummary};
use crate::scene::TableWant;
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
/// use lobefit::scene::TableWant;
/// use lobefit_truth::quantity::GGX_REFLECTION;
///
/// const TABLE: ValueTable = ValueTable {
///     quantity: GGX_REFLECTION,
///     column: "E",
///     name: "ggx",
///     role: "ggx_lookup",
///     seconds: 1.0,
///     wants: &[],
/// };
///
/// fn bake(called: &Called, context: &Context) -> Result<Made, BakeError> {
///     let want = TableWant::flat(Layout::Homogeneous, [32, 32], TexelFormat::F16);
///     let wants = [(want, String::new())];
///     let (tables, broken) = ValueTable { wants: &wants, ..TABLE }.bake(called.only_job()?, context)?;
///     let error = tables.first().map(|table| table.errors.lookup.max);
///     let mut made = Made::new(called, error, "lookup error of E");
///     made.broken = broken;
///     made.tables(context, tables)?;
///     Ok(made)
/// }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ValueTable<'a> {
    /// A quantity whose inputs are alpha and mu.
    pub quantity: &'static dyn Quantity,
    /// The column that it holds. Its channel and its decoding call it E.
    pub column: &'static str,
    /// How its name begins; the size follows.
    pub name: &'static str,
    /// The name of its function: `minnaert_lookup`.
    pub role: &'static str,
    /// Seconds of one on one core.
    pub seconds: f64,
    /// Tables of two axes, each with who sets its limit.
    pub wants: &'a [(TableWant, String)],
}

impl ValueTable<'_> {
    /// The tables of a job whose ranges are of roughness and mu, and their limits that are not kept,
    /// in words.
    ///
    /// # Errors
    /// A job without these ranges; a truth that cannot be integrated; a layout with slices.
    pub fn bake(&self, job: &Job, context: &Context) -> Result<(Vec<BakedTable>, Vec<String>), BakeError> {
        let one = |(want, limited_by): &(TableWant, String)| {
            let (mu, alpha_map) = (want.n_dot_v, context.scene.alpha);
            let roughness = Span::roughness(job.range("roughness")?, alpha_map).widened();
            let flat = approximate::Region { roughness, mu, alpha_map };
            Ok(TableJob {
                names: vec![self.named(want)],
                smith: context.scene.smith,
                want: TableWant { serves: Serves::Albedo, ..want.clone() },
                region: flat.into(),
                limited_by: limited_by.clone(),
                unjudged_by: None,
                wanted_by: job.callers(),
            })
        };
        let jobs: Vec<TableJob> = self.wants.iter().map(one).collect::<Result<_, BakeError>>()?;
        bake(self, &jobs, context)
    }

    /// What a plan says of them.
    pub fn expects(&self, job: &Job) -> Vec<JobSummary> {
        let one = |(want, _): &(TableWant, String)| {
            let (format, layout) = (want.format.name(), want.layout.name());
            let size = want.size.as_ref().map_or_else(|| OPEN_SIZE.into(), |size| size_text(size));
            let texels = want.size.as_ref().map_or(AUTO_SIDE * AUTO_SIDE, |size| size.iter().product());
            JobSummary {
                name: self.named(want),
                approximation: format!("table {size} {format}, {layout} layout, of {}", self.column),
                ranges: job.ranges.clone().into_iter().chain([("mu", want.n_dot_v)]).collect(),
                bytes: texels as u64 * want.format.bytes(),
                bytes_at_most: want.size.is_none(),
                expected_error: want.max_error,
                seconds: self.seconds,
                ..JobSummary::default()
            }
        };
        self.wants.iter().map(one).collect()
    }

    fn named(&self, want: &TableWant) -> String {
        let size = want.size.as_ref().map_or_else(|| "auto".into(), |size| size_text(size));
        format!("{}-{}", self.name, shape(&size, want.format, want.layout))
    }
}

/// A column of a quantity.
#[derive(Clone, Copy)]
struct Held(&'static dyn Quantity, &'static str);

impl Held {
    /// The values at places of alpha and mu, and how far they may be off.
    fn truth(
        self,
        smith: Smith,
        [alpha, mu]: [Vec<f64>; 2],
        memo: &Memo,
    ) -> Result<(Vec<f64>, f64), IntegrateError> {
        let Held(quantity, column) = self;
        let has = quantity.has(Choice::Smith);
        let variant = if has { Variant::from(smith) } else { Variant::default() };
        // A texel at the end of its axis may lie beyond the quantity's domain: it has the nearest
        // value that there is.
        let domain = |name| quantity.inputs().iter().find(|input| input.name == name);
        let inside = |name: &'static str, column: Vec<f64>| {
            let [low, high] = domain(name).map_or([0.0, 1.0], |input| input.domain);
            (name, column.into_iter().map(|x| x.clamp(low, high)).collect::<Vec<f64>>())
        };
        let points = points::Points::new([inside("alpha", alpha), inside("mu", mu)]);
        let tolerance = quantity.tolerance_of_many(&variant);
        let truth = quantity.truth(&variant, &points, &[column], tolerance)?;
        memo.add(points.len());
        let (error, [values]) = (truth.error.max(tolerance), truth.arrays());
        Ok((values, error))
    }
}

impl Family for ValueTable<'_> {
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

    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError> {
        let (held, integration) = (Held(self.quantity, self.column), Cell::new(0.0));
        let mut tables = flat::build(self.quantity.name(), spec, flat::ROUNDS, &|places| {
            let (alpha, mu) = places.iter().copied().unzip();
            let (values, error) = held.truth(spec.smith, [alpha, mu], memo)?;
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
        memo: &Memo,
    ) -> Result<Truths, IntegrateError> {
        let held = Held(self.quantity, self.column);
        let at = move |points: &LookupPoints, memo: &Memo| {
            let [alpha, mu] = [|p: &Point| p.alpha, |p: &Point| p.mu.min(1.0)]
                .map(|input| points.all.iter().map(|p| f64::from(input(p))).collect());
            let (e, integration) = held.truth(smith, [alpha, mu], memo)?;
            Ok((Albedo { e, b: Vec::new() }, integration))
        };
        let (albedo, integration) = at(points, memo)?;
        Ok(Truths {
            sides: vec![albedo],
            made: Made { evaluations: 0, integration },
            further: Further::new(move |_, points, memo| Ok(at(points, memo)?.0)),
        })
    }
}
