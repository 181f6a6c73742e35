//! Axes of tables: physical values, unit coordinates, and back in a shader's arithmetic.

use lobefit::data::{AlphaMap, Axis, Registration, Surface, Warp};
use lobefit_shade::Precision;

fn axis(name: &str, warp: Warp, min: f64, max: f64) -> Axis {
    Axis { name: name.into(), size: 32, registration: Registration::Endpoint, warp, min, max }
}

fn all() -> Vec<Axis> {
    vec![
        axis("roughness", Warp::Linear, 0.02, 1.0),
        axis("mu", Warp::Sqrt, 0.0, 1.0),
        axis("mu", Warp::Grazing, 1.0, 0.0),
        axis("mu", Warp::Homogeneous, 0.0, 1.0),
        axis("mu", Warp::HomogeneousIor, 0.0, 1.0),
        axis("mu", Warp::HomogeneousAzimuth, 0.0, 1.0),
        axis("anisotropy", Warp::Square, 0.0, 1.0),
        axis("ior", Warp::Ior, 1.0, 2.0),
        axis("ior", Warp::Ior, 1.05, 3.0),
        axis("anisotropy", Warp::Aspect, 0.0, 1.0),
        axis("anisotropy", Warp::Aspect, 0.2, 0.7),
    ]
}

fn surfaces() -> Vec<Surface<f64>> {
    let pairs = [0.0004, 0.02, 0.3, 1.0].map(|alpha| {
        [1.0, 1.001, 1.5, 3.0].map(|ior| {
            let (anisotropy, cos2_phi) = ((ior - 1.0) / 2.0, 1.0 / ior);
            Surface { alpha, ior, anisotropy, cos2_phi }
        })
    });
    pairs.into_iter().flatten().collect()
}

/// From a unit coordinate to the variable and, in a shader's arithmetic, back: within a
/// hundredth of a texel.
#[test]
fn a_lookup_finds_the_unit_coordinate_that_a_value_came_from() {
    for axis in all() {
        let coordinate = axis.coordinate().expect("it parses");
        for surface in surfaces() {
            for i in 0..=310 {
                let u = f64::from(i) / 310.0;
                let value = axis.physical(u, surface);
                let shader = Surface {
                    alpha: surface.alpha as f32,
                    ior: surface.ior as f32,
                    anisotropy: surface.anisotropy as f32,
                    cos2_phi: surface.cos2_phi as f32,
                };
                let found = f64::from(coordinate.at(
                    (value as f32).max(axis.min.min(axis.max) as f32),
                    shader,
                    Precision::F32,
                ));
                // ior is rounded by 6e-8, which next to 1 is itself a step of the axis.
                let tolerance = match value - axis.min {
                    excess if axis.warp != Warp::Ior || excess > 1e-4 => 0.01,
                    excess if excess > 1e-6 => 0.25,
                    _ => 3.0,
                };
                let texel = found * 32.0 - 0.5;
                assert!((texel - 31.0 * u).abs() < tolerance, "{axis:?} {surface:?} at {u}: {texel}");
            }
        }
    }
}

#[test]
fn the_ends_of_a_range_are_the_ends_of_its_axis_and_values_go_from_one_to_the_other() {
    for axis in all() {
        for surface in surfaces() {
            assert!((axis.physical(0.0, surface) - axis.min).abs() < 1e-12, "{axis:?} {surface:?}");
            assert!((axis.physical(1.0, surface) - axis.max).abs() < 1e-12, "{axis:?} {surface:?}");
            let nodes: Vec<f64> = (0..32).map(|i| axis.node(i, surface)).collect();
            let onward = (axis.max - axis.min).signum();
            assert!(
                nodes.windows(2).all(|w| onward * (w[1] - w[0]) > 0.0),
                "{axis:?} {surface:?}: {nodes:?}"
            );
        }
    }
}

#[test]
fn a_mirror_has_finite_coordinates() {
    for axis in all().into_iter().filter(|a| !matches!(a.warp, Warp::Homogeneous | Warp::HomogeneousAzimuth))
    {
        let surface = Surface::<f32>::rough(0.0);
        let value = (axis.min as f32).max(0.001);
        let coordinate = axis.coordinate().expect("it parses");
        assert!(coordinate.at(value, surface, Precision::F32).is_finite(), "{axis:?}");
    }
}

#[test]
fn formulas_name_their_range() {
    let formula = axis("ior", Warp::Ior, 1.0, 2.0).formula();
    assert!(formula.contains("sqrt(ior - 1)") && formula.contains("0.001 + 0.55 * sqrt(alpha)"), "{formula}");
    assert!(axis("anisotropy", Warp::Aspect, 0.0, 1.0).formula().contains("sqrt(1 - 0.9 * anisotropy)"));
}

#[test]
fn the_inverse_is_the_inverse() {
    for map in AlphaMap::ALL {
        for roughness in [0.0, 1e-3, 0.02, 0.3, 1.0] {
            let back = map.roughness(map.alpha(roughness));
            assert!((back - roughness).abs() <= 1e-15 * roughness, "{map:?}: {roughness} {back}");
        }
    }
}
