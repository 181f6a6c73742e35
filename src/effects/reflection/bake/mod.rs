//! Jobs to fits of the normalisation and tables of E, A and B.

mod explore;
pub mod findings;
mod pictures;

use super::demand::{is_coloured, parted};
use super::mixed::{self, Shortcut};
use super::{FitJob, FitSpec, Reflection, fit_all};
use crate::approximate::{Emission, Fit, FitSet, FitStageError};
use crate::data::{Use, Vendor};
use crate::effects::code::{functions, rgb};
use crate::effects::context::Context;
use crate::effects::demand::{Budget, Job};
use crate::effects::table::{self, TableJob};
use crate::effects::{BakeError, Called, Made};
use crate::emit::compensation;
use crate::emit::manifest::FitEntry;
use crate::scene::Lobe;
use lobefit_shade::Source;
use lobefit_shade::code::{CodeError, Language};
use lobefit_truth::quantity::Specular;

/// The lobe of what is lost, behind the averages of Fresnel factors that it takes.
const MULTISCATTER: [&str; 5] = [
    "fresnel_average_schlick",
    "fresnel_average_f82",
    "fresnel_conductor",
    "fresnel_average_conductor",
    "ggx_multiscatter_lobe",
];

/// Its functions in a language.
fn printed(language: Language) -> Result<String, BakeError> {
    let text = include_str!("../multiscatter.wgsl");
    let source = Source::parse("multiscatter.wgsl", text).map_err(CodeError::from)?;
    let print = |name| Ok(format!("\n{}", source.print_documented(language, name)?));
    MULTISCATTER.into_iter().map(print).collect()
}

/// Bakes the effect.
pub(super) fn bake(of: &Reflection, called: &Called, context: &Context) -> Result<Made, BakeError> {
    let (jobs, fit) = parted(&called.work);
    let jobs = TableJob::all(context.scene, jobs)?;
    let (tables, broken) = table::bake(of, &jobs, context)?;
    let mut made = Made::new(called, None, "");
    made.broken = broken;
    // Every promise that is not kept is said at once: behind a table's that of a fit.
    if !made.broken.is_empty() && !fit.is_some_and(Job::is_promised) {
        return Ok(made);
    }
    let FitSet { fits, dropped, nearest, unserved } = match fit {
        Some(job) => bake_fits(of, job, context)?,
        None => FitSet::default(),
    };
    if let Some(job) = fit {
        let of_tables = made.broken.len();
        made.promised(job, (&fits, &nearest), "fit", Use::NORMALISATION);
        let last = made.broken.iter_mut().skip(of_tables).last();
        if let (Some(last), Some(limit)) = (last, job.goals.max_error) {
            let table = TableJob::open(context.scene, job.range("roughness")?, job.range("mu")?);
            *last += &format!("\n{}", table::table_instead(of, &table, limit, context)?);
        }
    }
    let is_kept = made.broken.is_empty();
    made.broken.extend(unserved);
    // What the limits leave of a job is not lost with its other functions (`lobefit cost`).
    if !is_kept || !made.broken.is_empty() && context.scene.output.reports {
        return Ok(made);
    }
    let (measured, metric) = findings::measured(&tables, &fits);
    made.part.finding = called.finding(measured, metric);
    let wants = fit.map(|job| FitJob::of(context.scene, job)).unwrap_or_default();
    let coloured = wants.coloured;
    let mixes = fit.map(|job| mixes(of, job, &wants.mixed, context)).transpose()?.unwrap_or_default();
    made.code(context, |language| {
        let mut text = functions(language, &fits, coloured)?;
        if wants.multiscatter {
            text += &printed(language)?;
        }
        for (specular, shortcut) in &mixes {
            text += &mixed::printed(language, *specular, shortcut)?;
        }
        Ok(text)
    })?;
    made.tables(context, tables)?;
    if context.reports(called.effect) {
        let region = fit.map(|job| job.region(context.scene.alpha)).transpose()?;
        let findings = findings::findings(of, (&made, region), (&fits, &dropped), context)?;
        made.furnaces = findings::furnaces(of, &made.tables, (region, &fits), context)?;
        made.findings(&findings)?;
    }
    explore::explored(of, &mut made, (fit, &fits), context)?;
    if let Some(job) = fit {
        fits_called(&mut made, job, &fits, context)?;
    }
    made.fits(context, (fits, dropped), |_, fit, entry| FitEntry { rgb: rgb(fit, coloured), ..entry })?;
    Ok(made)
}

