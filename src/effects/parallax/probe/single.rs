//! One fetch: along a ray, and along the axis of a lobe.

use super::{Wanted, lobe, meet};
use crate::effects::parallax::room::proxies::Eased;

/// What becomes of a place met by the ray: `met` holds normal and distance.
const SEEN: &str = "
let offset = place - probe + met.w * ray;
let nearer = inverseSqrt(SQUARE);
let towards = offset * nearer;
let ratio = met.w * nearer;
";

/// The statements that meet the proxy by `ray` and see the place from the probe.
pub(super) fn seen(wanted: &Wanted) -> String {
    // a body with smooth edges may pass through the probe
    let square = if wanted.lookup.smooth { "max(dot(offset, offset), 1e-20)" } else { "dot(offset, offset)" };
    let call = call(wanted, "place, ray", &meet::passed(wanted.lookup));
    format!("let met = {}({call});{}", meet::name(wanted.lookup), SEEN.replace("SQUARE", square))
}

fn call(wanted: &Wanted, first: &str, body: &[String]) -> String {
    let bend = if wanted.lookup.smooth { ", bend" } else { "" };
    format!("{first}{bend}, {}", body.join(", "))
}

/// The arguments of a call: some, how smooth edges are, the proxy.
pub(super) fn passed(wanted: &Wanted, first: &str) -> String {
    let body: Vec<String> = meet::body(wanted.lookup).into_iter().map(|[name, _]| name).collect();
    call(wanted, first, &body)
}

/// The statements that name the lobe's `ray` and `width`, and how smooth edges are.
pub(super) fn about(wanted: &Wanted) -> String {
    let lobe = if wanted.lookup.is_fitted() { lobe::AXIS } else { "let width = alpha;\n" };
    let bend = format!("let bend = {};\n", Eased::source("width"));
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

/// The width by the square of rho, which is clamped, as 1 over it: `parallax_1` is 1 over the
/// larger of 1 and (1 + K alpha)/(rho alpha) - K.
const WIDTH: &str = "
let seen = clamp(ratio * ratio * dot(met.xyz, towards), LEAST_RHO, MOST_RHO) * (alpha * alpha);
let narrow = max((1.0 + FLOW * alpha) * inverseSqrt(max(seen, 1e-24)) - FLOW, 1.0);
";

/// The width by the distances of what the engine has hit, as 1 over it.
const HIT: &str = "
let away = sqrt(dot(offset, offset));
let held = clamp(distance, LEAST_RHO * away, MOST_RHO * away);
let narrow = max((1.0 + FLOW * alpha) * away / max(held * alpha, 1e-20) - FLOW, 1.0);
";

/// The lookup of what the engine has hit.
pub(super) fn hit(wanted: &Wanted) -> String {
    let [low, high] = wanted.rho;
    let constants = [("LEAST_RHO", low), ("MOST_RHO", high), ("FLOW", wanted.flow)];
    let (name, body, fetched) = (&wanted.name, named(HIT, constants), wanted.fetched());
    format!(
        "fn {name}(offset: vec3f, distance: f32, alpha: f32) -> vec4f {{\n{body}return vec4f(offset, {fetched});\n}}\n"
    )
}

/// A text with numbers for the names of its constants.
fn named(text: &str, constants: [(&str, f64); 3]) -> String {
    constants
        .into_iter()
        .fold(text.into(), |text: String, (name, value)| text.replace(name, &format!("{:?}", value as f32)))
}

/// The fetch along a ray.
pub(super) fn fetch(wanted: &Wanted) -> String {
    let [low, high] = wanted.rho.map(|rho| rho * rho);
    let constants = [("LEAST_RHO", low), ("MOST_RHO", high), ("FLOW", wanted.flow)];
    let body =
        [seen(wanted), named(WIDTH, constants), format!("return vec4f(towards, {});\n", wanted.fetched())];
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
