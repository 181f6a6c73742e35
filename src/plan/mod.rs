//! A scene to the jobs that it calls for, and to the effects left out with the reason. Nothing is planned
//! that no material needs; jobs that several materials share are planned once.

mod coupling;
mod effect;
mod job;
mod left_out;
mod merge;
mod parallax;
mod reflection;
mod sheen;
mod volumes;
mod work;

pub use effect::{Effect, EffectName, JobSummary, LeftOut};
pub use job::{
    CouplingJob, FitJob, FitPromise, JUDGED_MU, Limit, ParallaxJob, SheenJob, TableJob, VolumeJob,
    VolumeSpan, VolumeTable,
};

use serde::Serialize;

use crate::scene::Scene;

/// What a scene calls for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// Version of the plan's JSON form: 1.
    pub schema_version: u32,
    /// The scene's name.
    pub scene: String,
    /// Effects that the scene calls for and this version has, in the order of [`EffectName::ALL`].
    pub effects: Vec<Effect>,
    /// Every other effect, with the reason.
    pub left_out: Vec<LeftOut>,
    /// Tables to bake, in the order in which the materials first want them; names are unique.
    #[serde(skip)]
    pub tables: Vec<TableJob>,
    /// The fit to make, if any material wants one.
    #[serde(skip)]
    pub fit: Option<FitJob>,
    /// Tables of three axes to bake, in the order in which the materials first want them; names are unique.
    #[serde(skip)]
    pub volumes: Vec<VolumeJob>,
    /// The fits of the sheen, if any material has one.
    #[serde(skip)]
    pub sheen: Option<SheenJob>,
    /// The fits of the coupling of diffuse bases, one job for each kind of specular lobe above them, in the order of
    /// [`Specular::ALL`](lobefit_truth::integrate::coupling::Specular::ALL).
    #[serde(skip)]
    pub couplings: Vec<CouplingJob>,
    /// The fits of the probes' lookups, one job for each kind of lobe that a chain is prefiltered with, in the order of
    /// [`Kernel`](lobefit_truth::optics::kernel::Kernel).
    #[serde(skip)]
    pub parallaxes: Vec<ParallaxJob>,
}

/// Plans a validated scene.
pub fn plan(scene: &Scene) -> Plan {
    let tables = merge::tables(scene);
    let fit = merge::fit(scene);
    let volumes = volumes::volumes(scene);
    let sheen = sheen::job(scene);
    let couplings = coupling::jobs(scene);
    let parallaxes = parallax::jobs(scene);
    let effects: Vec<Effect> = EffectName::ALL
        .into_iter()
        .filter_map(|name| match name {
            EffectName::Reflection => reflection::effect(scene, &tables, fit.as_ref()),
            EffectName::Anisotropy | EffectName::Glass => volumes::effect(scene, &volumes, name),
            EffectName::DiffuseCoupling => coupling::effect(scene, &couplings),
            EffectName::Sheen => sheen.as_ref().map(|job| sheen::effect(scene, job)),
            EffectName::Parallax => parallax::effect(scene, &parallaxes),
            _ => None,
        })
        .collect();
    let left_out = EffectName::ALL
        .into_iter()
        .filter(|&name| !effects.iter().any(|e| e.effect == name))
        .map(|name| LeftOut { effect: name, reason: left_out::reason(name, scene) })
        .collect();
    let (schema_version, scene) = (1, scene.name.clone());
    Plan { schema_version, scene, effects, left_out, tables, fit, volumes, sheen, couplings, parallaxes }
}

impl Plan {
    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.effects.is_empty()
    }
}
