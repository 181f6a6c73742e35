//! The effects `glass-outside` and `glass-inside`: the factor on a rough dielectric interface, reflection and
//! transmission, that gives back what is lost between facets. Quantity `ggx-glass`, N with E N = 1 of
//! E = R + T, from either side. The same of Beckmann's distribution: `beckmann-glass-outside`, `-inside`.

use crate::approximate::{Formulas, own};
use crate::data::{Ndf, Use};
use crate::effects::demand::{Demand, Job, Span};
use crate::effects::dielectric::{ALPHA_MIN, seconds};
use crate::effects::effect::Profile;
use crate::effects::value::{self, IOR_WIDTH_MIN, ValueFits};
use crate::effects::who::{NO_GLASS, NOT_ASKED, about, named, no_beckmann_glass, no_distribution, verb};
use crate::effects::{Effect, JobSummary, beckmann, ggx};
use crate::scene::limits::GLASS_IOR;
use crate::scene::{Lobe, Material, Scene};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::{BECKMANN_GLASS, GGX_GLASS};

/// The effect, of one distribution of normals and for a view from one side.
pub struct GlassCompensation {
    ndf: Ndf,
    profile: Profile,
    fits: ValueFits<'static>,
}

/// Of GGX, for a view from outside.
pub static OUTSIDE: GlassCompensation = GlassCompensation {
    ndf: Ndf::Ggx,
    profile: Profile {
        name: "glass-outside",
        fits: &[FROM_OUTSIDE],
        prefixes: &[FROM_OUTSIDE.role],
        ..PROFILE
    },
    fits: FROM_OUTSIDE,
};

/// Of GGX, for a view from inside.
pub static INSIDE: GlassCompensation = GlassCompensation {
    ndf: Ndf::Ggx,
    profile: Profile { name: "glass-inside", fits: &[FROM_INSIDE], prefixes: &[FROM_INSIDE.role], ..PROFILE },
    fits: FROM_INSIDE,
};

/// Of Beckmann's distribution, for a view from outside.
pub static BECKMANN_OUTSIDE: GlassCompensation = GlassCompensation {
    ndf: Ndf::Beckmann,
    profile: Profile {
        name: "beckmann-glass-outside",
        fits: &[BECKMANN_FROM_OUTSIDE],
        prefixes: &[BECKMANN_FROM_OUTSIDE.role],
        lobe: beckmann,
        ..PROFILE
    },
    fits: BECKMANN_FROM_OUTSIDE,
};

/// Of Beckmann's distribution, for a view from inside.
pub static BECKMANN_INSIDE: GlassCompensation = GlassCompensation {
    ndf: Ndf::Beckmann,
    profile: Profile {
        name: "beckmann-glass-inside",
        fits: &[BECKMANN_FROM_INSIDE],
        prefixes: &[BECKMANN_FROM_INSIDE.role],
        lobe: beckmann,
        ..PROFILE
    },
    fits: BECKMANN_FROM_INSIDE,
};

const PROFILE: Profile = Profile {
    lobe: ggx,
    notes: &[(
        &["ggx_glass_energy_compensation_", "beckmann_glass_energy_compensation_"],
        &[
            "`*_glass_energy_compensation_outside` and `_inside` multiply glass's reflection and transmission alike, by",
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

const BECKMANN_FROM_OUTSIDE: ValueFits = ValueFits {
    quantity: BECKMANN_GLASS,
    own: Formulas {
        all: &own![
            "beckmann_glass_outside_3",
            "beckmann_glass_outside_5",
            "beckmann_glass_outside_8",
            "beckmann_glass_outside_12",
            "beckmann_glass_outside_14",
            "beckmann_glass_outside_16"
        ],
        flat: &own![
            "beckmann_glass_outside_flat_3",
            "beckmann_glass_outside_flat_6",
            "beckmann_glass_outside_flat_9",
            "beckmann_glass_outside_flat_10",
            "beckmann_glass_outside_flat_12",
            "beckmann_glass_outside_flat_13",
            "beckmann_glass_outside_flat_16"
        ],
    },
    role: "beckmann_glass_energy_compensation_outside",
    ..FROM_OUTSIDE
};

const BECKMANN_FROM_INSIDE: ValueFits = ValueFits {
    quantity: BECKMANN_GLASS,
    own: Formulas {
        all: &own![
            "beckmann_glass_inside_6",
            "beckmann_glass_inside_13",
            "beckmann_glass_inside_15",
            "beckmann_glass_inside_23"
        ],
        flat: &own![
            "beckmann_glass_inside_flat_4",
            "beckmann_glass_inside_flat_5",
            "beckmann_glass_inside_flat_8",
            "beckmann_glass_inside_flat_10",
            "beckmann_glass_inside_flat_16",
            "beckmann_glass_inside_flat_19"
        ],
    },
    role: "beckmann_glass_energy_compensation_inside",
    ..FROM_INSIDE
};

/// Least index of refraction of a job that need not begin lower: towards 1 the loss from inside changes
/// ever faster.
const IOR_MIN: f64 = 1.1;

impl GlassCompensation {
    /// Whether it is glass of the effect's distribution that wants fits.
    fn is_for(&self, material: &Material) -> bool {
        (material.lobe(), material.distribution) == (Lobe::Glass, self.ndf) && material.wants.fit.is_some()
    }
}

impl Effect for GlassCompensation {
    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let least = scene.alpha.roughness(ALPHA_MIN);
        let demand = |(of, material): (usize, &Material)| {
            let (want, ior) =
                material.wants.fit.as_ref().filter(|_| self.is_for(material)).zip(material.ior)?;
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
        let glass = || scene.materials.iter().filter(|m| m.lobe().is_glass());
        let has_own = glass().any(|m| m.distribution == self.ndf);
        self.unserved(scene).unwrap_or_else(|| match glass().next() {
            _ if has_own => NOT_ASKED.into(),
            _ if self.ndf == Ndf::Beckmann => no_beckmann_glass(scene),
            Some(_) => no_distribution(self.ndf, "glass"),
            None => NO_GLASS.into(),
        })
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let smooth: Vec<&Material> = scene.materials.iter().filter(|m| self.is_for(m)).collect();
        about(&smooth, |m| {
            let (named, stay) = (named(m), verb(m, "stay"));
            format!("{named} {stay} below alpha {ALPHA_MIN}, where next to nothing is lost")
        })
    }
}
