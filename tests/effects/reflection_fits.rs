//! The bars of the fits: certified in f32, after rounding, at more than 2^20 points that were not
//! used in fitting.

use lobefit::approximate::{Emission, Fit, Memo, Region};
use lobefit::data::{AlphaMap, Norm, Smith, Source};
use lobefit::effects::reflection::{FitSpec, fit_all};

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
    let fits = fit_all(&spec(), &Memo::default()).expect("fits");
    assert!(fits.dropped.is_empty(), "{:?}", fits.dropped);
    let fits = fits.fits;
    let named = |name: &str| -> &Fit {
        fits.iter().find(|f| f.approximation.name == name).unwrap_or_else(|| panic!("no {name}"))
    };
    let max = |name: &str| named(name).approximation.certificate.max_abs;
    let rms = |name: &str| named(name).approximation.certificate.rms;
    let ops = |name: &str| named(name).approximation.cost.ops;
    assert!(max("ggx_norm_n1") <= 0.128 && rms("ggx_norm_n1_rms") <= 0.062 && ops("ggx_norm_n1") == 3);
    assert!(
        (max("ggx_norm_pesce_n1") - 0.144).abs() < 1e-3 && (rms("ggx_norm_pesce_n1") - 0.077).abs() < 1e-3
    );
    assert!(max("ggx_norm_r3p") <= 0.10 && rms("ggx_norm_r3p_rms") <= 0.037 && ops("ggx_norm_r3p") == 3);
    assert!(max("ggx_norm_q13") <= 0.021 && ops("ggx_norm_q13") <= 13);
    assert!(max("ggx_norm_q20") <= 0.0105 && ops("ggx_norm_q20") <= 20);
    // What the search has found.
    for (name, most, bar) in [
        ("ggx_norm_r8", 8, 0.0557),
        ("ggx_norm_i10", 10, 0.0326),
        ("ggx_norm_i11", 11, 0.0236),
        ("ggx_norm_i12", 12, 0.0206),
        ("ggx_norm_i13", 13, 0.0114),
        ("ggx_norm_i14", 14, 0.0098),
        ("ggx_norm_i15", 15, 0.0072),
        ("ggx_norm_i16", 16, 0.005),
        ("ggx_norm_i17", 17, 0.0035),
        ("ggx_norm_i19", 19, 0.0025),
        ("ggx_norm_i20", 20, 0.0018),
        ("ggx_eavg_3", 3, 0.00145),
        ("ggx_eavg_4", 4, 0.00031),
        ("ggx_eavg_5p", 5, 6.2e-5),
        ("ggx_eavg_12", 12, 2.5e-6),
    ] {
        println!("{name}: {} max {} rms {}", ops(name), max(name), rms(&format!("{name}_rms")));
        assert!(max(name) <= bar && ops(name) == most, "{name}: {} at {}", max(name), ops(name));
    }
    assert!(max("ggx_eavg_5") <= 1e-4 && ops("ggx_eavg_5") <= 5);
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
