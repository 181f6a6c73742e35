//! What every formula of a bake costs: operations, compiled code on the GPUs of each vendor, and time
//! where it was measured.

use super::isa::{IsaRecord, Precision};
use super::priced::priced;
use crate::approximate::Fit;
use crate::bake::{BakeError, Baked};
use crate::data::{Form, Formula, Half, Norm, Source, Use, Vendor};
use crate::emit::include::Include;
use crate::report::{CostJob, CostPoint, CostUnit, GpuRecord};
use lobefit_math::correlation::Correlation;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::{COUPLING, Specular};

/// What formulas are counted by: the record of a vendor's compiled code, or of times.
enum Counted<'a> {
    Compiled(Vendor, &'a IsaRecord),
    Timed(&'a GpuRecord),
}

/// Units and formulas of the bake of a scene, the fits of the largest error and published formulas.
///
/// # Errors
/// No model of a vendor's GPUs; a scene that emits no WGSL.
pub fn costs(
    baked: &Baked,
    scene: &str,
    records: &[IsaRecord],
    times: &[GpuRecord],
) -> Result<(Vec<CostUnit>, Vec<CostJob>), BakeError> {
    let lacks = || BakeError::Scene {
        field: "languages".into(),
        message: "compiled code is of WGSL: add wgsl".into(),
    };
    let include = Include::of(&baked.files).ok_or_else(lacks)?;
    let record = |vendor| {
        let of = |record: &&IsaRecord| record.driver == priced(vendor).driver && record.scene == scene;
        Some(Counted::Compiled(vendor, records.iter().find(of)?))
    };
    let compiled = Vendor::ALL.into_iter().filter_map(record);
    let counted: Vec<Counted> = compiled.chain(times.iter().map(Counted::Timed)).collect();
    let mut units =
        vec![CostUnit { name: "operations".into(), unit: "operations".into(), ..CostUnit::default() }];
    units.extend(counted.iter().map(|of| of.unit(baked, &include)));
    let mut jobs: Vec<(String, CostJob)> = Vec::new();
    let mut lobe = String::new();
    for fit in baked.fits.iter().filter(|fit| fit.norm() != Norm::Rms.name()) {
        let a = &fit.approximation;
        let specular = Specular::ALL.iter().find(|s| a.name.starts_with(&format!("coupling_{}_", s.name())));
        if let Some(specular) = specular {
            lobe = specular.name().into();
        }
        let title = title([&a.quantity, &a.column], a.used_as, Some(&lobe), a.side.map(Side::name));
        let mut costs = vec![Some(f64::from(a.cost.ops))];
        for of in &counted {
            costs.push(of.cost(fit, &include)?);
        }
        let published = a.source != Source::Fitted;
        let half = match &a.form {
            // Fits of half precision have no other error.
            Form::Formula(Formula { half: Some(Half::Measured(half)), .. })
                if a.certificate.precision == "f32" =>
            {
                Some(half.max_abs)
            }
            _ => None,
        };
        let point = CostPoint { name: a.name.clone(), error: a.certificate.max_abs, half, published, costs };
        match jobs.iter_mut().find(|(known, _)| *known == title) {
            Some((_, job)) => job.points.push(point),
            None => {
                let metric = a.used_as.metric.into();
                let domain = a.certificate.domain.clone();
                jobs.push((title.clone(), CostJob { title, metric, domain, points: vec![point] }));
            }
        }
    }
    let jobs: Vec<CostJob> = jobs.into_iter().map(|(_, job)| job).collect();
    for (k, of) in counted.iter().enumerate() {
        let Counted::Timed(record) = of else { continue };
        let is_own = |of: &Counted| matches!(of, Counted::Compiled(vendor, _) if record.is_of(*vendor));
        let own = counted.iter().position(is_own).map(|own| own + 1);
        let followed =
            [Some(0), own].into_iter().flatten().filter_map(|of| followed(&units, &jobs, [of, k + 1]));
        let followed: String = followed.collect();
        units[k + 1].unit += &followed;
    }
    Ok((units, jobs))
}

/// What formulas for a use stand for; of factors of what lies below, with the lobe above, and with the
/// side of the view where there are two.
pub fn title(
    [quantity, column]: [&str; 2],
    used_as: Use,
    specular: Option<&str>,
    side: Option<&str>,
) -> String {
    let about = match used_as.name {
        "value" => format!("{column} of {quantity}"),
        _ if used_as.meaning.contains(quantity) => quantity.into(),
        _ => format!("{quantity}: {}", used_as.meaning),
    };
    match (specular.filter(|_| used_as == COUPLING), side) {
        (Some(specular), _) => format!("{about}, under a {specular} lobe"),
        (None, Some(side)) => format!("{about}, from {side}"),
        (None, None) => about,
    }
}

/// How well a unit follows the times of another; none of fewer than three formulas.
fn followed(units: &[CostUnit], jobs: &[CostJob], [of, timed]: [usize; 2]) -> Option<String> {
    let points = jobs.iter().flat_map(|job| &job.points);
    let pairs: Vec<_> = points.filter_map(|point| Some((point.costs[of]?, point.costs[timed]?))).collect();
    let Correlation { values, count, .. } = Correlation::of(&pairs)?;
    let name = &units[of].name;
    Some(format!(
        "; its correlation (Pearson) with {name} is {values:.3} over {count} formulas of the largest error"
    ))
}

impl Counted<'_> {
    fn unit(&self, baked: &Baked, include: &Include) -> CostUnit {
        let (vendor, record) = match self {
            Counted::Compiled(vendor, record) => (*vendor, record),
            Counted::Timed(record) => {
                let unit = "picoseconds of a call on a full device, of published ones those that are emitted";
                let name = record.device.adapter.clone();
                let (counted, unit) = ("picoseconds".into(), unit.into());
                return CostUnit { name, counted, unit, ..CostUnit::default() };
            }
        };
        let priced = priced(vendor);
        let name = format!("{} {}", vendor.title(), priced.family);
        // What follows a comma is how they are counted.
        let counted = priced.unit.split(',').next().unwrap_or(priced.unit).into();
        let unit = format!(
            "{}, by {}, published ones by the model of that compiler",
            priced.unit,
            record.compiler()
        );
        let listings = record.listings.as_ref().filter(|listings| listings.family == priced.family);
        let text = |fit: &Fit| {
            let name = fit.hypothesis.name();
            include.hash(name).filter(|hash| record.is_of(name, hash))?;
            Some((name.to_owned(), listings?.texts.get(name)?.clone()))
        };
        CostUnit { name, counted, unit, code: baked.fits.iter().filter_map(text).collect() }
    }

    /// What the compiled code of a formula of ours costs, if it is of this code; of a published one,
    /// which is not emitted, what the vendor's model says. Its time, if it is of this code.
    fn cost(&self, fit: &Fit, include: &Include) -> Result<Option<f64>, BakeError> {
        let name = fit.hypothesis.name();
        let (vendor, record) = match self {
            Counted::Compiled(vendor, record) => (*vendor, record),
            Counted::Timed(record) => return Ok(record.nanoseconds(name, include).map(|time| 1e3 * time)),
        };
        let current = include.hash(name).is_some_and(|hash| record.is_of(name, &hash));
        let priced = priced(vendor);
        let mut rows = record.rows.iter().filter(|row| row.function == name && row.family == priced.family);
        let row = rows.find(|row| row.precision == Precision::F32).filter(|_| current);
        if row.is_some() || fit.emitted {
            return Ok(row.and_then(|row| (priced.cost)(&row.counts)));
        }
        let price = vendor.price(&fit.hypothesis.tape().features());
        Ok(Some(price.map_err(crate::approximate::FitStageError::from)?))
    }
}
