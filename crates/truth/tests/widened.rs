//! The roughness that stands for a widened lobe against facets drawn one by one by a textbook, its limits,
//! the energy of lights, and how far the distribution of averaged normals matters.
#![allow(clippy::disallowed_methods)]

use lobefit_truth::quantity::{AVERAGED_WIDTH, COATED_WIDTH, LIT_WIDTH, Quantity, Variant, Widened};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

type Vector = [f64; 3];
type Light = Option<(Vector, f64)>;

/// Lights of a lobe.
const LIGHTS: usize = 1 << 15;

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn at(of: &Widened, x: &[f64], tolerance: f64) -> Vec<f64> {
    of.at(&Variant::default(), x, tolerance).unwrap_or_else(|e| panic!("{e}"))
}

/// Coordinates about an axis, to those of its frame and back.
fn frame(axis: Vector) -> [Vector; 3] {
    let other = if axis[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let along = dot(axis, other);
    let a: Vector = std::array::from_fn(|i| other[i] - along * axis[i]);
    let a = a.map(|x| x / dot(a, a).sqrt());
    let b =
        [axis[1] * a[2] - axis[2] * a[1], axis[2] * a[0] - axis[0] * a[2], axis[0] * a[1] - axis[1] * a[0]];
    [a, b, axis]
}

fn back(frame: [Vector; 3], local: Vector) -> Vector {
    std::array::from_fn(|i| (0..3).map(|k| frame[k][i] * local[k]).sum())
}

/// A direction with this cosine to the third axis.
fn around(cosine: f64, random: &mut Pcg64) -> Vector {
    let (sine, turn) =
        ((1.0 - cosine * cosine).max(0.0).sqrt(), std::f64::consts::TAU * random.random::<f64>());
    [sine * turn.cos(), sine * turn.sin(), cosine]
}

fn lambda(alpha: f64, z: f64) -> f64 {
    0.5 * ((1.0 + alpha * alpha * (1.0 - z * z) / (z * z)).sqrt() - 1.0)
}

/// A facet of D cos, and what visible facets like it count (Walter et al. 2007, eq. 41).
fn facet(alpha: f64, view: Vector, random: &mut Pcg64) -> Light {
    let u: f64 = random.random();
    let normal = around(1.0 / (1.0 + alpha * alpha * u / (1.0 - u)).sqrt(), random);
    let cosine = dot(view, normal);
    (cosine > 0.0 && view[2] > 0.0).then(|| (normal, cosine / (view[2] * normal[2])))
}

fn seen(alpha: f64, view: Vector, light: Vector) -> f64 {
    1.0 / (1.0 + lambda(alpha, view[2]) + lambda(alpha, light[2].abs()))
}

fn mirrored(alpha: f64, view: Vector, random: &mut Pcg64) -> Light {
    let (normal, weight) = facet(alpha, view, random)?;
    let light: Vector = std::array::from_fn(|i| 2.0 * dot(view, normal) * normal[i] - view[i]);
    (light[2] > 0.0).then(|| (light, weight * seen(alpha, view, light)))
}

/// Through a facet, into or out of an index.
fn through(alpha: f64, view: Vector, ior: f64, random: &mut Pcg64) -> Light {
    let (normal, weight) = facet(alpha, view, random)?;
    let cosine = dot(view, normal);
    let square = 1.0 - (1.0 - cosine * cosine) / (ior * ior);
    if square <= 0.0 {
        return None;
    }
    let inside = square.sqrt();
    let light: Vector = std::array::from_fn(|i| (cosine / ior - inside) * normal[i] - view[i] / ior);
    let s = (cosine - ior * inside) / (cosine + ior * inside);
    let p = (ior * cosine - inside) / (ior * cosine + inside);
    (light[2] < 0.0).then(|| (light, weight * (1.0 - 0.5 * (s * s + p * p)) * seen(alpha, view, light)))
}

/// Normals of a mean length L: of von Mises and Fisher, k by halving; or of GGX slopes, whose width is found
/// so that their mean has it.
fn normals(length: f64, is_ggx: bool) -> impl Fn(&mut Pcg64) -> Vector {
    let mean = |width: f64| -> f64 {
        if !is_ggx {
            return 1.0 / (1.0 / width).tanh() - width;
        }
        (0..4000)
            .map(|i| (f64::from(i) + 0.5) / 4000.0)
            .map(|u| 1.0 / (1.0 + width * width * u / (1.0 - u)).sqrt())
            .sum::<f64>()
            / 4000.0
    };
    let (mut low, mut high) = (1e-6, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if mean(middle) > length { low = middle } else { high = middle }
    }
    move |random| {
        let u: f64 = random.random();
        let cosine = match is_ggx {
            true => 1.0 / (1.0 + low * low * u / (1.0 - u)).sqrt(),
            false => 1.0 + low * (u + (1.0 - u) * (-2.0 / low).exp()).ln(),
        };
        around(cosine, random)
    }
}

fn averaged(alpha: f64, view: Vector, normal: Vector, random: &mut Pcg64) -> Light {
    let frame = frame(normal);
    let (light, energy) = mirrored(alpha, frame.map(|axis| dot(axis, view)), random)?;
    Some((back(frame, light), energy))
}

/// tan(theta/2) of the cone of half of the energy about the mirror direction.
fn middle(mu: f64, light: impl Fn(Vector, &mut Pcg64) -> Light + Sync) -> f64 {
    let view = [(1.0 - mu * mu).sqrt(), 0.0, mu];
    let chunk = |seed: usize| {
        let mut random = Pcg64::seed_from_u64(seed as u64);
        let one = |(light, energy): (Vector, f64)| (dot(light, [-view[0], 0.0, view[2]]), energy);
        (0..LIGHTS / 16).filter_map(|_| light(view, &mut random).map(one)).collect::<Vec<_>>()
    };
    let mut all: Vec<(f64, f64)> = (0..16).into_par_iter().flat_map_iter(chunk).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut left = 0.5 * all.iter().map(|(_, energy)| energy).sum::<f64>();
    let found = all.iter().find(|(_, energy)| {
        left -= energy;
        left <= 0.0
    });
    let cosine = found.expect("a middle").0;
    ((1.0 - cosine) / (1.0 + cosine)).sqrt()
}

/// The roughness by halving.
fn roughness(mu: f64, tangent: f64) -> f64 {
    let (mut low, mut high) = (0.01, 1.0);
    for _ in 0..9 {
        let r: f64 = 0.5 * (low + high);
        if middle(mu, |view, random| mirrored(r * r, view, random)) < tangent { low = r } else { high = r }
    }
    0.5 * (low + high)
}

/// The textbook's samples are off by 0.01 of the roughness.
fn agrees(of: &Widened, x: &[f64], tangent: f64) {
    let (found, own) = (at(of, x, 5e-3), roughness(x[1], tangent));
    println!("{} {x:?}: {found:?}, textbook {own}", of.name());
    assert!((found[0] - own).abs() < 0.015 + found[found.len() - 1], "{x:?}: {found:?}, textbook {own}");
    let off = (0.5 * found[1]).tan() / tangent - 1.0;
    assert!(off.abs() < 0.04, "{x:?}: the radius is off by {off}");
}

#[test]
fn half_of_the_energy_of_facets_lies_within_the_radius() {
    for [r, mu, length] in [[0.4, 1.0, 0.98], [0.3, 0.4, 0.9], [0.6, 0.15, 0.8], [0.1, 0.7, 0.7]] {
        let normal = normals(length, false);
        let tangent = middle(mu, |view, random| averaged(r * r, view, normal(random), random));
        agrees(&AVERAGED_WIDTH, &[r * r, mu, length], tangent);
    }
    for [r, mu, radius] in [[0.4, 1.0, 0.3], [0.2, 0.3, 0.1], [0.6, 0.1, 0.45]] {
        let lit = |view, random: &mut Pcg64| {
            let (light, energy) = mirrored(r * r, view, random)?;
            let cosine = 1.0 - random.random::<f64>() * (1.0 - radius.cos());
            Some((back(frame(light), around(cosine, random)), energy))
        };
        agrees(&LIT_WIDTH, &[r * r, mu, radius], middle(mu, lit));
    }
    for [r, mu, coat, ior] in [[0.3, 1.0, 0.5, 1.6], [0.4, 0.6, 0.4, 1.5], [0.6, 0.6, 0.3, 1.3]] {
        let coated = |view, random: &mut Pcg64| {
            let (down, entered) = through(coat * coat, view, ior, random)?;
            let (up, kept) = mirrored(r * r, down.map(|x| -x), random)?;
            let (out, left) = through(coat * coat, [-up[0], -up[1], up[2]], 1.0 / ior, random)?;
            Some(([out[0], out[1], -out[2]], entered * kept * left))
        };
        agrees(&COATED_WIDTH, &[r * r, mu, coat, ior], middle(mu, coated));
    }
}

/// The energy of a lobe at the nearest point of a disk, by lights spread evenly over the sphere.
#[test]
fn the_normalisation_is_that_of_the_energy() {
    for [alpha, mu, radius] in [[0.3, 1.0, 0.3], [0.4, 0.3, 0.2], [0.6, 0.6, 0.5_f64]] {
        let (view, axis) = ([(1.0 - mu * mu).sqrt(), 0.0, mu], [-(1.0 - mu * mu).sqrt(), 0.0, mu]);
        let lobe = |light: Vector| {
            let sum: Vector = std::array::from_fn(|i| view[i] + light[i]);
            let z = sum[2] / dot(sum, sum).sqrt();
            let across = 1.0 - (1.0 - alpha * alpha) * z * z;
            if light[2] > 0.0 { seen(alpha, view, light) / (across * across) } else { 0.0 }
        };
        let nearest = |middle: Vector| {
            let angle = dot(middle, axis).acos();
            let cosine = (angle - radius).max(0.0).cos();
            let rest: Vector = std::array::from_fn(|i| middle[i] - angle.cos() * axis[i]);
            let part = (1.0 - cosine * cosine).sqrt() / dot(rest, rest).sqrt();
            std::array::from_fn(|i| cosine * axis[i] + part * rest[i])
        };
        let mut random = Pcg64::seed_from_u64(5);
        let (mut own, mut wider) = (0.0, 0.0);
        for _ in 0..1 << 18 {
            let light = around(2.0 * random.random::<f64>() - 1.0, &mut random);
            own += lobe(light);
            wider += lobe(nearest(light));
        }
        let found = at(&LIT_WIDTH, &[alpha, mu, radius], 5e-3);
        let off = found[2] * wider / own - 1.0;
        println!("{alpha} {mu} {radius}: {found:?}, off by {off}");
        assert!(off.abs() < 0.02, "{alpha} {mu} {radius}: {found:?}, off by {off}");
    }
}

#[test]
fn what_nothing_widens_keeps_its_roughness() {
    for (of, more) in [(&AVERAGED_WIDTH, 1.0), (&LIT_WIDTH, 0.0)] {
        for [r, mu] in [[0.1, 1.0], [0.5, 0.2], [0.9, 0.05]] {
            let found = at(of, &[r * r, mu, more], 5e-3);
            assert!((found[0] - r).abs() < 1e-3, "{r} {mu}: {found:?}");
        }
    }
    let found = at(&LIT_WIDTH, &[0.25, 0.5, 0.0], 5e-3);
    assert!((found[2] - 1.0).abs() < 1e-12, "{found:?}");
}

/// The figures of docs/scene.md: the same mean length of GGX slopes.
#[test]
fn the_distribution_of_normals_matters_as_the_page_says() {
    let page = include_str!("../../../docs/scene.md");
    let mut lacking = Vec::new();
    for [r, mu, length] in [[0.2, 1.0, 0.98], [0.2, 0.3, 0.9], [0.5, 0.3, 0.9]] {
        let normal = normals(length, true);
        let tangent = middle(mu, |view, random| averaged(r * r, view, normal(random), random));
        let (own, ggx) = (at(&AVERAGED_WIDTH, &[r * r, mu, length], 5e-3)[0], roughness(mu, tangent));
        let row = format!("| {r} | {mu} | {length} | {own:.2} | {ggx:.2} |");
        lacking.extend((!page.contains(&row)).then_some(row));
    }
    assert!(lacking.is_empty(), "docs/scene.md has no row {lacking:#?}");
}

#[test]
fn inputs_outside_the_domain_are_refused() {
    for (of, x, input) in [
        (&AVERAGED_WIDTH, vec![0.5, 0.5, 0.4], "mean_length"),
        (&LIT_WIDTH, vec![0.5, 0.001, 0.1], "mu"),
        (&COATED_WIDTH, vec![0.5, 0.5, f64::NAN, 1.5], "coat_roughness"),
    ] {
        let error = of.at(&Variant::default(), &x, 1e-2).expect_err("outside").to_string();
        assert!(error.contains(input), "{error}");
    }
    let error =
        LIT_WIDTH.at(&Variant::default(), &[0.5, 0.5, 0.1], 1e-9).expect_err("finer than any sequence");
    assert!(error.to_string().contains("tolerance 1e-9"), "{error}");
}
