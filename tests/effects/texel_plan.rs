//! The layouts for the trilinear lookup: plans of points, texels from their values, and what the
//! lookup returns.

use lobefit::data::{AlphaMap, Coordinate, Smith, Surface};
use lobefit::effects::anisotropy::aniso_axes;
use lobefit::effects::glass::glass_axes;
use lobefit::effects::table::{Node, TexelPlan, check};
use lobefit_shade::Precision;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::reflection::{Effort, albedo};

/// A trilinear lookup in f64, clamped to the edge.
fn lookup(axes: &[(usize, Coordinate); 3], texels: &[f64], values: [f64; 3], surface: Surface<f32>) -> f64 {
    let cells = [0, 1, 2].map(|k| {
        let (n, coordinate) = (axes[k].0, &axes[k].1);
        let x = f64::from(coordinate.at(values[k] as f32, surface, Precision::F32)) * n as f64 - 0.5;
        let x = x.clamp(0.0, (n - 1) as f64);
        let base = (x.floor() as usize).min(n - 2);
        (base, x - base as f64)
    });
    let mut sum = 0.0;
    for corner in 0..8 {
        let (mut weight, mut at) = (1.0, [0; 3]);
        for k in 0..3 {
            let far = corner >> k & 1;
            at[k] = cells[k].0 + far;
            weight *= if far == 1 { cells[k].1 } else { 1.0 - cells[k].1 };
        }
        sum += weight * texels[(at[2] * axes[1].0 + at[1]) * axes[0].0 + at[0]];
    }
    sum
}

/// The isotropic lobe behind the axes of the anisotropic one: optimised texels halve the error of
/// sampled ones, and the error found on the lattice is the one found off it.
#[test]
fn optimised_texels_halve_the_error() {
    let axes = aniso_axes([32, 24, 2], [0.15, 1.0], [0.0, 1.0]);
    let plan = TexelPlan::new(axes.clone(), AlphaMap::RoughnessSquared, [2, 2, 1], 20, 0.001);
    let axes = axes.map(|axis| (axis.size, axis.coordinate().expect("it parses")));
    let effort = &Effort::ladder()[1].outer;
    let loss = |alpha: f64, mu: f64| 1.0 - albedo(Smith::Correlated, alpha, mu, effort);
    let points = plan.points();
    assert!(points.iter().all(|p| (0.00025..=1.0).contains(&p.mu)));
    let values: Vec<f64> = points.iter().map(|p| loss(p.alpha, p.mu)).collect();
    let worst = |texels: &[f64]| {
        let mut worst = 0.0_f64;
        for i in 0..60 {
            let roughness = 0.15 + 0.85 * (f64::from(i) + 0.37) / 60.0;
            let alpha = roughness * roughness;
            for j in 0..90 {
                let u = (f64::from(j) + 0.41) / 90.0;
                let mu = 0.001 + 0.999 * u * u * u;
                let found = lookup(&axes, texels, [mu, roughness, 0.4], Surface::<f32>::rough(alpha as f32));
                worst = worst.max((found - loss(alpha, mu)).abs());
            }
        }
        worst
    };
    let ((sampled, before), (optimised, after)) = (plan.texels(&values, 0), plan.texels(&values, 15));
    let (sampled, optimised) = (worst(&sampled), worst(&optimised));
    println!("lattice {before:.2e} -> {after:.2e}, off it {sampled:.2e} -> {optimised:.2e}");
    assert!(after < 0.6 * before && optimised < 0.65 * sampled && optimised < 1.3 * after);
    assert!(optimised < 2e-3);
}

/// The check of the targets finds the worst of them within a third, whichever part of the lattice
/// it lies in, and the same at every call.
#[test]
fn the_check_finds_what_interpolation_leaves() {
    let axes = aniso_axes([24, 24, 8], [0.03, 1.0], [0.0, 1.0]);
    let effort = &Effort::ladder()[1].outer;
    let loss = |node: &Node| 1.0 - albedo(Smith::Correlated, node.alpha, node.mu, effort);
    let direct = |nodes: &[Node]| Ok((nodes.iter().map(|node| [loss(node)]).collect(), nodes.len() as u64));
    for (nodes, most) in [(6, 1e-1), (14, 1e-3)] {
        let plan = TexelPlan::new(axes.clone(), AlphaMap::RoughnessSquared, [2, 2, 1], nodes, 0.001);
        let losses: Vec<f64> = plan.points().iter().map(loss).collect();
        let mut wanted = plan.targets(&losses);
        let [columns, rows, slices] = plan.samples();
        let mut worst = 0.0_f64;
        for i in 0..columns * rows * slices {
            let node = plan.sample([i % columns, i / columns % rows, i / columns / rows]);
            if wanted.weights[i] > 0.0 {
                worst = worst.max((wanted.targets[i] - loss(&node)).abs());
            }
        }
        let checked = check("test", &plan, 8192, [&wanted], direct).expect("a check");
        assert!(checked.worst <= worst && checked.worst > 0.67 * worst, "{checked:?} of {worst:e}");
        assert!(worst > 1e-7 && worst < most && checked.at.is_some(), "{nodes} nodes: {worst:e}");
        assert_eq!(checked.evaluations, checked.samples as u64);
        assert_eq!(checked, check("test", &plan, 8192, [&wanted], direct).expect("a check"));
        wanted.targets.fill(f64::NAN);
        let refused = check("test", &plan, 8192, [&wanted], direct);
        assert!(matches!(refused, Err(IntegrateError::NotFinite { quantity: "test", .. })), "{refused:?}");
    }
}

/// Points follow the axes: every ior of the range, mu from grazing to normal.
#[test]
fn points_of_a_glass_table_span_its_ranges() {
    let axes = glass_axes([16, 8, 8], [0.02, 1.0], [1.0, 2.0]);
    let plan = TexelPlan::new(axes, AlphaMap::Roughness, [2, 1, 3], 6, 0.001);
    let points = plan.points();
    assert_eq!(points.len(), 31 * 22 * 6);
    let span = |f: fn(&lobefit::effects::table::Node) -> f64| {
        points.iter().map(f).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)])
    };
    assert_eq!(span(|p| p.slice), [1.0, 2.0]);
    assert_eq!(span(|p| p.alpha), [0.02, 1.0]);
    assert_eq!(span(|p| p.mu), [0.00025, 1.0]);
}

/// A narrow range far from the matched index has slices linear in it.
#[test]
fn slices_crowd_only_towards_a_matched_index() {
    let slices = |ior| glass_axes([8; 3], [0.1, 1.0], ior)[2].warp;
    assert_ne!(slices([1.0, 2.0]), slices([1.3, 1.7]));
}
