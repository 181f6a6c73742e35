//! Shares of lights: of a cosine by another integral, of lobes by samples, of the emitted function by
//! the closed form; and that a fitted matrix is the best about.

use lobefit_ltc::{
    Lobe, Lookup, Matrix, Pair, Quad, Setting, Square, View, cosine_share, fitted, measured, misplaced,
    proxy_share, sphere_share, squares, vector_share,
};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, dot, normalise, scaled};
use lobefit_shade::tape::Half;
use lobefit_truth::optics::{Smith, ggx};
use std::f64::consts::PI;

const GGX: Lobe = Lobe::Ggx(Smith::Correlated);
const SAMPLES: u64 = 1 << 15;

/// Whether a direction lies in a square.
fn holds(square: &Square, light: Vec3) -> bool {
    let depth = dot(light, square.centre);
    let within = |axis: Vec3| dot(light, axis).abs() <= square.half * depth;
    depth > 0.0 && within(square.across) && within(square.along)
}

/// Two numbers of each sample, evenly spread: a lattice of the golden ratio, moved.
fn drawn(moved: f64) -> impl Iterator<Item = [f64; 2]> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    (0..SAMPLES).map(move |i| {
        let at = |x: f64| (x + 0.37 * moved).fract();
        [at((i as f64 + 0.5) / SAMPLES as f64), at(i as f64 * GOLDEN)]
    })
}

/// Squares about the hemisphere: facing, across the horizon, below it, more than half of it.
fn some() -> Vec<Square> {
    let at = |x: f64, y: f64, z: f64, half: f64| Square::facing(normalise([x, y, z]), half);
    vec![
        at(0.0, 0.0, 1.0, 0.3),
        at(-0.5, 0.2, 0.8, 0.5),
        at(0.9, -0.3, 0.1, 0.4),
        at(-0.7, 0.7, 0.0, 1.0),
        at(0.1, 0.9, -0.2, 0.6),
        at(0.3, -0.2, 0.7, 3.0),
        at(0.2, 0.4, -0.9, 0.3),
    ]
}

#[test]
fn the_identity_is_the_cosine() {
    // The cosine over the square, by a rule in its plane that the horizon cuts.
    let rule = Gauss::new(96);
    for (i, square) in some().iter().enumerate() {
        let direct = |x: f64, y: f64| {
            let light: Vec3 =
                std::array::from_fn(|k| square.centre[k] + x * square.across[k] + y * square.along[k]);
            let inverse = 1.0 / dot(light, light).sqrt();
            (light[2] * inverse).max(0.0) * (inverse * inverse * inverse) / PI
        };
        let half = square.half;
        let horizon = (-square.centre[2] / square.along[2]).clamp(-half, half);
        let along = |low: f64, high: f64| {
            rule.integrate(low, high, |y| rule.integrate(-half, half, |x| direct(x, y)))
        };
        let expected = along(-half, horizon) + along(horizon, half);
        let found = Matrix::IDENTITY.share(&square.corners());
        assert!((found - expected).abs() < 1e-10, "square {i}: {found}, not {expected}");
        let mut turned = square.corners();
        turned.reverse();
        assert!((cosine_share(&turned) - found).abs() < 1e-15, "whichever way round");
    }
}

#[test]
fn a_matrix_sends_what_its_density_holds() {
    let matrix = Matrix { m11: 0.8, m13: 0.3, m31: -0.2, m33: 0.4 };
    // Directions of the cosine, taken to the lobe.
    let taken: Vec<Vec3> = drawn(1.0)
        .map(|[u, v]| {
            let (s, c) = ops::sincos(2.0 * PI * v);
            let light = matrix.given([u.sqrt() * c, u.sqrt() * s, (1.0 - u).sqrt()]);
            normalise(light)
        })
        .collect();
    for square in some() {
        let inside = taken.iter().filter(|light| holds(&square, **light)).count() as f64 / SAMPLES as f64;
        let found = matrix.share(&square.corners());
        assert!((found - inside).abs() < 2e-3, "{found}, of samples {inside}");
    }
    // The solid angle of the samples: the integral of 1/density over them is that of its support.
    let solid: f64 = taken.iter().map(|light| 1.0 / matrix.density(*light)).sum::<f64>() / SAMPLES as f64;
    assert!((solid / (2.0 * PI) - 1.0).abs() < 0.1, "half of the sphere: {solid}");
}

