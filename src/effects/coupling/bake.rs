//! Jobs to fits of the factor, one set for each kind of lobe that lies above a base.

use super::emitted::{around as coupled, coloured};
use super::{AnyF0, CouplingSpec, anywhere, code, evaluations, findings, fit_emitted, page, role, specular};
use crate::approximate::{Dropped, Fit, FitSet};
use crate::effects::context::Context;
use crate::effects::demand::Job;
use crate::effects::explore::Exploring;
use crate::effects::page::smallest_error;
use crate::effects::{BakeError, Called, Made};
use crate::emit::call::ROUGH_BASE;
use crate::emit::manifest::{AnyF0Entry, FitEntry};
use crate::report::explore::Drawn;
use lobefit_truth::quantity::{COUPLING, GGX_REFLECTION};

/// What was made for the bases under one kind of lobe.
pub(super) struct Lobe {
    pub spec: CouplingSpec,
    pub fits: Vec<Fit>,
    pub dropped: Vec<Dropped>,
    /// What keeps the stated error, where none of the fits does.
    pub nearest: Option<String>,
    /// The error of each of the fits over all f0.
    pub anywhere: Vec<AnyF0>,
}

/// Bakes the effect.
pub(super) fn bake(called: &Called, context: &Context) -> Result<Made, BakeError> {
    context.progress.stage("fits of the coupling");
    let lobes: Vec<Lobe> =
        called.work.iter().map(|job| Lobe::fitted(job, context)).collect::<Result<_, _>>()?;
    let worst = lobes.iter().filter_map(|lobe| smallest_error(&lobe.fits)).reduce(f64::max);
    let metric = "error of the factor of the best fit, under the lobe where that is largest";
    let mut made = Made::new(called, worst, metric);
    for (job, lobe) in called.work.iter().zip(&lobes) {
        let what = format!("coupling under a {} lobe", lobe.spec.specular.name());
        made.promised(job, (&lobe.fits, &lobe.nearest), &what, COUPLING);
    }
    if !made.broken.is_empty() {
        return Ok(made);
    }
    if context.reports(called.effect) {
        let findings = findings::findings(&made.part.finding, &lobes, context)?;
        made.furnaces.extend(findings.lobes.iter().flat_map(|lobe| lobe.furnace.spheres()));
        made.page(page::page(&findings)?, &findings)?;
    }
    let exploring: Vec<Exploring> = lobes.iter().map(Lobe::exploring).collect();
    made.explored(context, &exploring)?;
    made.code(context, |language| lobes.iter().map(|lobe| code::in_language(language, lobe)).collect())?;
    for (job, lobe) in called.work.iter().zip(&lobes) {
        made.fits_called(job, &lobe.fits, context.scene);
        let brdf = format!("diffuse_coupled_{} is the BRDF that calls it.", lobe.spec.specular.name());
        if let Some(best) = lobe.best() {
            made.called_within(best.hypothesis.name(), coupled(lobe.spec.specular));
        }
        let emitted = lobe.fits.iter().filter(|fit| fit.emitted);
        made.cautions.extend(emitted.map(|fit| (fit.hypothesis.name().to_string(), brdf.clone())));
    }
    for call in &mut made.part.entries.calls {
        let material = context.scene.materials.iter().find(|material| material.name == call.of);
        let times = material.map_or(1, evaluations);
        if material.is_some_and(|own| own.rough_base().is_some()) {
            // What calls it adds Lambert's lobe.
            call.around.clear();
            call.then = Some(ROUGH_BASE.into());
        }
        call.cost.ops *= times;
        call.price = call.price.map(|price| price * f64::from(times));
        if times > 1 {
            // A tinted base takes those for three channels, where they are.
            let all: Vec<String> = call.around.iter().map(|around| around.function.clone()).collect();
            call.around.retain(|around| !all.contains(&coloured(&around.function)));
        }
    }
    for lobe in lobes {
        let set = (lobe.fits.clone(), lobe.dropped.clone());
        made.fits(context, set, |i, fit, entry| lobe.entry(i, fit, entry))?;
    }
    Ok(made)
}

impl Lobe {
    fn fitted(job: &Job, context: &Context) -> Result<Lobe, BakeError> {
        let lacks = || BakeError::Internal(format!("{}: no base", job.name));
        let spec = CouplingSpec {
            specular: specular(context.scene, job).ok_or_else(lacks)?,
            smith: context.scene.smith,
            region: job.region(context.scene.alpha)?,
            f0: job.range("f0")?,
            max_ops: job.budget().max_ops,
            norms: job.goals.norms.clone(),
        };
        let emission = job.emission(context.scene, &role(spec.specular));
        let FitSet { fits, dropped, nearest, .. } = fit_emitted(&spec, emission, &context.memo)?;
        let anywhere = anywhere(&spec, &fits.iter().collect::<Vec<_>>(), &context.memo)?;
        Ok(Lobe { spec, fits, dropped, nearest, anywhere })
    }

    /// Each fit with its error over all f0.
    pub fn measured(&self) -> impl Iterator<Item = (&Fit, &AnyF0)> {
        self.fits.iter().zip(&self.anywhere)
    }

    /// The most accurate of the emitted factors, the cheapest of equals: the one that a material is
    /// shown with.
    pub fn best(&self) -> Option<&Fit> {
        let rank = |fit: &&Fit| (fit.approximation.certificate.max_abs, fit.approximation.cost.ops);
        let emitted = self.fits.iter().filter(|fit| fit.emitted);
        emitted.min_by(|a, b| rank(a).0.total_cmp(&rank(b).0).then(rank(a).1.cmp(&rank(b).1)))
    }

    /// A base below this lobe, as the live page draws it.
    fn exploring(&self) -> Exploring<'_> {
        let CouplingSpec { specular, smith, region, f0, .. } = self.spec;
        let name = specular.name();
        Exploring {
            name: format!("base-{name}"),
            title: format!("dielectric: diffuse base below a {name} lobe"),
            lead: format!(
                "A white base below a lobe that is multiplied by {}. The lobe is exact: what is missing or too much is the base's factor.",
                specular.formula()
            ),
            drawn: Drawn::Base(specular),
            quantity: GGX_REFLECTION,
            outputs: &["E", "B"],
            variant: smith.into(),
            region,
            at: Vec::new(),
            f0: f0[0],
            fits: self.fits.iter().collect(),
            tables: Vec::new(),
        }
    }

    /// The entry of a fit with its error over all f0, and where it is proven to have no pole and no
    /// value below 0.
    fn entry(&self, i: usize, fit: &Fit, entry: FitEntry) -> FitEntry {
        let any = &self.anywhere[i];
        let any = AnyF0Entry {
            max_abs: any.max,
            at: any.at.clone(),
            places: any.places,
            looked_at: any.f0.words(),
        };
        entry.under(self.spec.specular.name(), any, fit.safe.clone())
    }
}
