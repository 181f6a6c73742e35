//! The effect `sheen`: the rim of cloth. Quantity `sheen-charlie`, or `sheen-estevez-kulla` where the scene
//! says so.

mod catalogue;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::Profile;
use super::table::{ValueTable, wants};
use super::value::{self, Functions, ValueFits};
use super::who::{about, stay_smooth};
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::approximate::{Fit, Formulas};
use crate::scene::{Material, Scene, TableWant, Visibility};
pub use catalogue::{HYPOTHESES, PUBLISHED};
use lobefit_shade::Source;
use lobefit_shade::code::{CodeError, Language};
use lobefit_truth::quantity::{EstevezKulla, SheenCharlie};

/// The effect.
pub struct Sheen;

const FITS: ValueFits = ValueFits {
    quantity: &SheenCharlie,
    side: None,
    column: "E",
    used_as: None,
    own: Formulas::of(&HYPOTHESES),
    published: &PUBLISHED,
    role: "sheen_albedo",
    of: "sheen",
    field: "sheen",
    layer: Some("sheen"),
    because: "with a sheen layer",
    caption: "E of the sheen's lobe: near 0 where a narrow lobe is seen face on, and largest at grazing view, where with its visibility \
              term it returns more than it receives the narrower it is: a value above 1 is the model's own, no error of its integral.",
    curves: &[0.1, 0.2, 0.3, 0.5, 1.0],
    shown_at: &[],
    seconds: [2.0, 0.15],
    table: None,
    around: Some(Functions {
        print: scale,
        taking: &[BASE_SCALE],
        calling: &[],
        said: |_| Ok("sheen_base_scale makes of it what the layers below keep.".into()),
    }),
};

/// The same with the other visibility.
const SHADOWED: ValueFits = ValueFits {
    quantity: &EstevezKulla,
    own: Formulas::of(&catalogue::SHADOWED),
    published: &[],
    seconds: [7.0, 0.3],
    caption: "E of the sheen's lobe: near 0 where a narrow lobe is seen face on, and largest at grazing view, where the shadowing of its \
              authors lets it return more than it receives: a value above 1 is the model's own, no error of its integral.",
    ..FITS
};

/// What the base below keeps, in WGSL.
const SCALE: &str = include_str!("sheen.wgsl");

/// Its function.
const BASE_SCALE: &str = "sheen_base_scale";

/// The function of the base, in a language.
fn scale(language: Language, _: &Fit) -> Result<String, BakeError> {
    let source = Source::parse("sheen.wgsl", SCALE).map_err(CodeError::from)?;
    Ok(format!("\n{}", source.print_documented(language, BASE_SCALE)?))
}

/// The tables that the sheens of a scene want.
fn wanted(scene: &Scene) -> Vec<(TableWant, String)> {
    wants(scene, "sheen", |m| m.sheen.as_ref().is_some_and(|sheen| sheen.rough_range(scene.alpha).is_some()))
}

/// The fits of a visibility, and the tables that are wanted beside them.
fn with(visibility: Visibility, wants: &[(TableWant, String)]) -> ValueFits<'_> {
    let fits = match visibility {
        Visibility::Neubelt => FITS,
        Visibility::EstevezKulla => SHADOWED,
    };
    let of = ValueTable::of(fits.quantity, fits.column, "sheen", "sheen_lookup");
    let table = (!wants.is_empty()).then_some(ValueTable { wants, ..of });
    ValueFits { table, ..fits }
}

impl Effect for Sheen {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "sheen",
                fits: &[FITS, SHADOWED],
                functions: &[BASE_SCALE],
                prefixes: &["sheen_albedo", "sheen_lookup"],
                texts: &[SCALE],
                lobe: |scene| {
                    format!(
                        "Charlie sheen lobe, {}; alpha = {}",
                        scene.sheen_visibility.words(),
                        scene.alpha.name()
                    )
                },
                notes: &[(
                    &["sheen_albedo", "charlie_", "estevez_kulla_"],
                    &["`sheen_albedo` is E of the sheen lobe, by which the layers below it are dimmed."],
                )],
                is_explored: true,
                ..Profile::NONE
            }
        }
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let demand = |(of, material): (usize, &Material)| {
            let sheen = material.sheen.as_ref()?;
            let range = sheen.rough_range(scene.alpha)?;
            Some(FITS.demand(scene, of, range, sheen.goals.clone()))
        };
        scene.materials.iter().enumerate().filter_map(demand).collect()
    }

    fn left_out(&self, scene: &Scene) -> String {
        let why = self.unserved(scene).map(|why| format!("no sheen is rough: {why}"));
        why.unwrap_or_else(|| "no material has a sheen layer".into())
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        let sheens: Vec<&Material> = scene.materials.iter().filter(|m| m.sheen.is_some()).collect();
        let of = if sheens.len() == 1 { "the sheen of" } else { "the sheens of" };
        about(&sheens, |m| format!("{of} {}", stay_smooth(m)))
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        value::expects(&[with(scene.sheen_visibility, &wanted(scene))], jobs)
    }

    fn stages(&self, scene: &Scene, jobs: &[Job]) -> usize {
        jobs.len() + wanted(scene).len()
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        with(context.scene.sheen_visibility, &wanted(context.scene)).bake(called, context)
    }
}
