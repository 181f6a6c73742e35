//! The azimuth of anisotropic lobes as the variable of a cubic.

use lobefit::effects::anisotropy::Azimuth;
use lobefit_math::ops;

#[test]
fn t_and_azimuth_are_inverse() {
    for (alpha, aspect) in [(0.02, 0.9), (0.3, 0.5), (1.0, 0.1_f64.sqrt())] {
        let surface = Azimuth { alpha, aspect };
        assert!((surface.t(0.0) - 1.0).abs() < 1e-12, "along alpha_x");
        assert!((surface.t(std::f64::consts::FRAC_PI_2) + 1.0).abs() < 1e-12, "along alpha_y");
        for t in [-0.99, -0.4, 0.0, 0.3, 0.8] {
            assert!((surface.t(surface.phi(t)) - t).abs() < 1e-9, "{alpha} {aspect} {t}");
        }
    }
    assert_eq!(Azimuth { alpha: 0.2, aspect: 1.0 }.t(0.7), 0.0);
}

#[test]
fn a_cubic_is_itself_and_a_smooth_function_is_close() {
    let cubic = |t: f64| 0.3 - 0.2 * t + 0.1 * t * t + 0.05 * t * t * t;
    let found = Azimuth::cubic(&Azimuth::samples().into_iter().map(cubic).collect::<Vec<_>>());
    for (a, b) in found.into_iter().zip([0.3, -0.2, 0.1, 0.05]) {
        assert!((a - b).abs() < 1e-14);
    }
    let found = Azimuth::cubic(&Azimuth::samples().into_iter().map(ops::exp).collect::<Vec<_>>());
    // The best cubic of exp on [-1, 1] errs by 5.5e-3.
    for i in 0..=100 {
        let t = -1.0 + 0.02 * f64::from(i);
        assert!((Azimuth::at(found, t) - ops::exp(t)).abs() < 6.2e-3);
    }
}
