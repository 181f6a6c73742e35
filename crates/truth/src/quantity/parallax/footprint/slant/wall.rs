//! The wall in coordinates that resolve every lobe.

use std::f64::consts::PI;
use std::sync::OnceLock;

use super::geometry::Slant;
use crate::optics::kernel::Lobe;
use lobefit_math::ops;
use lobefit_math::vector::{Vec3, dot};

/// How finely a wall is resolved.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Resolution {
    /// Step of ln R.
    pub step: f64,
    /// Angles in a turn, even.
    pub angles: usize,
}

impl Resolution {
    /// For searches.
    pub const COARSE: Resolution = Resolution { step: 0.16, angles: 48 };

    /// For figures: the total variation is then known to 1e-3, the H^-1 norm to 2e-3 of itself
    /// (tests).
    pub const FINE: Resolution = Resolution { step: 0.06, angles: 128 };
}

/// Rows of ln R start at this share of the footprint's narrow axis, inside which there is 1e-5 of
/// the energy.
const INNERMOST: f64 = 3e-3;

/// And end at so many of the larger distance, beyond which there is at most the share of the
/// horizon's energy that 1/300 of the height sees.
const OUTERMOST: f64 = 300.0;

/// The wall's places.
#[derive(Clone, Debug)]
pub struct Wall {
    resolution: Resolution,
    /// Angles kept: half a turn where the other half mirrors it.
    columns: usize,
    mirrored: bool,
    /// R of each row.
    radii: Vec<f64>,
    /// Cosine and sine of each column.
    angles: Vec<[f64; 2]>,
    modes: OnceLock<Modes>,
}

/// The modes of a turn.
#[derive(Clone, Debug)]
struct Modes {
    /// exp(-m step) of each mode, the last below half the angles.
    decays: Vec<f64>,
    /// `waves[m][j]`: share of column j in mode m; the sine modes follow where nothing is mirrored.
    waves: Vec<Vec<f64>>,
}

/// Energy per ln R and angle, row by row; whatever it sums to.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    /// The values.
    pub values: Vec<f64>,
}

/// Energy per area that a lobe about an axis from a place before the wall leaves at (x, y): K
/// cos(psi)/dist^2, cos(psi) = height/dist.
fn per_area(lobe: &Lobe, from: Vec3, axis: Vec3, [x, y]: [f64; 2]) -> f64 {
    let v = [x - from[0], y - from[1], -from[2]];
    let square = dot(v, v);
    let distance = square.sqrt();
    let cosine = dot(v, axis) / distance;
    if cosine <= 0.0 {
        return 0.0;
    }
    let u = ((1.0 - cosine) / (1.0 + cosine)).max(0.0);
    lobe.per_solid_angle(u) * from[2] / (square * distance)
}

impl Modes {
    fn new(resolution: Resolution, mirrored: bool) -> Modes {
        let count = resolution.angles;
        let columns = if mirrored { count / 2 } else { count };
        let turn = 2.0 * PI / count as f64;
        let modes = count / 2;
        let column = |j: usize| turn * (j as f64 + 0.5);
        let wave = |m: usize, sine: bool| -> Vec<f64> {
            // F_m = int F cos(m phi) dphi; by Parseval mode 0 counts once and the others twice
            let scale = turn * (if m == 0 { 1.0 } else { 2.0_f64 }).sqrt();
            let scale = if mirrored { 2.0 * scale } else { scale };
            let part = |(s, c): (f64, f64)| if sine { s } else { c };
            (0..columns).map(|j| scale * part(ops::sincos(m as f64 * column(j)))).collect()
        };
        let mut waves: Vec<Vec<f64>> = (0..modes).map(|m| wave(m, false)).collect();
        let mut decays: Vec<f64> = (0..modes).map(|m| ops::exp(-(m as f64) * resolution.step)).collect();
        if !mirrored {
            waves.extend((1..modes).map(|m| wave(m, true)));
            decays.extend_from_within(1..);
        }
        Modes { decays, waves }
    }
}

