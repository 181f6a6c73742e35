//! What the bake of an effect made.

use std::collections::BTreeMap;

use serde::Serialize;

use super::context::Context;
use super::demand::{Caller, Job, Promise};
use super::explore::Exploring;
use super::table::BakedTable;
use super::{BakeError, Called, Effect, answer};
use crate::approximate::{Dropped, Fit};
use crate::data::{Approximation, Use};
use crate::emit::call::{Around, Call, How, TIMES};
use crate::emit::manifest::{Entries, FitEntry, FitLeftOut, Report};
use crate::emit::{compensation, include};
use crate::report::explore::Explored;
use crate::report::{self, Answer, Draft, EffectFinding, Findings, Furnace, Offer, Page, Purpose, words};
use crate::scene::Scene;
use crate::store::Files;
use lobefit_shade::code::{Language, pair_of};
use lobefit_shade::comment::comment;

/// What one effect adds to the files of a bake. The same recipe gives the same part, so one that an
/// older bake left on the disk stands for the one that would be made.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The effect.
    pub by: &'static dyn Effect,
    /// What the scene called for and what was measured.
    pub finding: EffectFinding,
    /// Its entries in the manifest.
    pub entries: Entries,
    /// Its section of each include file, by language.
    pub code: BTreeMap<Language, String>,
    /// Its tables and pages.
    pub files: Files,
    /// What it adds to the live page.
    pub explored: Vec<Explored>,
    /// What a reader takes from it.
    pub answer: Answer,
}

/// The part of an effect, with the results that it was made from.
#[derive(Debug)]
pub struct Made {
    /// What it adds to the files.
    pub part: Part,
    /// Promises of the scene that are not kept, each a sentence.
    pub broken: Vec<String>,
    /// Fits, and published formulas for comparison; each name once.
    pub fits: Vec<Fit>,
    /// Hypotheses of the catalogue that have no reliable fit in this scene.
    pub dropped: Vec<Dropped>,
    /// Tables.
    pub tables: Vec<BakedTable>,
    /// What the fits are for.
    pub purposes: Vec<Purpose>,
    /// Functions of tables, each with what its lookup error does not say.
    pub cautions: Vec<(String, String)>,
    /// Functions that are recommended, each with what there is to take in its place that neither fits
    /// nor tables of its column are.
    pub beside: Vec<(String, Offer)>,
    /// What the scene limits where that is not the error of the certificates.
    pub limited: Option<Limited>,
    /// Spheres in a white environment, the rows named after what they show.
    pub furnaces: Vec<Furnace>,
    /// Its page, which waits for the conclusion.
    draft: Option<Draft>,
}

/// An error of approximations that is not the one of their certificates.
#[derive(Debug)]
pub struct Limited {
    /// What it is, in words.
    pub metric: String,
    /// Its largest value, by approximation.
    pub errors: BTreeMap<String, f64>,
}

impl Made {
    /// Nothing yet, with the error that was measured and what error that is.
    pub fn new(called: &Called, measured: Option<f64>, metric: &str) -> Made {
        Made::of(Part {
            by: called.by,
            finding: called.finding(measured, metric),
            entries: Entries::default(),
            code: BTreeMap::new(),
            files: Files::new(),
            explored: Vec::new(),
            answer: Answer::default(),
        })
    }

    /// Notes an error that was measured and what error that is; of several, which have units of their own,
    /// the first counts and the metric states the others.
    pub fn measured(&mut self, error: Option<f64>, metric: &str) {
        let finding = &mut self.part.finding;
        match error.filter(|_| !finding.metric.is_empty()) {
            Some(error) => finding.metric += &format!("; {metric}: {}", words::max(error)),
            None => (finding.measured_error, finding.metric) = (error, metric.into()),
        }
    }

    /// A part, and nothing beside it.
    pub fn of(part: Part) -> Made {
        Made {
            part,
            broken: Vec::new(),
            fits: Vec::new(),
            dropped: Vec::new(),
            tables: Vec::new(),
            purposes: Vec::new(),
            cautions: Vec::new(),
            beside: Vec::new(),
            limited: None,
            furnaces: Vec::new(),
            draft: None,
        }
    }

