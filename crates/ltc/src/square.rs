//! The lights of the measurement: squares that face the shaded point, and what a lobe sends from
//! each, by quadrature.

use crate::lobe::{Lobe, View};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, cross, dot, normalise, plus, scaled};
use std::sync::LazyLock;

/// A square light: the directions `centre + x across + y along` with |x| and |y| at most `half`.
#[derive(Clone, Copy, Debug)]
pub struct Square {
    /// Direction of its middle.
    pub centre: Vec3,
    /// Level, at a right angle to the centre.
    pub across: Vec3,
    /// At right angles to both.
    pub along: Vec3,
    /// Half of its side, at distance 1.
    pub half: f64,
}

/// Half angles of the squares: some that every lobe has, and multiples of the lobe's own width.
const ANGLES: [f64; 3] = [0.1, 0.4, 1.2];
const WIDTHS: [f64; 3] = [0.5, 1.0, 2.0];

/// Where the mirror direction lies in a square, in half sides from its middle: along the plane of
/// incidence (a negative one has the square above it) and across.
const PLACES: [[f64; 2]; 5] = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [-1.0, 1.0]];

/// Squares of a view.
pub const PER_PLACE: usize = (ANGLES.len() + WIDTHS.len()) * PLACES.len();

/// A share of the lobe's light, with its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// The value.
    pub value: f64,
    /// How far off it may be.
    pub error: f64,
}

/// Nodes of a panel in the two rules: the first is the value, the second says how far off it is.
const NODES: [usize; 2] = [8, 5];
static RULES: LazyLock<[Gauss; 2]> = LazyLock::new(|| NODES.map(Gauss::new));

/// How panels grow away from the peak.
const GROWTH: f64 = 2.5;

/// Longest panel of Charlie's lobe, which is a ring along the horizon and not about the mirror
/// direction: at least, at most, and over the root of alpha, which the ring's width goes with.
const LONGEST: [f64; 3] = [0.2, 1.2, 1.2];

/// The squares of a view: six sizes, from half the lobe's width to more than half of the hemisphere,
/// each about the mirror direction, beside it with an edge or a corner on it, and above and below.
pub fn squares(view: &View) -> Vec<Square> {
    let own = width(view);
    let angles = ANGLES.into_iter().chain(WIDTHS.map(|times| (times * own).min(ANGLES[2])));
    let mirrored = view.mirrored();
    let at = move |angle: f64| {
        PLACES.map(|[along, across]| {
            let (s, c) = ops::sincos(along * angle);
            let [x, _, z] = mirrored;
            // towards the horizon on the far side by a positive angle
            let turned = [x * c - z * s, 0.0, z * c + x * s];
            let (s, c) = ops::sincos(across * angle);
            Square::facing(plus(scaled(turned, c), [0.0, s, 0.0]), ops::tan(angle))
        })
    };
    angles.flat_map(at).collect()
}

/// About half of the angle within which most of the lobe lies.
fn width(view: &View) -> f64 {
    match view.lobe {
        Lobe::Ggx(_) => (2.0 * view.alpha).min(0.8),
        Lobe::Charlie => 0.8,
    }
}

impl Square {
    /// That with this middle.
    pub fn facing(centre: Vec3, half: f64) -> Square {
        let level = [-centre[1], centre[0], 0.0];
        let across = if dot(level, level) > 1e-20 { normalise(level) } else { [0.0, 1.0, 0.0] };
        Square { centre, across, along: cross(centre, across), half }
    }

    /// Its corners.
    pub fn corners(&self) -> [Vec3; 4] {
        [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
            .map(|[x, y]| self.at(x * self.half, y * self.half))
    }

    fn at(&self, x: f64, y: f64) -> Vec3 {
        plus(self.centre, plus(scaled(self.across, x), scaled(self.along, y)))
    }

    /// The share of a lobe's light from it. The panels grow from the mirror direction, or from what
    /// is next to it; one of their ends is the horizon, which is level.
    pub fn share(&self, view: &View) -> Share {
        let mirrored = view.mirrored();
        let depth = dot(mirrored, self.centre);
        let place = |axis: Vec3| {
            let at = dot(mirrored, axis) / depth.max(1e-9);
            at.clamp(-self.half, self.half)
        };
        let fine = (0.5 * view.alpha).min(0.25);
        let longest = match view.lobe {
            Lobe::Ggx(_) => f64::INFINITY,
            Lobe::Charlie => (LONGEST[2] * view.alpha.sqrt()).clamp(LONGEST[0], LONGEST[1]),
        };
        let ends = [
            panels(place(self.across), [fine * view.mu.max(view.alpha), longest], self.half, None),
            panels(place(self.along), [fine, longest], self.half, self.horizon()),
        ];
        let [value, coarse] = RULES.each_ref().map(|rule| self.by(rule, &ends, view));
        Share { value, error: (value - coarse).abs() }
    }

    /// Where the horizon crosses it.
    fn horizon(&self) -> Option<f64> {
        let at = -self.centre[2] / self.along[2];
        (at.abs() < self.half).then_some(at)
    }

    fn by(&self, rule: &Gauss, [x, y]: &[Vec<f64>; 2], view: &View) -> f64 {
        let density = |x: f64, y: f64| {
            let light = self.at(x, y);
            let inverse = 1.0 / dot(light, light).sqrt();
            view.density(scaled(light, inverse)) * inverse * inverse * inverse
        };
        let over = |ends: &[f64], f: &mut dyn FnMut(f64) -> f64| {
            ends.windows(2).map(|end| rule.integrate(end[0], end[1], &mut *f)).sum::<f64>()
        };
        over(y, &mut |y| over(x, &mut |x| density(x, y)))
    }
}

/// Ends of panels between -half and half.
fn panels(peak: f64, [first, longest]: [f64; 2], half: f64, cut: Option<f64>) -> Vec<f64> {
    let mut ends = vec![-half, half, peak];
    ends.extend(cut);
    let mut reach = first;
    while reach < 2.0 * half {
        ends.extend([peak - reach, peak + reach].into_iter().filter(|at| at.abs() < half));
        reach = (reach * GROWTH).min(reach + longest);
    }
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    ends
}
