//! The roughness that stands for a widened lobe against facets drawn one by one by a textbook, its limits,
//! the energy of lights, and how far the distribution of averaged normals matters.
#![allow(clippy::disallowed_methods)]

use lobefit_math::recurrence::Recurrence;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{AVERAGED_WIDTH, COATED_WIDTH, LIT_WIDTH, Quantity, Variant, Widened};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

type Vector = [f64; 3];
type Light = Option<(Vector, f64)>;

/// Lights of a lobe.
const LIGHTS: usize = 1 << 18;

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

/// The density of a bare lobe times the cosine, but for a factor.
fn lobe(alpha: f64, view: Vector, light: Vector) -> f64 {
    let sum: Vector = std::array::from_fn(|i| view[i] + light[i]);
    let z = sum[2] / dot(sum, sum).sqrt();
    let across = (1.0 - z) * (1.0 + z) + alpha * alpha * z * z;
    if light[2] > 0.0 { seen(alpha, view, light) / (across * across) } else { 0.0 }
}

/// Rings from tan(theta/2) = 1e-6 to 1e4, their width in its logarithm, and where a tangent lies among them.
const RINGS: usize = 700;
const STEP: f64 = 0.033;

fn place(tangent: f64) -> f64 {
    (tangent / 1e-6).ln() / STEP
}

/// Integrals of a bare lobe over rings about the mirror direction, even in ln(tan(theta/2)): the middle of
/// the ring in rings,
/// its energy, and its energy with `wider` of theta in place of the sine.
fn rings(alpha: f64, mu: f64, wider: &dyn Fn(f64) -> f64) -> Vec<[f64; 3]> {
    const TURNS: usize = 100;
    let sine = (1.0 - mu * mu).sqrt();
    let (view, axes) = ([sine, 0.0, mu], [[mu, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, mu]]);
    let one = |i: usize| {
        let theta = 2.0 * ((i as f64 + 0.5) * STEP + 1e-6_f64.ln()).exp().atan();
        // Half of a turn: the other is its mirror image. A grazing lobe is narrow across the plane of
        // incidence.
        let at = |k: usize| {
            let (y, x) = (std::f64::consts::PI * (k as f64 + 0.5) / TURNS as f64).sin_cos();
            let square = x * x + mu * y * y;
            let [x, y] = [x, mu.sqrt() * y].map(|part| theta.sin() * part / square.sqrt());
            lobe(alpha, view, back(axes, [x, y, theta.cos()])) * mu.sqrt() / square
        };
        let mean = (0..TURNS).map(at).sum::<f64>() / TURNS as f64;
        let width = mean * std::f64::consts::TAU * STEP * theta.sin();
        [i as f64 + 0.5, width * theta.sin(), width * wider(theta)]
    };
    (0..RINGS).map(one).collect()
}

/// The roughness whose lobe holds half of its energy within the cone of a tangent, by halving.
fn roughness(mu: f64, tangent: f64) -> f64 {
    let (mut low, mut high) = (0.01, 1.0);
    for _ in 0..12 {
        let r: f64 = 0.5 * (low + high);
        let rings = rings(r * r, mu, &f64::sin);
        let whole: f64 = rings.iter().map(|ring| ring[1]).sum();
        let inside: f64 =
            rings.iter().map(|ring| ring[1] * (place(tangent) - ring[0] + 0.5).clamp(0.0, 1.0)).sum();
        if inside > 0.5 * whole { low = r } else { high = r }
    }
    0.5 * (low + high)
}

/// The textbook's lights are off by 0.003 of the roughness: both lie within the promise of 0.01.
fn agrees(of: &Widened, x: &[f64], tangent: f64) {
    let (found, own) = (at(of, x, 5e-3), roughness(x[1], tangent));
    println!("{} {x:?}: {found:?}, textbook {own}", of.name());
    assert!((found[0] - own).abs() < 3e-3 + found[found.len() - 1], "{x:?}: {found:?}, textbook {own}");
    let off = (0.5 * found[1]).tan() / tangent - 1.0;
    // The radius goes with the square of the roughness.
    assert!(off.abs() < 0.01 + 2.0 * found[found.len() - 1] / own, "{x:?}: the radius is off by {off}");
}

