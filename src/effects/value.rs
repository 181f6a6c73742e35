//! Fits of one column of a quantity over alpha, mu and the inputs of `shown_at`: all that an effect
//! needs whose shaders call formulas alone.

use std::cell::LazyCell;
use std::collections::BTreeMap;

use super::context::Context;
use super::demand::{Demand, Job, Span};
use super::explore::Exploring;
use super::grid::{self, Grid, at_text};
use super::selection::{Selected, selected};
use super::table::{self, ValueTable};
use super::{BakeError, Called, JobSummary, Made, code, page, sky};
use crate::approximate::target::TargetSpec;
use crate::approximate::{self, Dropped, Emission, Entry, Fit, FitSet, Formulas, Region, Wanted};
use crate::data::{Arguments, Use};
use crate::emit::call::{self, How};
use crate::report::explore::Drawn;
use crate::report::{ApproximationFinding, Findings};
use crate::scene::{Goals, Scene};
use lobefit_shade::code::Language;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::{Choice, Quantity, Residual, Variant};

/// Narrowest range of the index of refraction of a job: over less, constants are hardly told apart.
pub(super) const IOR_WIDTH_MIN: f64 = 0.4;

/// What is fitted and how its page shows it.
pub struct ValueFits<'a> {
    /// A quantity whose inputs are alpha, mu if it has that, and those of `shown_at`.
    pub quantity: &'static dyn Quantity,
    /// The side from which its light comes, of a quantity that has two.
    pub side: Option<Side>,
    /// The column that formulas stand for.
    pub column: &'static str,
    /// What they are used as; none: as the column's first use.
    pub used_as: Option<Use>,
    /// Formulas with free parameters.
    pub own: Formulas<'a>,
    /// Published formulas: measured and reported, not emitted.
    pub published: &'a [Entry],
    /// The name of the emitted function, by its role: `ggx_average_albedo`.
    pub role: &'static str,
    /// What it is of, in messages.
    pub of: &'static str,
    /// The field of a material that holds the goals.
    pub field: &'static str,
    /// The layer of a material whose roughness it is of; none of the specular lobe.
    pub layer: Option<&'static str>,
    /// What a material has that calls for it: `with a clear coat`.
    pub because: &'static str,
    /// What to see in the map of the truth.
    pub caption: &'static str,
    /// Roughness of the page's curves, as far as they lie in the region.
    pub curves: &'a [f64],
    /// Inputs beside roughness and mu, and where pages show them, if that lies in the range of a job.
    pub shown_at: &'a [(&'static str, f64)],
    /// Seconds on one core of the truth, and of one fit.
    pub seconds: [f64; 2],
    /// Tables beside the fits.
    pub table: Option<ValueTable<'a>>,
    /// What the include files have beside the fits: functions of the most accurate one.
    pub around: Option<Functions>,
}

/// Functions about a fit.
#[derive(Clone, Copy)]
pub struct Functions {
    /// Their text in a language.
    pub print: fn(Language, &Fit) -> Result<String, BakeError>,
    /// The functions that take the value of the fit, the one to take first.
    pub taking: &'static [&'static str],
    /// The functions that call the fit.
    pub calling: &'static [&'static str],
    /// What the card of the fit says of them; empty where there are none.
    pub said: fn(&Fit) -> Result<String, BakeError>,
}

/// Fits of the values whose names the jobs have, on one page.
///
/// # Errors
/// As [`ValueFits::bake`]; a job of no such name.
pub fn bake(all: &[ValueFits], called: &Called, context: &Context) -> Result<Made, BakeError> {
    let mut made = Made::new(called, None, "");
    let is_shown = LazyCell::new(|| context.reports(called.effect));
    let mut page: Option<Findings> = None;
    for job in &called.work {
        let unknown = || BakeError::Internal(format!("{}: no fits of {}", called.effect, job.name));
        let own = all.iter().find(|own| own.of == job.name).ok_or_else(unknown)?;
        if !made.broken.is_empty() && !job.is_promised() {
            continue;
        }
        let more = own.add(&mut made, job, (context, &is_shown))?;
        page = match (page, more) {
            (Some(mut page), Some(more)) => {
                page.join(more);
                Some(page)
            }
            (page, more) => page.or(more),
        };
    }
    if let Some(page) = page.filter(|_| made.broken.is_empty()) {
        made.findings(&Findings { effects: vec![made.part.finding.clone()], ..page })?;
    }
    Ok(made)
}

