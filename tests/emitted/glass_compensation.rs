//! The effects glass-outside and glass-inside: the emitted factor in WGSL times R + T of a textbook, and
//! the formulas in docs/scene.md.
#![allow(clippy::disallowed_methods)]

use crate::baked_support::assert_promised;
use crate::dielectric::energies;
use crate::emit_support::example::{baked, certified};
use crate::width::PANES;

use std::sync::LazyLock;

use lobefit::approximate::Fit;
use lobefit::bake::Baked;
use lobefit::data::Smith;
use lobefit::effects::Effect;
use lobefit::effects::glass::compensation::{INSIDE, OUTSIDE};
use lobefit::effects::value::ValueFits;
use lobefit::emit::manifest::Manifest;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points::Points;

fn both() -> impl Iterator<Item = &'static ValueFits<'static>> {
    [&OUTSIDE, &INSIDE].into_iter().flat_map(|effect| effect.profile().fits)
}

/// Glass of one index of refraction.
static PANE: LazyLock<Baked> = LazyLock::new(|| {
    baked(
        r#"{"schema_version": 1, "name": "pane", "pick": "all", "reports": false, "languages": ["wgsl"], "materials": [
           {"name": "pane", "kind": "glass", "ior": 1.5, "roughness": [0.02, 1], "wants": {"fit": {}}}]}"#,
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

/// R + T by a lattice of visible normals.
fn sent_on(side: Side, [roughness, mu, ior]: [f64; 3], points: usize) -> f64 {
    let ratio = if side == Side::Outside { ior } else { 1.0 / ior };
    energies(Smith::Correlated, [roughness * roughness, mu, ratio], points).iter().sum()
}

#[test]
fn the_emitted_factor_gives_back_what_the_textbook_loses() {
    for fits in both() {
        let side = fits.side.expect("a side");
        let truths: Vec<f64> = places().into_iter().map(|place| sent_on(side, place, 1 << 12)).collect();
        certified(&PANES, fits.own.all, (&places(), &truths), 4e-3, 0.5);
    }
}

#[test]
fn of_one_index_it_takes_fewer_operations() {
    let at: Vec<[f64; 3]> = places().into_iter().filter(|[.., ior]| *ior == 1.5).collect();
    for fits in both() {
        let side = fits.side.expect("a side");
        let truths: Vec<f64> = at.iter().map(|place| sent_on(side, *place, 1 << 12)).collect();
        certified(&PANE, fits.own.flat, (&at, &truths), 4e-3, 0.5);
    }
    let rows = |baked: &Baked, side: Side| {
        let own = baked.fits.iter().filter(|fit| fit.approximation.side == Some(side));
        own.map(|fit| (fit.approximation.cost.ops, fit.approximation.certificate.max_abs)).collect::<Vec<_>>()
    };
    for side in Side::ALL {
        let best = |rows: Vec<(u32, f64)>| rows.into_iter().map(|(_, error)| error).fold(1.0, f64::min);
        let [of_one, of_all] = [&PANE, &PANES].map(|baked| best(rows(baked, side)));
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
    for side in Side::ALL {
        for place in places() {
            let [coarse, fine] = [1 << 11, 1 << 12].map(|points| sent_on(side, place, points));
            assert!((coarse - fine).abs() < 2e-3, "{side:?} {place:?}: {coarse} {fine}");
            let smooth = sent_on(side, [1e-3, place[1], place[2]], 256);
            assert!((smooth - 1.0).abs() < 1e-3, "{side:?} {place:?}: {smooth}");
        }
    }
}

/// The table of docs/scene.md, and what a shader makes of the factor.
#[test]
fn the_page_has_every_formula() {
    let page = include_str!("../../docs/scene.md");
    let of_scenes = || PANES.fits.iter().chain(&PANE.fits);
    let own: Vec<&Fit> = of_scenes().filter(|fit| fit.approximation.quantity == "ggx-glass").collect();
    let row = |fit: &&Fit| {
        let a = &fit.approximation;
        let [most, usual] = [a.certificate.max_abs, a.certificate.rms].map(|x| lobefit_shade::round_up(x, 4));
        format!("| `{}` | {} | {most} | {usual} |", a.name, a.cost.ops)
    };
    let lacking: Vec<String> = own.iter().map(row).filter(|row| !page.contains(row)).collect();
    assert!(lacking.is_empty(), "docs/scene.md has no row\n{}", lacking.join("\n"));
    assert_eq!(own.len(), both().map(|fits| fits.own.entries().count()).sum::<usize>());
    let count = both().map(|fits| fits.own.all.len()).sum::<usize>();
    assert_promised("tests/emitted/glass_compensation.rs", own);
    let manifest = Manifest::read(&PANES.files["manifest.json"]).expect("a manifest");
    let calls = manifest
        .entries
        .calls
        .iter()
        .filter(|call| ["glass-outside", "glass-inside"].contains(&call.effect.as_str()));
    let then: Vec<&str> = calls.filter_map(|call| call.then.as_deref()).collect();
    assert_eq!(then, vec!["f*N"; count]);
}
