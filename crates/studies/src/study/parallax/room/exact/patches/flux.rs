//! int G dphi along edges.
//!
//! An edge from a to b, seen from the place and with z along the axis, turns about it by dphi = (x
//! dy - y dx)/(x^2 + y^2), whose numerator is constant along it. G dphi has poles in the complex
//! plane where x^2 + y^2 = 0, or where x^2 + y^2 + z^2 = 0. E dphi has not the first ones but those
//! of E, where tan^2(theta/2) = -alpha^2, which is about x^2 + y^2 = -(2 alpha/(1 + alpha^2))^2
//! z^2. The sum S of the distances of a and b from a pole over the length of the edge is the larger
//! half-axis of the ellipse about the edge that runs through it, and Gauss's rule of n nodes is off
//! by some (S + sqrt(S^2 - 1))^-2n. An edge far from the axis is integrated by G; one near it by E,
//! whose integral is that of G less than the angle that the edge turns by; and one that is too long
//! for that as well is halved.

use std::f64::consts::PI;

use multiversion::multiversion;

use super::Fineness;
use lobefit_math::lanes::{F8, ln, sum};
use lobefit_math::ops;
use lobefit_math::vector::Vec3;

pub(super) use lobefit_math::lanes::LANES;

/// An edge between patches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub from: Vec3,
    pub to: Vec3,
    /// Radiance on its left less that on its right, seen from inside the room with the wall's first
    /// axis to the right; and the same of 1 where the room is not cut off and 0 where it is.
    pub jump: [f64; 4],
}

/// Edges side by side.
#[derive(Clone, Debug)]
pub(super) struct Block {
    from: [F8; 3],
    to: [F8; 3],
    jump: [F8; 4],
}

impl Block {
    /// Of at most [`LANES`] edges, one at least; what is left of the block is edges without a jump.
    pub fn new(edges: &[Edge]) -> Block {
        let lane = |value: fn(&Edge, usize) -> f64, i: usize| {
            std::array::from_fn(|l| edges.get(l).map_or_else(|| value(&edges[0], i), |edge| value(edge, i)))
        };
        let jump = |i: usize| std::array::from_fn(|l| edges.get(l).map_or(0.0, |edge| edge.jump[i]));
        Block {
            from: [0, 1, 2].map(|i| lane(|edge, i| edge.from[i], i)),
            to: [0, 1, 2].map(|i| lane(|edge, i| edge.to[i], i)),
            jump: [0, 1, 2, 3].map(jump),
        }
    }
}

/// A place, a frame about a lobe's axis, and the lobe.
pub(super) struct View {
    place: Vec3,
    frame: [Vec3; 3],
    outside: Outside,
    /// Square of the tangent at which E has its poles.
    pole2: f64,
    /// Least S of three nodes, and of two.
    wide: [f64; 2],
}

/// 1 - E of the cosine-weighted lobe over u = tan^2(theta/2) in [0, 1], by its closed form
/// `1 + a ln(A (1 + u)/(A + u)) + b u/(A + u)`; near A = 1, where that cancels, blended with its
/// limit, `((1 - u)/(1 + u))^2`.
struct Outside {
    a2: f64,
    a: f64,
    b: f64,
    limit: f64,
}

/// Above this A = alpha^2 the closed form is mixed with its limit: off by some 1e-7.
const NEAR_ONE: f64 = 0.999;

impl Outside {
    fn new(alpha: f64) -> Outside {
        let a2 = (alpha * alpha).min(NEAR_ONE);
        let limit = ((alpha * alpha - NEAR_ONE) / (1.0 - NEAR_ONE)).clamp(0.0, 1.0);
        let rest = 1.0 - a2;
        let (logarithm, rational) = (2.0 / (rest * rest), (1.0 + a2) / (rest * a2));
        let whole = logarithm * ops::log(2.0 * a2 / (1.0 + a2)) + rational / (1.0 + a2);
        Outside { a2, a: -logarithm / whole, b: -rational / whole, limit }
    }

    #[inline(always)]
    fn at(&self, u: &F8) -> F8 {
        let Outside { a2, a, b, limit } = *self;
        let (mut over, mut within) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            over[l] = 1.0 / (a2 + u[l]);
            within[l] = a2 * (1.0 + u[l]) * over[l];
        }
        let logs = ln(&within);
        let mut out = [0.0; LANES];
        for l in 0..LANES {
            let cosine = (1.0 - u[l]) / (1.0 + u[l]);
            out[l] = (1.0 - limit) * (1.0 + a * logs[l] + b * u[l] * over[l]) + limit * cosine * cosine;
        }
        out
    }
}

