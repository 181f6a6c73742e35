//! `lobefit cost --budget`, `--max-error`, `--max-bytes`: what to ship of a scene within limits.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use rayon::prelude::*;
use serde::{Serialize, Serializer};

use lobefit_shade::code::Language;

use super::super::CliError;
use super::super::calls::{MARK, cosines, table};
use super::super::input;
use super::super::output::{Outcome, print, print_json, say, say_each};
use super::super::progress::Bar;
use super::{NOTHING, Options};
use crate::approximate::FitStageError;
use crate::bake::{BakeError, Baked, Selection};
use crate::data::Vendor;
use crate::effects::demand::Demand;
use crate::effects::{Called, most_accurate};
use crate::emit::call::{Call, LookupFunction};
use crate::emit::header::short;
use crate::emit::include;
use crate::emit::manifest::{Entries, Manifest, TableEntry};
use crate::plan::{self, Plan};
use crate::scene::escape::visible;
use crate::scene::{Limits, Scene};
use crate::store::{Cache, MANIFEST};

/// What is to be shipped within the limits.
#[derive(Serialize)]
struct Shipped {
    /// Version of the form: 1.
    schema_version: u32,
    /// Name of the scene.
    scene: String,
    /// What the price of a call counts; none of neutral operations.
    unit: Option<String>,
    /// The functions that keep the limits.
    ship: Vec<Snippet>,
    /// What nothing keeps, in sentences that name the nearest.
    unkept: Vec<String>,
}

/// Fields of a scene: `materials[0].wants.fit: "max_error": 0.0113`.
#[derive(Clone, Debug, PartialEq)]
struct Field {
    path: String,
    /// Of a table.
    size: Option<Vec<usize>>,
    max_error: f64,
    /// The vendor whose model a formula is picked by.
    vendor: Option<Vendor>,
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Field { path, size, max_error, vendor } = self;
        write!(f, "{path}: ")?;
        if let Some(size) = size {
            write!(f, "\"size\": {size:?}, ")?;
        }
        write!(f, "\"max_error\": {max_error}")?;
        match vendor {
            Some(vendor) => write!(f, "; \"cost\": \"{}\" of the scene", vendor.word()),
            None => Ok(()),
        }
    }
}

