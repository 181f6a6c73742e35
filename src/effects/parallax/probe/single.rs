//! One fetch, as scripts: along a ray, and along the reflected one.

use super::script::{Kind, Routine};
use super::{Wanted, lobe, meet};

/// Least cosine of a ray to the proxy's normal.
const GRAZING: &str = "0.02";

/// What becomes of a place met by the ray: `met` holds normal and distance. The direction is the ray's own within 1e-6 of the distance about
/// the probe, where the place is the probe's.
const SEEN: &str = "
offset = place.x - probe.x + met.w * ray.x | place.y - probe.y + met.w * ray.y | place.z - probe.z + met.w * ray.z
least = 0.000000000001 * met.w * met.w
square = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z
away = sqrt(max(square, least))
towards = choose(square > least, offset.x / away, ray.x) | choose(square > least, offset.y / away, ray.y) | choose(square > least, offset.z / away, ray.z)
straight = met.x * ray.x + met.y * ray.y + met.z * ray.z
facing = met.x * towards.x + met.y * towards.y + met.z * towards.z
here = max(straight, GRAZING)
there = max(facing, GRAZING)
";

/// The lines that meet the proxy by `ray` and see that from the probe.
pub(super) fn seen(wanted: &Wanted) -> String {
    format!(
        "met :4 = {}({})\n{}",
        meet::name(wanted.lookup),
        passed(wanted, "place, ray"),
        SEEN.replace("GRAZING", GRAZING)
    )
}

/// The arguments of a call: some, how smooth edges are, the proxy.
pub(super) fn passed(wanted: &Wanted, first: &str) -> String {
    let power = if wanted.lookup.smooth { ", bend" } else { "" };
    let body: Vec<&str> = meet::body(wanted.lookup).iter().map(|(name, _)| *name).collect();
    format!("{first}{power}, {}", body.join(", "))
}

/// The line that names how smooth edges are.
pub(super) fn power(wanted: &Wanted) -> String {
    if wanted.lookup.smooth { format!("bend = {}\n", wanted.power.script()) } else { String::new() }
}

/// The name of the function of a fetch along a ray.
pub(super) fn name(wanted: &Wanted) -> String {
    wanted.fetch.clone()
}

/// The fetch along a ray.
pub(super) fn fetch(wanted: &Wanted) -> Routine {
    let start = [("place", Kind::Numbers(3)), ("ray", Kind::Numbers(3)), ("alpha", Kind::Numbers(1))];
    let power = wanted.lookup.smooth.then_some(("bend", Kind::Numbers(1)));
    let body = [
        seen(wanted),
        "rho = met.w / away * sqrt(there / here)\n".into(),
        format!("width :1 = {}\n", wanted.width.call("alpha", "rho")),
        wanted.level_lines("width"),
        format!("give towards.x | towards.y | towards.z | {}", wanted.fetched("width")),
    ];
    let what = if wanted.level.is_some() { "level" } else { "width" };
    let header = format!(
        "One fetch of the lookups below, along a ray, of a lobe of width alpha: direction and {what}."
    );
    Routine {
        name: name(wanted),
        header: vec![header],
        arguments: start.into_iter().chain(power).chain(meet::body(wanted.lookup)).collect(),
        result: Kind::Numbers(4),
        body: body.concat(),
    }
}

/// The arguments of a lookup: the place, what its lobe is told by, the proxy. Several fetches of the mirror lobe take the normal too, for
/// fetches that leave below the surface.
pub(super) fn arguments(wanted: &Wanted, normal: bool) -> Vec<(&'static str, Kind)> {
    let told: &[&str] = match (wanted.lookup.is_fitted(), normal) {
        (true, _) => &["normal", "view"],
        (false, true) => &["normal", "ray"],
        (false, false) => &["ray"],
    };
    let places = ["place"].iter().chain(told).map(|name| (*name, Kind::Numbers(3)));
    places.chain([("alpha", Kind::Numbers(1))]).chain(meet::body(wanted.lookup)).collect()
}

/// A script of a lobe of width `alpha` about `ray`, of the one that the lookup takes a surface's for.
pub(super) fn of_lobe(wanted: &Wanted, script: &str) -> String {
    if wanted.lookup.is_fitted() { lobe::of_this(wanted.lookup.taps, script) } else { script.into() }
}

/// The lookup by one fetch.
pub(super) fn lookup(wanted: &Wanted) -> Routine {
    let call = format!("fetch :4 = {}({})\ngive fetch", name(wanted), passed(wanted, "place, ray, alpha"));
    Routine {
        name: wanted.name.clone(),
        header: wanted.header.clone(),
        arguments: arguments(wanted, false),
        result: Kind::Numbers(4),
        body: of_lobe(wanted, &(power(wanted) + &call)),
    }
}
