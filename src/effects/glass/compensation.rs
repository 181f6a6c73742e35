//! The effects `glass-outside` and `glass-inside`: the factor on a rough dielectric interface, reflection and
//! transmission, that gives back what is lost between facets. Quantity `ggx-glass`, N with E N = 1 of
//! E = R + T, from either side.

use crate::approximate::{Formulas, own};
use crate::data::{Ndf, Use};
use crate::effects::demand::{Demand, Job, Span};
use crate::effects::dielectric::{ALPHA_MIN, seconds};
use crate::effects::effect::Profile;
use crate::effects::value::{self, IOR_WIDTH_MIN, ValueFits};
use crate::effects::who::{NO_GLASS, NOT_ASKED, about, named, verb};
use crate::effects::{Effect, JobSummary, ggx};
use crate::scene::limits::GLASS_IOR;
use crate::scene::{Lobe, Material, Scene};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::GGX_GLASS;

/// The effect, for a view from one side.
pub struct GlassCompensation {
    profile: Profile,
    fits: ValueFits<'static>,
}

/// For a view from outside.
pub static OUTSIDE: GlassCompensation = GlassCompensation {
    profile: Profile {
        name: "glass-outside",
        fits: &[FROM_OUTSIDE],
        prefixes: &[FROM_OUTSIDE.role],
        ..PROFILE
    },
    fits: FROM_OUTSIDE,
};

/// For a view from inside.
pub static INSIDE: GlassCompensation = GlassCompensation {
    profile: Profile { name: "glass-inside", fits: &[FROM_INSIDE], prefixes: &[FROM_INSIDE.role], ..PROFILE },
    fits: FROM_INSIDE,
};

const PROFILE: Profile = Profile {
    lobe: ggx,
    notes: &[(
        &["ggx_glass_energy_compensation_"],
        &[
            "`ggx_glass_energy_compensation_outside` and `_inside` multiply glass's reflection and transmission alike, by",
            "the side that the view is on, in place of `ggx_compensate_glass`, never beside it. ior is inside over outside",
            "for either side. Pass roughness, n_dot_v and ior within the stated domain.",
        ],
    )],
    ..Profile::NONE
};

const FROM_OUTSIDE: ValueFits = ValueFits {
    quantity: GGX_GLASS,
    side: Some(Side::Outside),
    column: "E",
    used_as: Some(Use::NORMALISATION),
    own: Formulas {
        all: &own![
            "ggx_glass_outside_3",
            "ggx_glass_outside_4",
            "ggx_glass_outside_6",
            "ggx_glass_outside_9",
            "ggx_glass_outside_11",
            "ggx_glass_outside_14",
            "ggx_glass_outside_16",
            "ggx_glass_outside_18",
            "ggx_glass_outside_20"
        ],
        flat: &own![
            "ggx_glass_outside_flat_3",
            "ggx_glass_outside_flat_4",
            "ggx_glass_outside_flat_6",
            "ggx_glass_outside_flat_8",
            "ggx_glass_outside_flat_10",
            "ggx_glass_outside_flat_11",
            "ggx_glass_outside_flat_12",
            "ggx_glass_outside_flat_14",
            "ggx_glass_outside_flat_15",
            "ggx_glass_outside_flat_16",
        ],
    },
    published: &[],
    role: "ggx_glass_energy_compensation_outside",
    of: "glass from outside",
    field: "wants.fit",
    layer: None,
    because: "with a rough surface wants fits",
    caption: "E = R + T from outside: what a rough interface sends on. The rest is lost between facets.",
    curves: &[0.1, 0.2, 0.4, 0.7, 1.0],
    shown_at: &[("ior", 1.5)],
    seconds: [1.5, 0.7],
    table: None,
    around: None,
};

const FROM_INSIDE: ValueFits = ValueFits {
    side: Some(Side::Inside),
    own: Formulas {
        all: &own![
            "ggx_glass_inside_6",
            "ggx_glass_inside_9",
            "ggx_glass_inside_10",
            "ggx_glass_inside_11",
            "ggx_glass_inside_19",
            "ggx_glass_inside_25"
        ],
        flat: &own![
            "ggx_glass_inside_flat_3",
            "ggx_glass_inside_flat_4",
            "ggx_glass_inside_flat_6",
            "ggx_glass_inside_flat_8",
            "ggx_glass_inside_flat_10",
            "ggx_glass_inside_flat_12",
            "ggx_glass_inside_flat_14",
            "ggx_glass_inside_flat_15",
            "ggx_glass_inside_flat_16",
        ],
    },
    role: "ggx_glass_energy_compensation_inside",
    of: "glass from inside",
    caption: "E = R + T from inside: what a rough interface sends on. Beyond the critical angle it reflects alone. The rest is lost \
              between facets.",
    ..FROM_OUTSIDE
};

/// Least index of refraction of a job that need not begin lower: towards 1 the loss from inside changes
/// ever faster.
const IOR_MIN: f64 = 1.1;

/// Glass of GGX's distribution that wants fits.
fn wanting(material: &Material) -> bool {
    (material.lobe(), material.distribution) == (Lobe::Glass, Ndf::Ggx) && material.wants.fit.is_some()
}

impl Effect for GlassCompensation {
    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let least = scene.alpha.roughness(ALPHA_MIN);
        let demand = |(of, material): (usize, &Material)| {
            let (want, ior) = material.wants.fit.as_ref().filter(|_| wanting(material)).zip(material.ior)?;
            let [low, high] = material.roughness;
            let mut demand = self.fits.demand(scene, of, [low.max(least), high], want.goals.clone());
            let ior = Span::at_least(ior, IOR_WIDTH_MIN, [IOR_MIN.min(ior[0]), GLASS_IOR]);
            demand.spans.push(("ior", ior.or_one(self.fits.own.is_flat())));
            (high >= least).then_some(demand)
        };
        scene.materials.iter().enumerate().filter_map(demand).collect()
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        value::expects(&[ValueFits { seconds: seconds(&self.fits, scene), ..self.fits }], jobs)
    }

    fn left_out(&self, scene: &Scene) -> String {
        let is_glass = scene.materials.iter().any(|m| m.lobe().is_glass());
        let without = if is_glass { NOT_ASKED } else { NO_GLASS };
        self.unserved(scene).unwrap_or_else(|| without.into())
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let smooth: Vec<&Material> = scene.materials.iter().filter(|m| wanting(m)).collect();
        about(&smooth, |m| {
            let (named, stay) = (named(m), verb(m, "stay"));
            format!("{named} {stay} below alpha {ALPHA_MIN}, where next to nothing is lost")
        })
    }
}
