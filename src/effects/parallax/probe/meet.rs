//! Where a ray meets a proxy: the formulas of [`crate::effects::parallax::room::proxies`] in a
//! shader's arithmetic, by `meet.wgsl`.

use super::constant;
use crate::data::ProbeLookup;
use crate::effects::parallax::room::proxies::{NEAREST, Tie};

/// The functions of boxes, and of as many planes as COUNT says.
const MEET: &str = include_str!("meet.wgsl");

/// Least share of the nearest plane's inverse distance that counts.
const LEAST_SHARE: f64 = 1e-8;

/// The name of the function of a proxy.
pub(super) fn name(lookup: ProbeLookup) -> String {
    format!("parallax_meet_{}_{}", lookup.shape(), lookup.edges())
}

/// The functions of proxies, for the planes of one.
pub(super) fn source(lookup: ProbeLookup) -> String {
    let constants = [
        constant("NEAREST", NEAREST),
        constant("LEAST", LEAST_SHARE),
        constant("GRAZING", Tie::GRAZING),
        constant("LEAST_BEND", 1.0 / Tie::MOST),
        constant("MOST_BEND", 1.0 / Tie::LEAST),
    ];
    constants.concat() + &MEET.replace("COUNT", &lookup.planes.unwrap_or(1).to_string())
}

/// The arguments that describe a proxy, with their types.
pub(super) fn body(lookup: ProbeLookup) -> Vec<[String; 2]> {
    let point = |name: &str| [name.to_string(), "vec3f".to_string()];
    match lookup.planes {
        None => vec![point("low"), point("high"), point("probe")],
        Some(n) => vec![["planes".into(), format!("array<vec4f, {n}>")], point("probe")],
    }
}

/// What the function of a proxy does.
pub(super) fn header(lookup: ProbeLookup) -> Vec<String> {
    let shape = match lookup.planes {
        None => {
            "a box between the corners low and high, which are along the axes; probe is inside.".to_string()
        }
        Some(n) => format!(
            "{n} planes about the probe: xyz the outward unit normal, w > 0 the distance from the probe."
        ),
    };
    let mut lines = vec![
        "Where a ray of unit length from a place meets the proxy of a room: its unit normal (xyz) and the distance (w).".into(),
        format!("The proxy is {shape}"),
    ];
    if lookup.planes.is_some() {
        lines.push("Fill up with (0, 0, 0, 1).".into());
    }
    if lookup.smooth {
        lines.push("Edges are smooth: t = (sum t_i^-p)^(-1/p) over the planes ahead, with that body's normal; p = 1/(bend s) within".into());
        lines.push(format!(
            "[{}, {}], s twice the standard deviation of n_i/max(n_i.ray, {}) with weights t_i^-4.",
            Tie::LEAST,
            Tie::MOST,
            Tie::GRAZING
        ));
    }
    lines.push(format!(
        "A plane ahead that the place is on or outside of counts as {NEAREST} of the probe's distance to it away."
    ));
    lines
}
