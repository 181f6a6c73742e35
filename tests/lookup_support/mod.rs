//! Lookups of probes as emitted: in every language that a compiler is there for, and on a device,
//! they fetch what the lookups of the study do, also from places and along rays that are hard.
#![allow(dead_code, reason = "each test binary uses its part")]

use crate::emit_support;

use std::ops::Range;
use std::sync::LazyLock;

use crate::baked_support::bake_scene;
use emit_support::compilers::{self, Contraction, loops};
use emit_support::functions;
use emit_support::programs::run;
use lobefit::bake::Baked;
use lobefit::data::{ProbeLookup, SurfaceLobe};
use lobefit::effects::parallax::taps::horizon::{FADE, fade};
use lobefit::effects::parallax::{LobeFit, Shading, ShadingLobe, Stretch, TapRule};
use lobefit::scene::Scene;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, dot, length, minus, normalise, plus, scaled, tangents};
use lobefit_shade::Hypothesis;
use lobefit_shade::code::Language;
use lobefit_studies::study::parallax::room::proxies::{Body, Eased, NEAREST};
use lobefit_studies::study::parallax::room::{Meeting, Proxy, Room, Seen, octagon, room_b};
use lobefit_truth::optics::kernel::Kernel;
use serde_json::Value;

/// Every kind of lookup, of a chain of widths and of one of levels.
const SCENE: &str = r#"{"schema_version": 1, "name": "test", "pick": "all", "materials": [], "probes": [
    {"name": "a", "norms": ["max"], "max_ops": 13, "lookups": [
        {}, {"edges": "sharp"}, {"planes": 11}, {"planes": 11, "edges": "sharp"},
        {"taps": 2}, {"taps": 3}, {"planes": 11, "taps": 3}, {"edges": "sharp", "taps": 2},
        {"lobe": "fitted"}, {"planes": 11, "edges": "sharp", "lobe": "fitted"}, {"taps": 2, "lobe": "fitted"},
        {"planes": 11, "taps": 3, "lobe": "fitted"}, {"edges": "sharp", "taps": 3, "lobe": "fitted"}]},
    {"name": "b", "norms": ["max"], "max_ops": 13, "mips": {"map": "linear", "count": 7},
        "lookups": [{}, {"taps": 3}, {"taps": 3, "lobe": "fitted"}]},
    {"name": "c", "norms": ["max"], "max_ops": 13, "kernel": "ndf", "lookups": [{"planes": 14}, {"taps": 2}]},
    {"name": "d", "norms": ["max"], "max_ops": 13, "kernel": "half", "lookups": [{"edges": "sharp", "taps": 3}]}]}"#;

pub static BAKED: LazyLock<Baked> = LazyLock::new(|| {
    let scene = Scene::from_json(SCENE.as_bytes(), "test.json").expect("a scene");
    bake_scene(&scene).expect("a bake")
});

pub fn text(language: Language) -> String {
    let file = format!("fits/lobefit.{}", language.extension());
    String::from_utf8(BAKED.files[&file].clone()).expect("UTF-8")
}

/// A lookup of the manifest, the room that it is run in, and the width that it calls.
pub struct Emitted {
    pub entry: Value,
    pub lookup: ProbeLookup,
    pub room: Room,
    width: Hypothesis,
}

/// Widths that are not 0 far from where they are fitted; the last is that of a mirror.
const ALPHAS: [f32; 7] = [0.01, 0.04, 0.1225, 0.25, 0.5, 1.0, 0.0];

pub static EMITTED: LazyLock<Vec<Emitted>> = LazyLock::new(|| {
    let manifest: Value = serde_json::from_slice(&BAKED.files["manifest.json"]).expect("JSON");
    let source = text(Language::Wgsl);
    let known = functions(&source);
    let of = |entry: &Value| {
        let word = |key: &str| entry[key].as_str().expect("a word");
        let planes = word("proxy").strip_prefix("planes_").map(|n| n.parse().expect("a number"));
        let width = Hypothesis::parse("lobefit.wgsl", &emit_support::module(word("width"), &known));
        let taps = entry["cost"]["fetches"].as_u64().expect("a number") as u32;
        Emitted {
            entry: entry.clone(),
            lookup: ProbeLookup {
                hit: false,
                planes,
                smooth: word("edges") == "smooth",
                taps,
                lobe: lobe(word("lobe")),
            },
            room: single(if planes.is_some() { octagon() } else { room_b() }),
            width: width.expect("a formula"),
        }
    };
    manifest["lookups"].as_array().expect("lookups").iter().map(of).collect()
});