    /// The part that is done: the answer to what the effect was called for, and the page with it.
    ///
    /// # Errors
    /// Figures that are not finite.
    pub fn finished(mut self, scene: &Scene) -> Result<Made, BakeError> {
        let answer = answer::answer(&self);
        if let Some(limited) = &self.limited {
            answer::limit_calls(&mut self.part.entries, limited);
        }
        answer::mark(&mut self.part.entries, &answer.purposes);
        for call in &mut self.part.entries.calls {
            let material = scene.materials.iter().find(|material| material.name == call.of);
            call.without = material.and_then(|own| (self.part.by.profile().without)(own)).map(String::from);
        }
        self.signed()?;
        let recommended = comment("//", &answer::recommendations(&self.part.entries.calls));
        // Behind the head of a file, where Rust takes no inner documentation.
        self.part.code.values_mut().for_each(|text| text.insert_str(0, &recommended));
        let Some(draft) = self.draft.take() else { return Ok(self) };
        self.part.answer = report::settled(answer)?;
        let effect = self.part.by.name();
        for file in draft.files(&self.part.answer.conclusion) {
            let entry = Report { effect: Some(effect.into()), file: file.path.clone() };
            self.part.entries.reports.push(entry);
            self.part.files.insert(file.path, file.bytes);
        }
        Ok(self)
    }

    /// Gives each call its arguments, and those of the emitted functions that take its value or call it.
    ///
    /// # Errors
    /// A call of a function that no entry has: a defect of the effect.
    fn signed(&mut self) -> Result<(), BakeError> {
        let mut calls = std::mem::take(&mut self.part.entries.calls);
        let text = self.part.code.values().next().map_or("", String::as_str);
        let declared = |function: &str| include::call(text, function).map(|declared| declared.arguments);
        for call in &mut calls {
            let unknown = || BakeError::Internal(format!("{} is not declared in fits/", call.function));
            let own = self.part.entries.arguments(&call.function);
            call.arguments = own.or_else(|| declared(&call.function)).ok_or_else(unknown)?;
            // Of a compensation the function of colours and that of the factor.
            let takers = call.then.iter().flat_map(|then| [then.clone(), format!("{then}_factor")]);
            call.around.splice(..0, takers.map(|function| Around::new(function, How::TakesValue)));
            call.around.retain_mut(|around| {
                // Effects share the compensations.
                let shared = || compensation::arguments(&around.function);
                if let Some(arguments) = declared(&around.function).or_else(shared) {
                    around.signed(arguments);
                }
                !around.arguments.is_empty()
            });
        }
        self.part.entries.calls = calls;
        Ok(())
    }

    /// Notes that functions, where they are emitted, call one that materials call.
    pub fn called_within(&mut self, function: &str, by: impl IntoIterator<Item = String>) {
        let by: Vec<Around> = by.into_iter().map(|name| Around::new(name, How::Calls)).collect();
        let calls = self.part.entries.calls.iter_mut().filter(|call| call.function == function);
        calls.for_each(|call| call.around.extend(by.iter().cloned()));
    }

    /// Enters the emitted fits of a job, with what `more` adds to the entry of the fit at an index,
    /// and the hypotheses without one. A published formula is measured for every job; one result of
    /// a name is enough.
    ///
    /// # Errors
    /// A formula that cannot be printed.
    pub fn fits(
        &mut self,
        context: &Context,
        (fits, dropped): (Vec<Fit>, Vec<Dropped>),
        more: impl Fn(usize, &Fit, FitEntry) -> FitEntry,
    ) -> Result<(), BakeError> {
        self.purposes.extend(answer::of_fits(&fits, &context.scene.output.languages)?);
        let (effect, alpha_map) = (self.part.by.name(), context.scene.alpha.name());
        let entries = &mut self.part.entries;
        for (i, fit) in fits.iter().enumerate().filter(|(_, fit)| fit.emitted) {
            let entry = FitEntry::new(effect, alpha_map, &fit.approximation);
            let (function, pair) = (fit.hypothesis.name().to_string(), pair_of(&fit.hypothesis));
            entries.fits.extend(entry.map(|entry| more(i, fit, FitEntry { function, pair, ..entry })));
        }
        entries.fits_left_out.extend(dropped.iter().map(|dropped| FitLeftOut {
            effect: effect.into(),
            hypothesis: dropped.hypothesis.clone(),
            norm: dropped.norm.into(),
            reason: dropped.reason.clone(),
        }));
        for fit in fits {
            // Formulas of fewer inputs have one name in every job, and functions of their own.
            let names = |fit: &Fit| [fit.approximation.name.clone(), fit.hypothesis.name().to_string()];
            if self.fits.iter().all(|known| names(known) != names(&fit)) {
                self.fits.push(fit);
            }
        }
        self.dropped.extend(dropped);
        Ok(())
    }