impl Serialize for Field {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

/// A function to ship.
#[derive(Serialize)]
struct Snippet {
    #[serde(flatten)]
    call: Call,
    /// The line that calls it.
    snippet: String,
    /// What it is called with, as the code declares it.
    parameters: String,
    /// The fields of the scene by which `bake` picks it, in place of the limits that stand there, where
    /// there are any: `materials[0].wants.fit: "max_error": 0.0113`.
    #[serde(skip_serializing_if = "Option::is_none")]
    field: Option<Field>,
    /// The code, with all that the job's other functions need.
    code: String,
    /// The quantity and the one column of it that the call gives or corrects for.
    #[serde(skip)]
    gives: Option<(String, String)>,
}

/// Bakes each job by itself, in memory, under the limits, and says what keeps them.
pub(super) fn verb(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let languages = &input.scene.output.languages;
    let of_scene = languages.first().filter(|_| !languages.contains(&Language::Wgsl));
    let limits = Limits {
        budget: options.budget,
        vendor: options.vendor,
        max_error: options.max_error,
        max_bytes: options.max_bytes,
        language: options.language.or(of_scene.copied()).unwrap_or(Language::Wgsl),
    };
    let by_error = by_error(&input.scene, limits);
    let input = input.limited(&limits);
    let plan = plan::plan(&input.scene);
    let jobs: Vec<Plan> = plan.effects.iter().flat_map(|called| jobs(&plan, called)).collect();
    let (progress, cache) =
        (Bar::new(options.quiet || options.json, (&input.scene, &plan), 0), Cache::of_user());
    let selection = || Selection { cache: cache.as_ref(), whole: true, ..Selection::default() };
    let bake = |job: &Plan| input.bake(job, selection(), &progress);
    let baked = options.threads.install(|| {
        let all: Vec<Result<Baked, CliError>> = jobs.par_iter().map(bake).collect();
        // Of several errors the first in the order of the plan.
        all.into_iter().collect::<Result<Vec<Baked>, CliError>>()
    })?;
    drop(progress);
    let model = limits.vendor.map(Vendor::model).transpose().map_err(FitStageError::from);
    let unit = model.map_err(BakeError::from)?.map(|model| model.unit);
    let mut shipped = Shipped {
        schema_version: 1,
        scene: input.scene.name.clone(),
        unit,
        ship: Vec::new(),
        unkept: Vec::new(),
    };
    for (plan, baked) in jobs.iter().zip(&baked) {
        shipped.add((plan, &by_error), baked, &limits)?;
    }
    shipped.tables_beside_functions();
    let shared = shipped.one_limit_of_a_field();
    if options.json {
        print_json(&shipped)?;
    } else {
        match plan.is_empty() {
            true => print(NOTHING)?,
            false if !options.quiet => print(shipped.text((&limits, shared), &input.scene).as_bytes())?,
            false => {}
        }
        say_each("not within the limits", &shipped.unkept);
        if let (Some(unit), true) = (&shipped.unit, shipped.ship.is_empty() && !shipped.unkept.is_empty()) {
            say(&format!("costs are in {unit}"));
        }
    }
    Ok(if shipped.unkept.is_empty() { Outcome::Done } else { Outcome::Failed })
}

/// The goals that take a limit on the error.
fn by_error(scene: &Scene, limits: Limits) -> BTreeSet<String> {
    let limited = scene.clone().limited(&Limits { max_error: limits.max_error.or(Some(1.0)), ..limits });
    let jobs = plan::plan(&limited).effects.into_iter().flat_map(|called| called.work);
    let demands = jobs.flat_map(|job| job.demands).filter(|demand| demand.goals.max_error.is_some());
    demands.map(|demand| goal(&demand)).collect()
}

/// What has goals: a field, and a job where several are of one field.
fn goal(demand: &Demand) -> String {
    format!("{} of {}", demand.job, demand.field)
}

/// A plan of each job of an effect alone: what one job does not keep is no other's loss.
fn jobs<'a>(plan: &'a Plan, called: &'a Called) -> impl Iterator<Item = Plan> + 'a {
    called.work.iter().map(|job| Plan {
        effects: vec![Called { work: vec![job.clone()], ..called.clone() }],
        left_out: Vec::new(),
        ..plan.clone()
    })
}

impl Shipped {
    /// Adds what a job made: of the calls of a material for one purpose the recommended, or where
    /// that is beyond the limits the most accurate within them. With the plan the goals that
    /// take a limit on the error.
    fn add(
        &mut self,
        plan: (&Plan, &BTreeSet<String>),
        baked: &Baked,
        limits: &Limits,
    ) -> Result<(), BakeError> {
        self.unkept.extend(baked.broken.iter().cloned());
        let file = format!("fits/lobefit.{}", limits.language.extension());
        let code = baked.files.get(&file).map(|text| String::from_utf8_lossy(text)).unwrap_or_default();
        let manifest = baked.files.get(MANIFEST).map(|text| Manifest::read(text)).transpose()?;
        let entries = manifest.map(|manifest| manifest.entries).unwrap_or_default();
        let mut purposes: Vec<Vec<&Call>> = Vec::new();
        for call in &baked.calls {
            let same = |calls: &&mut Vec<&Call>| !call.purpose.is_empty() && calls[0].stands_for(call);
            match purposes.iter_mut().find(same) {
                Some(calls) => calls.push(call),
                None => purposes.push(vec![call]),
            }
        }
        for (k, calls) in purposes.iter().enumerate() {
            // The limit of a job of fits is on the first that it makes for a material.
            let is_first = purposes[..k].iter().all(|before| before[0].of != calls[0].of);
            let within = || calls.iter().filter(|call| beyond(call, limits).is_empty());
            // Lookups have one width, and its error tells none from another.
            let is_within = |lookup: &&LookupFunction| within().any(|call| call.function == lookup.function);
            let lookup = most_accurate(entries.lookups.iter().filter(is_within));
            let lookup = lookup.filter(|_| limits.budget.is_some());
            let of_lookup = |call: &&&Call| lookup.is_some_and(|lookup| lookup.function == call.function);
            let best = within().find(of_lookup).or_else(|| {
                within().min_by(|a, b| {
                    b.recommended.cmp(&a.recommended).then(a.max_error.total_cmp(&b.max_error))
                })
            });
            let Some(&call) = best else {
                let nearest = calls.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
                self.unkept.extend(nearest.map(|call| {
                    let beyond = beyond(call, limits).join(", ");
                    format!("{} ({}) is the nearest to the limits: {beyond}", call.function, call.of)
                }));
                continue;
            };
            let lacks = || BakeError::Internal(format!("{file} does not declare {}", call.function));
            let include::Called { call: snippet, parameters, .. } =
                include::call(&code, &call.function).ok_or_else(lacks)?;
            let field = field(plan, &entries, (call, &baked.calls), limits).filter(|_| is_first);
            let gives = gives(&entries, call);
            let (call, code) = (call.clone(), code.to_string());
            self.ship.push(Snippet { call, snippet, parameters, field, code, gives });
        }
        Ok(())
    }

