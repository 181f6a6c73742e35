//! Arithmetic: tests that stand beside it and see what is private of it. Their files are compiled here
//! once more, and the library is not.
#![allow(dead_code, reason = "what of these files no test calls")]

use lobefit_math::{ops, srgb};

#[path = "../src/chebyshev.rs"]
mod chebyshev;
#[path = "../src/gauss.rs"]
mod gauss;
#[path = "../src/lanes.rs"]
mod lanes;
#[path = "../src/panels.rs"]
mod panels;
#[path = "../src/piecewise.rs"]
mod piecewise;
#[path = "../src/recurrence.rs"]
mod recurrence;
#[path = "../src/sobol.rs"]
mod sobol;
#[path = "../src/sum.rs"]
mod sum;

/// Values of IEC 61966-2-1, and the curve and its inverse on both sides of where they bend.
#[test]
fn the_curve_of_srgb_is_undone_by_its_inverse() {
    assert!((srgb::encoded(0.5) - 0.735_356_983_052_449_5).abs() < 1e-15);
    assert!((srgb::decoded(0.5) - 0.214_041_140_482_232_55).abs() < 1e-15);
    assert_eq!([0.0, 1.0].map(srgb::decoded), [0.0, 1.0]);
    // The line at dark, and where it ends: the standard's constants meet there to 1e-8.
    assert!((srgb::encoded(0.001) - 0.012_92).abs() < 1e-17);
    let bend = 0.040_45 / 12.92;
    let [below, above] = [bend - 1e-12, bend + 1e-12].map(srgb::encoded);
    assert!((above - below).abs() < 1e-7 && (below - 0.040_45).abs() < 1e-10, "{below} {above}");
    for i in 0..=1000 {
        let x = f64::from(i) / 1000.0;
        let back = srgb::decoded(srgb::encoded(x));
        assert!((back - x).abs() < 1e-15, "{x}: {back}");
    }
}
