//! The effects glass-outside and glass-inside, of either distribution: the emitted factor in WGSL times R + T
//! of a textbook, and the formulas in docs/scene.md.
#![allow(clippy::disallowed_methods)]

use crate::baked_support::assert_promised;
use crate::dielectric::energies;
use crate::emit_support::example::{baked, certified};
use crate::furnace_support::textbook::fresnel;
use crate::width::PANES;

use std::sync::LazyLock;

use lobefit::approximate::Fit;
use lobefit::bake::Baked;
use lobefit::data::{Ndf, Smith};
use lobefit::effects::Effect;
use lobefit::effects::glass::compensation::{BECKMANN_INSIDE, BECKMANN_OUTSIDE, INSIDE, OUTSIDE};
use lobefit::effects::value::ValueFits;
use lobefit::emit::manifest::Manifest;
use lobefit_math::ops::erfc;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points::Points;

/// What is fitted, by distribution and side.
fn all() -> impl Iterator<Item = (Ndf, Side, &'static ValueFits<'static>)> {
    let of = [
        (Ndf::Ggx, &OUTSIDE),
        (Ndf::Ggx, &INSIDE),
        (Ndf::Beckmann, &BECKMANN_OUTSIDE),
        (Ndf::Beckmann, &BECKMANN_INSIDE),
    ];
    let fits =
        of.into_iter().flat_map(|(ndf, effect)| effect.profile().fits.iter().map(move |fits| (ndf, fits)));
    fits.map(|(ndf, fits)| (ndf, fits.side.expect("a side"), fits))
}

fn quantity(ndf: Ndf) -> &'static str {
    if ndf == Ndf::Ggx { "ggx-glass" } else { "beckmann-glass" }
}

/// Glass of one index of refraction.
static PANE: LazyLock<Baked> = LazyLock::new(|| {
    baked(
        r#"{"schema_version": 1, "name": "pane", "pick": "all", "reports": false, "languages": ["wgsl"], "materials": [
           {"name": "pane", "kind": "glass", "ior": 1.5, "roughness": [0.02, 1], "wants": {"fit": {}}},
           {"name": "other", "kind": "glass", "ior": 1.5, "roughness": [0.02, 1], "distribution": "beckmann", "wants": {"fit": {}}}]}"#,
    )
});

/// Places at some indices of refraction of what is inside.
fn places() -> Vec<[f64; 3]> {
    let mut places = Vec::new();
    for roughness in [0.03, 0.1, 0.15, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0] {
        for mu in [0.01, 0.03, 0.08, 0.2, 0.4, 0.6, 0.8, 1.0] {
            places.extend([1.1, 1.2, 1.33, 1.5, 1.75, 2.0].map(|ior| [roughness, mu, ior]));
        }
    }
    places
}

/// R + T by a lattice of normals, of GGX of those that the view sees.
fn sent_on(ndf: Ndf, side: Side, [roughness, mu, ior]: [f64; 3], points: usize) -> f64 {
    let ratio = if side == Side::Outside { ior } else { 1.0 / ior };
    let at = [roughness * roughness, mu, ratio];
    match ndf {
        Ndf::Ggx => energies(Smith::Correlated, at, points).iter().sum(),
        Ndf::Beckmann => of_beckmann(at, 8 * points),
    }
}

/// The mean over facets of what they send on, F and 1 - F where it leaves on the right side, times
/// G2 (v, m) / ((v, n) (m, n)): facets lie by D (m, n), where tan^2 of their tilt is -alpha^2 ln u
/// (Walter et al. 2007, equations 28 and 29), and Lambda is that of Heitz 2014, equation 86.
fn of_beckmann([alpha, mu, ratio]: [f64; 3], points: usize) -> f64 {
    let sine = (1.0 - mu * mu).sqrt();
    let lambda = |z: f64| {
        let a = z / (alpha * (1.0 - z * z).max(1e-300).sqrt());
        0.5 * ((-a * a).exp() / (a * std::f64::consts::PI.sqrt()) - erfc(a))
    };
    let golden = 0.618_033_988_749_894_9;
    let of_view = lambda(mu);
    let mut sum = 0.0;
    for i in 0..points {
        let (u, turn) = ((i as f64 + 0.5) / points as f64, std::f64::consts::TAU * golden * i as f64);
        let upright = 1.0 / (1.0 - alpha * alpha * u.ln()).sqrt();
        let cosine = sine * (1.0 - upright * upright).sqrt() * turn.cos() + mu * upright;
        if cosine <= 0.0 {
            continue;
        }
        let mirrored = 2.0 * cosine * upright - mu;
        let square = 1.0 - (1.0 - cosine * cosine) / (ratio * ratio);
        let refracted = (mu - cosine * upright) / ratio + square.max(0.0).sqrt() * upright;
        let back = fresnel(cosine, ratio);
        for (part, height) in [(back, mirrored), (1.0 - back, refracted)] {
            if height > 0.0 && part > 0.0 {
                sum += part / (1.0 + of_view + lambda(height)) * cosine / (mu * upright);
            }
        }
    }
    sum / points as f64
}

