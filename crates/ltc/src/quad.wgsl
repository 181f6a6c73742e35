//! What a quadrilateral sends by a linearly transformed cosine (Heitz, Dupuy, Hill and Neubelt 2016), clipped to the horizon
//! without branches: of each edge the part above it, and the arc along it from where the outline goes down to where it comes up.

/// The angle of two directions over 2 pi times its sine, from the cosine and the square of the sine: within 6e-7 of itself, a
/// weighted least-squares fit. Near opposite directions the sine has digits that the cosine has not.
fn ltc_arc(cosine: f32, square: f32) -> f32 {
    let x = abs(cosine);
    let near = (0.86384606 + x * (0.4981476 + x * 0.014316445)) / (3.4553862 + x * (4.1922207 + x));
    return select(0.5 * inverseSqrt(max(square, 1e-24)) - near, near, cosine > 0.0);
}

/// The part of an edge of unit directions in the integral.
fn ltc_edge(a: vec3f, b: vec3f) -> f32 {
    let x = a.y * b.z - a.z * b.y;
    let y = a.z * b.x - a.x * b.z;
    let z = a.x * b.y - a.y * b.x;
    return z * ltc_arc(dot(a, b), x * x + y * y + z * z);
}

/// The direction of a, or where the edge to b crosses the horizon if a lies below it.
fn ltc_raised(a: vec3f, b: vec3f) -> vec3f {
    let t = select(a.z / (a.z - b.z), 0.0, a.z > 0.0);
    let place = a + t * (b - a);
    return place * inverseSqrt(max(dot(place, place), 1e-24));
}

/// The part of an edge above the horizon.
fn ltc_lit(a: vec3f, b: vec3f) -> f32 {
    let start = ltc_raised(a, b);
    let end = ltc_raised(b, a);
    return select(0.0, ltc_edge(start, end), max(a.z, b.z) > 0.0);
}

/// Where an edge from above goes below; else 0.
fn ltc_leaving(a: vec3f, b: vec3f) -> vec3f {
    let place = ltc_raised(b, a);
    return select(vec3f(0.0, 0.0, 0.0), place, min(a.z, select(1.0, -1.0, b.z > 0.0)) > 0.0);
}

// A corner where the lobe is a cosine.
fn taken(matrix: vec4f, corner: vec3f) -> vec3f {
    return vec3f(matrix.x * corner.x + matrix.z * corner.z, corner.y, matrix.y * corner.x + matrix.w * corner.z);
}

/// The share of a lobe's light within a quadrilateral of even radiance, clipped to the horizon. `matrix` is a texel of the lobe's
/// table; the corners, in turn, are (dot(c, t), dot(c, cross(n, t)), dot(c, n)) of the vectors c from the shaded point, with n the
/// normal and t the tangent towards the view.
fn ltc_quad(matrix: vec4f, p0: vec3f, p1: vec3f, p2: vec3f, p3: vec3f) -> f32 {
    let a = taken(matrix, p0);
    let b = taken(matrix, p1);
    let c = taken(matrix, p2);
    let d = taken(matrix, p3);
    let down_ab = ltc_leaving(a, b);
    let down_bc = ltc_leaving(b, c);
    let down_cd = ltc_leaving(c, d);
    let down_da = ltc_leaving(d, a);
    let up_ab = ltc_leaving(b, a);
    let up_bc = ltc_leaving(c, b);
    let up_cd = ltc_leaving(d, c);
    let up_da = ltc_leaving(a, d);
    let down = down_ab + down_bc + down_cd + down_da;
    let up = up_ab + up_bc + up_cd + up_da;
    let turn = down.x * up.y - down.y * up.x;
    let level = turn * ltc_arc(dot(down, up), turn * turn);
    return abs(ltc_lit(a, b) + ltc_lit(b, c) + ltc_lit(c, d) + ltc_lit(d, a) + level);
}
