//! What samples, formats and designs leave, which is no part that other code made.

use lobefit::data::Smith;
use lobefit_audit::audit::{Audit, AuditedTable, Column, Defect, Fit, Fixed, Registration, Scale};
use lobefit_audit::foreign::Step;
use lobefit_math::ops;
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::support::{axes, both, columns, jitter, reflection_of, rising, run, says, shipped};

/// Texels along each axis.
const N: usize = 24;

fn at(i: usize) -> f64 {
    (i as f64 + 0.5) / N as f64
}

/// Parts that are said to be of other code.
pub fn parts(found: &Audit) -> usize {
    found.channels[0].defects.iter().filter(|d| matches!(d, Defect::Part { .. })).count()
}

/// E and B of GGX, height-correlated, by independent samples of D: the spread of the weights is largest at
/// grazing view and nothing on smooth surfaces.
fn sampled(alpha: f64, mu: f64, samples: u32, random: &mut Pcg64) -> [f64; 2] {
    let uniform = |random: &mut Pcg64| random.next_u32() as f64 / 4294967296.0;
    let lambda = |c: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - c * c) / (c * c)).sqrt() - 1.0);
    let mut sums = [0.0; 2];
    for _ in 0..samples {
        let (phi, v) = (2.0 * std::f64::consts::PI * uniform(random), uniform(random));
        let cosine = ((1.0 - v) / (1.0 + (alpha * alpha - 1.0) * v)).sqrt();
        let y = (1.0 - mu * mu).sqrt() * (1.0 - cosine * cosine).sqrt() * ops::cos(phi) + mu * cosine;
        let light = 2.0 * y * cosine - mu;
        if light > 0.0 && y > 0.0 {
            let weight = y / (cosine * mu) / (1.0 + lambda(mu) + lambda(light));
            sums = [sums[0] + weight, sums[1] + weight * ops::pow(1.0 - y, 5.0)];
        }
    }
    sums.map(|sum| sum / f64::from(samples))
}

/// E of 8192 samples at each texel.
fn of_samples() -> Vec<f64> {
    let mut random = Pcg64::seed_from_u64(3);
    (0..N * N).map(|i| sampled(at(i / N) * at(i / N), at(i % N), 8192, &mut random)[0]).collect()
}

/// Texels that are further off than so many samples leave.
fn over(values: &[f64], samples: u32) -> usize {
    let fixed = Fixed { samples: Some(samples), ..Fixed::default() };
    let found = run(&shipped(&[N; 2], vec![("0", values.to_vec())]), "ggx-reflection", &fixed);
    let said = found.channels[0].defects.iter().find_map(|d| match d {
        Defect::Sampled { texels, .. } => Some(texels[0]),
        _ => None,
    });
    said.expect("samples are spoken of")
}

/// A channel of few samples "follows nothing that is known", whatever `--samples` said.
#[test]
fn few_samples_follow_what_they_are_samples_of() {
    let both = |x: usize, y: usize| both(Smith::Correlated, at(y) * at(y), at(x));
    let a = |i: usize| both(i % N, i / N).0 - both(i % N, i / N).1;
    let bias: Vec<f64> = (0..N * N).map(|i| both(i % N, i / N).1).collect();
    // Noise of 0.029, root mean square.
    let noisy: Vec<f64> = (0..N * N).map(|i| a(i) + 0.05 * jitter(i % N, i / N)).collect();
    let found = reflection_of(&shipped(&[N; 2], vec![("0", noisy), ("1", bias.clone())]));
    says(&found.verdict(None), "PASS", &["A and B", "as sampling noise does"]);
    // As smooth as the truth, as one set of points for all texels has it.
    let smooth: Vec<f64> = (0..N * N).map(|i| a(i) + 0.09 * ops::sin(7.0 * at(i / N)) * at(i % N)).collect();
    let of_set = shipped(&[N; 2], vec![("0", smooth), ("1", bias)]);
    let known = Fixed { samples: Some(16), ..Fixed::default() };
    says(&run(&of_set, "ggx-reflection", &known).verdict(None), "PASS", &["than 16 samples leave"]);
    says(&reflection_of(&of_set).verdict(None), "UNKNOWN", &[]);
}