#[test]
fn the_emitted_factor_gives_back_what_the_textbook_loses() {
    for (ndf, side, fits) in all() {
        let truths: Vec<f64> = places().into_iter().map(|place| sent_on(ndf, side, place, 1 << 12)).collect();
        certified(&PANES, fits.own.all, (&places(), &truths), 4e-3, 0.5);
    }
}

#[test]
fn of_one_index_it_takes_fewer_operations() {
    let at: Vec<[f64; 3]> = places().into_iter().filter(|[.., ior]| *ior == 1.5).collect();
    for (ndf, side, fits) in all() {
        let truths: Vec<f64> = at.iter().map(|place| sent_on(ndf, side, *place, 1 << 12)).collect();
        certified(&PANE, fits.own.flat, (&at, &truths), 4e-3, 0.5);
    }
    let rows = |baked: &Baked, ndf: Ndf, side: Side| {
        let own = baked.fits.iter().filter(|fit| {
            (fit.approximation.quantity.as_str(), fit.approximation.side) == (quantity(ndf), Some(side))
        });
        own.map(|fit| (fit.approximation.cost.ops, fit.approximation.certificate.max_abs)).collect::<Vec<_>>()
    };
    for (ndf, side, _) in all() {
        let best = |rows: Vec<(u32, f64)>| rows.into_iter().map(|(_, error)| error).fold(1.0, f64::min);
        let [of_one, of_all] = [&PANE, &PANES].map(|baked| best(rows(baked, ndf, side)));
        assert!(of_one < 0.5 * of_all, "{side:?}: {of_one} of one index, {of_all} of a range");
    }
}

/// Below the domain: towards a mirror and towards grazing.
#[test]
fn of_one_index_none_is_negative_beyond_its_domain() {
    let mut points = Points::default();
    for i in 0..=100 {
        for j in 0..=100 {
            let (roughness, mu) = (f64::from(i) / 100.0, f64::from(j) * 1e-4 + 1e-5);
            let alpha = f64::from((roughness as f32) * (roughness as f32));
            let [roughness, mu] = [roughness, mu].map(|x| f64::from(x as f32));
            points.push([("roughness", roughness), ("alpha", alpha), ("mu", mu), ("ior", 1.5)]);
        }
    }
    for fit in PANE.fits.iter().filter(|fit| fit.emitted) {
        let values = fit.values_for(&points, 1.0).expect("finite values");
        let least = values.into_iter().fold(f32::INFINITY, f32::min);
        assert!(least >= 0.0, "{}: {least}", fit.hypothesis.name());
    }
}

#[test]
fn the_sum_over_facets_settles_and_ends_in_no_loss() {
    for (ndf, side, _) in all() {
        for place in places() {
            let [coarse, fine] = [1 << 11, 1 << 12].map(|points| sent_on(ndf, side, place, points));
            assert!((coarse - fine).abs() < 2e-3, "{ndf:?} {side:?} {place:?}: {coarse} {fine}");
            let smooth = sent_on(ndf, side, [1e-3, place[1], place[2]], 256);
            assert!((smooth - 1.0).abs() < 1e-3, "{ndf:?} {side:?} {place:?}: {smooth}");
        }
    }
}

/// The table of docs/scene.md, and what a shader makes of the factor.
#[test]
fn the_page_has_every_formula() {
    let page = include_str!("../../docs/scene.md");
    let of_scenes = || PANES.fits.iter().chain(&PANE.fits);
    let is_glass =
        |fit: &&Fit| [Ndf::Ggx, Ndf::Beckmann].map(quantity).contains(&fit.approximation.quantity.as_str());
    let own: Vec<&Fit> = of_scenes().filter(is_glass).collect();
    let row = |fit: &&Fit| {
        let a = &fit.approximation;
        let [most, usual] = [a.certificate.max_abs, a.certificate.rms].map(|x| lobefit_shade::round_up(x, 4));
        format!("| `{}` | {} | {most} | {usual} |", a.name, a.cost.ops)
    };
    let lacking: Vec<String> = own.iter().map(row).filter(|row| !page.contains(row)).collect();
    assert!(lacking.is_empty(), "docs/scene.md has no row\n{}", lacking.join("\n"));
    assert_eq!(own.len(), all().map(|(.., fits)| fits.own.entries().count()).sum::<usize>());
    let count = all().map(|(.., fits)| fits.own.all.len()).sum::<usize>();
    assert_promised("tests/emitted/glass_compensation.rs", own);
    let manifest = Manifest::read(&PANES.files["manifest.json"]).expect("a manifest");
    let calls = manifest
        .entries
        .calls
        .iter()
        .filter(|call| call.effect.ends_with("glass-outside") || call.effect.ends_with("glass-inside"));
    let then: Vec<&str> = calls.filter_map(|call| call.then.as_deref()).collect();
    assert_eq!(then, vec!["f*N"; count]);
}
