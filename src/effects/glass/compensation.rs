//! The effect `glass-compensation`: the factor on a rough dielectric interface, reflection and
//! transmission, that gives back what is lost between facets. Quantity `ggx-glass`, N with E N = 1 of
//! E = R + T, from either side.

use crate::approximate::own;
use crate::data::{Ndf, Use};
use crate::effects::demand::{Demand, Job, Span};
use crate::effects::dielectric::{ALPHA_MIN, seconds};
use crate::effects::effect::Note;
use crate::effects::value::{self, IOR_WIDTH_MIN, ValueFits};
use crate::effects::who::{NO_GLASS, about, named, verb};
use crate::effects::{Effect, JobSummary, ggx};
use crate::scene::limits::GLASS_IOR;
use crate::scene::{Lobe, Material, Scene};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::GGX_GLASS;

/// The effect.
pub struct GlassCompensation;

/// The fits for rays from outside and from inside.
pub static FITS: [ValueFits; 2] = [
    OUTSIDE,
    ValueFits {
        side: Some(Side::Inside),
        own: &own![
            "ggx_glass_inside_4",
            "ggx_glass_inside_6",
            "ggx_glass_inside_9",
            "ggx_glass_inside_11",
            "ggx_glass_inside_19",
            "ggx_glass_inside_25"
        ],
        role: "ggx_glass_energy_compensation_inside",
        of: "glass from inside",
        caption: "E = R + T from inside: beyond the critical angle the interface reflects alone, and what the facets lose grows with the \
                  index.",
        ..OUTSIDE
    },
];

const OUTSIDE: ValueFits = ValueFits {
    quantity: &GGX_GLASS,
    side: Some(Side::Outside),
    column: "E",
    used_as: Some(Use::NORMALISATION),
    own: &own![
        "ggx_glass_outside_3",
        "ggx_glass_outside_6",
        "ggx_glass_outside_9",
        "ggx_glass_outside_14",
        "ggx_glass_outside_16",
        "ggx_glass_outside_18",
        "ggx_glass_outside_20"
    ],
    published: &[],
    role: "ggx_glass_energy_compensation_outside",
    of: "glass from outside",
    field: "wants.fit",
    layer: None,
    because: "with a rough surface wants fits",
    caption: "E = R + T from outside: what a rough interface sends on. The rest is lost between facets.",
    curves: &[0.1, 0.2, 0.4, 0.7, 1.0],
    shown_at: &[("ior", 1.5)],
    seconds: [1.0, 0.4],
    table: None,
    around: None,
};

/// Glass of GGX's distribution that wants fits.
fn wanting(material: &Material) -> bool {
    (material.lobe(), material.distribution) == (Lobe::Glass, Ndf::Ggx) && material.wants.fit.is_some()
}

impl Effect for GlassCompensation {
    fn name(&self) -> &'static str {
        "glass-compensation"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let least = scene.alpha.roughness(ALPHA_MIN);
        let rough = |(_, material): &(usize, &Material)| wanting(material) && material.roughness[1] >= least;
        let demand = |(of, material): (usize, &Material), (rank, fits): (usize, &ValueFits)| {
            let (want, ior) = material.wants.fit.as_ref().zip(material.ior)?;
            let [low, high] = material.roughness;
            let mut demand = fits.demand(scene, of, [low.max(least), high], want.goals.clone());
            demand.spans.push(("ior", Span::at_least(ior, IOR_WIDTH_MIN, [1.0, GLASS_IOR])));
            Some(Demand { rank, ..demand })
        };
        let all = scene.materials.iter().enumerate().filter(rough);
        all.flat_map(|of| FITS.iter().enumerate().filter_map(move |fits| demand(of, fits))).collect()
    }

    fn fits(&self) -> &'static [ValueFits<'static>] {
        &FITS
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        let all = FITS.each_ref().map(|fits| ValueFits { seconds: seconds(fits, scene), ..*fits });
        value::expects(&all, jobs)
    }

    fn left_out(&self, scene: &Scene) -> String {
        self.unserved(scene).unwrap_or_else(|| match scene.materials.iter().any(|m| m.lobe().is_glass()) {
            true => "no glass wants `fit`".into(),
            false => NO_GLASS.into(),
        })
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let smooth: Vec<&Material> = scene.materials.iter().filter(|m| wanting(m)).collect();
        about(&smooth, |m| {
            format!("{} {} below alpha {ALPHA_MIN}, where next to nothing is lost", named(m), verb(m, "stay"))
        })
    }

    fn prefixes(&self) -> &'static [&'static str] {
        &["ggx_glass_energy_compensation_"]
    }

    fn lobe(&self, scene: &Scene) -> String {
        ggx(scene)
    }

    fn notes(&self) -> &'static [Note] {
        &[(
            &["ggx_glass_energy_compensation_"],
            &[
                "`ggx_glass_energy_compensation_outside` and `ggx_glass_energy_compensation_inside` multiply glass's reflection and transmission alike, by the side that",
                "the view is on: then neither side loses light between facets. ior is inside over outside for either side. Pass roughness and ior within",
                "the stated domain.",
            ],
        )]
    }
}
