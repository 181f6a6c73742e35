//! The colour spaces of FLIP, and the distance in the last of them.

use lobefit_math::ops;

/// xy of the primaries of sRGB.
const PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];

/// xy of the white D65 to the five digits that FLIP's authors use.
const WHITE: [f64; 2] = [0.31271, 0.32902];

/// Linear RGB to XYZ, and back.
const TO_XYZ: [[f64; 3]; 3] = to_xyz();
const TO_RGB: [[f64; 3]; 3] = inverse(TO_XYZ);

/// XYZ of white.
const WHITE_XYZ: [f64; 3] = point(WHITE);

/// Exponent that compresses large colour differences, q_c; where the differences are cut, p_c of
/// the largest, and what is left of the scale below, p_t (2020, section 4.1.2).
const COMPRESSION: f64 = 0.7;
const CUT: f64 = 0.4;
const BELOW_CUT: f64 = 0.95;

const fn point([x, y]: [f64; 2]) -> [f64; 3] {
    [x / y, 1.0, (1.0 - x - y) / y]
}

/// The matrix whose columns are the primaries, scaled so that they add up to white.
const fn to_xyz() -> [[f64; 3]; 3] {
    let [r, g, b] = [point(PRIMARIES[0]), point(PRIMARIES[1]), point(PRIMARIES[2])];
    let columns = [[r[0], g[0], b[0]], [r[1], g[1], b[1]], [r[2], g[2], b[2]]];
    let scale = apply(inverse(columns), WHITE_XYZ);
    let mut out = columns;
    let mut i = 0;
    while i < 9 {
        out[i / 3][i % 3] *= scale[i % 3];
        i += 1;
    }
    out
}

/// Inverse by cofactors.
const fn inverse(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut cofactor = [[0.0; 3]; 3];
    let mut i = 0;
    while i < 9 {
        let (r, c) = (i / 3, i % 3);
        let (r1, r2, c1, c2) = ((r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3);
        cofactor[c][r] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        i += 1;
    }
    let determinant = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[1][0] + m[0][2] * cofactor[2][0];
    let mut i = 0;
    while i < 9 {
        cofactor[i / 3][i % 3] /= determinant;
        i += 1;
    }
    cofactor
}

const fn apply(m: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    [
        m[0][0] * v[0] + m[0][1] * v[1] + m[0][2] * v[2],
        m[1][0] * v[0] + m[1][1] * v[1] + m[1][2] * v[2],
        m[2][0] * v[0] + m[2][1] * v[1] + m[2][2] * v[2],
    ]
}

/// Linear RGB to YCxCz, the linearised L*a*b* in which the eye's blur is applied.
pub(super) fn opponent(rgb: [f64; 3]) -> [f64; 3] {
    let xyz = apply(TO_XYZ, rgb);
    let [x, y, z] = [xyz[0] / WHITE_XYZ[0], xyz[1] / WHITE_XYZ[1], xyz[2] / WHITE_XYZ[2]];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// YCxCz to linear RGB.
fn rgb([luma, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (luma + 16.0) / 116.0;
    apply(TO_RGB, [(y + cx / 500.0) * WHITE_XYZ[0], y, (y - cz / 200.0) * WHITE_XYZ[2]])
}

/// Slope of L*'s linear foot and its end (CIE 15:2004).
const FOOT: f64 = 6.0 / 29.0;

/// Linear RGB to L*a*b*, with a* and b* after Hunt: less colour where there is less light.
fn perceived(rgb: [f64; 3]) -> [f64; 3] {
    let xyz = apply(TO_XYZ, rgb);
    let f = |i: usize| {
        let t = xyz[i] / WHITE_XYZ[i];
        if t > FOOT * FOOT * FOOT { ops::cbrt(t) } else { t / (3.0 * FOOT * FOOT) + 4.0 / 29.0 }
    };
    let (x, y, z) = (f(0), f(1), f(2));
    let lightness = 116.0 * y - 16.0;
    [lightness, 5.0 * lightness * (x - y), 2.0 * lightness * (y - z)]
}

/// HyAB: lightness apart from colour.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (da, db) = (a[1] - b[1], a[2] - b[2]);
    (a[0] - b[0]).abs() + (da * da + db * db).sqrt()
}

/// The perceived colour of a blurred pixel of YCxCz.
pub(super) fn seen(pixel: [f64; 3]) -> [f64; 3] {
    perceived(rgb(pixel).map(|x| x.clamp(0.0, 1.0)))
}

/// The difference in colour of two pixels as [`seen`], in [0, 1], where [`largest`] is given (2020,
/// section 4.1).
pub(super) fn difference(reference: [f64; 3], test: [f64; 3], largest: f64) -> f64 {
    let d = ops::pow(distance(reference, test), COMPRESSION);
    let cut = CUT * largest;
    if d < cut { BELOW_CUT / cut * d } else { BELOW_CUT + (d - cut) / (largest - cut) * (1.0 - BELOW_CUT) }
}

/// The compressed distance of green and blue, the largest there is.
pub(super) fn largest() -> f64 {
    ops::pow(distance(perceived([0.0, 1.0, 0.0]), perceived([0.0, 0.0, 1.0])), COMPRESSION)
}