fn lobe(word: &str) -> SurfaceLobe {
    [SurfaceLobe::Mirror, SurfaceLobe::Fitted].into_iter().find(|lobe| lobe.name() == word).expect("a lobe")
}

/// The room with its planes and its probe as f32 have them, which is what shaders are given.
pub fn single(mut room: Room) -> Room {
    let f32 = |x: f64| f64::from(x as f32);
    room.probe = room.probe.map(f32);
    for wall in &mut room.walls {
        wall.plane.normal = wall.plane.normal.map(f32);
        // planes are given by their distance from the probe
        let height = f32(wall.plane.depth(room.probe));
        wall.plane.offset = height + dot(wall.plane.normal, room.probe);
    }
    room
}

impl Emitted {
    pub fn name(&self) -> &str {
        self.entry["function"].as_str().expect("a name")
    }

    fn proxy(&self) -> Box<dyn Proxy> {
        let body = Body::new(&self.room.shape(), self.room.probe).expect("a probe inside");
        if self.lookup.smooth { Box::new(Eased { body }) } else { Box::new(body) }
    }

    /// The planes about the probe, filled up.
    pub fn planes(&self) -> Vec<[f32; 4]> {
        let own = self.room.walls.iter().map(|wall| {
            let [x, y, z] = wall.plane.normal;
            [x, y, z, wall.plane.depth(self.room.probe)].map(|x| x as f32)
        });
        let count = self.lookup.planes.unwrap_or(0) as usize;
        own.chain(std::iter::repeat([0.0, 0.0, 0.0, 1.0])).take(count).collect()
    }

    /// Corners of a box, and the probe.
    pub fn corners(&self) -> [[f32; 3]; 3] {
        let planes = &self.room.walls;
        let high = [1, 3, 5].map(|i| planes[i].plane.offset as f32);
        let low = [0, 2, 4].map(|i| -planes[i].plane.offset as f32);
        [low, high, self.room.probe.map(|x| x as f32)]
    }
}

/// Place, the surface's normal, the ray or for the fitted lobe the view, alpha.
pub type Point = [f32; 10];

/// Places all over a room and beyond, on its walls and edges, with rays of all directions, along
/// axes, walls and as good as along them.
pub fn points(room: &Room) -> Vec<Point> {
    let (places, turns) = (Sobol::new([1, 2, 3]), Sobol::new([4, 5, 6]).padded(7));
    let even = |set: &Sobol, i: u32| [0, 1, 2].map(|k| 2.0 * set.coordinate(i, k) - 1.0);
    let mut points = Vec::new();
    let at = |place: Vec3, ray: Vec3, alpha: f32| -> Point {
        let ray = normalise(ray);
        // some surfaces are seen head on, some at grazing angles
        let [a, b, c] = even(&turns, 5000 + (place[0].to_bits() as u32 ^ ray[1].to_bits() as u32) % 1000);
        let normal = normalise(plus(ray, scaled(normalise([a, b, c]), 0.98)));
        let [p, n, r] = [place, normal, ray].map(|v| v.map(|x| x as f32));
        [p[0], p[1], p[2], n[0], n[1], n[2], r[0], r[1], r[2], alpha]
    };
    for i in 0..4000_u32 {
        let [x, y, z] = even(&places, i);
        // some of them outside
        let place = [6.5 * x, 3.0 * y, 1.6 * z];
        points.push(at(place, even(&turns, i), ALPHAS[i as usize % ALPHAS.len()]));
    }
    for (i, wall) in room.walls.iter().enumerate() {
        let normal = wall.plane.normal;
        let foot = plus(room.probe, scaled(normal, wall.plane.depth(room.probe)));
        let other = &room.walls[(i + 2) % room.walls.len()].plane;
        let beside = plus(foot, scaled(other.normal, other.depth(foot)));
        for place in [foot, beside, plus(foot, scaled(normal, 2.0))] {
            for (k, alpha) in ALPHAS.into_iter().enumerate() {
                for (axis, sign) in [(0, 1.0), (1, 1.0), (2, 1.0), (0, -1.0), (1, -1.0), (2, -1.0)] {
                    let mut along = [0.0; 3];
                    along[axis] = sign;
                    points.push(at(place, along, alpha));
                    points.push(at(place, plus(along, scaled(normal, -1e-4)), alpha));
                }
                points.push(at(place, normal, alpha));
                points.push(at(
                    place,
                    plus(scaled(normal, -1.0), scaled(even(&turns, k as u32), 0.3)),
                    alpha,
                ));
            }
        }
    }
    points
}

