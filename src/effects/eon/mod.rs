//! The effect `eon`: a rough diffuse base, as of clay, plaster or dust. Quantity `eon-single`.

mod lobe;

use super::Effect;
use super::demand::Demand;
use super::effect::Profile;
use super::value::{Functions, ValueFits};
use super::who::{about, named, reasons, verb};
use crate::approximate::{Entry, Formulas, own, published};
use crate::scene::{Material, Scene};
use lobefit_truth::quantity::EonSingle;

/// The effect.
pub struct Eon;

/// E(roughness, mu) with free parameters, by rising cost.
pub const HYPOTHESES: [Entry; 5] = own!["eon_e_5", "eon_e_6", "eon_e_7", "eon_e_9", "eon_e_12"];

/// E(roughness, mu) as published: measured and reported, not emitted.
pub const PUBLISHED: [Entry; 1] = published!["eon_e_portsmouth" by "Portsmouth, Kutz and Hill, EON, 2024"];

const FITS: ValueFits = ValueFits {
    quantity: &EonSingle,
    side: None,
    column: "E",
    used_as: None,
    own: Formulas::of(&HYPOTHESES),
    published: &PUBLISHED,
    role: "eon_albedo",
    of: "eon",
    field: "base",
    layer: Some("base"),
    because: "with a rough diffuse base",
    caption: "E of the single-scattering lobe: 1 at grazing and where the base is smooth, smallest face on, where light is lost \
              between facets. The lobe of several bounces sends it back.",
    curves: &[0.25, 0.5, 0.75, 1.0],
    shown_at: &[],
    seconds: [0.3, 0.1],
    table: None,
    around: Some(Functions {
        print: lobe::in_language,
        taking: &[],
        calling: &[lobe::BRDF],
        said: lobe::said,
    }),
};

/// The base's roughness, if it is rough and sends back light.
fn rough(material: &Material) -> Option<[f64; 2]> {
    material.rough_base().map(|base| base.roughness)
}

impl Effect for Eon {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "eon",
                fits: &[FITS],
                functions: &lobe::NAMES,
                prefixes: &["eon_albedo"],
                texts: &[lobe::TEXT],
                lobe: |_| {
                    "Oren-Nayar diffuse lobe in the form of EON; roughness is its own, not squared".into()
                },
                notes: &[(
                    &["eon_"],
                    &[
                        "`eon_albedo` is E of the single-scattering lobe of a rough diffuse base, `eon_brdf` the whole base. Below a rough lobe",
                        "multiply it by `diffuse_coupling`: `diffuse_coupled_*` has Lambert's lobe in its place.",
                    ],
                )],
                is_explored: true,
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material): (usize, &Material)| {
            let (base, range) = (material.base.as_ref()?, rough(material)?);
            Some(FITS.demand(scene, of, range, base.goals.clone()))
        };
        scene.materials.iter().enumerate().filter_map(demand).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        let based = |m: &&Material| m.base.is_some();
        let (black, smooth): (Vec<&Material>, Vec<&Material>) =
            scene.materials.iter().filter(based).partition(|m| m.base.as_ref().is_some_and(|b| b.is_rough()));
        let are = |m: &[&Material], kind: &str, what: &str| {
            let bases = if m.len() == 1 { "base" } else { "bases" };
            format!("the {kind} {bases} of {} {} {what}", named(m), verb(m, "are"))
        };
        let smooth = about(&smooth, |m| are(m, "diffuse", "smooth"));
        let black = about(&black, |m| are(m, "rough", "black"));
        reasons([smooth, black]).unwrap_or_else(|| "no material has a diffuse base".into())
    }
}
