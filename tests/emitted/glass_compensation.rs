//! The effects glass-outside and glass-inside: the emitted factor in WGSL times R + T of a textbook, and
//! the formulas in docs/scene.md.
#![allow(clippy::disallowed_methods)]

use crate::baked_support::assert_promised;
use crate::dielectric::energies;
use crate::emit_support::example::certified;
use crate::width::PANES;

use lobefit::approximate::Fit;
use lobefit::data::Smith;
use lobefit::effects::Effect;
use lobefit::effects::glass::compensation::{INSIDE, OUTSIDE};
use lobefit::effects::value::ValueFits;
use lobefit::emit::manifest::Manifest;
use lobefit_truth::integrate::glass::Side;

fn both() -> impl Iterator<Item = &'static ValueFits<'static>> {
    [&OUTSIDE, &INSIDE].into_iter().flat_map(|effect| effect.profile().fits)
}

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
    let own: Vec<&Fit> = PANES.fits.iter().filter(|fit| fit.approximation.quantity == "ggx-glass").collect();
    let row = |fit: &&Fit| {
        let a = &fit.approximation;
        let [most, usual] = [a.certificate.max_abs, a.certificate.rms].map(|x| lobefit_shade::round_up(x, 4));
        format!("| `{}` | {} | {most} | {usual} |", a.name, a.cost.ops)
    };
    let lacking: Vec<String> = own.iter().map(row).filter(|row| !page.contains(row)).collect();
    assert!(lacking.is_empty(), "docs/scene.md has no row\n{}", lacking.join("\n"));
    assert_eq!(own.len(), both().map(|fits| fits.own.all.len()).sum::<usize>());
    let count = own.len();
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
