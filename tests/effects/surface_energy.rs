//! A whole material in a furnace, and with its directions exchanged.

use std::sync::{Arc, Mutex};

use lobefit::data::Smith;
use lobefit::effects::coupling::surface::measure::{self, Rules, TOLERANCE};
use lobefit::effects::coupling::surface::{
    Albedos, Base, Coupling, Factor, FactorAt, Lobe, Material, Surface, SurfaceError,
};
use lobefit_math::sobol::Sobol;
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::reflection;
use lobefit_truth::optics::fresnel;
use lobefit_truth::quantity::coupling::{self, Specular};

const SMITHS: [Smith; 2] = [Smith::Correlated, Smith::Separable];

fn surface(smith: Smith, alpha: f64, f0: [f64; 3], lobe: Lobe, coupling: Coupling) -> Material {
    Material { smith, alpha, f0, lobe, base: Some(Base { albedo: [1.0; 3], coupling }) }
}

/// The interpolants hold what they promise: 1e-7, the loss relative to itself.
#[test]
fn albedos_between_the_nodes_are_the_integrals() {
    let sobol = Sobol::new([3, 5, 7]);
    for smith in SMITHS {
        for alpha in [1e-3, 0.03, 0.4, 1.0] {
            let albedos = Albedos::new(smith, alpha).unwrap();
            let average = reflection::average(smith, alpha, 1e-9).unwrap();
            assert!((albedos.average.e - average.e_avg).abs() < 1e-8, "{smith:?} {alpha}");
            let off = albedos.average.loss / average.loss_avg - 1.0;
            assert!(off.abs() < 1e-7, "{smith:?} {alpha}: average loss off by {off:e}");
            for i in 0..40 {
                let x = sobol.coordinate(i, 0);
                // half of the cosines in the layer of width alpha
                let mu = if i % 2 == 0 { x } else { (alpha * x * x * x).max(1e-5 * alpha) };
                let truth = reflection::reflection(smith, alpha, mu, 1e-9).unwrap();
                let got = albedos.at(mu);
                assert!((got.e - truth.e).abs() < 1e-7, "{smith:?} {alpha} {mu}: {got:?} {truth:?}");
                assert!((got.b - truth.b).abs() < 1e-7, "{smith:?} {alpha} {mu}: {got:?} {truth:?}");
                let off = got.loss / truth.loss - 1.0;
                assert!(off.abs() < 1e-7, "{smith:?} {alpha} {mu}: loss off by {off:e}");
            }
        }
    }
}

/// A value that is not a number at one direction of the first rule alone is named, and not taken
/// for a rule that has settled.
#[test]
fn a_rule_that_meets_nan_is_refused() {
    let met = Arc::new(Mutex::new(Vec::new()));
    let albedos = Arc::new(Albedos::new(Smith::Correlated, 0.4).unwrap());
    let surface = |factor| {
        let material = Material::white(0.4, 0.04, Lobe::Single, Coupling::Symmetrised(factor));
        Surface::with(&material, albedos.clone()).unwrap()
    };
    let seen = met.clone();
    let good = surface(Factor::new("good", move |at: &FactorAt| {
        seen.lock().unwrap().push(at.mu);
        1.0 - at.f0
    }));
    met.lock().unwrap().clear();
    Rules::new(0.4, 0.7).base(&good, TOLERANCE).unwrap();
    // The view, then a light of the first rule; later rules have other lights.
    let light = met.lock().unwrap().iter().copied().find(|mu| *mu != 0.7).unwrap();
    assert_eq!(met.lock().unwrap().iter().filter(|mu| **mu == light).count(), 1, "in one rule alone");
    let bad =
        surface(Factor::new("bad", move |at: &FactorAt| if at.mu == light { f64::NAN } else { 1.0 - at.f0 }));
    let error = Rules::new(0.4, 0.7).base(&bad, TOLERANCE).unwrap_err();
    assert!(matches!(error, SurfaceError::NotFinite { what: "furnace", .. }), "{error}");
}

