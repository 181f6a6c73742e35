//! Lookups of tables of any number of axes.

use half::f16;
use lobefit::data::{
    AlphaMap, Axis, Channel, Decode, Registration, Smith, Surface, Table, TexelFormat, Warp,
};
use lobefit::effects::table::{Lookup, LookupError, Point};
use lobefit_shade::Precision;

fn axis(name: &str, size: usize, registration: Registration, min: f64, max: f64) -> Axis {
    Axis { name: name.into(), size, registration, warp: Warp::Linear, min, max }
}

/// A function that trilinear interpolation reproduces, held at the nodes of unequal axes.
fn plane(mu: f64, roughness: f64, ior: f64) -> f64 {
    0.125 + 0.25 * mu + 0.125 * roughness * ior - 0.0625 * mu * roughness * ior
}

fn table() -> Table {
    let axes = vec![
        axis("mu", 5, Registration::Endpoint, 0.0, 1.0),
        axis("roughness", 4, Registration::Centre, 0.0, 1.0),
        axis("ior", 3, Registration::Endpoint, 1.0, 2.0),
    ];
    let at = |i: usize| {
        let node = |axis: usize, i| axes[axis].node(i, Surface::<f64>::rough(0.0));
        plane(node(0, i % 5), node(1, i / 5 % 4), node(2, i / 20))
    };
    let channels = vec![Channel { name: "E".into(), texels: (0..60).map(at).collect() }];
    Table {
        name: "test".into(),
        quantity: "ggx-glass".into(),
        smith: Some(Smith::Separable),
        alpha_map: AlphaMap::Roughness,
        channels,
        axes,
        format: TexelFormat::F32,
    }
}

#[test]
fn what_is_linear_along_each_axis_comes_back() {
    let table = table();
    let lookup = Lookup::new(&table, Decode::Albedo).expect("three known axes");
    for i in 0..=10 {
        for j in 0..=10 {
            for k in 0..=10 {
                let [mu, roughness, ior] = [i as f32 / 10.0, j as f32 / 10.0, 1.0 + k as f32 / 10.0];
                let found = lookup.at(&Point { mu, roughness, ior, ..Point::default() }).e;
                // Centres end half a texel inside: clamped beyond.
                let inside = f64::from(roughness).clamp(0.125, 0.875);
                let expected = plane(f64::from(mu), inside, f64::from(ior));
                assert!(
                    (f64::from(found) - expected).abs() < 5e-7,
                    "{mu} {roughness} {ior}: {found} {expected}"
                );
            }
        }
    }
}

/// The texels of the first slice, and of its first row, are tables of their own.
#[test]
fn one_and_two_axes_are_cases_of_three() {
    let whole = table();
    for axes in [1, 2] {
        let mut part = table();
        part.axes.truncate(axes);
        let texels: usize = part.axes.iter().map(|axis| axis.size).product();
        part.channels[0].texels.truncate(texels);
        let [part, whole] = [&part, &whole].map(|t| Lookup::new(t, Decode::Albedo).expect("known axes"));
        for i in 0..=100 {
            let mu = i as f32 / 100.0;
            let roughness = if axes == 1 { 0.0 } else { 1.0 - mu };
            let point = Point { mu, roughness, ior: 1.0, ..Point::default() };
            assert_eq!(part.at(&point), whole.at(&point), "{point:?}");
        }
    }
}

#[test]
fn coarse_weights_are_off_by_at_most_half_a_step_of_each_axis() {
    let table = table();
    let exact = Lookup::new(&table, Decode::Albedo).expect("three known axes");
    let coarse = exact.clone().with_weight_bits(8);
    let steps = 0.25 / 4.0 + 0.125 * 2.0 / 4.0 + 0.125 * 0.5;
    let mut worst: f32 = 0.0;
    for i in 0..1000 {
        let part = |k: usize| ((i * k) % 1009) as f32 / 1008.0;
        let point = Point { mu: part(1), roughness: part(37), ior: 1.0 + part(211), ..Point::default() };
        worst = worst.max((exact.at(&point).e - coarse.at(&point).e).abs());
    }
    assert!(worst > 0.0 && worst < steps / 512.0 + 1e-6, "{worst}");
}

/// Coordinates in half precision by another arithmetic of it: every operation rounded, and with the product
/// fused into the sum.
#[test]
fn in_f16_every_operation_of_the_coordinates_is_rounded() {
    let table = table();
    let half = |x: f64| f16::from_f64(x).to_f64();
    let lookups = [Precision::F16, Precision::F16Fused]
        .map(|p| Lookup::new(&table, Decode::Albedo).expect("three known axes").with_precision(p));
    let mut differs = 0;
    for i in 0..1000 {
        let part = |k: usize| ((i * k) % 1009) as f32 / 1008.0;
        let point = Point { mu: part(1), roughness: part(37), ior: 1.0 + part(211), ..Point::default() };
        let [mu, roughness, ior] = [point.mu, point.roughness, point.ior].map(|x| half(f64::from(x)));
        // Ends are the centres of the outermost texels: u (n - 1) / n + 1 / (2 n), u from the first value on.
        let apart = |x: f64, scale: f64, offset: f64| half(half(x * half(scale)) + half(offset));
        let fused = |x: f64, scale: f64, offset: f64| half(x * half(scale) + half(offset));
        let of_mu = (mu, 0.8, 0.1);
        let of_ior = (ior, 2.0 / 3.0, 0.5 / 3.0 - 2.0 / 3.0);
        let expected = [&apart as &dyn Fn(f64, f64, f64) -> f64, &fused]
            .map(|f| [of_mu, of_ior].map(|(x, scale, offset)| f(x, scale, offset)));
        for (lookup, [u, w]) in lookups.iter().zip(expected) {
            let texels = |u: f64, n: f64| (u * n - 0.5).clamp(0.0, n - 1.0);
            let expected = [texels(u, 5.0), texels(roughness, 4.0), texels(w, 3.0)];
            assert_eq!(lookup.position(&point)[..3], expected, "{point:?}");
        }
        differs += usize::from(expected[0] != expected[1]);
    }
    assert!(differs > 0);
}

#[test]
fn other_tables_are_refused() {
    for axes in [0, 6] {
        let mut other = table();
        other.axes = vec![other.axes[0].clone(); axes];
        let refused = Lookup::new(&other, Decode::Albedo);
        assert!(matches!(refused, Err(LookupError::Axes { axes: found, .. }) if found == axes));
    }
    let refused = Lookup::new(&table(), Decode::LossBias).map(drop);
    assert!(matches!(refused, Err(LookupError::Channels { channels: 1, expected: 2, .. })));
    let mut unknown = table();
    unknown.axes[2].name = "rho".into();
    assert!(
        matches!(Lookup::new(&unknown, Decode::Albedo), Err(LookupError::Axis { axis, .. }) if axis == "rho")
    );
}