/// Sines and cosines between the normals and the views of surfaces: head on, close to that, at
/// grazing angles, along the surface, below it and straight below.
const TILTS: [[f64; 2]; 12] = [
    [0.0, 1.0],
    [1e-7, 1.0],
    [1e-5, 1.0],
    [1e-3, 1.0],
    [1.0, 0.06],
    [1.0, 0.021],
    [1.0, 1e-4],
    [1.0, 0.0],
    [0.8, -0.6],
    [1e-3, -1.0],
    [1e-5, -1.0],
    [0.0, -1.0],
];

impl Emitted {
    /// Points of its room; where it takes the view, a part of them with hard ones.
    pub fn points(&self) -> Vec<Point> {
        let mut points = points(&self.room);
        if self.lookup.is_fitted() {
            for (i, point) in points.iter_mut().enumerate() {
                let Some([sine, cosine]) = TILTS.get(i % 16) else { continue };
                let view = [6, 7, 8].map(|k| f64::from(point[k]));
                let [across, _] = tangents(view);
                let normal = normalise(plus(scaled(across, *sine), scaled(view, *cosine)));
                (0..3).for_each(|k| point[3 + k] = normal[k] as f32);
            }
        }
        points
    }

    /// The lobe that a point is looked up for.
    fn lobe(&self, [place, normal, last]: [Vec3; 3], alpha: f64) -> ShadingLobe {
        match self.lookup.lobe {
            SurfaceLobe::Mirror => ShadingLobe { axis: last, alpha, axes: tangents(last) },
            SurfaceLobe::Fitted => {
                let seen = Seen { place, normal, view: last, alpha };
                Shading::Fitted(LobeFit::of(self.lookup.taps)).lobe(&seen)
            }
        }
    }
}

/// What is expected at a point, and how far f32 may be from it.
pub struct Expected {
    pub towards: Vec3,
    pub width: f64,
    pub weight: f64,
    allowed: f64,
}

/// Ratios of distances where the scene gives none: lookups clamp theirs to them.
pub const RHO: [f64; 2] = [0.0625, 8.0];

/// The rounding of a place in a room of f32 coordinates, with that of the operations on it.
const ROUNDING: f64 = 2e-6;

impl Emitted {
    /// One fetch along a ray, of a lobe that is `alpha` wide, through the proxy of a lobe that is
    /// `whole` wide.
    fn expected(&self, place: Vec3, ray: Vec3, alpha: f64, whole: f64) -> Option<Expected> {
        let Meeting { distance, place: met, normal } = self.proxy().meet(place, ray, whole)?;
        let away = minus(met, self.room.probe);
        let towards = normalise(away);
        let here = dot(normal, ray);
        let slanted = dot(normal, towards).max(0.0) / here;
        let rho = (distance / length(away) * slanted.sqrt()).clamp(RHO[0], RHO[1]);
        let width = self.width_at(alpha, rho);
        // a plane's distance carries the rounding of coordinates: relative to that distance it
        // moves the place met along the ray, and tilts the normal of a smooth body by as much, p
        // times
        let ahead = self
            .room
            .walls
            .iter()
            .map(|wall| (wall.plane.depth(place).abs().max(NEAREST), dot(wall.plane.normal, ray)));
        let nearest = ahead.clone().filter(|(_, a)| *a > 0.0).map(|(d, _)| d).fold(f64::INFINITY, f64::min);
        let unsure = ROUNDING / nearest;
        // the normal turns from that of one plane to the next's within the rounding of the edge
        let power = if self.lookup.smooth { 1.0 / Eased::bend(whole) } else { 1.0 };
        // where two planes are as near, the sharp proxy takes either
        let mut along: Vec<f64> = ahead.map(|(d, a)| a / d).collect();
        along.sort_by(f64::total_cmp);
        let tie = 1.0 - along[along.len() - 2] / along[along.len() - 1];
        if !self.lookup.smooth && tie < 1e-4 + 4.0 * unsure {
            return None;
        }
        let allowed =
            ROUNDING + unsure * distance / length(away) + 0.5 * power * unsure / here + power * ROUNDING;
        Some(Expected { towards, width, weight: 1.0, allowed })
    }

