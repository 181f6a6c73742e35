//! The effects `reflection` and `beckmann`: the specular lobe of rough metals and
//! dielectrics, of either distribution of normals. Quantities `ggx-reflection`, `ggx-average` and
//! `beckmann-reflection`.

pub mod bake;
mod catalogue;
mod demand;
mod fits;
mod mixed;
mod published;
mod table;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::Profile;
use super::who::anisotropy;
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::approximate::Entry;
use crate::approximate::target::Target;
use crate::data::{Ndf, Use};
use crate::scene::Scene;
pub use catalogue::{AVERAGES, BLENDS, NORMALISATIONS, SEEDS};
pub use demand::{CERTIFIED, FitJob, JUDGED, REACHED};
pub use fits::{FitSpec, fit_all};
pub use published::{PUBLISHED, PUBLISHED_AVERAGES, PUBLISHED_BLENDS};
pub use table::{build, sampled};

use lobefit_truth::quantity;

/// The effect, of one distribution of normals.
pub struct Reflection {
    ndf: Ndf,
    profile: Profile,
    /// The quantity.
    lobe: &'static dyn quantity::Reflection,
    /// How names of tables begin, and the roles of those of E and of E and B.
    tables: [&'static str; 3],
    /// The emitted normalisation, average and blend, by their roles.
    roles: [&'static str; 3],
    /// How names of formulas begin: of N, of f0 A + B, of E, of B.
    stems: [&'static str; 4],
    normalisations: &'static [Entry],
    averages: &'static [Entry],
    blends: &'static [Entry],
    /// Published normalisations that are emitted beside ours, and those that are not.
    seeds: &'static [Entry],
    published: &'static [Entry],
    published_blends: &'static [Entry],
    published_averages: &'static [Entry],
    /// Operations and error of the normalisations that none beats, where they are recorded.
    reached: &'static [(u32, f64)],
    /// What its truth takes.
    price: &'static demand::TruthPrice,
}

/// Of GGX.
pub static GGX: Reflection = Reflection {
    ndf: Ndf::Ggx,
    profile: Profile {
        name: "reflection",
        prefixes: &[
            "ggx_albedo",
            "ggx_dfg",
            "ggx_energy_compensation",
            "ggx_average_albedo",
            "ggx_directional_albedo",
            "ggx_mixed",
        ],
        functions: &mixed::NAMES,
        texts: &[mixed::TEXT],
        lobe: super::ggx,
        notes: &[
            super::NOTE_F0,
            (&["ggx_energy_compensation", "ggx_norm_"], &COMPENSATION),
            (
                &["ggx_mixed_"],
                &["A metal that is a dielectric in part takes N in `ggx_mixed_*`, and not `_rgb`."],
            ),
            super::NOTE_LOOKUP,
        ],
        is_explored: true,
        without: anisotropy,
        ..Profile::NONE
    },
    lobe: quantity::GGX_REFLECTION,
    tables: ["ggx-dfg", "ggx_albedo", "ggx_dfg"],
    roles: ["ggx_energy_compensation", "ggx_average_albedo", "ggx_directional_albedo"],
    stems: ["ggx_norm_", "ggx_blend_", "ggx_e_", "ggx_b_"],
    normalisations: &NORMALISATIONS,
    averages: &AVERAGES,
    blends: &BLENDS,
    seeds: &SEEDS,
    published: &PUBLISHED,
    published_blends: &PUBLISHED_BLENDS,
    published_averages: &PUBLISHED_AVERAGES,
    reached: &REACHED,
    price: &demand::GGX_PRICE,
};

/// Of Beckmann's distribution: what GGX has but averages.
pub static BECKMANN: Reflection = Reflection {
    ndf: Ndf::Beckmann,
    profile: Profile {
        name: "beckmann",
        prefixes: &[
            "beckmann_albedo",
            "beckmann_dfg",
            "beckmann_energy_compensation",
            "beckmann_directional_albedo",
        ],
        lobe: super::beckmann,
        notes: &[
            super::NOTE_F0,
            (&["beckmann_energy_compensation", "beckmann_norm_"], &COMPENSATION),
            super::NOTE_LOOKUP,
        ],
        is_explored: true,
        without: anisotropy,
        ..Profile::NONE
    },
    lobe: quantity::BECKMANN_REFLECTION,
    tables: ["beckmann-dfg", "beckmann_albedo", "beckmann_dfg"],
    roles: ["beckmann_energy_compensation", "beckmann_average_albedo", "beckmann_directional_albedo"],
    stems: ["beckmann_norm_", "beckmann_blend_", "beckmann_e_", "beckmann_b_"],
    normalisations: &catalogue::BECKMANN_NORMALISATIONS,
    averages: &[],
    blends: &catalogue::BECKMANN_BLENDS,
    seeds: &[],
    published: &[],
    published_blends: &[],
    published_averages: &[],
    reached: &[],
    price: &demand::BECKMANN_PRICE,
};

const COMPENSATION: [&str; 2] = [
    "The energy compensation N has E N = 1: multiply the specular lobe by it. Of a metal take `_rgb`, which is",
    "1 + f0 (N - 1) per colour channel.",
];

impl Reflection {
    /// Every file of the catalogue, in a fixed order.
    pub fn entries(&self) -> impl Iterator<Item = &'static Entry> {
        let ours = self.normalisations.iter().chain(self.averages).chain(self.blends).chain(self.seeds);
        ours.chain(self.published).chain(self.published_blends).chain(self.published_averages)
    }
}

impl Effect for Reflection {
    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        self.wanted(scene)
    }

    fn left_out(&self, scene: &Scene) -> String {
        self.why_not(scene)
    }

    fn unserved(&self, scene: &Scene) -> Option<String> {
        self.unserved_smooth(scene)
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        self.summaries(scene, jobs)
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        self.entries().collect()
    }

    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let own = target.quantity.name() == self.lobe.name();
        let prefix = match (target.column, target.used_as) {
            ("E", Use::NORMALISATION) if own => self.stems[0],
            (_, Use::F0_BLEND) if own => self.stems[1],
            ("E", Use::VALUE) if own => self.stems[2],
            ("B", Use::VALUE) if own => self.stems[3],
            ("E_avg", Use::VALUE) if target.quantity.name() == "ggx-average" => {
                return self.averages.iter().chain(self.published_averages).collect();
            }
            _ => return Vec::new(),
        };
        self.entries().filter(|entry| entry.name().starts_with(prefix)).collect()
    }

    fn takes_formulas_for(&self, target: &Target) -> bool {
        (target.quantity.name(), target.column, target.used_as) == (self.lobe.name(), "E", Use::NORMALISATION)
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        bake::bake(self, called, context)
    }
}
