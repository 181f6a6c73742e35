//! The search over forms: planted frontiers, the bars of the furnace normalisation, determinism, bad input.
#![allow(clippy::disallowed_methods)]

mod fit_support;

use fit_support::albedo;
use lobefit::fit::search::{Anchor, Found, Progress, SearchAxis, SearchSamples, Space, search};

fn axis(arguments: &[(&str, u32)], degree: u8) -> SearchAxis {
    SearchAxis { arguments: arguments.iter().map(|(n, p)| (n.to_string(), *p)).collect(), degree }
}

fn quiet(_: &Progress) {}

/// Furnace samples on a grid denser at the ends.
fn furnace(n: usize) -> SearchSamples {
    let t = |i: usize| 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / (n - 1) as f64).cos();
    let (mut roughness, mut mu) = (Vec::new(), Vec::new());
    for i in 0..n {
        let r = 0.02 + 0.98 * t(i);
        for j in 0..n {
            roughness.push(r);
            mu.push(0.01 + 0.99 * t(j));
        }
        // the layer mu ~ alpha
        for k in [0.3, 0.6, 1.1, 2.0, 4.0] {
            roughness.push(r);
            mu.push((k * r * r).clamp(0.01, 1.0));
        }
    }
    let scale: Vec<f64> = roughness.iter().zip(&mu).map(|(r, m)| albedo(r * r, *m)).collect();
    SearchSamples { target: vec![1.0; scale.len()], scale, axes: vec![roughness, mu] }
}

fn normalisation(max_ops: u32) -> Space {
    let axes = vec![axis(&[("roughness", 1), ("alpha", 2)], 8), axis(&[("mu", 1)], 4)];
    let anchor = Some(Anchor { value: 1.0, zeros: vec![0] });
    Space { anchor, ..Space::new("norm_", axes, max_ops) }
}

fn show(found: &[Found]) {
    for f in found {
        println!(
            "{} ops: max {:.5} rms {:.5} bound {:.5}\n{}",
            f.ops,
            f.max,
            f.rms,
            f.bound,
            f.hypothesis.source()
        );
    }
}

#[test]
fn the_cheap_bars_of_the_furnace_are_met() {
    let found = search(&Space { width: 12, sweeps: 2, ..normalisation(6) }, &furnace(20), &quiet).unwrap();
    show(&found);
    let best = |ops: u32| found.iter().filter(|f| f.ops <= ops).map(|f| f.max).fold(f64::INFINITY, f64::min);
    assert!(best(3) < 0.098 && best(6) < 0.0625, "{} {}", best(3), best(6));
}
