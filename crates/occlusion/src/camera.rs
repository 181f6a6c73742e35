//! A pinhole camera: metres, z up in the world; in the view x right, y down, z ahead.

use lobefit_math::ops::{cos, sin};

/// A place or a displacement.
pub type Place = [f32; 3];

/// Depth below which nothing is drawn, projected or tested.
pub const NEAR: f32 = 0.1;

/// Where it is and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Its place.
    pub eye: Place,
    /// Right, down and ahead, of unit length.
    pub axes: [Place; 3],
    /// Tangents of half the field of view across and down.
    pub tangents: [f32; 2],
}

/// a . b
pub fn dot(a: Place, b: Place) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Camera {
    /// At a place, turned by yaw from the x axis towards y and by pitch upwards (radians), 90
    /// degrees wide, of the shape of a buffer.
    pub fn new(eye: Place, [yaw, pitch]: [f64; 2], size: [usize; 2]) -> Camera {
        let ([sy, cy], [sp, cp]) = ([sin(yaw), cos(yaw)], [sin(pitch), cos(pitch)]);
        let right = [sy, -cy, 0.0];
        let ahead = [cp * cy, cp * sy, sp];
        let down = [sp * cy, sp * sy, -cp];
        let axes = [right, down, ahead].map(|axis| axis.map(|x| x as f32));
        Camera { eye, axes, tangents: [1.0, size[1] as f32 / size[0] as f32] }
    }

    /// A place in the view.
    pub fn view(&self, place: Place) -> Place {
        let away = [0, 1, 2].map(|k| place[k] - self.eye[k]);
        self.axes.map(|axis| dot(axis, away))
    }

    /// Pixels of a place in the view; none nearer than [`NEAR`], behind, or not finite.
    pub fn pixel(&self, view: Place, size: [usize; 2]) -> Option<[f32; 2]> {
        // Written so that what is not a number is refused.
        let ahead = view[2] >= NEAR && view.iter().all(|x| x.is_finite());
        ahead.then(|| [0, 1].map(|k| (view[k] / (view[2] * self.tangents[k]) + 1.0) * 0.5 * size[k] as f32))
    }

    /// The displacement to depth 1 through the corner of pixel 0, and its steps by a pixel across
    /// and down: in the world.
    pub fn rays(&self, size: [usize; 2]) -> [Place; 3] {
        let [right, down, ahead] = self.axes;
        let [tx, ty] = self.tangents;
        let step = [2.0 * tx / size[0] as f32, 2.0 * ty / size[1] as f32];
        [
            [0, 1, 2].map(|k| ahead[k] - tx * right[k] - ty * down[k]),
            right.map(|x| x * step[0]),
            down.map(|x| x * step[1]),
        ]
    }
}