/// The albedo of every lobe by quadrature of f(l, v) is the closed form from E and A; a white base
/// under the exact factors closes it to 1.
#[test]
fn exact_couplings_close_the_furnace() {
    for smith in SMITHS {
        for (alpha, mu) in [(0.02, 0.015), (0.02, 0.7), (0.3, 0.1), (0.8, 0.95), (1.0, 0.01)] {
            let albedos = Arc::new(Albedos::new(smith, alpha).unwrap());
            let rules = Rules::new(alpha, mu);
            for f0 in [[0.0, 0.04, 0.7], [0.04; 3]] {
                for lobe in Lobe::ALL {
                    for coupling in
                        [Coupling::OneMinusOwnSpecular, Coupling::Kelemen, Coupling::Interreflected]
                    {
                        let material = surface(smith, alpha, f0, lobe, coupling);
                        let surface = Surface::with(&material, albedos.clone()).unwrap();
                        let albedo = rules.albedo(&surface).unwrap();
                        let closed = surface.specular_albedo(mu);
                        for i in 0..3 {
                            let off = albedo.specular[i].value - closed[i];
                            assert!(off.abs() < 1e-6, "{material:?} at {mu}: lobe off by {off:e}");
                            let off = albedo.total()[i].value - 1.0;
                            assert!(off.abs() < 2e-6, "{material:?} at {mu}: furnace off by {off:e}");
                        }
                    }
                }
            }
        }
    }
}

/// At f0 = 1 every lobe but the bare one is lossless, and nothing is left for the base.
#[test]
fn compensated_mirrors_are_white() {
    for lobe in Lobe::ALL {
        let surface = Surface::new(&Material::white(0.6, 1.0, lobe, Coupling::Kelemen)).unwrap();
        for mu in [0.05, 0.5, 1.0] {
            let albedo = measure::albedo(&surface, mu).unwrap();
            let loss = reflection::reflection(Smith::Correlated, 0.6, mu, 1e-9).unwrap().loss;
            let lost = if lobe == Lobe::Single { loss } else { 0.0 };
            assert!((albedo.specular[0].value - (1.0 - lost)).abs() < 1e-6, "{lobe:?} {mu}: {albedo:?}");
            assert!((albedo.base[0].value - lost).abs() < 1e-6, "{lobe:?} {mu}: {albedo:?}");
        }
    }
}

/// What the lobe leaves is the truth of `diffuse-coupling`.
#[test]
fn what_is_left_is_the_coupling_truth() {
    let lobes = [
        (Lobe::Single, Specular::Single),
        (Lobe::Normalised, Specular::Normalised),
        (Lobe::Compensated, Specular::Compensated),
    ];
    for (lobe, specular) in lobes {
        for (alpha, mu, f0) in [(0.1, 0.05, 0.04), (0.5, 0.6, 0.2), (1.0, 1.0, 0.9)] {
            let surface = Surface::new(&Material::metal(alpha, [f0; 3], lobe)).unwrap();
            let truth = coupling::coupling(Smith::Correlated, alpha, mu, f0, specular, 1e-9).unwrap();
            let left = surface.side(mu).left[0];
            assert!((left - truth.value).abs() < 2e-7, "{lobe:?} {alpha} {mu} {f0}: {left} {truth:?}");
        }
    }
}

/// Those that claim reciprocity have it to the last bit but for three roundings; those that do not,
/// depart from it visibly.
#[test]
fn reciprocal_materials_measure_zero() {
    let pairs = measure::pairs();
    assert_eq!(pairs.len(), 66 * 6);
    for smith in SMITHS {
        let albedos = Arc::new(Albedos::new(smith, 0.4).unwrap());
        for f0 in [[0.02, 0.04, 0.2], [0.04; 3]] {
            for lobe in Lobe::ALL {
                for coupling in Coupling::ALL {
                    let reciprocal = lobe.is_reciprocal() && coupling.is_reciprocal();
                    let material = surface(smith, 0.4, f0, lobe, coupling);
                    let surface = Surface::with(&material, albedos.clone()).unwrap();
                    let found = measure::reciprocity(&surface, &pairs).unwrap().unwrap();
                    if reciprocal {
                        assert!(found.departure < 4e-15, "{material:?}: {found:?}");
                    } else {
                        assert!(found.departure > 1e-3, "{material:?}: {found:?}");
                    }
                }
            }
        }
    }
}

