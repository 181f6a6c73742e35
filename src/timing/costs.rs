//! What every formula of a bake costs: operations, and compiled code on the GPUs of each vendor.

use super::isa::{IsaRecord, Precision};
use super::priced::priced;
use crate::approximate::Fit;
use crate::bake::{BakeError, Baked};
use crate::data::{Norm, Source, Vendor};
use crate::emit::include::Include;
use crate::report::{CostJob, CostPoint, CostUnit};
use lobefit_truth::quantity::{COUPLING, Specular};

/// A vendor with the record of its compiled code.
struct Counted<'a> {
    vendor: Vendor,
    record: &'a IsaRecord,
}

/// Units and formulas of the bake of a scene, the fits of the largest error and published formulas.
///
/// # Errors
/// No model of a vendor's GPUs; a scene that emits no WGSL.
pub fn costs(
    baked: &Baked,
    scene: &str,
    records: &[IsaRecord],
) -> Result<(Vec<CostUnit>, Vec<CostJob>), BakeError> {
    let lacks = || BakeError::Scene {
        field: "languages".into(),
        message: "compiled code is of WGSL: add wgsl".into(),
    };
    let include = Include::of(&baked.files).ok_or_else(lacks)?;
    let record = |vendor| {
        let of = |record: &&IsaRecord| record.driver == priced(vendor).driver && record.scene == scene;
        Some(Counted { vendor, record: records.iter().find(of)? })
    };
    let counted: Vec<Counted> = Vendor::ALL.into_iter().filter_map(record).collect();
    let mut units =
        vec![CostUnit { name: "operations".into(), counted: String::new(), unit: "operations".into() }];
    units.extend(counted.iter().map(Counted::unit));
    let mut jobs: Vec<(String, CostJob)> = Vec::new();
    let mut lobe = String::new();
    for fit in baked.fits.iter().filter(|fit| fit.norm() != Norm::Rms.name()) {
        let a = &fit.approximation;
        let specular = Specular::ALL.iter().find(|s| a.name.starts_with(&format!("coupling_{}_", s.name())));
        if let Some(specular) = specular {
            lobe = format!(", under a {} lobe", specular.name());
        }
        let about = match a.used_as.name {
            "value" => format!("{} of {}", a.column, a.quantity),
            _ if a.used_as.meaning.contains(&a.quantity) => a.quantity.clone(),
            _ => format!("{}: {}", a.quantity, a.used_as.meaning),
        };
        let title = about + if a.used_as == COUPLING { &lobe } else { "" };
        let mut costs = vec![Some(f64::from(a.cost.ops))];
        for of in &counted {
            costs.push(of.cost(fit, &include)?);
        }
        let published = a.source != Source::Fitted;
        let point = CostPoint { name: a.name.clone(), error: a.certificate.max_abs, published, costs };
        match jobs.iter_mut().find(|(known, _)| *known == title) {
            Some((_, job)) => job.points.push(point),
            None => {
                let metric = a.used_as.metric.into();
                jobs.push((title.clone(), CostJob { title, metric, points: vec![point] }));
            }
        }
    }
    Ok((units, jobs.into_iter().map(|(_, job)| job).collect()))
}

impl Counted<'_> {
    fn unit(&self) -> CostUnit {
        let priced = priced(self.vendor);
        let name = format!("{} {}", self.vendor.title(), priced.family);
        // What follows a comma is how they are counted.
        let counted = priced.unit.split(',').next().unwrap_or(priced.unit).into();
        CostUnit { name, counted, unit: format!("{}, by {}", priced.unit, self.record.compiler()) }
    }

    /// What the compiled code of a formula of ours costs, if it is of this code; of a published one,
    /// which is not emitted, what the vendor's model says.
    fn cost(&self, fit: &Fit, include: &Include) -> Result<Option<f64>, BakeError> {
        let name = fit.hypothesis.name();
        let current = include.hash(name).is_some_and(|hash| self.record.is_of(name, &hash));
        let priced = priced(self.vendor);
        let mut rows =
            self.record.rows.iter().filter(|row| row.function == name && row.family == priced.family);
        let row = rows.find(|row| row.precision == Precision::F32).filter(|_| current);
        if row.is_some() || fit.emitted {
            return Ok(row.and_then(|row| (priced.cost)(&row.counts)));
        }
        let price = self.vendor.price(&fit.hypothesis.tape().features());
        Ok(Some(price.map_err(crate::approximate::FitStageError::from)?))
    }
}
