//! One fetch, as a script.

use super::script::{Kind, Routine};
use super::{Wanted, meet};

/// Least cosine of a ray to the proxy's normal.
pub(super) const GRAZING: &str = "0.02";

/// What becomes of a place met by a ray: `met` holds normal and distance, `ray` and `place` are those of the ray.
pub(super) const SEEN: &str = "
from = place.x - probe.x + met.w * RAY.x | place.y - probe.y + met.w * RAY.y | place.z - probe.z + met.w * RAY.z
least = 0.000000000001 * met.w * met.w
square = from.x * from.x + from.y * from.y + from.z * from.z
away = sqrt(max(square, least))
towards = choose(square > least, from.x / away, RAY.x) | choose(square > least, from.y / away, RAY.y) | choose(square > least, from.z / away, RAY.z)
here = max(met.x * RAY.x + met.y * RAY.y + met.z * RAY.z, GRAZING)
there = max(met.x * towards.x + met.y * towards.y + met.z * towards.z, GRAZING)
rho = met.w / away * sqrt(there / here)
";

/// [`SEEN`] of a ray of this name.
pub(super) fn seen(ray: &str) -> String {
    SEEN.replace("RAY", ray).replace("GRAZING", GRAZING)
}

/// The line that meets the proxy by a ray of this name.
pub(super) fn met(wanted: &Wanted, ray: &str) -> String {
    let power = if wanted.lookup.smooth { "power, " } else { "" };
    let body: Vec<&str> = meet::body(wanted.lookup).iter().map(|(name, _)| *name).collect();
    format!("met :4 = {}(place, {ray}, {power}{})\n", meet::name(wanted.lookup), body.join(", "))
}

/// The lines that name the power of the smooth proxy.
pub(super) fn power(wanted: &Wanted) -> String {
    if wanted.lookup.smooth { format!("power = {}\n", wanted.power.script()) } else { String::new() }
}

/// The lookup by one fetch.
pub(super) fn routine(wanted: &Wanted) -> Routine {
    let start = [("place", Kind::Numbers(3)), ("ray", Kind::Numbers(3)), ("alpha", Kind::Numbers(1))];
    let width = format!("width :1 = {}\n", wanted.width.call("alpha", "rho"));
    let body = [
        power(wanted),
        met(wanted, "ray"),
        seen("ray"),
        width,
        wanted.level_lines("width"),
        format!("give towards.x | towards.y | towards.z | {}", wanted.fetched("width")),
    ];
    Routine {
        name: wanted.name.clone(),
        header: wanted.header.to_vec(),
        arguments: start.into_iter().chain(meet::body(wanted.lookup)).collect(),
        result: Kind::Numbers(4),
        body: body.concat(),
    }
}
