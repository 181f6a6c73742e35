//! One fetch: along a ray, and along the axis of a lobe.

use super::{Wanted, lobe, meet};

/// What becomes of a place met by the ray: `met` holds normal and distance. The direction is the
/// ray's own within 1e-6 of the distance about the probe, where the place is the probe's. Cosines
/// with the proxy's normal are at least 0.02.
const SEEN: &str = "
let offset = place - probe + met.w * ray;
let least = 1e-12 * met.w * met.w;
let square = dot(offset, offset);
let away = sqrt(max(square, least));
let towards = select(ray, offset / away, square > least);
let straight = dot(met.xyz, ray);
let facing = dot(met.xyz, towards);
let here = max(straight, 0.02);
let there = max(facing, 0.02);
";

/// The statements that meet the proxy by `ray` and see the place from the probe.
pub(super) fn seen(wanted: &Wanted) -> String {
    format!("let met = {}({});{SEEN}", meet::name(wanted.lookup), passed(wanted, "place, ray"))
}

/// The arguments of a call: some, how smooth edges are, the proxy.
pub(super) fn passed(wanted: &Wanted, first: &str) -> String {
    let power = if wanted.lookup.smooth { ", bend" } else { "" };
    let body: Vec<String> = meet::body(wanted.lookup).into_iter().map(|[name, _]| name).collect();
    format!("{first}{power}, {}", body.join(", "))
}

/// The statements that name the lobe's `ray` and `width`, and how smooth edges are.
pub(super) fn about(wanted: &Wanted) -> String {
    let lobe = if wanted.lookup.is_fitted() { lobe::AXIS } else { "let width = alpha;\n" };
    let bend = format!("let bend = {};\n", wanted.power.source("width"));
    if wanted.lookup.smooth { lobe.to_string() + &bend } else { lobe.to_string() }
}

/// A function of a place, of what else is named, of the lobe's width, and of the proxy.
pub(super) fn function(name: &str, points: &[&str], bend: bool, wanted: &Wanted, end: [&str; 2]) -> String {
    let points = ["place"].iter().chain(points).map(|point| format!("{point}: vec3f"));
    let numbers = [Some("alpha"), bend.then_some("bend")].into_iter().flatten().map(|n| format!("{n}: f32"));
    let body = meet::body(wanted.lookup).into_iter().map(|[name, kind]| format!("{name}: {kind}"));
    let arguments: Vec<String> = points.chain(numbers).chain(body).collect();
    let [result, body] = end;
    format!("fn {name}({}) -> {result} {{\n{body}}}\n", arguments.join(", "))
}

/// The fetch along a ray.
pub(super) fn fetch(wanted: &Wanted) -> String {
    let body = [
        seen(wanted),
        "let rho = met.w / away * sqrt(there / here);\n".into(),
        format!("let width = {};\n", wanted.width.call("alpha", "rho")),
        format!("return vec4f(towards, {});\n", wanted.fetched("width")),
    ];
    function(&wanted.fetch, &["ray"], wanted.lookup.smooth, wanted, ["vec4f", &body.concat()])
}

/// The points that a lookup takes beside the place. Several fetches of the mirror lobe take the
/// normal too, for fetches that leave below the surface.
pub(super) fn points(wanted: &Wanted) -> &'static [&'static str] {
    match (wanted.lookup.is_fitted(), wanted.lookup.taps > 1) {
        (true, _) => &["normal", "view"],
        (false, true) => &["normal", "ray"],
        (false, false) => &["ray"],
    }
}

/// The lookup by one fetch.
pub(super) fn lookup(wanted: &Wanted) -> String {
    let call = format!("return {}({});\n", wanted.fetch, passed(wanted, "place, ray, width"));
    function(&wanted.name, points(wanted), false, wanted, ["vec4f", &(about(wanted) + &call)])
}