    /// The width of a fetch.
    pub fn width_at(&self, alpha: f64, rho: f64) -> f64 {
        self.width.tape().evaluate(&[vec![alpha], vec![rho]], &[]).expect("a width")[0]
    }

    /// Whether a point is outside of a wall of the room, or on it.
    pub fn is_outside(&self, point: &Point) -> bool {
        let place = [0, 1, 2].map(|k| f64::from(point[k]));
        self.room.walls.iter().any(|wall| wall.plane.depth(place) < 1e-6)
    }

    /// The fetches at a point; none where f32 may decide otherwise: which of two planes as near,
    /// which end of an axis that is as long is which.
    pub fn all_expected(&self, point: &Point) -> Option<Vec<Expected>> {
        let [place, normal, last] = [0, 3, 6].map(|k| [0, 1, 2].map(|axis| f64::from(point[k + axis])));
        let lobe = self.lobe([place, normal, last], f64::from(point[9]));
        let (ray, alpha) = (lobe.axis, lobe.alpha);
        let one = self.expected(place, ray, alpha, alpha)?;
        if self.lookup.taps == 1 {
            return Some(vec![one]);
        }
        let kernel = self.entry["kernel"].as_str().and_then(Kernel::of).expect("a kernel");
        let rule = TapRule::of(&kernel, self.lookup.taps as usize).expect("a rule");
        let hit = self.proxy().meet(place, ray, alpha)?;
        let stretch = Stretch::of_lobe(place, &hit, self.room.probe, alpha, lobe.axes)?;
        if stretch.growth < 1e-3 {
            return None;
        }
        let mut fetches = Vec::new();
        let ruled = rule.taps(&stretch, alpha);
        let mut faded = ruled.clone();
        fade(&mut faded, ray, stretch.major, normal);
        // close to the surface what a cosine is off by goes into weights and tilts, as many times
        // as a fade is steep
        let fading = if faded == ruled { 1.0 } else { 1.0 / FADE };
        for tap in faded {
            let tilted = normalise(plus(ray, scaled(stretch.major, tap.tilt)));
            let fetch = self.expected(place, tilted, tap.width * alpha, alpha)?;
            // the axis of a footprint turns by the normal's tilt over what its axes differ by, a
            // fetch by its own tilt of that
            let steep = 1.0 / dot(hit.normal, ray).max(0.02);
            let unsure = ROUNDING * steep * steep;
            let spread = alpha * (unsure / stretch.length).min(unsure.sqrt());
            let turned = 40.0 * steep * alpha * one.allowed + 4.0 * spread;
            let allowed = fading * (fetch.allowed * (1.0 + steep) + turned);
            fetches.push(Expected { weight: tap.weight, allowed, ..fetch });
        }
        Some(fetches)
    }

    /// Numbers that a call returns.
    pub fn numbers(&self) -> usize {
        if self.lookup.taps == 1 { 4 } else { 5 * self.lookup.taps as usize }
    }

    /// What is expected at each of its points: of any language the same.
    pub fn job(&self) -> Job<'_> {
        let points = self.points();
        let expected = points.iter().map(|point| self.all_expected(point)).collect();
        Job { emitted: self, points, expected }
    }
}

/// A lookup with its points, and what is expected there.
pub struct Job<'a> {
    pub emitted: &'a Emitted,
    pub points: Vec<Point>,
    expected: Vec<Option<Vec<Expected>>>,
}

