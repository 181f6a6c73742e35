//! A table of one column of any quantity of alpha and mu, or of alpha, mu and ior.

use std::cell::Cell;

use super::job::{AUTO_SIDE, OPEN_SIZE, shape, size_text, wide};
use super::{
    BakedTable, BuildError, Family, Further, LookupPoints, Made, Point, Region, SliceAxis, Slices, Spec,
    TableJob, Truths, bake, flat,
};
use crate::approximate::{self, Memo};
use crate::data::{Layout, Serves, Smith, Table};
use crate::effects::context::Context;
use crate::effects::demand::{Job, Span};
use crate::effects::{Albedo, BakeError, JobSummary};
use crate::scene::{Material, Scene, TableWant};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points;
use lobefit_truth::quantity::{Choice, Quantity, Variant};

/// 2^14 uniform points, half as many in the layer mu ~ alpha, and the edges; of tables with slices groups.
const LOG2_POINTS: u32 = 14;
const LOG2_GROUPS: u32 = 12;

/// Values at places of alpha, mu and ior; of a quantity without it ior is not read.
pub type Values<'a> = dyn Fn(&[[f64; 3]]) -> Result<Vec<f64>, IntegrateError> + 'a;

/// The tables of a spec from its values, texels not yet rounded, and how far what they were chosen for is off
/// beside the values' own error.
pub type Texels = fn(&'static str, &Spec, &Values) -> Result<(Vec<Table>, f64), BuildError>;

/// Of two axes, in the layouts of [`flat`].
fn flat_texels(
    quantity: &'static str,
    spec: &Spec,
    values: &Values,
) -> Result<(Vec<Table>, f64), BuildError> {
    let tables = flat::build(quantity, spec, flat::ROUNDS, &|places| {
        let places: Vec<[f64; 3]> = places.iter().map(|(alpha, mu)| [*alpha, *mu, 1.0]).collect();
        Ok(values(&places)?.into_iter().map(|e| (e, 0.0)).collect())
    })?;
    Ok((tables, 0.0))
}

/// The tables that the materials of a scene list in a field, each once and within the strictest limit, with
/// who sets that.
pub fn wants(scene: &Scene, field: &str, calls: impl Fn(&Material) -> bool) -> Vec<(TableWant, String)> {
    let mut all: Vec<(TableWant, String)> = Vec::new();
    for (i, material) in scene.materials.iter().enumerate().filter(|(_, material)| calls(material)) {
        let own = material.tables().filter(|(of, ..)| *of == field);
        for (_, j, table) in own.filter(|(.., table)| table.layout != Layout::AreaLights) {
            let by = format!("{} (materials[{i}].{field}.tables[{j}].max_error)", material.name);
            let stricter = |known: &TableWant| {
                table.max_error.is_some_and(|e| known.max_error.is_none_or(|known| e < known))
            };
            match all.iter_mut().find(|(known, _)| known.is_like(table)) {
                None => all.push((table.clone(), by)),
                Some((known, limited_by)) => {
                    let [low, high] = known.n_dot_v;
                    if stricter(known) {
                        (known.max_error, *limited_by) = (table.max_error, by);
                    }
                    known.n_dot_v = [low.min(table.n_dot_v[0]), high.max(table.n_dot_v[1])];
                }
            }
        }
    }
    all
}

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
/// const TABLE: ValueTable = ValueTable::of(GGX_REFLECTION, "E", "ggx", "ggx_lookup");
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
    /// A quantity whose inputs are alpha and mu, and of tables with slices ior.
    pub quantity: &'static dyn Quantity,
    /// The column that it holds. In layouts of two axes its channel and its decoding call it E.
    pub column: &'static str,
    /// How its name begins; the size follows.
    pub name: &'static str,
    /// The name of its function: `minnaert_lookup`.
    pub role: &'static str,
    /// The side from which its light comes, of a quantity that has two.
    pub side: Option<Side>,
    /// What makes its texels.
    pub texels: Texels,
    /// Seconds of one on one core.
    pub seconds: f64,
    /// The tables, each with who sets its limit.
    pub wants: &'a [(TableWant, String)],
}

impl ValueTable<'static> {
    /// Of a quantity of alpha and mu: of two axes and half a second, and which are wanted is open.
    pub const fn of(
        quantity: &'static dyn Quantity,
        column: &'static str,
        name: &'static str,
        role: &'static str,
    ) -> Self {
        ValueTable { quantity, column, name, role, side: None, texels: flat_texels, seconds: 0.5, wants: &[] }
    }
}