#[test]
fn half_of_the_energy_of_facets_lies_within_the_radius() {
    for [r, mu, length] in [[0.3, 0.4, 0.9], [0.6, 0.15, 0.8], [0.05, 0.7, 0.999]] {
        let normal = normals(length, false);
        let tangent = middle(mu, |view, random| averaged(r * r, view, normal(random), random));
        agrees(&AVERAGED_WIDTH, &[r * r, mu, length], tangent);
    }
    for [r, mu, radius] in [[0.06, 0.3, 0.02], [0.6, 0.1, 0.45]] {
        let lit = |view, random: &mut Pcg64| {
            let (light, energy) = mirrored(r * r, view, random)?;
            let cosine = 1.0 - random.random::<f64>() * (1.0 - radius.cos());
            Some((back(frame(light), around(cosine, random)), energy))
        };
        agrees(&LIT_WIDTH, &[r * r, mu, radius], middle(mu, lit));
    }
    for [r, mu, coat, ior] in [[0.4, 0.6, 0.4, 1.5], [0.07, 0.8, 0.1, 1.3]] {
        let coated = |view, random: &mut Pcg64| {
            let (down, entered) = through(coat * coat, view, ior, random)?;
            let (up, kept) = mirrored(r * r, down.map(|x| -x), random)?;
            let (out, left) = through(coat * coat, [-up[0], -up[1], up[2]], 1.0 / ior, random)?;
            Some(([out[0], out[1], -out[2]], entered * kept * left))
        };
        agrees(&COATED_WIDTH, &[r * r, mu, coat, ior], middle(mu, coated));
    }
}

/// The energy of a lobe over that at the nearest point of a disk: a light whose nearest point lies at theta
/// has its middle at
/// theta + radius, and all within the radius have the peak.
fn normalisation([alpha, mu, radius]: [f64; 3]) -> f64 {
    let wider = |theta: f64| if theta + radius < std::f64::consts::PI { (theta + radius).sin() } else { 0.0 };
    let rings = rings(alpha, mu, &wider);
    let axis = [-(1.0 - mu * mu).sqrt(), 0.0, mu];
    let peak = std::f64::consts::TAU * (1.0 - radius.cos()) * lobe(alpha, [-axis[0], 0.0, mu], axis);
    let [own, moved] = [1, 2].map(|k| rings.iter().map(|ring| ring[k]).sum::<f64>());
    own / (moved + peak)
}

/// The energy of a lobe at the nearest point of a disk, by rings about the mirror direction, at single places
/// and of many.
#[test]
fn the_normalisation_is_that_of_the_energy() {
    let mut lacking = Vec::new();
    for [alpha, mu, radius] in [
        [0.3, 1.0, 0.3],
        [0.6, 0.6, 0.5_f64],
        [0.003, 0.5, 0.4],
        [0.003, 1.0, 0.01],
        [0.01, 0.2, 0.1],
        [0.03, 0.9, 0.5],
        [0.03, 0.05, 0.2],
    ] {
        let (x, expected) = ([alpha, mu, radius], normalisation([alpha, mu, radius]));
        let found = at(&LIT_WIDTH, &x, 5e-3);
        let columns = ["alpha", "mu", "light_radius"].into_iter().zip(x.map(|x| vec![x]));
        let quick = LIT_WIDTH
            .truth(&Variant::default(), &Points::new(columns), &["normalisation"], 1.5e-2)
            .expect("it");
        let offs = [found[2], quick.columns[0][0]].map(|value| (value / expected - 1.0).abs());
        println!("{x:?}: {found:?}, of rings {expected}, off by {offs:?}");
        if offs[0] > 1e-3 + found[3] || offs[1] > 1.5e-2 || found[3] > 5e-3 {
            lacking.push((x, found, expected, offs));
        }
    }
    assert!(lacking.is_empty(), "{lacking:#?}");
}

/// Means of single sequences scatter as the stated error says: shifts that go together would agree too well.
/// The error is three standard errors of eight means: beyond it lies a mean at 2 % of the places (t with
/// seven degrees of freedom), and of 60 places at more than four with a probability of 0.8 % (binomial).
#[test]
fn the_stated_error_holds_at_nearly_all_places() {
    let mut beyond = 0;
    let places = Recurrence::new(3);
    for i in 0..60 {
        let [a, b, c] = [0, 1, 2].map(|k| places.coordinate(i, k));
        let x = [0.01 + 0.8 * a * a, 0.05 + 0.95 * b, 0.02 + 0.4 * c];
        let (found, own) = (at(&LIT_WIDTH, &x, 2e-2), normalisation(x));
        beyond += usize::from((found[2] / own - 1.0).abs() > found[3] + 2e-4);
    }
    println!("{beyond} of 60 beyond");
    assert!(beyond <= 4, "{beyond} of 60 places are off by more than three standard errors");
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
    let page = include_str!("../../../../docs/scene.md");
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