#[test]
fn what_a_lobe_sends_is_what_samples_find() {
    for (alpha, mu) in [(0.05, 0.9), (0.2, 0.3), (0.6, 0.05), (1.0, 0.6)] {
        let view = View::new(GGX, alpha, mu).expect("in the domain");
        let eye = [(1.0 - mu * mu).sqrt(), 0.0, mu];
        // Visible normals: the weight of a light is what is not shadowed.
        let lights: Vec<(Vec3, f64)> = drawn(2.0)
            .map(|[u, v]| ggx::mirror(eye, ggx::visible_normal([alpha; 2], eye, u, v)).0)
            .filter(|light| light[2] > 0.0)
            .map(|light| (light, ggx::lit_given_visible(Smith::Correlated, alpha, mu, light[2])))
            .collect();
        let whole: f64 = lights.iter().map(|(_, w)| w).sum::<f64>() / SAMPLES as f64;
        assert!((whole / view.albedo - 1.0).abs() < 2e-3, "the density integrates to 1: {whole}");
        for square in squares(&view) {
            let inside = lights.iter().filter(|(light, _)| holds(&square, *light));
            let found = inside.map(|(_, w)| w).sum::<f64>() / SAMPLES as f64 / view.albedo;
            let share = square.share(&view);
            assert!((share.value - found).abs() < 4e-3 + share.error, "{alpha} {mu}: {share:?}, not {found}");
            assert!(share.error < 2e-3, "{alpha} {mu}: {share:?}");
        }
    }
}

#[test]
fn what_a_sheen_sends_is_what_samples_find() {
    for (alpha, mu) in [(0.1, 0.2), (0.5, 0.8)] {
        let view = View::new(Lobe::Charlie, alpha, mu).expect("in the domain");
        let lights: Vec<Vec3> = drawn(3.0)
            .map(|[u, v]| {
                let (s, c) = ops::sincos(2.0 * PI * v);
                let sine = (1.0 - u * u).sqrt();
                [sine * c, sine * s, u]
            })
            .collect();
        let share = |inside: &dyn Fn(Vec3) -> bool| {
            let sum: f64 = lights.iter().filter(|l| inside(**l)).map(|l| view.density(*l)).sum();
            2.0 * PI * sum / SAMPLES as f64
        };
        assert!((share(&|_| true) - 1.0).abs() < 3e-3, "the density integrates to 1");
        for square in squares(&view) {
            let (own, found) = (square.share(&view), share(&|light| holds(&square, light)));
            assert!((own.value - found).abs() < 6e-3, "{alpha} {mu}: {own:?}, not {found}");
        }
    }
}

#[test]
fn the_emitted_function_is_the_closed_form() {
    let quad = Quad::new().expect("it parses");
    for matrix in [Matrix::IDENTITY, Matrix { m11: 0.7, m13: 0.4, m31: -0.1, m33: 0.3 }] {
        for square in some() {
            for distance in [0.01, 1.0, 300.0] {
                let corners = square.corners().map(|corner| scaled(corner, distance));
                let (exact, found) = (matrix.share(&corners), quad.share(matrix.texel(), &corners));
                assert!((exact - found).abs() < 2e-6, "{square:?} at {distance}: {found}, not {exact}");
            }
        }
    }
    // A corner on the horizon, an edge along it.
    let edge = [[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0]];
    let (exact, found) = (cosine_share(&edge), quad.share(Matrix::IDENTITY.texel(), &edge));
    assert!((exact - found).abs() < 1e-6, "{found}, not {exact}");
}