impl ValueTable<'_> {
    /// The tables of a job whose ranges are of roughness, mu and what slices span, and their limits that are
    /// not kept, in words.
    ///
    /// # Errors
    /// A job without these ranges; a truth that cannot be integrated; a layout that `texels` does not have.
    pub fn bake(&self, job: &Job, context: &Context) -> Result<(Vec<BakedTable>, Vec<String>), BakeError> {
        let one = |(want, limited_by): &(TableWant, String)| {
            let (mu, alpha_map) = (want.n_dot_v, context.scene.alpha);
            let roughness = Span::roughness(job.range("roughness")?, alpha_map).widened();
            let flat = approximate::Region { roughness, mu, alpha_map };
            let slices = (want.layout.axes() > 2).then(|| self.slices(job, want)).transpose()?;
            Ok(TableJob {
                names: vec![self.named(want)],
                smith: context.scene.smith,
                want: TableWant { serves: Serves::Albedo, ..want.clone() },
                region: Region { slices, ..flat.into() },
                limited_by: limited_by.clone(),
                unjudged_by: None,
                wanted_by: job.callers(),
            })
        };
        let jobs: Vec<TableJob> = self.wants.iter().map(one).collect::<Result<_, BakeError>>()?;
        bake(self, &jobs, context)
    }

    /// What the slices of a table span: of one slice the one value.
    fn slices(&self, job: &Job, want: &TableWant) -> Result<Slices, BakeError> {
        let axis = SliceAxis::Ior;
        let own = Slices { axis, range: job.own_range(axis.name())? };
        let range = wide(own, want).widened();
        Ok(Slices { axis, range })
    }

    /// Seconds of a texel with slices, whose samples are many; of two axes they are in `seconds`.
    fn texel_seconds(&self, want: &TableWant) -> f64 {
        if want.layout.axes() > 2 { 1e-4 } else { 0.0 }
    }

    fn held(&self) -> Held {
        Held { quantity: self.quantity, column: self.column, side: self.side }
    }

    /// What a plan says of them.
    pub fn expects(&self, job: &Job) -> Vec<JobSummary> {
        let one = |(want, _): &(TableWant, String)| {
            let (format, layout) = (want.format.name(), want.layout.name());
            let size = want.size.as_ref().map_or_else(|| OPEN_SIZE.into(), |size| size_text(size));
            // The bake of a job without a range of slices is an error with its name.
            let slices = (want.layout.axes() > 2).then(|| self.slices(job, want).ok()).flatten();
            let slices = slices.map(|slices| (slices.axis.name(), slices.range));
            let texels = want.size.as_ref().map_or(AUTO_SIDE * AUTO_SIDE, |size| size.iter().product());
            JobSummary {
                name: self.named(want),
                approximation: format!("table {size} {format}, {layout} layout, of {}", self.column),
                ranges: job.ranges.clone().into_iter().chain([("mu", want.n_dot_v)]).chain(slices).collect(),
                bytes: texels as u64 * want.format.bytes(),
                bytes_at_most: want.size.is_none() || want.max_bytes.is_some(),
                expected_error: want.max_error,
                seconds: self.seconds + texels as f64 * self.texel_seconds(want),
                ..JobSummary::default()
            }
        };
        self.wants.iter().map(one).collect()
    }

    fn named(&self, want: &TableWant) -> String {
        let stated = want.size.as_ref().filter(|_| want.max_bytes.is_none());
        let size = stated.map_or_else(|| "auto".into(), |size| size_text(size));
        format!("{}-{}", self.name, shape(&size, want.format, want.layout))
    }
}

/// A column of a quantity, from a side.
#[derive(Clone, Copy)]
struct Held {
    quantity: &'static dyn Quantity,
    column: &'static str,
    side: Option<Side>,
}

impl Held {
    /// The domain of an input; [0, 1] of what is none.
    fn domain(&self, name: &str) -> [f64; 2] {
        let input = self.quantity.inputs().iter().find(|input| input.name == name);
        input.map_or([0.0, 1.0], |input| input.domain)
    }

    /// The values at places of alpha, mu and ior, and how far they may be off.
    fn truth(
        &self,
        smith: Smith,
        places: &[[f64; 3]],
        memo: &Memo,
    ) -> Result<(Vec<f64>, f64), IntegrateError> {
        let smith = self.quantity.has(Choice::Smith).then_some(smith);
        let variant = Variant { smith, side: self.side, ..Variant::default() };
        // A texel at the end of its axis may lie beyond the quantity's domain: it has the nearest
        // value that there is.
        let inside = |k: usize, name: &'static str| {
            let [low, high] = self.domain(name);
            (name, places.iter().map(|place| place[k].clamp(low, high)).collect::<Vec<f64>>())
        };
        let has = |name: &str| self.quantity.inputs().iter().any(|input| input.name == name);
        let inputs = ["alpha", "mu", "ior"].into_iter().enumerate().filter(|(_, name)| has(name));
        let points = points::Points::new(inputs.map(|(k, name)| inside(k, name)));
        let tolerance = self.quantity.tolerance_of_many(&variant);
        let truth = self.quantity.truth(&variant, &points, &[self.column], tolerance)?;
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

    fn identity(&self) -> String {
        format!("{} {} {} {:?}", self.name, self.quantity.name(), self.column, self.side)
    }

    fn described(&self, _: &TableJob, _: Option<Side>) -> String {
        format!("of {}", self.column)
    }

    fn seconds(&self, _: usize, _: &[TableJob]) -> f64 {
        self.seconds
    }

    fn note(&self, _: Layout) -> Option<&'static str> {
        self.side.map(|side| match side {
            Side::Outside => "of rays from outside",
            Side::Inside => "of rays from inside",
        })
    }

    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError> {
        let integration = Cell::new(0.0);
        let (mut tables, beside) = (self.texels)(self.quantity.name(), spec, &|places| {
            let (values, error) = self.held().truth(spec.smith, places, memo)?;
            integration.set(error);
            Ok(values)
        })?;
        if !self.quantity.has(Choice::Smith) {
            tables.iter_mut().for_each(|table| table.smith = None);
        }
        Ok((tables, Made { evaluations: 0, integration: integration.get() + beside }))
    }

    fn points(&self, region: &Region, _: bool) -> Result<LookupPoints, BuildError> {
        let log2 = if region.slices.is_some() { LOG2_GROUPS } else { LOG2_POINTS };
        Ok(LookupPoints::certification(region, log2))
    }

    fn truths(
        &self,
        smith: Smith,
        points: &LookupPoints,
        _: bool,
        memo: &Memo,
    ) -> Result<Truths, IntegrateError> {
        let held = self.held();
        let at = move |points: &LookupPoints, memo: &Memo| {
            let place = |p: &Point| [p.alpha, p.mu.min(1.0), p.ior].map(f64::from);
            let places: Vec<[f64; 3]> = points.all.iter().map(place).collect();
            let (e, integration) = held.truth(smith, &places, memo)?;
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