impl Job<'_> {
    /// Checks what a language returned: directions with widths, or with levels of a linear chain;
    /// then weights.
    pub fn agrees(&self, language: &str, found: &[f32]) {
        let Job { emitted, points, expected } = self;
        let (numbers, taps) = (emitted.numbers(), emitted.lookup.taps as usize);
        assert_eq!(found.len(), numbers * points.len(), "{language}: {}", emitted.name());
        let (mut compared, mut worst) = (0, 0.0_f64);
        for ((point, expected), found) in points.iter().zip(expected).zip(found.chunks_exact(numbers)) {
            let text = || format!("{language}: {} at {point:?}: {found:?}", emitted.name());
            assert!(found.iter().all(|x| x.is_finite()), "{}", text());
            let weights: Vec<f32> = if taps == 1 { vec![1.0] } else { found[4 * taps..].to_vec() };
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{}", text());
            compared += usize::from(expected.is_some());
            for (i, weight) in weights.iter().enumerate() {
                let [x, y, z, w] = [0, 1, 2, 3].map(|k| f64::from(found[4 * i + k]));
                assert!((length([x, y, z]) - 1.0).abs() < 1e-5, "{}", text());
                let width = if emitted.entry["gives"] == "mip" { (w / 6.0) * (w / 6.0) } else { w };
                assert!((0.0..=1.0 + 1e-6).contains(&width), "{}", text());
                let Some(expected) = expected else { continue };
                let Expected { towards, width: wanted, weight: share, allowed } = expected[i];
                let gap = (f64::from(*weight) - share).abs();
                assert!(gap < 1e-5 + 4.0 * allowed, "{}: weight {i} {share}, {allowed:e}", text());
                if share < 1e-6 {
                    continue;
                }
                // the axis of a round footprint is any: what lies along it weighs next to nothing
                let allowed = allowed / share.clamp(0.01, 1.0);
                let off = length(minus([x, y, z], towards)) / allowed;
                let relative = (width - wanted).abs() / wanted.max(1e-6);
                assert!(off < 1.0, "{}, direction {i} off by {off} of {allowed:e}", text());
                assert!(
                    relative < 8.0 * allowed + 1e-5,
                    "{}, expected width {i} {wanted}, {allowed:e}",
                    text()
                );
                worst = worst.max(off);
            }
        }
        // an axis of a lobe with several has no sign where it grows nowhere, as those have that are
        // next to nothing wide
        let least = if taps == 1 { 8 } else { 6 };
        assert!(compared * 10 > points.len() * least, "{language}: {compared} of {} compared", points.len());
        assert!(worst > 1e-3, "{language}: {}: the tolerance says nothing: {worst}", emitted.name());
    }
}

pub fn bytes(points: &[Point]) -> Vec<u8> {
    points.iter().flatten().flat_map(|x| x.to_le_bytes()).collect()
}

/// A vector of literals.
pub fn literal(language: Language, values: &[f32]) -> String {
    let n = values.len();
    let list: Vec<String> = values.iter().map(|x| format!("{x:?}{}", suffix(language))).collect();
    let list = list.join(", ");
    match language {
        Language::Rust => format!("[{list}]"),
        Language::Wgsl => format!("vec{n}<f32>({list})"),
        Language::Glsl => format!("vec{n}({list})"),
        Language::C => format!("{{{list}}}"),
        Language::Hlsl | Language::Msl => format!("float{n}({list})"),
    }
}

fn suffix(language: Language) -> &'static str {
    if matches!(language, Language::Rust | Language::Wgsl | Language::Glsl) { "" } else { "f" }
}

/// The type of a vector.
fn vector(language: Language, n: usize) -> String {
    match language {
        Language::Glsl => format!("vec{n}"),
        Language::C => format!("lobefit_float{n}"),
        _ => format!("float{n}"),
    }
}

/// Declarations of what a lookup is called with beside the point, and their names.
pub fn described(language: Language, k: usize, emitted: &Emitted) -> (String, String) {
    let [low, high, probe] = emitted.corners();
    let value = |name: &str, n: usize, value: String| match language {
        Language::Rust => format!("    let {name}_{k} = {value};\n"),
        Language::Wgsl => format!("    let {name}_{k} = {value};\n"),
        _ => format!("static {} {name}_{k} = {value};\n", vector(language, n)),
    };
    let probe = value("probe", 3, literal(language, &probe));
    let Some(count) = emitted.lookup.planes else {
        let [low, high] =
            [("low", low), ("high", high)].map(|(name, v)| value(name, 3, literal(language, &v)));
        return (format!("{low}{high}{probe}"), format!("low_{k}, high_{k}, probe_{k}"));
    };
    let list: Vec<String> = emitted.planes().iter().map(|plane| literal(language, plane)).collect();
    let list = list.join(", ");
    let planes = match language {
        Language::Rust => format!("    let planes_{k} = &[{list}];\n"),
        Language::Wgsl => format!("    let planes_{k} = array<vec4<f32>, {count}>({list});\n"),
        _ => format!("static {} planes_{k}[{count}] = {{{list}}};\n", vector(language, 4)),
    };
    (format!("{planes}{probe}"), format!("planes_{k}, probe_{k}"))
}

