//! A scene to the jobs that it calls for, and to the effects left out with the reason. Nothing is
//! planned that no material needs; jobs that several materials share are planned once.

mod clamped;

use std::collections::BTreeSet;

use serde::Serialize;

use crate::effects::demand::{Demand, Job};
use crate::effects::{Called, Effect, LeftOut, catalogue};
use crate::scene::Scene;
pub use clamped::Clamped;

/// What a scene calls for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// Version of the plan's JSON form: 1.
    pub schema_version: u32,
    /// The scene's name.
    pub scene: String,
    /// Effects that the scene calls for, in the order of the catalogue.
    pub effects: Vec<Called>,
    /// Every other effect of the catalogue, with the reason; and of those that are called for, why
    /// materials that ask for it get nothing.
    pub left_out: Vec<LeftOut>,
    /// The effects that the scene could have called for.
    #[serde(skip)]
    pub catalogue: Vec<&'static dyn Effect>,
}

/// Plans a validated scene with the effects of this version.
pub fn plan(scene: &Scene) -> Plan {
    plan_with(scene, catalogue())
}

/// Plans a validated scene with the effects of a catalogue.
pub fn plan_with(scene: &Scene, catalogue: &[&'static dyn Effect]) -> Plan {
    let mut plan = Plan {
        schema_version: 1,
        scene: scene.name.clone(),
        effects: Vec::new(),
        left_out: Vec::new(),
        catalogue: catalogue.to_vec(),
    };
    for effect in catalogue {
        let demands = effect.demands(scene);
        let reason = match demands.is_empty() {
            true => Some(effect.left_out(scene)),
            false => effect.unserved(&scene.without(&served(&demands))),
        };
        plan.left_out.extend(reason.map(|reason| LeftOut { effect: effect.name(), reason }));
        plan.effects.extend(Called::new(*effect, scene, demands));
    }
    plan
}

/// The materials and probes of demands, as `materials[0]`.
fn served(demands: &[Demand]) -> BTreeSet<&str> {
    let end = |field: &str| field.find(']').map_or(field.len(), |end| end + 1);
    demands.iter().map(|demand| &demand.field[..end(&demand.field)]).collect()
}

impl Plan {
    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.effects.is_empty()
    }

    /// The jobs of an effect; none where the scene does not call for it.
    pub fn jobs(&self, effect: &str) -> &[Job] {
        self.effects.iter().find(|called| called.effect == effect).map_or(&[], |called| &called.work)
    }
}
