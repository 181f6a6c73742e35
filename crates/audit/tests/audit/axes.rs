//! Coordinates of tables: scales, registrations, and axes of both.

use lobefit_audit::audit::{AxisReading, Fixed, Form, Input, REGISTRATIONS, Registration, SCALES, Scale};

use crate::support::{both, plane, run, said};
use lobefit::data::Smith;

#[test]
fn positions_undo_coordinates() {
    for registration in REGISTRATIONS {
        for i in 1..7 {
            let back = registration.position(registration.coordinate(i, 9), 9);
            assert!((back - i as f64).abs() < 1e-12, "{registration:?} {i}: {back}");
            let mirrored = 1.0 - registration.mirrored().coordinate(8 - i, 9);
            assert!((mirrored - registration.coordinate(i, 9)).abs() < 1e-15, "{registration:?} {i}");
        }
    }
}

#[test]
fn halves_have_ends_of_their_own() {
    let axis = |reversed| AxisReading::new(Scale::IorBothSides, Registration::Endpoint, reversed);
    let nodes = [0, 15, 16, 31].map(|i| axis(false).node(i, 32));
    assert_eq!(nodes, [0.4, 1.0, 1.0, 2.5]);
    for (reversed, i) in [false, true].into_iter().flat_map(|r| (0..32).map(move |i| (r, i))) {
        let own = axis(reversed);
        let back = own.position(own.coordinate(i, 32), 32, Registration::Endpoint);
        // Both halves have the index 1.
        let same = (own.node(i, 32) - 1.0).abs() < 1e-12 && (back - i as f64).abs() < 1.0 + 1e-12;
        assert!(same || (back - i as f64).abs() < 1e-12, "{reversed} {i}: {back}");
    }
}

#[test]
fn scales_lead_to_their_inputs() {
    for scale in SCALES {
        assert!((0.0..=1.0).contains(&scale.input_at(0.4)) || scale.input() == Input::Ior, "{scale:?}");
    }
    assert!((Scale::FourthRootF0.input_at(0.04_f64.sqrt().sqrt()) - 1.5).abs() < 1e-12);
    assert_eq!(Scale::Theta.input_at(1.0), 0.0);
}

/// A reader counts along the texels: a falling axis at left edges is a rising one at right edges.
#[test]
fn a_falling_axis_is_shifted_the_other_way() {
    for (registration, word) in [
        (Registration::Left, "along y, compute texel i at (i + 1/2)/n, or sample at u + 1/(2n)"),
        (Registration::Right, "along y, compute texel i at (i + 1/2)/n, or sample at u - 1/(2n)"),
        (Registration::OneHigh, "that of texel i + 1"),
        (Registration::OneLow, "that of texel i - 1"),
        (Registration::EndHigh, "that of texel i + 1"),
        (Registration::EndLow, "that of texel i - 1"),
    ] {
        for falling in [false, true] {
            let along = |y: usize| registration.coordinate(y, 24);
            let roughness = |y: usize| if falling { 1.0 - along(y) } else { along(y) };
            let mu = |x: usize| registration.plain().coordinate(x, 24).max(1e-4);
            let value = |x: usize, y: usize| both(Smith::Correlated, roughness(y) * roughness(y), mu(x)).0;
            let fixed = Fixed {
                axes: Some(vec![(Scale::Mu, false), (Scale::Roughness, falling)]),
                form: Form::find("correlated"),
                ..Fixed::default()
            };
            let found = run(&plane([24; 2], &[("0", &value)]), "ggx-reflection", &fixed);
            assert!(said(&found).contains(word), "{registration:?} {falling}: {}", said(&found));
        }
    }
}