/// An edge that passes near the point, whose ends are nearly opposite as the point sees them: directions of
/// f32 are
/// off by 6e-8, of the edge's sine of about 2 over its length by the distance.
#[test]
fn a_long_thin_light_near_the_point_keeps_its_digits() {
    let quad = Quad::new().expect("it parses");
    println!("{} operations", quad.ops());
    for near in [1e-1_f64, 1e-2, 1e-3, 2e-4] {
        let mut worst = 0.0_f64;
        for turn in 0..24 {
            let (s, c) = ops::sincos(f64::from(turn) * PI / 12.0 + 0.1);
            for [rise, width, lean] in [[0.3, 0.2, 0.0], [1.0, 0.5, 0.3], [0.05, 1.0, -0.4]] {
                let corner = |along: f64, across: f64| {
                    let (x, y) = (along, near * (1.0 + across));
                    // In the digits of f32, which both are given.
                    [c * x - s * y, s * x + c * y, near * rise * (1.0 + lean * across)]
                        .map(|x| f64::from(x as f32))
                };
                let corners = [corner(-1.0, 0.0), corner(0.9, 0.0), corner(0.9, width), corner(-1.0, width)];
                for matrix in [Matrix::IDENTITY, Matrix { m11: 0.75, m13: 0.5, m31: -0.125, m33: 0.25 }] {
                    let (exact, found) = (matrix.share(&corners), quad.share(matrix.texel(), &corners));
                    worst = worst.max((exact - found).abs());
                }
            }
        }
        println!("at {near}: off by {worst:.2e}");
        assert!(worst < 2e-6 + 1e-7 / near, "at {near}: off by {worst:.2e}");
    }
}

#[test]
fn a_sphere_sends_what_a_rule_finds() {
    let rule = Gauss::new(200);
    for (cosine, length) in [(1.0_f64, 0.5_f64), (0.2, 0.3), (-0.3, 0.4), (0.0, 1.0), (-0.9, 0.1), (0.6, 0.9)]
    {
        let (sine, reach) = ((1.0 - cosine * cosine).sqrt(), ops::asin(length.sqrt()));
        // z over the cap, whose rings are cut at the horizon.
        let ring = |theta: f64| {
            let (s, c) = ops::sincos(theta);
            let (middle, swing) = (cosine * c, sine * s);
            let cut: f64 = if swing == 0.0 { 0.0 } else { (-middle / swing).clamp(-1.0, 1.0) };
            let half = if middle >= swing { PI } else { ops::acos(cut) };
            let half = if middle <= -swing { 0.0 } else { half };
            s * 2.0 * (middle * half + swing * ops::sin(half)) / PI
        };
        let expected = rule.integrate(0.0, reach, ring);
        let found = sphere_share(cosine, length);
        assert!((found - expected).abs() < 2e-4, "{cosine} {length}: {found}, not {expected}");
    }
    let facing = Square::facing([0.0, 0.0, 1.0], 0.4).corners();
    let [vector, exact] = [vector_share(&facing)[2], cosine_share(&facing)];
    assert!((vector - exact).abs() < 1e-15);
    assert!((proxy_share([0.0, 0.0, exact]) - exact).abs() < 1e-12, "a light that faces has no horizon");
}

