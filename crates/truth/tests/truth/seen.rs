//! A sky by a lobe and by the one in its place: a disk of the radius that the quantity states about the
//! axis of the lobe is half of either.

use lobefit_math::ops::cos;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{AVERAGED_WIDTH, COATED_WIDTH, LIT_WIDTH, Quantity, RefractedWidth, Variant};

const DRAWN: usize = 1 << 14;

#[test]
fn half_of_either_lobe_lies_within_the_stated_cone() {
    let cases: [(&dyn Quantity, &[[f64; 4]]); 4] = [
        (&RefractedWidth, &[[0.16, 0.7, 1.5, 0.0], [0.04, 0.3, 1.3, 0.0]]),
        (&AVERAGED_WIDTH, &[[0.16, 0.7, 0.95, 0.0], [0.04, 0.9, 0.9, 0.0]]),
        (&LIT_WIDTH, &[[0.04, 0.7, 0.1, 0.0], [0.16, 0.4, 0.2, 0.0]]),
        (&COATED_WIDTH, &[[0.09, 0.8, 0.5, 1.5], [0.04, 0.5, 0.3, 1.3]]),
    ];
    for (quantity, places) in cases {
        let variant =
            Variant { smith: quantity.choices().first().map(|_| Default::default()), ..Variant::default() };
        for place in places {
            let inputs = quantity.inputs();
            let x = &place[..inputs.len()];
            let points = Points::new(inputs.iter().zip(x).map(|(input, x)| (input.name, vec![*x])));
            let outputs = [quantity.outputs()[0], "radius"];
            let found = quantity.truth(&variant, &points, &outputs, 1e-2).expect("a truth").columns;
            let [roughness, radius] = [found[0][0], found[1][0]];
            let sine = (1.0 - x[1] * x[1]).sqrt();
            let axis = if quantity.name() == "refracted-width" {
                let sine = sine / x[2];
                [-sine, 0.0, -(1.0 - sine * sine).sqrt()]
            } else {
                [-sine, 0.0, x[1]]
            };
            let disk = |light: [f64; 3]| {
                let cosine: f64 = (0..3).map(|k| light[k] * axis[k]).sum();
                f64::from(u8::from(cosine >= cos(radius)))
            };
            let seen = quantity.seen().expect("a lobe");
            let shares = [seen.shown(&variant, x, DRAWN, &disk), seen.in_place(roughness, x, DRAWN, &disk)];
            let shares = shares.map(|share| share.expect("a mean"));
            println!("{} {x:?}: {shares:?}", quantity.name());
            assert!(
                shares.iter().all(|share| (share - 0.5).abs() < 0.01),
                "{} {x:?}: {shares:?}",
                quantity.name()
            );
            let even = seen.shown(&variant, x, 256, &|_| 0.7).expect("a mean");
            assert!((even - 0.7).abs() < 1e-12);
            // Nothing is shown of no light at all.
            assert!(seen.shown(&variant, x, 0, &|_| 0.7).is_err());
        }
    }
    assert!(lobefit_truth::quantity::GGX_GLASS.seen().is_none());
}
