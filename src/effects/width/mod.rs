//! The effect `width`: the roughness that stands for a lobe that another one replaces: for what glass
//! refracts (quantity `refracted-width`), and for what something widens (`averaged-width`, `lit-width`,
//! `coated-width`).

use super::demand::{Demand, Span};
use super::effect::Profile;
use super::value::{IOR_WIDTH_MIN, ValueFits};
use super::who::{NOT_ASKED, about, anisotropy, rough, stay_smooth};
use super::{Effect, ggx};
use crate::approximate::{Formulas, own, published};
use crate::data::AlphaMap;
use crate::scene::limits::EXACT_IOR;
use crate::scene::{Goals, Material, Scene};
use lobefit_truth::quantity::{AVERAGED_WIDTH, COATED_WIDTH, LIT_WIDTH, RefractedWidth};

/// The effect.
pub struct Width;

/// Least index of refraction of a job: the truth is quick from there.
const IOR_MIN: f64 = 1.05;

/// The least cosine of the widened lobes' quantities and their least roughness of a coat, and the largest
/// index of a coat.
const MU_MIN: f64 = 0.01;
const COAT_ROUGHNESS_MIN: f64 = 0.01;
const COAT_IOR: f64 = 2.0;

/// The fits of each value, ours by rising cost, beside what engines ship.
pub static FITS: [ValueFits; 5] = [
    ValueFits {
        quantity: &RefractedWidth,
        column: "roughness_refracted",
        own: Formulas::of(&own![
            "refracted_width_2",
            "refracted_width_4",
            "refracted_width_9",
            "refracted_width_11",
            "refracted_width_14"
        ]),
        published: &published![
            "refracted_width_none" by "no rule: the roughness of the surface",
            "refracted_width_khronos" by "Khronos glTF Sample Renderer, applyIorToRoughness; Bevy, three.js",
        ],
        role: "refracted_roughness",
        of: "refraction",
        field: "wants.refracted_width",
        because: "with a rough surface wants the width of what it refracts",
        caption: "The roughness of the prefiltered lobe that holds half of its energy within the cone that holds half of the refracted one.",
        shown_at: &[("ior", 1.5)],
        seconds: [3.5, 0.4],
        ..WIDENED
    },
    ValueFits {
        quantity: &AVERAGED_WIDTH,
        column: "roughness_averaged",
        own: Formulas::of(&own!["averaged_width_14", "averaged_width_16", "averaged_width_21"]),
        published: &published![
            "averaged_width_none" by "no rule: the roughness of the surface",
            "averaged_width_toksvig" by "M. Toksvig, Mipmapping Normal Maps, 2005, in the form of GGX",
            "averaged_width_lean" by "M. Olano and D. Baker, LEAN Mapping, 2010",
            "averaged_width_filament" by "Y. Tokuyoshi and A. Kaplanyan 2019, as in Filament",
        ],
        role: "averaged_roughness",
        of: "normals",
        because: "with a rough specular lobe wants its width over averaged normals",
        shown_at: &[("mean_length", 0.9)],
        ..WIDENED
    },
    ValueFits {
        quantity: &LIT_WIDTH,
        column: "roughness_lit",
        own: Formulas::of(&own!["lit_width_8", "lit_width_14", "lit_width_15"]),
        published: &published![
            "lit_width_none" by "no rule: the roughness of the surface",
            "lit_width_karis" by "B. Karis, Real Shading in Unreal Engine 4, 2013",
        ],
        role: "lit_roughness",
        of: "disk lights",
        because: "with a rough specular lobe wants its width under disk lights",
        shown_at: &[("light_radius", 0.1)],
        ..WIDENED
    },
    ValueFits {
        quantity: &LIT_WIDTH,
        column: "normalisation",
        own: Formulas::of(&own!["lit_energy_12", "lit_energy_13"]),
        published: &published!["lit_energy_karis" by "B. Karis, Real Shading in Unreal Engine 4, 2013"],
        role: "lit_normalisation",
        of: "nearest points of disk lights",
        because: "with a rough specular lobe wants its energy under disk lights",
        caption: "The factor on the lobe at the light's nearest point to the mirror direction that keeps its energy.",
        shown_at: &[("light_radius", 0.1)],
        ..WIDENED
    },
    ValueFits {
        quantity: &COATED_WIDTH,
        column: "roughness_coated",
        own: Formulas::of(&own!["coated_width_19", "coated_width_21"]),
        published: &published![
            "coated_width_none" by "no rule: the roughness of the base",
            "coated_width_openpbr" by "OpenPBR 1.1; MaterialX, open_pbr_surface",
        ],
        role: "coated_roughness",
        of: "bases below coats",
        because: "with a rough specular lobe wants its width below its coat",
        shown_at: &[("coat_roughness", 0.5), ("ior", 1.5)],
        ..WIDENED
    },
];

