//! Lookups of probes, by the same arithmetic as the emitted functions in f64.

use std::hint::black_box;

use super::room::proxies::{Body, Eased};
use super::room::{Convex, Lookup, Plane, Proxy, Seen};
use super::{Corrected, LobeFit, Ratio, Shading, TapRule, Width, lobes};
use crate::data::{ProbeLookup, SurfaceLobe};
use crate::effects::effect::Clock;
use crate::report::TimedLookup;
use crate::scene::Scene;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::{Vec3, dot, normalise, scaled};

/// Pixels that a time is the mean of.
const PIXELS: u32 = 1 << 12;

/// Every lookup that a probe of the scene wants, once.
pub(super) fn lookups(scene: &Scene, seconds: Clock) -> Vec<TimedLookup> {
    let mut wanted: Vec<ProbeLookup> =
        lobes(scene).iter().flat_map(|lobe| &lobe.lookups).map(|(lookup, _)| *lookup).collect();
    wanted.sort();
    wanted.dedup();
    wanted.into_iter().filter_map(|lookup| timed(lookup, seconds)).collect()
}

fn timed(lookup: ProbeLookup, seconds: Clock) -> Option<TimedLookup> {
    // what it is looked up by the engine has found
    if lookup.hit {
        return None;
    }
    let body = Body::new(&shape(lookup.planes), [0.1, -0.2, 0.05])?;
    let time = if lookup.smooth {
        per_pixel(Eased { body }, lookup, seconds)
    } else {
        per_pixel(body, lookup, seconds)
    };
    Some(TimedLookup { lookup: lookup.text(), fetches: lookup.taps, nanoseconds: time * 1e9 })
}

/// A box, or so many planes about the origin at distance 1: their normals at random.
fn shape(planes: Option<u32>) -> Convex {
    let Some(planes) = planes else { return Convex::cuboid([-1.0; 3], [1.0; 3]) };
    let points = Sobol::new([1, 2, 3]);
    let normal = |i: u32| {
        let [x, y, z] = [0, 1, 2].map(|d| points.coordinate(i, d) - 0.5);
        Plane { normal: normalise([x, y, z]), offset: 1.0 }
    };
    Convex { planes: (0..planes).map(normal).collect() }
}

fn per_pixel<P: Proxy>(proxy: P, wanted: ProbeLookup, seconds: Clock) -> f64 {
    let rule = match wanted.taps {
        2 => TapRule::two(),
        3 => TapRule::three(),
        _ => TapRule::one(),
    };
    let shading = match wanted.lobe {
        SurfaceLobe::Mirror => Shading::Mirror,
        SurfaceLobe::Fitted => Shading::Fitted(LobeFit::of(wanted.taps)),
    };
    let (probe, ratio, width) = ([0.1, -0.2, 0.05], Ratio::Area, Width::EMITTED);
    let lookup = Corrected { proxy, probe, shading, rule, ratio, width };
    let points = pixels();
    let time = seconds(&mut || {
        for seen in &points {
            black_box(lookup.taps(black_box(seen)));
        }
    });
    time / points.len() as f64
}

/// Places about the origin with any normal, a view above it and a width.
fn pixels() -> Vec<Seen> {
    let [places, normals, views] =
        [7, 8, 9].map(|seed| Sobol::new([seed, seed + 10, seed + 20]).padded(seed + 30));
    let about = |points: &Sobol, i: u32| -> Vec3 { [0, 1, 2].map(|d| points.coordinate(i, d) - 0.5) };
    let pixel = |i: u32| {
        let normal = normalise(about(&normals, i));
        let view = normalise(about(&views, i));
        let above = if dot(normal, view) < 0.0 { -1.0 } else { 1.0 };
        let alpha = 0.01 + 0.99 * places.coordinate(i.reverse_bits() >> 8, 0);
        Seen { place: about(&places, i), normal, view: scaled(view, above), alpha }
    };
    (0..PIXELS).map(pixel).collect()
}
