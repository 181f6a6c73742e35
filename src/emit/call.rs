//! What materials and probes call of a bake.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::manifest::{Entries, Manifest};
use crate::data::{Cost, Place};

/// A function that a material or a probe calls.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Call {
    /// Effect that it belongs to.
    pub effect: String,
    /// Name of the material or probe.
    pub of: String,
    /// The layer of the material whose roughness and index it takes: `coat`, `sheen`, or the diffuse `base`;
    /// none of the specular lobe and of probes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layer: Option<String>,
    /// What for, by the name of its card on the overview: calls of one material for one purpose stand
    /// for one another.
    #[serde(default)]
    pub purpose: String,
    /// Whether it is the one to take of these.
    #[serde(default)]
    pub recommended: bool,
    /// The function in the include files.
    pub function: String,
    /// The names of its arguments in order; `table` stands for the texture, with its sampler in the
    /// languages that have one.
    #[serde(default)]
    pub arguments: Vec<String>,
    /// What it is made of: the name of the fit or of the table.
    pub name: String,
    /// The function that takes its value, or what is made of it and the lobe f: `f/E`, `f*N`,
    /// `f0*A + B`, `f0*A + B or f/E`, `f + c*eon_brdf`,
    /// `n = 1/E`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub then: Option<String>,
    /// Functions of the include files about it: that take its value, or that call it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub around: Vec<Around>,
    /// The texture that it fetches from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// What of the material's lobe it does not know, and its error does not count: `anisotropy`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub without: Option<String>,
    /// Largest error.
    pub max_error: f64,
    /// What error that is: `furnace error |E N - 1|`, ...
    pub metric: String,
    /// Cost of a call.
    pub cost: Cost,
    /// What it costs beside fetches on the GPUs of the vendor that the scene names, by the model of
    /// them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub price: Option<f64>,
}

/// A function about a call, in the include files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Around {
    /// Its name.
    pub function: String,
    /// The names of its arguments in order.
    pub arguments: Vec<String>,
    /// The argument that takes the call's value, where it takes it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// What it does with the call.
    pub how: How,
}

impl Around {
    /// It with its arguments.
    pub fn signature(&self) -> String {
        signature(&self.function, &self.arguments)
    }

    /// One whose arguments are not known yet.
    pub fn new(function: String, how: How) -> Around {
        Around { function, arguments: Vec::new(), value: None, how }
    }

    /// Gives it its arguments.
    pub fn signed(&mut self, arguments: Vec<String>) {
        let is_there = |name: &&str| arguments.iter().any(|own| own == name);
        let value = VALUES.into_iter().find(is_there).filter(|_| self.how == How::TakesValue);
        (self.value, self.arguments) = (value.map(String::from), arguments);
    }
}

fn signature(function: &str, arguments: &[String]) -> String {
    format!("{function}({})", arguments.join(", "))
}

/// What is made of an albedo E and the lobe f where no function does it: the lobe over it.
pub const OVER: &str = "f/E";

/// What is made of A and B: the albedo for any f0.
pub const SPLIT: &str = "f0*A + B";

/// What is made of E, A and B where no function does it: the albedo for any f0, and the lobe over E.
pub const SPLIT_OVER: &str = "f0*A + B or f/E";

/// What is made of a normalisation N and the lobe f: their product.
pub const TIMES: &str = "f*N";

/// What is made of an albedo E for a metal in part: the n of `ggx_mixed_*`.
pub const INVERSE: &str = "n = 1/E";

/// What is made of the factor c of a rough base and the lobe f.
pub const ROUGH_BASE: &str = "f + c*eon_brdf";

/// How functions name the argument that takes the value of a call, the first that is there: a coat's share
/// stands beside the albedo of its lobe.
const VALUES: [&str; 6] = ["escape", "e_avg", "e", "e_v", "matrix", "n"];

/// What a function does with another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum How {
    /// It takes its value.
    TakesValue,
    /// It calls it.
    Calls,
}

