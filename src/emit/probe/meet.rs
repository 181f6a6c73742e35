//! Where a ray meets a proxy, as scripts: the formulas of [`crate::effects::room::proxies`], in f32.

use super::script::{Kind, Routine};
use crate::data::ProbeLookup;

/// [`NEAREST`](crate::effects::room::proxies::NEAREST) as scripts write it.
pub(super) const NEAREST: &str = "0.0001";

/// Least share of the nearest plane's inverse distance that counts: pow(0, p) is undefined in some languages, and a smaller one is that of a
/// ray along the plane.
const LEAST_SHARE: &str = "0.00000001";

/// The name of the function of a proxy.
pub(super) fn name(lookup: ProbeLookup) -> String {
    format!("parallax_meet_{}_{}", lookup.shape(), lookup.edges())
}

/// The arguments that describe a proxy.
pub(super) fn body(lookup: ProbeLookup) -> Vec<(&'static str, Kind)> {
    let place = Kind::Numbers(3);
    match lookup.planes {
        None => vec![("low", place), ("high", place), ("probe", place)],
        Some(n) => vec![("planes", Kind::Planes(n)), ("probe", place)],
    }
}

/// The function of a proxy: unit normal, then the distance along the ray.
pub(super) fn routine(lookup: ProbeLookup) -> Routine {
    let power = lookup.smooth.then_some(("power", Kind::Numbers(1)));
    let start = [("place", Kind::Numbers(3)), ("ray", Kind::Numbers(3))];
    let arguments = start.into_iter().chain(power).chain(body(lookup)).collect();
    let script = match (lookup.planes, lookup.smooth) {
        (None, smooth) => of_box(smooth),
        (Some(_), true) => SMOOTH_PLANES.replace("NEAREST", NEAREST).replace("LEAST", LEAST_SHARE),
        (Some(_), false) => SHARP_PLANES.replace("NEAREST", NEAREST),
    };
    Routine { name: name(lookup), header: header(lookup), arguments, result: Kind::Numbers(4), body: script }
}

fn header(lookup: ProbeLookup) -> Vec<String> {
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
        lines.push("Edges are smooth: t = (sum t_i^-p)^(-1/p) over the planes ahead, p = power in [2, 256], with that body's normal.".into());
    }
    lines.push(format!(
        "A plane ahead that the place is on or outside of counts as {NEAREST} of the probe's distance to it away."
    ));
    lines
}

/// Nearness is 1 over a plane's distance from the place, with the normal's sign; its product with the ray is 1 over the distance along it.
fn of_box(smooth: bool) -> String {
    let mut script = String::new();
    for k in ["x", "y", "z"] {
        script += &format!(
            "ahead_{k} = choose(ray.{k} > 0.0, high.{k} - place.{k}, low.{k} - place.{k})
            least_{k} = choose(ray.{k} > 0.0, high.{k} - probe.{k}, low.{k} - probe.{k})
            side_{k} = choose(ray.{k} > 0.0, 1.0, -1.0)
            nearness_{k} = side_{k} / max(side_{k} * ahead_{k}, {NEAREST} * side_{k} * least_{k})
            along_{k} = nearness_{k} * ray.{k}\n"
        );
    }
    script += "steepest = max(max(along_x, along_y), along_z)\n";
    script + &if smooth { SMOOTH_BOX.replace("LEAST", LEAST_SHARE) } else { SHARP_BOX.into() }
}

const SMOOTH_BOX: &str = "
scale = 1.0 / steepest
weight_x = choose(along_x * scale > LEAST, pow(max(along_x * scale, LEAST), power - 1.0), 0.0)
weight_y = choose(along_y * scale > LEAST, pow(max(along_y * scale, LEAST), power - 1.0), 0.0)
weight_z = choose(along_z * scale > LEAST, pow(max(along_z * scale, LEAST), power - 1.0), 0.0)
sum = (weight_x * along_x + weight_y * along_y + weight_z * along_z) * scale
normal = weight_x * nearness_x * scale | weight_y * nearness_y * scale | weight_z * nearness_z * scale
unit = 1.0 / sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z)
give normal.x * unit | normal.y * unit | normal.z * unit | scale / pow(sum, 1.0 / power)";

const SHARP_BOX: &str = "
is_x = choose(along_x >= max(along_y, along_z), 1.0, 0.0)
is_y = choose(along_y >= along_z, 1.0 - is_x, 0.0)
give side_x * is_x | side_y * is_y | side_z * (1.0 - is_x - is_y) | 1.0 / steepest";

const SMOOTH_PLANES: &str = "
offset = place.x - probe.x | place.y - probe.y | place.z - probe.z
var steepest = 0.0
each
    depth = max(plane.w - (plane.x * offset.x + plane.y * offset.y + plane.z * offset.z), NEAREST * plane.w)
    set steepest = max(steepest, (plane.x * ray.x + plane.y * ray.y + plane.z * ray.z) / depth)
end
scale = 1.0 / steepest
var sum = 0.0
var normal_x = 0.0
var normal_y = 0.0
var normal_z = 0.0
each
    nearness = scale / max(plane.w - (plane.x * offset.x + plane.y * offset.y + plane.z * offset.z), NEAREST * plane.w)
    share = (plane.x * ray.x + plane.y * ray.y + plane.z * ray.z) * nearness
    weight = choose(share > LEAST, pow(max(share, LEAST), power - 1.0), 0.0)
    set sum = sum + weight * share
    set normal_x = normal_x + weight * nearness * plane.x
    set normal_y = normal_y + weight * nearness * plane.y
    set normal_z = normal_z + weight * nearness * plane.z
end
unit = 1.0 / sqrt(normal_x * normal_x + normal_y * normal_y + normal_z * normal_z)
give normal_x * unit | normal_y * unit | normal_z * unit | scale / pow(sum, 1.0 / power)";

const SHARP_PLANES: &str = "
offset = place.x - probe.x | place.y - probe.y | place.z - probe.z
var steepest = 0.0
var normal_x = 0.0
var normal_y = 0.0
var normal_z = 0.0
each
    depth = max(plane.w - (plane.x * offset.x + plane.y * offset.y + plane.z * offset.z), NEAREST * plane.w)
    along = (plane.x * ray.x + plane.y * ray.y + plane.z * ray.z) / depth
    set normal_x = choose(along > steepest, plane.x, normal_x)
    set normal_y = choose(along > steepest, plane.y, normal_y)
    set normal_z = choose(along > steepest, plane.z, normal_z)
    set steepest = max(steepest, along)
end
give normal_x | normal_y | normal_z | 1.0 / steepest";
