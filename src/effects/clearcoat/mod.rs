//! The effect `clearcoat`: how a dielectric surface, smooth or rough, darkens the base below it by internal
//! reflection: a coat, or a lobe with the exact Fresnel term. Quantity `ggx-coat`.

use super::context::Context;
use super::demand::{Demand, ROUGHNESS_WIDTH_MIN, Span};
use super::effect::Profile;
use super::value::{self, Functions, IOR_WIDTH_MIN, ValueFits};
use super::{BakeError, Called, Effect, Made, ggx};
use crate::approximate::{Entry, Fit, Formulas, own, published};
use crate::emit::call::{Around, How};
use crate::emit::include::call;
use crate::scene::limits::EXACT_IOR;
use crate::scene::{Goals, Material, Scene};
use lobefit_shade::Source;
use lobefit_shade::code::{CodeError, Language};
use lobefit_truth::quantity::GgxCoat;

/// The effect.
pub struct Clearcoat;

/// The share of diffuse light from inside that leaves, of roughness and ior, by rising cost.
pub const HYPOTHESES: [Entry; 5] =
    own!["coat_escape_4", "coat_escape_8", "coat_escape_11", "coat_escape_13", "coat_escape_17"];

/// 1 - K as published: measured and reported, not emitted.
pub const PUBLISHED: [Entry; 3] = published![
    "coat_escape_materialx" by "MaterialX 1.39, open_pbr_surface",
    "coat_escape_egan" by "Egan and Hilgeman 1973, of a smooth surface",
    "coat_escape_kulla" by "Kulla and Conty 2017, of a smooth surface",
];

/// Least alpha of a job; below it is the smooth coat's value within 4e-6.
const ALPHA_MIN: f64 = 4e-4;

/// What is made of a fit's value, in WGSL, and its functions.
const TEXT: &str = include_str!("coat.wgsl");
const NAMES: [&str; 2] = ["coat_base_scale", DIFFUSE];

/// The one that has Lambert's lobe.
const DIFFUSE: &str = "coat_diffuse";

const FITS: ValueFits = ValueFits {
    quantity: &GgxCoat,
    side: None,
    column: "escape",
    used_as: None,
    own: Formulas::of(&HYPOTHESES),
    published: &PUBLISHED,
    role: "coat_escape",
    of: "coats",
    field: "coat",
    layer: Some("coat"),
    because: "with a coat",
    caption: "",
    curves: &[],
    shown_at: &[("ior", 1.5)],
    seconds: [1.0, 0.3],
    table: None,
    around: Some(Functions {
        print: functions,
        taking: &NAMES,
        calling: &[],
        said: |_| {
            Ok("coat_base_scale makes of it what the base keeps, coat_diffuse a reciprocal diffuse base."
                .into())
        },
    }),
};

/// The same of a surface itself, which a base lies below.
const OF_BASES: ValueFits = ValueFits {
    field: "base",
    layer: None,
    because: "with a diffuse base below the exact Fresnel term",
    ..FITS
};

/// What takes the albedo of a lobe with the exact Fresnel term above a base of a material.
pub(super) fn taking(material: Option<&Material>) -> impl Iterator<Item = Around> {
    let suits = serves(material);
    let around = |name: &str| {
        let declared = call(TEXT, name)?;
        let (function, value) = (name.into(), Some("e_v".into()));
        Some(Around { function, arguments: declared.arguments, value, how: How::TakesValue })
    };
    NAMES.into_iter().filter(move |name| suits(name)).filter_map(around)
}

/// Which of the functions serve the base of a material: a rough one has a lobe of its own, which is scaled.
fn serves(material: Option<&Material>) -> impl Fn(&str) -> bool + use<> {
    let is_rough = material.is_some_and(|own| own.rough_base().is_some());
    move |name| !(is_rough && name == DIFFUSE)
}

/// The functions about a fit, in a language.
fn functions(language: Language, _: &Fit) -> Result<String, BakeError> {
    let source = Source::parse("coat.wgsl", TEXT).map_err(CodeError::from)?;
    let print = |name| Ok(format!("\n{}", source.print_documented(language, name)?));
    NAMES.into_iter().map(print).collect()
}

impl Effect for Clearcoat {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "clearcoat",
                fits: &[FITS],
                functions: &NAMES,
                prefixes: &[FITS.role],
                texts: &[TEXT],
                lobe: ggx,
                notes: &[(
                    &[FITS.role],
                    &[
                        "`coat_escape` is 1 - K: the share of a diffuse base's light that leaves a coat from inside, (1 - E_avg)/ior^2 with E_avg the coat's",
                        "average albedo, of the coat's own roughness and index: pass an ior within the stated domain, and of a smoother coat the least roughness there.",
                        "The error is relative. The coat is taken for one that loses nothing between facets.",
                    ],
                )],
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material): (usize, &Material)| {
            let least = scene.alpha.roughness(ALPHA_MIN);
            let own = |fits: ValueFits, [low, high]: [f64; 2], ior, goals: &Goals| {
                let range = [low.max(least), high.max(least + ROUGHNESS_WIDTH_MIN)];
                let mut demand = fits.demand(scene, of, range, goals.clone());
                // Of one index it is a function of roughness alone.
                let ior = Span::at_least(ior, IOR_WIDTH_MIN, [1.0, EXACT_IOR]).or_one(true);
                demand.spans.push(("ior", ior));
                demand
            };
            let coat = material.coat.as_ref().map(|coat| own(FITS, coat.roughness, coat.ior, &coat.goals));
            let rough = material.roughness[1] >= least;
            let exact = material.exact_base().zip(material.ior).filter(|_| rough);
            let exact = exact.map(|(base, ior)| own(OF_BASES, material.roughness, ior, &base.goals));
            coat.into_iter().chain(exact)
        };
        scene.materials.iter().enumerate().flat_map(demand).collect()
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        let mut made = value::bake(self.profile().fits, called, context)?;
        for call in &mut made.part.entries.calls {
            let suits = serves(context.scene.materials.iter().find(|material| material.name == call.of));
            call.around.retain(|around| suits(&around.function));
        }
        Ok(made)
    }

    fn left_out(&self, _: &Scene) -> String {
        "no material has a coat, or a diffuse base below the exact Fresnel term".into()
    }
}