/// What a plan says of jobs: first their fits, then their tables.
pub fn expects(all: &[ValueFits], jobs: &[Job]) -> Vec<JobSummary> {
    let of = |job: &Job| all.iter().find(|own| own.of == job.name);
    let fits = |job: &Job| {
        // The bake of a job without fits is an error with its name.
        let Some(own) = of(job) else {
            return JobSummary::fits(job, "nothing that the effect has, so that `bake` fails", 0.0);
        };
        let ([truth, fit], count) = (own.seconds, job.formulas(own.own).len() * job.goals.norms.len());
        let what = format!("{} of {}", own.words()[0], own.of);
        JobSummary::fits(job, &what, truth + count as f64 * fit).doubting(job, own.own)
    };
    let tables =
        |job| of(job).and_then(|own| own.table.as_ref()).into_iter().flat_map(|table| table.expects(job));
    jobs.iter().map(fits).chain(jobs.iter().flat_map(tables)).collect()
}

impl ValueFits<'_> {
    /// The demand of the material at place `of` in the scene for fits over its roughness.
    pub fn demand(&self, scene: &Scene, of: usize, roughness: [f64; 2], goals: Goals) -> Demand {
        let (name, kind) = (&scene.materials[of].name, scene.materials[of].kind.name());
        let roughness = Span::roughness(roughness, scene.alpha).or_one(false);
        // Room for the index of refraction that some effects add.
        let mut spans = Vec::with_capacity(3);
        spans.push(("roughness", roughness));
        spans.extend(self.has_mu().then(|| ("mu", Span::new(scene.mu))));
        Demand {
            job: self.of.into(),
            of,
            name: name.clone(),
            field: format!("materials[{of}].{}", self.field),
            because: format!("{name}: {kind} {} (roughness {})", self.because, roughness.text()),
            spans,
            goals,
            layer: self.layer,
            ..Demand::default()
        }
    }

    /// Whether it is a value of a view.
    fn has_mu(&self) -> bool {
        self.quantity.inputs().iter().any(|input| input.name == "mu")
    }

    /// What its formulas are used as.
    pub fn used_as(&self) -> Use {
        self.used_as.unwrap_or_else(|| self.quantity.uses(self.column)[0])
    }

    /// On pages: what formulas stand for, a map of their errors, and their error.
    fn words(&self) -> [String; 3] {
        let column = self.column;
        match self.used_as().residual {
            Residual::Difference => [column.into(), column.into(), format!("error of {column}")],
            Residual::Product => {
                let (factor, error) = (format!("N = 1/{column}"), format!("{column} N - 1"));
                [factor, error.clone(), format!("furnace error |{error}|")]
            }
            Residual::Quotient => {
                [column.into(), format!("relative {column}"), format!("relative error of {column}")]
            }
        }
    }

    /// The region of a job; without a view, mu is 1.
    fn region(&self, job: &Job, scene: &Scene) -> Result<Region, BakeError> {
        let mu = if self.has_mu() { job.range("mu")? } else { [1.0; 2] };
        Ok(Region { roughness: job.range("roughness")?, mu, alpha_map: scene.alpha })
    }

    /// Fits, their code and their page.
    ///
    /// # Errors
    /// A formula or a domain that is refused; a truth that cannot be integrated.
    pub fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        bake(std::slice::from_ref(self), called, context)
    }

    /// Adds those of a job and gives their part of the page; nothing where promises are broken.
    fn add(
        &self,
        made: &mut Made,
        job: &Job,
        (context, is_shown): (&Context, &LazyCell<bool, impl FnOnce() -> bool>),
    ) -> Result<Option<Findings>, BakeError> {
        let table = self.table.as_ref().map(|table| table.bake(job, context)).transpose()?;
        let (tables, broken) = table.unwrap_or_default();
        made.broken.extend(broken);
        if !made.broken.is_empty() && !job.is_promised() {
            return Ok(None);
        }
        context.progress.stage(&format!("fits of {}", self.of));
        let region = self.region(job, context.scene)?;
        let FitSet { fits, dropped, nearest, .. } =
            approximate::fit_all(&self.wanted(job, context.scene, &region)?, &context.memo)?;
        let shown = self.shown(job)?;
        let [_, _, metric] = self.words();
        made.measured(page::smallest_error(&fits), &format!("{metric} of the best fit"));
        made.promised(job, (&fits, &nearest), self.of, self.used_as());
        if !made.broken.is_empty() {
            return Ok(None);
        }
        let around = self.around.zip(page::best(&fits));
        made.code(context, |language| {
            let own = code::functions(language, &fits, false)?;
            Ok(own + &around.map_or_else(|| Ok(String::new()), |(of, fit)| (of.print)(language, fit))?)
        })?;
        if let Some((of, fit)) = around {
            made.cautions.push((fit.hypothesis.name().into(), (of.said)(fit)?));
        }
        made.tables(context, tables)?;
        let findings = || self.findings(made, context, (&region, &shown), (&fits, &dropped));
        let findings = is_shown.then(findings).transpose()?;
        self.explored(made, job, (&fits, &region, &shown), context)?;
        made.fits_called(job, &fits, context.scene);
        if let Some((of, fit)) = around {
            let others =
                || of.taking.iter().skip(1).map(|name| call::Around::new(name.to_string(), How::TakesValue));
            for call in &mut made.part.entries.calls {
                call.then = of.taking.first().map(ToString::to_string);
                call.around.extend(others());
            }
            made.called_within(fit.hypothesis.name(), of.calling.iter().map(ToString::to_string));
        }
        made.fits(context, (fits, dropped), |_, _, entry| entry)?;
        Ok(findings)
    }

    /// The published formulas stand beside ours where the map of roughness is theirs.
    fn wanted<'a>(&'a self, job: &'a Job, scene: &Scene, region: &Region) -> Result<Wanted<'a>, BakeError> {
        let Region { roughness, mu, alpha_map } = *region;
        let mut domain = BTreeMap::from([("roughness".to_string(), roughness)]);
        domain.extend(self.has_mu().then(|| ("mu".to_string(), mu)));
        for (input, _) in self.shown_at {
            domain.insert(input.to_string(), job.range(input)?);
        }
        Ok(Wanted {
            spec: TargetSpec {
                quantity: self.quantity,
                column: Some(self.column.into()),
                used_as: Some(self.used_as()),
                variant: self.variant(scene),
                alpha_map,
                domain,
            },
            own: self.own,
            user: &[],
            published: self.published.iter().collect(),
            norms: &job.goals.norms,
            max_ops: job.goals.max_ops,
            safe_range: None,
            emission: self.emission(job, scene),
        })
    }

    fn variant(&self, scene: &Scene) -> Variant {
        let smith = self.quantity.has(Choice::Smith).then_some(scene.smith);
        Variant { smith, side: self.side, ..Variant::default() }
    }

    /// Where the pages of a job show the other inputs.
    fn shown(&self, job: &Job) -> Result<Vec<(&'static str, f64)>, BakeError> {
        let one = |(input, usual): &(&'static str, f64)| {
            let [low, high] = job.range(input)?;
            let is_inside = (low..=high).contains(usual);
            Ok((*input, if is_inside { *usual } else { 0.5 * (low + high) }))
        };
        self.shown_at.iter().map(one).collect()
    }

    /// A quantity of roughness itself has no alpha, whatever other functions of the scene take.
    fn emission(&self, job: &Job, scene: &Scene) -> Emission {
        let emission = job.emission(scene, self.role);
        match self.quantity.inputs().iter().any(|input| input.name == "alpha") {
            true => emission,
            false => Emission { arguments: Arguments::Roughness, ..emission },
        }
    }

    fn findings(
        &self,
        made: &Made,
        context: &Context,
        (region, shown): (&Region, &[(&'static str, f64)]),
        (fits, dropped): (&[Fit], &[Dropped]),
    ) -> Result<Findings, BakeError> {
        let tables = made.tables.iter().map(|table| &table.approximation);
        let all = fits.iter().map(|fit| &fit.approximation);
        let drawn =
            if shown.is_empty() { String::new() } else { format!("Curves and maps are{}.", at_text(shown)) };
        let chosen = selected(fits, self.column, self.used_as(), context);
        let found = Findings {
            left_out: page::left_out(dropped),
            caption: format!("{} {drawn} {}", self.caption, grid::beside_text(region)).trim().into(),
            approximations: tables.chain(all).map(ApproximationFinding::from).collect(),
            ..Findings::new(context.origin())
        };
        if !self.has_mu() {
            let chosen: Vec<&Fit> = chosen.iter().map(|one| one.fit).collect();
            let of = (self.quantity, self.column, self.variant(context.scene));
            let averages = page::over_roughness(of, (region, shown), &chosen, context)?;
            return Ok(Findings { averages: Some(averages), ..found });
        }
        let (map, lines) = (Grid::map(region).at(shown), Grid::curves(region, self.curves).at(shown));
        let (truth, along) = (self.truths(&map, context)?, self.truths(&lines, context)?);
        let is_width = self.quantity.outputs()[0] == self.column;
        let of = (self.quantity, &self.variant(context.scene));
        let spheres = if is_width { sky::spheres(of, (region, shown), fits, self.of)? } else { None };
        let residual = self.used_as().residual;
        let [shown_as, error_of, _] = self.words();
        let along: Vec<f64> = along.iter().map(|truth| residual.ideal(*truth)).collect();
        let finding = |one: &Selected| {
            let values = map.values(one.fit, 1.0)?;
            let errors = values.iter().zip(&truth).map(|(value, truth)| residual.of(*value, *truth));
            let curves = lines.lines(&along, &lines.values(one.fit, 1.0)?);
            page::fit(one, shown_as.clone(), curves, map.field(&error_of, true, errors))
        };
        Ok(Findings {
            truths: vec![map.field(self.column, false, truth.iter().copied())],
            tables: made.tables.iter().filter_map(|t| table::finding(t, &made.part, Vec::new())).collect(),
            fits: chosen.iter().map(finding).collect::<Result<_, BakeError>>()?,
            spheres: spheres.into_iter().collect(),
            ..found
        })
    }

    /// What the live page draws: the column as the light that comes back, where pages show it, then at the
    /// ends of the range of an input that they show at one value.
    fn explored(
        &self,
        made: &mut Made,
        job: &Job,
        (fits, region, shown): (&[Fit], &Region, &[(&'static str, f64)]),
        context: &Context,
    ) -> Result<(), BakeError> {
        let mut places = vec![shown.to_vec()];
        if let [(input, usual)] = *shown {
            let ends = job.ranges.get(input).into_iter().flatten().filter(|end| **end != usual);
            places.extend(ends.map(|end| vec![(input, *end)]));
        }
        let outputs = [self.column];
        let exploring = |(i, at): (usize, Vec<(&'static str, f64)>)| Exploring {
            name: if i == 0 { self.of.into() } else { format!("{}-{i}", self.of) },
            title: format!("{}: {}{}", self.of, self.column, at_text(&at)),
            lead: format!("Brightness is {} of {}{}.", self.column, self.of, at_text(&at)),
            drawn: Drawn::Value,
            quantity: self.quantity,
            outputs: &outputs,
            variant: self.variant(context.scene),
            region: *region,
            at,
            f0: 1.0,
            fits: fits.iter().collect(),
            tables: Vec::new(),
        };
        let all: Vec<Exploring> = places.into_iter().enumerate().map(exploring).collect();
        made.explored(context, &all)
    }

    fn truths(&self, grid: &Grid, context: &Context) -> Result<Vec<f64>, BakeError> {
        let points = &grid.points;
        context.memo.add(points.len());
        let (quantity, variant) = (self.quantity, self.variant(context.scene));
        let tolerance = quantity.tolerance_of_many(&variant);
        let [column] = quantity.truth(&variant, points, &[self.column], tolerance)?.arrays();
        Ok(column)
    }
}