/// A function that looks a probe up through a proxy of its room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LookupFunction {
    /// Effect that called for it.
    pub effect: String,
    /// Function in the emitted code.
    pub function: String,
    /// Argument names in order.
    pub inputs: Vec<String>,
    /// What they are, in a sentence.
    #[serde(default)]
    pub arguments: String,
    /// `box`, the number of planes after `planes_`, or `hit`: what the engine has hit.
    pub proxy: String,
    /// `smooth` or `sharp`; `none` of a hit.
    pub edges: String,
    /// What the lobe of the surface is taken for: `mirror` or `fitted`.
    pub lobe: String,
    /// What smooth edges are rounded over, by alpha or the `width` of the fitted lobe, the walls'
    /// distances h from the place and t along the ray.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rounding: Option<String>,
    /// What it returns beside a direction: `width` or `mip`.
    pub gives: String,
    /// The fit of the width.
    pub width: String,
    /// The lobe that the chain is prefiltered with.
    pub kernel: String,
    /// Roughness to alpha.
    pub alpha_map: String,
    /// The chain, in words, where it returns levels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chain: Option<String>,
    /// Cost, its fetches among it; bytes are the chain's.
    pub cost: Cost,
}

/// A function of the levels of a prefiltered chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MipEntry {
    /// Effect that called for it.
    pub effect: String,
    /// Function in the emitted code.
    pub function: String,
    /// What it gives: `mip`, `roughness`, `adjusted-mip`, `mip-bias`.
    pub gives: String,
    /// Argument names in order, of `mip`, `rho`, `roughness`, `alpha`.
    pub inputs: Vec<String>,
    /// The chain, in words.
    pub chain: String,
    /// Roughness to alpha.
    pub alpha_map: String,
    /// The lobe that the chain is prefiltered with; none of functions that do not depend on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kernel: Option<String>,
    /// Coefficients by parameter.
    pub coefficients: BTreeMap<String, f32>,
    /// Largest error in levels, of `roughness` there and back.
    pub max_mips: f64,
    /// Where it is.
    pub at: Place,
    /// Operations.
    pub ops: u32,
}

/// A function of masks of sub-voxels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MaskLookup {
    /// Effect that called for it.
    pub effect: String,
    /// Function in the emitted code.
    pub function: String,
    /// Argument names in order; Rust and C take the two halves of a super-voxel as one of 64 bits.
    pub inputs: Vec<String>,
    /// What it returns.
    pub gives: String,
    /// Cost.
    pub cost: Cost,
}

/// The layers of a material that functions are of, from the inside out; without a name, the specular
/// lobe.
const LAYERS: [Option<&str>; 4] = [Some("base"), None, Some("coat"), Some("sheen")];

/// Most callers that the row of a function names: more stand with all that they call.
pub const NAMED: usize = 3;

/// Materials or probes that call the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Callers<'a> {
    /// Their names.
    pub names: Vec<&'a str>,
    /// What they call for each purpose, and what may stand for it:
    /// `ggx_energy_compensation (or ggx_albedo then ggx_compensate_reflection)`.
    pub calls: Vec<String>,
    /// What the first of each takes in all; a file that several fetch from counts once.
    pub cost: Cost,
}

impl Call {
    /// The call with its arguments.
    pub fn signature(&self) -> String {
        signature(&self.function, &self.arguments)
    }

    /// ` of the coat`, of what takes the roughness of a layer.
    pub fn of_layer(&self) -> String {
        self.layer.as_ref().map_or_else(String::new, |layer| format!(" of the {layer}"))
    }

    /// Whether a material or probe has a choice between it and another.
    pub fn stands_for(&self, other: &Call) -> bool {
        (&self.of, &self.layer, &self.purpose) == (&other.of, &other.layer, &other.purpose)
    }

    /// Whether it is the one to take of several of its material or probe for its purpose.
    pub fn is_preferred(&self, calls: &[Call]) -> bool {
        self.recommended && calls.iter().filter(|other| other.stands_for(self)).count() > 1
    }
}

/// What a function about calls does with them: each with the argument that takes its value, if any does.
pub type Uses<'a> = BTreeSet<(&'a str, Option<&'a str>)>;

/// The functions about calls, each once.
pub fn arounds(calls: &[Call]) -> Vec<(&Around, Uses<'_>)> {
    let mut all: Vec<(&Around, Uses)> = Vec::new();
    for (call, around) in calls.iter().flat_map(|call| call.around.iter().map(move |around| (call, around))) {
        let of = (call.function.as_str(), around.value.as_deref());
        match all.iter_mut().find(|(known, _)| known.function == around.function) {
            Some((_, known)) => drop(known.insert(of)),
            None => all.push((around, BTreeSet::from([of]))),
        }
    }
    all
}

