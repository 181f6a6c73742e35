//! The literal experiment against the study's figures, which come from another program, and against
//! a search on a plain grid.

use std::f64::consts::PI;

use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::window::{Ordinate, fits, ordinate, slanted};

#[test]
fn offsets_are_those_of_the_study() {
    let fit = |ordinate, alpha, distance| fits(&Kernel::Ndf, ordinate, alpha, distance).expect("a fit");
    // values: 0 in distance 1, growing as alpha' nears 1, positive below
    let [same, _] = fit(Ordinate::Value, 0.5, 1.0);
    assert!((same.alpha - 0.5).abs() < 1e-6 && same.offset.abs() < 1e-6 && same.error < 1e-7, "{same:?}");
    for (alpha, distance, adjusted, offset) in
        [(0.1, 4.0, 0.37, -0.046), (0.2, 2.0, 0.378, -0.04), (0.5, 2.0, 0.868, -1.34)]
    {
        let [with, without] = fit(Ordinate::Value, alpha, distance);
        assert!((with.alpha - adjusted).abs() < 5e-3, "{with:?}");
        assert!((with.offset / offset - 1.0).abs() < 0.05, "{with:?}");
        assert!(
            with.error < 0.014 && without.error < 0.08 && with.error < without.error,
            "{with:?} {without:?}"
        );
    }
    for alpha in [0.2, 0.36, 0.5, 0.64] {
        assert!(fit(Ordinate::Value, alpha, 0.5)[0].offset > 2e-3);
        let [with, _] = fit(Ordinate::Value, alpha, 4.0);
        assert!(with.offset < -0.3 && (with.saturated || with.alpha < 0.75), "{with:?}");
    }
    // energy: near 0 wherever alpha' is open, positive where it is not
    for alpha in [0.05, 0.1, 0.2, 0.36, 0.5, 0.64] {
        for distance in [0.25, 0.5, 1.0, 1.5, 2.0, 4.0] {
            let [with, without] = fit(Ordinate::PerArea, alpha, distance);
            if with.saturated {
                assert!((0.01..0.96).contains(&with.offset), "alpha {alpha} d {distance}: {with:?}");
            } else {
                assert!(with.offset.abs() < 0.04, "alpha {alpha} d {distance}: {with:?}");
                assert!(without.error < 0.021, "alpha {alpha} d {distance}: {without:?}");
            }
        }
    }
}

#[test]
fn no_width_scale_and_offset_of_a_grid_are_better() {
    let (alpha, distance) = (0.36, 1.5);
    let [with, _] = fits(&Kernel::Ndf, Ordinate::Value, alpha, distance).expect("a fit");
    let target = Kernel::Ndf.lobe(alpha);
    let error = |a: f64, scale: f64, offset: f64| {
        let fetch = Kernel::Ndf.lobe(a);
        let (mut off, mut whole) = (0.0, 0.0);
        for i in 0..2000 {
            let x = (f64::from(i) + 0.5) / 2000.0;
            let t = ordinate(&target, Ordinate::Value, x / distance);
            let d = t - scale * ordinate(&fetch, Ordinate::Value, x) - offset;
            (off, whole) = (off + d * d, whole + t * t);
        }
        (off / whole).sqrt()
    };
    assert!((error(with.alpha, with.scale, with.offset) - with.error).abs() < 1e-5);
    for (a, s, o) in (0..125).map(|i| (i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2)).filter(|c| *c != (0, 0, 0)) {
        let moved = error(
            with.alpha * (1.0 + 0.01 * f64::from(a)),
            with.scale * (1.0 + 0.01 * f64::from(s)),
            with.offset + 0.01 * f64::from(o),
        );
        assert!(moved > with.error, "{a} {s} {o}: {moved} below {}", with.error);
    }
}

#[test]
fn slants_have_the_negative_result() {
    let third = slanted(&Kernel::Ndf, 0.1, PI / 6.0).expect("a fit");
    assert!((third.same - 0.107).abs() < 1e-3 && (third.error - 0.0925).abs() < 1.5e-3, "{third:?}");
    assert!((third.alpha - 0.106).abs() < 2e-3, "{third:?}");
    let steep = slanted(&Kernel::Ndf, 0.1, PI / 2.5).expect("a fit");
    assert!((steep.same - 0.66).abs() < 5e-3 && (steep.error - 0.567).abs() < 5e-3, "{steep:?}");
    assert!((steep.alpha - 0.18).abs() < 2e-3, "{steep:?}");
    // across the tilt nothing changes; along it, the near and the far side are unlike
    assert!(
        (steep.half[0] - third.half[0]).abs() < 1e-12 && (steep.half[0] - 0.0648).abs() < 2e-4,
        "{steep:?}"
    );
    assert!((steep.half[1] - 0.175).abs() < 2e-3 && (steep.half[2] - 0.262).abs() < 2e-3, "{steep:?}");
}