#[test]
fn no_matrix_beside_a_fitted_one_is_better() {
    for (lobe, alpha, mu) in [(GGX, 0.1, 0.7), (GGX, 0.6, 0.2), (Lobe::Charlie, 0.4, 0.5)] {
        let view = View::new(lobe, alpha, mu).expect("in the domain");
        let refused = fitted(&view, &[]).expect_err("no start").to_string();
        assert!(
            refused.contains("`starts` is empty") && refused.contains(&format!("alpha {alpha}")),
            "{refused}"
        );
        let start = Matrix { m33: alpha, ..Matrix::IDENTITY };
        let found = fitted(&view, &[start, Matrix::IDENTITY]).expect("a fit");
        let best = misplaced(&view, found);
        assert!(best < 0.2 && best < misplaced(&view, start), "{lobe:?}: {best}");
        for k in 0..4 {
            for by in [0.97, 1.03] {
                let mut texel = found.texel();
                texel[k] *= by;
                let beside = misplaced(&view, Matrix::of_texel(texel));
                // The nodes of the fit are others than those that judge it.
                assert!(beside > best - 2e-3, "{lobe:?}, entry {k} times {by}: {beside} below {best}");
            }
        }
        for square in squares(&view) {
            let off = (found.share(&square.corners()) - square.share(&view).value).abs();
            assert!(off <= best + 2e-3, "no light is off by more than what is misplaced: {off}, {best}");
        }
    }
}

#[test]
fn a_small_pair_is_measured_at_its_texels_and_between() {
    let alpha = |roughness: f64| roughness * roughness;
    let pair = Pair::fitted(GGX, 8, alpha).expect("a pair");
    let setting = Setting { lobe: GGX, roughness: [0.3, 1.0], mu: [0.05, 1.0], places: 5 };
    let found = measured(&pair, &setting, alpha).expect("finite");
    // 0.204, half a texel from the places of the even grid, which find 0.173.
    assert!(found.shape.max < 0.21 && found.shape.rms < 0.03, "{:?}", found.shape);
    // Nothing about the stated maximum is larger, at texels or between: the lookup that shaders do.
    let (quad, [roughness, mu]) = (1.0 / 28.0, found.shape.at);
    for k in 0..49 {
        let near = |at: f64, k: i32| (at + quad * f64::from(k - 3)).clamp(0.0, 1.0);
        let (r, v) = (near(roughness, k % 7).max(0.3), near((1.0 - mu).sqrt(), k / 7));
        let mu = (1.0 - v * v).max(0.05);
        let matrix = Matrix::of_texel(pair.at(r, mu, Lookup::Exact)[0]);
        let view = View::new(GGX, alpha(r), mu).expect("in the domain");
        for square in squares(&view) {
            let off = (matrix.share(&square.corners()) - square.share(&view).value).abs();
            assert!(off < 1.02 * found.shape.max, "{r} {mu}: {off}, stated {:?}", found.shape);
        }
    }
    // In half precision places move by some 2^-11, 0.003 of a texel: as much as what lies between two texels.
    for (exact, half) in [(&found.shape, &found.shape_half), (&found.light, &found.light_half)] {
        let moved = (half.max - exact.max).abs();
        assert!(half != exact && moved < 0.02 * exact.max + 2e-3, "{exact:?} {half:?}");
    }
    let [exact, half] = [Lookup::Exact, Lookup::Half].map(|lookup| pair.at(0.7, 0.4, lookup)[1][0]);
    assert!(
        half == f64::from(Half::nearest(half as f32).to_f32()) && (half - exact).abs() < 2e-3,
        "{exact} {half}"
    );
    assert!(found.misplaced.max >= found.shape.max, "a square is no worse than any light");
    assert!(found.code.max < 1e-4 && found.integration.max < 2e-3);
    assert!(found.horizon.max > 0.05, "the formula without clipping is what errs: {:?}", found.horizon);
    // A pair whose E is off is found out, and one that is no number refused.
    let brighter = Pair {
        amplitudes: pair.amplitudes.iter().map(|[e, b, ..]| [e + 0.1, *b, 0.0, 0.0]).collect(),
        ..pair.clone()
    };
    let brighter = measured(&brighter, &setting, alpha).expect("finite");
    assert!((brighter.amplitude.mean - found.amplitude.mean - 0.1).abs() < 1e-9);
    let mut broken = pair;
    broken.matrices.iter_mut().for_each(|texel| texel[3] = f64::NAN);
    let refused = measured(&broken, &setting, alpha).expect_err("no number");
    assert!(refused.to_string().contains("is NaN at roughness"), "{refused}");
}
