//! The part of the effect `diffuse-coupling`: fits of the factor, one set for each kind of lobe that lies above a base.

use super::{code, findings};
use crate::approximate::{Dropped, Fit, FitSet, Region};
use crate::bake::Baked;
use crate::bake::Part;
use crate::data::Use;
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::coupling::{AnyF0, CouplingSpec, anywhere, fit_all};
use crate::effects::reflection::bake::unkept;
use crate::emit::manifest::canonical;
use crate::emit::manifest::{AnyF0Entry, Entries, FitEntry, FitLeftOut, Report};
use crate::plan::{CouplingJob, Effect};
use crate::report;
use crate::scene::Scene;
use crate::store::Files;

const EFFECT: &str = "diffuse-coupling";

/// What was made for the bases under one kind of lobe.
pub(super) struct Lobe {
    pub spec: CouplingSpec,
    pub fits: Vec<Fit>,
    pub dropped: Vec<Dropped>,
    /// The error of each of the fits over all f0.
    pub anywhere: Vec<AnyF0>,
}

/// Bakes the effect; its fits and hypotheses left out go into `baked` as well.
pub fn part(
    scene: &Scene,
    jobs: &[CouplingJob],
    effect: &Effect,
    baked: &mut Baked,
    context: &mut Context,
) -> Result<Part, BakeError> {
    context.progress.stage("fits of the coupling");
    let mut lobes = Vec::new();
    for job in jobs {
        let lobe = Lobe::fitted(job, context)?;
        let what = format!("coupling under a {} lobe", job.specular.name());
        for promise in &job.promises {
            context.broken.extend(unkept(promise, &lobe.fits, &what, Use::Coupling));
        }
        lobes.push(lobe);
    }
    let (mut entries, mut files) = (Entries::default(), Files::new());
    for lobe in &lobes {
        lobe.enter(scene, &mut entries)?;
    }
    context.progress.stage("report of diffuse-coupling");
    let findings = findings::findings(scene, &lobes, effect, context)?;
    for file in report::files(EFFECT, &super::page::page(&findings)?, &findings)? {
        entries.reports.push(canonical(&Report { effect: Some(EFFECT), file: file.path.clone() })?);
        files.insert(file.path, file.bytes);
    }
    let code = code::section(&lobes)?;
    for lobe in lobes {
        baked.take(lobe.fits, lobe.dropped);
    }
    Ok(Part { effect: effect.effect, finding: findings.effect, entries, code, files })
}

impl Lobe {
    fn fitted(job: &CouplingJob, context: &Context) -> Result<Lobe, BakeError> {
        let spec = CouplingSpec {
            specular: job.specular,
            smith: job.smith,
            region: Region { roughness: job.roughness, mu: job.mu, alpha_map: job.alpha_map },
            f0: job.f0,
            max_ops: job.max_ops,
            norms: job.norms.clone(),
        };
        let FitSet { fits, dropped } = fit_all(&spec, &context.counter)?;
        let anywhere = anywhere(&spec, &fits.iter().collect::<Vec<_>>(), &context.counter)?;
        Ok(Lobe { spec, fits, dropped, anywhere })
    }

    /// Each fit with its error over all f0.
    pub fn measured(&self) -> impl Iterator<Item = (&Fit, &AnyF0)> {
        self.fits.iter().zip(&self.anywhere)
    }

    /// The most accurate of the emitted factors, the cheapest of equals: the one that a material is shown with.
    pub fn best(&self) -> Option<&Fit> {
        let rank = |fit: &&Fit| (fit.approximation.certificate.max_abs, fit.approximation.cost.ops);
        let emitted = self.fits.iter().filter(|fit| fit.emitted);
        emitted.min_by(|a, b| rank(a).0.total_cmp(&rank(b).0).then(rank(a).1.cmp(&rank(b).1)))
    }

    /// Notes what is emitted, and what is left out.
    fn enter(&self, scene: &Scene, entries: &mut Entries) -> Result<(), BakeError> {
        for (fit, any) in self.measured().filter(|(fit, _)| fit.emitted) {
            if let Some(entry) = FitEntry::new(EFFECT, scene.alpha.name(), &fit.approximation) {
                let any = AnyF0Entry {
                    max_abs: any.max,
                    at: any.at.clone(),
                    places: any.places,
                    looked_at: any.f0.words(),
                };
                entries.fits.push(canonical(&entry.under(self.spec.specular.name(), any, fit.safe.clone()))?);
            }
        }
        for dropped in &self.dropped {
            entries.fits_left_out.push(canonical(&FitLeftOut {
                effect: EFFECT,
                hypothesis: dropped.hypothesis.clone(),
                norm: dropped.norm.into(),
                reason: dropped.reason.clone(),
            })?);
        }
        Ok(())
    }
}