    /// Where a table and a function give a material the same, the two are of one purpose, and the
    /// function is recommended, as in a bake of both.
    fn tables_beside_functions(&mut self) {
        let functions: Vec<_> = self.ship.iter().filter(|of| of.call.file.is_none()).collect();
        let known: Vec<_> = functions
            .iter()
            .map(|of| (of.call.of.clone(), of.gives.clone(), of.call.purpose.clone()))
            .collect();
        for table in self.ship.iter_mut().filter(|of| of.call.file.is_some() && of.gives.is_some()) {
            if let Some((.., purpose)) =
                known.iter().find(|(of, gives, _)| (of, gives) == (&table.call.of, &table.gives))
            {
                (table.call.purpose, table.call.recommended) = (purpose.clone(), false);
            }
        }
    }

    /// A field that several functions share has the largest of their errors, as both sides of glass do;
    /// whether one does.
    fn one_limit_of_a_field(&mut self) -> bool {
        let mut largest: BTreeMap<String, f64> = BTreeMap::new();
        let mut differ = false;
        let fields =
            || self.ship.iter().filter_map(|of| of.field.as_ref()).filter(|field| field.size.is_none());
        for field in fields() {
            let known = largest.entry(field.path.clone()).or_insert(field.max_error);
            differ |= *known != field.max_error;
            *known = known.max(field.max_error);
        }
        for field in self.ship.iter_mut().filter_map(|of| of.field.as_mut()).filter(|f| f.size.is_none()) {
            field.max_error = largest.get(&field.path).copied().unwrap_or(field.max_error);
        }
        differ
    }