/// Nodes and weights of Gauss's rules of two and three nodes on [0, 1].
const TWO: [(f64, f64); 2] = [(0.211_324_865_405_187_13, 0.5), (0.788_675_134_594_812_9, 0.5)];
const THREE: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

impl View {
    pub fn new(place: Vec3, frame: [Vec3; 3], alpha: f64, fineness: Fineness) -> View {
        let wide = match fineness {
            Fineness::Usual => [3.0, 8.0],
            Fineness::Fine => [6.0, 32.0],
        };
        let pole = 2.0 * alpha / (1.0 + alpha * alpha);
        View { place, frame, outside: Outside::new(alpha), pole2: pole * pole, wide }
    }

    #[inline(always)]
    fn local(&self, at: &[F8; 3]) -> [F8; 3] {
        let mut out = [[0.0; LANES]; 3];
        let [p, q, r] = self.place;
        for axis in 0..3 {
            let [a, b, c] = self.frame[axis];
            for l in 0..LANES {
                out[axis][l] = a * (at[0][l] - p) + b * (at[1][l] - q) + c * (at[2][l] - r);
            }
        }
        out
    }
}

/// Ends in the frame of a view, in front of the place.
#[derive(Clone, Copy)]
struct Ends {
    a: [F8; 3],
    b: [F8; 3],
}

impl Ends {
    /// Cut off at z = 0; what is wholly behind is a point.
    #[inline(always)]
    fn clipped(&self) -> Ends {
        let (mut at, mut out) = ([0.0; LANES], *self);
        for l in 0..LANES {
            at[l] = self.a[2][l] / (self.a[2][l] - self.b[2][l]);
        }
        for i in 0..2 {
            for l in 0..LANES {
                let (a, b, az, bz) = (self.a[i][l], self.b[i][l], self.a[2][l], self.b[2][l]);
                let cut = a + at[l] * (b - a);
                let before = if az < 0.0 { cut } else { a };
                let after = if bz < 0.0 { cut } else { b };
                let front = if az > bz { az } else { bz };
                out.a[i][l] = if front > 0.0 { before } else { 1.0 };
                out.b[i][l] = if front > 0.0 { after } else { 1.0 };
            }
        }
        for l in 0..LANES {
            let (az, bz) = (self.a[2][l], self.b[2][l]);
            out.a[2][l] = if az > 0.0 { az } else { 0.0 };
            out.b[2][l] = if bz > 0.0 { bz } else { 0.0 };
        }
        out
    }

    /// The smaller S of the poles where x^2 + y^2 = -pole2 z^2 and where the length is 0; infinite
    /// of a point.
    #[inline(always)]
    fn wideness(&self, pole2: f64) -> F8 {
        let mut out = [0.0; LANES];
        for l in 0..LANES {
            let (ax, ay, az) = (self.a[0][l], self.a[1][l], self.a[2][l]);
            let (bx, by, bz) = (self.b[0][l], self.b[1][l], self.b[2][l]);
            let (a2, b2) = (ax * ax + ay * ay, bx * bx + by * by);
            let way = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
            let deep = way + (bz - az) * (bz - az);
            let middle = 0.25 * pole2 * (az + bz) * (az + bz);
            let flat = ((a2 + middle).sqrt() + (b2 + middle).sqrt()) / way.sqrt();
            let solid = ((a2 + az * az).sqrt() + (b2 + bz * bz).sqrt()) / deep.sqrt();
            out[l] = if flat < solid { flat } else { solid };
        }
        out
    }

    /// The integral of G dphi by a rule; or, where `inside`, that of -E dphi.
    #[inline(always)]
    fn along(&self, outside: &Outside, rule: &[(f64, f64)], inside: f64) -> F8 {
        let (mut turn, mut out) = ([0.0; LANES], [0.0; LANES]);
        let (a, b) = (&self.a, &self.b);
        for l in 0..LANES {
            turn[l] = a[0][l] * b[1][l] - a[1][l] * b[0][l];
        }
        for &(at, weight) in rule {
            let (mut u, mut over) = ([0.0; LANES], [0.0; LANES]);
            for l in 0..LANES {
                let x = a[0][l] + at * (b[0][l] - a[0][l]);
                let y = a[1][l] + at * (b[1][l] - a[1][l]);
                let z = a[2][l] + at * (b[2][l] - a[2][l]);
                let flat = x * x + y * y;
                let whole = (flat + z * z).sqrt() + z;
                let square = flat / (whole * whole);
                u[l] = if square < 1.0 { square } else { 1.0 };
                over[l] = weight * turn[l] / flat;
            }
            let outside = outside.at(&u);
            for l in 0..LANES {
                out[l] += over[l] * (outside[l] - inside);
            }
        }
        out
    }
}