    /// Notes that each of some materials or probes calls a function of an approximation, which costs
    /// so much on the GPUs of the vendor that the scene names.
    pub fn called_by(
        &mut self,
        callers: Vec<Caller>,
        function: &str,
        (a, price): (&Approximation, Option<f64>),
        file: Option<&str>,
    ) {
        let effect = self.part.by.name();
        self.part.entries.calls.extend(callers.into_iter().map(|by| Call {
            effect: effect.into(),
            of: by.name,
            layer: by.layer.map(String::from),
            function: function.into(),
            name: a.name.clone(),
            file: file.map(String::from),
            then: (a.used_as == Use::NORMALISATION).then(|| TIMES.into()),
            max_error: a.certificate.max_abs,
            metric: answer::metric(a),
            cost: a.cost,
            price,
            ..Call::default()
        }));
    }

    /// Notes that the materials or probes of a job call the emitted ones of its fits.
    pub fn fits_called(&mut self, job: &Job, fits: &[Fit], scene: &Scene) {
        for fit in fits.iter().filter(|fit| fit.emitted) {
            let price = scene.output.cost.map(|_| fit.price);
            self.called_by(job.callers(), fit.hypothesis.name(), (&fit.approximation, price), None);
        }
    }

    /// Notes the promises that no emitted fit keeps, with what would.
    pub fn promised(
        &mut self,
        job: &Job,
        (fits, nearest): (&[Fit], &Option<String>),
        what: &str,
        used_as: Use,
    ) {
        if let (Some(nearest), []) = (nearest, job.promises.as_slice()) {
            let by = job.bounded_by();
            self.broken.push(format!("{what}: no formula is within the budget of {by}: {nearest}"));
        }
        let nearest = nearest.as_ref().map_or_else(String::new, |nearest| format!("; {nearest}"));
        let broken = job.promises.iter().filter_map(|promise| unkept(promise, fits, what, used_as));
        self.broken.extend(broken.map(|text| text + &nearest));
    }

    /// Adds to the section of each include file; no section in a language without text.
    ///
    /// # Errors
    /// A formula that cannot be printed.
    pub fn code(
        &mut self,
        context: &Context,
        print: impl Fn(Language) -> Result<String, BakeError>,
    ) -> Result<(), BakeError> {
        for &language in &context.scene.output.languages {
            let text = print(language)?;
            if !text.is_empty() {
                self.part.code.entry(language).or_default().push_str(&text);
            }
        }
        Ok(())
    }

    /// The page, and its figures as JSON.
    ///
    /// # Errors
    /// Figures that are not finite.
    pub fn page(&mut self, page: Page, figures: &impl Serialize) -> Result<(), BakeError> {
        self.draft = Some(report::draft(self.part.by.name(), page, figures)?);
        Ok(())
    }

    /// The default page: of fits and tables over roughness and mu.
    ///
    /// # Errors
    /// As [`Made::page`].
    pub fn findings(&mut self, findings: &Findings) -> Result<(), BakeError> {
        self.draft = Some(report::page(self.part.by.name(), findings)?);
        Ok(())
    }

    /// Adds to the live page, where the effect does and the scene wants pages.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn explored(&mut self, context: &Context, exploring: &[Exploring]) -> Result<(), BakeError> {
        if context.scene.output.reports && self.part.by.profile().is_explored {
            for one in exploring {
                self.part.explored.push(one.explored(context)?);
            }
        }
        Ok(())
    }
}

/// A sentence, after `what`, where no emitted fit for the use, of at most so many operations, is
/// within the promised error.
fn unkept(promise: &Promise, fits: &[Fit], what: &str, used_as: Use) -> Option<String> {
    let emitted = fits.iter().filter(|f| f.emitted);
    let affordable = emitted
        .map(|f| &f.approximation)
        .filter(|a| a.used_as == used_as)
        .filter(|a| promise.max_ops.is_none_or(|most| a.cost.ops <= most));
    let best = affordable.min_by(|a, b| a.certificate.max_abs.total_cmp(&b.certificate.max_abs));
    let wanted = promise.text();
    let (name, error) = match used_as {
        Use::NORMALISATION => ("normalisation", "furnace error"),
        _ => ("fit", "error"),
    };
    match best {
        None => Some(format!("{what}: no {name} is that cheap: {wanted}")),
        Some(a) if a.certificate.max_abs > promise.max_error => {
            Some(format!("{what}: the best is {} with {error} {}: {wanted}", a.name, a.certificate.max_abs))
        }
        Some(_) => None,
    }
}
