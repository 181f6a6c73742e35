//! The effect `reflection`: the specular lobe of rough metals and dielectrics. Quantities
//! `ggx-reflection` and `ggx-average`.

pub mod bake;
mod catalogue;
mod demand;
mod fits;
mod published;
mod table;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::Note;
use super::who::anisotropy;
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::approximate::Entry;
use crate::approximate::target::Target;
use crate::data::Use;
use crate::scene::{Material, Scene};
pub use catalogue::{AVERAGES, BLENDS, NORMALISATIONS, SEEDS, entries};
pub use demand::{CERTIFIED, FitJob, JUDGED, NORMALISATION, REACHED};
pub use fits::{FitSpec, fit_all};
pub use lobefit_truth::integrate::accuracy::{POINTS, SAMPLERS, Series, Sources, Study, studies};
pub use published::{PUBLISHED, PUBLISHED_AVERAGES, PUBLISHED_BLENDS};
pub use table::{Dfg, build, sampled};

/// The effect.
pub struct Reflection;

impl Effect for Reflection {
    fn name(&self) -> &'static str {
        "reflection"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        demand::demands(scene)
    }

    fn left_out(&self, scene: &Scene) -> String {
        demand::left_out(scene)
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        demand::summaries(scene, jobs)
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        catalogue::entries().collect()
    }

    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let prefix = match (target.quantity.name(), target.column, target.used_as) {
            ("ggx-reflection", "E", Use::NORMALISATION) => "ggx_norm_",
            ("ggx-reflection", _, Use::F0_BLEND) => "ggx_blend_",
            ("ggx-reflection", "E", Use::VALUE) => "ggx_e_",
            ("ggx-reflection", "B", Use::VALUE) => "ggx_b_",
            ("ggx-average", "E_avg", Use::VALUE) => "ggx_eavg_",
            _ => return Vec::new(),
        };
        catalogue::entries().filter(|entry| entry.name().starts_with(prefix)).collect()
    }

    fn takes_formulas_for(&self, target: &Target) -> bool {
        (target.quantity.name(), target.column, target.used_as) == ("ggx-reflection", "E", Use::NORMALISATION)
    }

    fn prefixes(&self) -> &'static [&'static str] {
        &["ggx_albedo", "ggx_dfg", "ggx_energy_compensation", "ggx_average_albedo", "ggx_directional_albedo"]
    }

    fn lobe(&self, scene: &Scene) -> String {
        super::ggx(scene)
    }

    fn notes(&self) -> &'static [Note] {
        &[
            super::NOTE_F0,
            (
                &["ggx_energy_compensation", "ggx_norm_"],
                &[
                    "The energy compensation N has E N = 1: multiply the specular lobe by it. Of a metal take `_rgb`, which is",
                    "1 + f0 (N - 1) per colour channel.",
                ],
            ),
            super::NOTE_LOOKUP,
        ]
    }

    fn is_explored(&self) -> bool {
        true
    }

    fn without(&self, material: &Material) -> Option<&'static str> {
        anisotropy(material)
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        bake::bake(called, context)
    }
}
