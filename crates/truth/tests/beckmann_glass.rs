//! Rough glass of Beckmann's distribution against an integral over slopes of facets, against Monte
//! Carlo, in its limits, and the kernel of tables against the truth.

use std::f64::consts::PI;

use lobefit_math::ops;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::glass::table::{Energies, Kernel};
use lobefit_truth::integrate::monte_carlo::{Draw, Points, Run};
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::quantity::{BECKMANN_GLASS, BECKMANN_REFLECTION, Choice, Quantity, Variant};

fn variant(smith: Smith, side: Side) -> Variant {
    let mut variant = Variant::from(smith);
    assert!(variant.choose(Choice::Side, side.name()));
    variant
}

fn truth(smith: Smith, [alpha, mu, ior]: [f64; 3], side: Side) -> Vec<f64> {
    BECKMANN_GLASS.at(&variant(smith, side), &[alpha, mu, ior], 1e-8).expect("in the domain")
}

#[test]
#[ignore]
fn convergence() {
    for smith in Smith::ALL {
        for tolerance in [1e-4, 1e-5, 1e-6, 1e-7] {
            let kernel = Kernel::of(Beckmann, smith, tolerance).unwrap();
            let mut worst = [(0.0, [0.0; 3], Side::Outside); 2];
            let mut errors = Vec::new();
            for i in 0..200 {
                let r = |k: f64| (0.5 + k * i as f64).fract();
                let alpha = ops::pow(4e-4, r(0.7548776662));
                let mu = (1e-3_f64).max(r(0.5698402910) * r(0.5698402910));
                let ior = 1.0 + 2.0 * ops::pow(r(0.3247179572), 3.0);
                let mut out = [Energies::default()];
                kernel.energies(alpha, mu, &[ior], &mut out).unwrap();
                for (k, side) in Side::ALL.into_iter().enumerate() {
                    let t = match BECKMANN_GLASS.at(&variant(smith, side), &[alpha, mu, ior], 1e-8) {
                        Ok(t) => t,
                        Err(e) => {
                            println!("{e}");
                            continue;
                        }
                    };
                    for (j, d) in
                        [(out[0].r[k] - t[0]).abs(), (out[0].t[k] - t[1]).abs()].into_iter().enumerate()
                    {
                        if !(d <= worst[j].0) {
                            worst[j] = (d, [alpha, mu, ior], side);
                        }
                        errors.push(d);
                    }
                }
            }
            errors.sort_by(f64::total_cmp);
            println!(
                "{smith:?} {tolerance:e} {worst:?} median {:e} p95 {:e}",
                errors[errors.len() / 2],
                errors[errors.len() * 95 / 100]
            );
        }
    }
    let _ = (PI, Draw::VisibleNormal, Points::Sobol, &BECKMANN_REFLECTION);
    let _: Option<Run> = None;
}
