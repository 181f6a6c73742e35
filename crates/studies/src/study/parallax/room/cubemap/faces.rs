//! Directions and places on the faces of a cube, in the order and orientation of Direct3D, Vulkan
//! and OpenGL: +x, -x, +y, -y, +z, -z.

use lobefit_math::vector::{Vec3, dot, normalise, plus, scaled};

/// Of every face the direction to its centre, and those in which its coordinates s and t grow
/// (OpenGL 4.6, table 8.19).
const FACES: [[Vec3; 3]; 6] = [
    [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]],
    [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]],
    [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]],
    [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
    [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]],
];

/// The face that a direction of any length but 0 goes through, and where: s and t in [-1, 1].
/// Directions through an edge go to the axis that comes first.
pub fn face_of(towards: Vec3) -> (usize, [f64; 2]) {
    let magnitudes = towards.map(f64::abs);
    let axis = (1..3).fold(0, |best, i| if magnitudes[i] > magnitudes[best] { i } else { best });
    let face = 2 * axis + usize::from(towards[axis] < 0.0);
    let [_, s, t] = FACES[face];
    (face, [s, t].map(|along| dot(along, towards) / magnitudes[axis]))
}

/// The unit direction of a place of a face; s and t beyond [-1, 1] are on the plane of the face,
/// outside of it.
pub fn direction(face: usize, [s, t]: [f64; 2]) -> Vec3 {
    let [centre, along_s, along_t] = FACES[face];
    normalise(plus(centre, plus(scaled(along_s, s), scaled(along_t, t))))
}

/// Centre of texel `i` of `n`, which may be -1 or `n`: a texel's width outside of the face.
pub(super) fn centre(i: isize, n: usize) -> f64 {
    (2.0 * i as f64 + 1.0) / n as f64 - 1.0
}