impl Wall {
    /// For lobes as narrow as `alpha` > 0 from the places of a slant.
    pub fn new(slant: &Slant, alpha: f64, resolution: Resolution) -> Wall {
        let (near, far) = (slant.shading.distance, slant.probe.distance);
        let (from, to) = (ops::log(INNERMOST * alpha * near), ops::log(OUTERMOST * near.max(far)));
        let rows = ((to - from) / resolution.step).ceil() as usize + 1;
        let mirrored = slant.mirrored();
        let count = resolution.angles;
        let columns = if mirrored { count / 2 } else { count };
        let turn = 2.0 * PI / count as f64;
        let column = |j: usize| turn * (j as f64 + 0.5);
        Wall {
            resolution,
            columns,
            mirrored,
            radii: (0..rows).map(|i| ops::exp(from + resolution.step * i as f64)).collect(),
            angles: (0..columns).map(|j| ops::sincos(column(j))).map(|(s, c)| [c, s]).collect(),
            modes: OnceLock::new(),
        }
    }

    fn modes(&self) -> &Modes {
        self.modes.get_or_init(|| Modes::new(self.resolution, self.mirrored))
    }

    /// What a lobe about an axis from a place before the wall leaves on it.
    pub fn footprint(&self, lobe: &Lobe, from: Vec3, axis: Vec3) -> Footprint {
        let mut values = Vec::with_capacity(self.radii.len() * self.columns);
        for radius in &self.radii {
            for [c, s] in &self.angles {
                let density = per_area(lobe, from, axis, [radius * c, radius * s]) * radius * radius;
                values.push(density);
            }
        }
        Footprint { values }
    }

    /// The integral over the wall.
    pub fn whole(&self, footprint: &Footprint) -> f64 {
        footprint.values.iter().sum::<f64>() * self.cell()
    }

    /// The integral of the absolute difference.
    pub fn variation(&self, f: &Footprint, g: &Footprint) -> f64 {
        f.values.iter().zip(&g.values).map(|(a, b)| (a - b).abs()).sum::<f64>() * self.cell()
    }

    /// Root mean square difference, largest difference, root mean square of `f` and largest `f`,
    /// all per wall area.
    pub fn per_area(&self, f: &Footprint, g: &Footprint) -> [f64; 4] {
        let mut out = [0.0_f64; 4];
        let rows = f.values.chunks(self.columns).zip(g.values.chunks(self.columns));
        for ((a, b), radius) in rows.zip(&self.radii) {
            let area = radius * radius;
            for (a, b) in a.iter().zip(b) {
                // dA = R^2 d ln R dphi
                out[0] += (a - b) * (a - b) / area;
                out[1] = out[1].max((a - b).abs() / area);
                out[2] += a * a / area;
                out[3] = out[3].max(a.abs() / area);
            }
        }
        [(out[0] * self.cell()).sqrt(), out[1], (out[2] * self.cell()).sqrt(), out[3]]
    }

    /// Numbers whose squares sum to 2 pi times the square of the H^-1 norm of a footprint, int
    /// (encircled energy)^2 d ln R of a round one; linear in it.
    pub fn whitened(&self, footprint: &Footprint) -> Vec<f64> {
        let (step, Modes { decays, waves }) = (self.resolution.step, self.modes());
        let modes = waves.len();
        let mut out = Vec::with_capacity(self.radii.len() * modes);
        let (mut last, mut average) = (vec![0.0; modes], vec![0.0; modes]);
        for row in footprint.values.chunks(self.columns) {
            for (m, wave) in waves.iter().enumerate() {
                let now: f64 = row.iter().zip(wave).map(|(f, w)| f * w).sum();
                average[m] = decays[m] * (average[m] + 0.5 * step * last[m]) + 0.5 * step * now;
                last[m] = now;
                out.push(average[m] * step.sqrt());
            }
        }
        out
    }

    fn cell(&self) -> f64 {
        let turn = 2.0 * PI / self.resolution.angles as f64;
        self.resolution.step * turn * if self.mirrored { 2.0 } else { 1.0 }
    }
}