/// A fitted formula takes the place of a coupling; one of other inputs is refused.
#[test]
fn formulas_can_be_the_factor() {
    let source =
        "override c: f32 = 1.0;\nfn factor(mu: f32, f0: f32) -> f32 { return c * (1.0 - f0) * mu; }\n";
    let hypothesis = Hypothesis::parse("factor.wgsl", source).unwrap();
    let factor = Factor::fitted("mine", &hypothesis, &[0.5]).unwrap();
    let material = Material::white(0.3, 0.04, Lobe::Single, Coupling::Factor(factor));
    let surface = Surface::new(&material).unwrap();
    let albedo = measure::albedo(&surface, 0.8).unwrap();
    assert!((albedo.base[1].value - 0.5 * 0.96 * 0.8).abs() < 1e-7, "{albedo:?}");
    assert!(matches!(Factor::fitted("mine", &hypothesis, &[]), Err(SurfaceError::Factor { .. })));
    let other = Hypothesis::parse("o.wgsl", "fn o(ior: f32) -> f32 { return ior; }").unwrap();
    assert!(Factor::fitted("other", &other, &[]).unwrap_err().to_string().contains("ior"));
}

#[test]
fn bad_materials_are_refused_by_name() {
    let refused = |material: &Material| Surface::new(material).unwrap_err().to_string();
    assert!(refused(&Material::metal(0.0, [1.0; 3], Lobe::Single)).contains("alpha = 0.0"));
    assert!(refused(&Material::metal(f64::NAN, [1.0; 3], Lobe::Single)).contains("alpha = NaN"));
    assert!(refused(&Material::metal(0.1, [1.0, 1.1, 1.0], Lobe::Single)).contains("f0 = 1.1"));
    let mut dark = Material::white(0.1, 0.04, Lobe::Single, Coupling::None);
    dark.base.as_mut().unwrap().albedo[2] = -0.1;
    assert!(refused(&dark).contains("base albedo = -0.1"));
    let albedos = Arc::new(Albedos::new(Smith::Correlated, 0.2).unwrap());
    let material = Material::metal(0.1, [1.0; 3], Lobe::Single);
    let error = Surface::with(&material, albedos).unwrap_err();
    assert!(error.to_string().contains("alpha 0.1"), "{error}");
    let surface = Surface::new(&material).unwrap();
    assert!(measure::albedo(&surface, 0.0).is_err());
    assert_eq!(surface.evaluate([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]), [0.0; 3]);
}

/// The ends: as alpha -> 0 every lobe leaves (1 - f0)(1 - (1 - mu)^5), the second lobe vanishes,
/// and the average of what is left is 20/21 (1 - f0); under f0 = 1 nothing is left but what single
/// scattering loses.
#[test]
fn smooth_lobes_leave_what_a_mirror_leaves() {
    for lobe in Lobe::ALL {
        for f0 in [0.0, 0.04, 0.5, 1.0] {
            let surface = Surface::new(&Material::white(1e-4, f0, lobe, Coupling::Kelemen)).unwrap();
            for mu in [0.05, 0.3, 1.0] {
                let mirror = (1.0 - f0) * (1.0 - fresnel::schlick_weight(1.0 - mu));
                let left = surface.side(mu).left[0];
                assert!((left - mirror).abs() < 2e-5, "{lobe:?} f0 {f0}, mu {mu}: {left} {mirror}");
            }
            let average = surface.left_average()[0];
            assert!((average - (1.0 - f0) * 20.0 / 21.0).abs() < 2e-5, "{lobe:?} {f0}: {average}");
            if f0 < 1.0 {
                // away from the mirror direction only the base is seen
                let f = surface.parts([0.6, 0.0, 0.8], [0.0, 0.6, 0.8]);
                assert!(f.specular[0] < 1e-6 && f.base[0] > 0.1 * (1.0 - f0), "{lobe:?} {f0}: {f:?}");
            }
        }
    }
}