/// Who calls what, in the order of the calls.
pub fn callers(calls: &[Call]) -> Vec<Callers<'_>> {
    let mut each: Vec<(&str, Vec<Vec<&Call>>)> = Vec::new();
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    for call in calls {
        let place = *places.entry(&call.of).or_insert(each.len());
        if place == each.len() {
            each.push((&call.of, Vec::new()));
        }
        let same = |choice: &&mut Vec<&Call>| !call.purpose.is_empty() && choice[0].stands_for(call);
        match each[place].1.iter_mut().find(same) {
            Some(choice) => choice.push(call),
            None => each[place].1.push(vec![call]),
        }
    }
    let mut sets: Vec<Callers> = Vec::new();
    let mut places: BTreeMap<(Vec<String>, [u64; 3]), usize> = BTreeMap::new();
    for (name, mut choices) in each {
        // From the inside out.
        choices.sort_by_key(|choice| LAYERS.iter().position(|layer| choice[0].layer.as_deref() == *layer));
        let calls: Vec<String> = choices.iter().map(|choice| worded(choice)).collect();
        let cost = in_all(choices.iter().filter_map(|choice| taken(choice)));
        let key = [u64::from(cost.ops), u64::from(cost.fetches), cost.bytes];
        let place = *places.entry((calls.clone(), key)).or_insert(sets.len());
        match sets.get_mut(place) {
            Some(set) => set.names.push(name),
            None => sets.push(Callers { names: vec![name], calls, cost }),
        }
    }
    sets
}

/// The one to take of calls that stand for one another.
fn taken<'a>(choice: &[&'a Call]) -> Option<&'a Call> {
    choice.iter().find(|call| call.recommended).or(choice.first()).copied()
}

/// What calls take together; a file that several fetch from counts once.
fn in_all<'a>(calls: impl Iterator<Item = &'a Call>) -> Cost {
    let (mut all, mut files) = (Cost::default(), BTreeSet::new());
    for Call { cost, file, .. } in calls {
        let is_new = file.as_ref().is_none_or(|file| files.insert(file));
        all.ops += cost.ops;
        all.fetches += cost.fetches;
        all.bytes += if is_new { cost.bytes } else { 0 };
    }
    all
}

/// Calls that stand for one another, the recommended one first; what takes the value of each or calls it is
/// said once.
fn worded(choice: &[&Call]) -> String {
    let then = |call: &Call| {
        let value = call.around.iter().find(|around| call.then.as_ref() == Some(&around.function));
        let value = value.and_then(|around| around.value.as_ref());
        let value = value.map_or_else(String::new, |value| format!(" as {value}"));
        let then = call.then.as_ref().map_or_else(String::new, |then| format!(" then {then}{value}"));
        let within = call.around.iter().find(|around| around.how == How::Calls);
        let within = within.map_or_else(String::new, |around| format!(" in {}", around.function));
        let without = call.without.as_ref().map_or_else(String::new, |what| format!(", {what} left out"));
        call.of_layer() + &then + &within + &without
    };
    let shared = choice.first().map(|call| then(call)).unwrap_or_default();
    let is_shared = choice.iter().all(|call| then(call) == shared);
    let (mut all, others): (Vec<&Call>, Vec<&Call>) = choice.iter().partition(|call| call.recommended);
    all.extend(others);
    let own = |call: &Call| if is_shared { String::new() } else { then(call) };
    let mut words = all.iter().map(|call| call.function.clone() + &own(call));
    let first = words.next().unwrap_or_default();
    let rest: Vec<String> = words.collect();
    let or = if rest.is_empty() { String::new() } else { format!(" (or {})", rest.join(", ")) };
    first + &or + if is_shared { &shared } else { "" }
}

impl Manifest {
    /// How roughness becomes alpha in its functions, if it has any.
    pub fn alpha_map(&self) -> Option<&str> {
        let fits = self.entries.fits.iter().map(|fit| &fit.alpha_map);
        fits.chain(self.entries.tables.iter().map(|table| &table.alpha_map)).next().map(String::as_str)
    }
}

impl Entries {
    /// The names of the arguments of a function that is no formula, in order, as the include files have
    /// them; of a table the table comes first.
    pub fn arguments(&self, function: &str) -> Option<Vec<String>> {
        let table = self.tables.iter().find(|table| table.function == function);
        if let Some(table) = table {
            return Some(std::iter::once("table").map(String::from).chain(table.inputs.clone()).collect());
        }
        let lookup = self.lookups.iter().find(|lookup| lookup.function == function);
        let mask = self.masks.iter().find(|mask| mask.function == function);
        lookup.map(|lookup| &lookup.inputs).or(mask.map(|mask| &mask.inputs)).cloned()
    }
}
