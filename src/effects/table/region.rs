//! The region in which a table must hold.

use std::collections::BTreeMap;

use super::{BuildError, Point};
use crate::approximate;
use crate::data::AlphaMap;

/// What the slices of a table lie along, after mu along its columns and roughness along its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SliceAxis {
    /// Anisotropy a in [0, 1]: aspect = sqrt(1 - 0.9 a), alpha_x = alpha/aspect, alpha_y = alpha
    /// aspect (Burley 2012).
    Anisotropy,
    /// Index of refraction, inside over outside.
    Ior,
}

impl SliceAxis {
    /// Its name in axes, certificates and arguments.
    pub fn name(self) -> &'static str {
        match self {
            SliceAxis::Anisotropy => "anisotropy",
            SliceAxis::Ior => "ior",
        }
    }

    /// Its value in a point.
    pub(super) fn of_mut(self, point: &mut Point) -> &mut f32 {
        match self {
            SliceAxis::Anisotropy => &mut point.anisotropy,
            SliceAxis::Ior => &mut point.ior,
        }
    }

    /// Its value at a point.
    pub fn of(self, point: &Point) -> f32 {
        match self {
            SliceAxis::Anisotropy => point.anisotropy,
            SliceAxis::Ior => point.ior,
        }
    }
}

/// The slices of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slices {
    /// The axis.
    pub axis: SliceAxis,
    /// Its range: of the anisotropy in [0, 1], of the index of refraction in [1, 3].
    pub range: [f64; 2],
}

/// Ranges of the inputs, and how roughness becomes alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Roughness, inside [0, 1].
    pub roughness: [f64; 2],
    /// Cosine of the view, inside [0, 1].
    pub mu: [f64; 2],
    /// What the slices span, where there are any.
    pub slices: Option<Slices>,
    /// The anisotropy of tables that have it beside other slices.
    pub anisotropy: Option<[f64; 2]>,
    /// Roughness to alpha.
    pub alpha_map: AlphaMap,
}

impl Region {
    /// Roughness and mu alone.
    pub fn flat(&self) -> approximate::Region {
        approximate::Region { roughness: self.roughness, mu: self.mu, alpha_map: self.alpha_map }
    }

    /// Range of alpha, to nine digits.
    pub fn alpha(&self) -> [f64; 2] {
        self.flat().alpha()
    }

    /// The slices.
    ///
    /// # Errors
    /// None, where a table with slices is made: a defect of the effect.
    pub fn slices(&self) -> Result<Slices, BuildError> {
        self.slices.ok_or(BuildError::Slices)
    }

    /// What the points of a table have in common: of slices the first value, the only one where no axis spans
    /// them.
    pub(super) fn in_common(&self) -> Point {
        let mut point = Point::default();
        if let Some(Slices { axis, range: [first, _] }) = self.slices {
            *axis.of_mut(&mut point) = first as f32;
        }
        point
    }

    /// The region by input, as certificates state it.
    pub fn ranges(&self) -> BTreeMap<String, [f64; 2]> {
        let inputs = [("alpha", self.alpha()), ("mu", self.mu), ("roughness", self.roughness)];
        let slices = self.slices.map(|slices| (slices.axis.name(), slices.range));
        let beside = self.anisotropy.map(|range| (SliceAxis::Anisotropy.name(), range));
        let phi = beside.map(|_| ("phi", [0.0, std::f64::consts::FRAC_PI_2]));
        inputs
            .into_iter()
            .chain(slices)
            .chain(beside)
            .chain(phi)
            .map(|(name, range)| (name.to_string(), range))
            .collect()
    }
}

impl From<approximate::Region> for Region {
    fn from(flat: approximate::Region) -> Region {
        let approximate::Region { roughness, mu, alpha_map } = flat;
        Region { roughness, mu, slices: None, anisotropy: None, alpha_map }
    }
}

/// aspect = sqrt(alpha_y/alpha_x) of an anisotropy in [0, 1].
pub fn aspect(anisotropy: f64) -> f64 {
    (1.0 - 0.9 * anisotropy).sqrt()
}
