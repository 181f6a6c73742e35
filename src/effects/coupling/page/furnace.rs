//! The furnace: lobe and white base together, which should not be seen.

use crate::effects::coupling::results::CouplingLobe;
use crate::report::sections::figures;
use crate::report::sections::furnace::{amplified, limit, spheres, worst};
use crate::report::{Furnace, ReportError, Section, Shade, Spheres, numbers};

pub(super) fn section(lobe: &CouplingLobe) -> Result<Section, ReportError> {
    let places = lobe.furnace.panels.iter().map(|(f0, _)| numbers::place(*f0));
    let panels: Vec<(String, Furnace)> = places.zip(lobe.furnace.spheres()).collect();
    let mut drawn = Vec::new();
    for (f0, furnace) in &panels {
        let title = format!("f0 = {f0}, {} lobe", lobe.specular);
        let shown = spheres(&title, furnace, &furnace.rows, Shade::Departure { limit: limit(furnace)? });
        drawn.push(Spheres { unit: "lobe + base − 1".into(), ..shown });
    }
    let caption = format!(
        "{} The lobe is exact here and multiplied by {}; what is seen is the error of the factor alone.",
        amplified(lobe.furnace.amplification),
        lobe.multiplier,
    );
    let mut blocks = vec![figures(&drawn, &caption)?];
    blocks.extend(panels.iter().map(|(f0, furnace)| {
        let caption = format!(
            "f0 = {f0}: largest signed departure over each sphere, rounded away from zero. Where it is larger than the sphere looks, it is \
             at the rim."
        );
        worst(furnace, &caption)
    }));
    Ok(Section::new(
        format!("furnace-{}", lobe.specular),
        format!("The furnace, {} lobe", lobe.specular),
        "Spheres of rising roughness with a white base, in equal light from everywhere and without absorption: lobe and base together \
               must send back all of it, so the right picture is an empty one.",
        blocks,
    ))
}