/// What the fits of widened lobes share.
const WIDENED: ValueFits = ValueFits {
    quantity: &RefractedWidth,
    side: None,
    column: "",
    used_as: None,
    own: Formulas::of(&[]),
    published: &[],
    role: "",
    of: "",
    field: "wants.widened",
    layer: None,
    because: "",
    caption: "The roughness of the lobe that holds half of its energy within the cone that holds half of the widened one.",
    curves: &[0.1, 0.2, 0.4, 0.7, 1.0],
    shown_at: &[],
    seconds: [2.0, 0.4],
    table: None,
    around: None,
};

/// What a material wants of the fits of a value: goals, and ranges of the further inputs.
fn wanted(material: &Material, fits: &ValueFits) -> Option<(Goals, Vec<(&'static str, Span)>)> {
    let ior = |ior: [f64; 2], most| {
        let inside = ior.map(|ior| ior.clamp(IOR_MIN, most));
        ("ior", Span::at_least(inside, IOR_WIDTH_MIN, [IOR_MIN, most]).or_one(fits.own.is_flat()))
    };
    if fits.field == FITS[0].field {
        let want = material.wants.refracted_width.as_ref()?;
        return Some((want.goals.clone(), vec![ior(material.ior?, EXACT_IOR)]));
    }
    let want = material.wants.widened.as_ref()?;
    let (goals, norms) = (want.goals.clone(), want.goals.norms.clone());
    match fits.role {
        "averaged_roughness" => {
            let span = Span::at_least(want.mean_length?, 0.1, [0.5, 1.0]).or_one(false);
            Some((goals, vec![("mean_length", span)]))
        }
        "coated_roughness" => {
            let coat = material.coat.as_ref().filter(|_| want.coat)?;
            let roughness = Span::at_least(
                coat.roughness.map(|r| r.max(COAT_ROUGHNESS_MIN)),
                0.1,
                [COAT_ROUGHNESS_MIN, 1.0],
            )
            .or_one(false);
            Some((goals, vec![("coat_roughness", roughness), ior(coat.ior, COAT_IOR)]))
        }
        role => {
            let span = Span::at_least(want.light_radius?, 0.05, [0.0, 0.5]).or_one(false);
            // The limit is of the roughness.
            let goals = if role == "lit_roughness" { goals } else { Goals { norms, ..Goals::default() } };
            Some((goals, vec![("light_radius", span)]))
        }
    }
}

impl Effect for Width {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "width",
                fits: &FITS,
                prefixes: &[
                    "refracted_roughness",
                    "averaged_roughness",
                    "lit_roughness",
                    "lit_normalisation",
                    "coated_roughness",
                ],
                lobe: ggx,
                notes: &[
                    (
                        &["refracted_roughness"],
                        &[
                            "`refracted_roughness` is the roughness to fetch a prefiltered environment map (alpha = roughness^2), or a picture that is blurred",
                            "as one, with, in the direction refract(-v, n, 1/ior), for glass seen from outside. Within the same cone lies half of the energy.",
                            "The error is of the roughness itself. Pass an ior within the stated domain.",
                        ],
                    ),
                    (
                        &["averaged_roughness", "lit_roughness", "coated_roughness"],
                        &[
                            "`averaged_roughness`, `lit_roughness` and `coated_roughness` are the roughness (alpha = roughness^2) of the lobe that stands for one over averaged",
                            "normals, under a disk light that is taken for its middle, or below a rough coat: within the same cone about the mirror direction lies half of the energy.",
                            "Their shadowing is height-correlated, whatever the scene has.",
                        ],
                    ),
                    (
                        &["lit_normalisation"],
                        &[
                            "`lit_normalisation` multiplies the lobe of the surface's own roughness at the disk's nearest point to the mirror direction. Its error is relative.",
                            "Its shadowing is height-correlated, whatever the scene has.",
                        ],
                    ),
                ],
                without: anisotropy,
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material, range): (usize, &Material, [f64; 2]),
                      (rank, fits): (usize, &ValueFits)| {
            let (goals, spans) = wanted(material, fits)?;
            let mut demand = Demand { rank, ..fits.demand(scene, of, range, goals) };
            if rank > 0 {
                demand.spans[1].1 = Span::new(scene.mu.map(|mu| mu.max(MU_MIN)));
            }
            demand.spans.extend(spans);
            Some(demand)
        };
        // The roughness that stands for a lobe has alpha = roughness^2.
        let all = rough(scene).filter(|_| scene.alpha == AlphaMap::RoughnessSquared);
        all.flat_map(|of| FITS.iter().enumerate().filter_map(move |fits| demand(of, fits))).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        self.unserved(scene).unwrap_or_else(|| match scene.materials.iter().any(|m| m.lobe().is_glass()) {
            false => "no material is glass or wants `widened`".into(),
            true => NOT_ASKED.into(),
        })
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let wants = |m: &&Material| m.wants.refracted_width.is_some() || m.wants.widened.is_some();
        let wanting: Vec<&Material> = scene.materials.iter().filter(wants).collect();
        about(&wanting, |m| match scene.alpha {
            AlphaMap::RoughnessSquared => stay_smooth(m),
            _ => "it is of lobes with alpha = roughness^2, which the scene has not".into(),
        })
    }
}