/// An edge that is not far enough from the axis for a rule.
#[derive(Clone, Copy)]
struct Near {
    a: Vec3,
    b: Vec3,
    jump: [f64; 4],
}

impl Near {
    fn of(ends: &Ends, jump: &[F8; 4], lane: usize) -> Near {
        let of = |x: &[F8; 3]| [x[0][lane], x[1][lane], x[2][lane]];
        Near { a: of(&ends.a), b: of(&ends.b), jump: [0, 1, 2, 3].map(|c| jump[c][lane]) }
    }

    /// The angle that it turns by.
    fn turn(&self) -> f64 {
        let ([ax, ay, _], [bx, by, _]) = (self.a, self.b);
        ops::atan2(ax * by - ay * bx, ax * bx + ay * by)
    }

    fn halves(&self) -> [Near; 2] {
        let Near { a, b, jump } = *self;
        let middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
        [Near { a, b: middle, jump }, Near { a: middle, b, jump }]
    }
}

/// Halvings of an edge at most: an edge 10 m long is then shorter than 1e-12 of that.
const MOST_HALVINGS: u32 = 40;

/// The sum over edges of their jumps times int G dphi/(2 pi). With the instructions that the
/// processor has: nothing is contracted, so that all give the same bits.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt",
    "x86_64+avx+avx2+bmi1+bmi2+f16c+fma+lzcnt+movbe+popcnt"
))]
pub(super) fn total(blocks: &[Block], view: &View) -> [f64; 4] {
    let mut sums = [[0.0; LANES]; 4];
    let mut near = Vec::new();
    for block in blocks {
        let (a, b) = (view.local(&block.from), view.local(&block.to));
        if (0..LANES).all(|l| a[2][l] <= 0.0 && b[2][l] <= 0.0) {
            continue;
        }
        let ends = Ends { a, b }.clipped();
        let wide = ends.wideness(0.0);
        let least = wide.iter().copied().fold(f64::INFINITY, f64::min);
        let rule: &[(f64, f64)] = if least < view.wide[1] { &THREE } else { &TWO };
        let mut turned = ends.along(&view.outside, rule, 0.0);
        if least < view.wide[0] {
            for l in (0..LANES).filter(|l| wide[*l] < view.wide[0]) {
                turned[l] = 0.0;
                near.push(Near::of(&ends, &block.jump, l));
            }
        }
        add(&mut sums, &block.jump, &turned);
    }
    let mut halvings = 0;
    while !near.is_empty() {
        let mut halves = Vec::new();
        for edges in near.chunks(LANES) {
            let (ends, jump) = beside(edges);
            let [far, wide] = [0.0, view.pole2].map(|pole2| ends.wideness(pole2));
            let mut turned = ends.along(&view.outside, &THREE, 0.0);
            let inside = ends.along(&view.outside, &THREE, 1.0);
            for (l, edge) in edges.iter().enumerate() {
                if far[l] >= view.wide[0] {
                    continue;
                }
                if wide[l] < view.wide[0] && halvings < MOST_HALVINGS {
                    turned[l] = 0.0;
                    halves.extend(edge.halves());
                } else {
                    turned[l] = inside[l] + edge.turn();
                }
            }
            add(&mut sums, &jump, &turned);
        }
        (near, halvings) = (halves, halvings + 1);
    }
    [0, 1, 2, 3].map(|c| sum(&sums[c]) / (2.0 * PI))
}

/// Edges side by side, at most [`LANES`]; what is left is points without a jump.
fn beside(edges: &[Near]) -> (Ends, [F8; 4]) {
    let (mut ends, mut jump) = (Ends { a: [[1.0; LANES]; 3], b: [[1.0; LANES]; 3] }, [[0.0; LANES]; 4]);
    for (l, edge) in edges.iter().enumerate() {
        for i in 0..3 {
            (ends.a[i][l], ends.b[i][l]) = (edge.a[i], edge.b[i]);
        }
        (0..4).for_each(|c| jump[c][l] = edge.jump[c]);
    }
    (ends, jump)
}

#[inline(always)]
fn add(sums: &mut [F8; 4], jump: &[F8; 4], turned: &F8) {
    for c in 0..4 {
        for l in 0..LANES {
            sums[c][l] += jump[c][l] * turned[l];
        }
    }
}