    /// A table, and under it the calls.
    fn text(&self, (limits, shared): (&Limits, bool), scene: &Scene) -> String {
        let calls: Vec<Call> = self.ship.iter().map(|of| of.call.clone()).collect();
        let mut lines = table(&calls, limits.vendor, scene);
        if calls.iter().any(|call| call.is_preferred(&calls)) {
            lines.push(format!(
                "{MARK} is recommended: of a table and a function that serve one material alike, the function"
            ));
        }
        lines.extend(cosines(&calls, scene));
        if let (Some(unit), Some(vendor), false) = (&self.unit, limits.vendor, lines.is_empty()) {
            lines.push(format!(
                "{0} cost: {unit}, by the model of {0}'s compiled code, fetches not counted",
                vendor.title()
            ));
        }
        lines.extend(limits.budget.and_then(|_| dearer(&calls)));
        let mut snippets: Vec<String> = Vec::new();
        for of in &self.ship {
            let field = of.field.as_ref().map_or_else(String::new, |field| format!("; {field}"));
            let snippet = format!("{} // {}{field}", of.snippet, of.call.name);
            if !snippets.contains(&snippet) {
                snippets.push(snippet);
            }
        }
        if self.ship.iter().any(|of| of.field.is_some()) {
            lines.push(
                "for `bake` to pick the same, write the fields behind // into the scene, in place of its own limits; --json has the code"
                    .into(),
            );
        }
        if shared {
            lines.push(
                "where functions share a field, it has the largest of their errors, within which `bake` may take a cheaper one for another".into(),
            );
        }
        lines.extend(snippets);
        lines.iter().map(|line| visible(line) + "\n").collect()
    }
}

/// Which functions have room in the budget since another of their formula costs more.
fn dearer(calls: &[Call]) -> Option<String> {
    let is_dearer = |own: &Call, other: &Call| {
        (&other.name, &other.effect) == (&own.name, &own.effect) && cost(other) > cost(own)
    };
    let by = |own: &Call| calls.iter().find(|other| is_dearer(own, other)).map(|o| o.function.clone());
    let rooms: BTreeSet<(&str, String)> =
        calls.iter().filter_map(|own| Some((own.function.as_str(), by(own)?))).collect();
    let named: Vec<String> = rooms
        .iter()
        .map(|(own, by)| {
            format!("the budget holds for {by}, which costs more than {own} of the same formula")
        })
        .collect();
    (!named.is_empty())
        .then(|| format!("{}: a scene without the dearer may have a more accurate one", named.join("; ")))
}

/// The fields of a scene by which `bake` picks what a call is made of: of a table its size and error,
/// of a formula its error, which no cheaper one keeps. A probe's limit is on another error.
fn field(
    (plan, by_error): (&Plan, &BTreeSet<String>),
    entries: &Entries,
    (call, all): (&Call, &[Call]),
    limits: &Limits,
) -> Option<Field> {
    let demands = &plan.effects.first()?.work.first()?.demands;
    let demand = demands.iter().find(|demand| demand.name == call.of)?;
    let path = Some(&demand.field).filter(|field| field.starts_with("materials"))?.clone();
    // Of what a field asks for beside its own functions, no limit there is on the error.
    if call.file.is_none() && !by_error.contains(&goal(demand)) {
        return None;
    }
    if call.file.is_none() {
        return Some(Field { path, size: None, max_error: call.max_error, vendor: limits.vendor });
    }
    // Of both sides of glass: the scene has one limit.
    let max_error =
        all.iter().filter(|call| call.file.is_some()).map(|call| call.max_error).fold(0.0, f64::max);
    let size = table_of(entries, call)?.axes.iter().map(|axis| axis.size).collect();
    Some(Field { path, size: Some(size), max_error, vendor: None })
}

/// The table that a call fetches from.
fn table_of<'a>(entries: &'a Entries, call: &Call) -> Option<&'a TableEntry> {
    entries.tables.iter().find(|table| call.file.as_ref().is_some_and(|file| table.files.contains(file)))
}

/// The quantity and the one column of it that a call gives or corrects for.
fn gives(entries: &Entries, call: &Call) -> Option<(String, String)> {
    if let Some(table) = table_of(entries, call) {
        let mut columns = table.decode.keys();
        let column = columns.next()?;
        return columns.next().is_none().then(|| (table.quantity.clone(), column.clone()));
    }
    let fit = entries.fits.iter().find(|fit| fit.name == call.name)?;
    Some((fit.quantity.clone(), fit.column.clone()))
}

/// What a call costs: operations, or by the vendor's model.
fn cost(call: &Call) -> f64 {
    call.price.unwrap_or(f64::from(call.cost.ops))
}

/// How a call is beyond the limits.
fn beyond(call: &Call, limits: &Limits) -> Vec<String> {
    let cost = cost(call);
    let mut beyond = Vec::new();
    if let Some(most) = limits.budget.filter(|most| cost > *most) {
        beyond.push(match limits.vendor {
            Some(vendor) => format!("{} cost of {} where the budget is {most}", vendor.title(), short(cost)),
            None => format!("{} operations where the budget is {most}", short(cost)),
        });
    }
    if let Some(most) = limits.max_error.filter(|most| call.max_error > *most) {
        beyond.push(format!("an error of {} where max_error is {most}", short(call.max_error)));
    }
    if let Some(most) = limits.max_bytes.filter(|most| call.cost.bytes > *most) {
        beyond.push(format!("{} bytes where max_bytes is {most}", call.cost.bytes));
    }
    beyond
}
