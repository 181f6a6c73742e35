//! The bars of the fits: certified in f32, after rounding, at more than 2^20 points that were not
//! used in fitting.

use crate::baked_support::assert_promised;
use lobefit::approximate::{Emission, Fit, Memo, Region};
use lobefit::data::{AlphaMap, Norm, Smith, Source};
use lobefit::effects::reflection::{FitSpec, GGX, fit_all};

fn spec() -> FitSpec {
    FitSpec {
        smith: Smith::Correlated,
        region: Region { roughness: [0.02, 1.0], mu: [0.01, 1.0], alpha_map: AlphaMap::RoughnessSquared },
        max_ops: Some(20),
        norms: vec![Norm::Max, Norm::Rms],
        average: true,
        average_ops: None,
        blend: false,
        hypotheses: Vec::new(),
        emission: Emission::default(),
    }
}

#[test]
fn bars() {
    let fits = fit_all(&GGX, &spec(), &Memo::default()).expect("fits");
    assert!(fits.dropped.is_empty(), "{:?}", fits.dropped);
    let fits = fits.fits;
    let named = |name: &str| -> &Fit {
        fits.iter().find(|f| f.approximation.name == name).unwrap_or_else(|| panic!("no {name}"))
    };
    let rms = |name: &str| named(name).approximation.certificate.rms;
    assert_promised("tests/effects/reflection_fits.rs", &fits);
    assert!(rms("ggx_norm_n1_rms") <= 0.062 && rms("ggx_norm_r3p_rms") <= 0.037);
    let published = named("ggx_norm_pesce_n1").approximation.certificate.max_abs;
    assert!((published - 0.144).abs() < 1e-3 && (rms("ggx_norm_pesce_n1") - 0.077).abs() < 1e-3);
    for fit in &fits {
        let a = &fit.approximation;
        assert!(a.certificate.points >= 1 << 20, "{}", a.name);
        assert!(a.certificate.rms <= a.certificate.max_abs, "{}", a.name);
        assert_eq!(
            fit.emitted,
            !matches!(&a.source, Source::Published(p) if !p.contains("Misunderstanding"))
        );
    }
}
