//! Where a ray meets a proxy: the formulas of [`crate::effects::parallax::room::proxies`] in a
//! shader's arithmetic, by `meet.wgsl`.

use super::constant;
use crate::data::ProbeLookup;
use crate::effects::parallax::room::proxies::{Eased, NEAREST};

/// The functions of boxes, and of as many planes as COUNT says.
const MEET: &str = include_str!("meet.wgsl");

/// The name of the function of a proxy.
pub(super) fn name(lookup: ProbeLookup) -> String {
    format!("parallax_meet_{}_{}", lookup.shape(), lookup.edges())
}

/// The functions of proxies, for the planes of one.
pub(super) fn source(lookup: ProbeLookup) -> String {
    constant("NEAREST", NEAREST) + &MEET.replace("COUNT", &lookup.planes.unwrap_or(1).to_string())
}

/// The arguments that describe a proxy, with their types.
pub(super) fn body(lookup: ProbeLookup) -> Vec<[String; 2]> {
    let point = |name: &str| [name.to_string(), "vec3f".to_string()];
    match lookup.planes {
        None => vec![point("low"), point("high"), point("probe")],
        Some(n) => vec![["planes".into(), format!("array<vec4f, {n}>")], point("probe")],
    }
}

/// The names of the arguments that a function of a proxy takes of those: a box does not need the
/// probe to be met.
pub(super) fn passed(lookup: ProbeLookup) -> Vec<String> {
    let names = body(lookup).into_iter().map(|[name, _]| name);
    names.filter(|name| lookup.planes.is_some() || name != "probe").collect()
}

/// What the function of a proxy does.
pub(super) fn header(lookup: ProbeLookup) -> Vec<String> {
    let shape = match lookup.planes {
        None => "a box between the corners low and high, which are along the axes.".to_string(),
        Some(n) => format!(
            "{n} planes about the probe: xyz the outward unit normal, w > 0 the distance from the probe."
        ),
    };
    let mut lines = vec![
        "Where a ray of unit length from a place meets the proxy of a room: the normal over its cosine with the ray (xyz), the".into(),
        "distance (w). A wall that the place is outside of counts as being as far ahead as it is behind.".into(),
        format!("The proxy is {shape}"),
    ];
    if lookup.planes.is_some() {
        lines.push("Fill up with (0, 0, 0, 1).".into());
    }
    if lookup.smooth {
        lines.push(format!(
            "Edges are rounded where 1/t of two planes ahead differ by less than {}.",
            Eased::formula("bend").replace(&format!("{} ", Eased::REACH), "")
        ));
    }
    lines
}
