//! What the live page draws of this effect: a metal with its compensation, and the albedo of a
//! dielectric.

use crate::approximate::{Fit, Region};
use crate::data::{Ndf, Use};
use crate::effects::context::Context;
use crate::effects::demand::Job;
use crate::effects::explore::Exploring;
use crate::effects::reflection::Reflection;
use crate::effects::table::BakedTable;
use crate::effects::{BakeError, Made};
use crate::report::explore::Drawn;

/// f0 of glass and plastic.
const DIELECTRIC: f64 = 0.04;

/// Adds both, as far as fits or tables stand for them.
pub(super) fn explored(
    reflection: &Reflection,
    made: &mut Made,
    (job, fits): (Option<&Job>, &[Fit]),
    context: &Context,
) -> Result<(), BakeError> {
    let region = job.map(|job| job.region(context.scene.alpha)).transpose()?;
    let tables = made.tables.clone();
    let Some(region) = region.or_else(|| tables.first().map(|table| table.region.flat())) else {
        return Ok(());
    };
    let of = |used_as: Use| fits.iter().filter(move |fit| fit.approximation.used_as == used_as).collect();
    let (of_lobe, in_words) = match reflection.ndf {
        Ndf::Ggx => ("", ""),
        Ndf::Beckmann => ("beckmann-", "Beckmann, "),
    };
    let metal = Exploring {
        name: format!("{of_lobe}metal"),
        title: format!("{in_words}metal: energy compensation"),
        lead: "A metal's lobe, multiplied by 1 + f0 (N \u{2212} 1). A white metal returns all light.".into(),
        drawn: Drawn::Compensation,
        f0: 1.0,
        fits: of(Use::NORMALISATION),
        ..lobe(reflection, region, &tables, context)
    };
    let dielectric = Exploring {
        name: format!("{of_lobe}dielectric"),
        title: format!("{in_words}dielectric: f0 A + B"),
        lead: "Brightness is f0 A + B, the light that the lobe of a dielectric sends back.".into(),
        drawn: Drawn::Albedo,
        fits: of(Use::F0_BLEND),
        ..lobe(reflection, region, &tables, context)
    };
    let filled = |one: &Exploring| !one.fits.is_empty() || one.tables.iter().any(|t| t.decode.has_bias());
    let mut exploring = vec![metal];
    exploring.extend(Some(dielectric).filter(filled));
    made.explored(context, &exploring)
}

/// The lobe, with its tables over the same roughness map.
fn lobe<'a>(
    reflection: &Reflection,
    region: Region,
    tables: &'a [BakedTable],
    context: &Context,
) -> Exploring<'a> {
    Exploring {
        name: String::new(),
        title: String::new(),
        lead: String::new(),
        drawn: Drawn::Value,
        quantity: reflection.lobe,
        outputs: &["E", "B"],
        variant: context.scene.smith.into(),
        region,
        at: Vec::new(),
        f0: DIELECTRIC,
        fits: Vec::new(),
        tables: tables.iter().collect(),
    }
}
