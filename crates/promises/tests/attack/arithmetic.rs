//! Functions of lanes and of directions beside their definitions.

use lobefit_math::lanes::{self, LANES};
use lobefit_math::vector;

use crate::Attack;
use crate::big::Big;

/// The coordinates of three numbers from a place.
fn at(x: &[Big], from: usize) -> [&Big; 3] {
    [&x[from], &x[from + 1], &x[from + 2]]
}

fn dot(a: [&Big; 3], b: [&Big; 3]) -> Big {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn of_lanes(attacks: &mut Vec<Attack>) {
    attacks.push(Attack::of(
        "math::lanes::exp",
        |x| vec![lanes::exp(&[x[0]; LANES])[3]],
        |x| vec![x[0].exp()],
    ));
    attacks.push(Attack::of("math::lanes::exp_of", |x| vec![lanes::exp_of(x[0])], |x| vec![x[0].exp()]));
    attacks.push(Attack::of("math::lanes::ln", |x| vec![lanes::ln(&[x[0]; LANES])[5]], |x| vec![x[0].ln()]));
    attacks.push(Attack::of(
        "math::lanes::sincos_turns",
        |x| {
            let (sines, cosines) = lanes::sincos_turns(&[x[0]; LANES]);
            vec![sines[4], cosines[4]]
        },
        |x| (2.0 * Big::pi() * x[0]).sin_cos().to_vec(),
    ));
    attacks.push(Attack::of(
        "math::lanes::sum",
        |x| vec![lanes::sum(&std::array::from_fn(|i| x[i]))],
        |x| vec![x.iter().fold(Big::from(0.0), |sum, x| sum + x)],
    ));
}

fn of_vectors(attacks: &mut Vec<Attack>) {
    let split = |x: &[f64]| ([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
    attacks.push(Attack::of(
        "math::vector::dot",
        move |x| vec![vector::dot(split(x).0, split(x).1)],
        |x| vec![dot(at(x, 0), at(x, 3))],
    ));
    attacks.push(Attack::of(
        "math::vector::cross",
        move |x| vector::cross(split(x).0, split(x).1).to_vec(),
        |x| {
            let of = |i: usize, j: usize| x[i] * x[3 + j] - x[j] * x[3 + i];
            vec![of(1, 2), of(2, 0), of(0, 1)]
        },
    ));
    attacks.push(Attack::of(
        "math::vector::length",
        |x| vec![vector::length([x[0], x[1], x[2]])],
        |x| vec![dot(at(x, 0), at(x, 0)).sqrt()],
    ));
    attacks.push(Attack::of(
        "math::vector::normalise",
        |x| vector::normalise([x[0], x[1], x[2]]).to_vec(),
        |x| {
            let length = dot(at(x, 0), at(x, 0)).sqrt();
            at(x, 0).map(|k| k / length).to_vec()
        },
    ));
    // Tangents of a direction that is drawn on the plane: each has length 1 and stands at right angles
    // to the others.
    attacks.push(Attack::of(
        "math::vector::tangents",
        |x| {
            let axis = vector::normalise([x[0], x[1], x[2]]);
            let [a, b] = vector::tangents(axis);
            [(a, a), (b, b), (a, b), (a, axis), (b, axis)].map(|(a, b)| vector::dot(a, b)).to_vec()
        },
        |_| [1.0, 1.0, 0.0, 0.0, 0.0].map(Big::from).to_vec(),
    ));
}

/// All of them.
pub fn attacks() -> Vec<Attack> {
    let mut all = Vec::new();
    of_lanes(&mut all);
    of_vectors(&mut all);
    all
}