/// What mixing f0 first loses for the metals of a job whose dielectric is multiplied so.
fn mixes(
    of: &Reflection,
    job: &Job,
    all: &[Specular],
    context: &Context,
) -> Result<Vec<(Specular, Shortcut)>, BakeError> {
    let region = job.region(context.scene.alpha)?;
    let mut mixes: Vec<(Specular, Shortcut)> = all.iter().map(|own| (*own, Shortcut::default())).collect();
    for material in job.demands.iter().filter_map(|demand| context.scene.materials.get(demand.of)) {
        let Some(mixed) = &material.mixed else { continue };
        let own = mixed::shortcut(of.lobe, &context.scene.smith.into(), (&region, material, mixed))?;
        let known =
            mixes.iter_mut().filter(|(specular, known)| *specular == mixed.specular && known.lost < own.lost);
        known.for_each(|(_, known)| *known = own);
    }
    Ok(mixes)
}

/// Notes which of the emitted fits the materials call: a metal, and a dielectric whose base is made for
/// such a lobe, the form for three channels.
fn fits_called(made: &mut Made, job: &Job, fits: &[Fit], context: &Context) -> Result<(), BakeError> {
    for fit in fits.iter().filter(|fit| fit.emitted) {
        for demand in &job.demands {
            let Some(material) = context.scene.materials.get(demand.of) else { continue };
            // Its tables are of its lobe; functions know one width.
            if material.lobe() == Lobe::Anisotropic && !material.wants.tables.is_empty() {
                continue;
            }
            let want = material.wants.fit.as_ref();
            let file = fit.hypothesis.file();
            let of_user = context.hypotheses.iter().any(|user| user.file == file);
            if of_user && !want.is_some_and(|want| want.hypotheses.iter().any(|path| path == file)) {
                continue;
            }
            let (mut a, name) = (fit.approximation.clone(), fit.hypothesis.name());
            let vendor = context.scene.output.cost;
            let mut price = vendor.map(|_| fit.price);
            let function = match a.used_as {
                Use::NORMALISATION if material.specular() == Specular::Single => continue,
                Use::NORMALISATION if is_coloured(material) => {
                    a.cost.ops += compensation::coloured_ops().map_err(CodeError::from)?;
                    price = vendor.map(|v| Ok::<_, BakeError>(fit.price + coloured_price(v)?)).transpose()?;
                    format!("{name}_rgb")
                }
                Use::NORMALISATION => name.into(),
                Use::F0_BLEND if want.is_some_and(|want| want.blend) => name.into(),
                Use::VALUE if want.is_some_and(|want| want.average) => name.into(),
                _ => continue,
            };
            made.called_by(vec![demand.caller()], &function, (&a, price), None);
            if let Some(call) = made.part.entries.calls.last_mut() {
                let is_average = a.used_as == Use::VALUE && want.is_some_and(|want| want.multiscatter);
                call.then = call.then.take().or_else(|| is_average.then(|| MULTISCATTER[4].into()));
                if let Some(mixed) = material.mixed.as_ref().filter(|_| a.used_as == Use::NORMALISATION) {
                    call.then = Some(mixed::name(mixed.specular).into());
                }
            }
        }
    }
    Ok(())
}

/// What a call for three channels costs beside N on a vendor's GPUs.
fn coloured_price(vendor: Vendor) -> Result<f64, BakeError> {
    Ok(vendor.model().map_err(FitStageError::from)?.coloured)
}

/// Fits all that the job asks for.
fn bake_fits(of: &Reflection, job: &Job, context: &Context) -> Result<FitSet, BakeError> {
    context.progress.stage("fits");
    let wants = FitJob::of(context.scene, job);
    let Budget { max_ops, call } = job.budget();
    let vendor = context.scene.output.cost.filter(|_| call.beside > 0);
    let beside_price = vendor.map(coloured_price).transpose()?.unwrap_or_default();
    let own = context.hypotheses.iter().filter(|h| wants.hypotheses.contains(&h.file));
    let spec = FitSpec {
        smith: context.scene.smith,
        region: job.region(context.scene.alpha)?,
        max_ops,
        norms: job.goals.norms.clone(),
        average: wants.average,
        // The lobe divides by 1 - E_avg, of which few operations leave nothing that is right.
        average_ops: max_ops.filter(|_| !wants.multiscatter),
        blend: wants.blend,
        hypotheses: own.map(|h| (h.file.clone(), h.source.clone())).collect(),
        emission: Emission { beside_price, ..job.emission(context.scene, of.roles[0]) },
    };
    Ok(fit_all(of, &spec, &context.memo)?)
}