/// What the functions of a language return, each at its points, by one program that calls them all; none
/// where the compiler is not there.
pub fn found(language: Language, jobs: &[(&Emitted, &[Point])]) -> Option<Vec<Vec<f32>>> {
    let all: Vec<u8> = jobs.iter().flat_map(|(_, points)| bytes(points)).collect();
    let (mut from, mut declarations, mut bodies) = (0, String::new(), Vec::new());
    for (k, (emitted, points)) in jobs.iter().enumerate() {
        let own = from..from + points.len();
        from = own.end;
        let (declared, names) = described(language, k, emitted);
        declarations += &declared;
        bodies.push(match language {
            Language::Rust => emitted.loop_in_rust(&names, own),
            _ => emitted.body_in_c(language, &names, own),
        });
    }
    let code = text(language);
    let values = match language {
        Language::Rust => run(&code, 10, &[declarations, bodies.concat()].concat(), &all),
        _ => {
            let main = [declarations, loops(10, &bodies)].concat();
            compilers::run(language, &code, &main, &all, Contraction::Off)?
        }
    };
    let mut rest = &values[..];
    let own = |(emitted, points): &(&Emitted, &[Point])| {
        let (own, others) = rest.split_at(emitted.numbers() * points.len());
        rest = others;
        own.to_vec()
    };
    Some(jobs.iter().map(own).collect())
}

impl Emitted {
    /// Whether it is called with the surface's normal before the ray or the view.
    pub fn takes_normal(&self) -> bool {
        self.lookup.taps > 1 || self.lookup.is_fitted()
    }

    /// The loop over its points that puts what the Rust function returns.
    fn loop_in_rust(&self, names: &str, own: Range<usize>) -> String {
        let normal = if self.takes_normal() { "[p[3], p[4], p[5]], " } else { "" };
        let call = format!(
            "lobefit::{}([p[0], p[1], p[2]], {normal}[p[6], p[7], p[8]], p[9], {names})",
            self.name()
        );
        let put = match self.lookup.taps {
            1 => format!("out.extend({call});"),
            _ => format!("let taps = {call}; out.extend(taps.fetches.concat()); out.extend(taps.weights);"),
        };
        format!("    for p in &points[{own:?}] {{ {put} }}\n")
    }

    /// What a loop of a language of C's family does at a point, where it is one of its own.
    fn body_in_c(&self, language: Language, names: &str, own: Range<usize>) -> String {
        let [three, four] = [3, 4].map(|n| vector(language, n));
        let argument = |name: &str, first: usize| match language {
            Language::C => {
                format!(
                    "        const {three} {name} = {{p[{first}], p[{}], p[{}]}};\n",
                    first + 1,
                    first + 2
                )
            }
            _ => format!("        const {three} {name}(p[{first}], p[{}], p[{}]);\n", first + 1, first + 2),
        };
        let arguments =
            [("place", 0), ("normal", 3), ("last", 6)].map(|(name, first)| argument(name, first)).concat();
        let parts = |name: &str| ["x", "y", "z", "w"].map(|part| format!("put({name}.{part}); ")).concat();
        let (name, taps) = (self.name(), self.lookup.taps);
        let (unused, normal) = if self.takes_normal() { ("", "normal, ") } else { ("(void)normal;", "") };
        let call = format!("{name}(place, {normal}last, p[9], {names})");
        let put = match taps {
            1 => format!("const {four} fetch = {call};\n        {}", parts("fetch")),
            _ => {
                let fetches: String = (0..taps).map(|i| parts(&format!("taps.fetch_{i}"))).collect();
                let weights: String = (0..taps).map(|i| format!("put(taps.weight_{i}); ")).collect();
                format!("const parallax_taps_{taps} taps = {call};\n        {fetches}{weights}")
            }
        };
        let [from, to] = [own.start, own.end].map(|i| 10 * i);
        let other = format!("if (p < points + {from} || p >= points + {to}) continue;");
        // C99 has declarations after statements.
        format!("        {other}\n{arguments}        {unused}{put}\n")
    }
}