/// "Made by other code, make the table again" was said of a good table of 8192 samples.
#[test]
fn point_07_what_samples_leave_is_no_part_of_other_code() {
    let e = of_samples();
    let found = reflection_of(&shipped(&[N; 2], vec![("0", e.clone())]));
    assert_eq!((found.fit, parts(&found), columns(&found)), (Fit::Whole, 0, vec![Some(Column::E)]));
    assert_eq!(axes(&found), rising(&[Scale::Mu, Scale::Roughness], Registration::Centre));
    // Weights of grazing views spread most.
    let errors = found.channels[0].errors.as_ref().unwrap();
    assert!(errors.rms < 0.02 && errors.at["mu"] < 0.05, "{errors:?}");
    says(&found.verdict(None), "PASS", &["ggx-reflection E"]);
    // Samples that are stated are held against what so many leave; a normalisation is off by the error of E
    // over E^2, of the same samples.
    assert!(over(&e, 64) == 0 && over(&e, 1 << 20) > 50);
    let inverse: Vec<f64> = e.iter().map(|e| 1.0 / e).collect();
    let (inverse, plain) = (over(&inverse, 1 << 18), over(&e, 1 << 18));
    assert!(plain > 20 && inverse.abs_diff(plain) <= 2, "{plain} {inverse}");
}

/// The first column of a table of end points has few weights, all large: one of them is no row of other code.
#[test]
fn samples_of_end_points_are_no_rows_of_other_code() {
    let end = |i: usize| (i as f64 / 15.0).max(1e-3);
    for seed in 0..4 {
        let mut random = Pcg64::seed_from_u64(seed);
        let mut b = |i: usize| sampled(end(i / 16) * end(i / 16), end(i % 16), 4096, &mut random)[1];
        let found = reflection_of(&shipped(&[16; 2], vec![("0", (0..256).map(&mut b).collect())]));
        assert_eq!((parts(&found), columns(&found)), (0, vec![Some(Column::B)]), "{seed}");
        says(&found.verdict(None), "PASS", &["ggx-reflection B"]);
    }
}

/// Two rows of other code in a table of samples are named by their rows, though samples leave a few
/// texels elsewhere as far off.
#[test]
fn damaged_rows_among_samples_are_named() {
    let truth = |i: usize| both(Smith::Correlated, at(i / N) * at(i / N), at(i % N)).0;
    // A hundred times the samples.
    let mut e: Vec<f64> =
        of_samples().iter().enumerate().map(|(i, e)| truth(i) + 0.1 * (e - truth(i))).collect();
    e[10 * N..12 * N].iter_mut().for_each(|e| *e += 0.1);
    let found = reflection_of(&shipped(&[N; 2], vec![("0", e)]));
    let part = found.channels[0].defects.iter().find_map(|d| match d {
        Defect::Part { extent, .. } => Some(extent.range.clone()),
        _ => None,
    });
    assert_eq!(part, Some(vec![[0, N - 1], [10, 11]]), "{:?}", found.channels[0].defects);
    let noise = "% of the error of the others jumps from texel to texel, as sampling noise does";
    says(&found.verdict(None), "FAIL", &["ggx-reflection E", "make the texels at y = 10 to 11 again", noise]);
}

/// Smooth surfaces are exact in any format; in ten bits the rest is off by up to a step.
#[test]
fn point_07_what_the_format_holds_is_no_part_of_other_code() {
    let e: Vec<f64> =
        (0..N * N).map(|i| both(Smith::Correlated, at(i / N) * at(i / N), at(i % N)).0).collect();
    for (step, steps) in [(Step::Unorm(8), 255.0), (Step::Unorm(10), 1023.0), (Step::Unorm(16), 65535.0)] {
        let of = |round: fn(f64) -> f64| {
            let values = e.iter().map(|e| round(e * steps) / steps).collect();
            reflection_of(&shipped(&[N; 2], vec![("0", values)]))
        };
        let found = of(f64::floor);
        assert_eq!((found.fit, parts(&found)), (Fit::Whole, 0), "{step:?}");
        assert!(found.worst() < 1.0001 / steps, "{}", found.worst());
        let found = of(f64::round);
        let rounded = |d: &Defect| matches!(d, Defect::Steps { step: own, .. } if *own == step);
        assert!(found.channels[0].defects.iter().any(rounded), "{step:?}");
        says(&found.verdict(Some(0.51 / steps)), "PASS", &["ggx-reflection E"]);
    }
}

/// A picture of 8 bits that was made from one of 565.
#[test]
fn pictures_of_fewer_bits_are_rounded_and_not_noisy() {
    let of = |bits: u32| {
        let steps = f64::from((1_u32 << bits) - 1);
        let eight = |e: f64| ((e * steps).round() / steps * 255.0).round() / 255.0;
        let values = |i: usize| eight(both(Smith::Correlated, at(i / N) * at(i / N), at(i % N)).0);
        let stored = shipped(&[N; 2], vec![("0", (0..N * N).map(values).collect())]);
        reflection_of(&AuditedTable { step: Step::Unorm(8), ..stored })
    };
    for bits in [5, 6] {
        let rounded = format!("That is what rounding to {bits}-bit unorm leaves");
        says(&of(bits).verdict(None), "PASS", &[&rounded]);
    }
}
