//! What the study of diffuse couplings found out.

use serde::Serialize;
use serde_json::Value;

use crate::study::coupling::surface::SurfaceRows;
use lobefit::report::Image;
use lobefit::report::Origin;

/// Couplings in a furnace and under an environment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CouplingStudy {
    /// What made it.
    pub origin: Origin,
    /// Whether it is of the reduced size, for tests.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub reduced: bool,
    /// What was asked: everything that the recipe hash covers.
    pub parameters: Value,
    /// White spheres in light of radiance 1 from everywhere.
    pub furnace: Vec<FurnaceStrip>,
    /// Spheres under the environment.
    pub lit: Vec<LitStrip>,
    /// The couplings of each specular lobe, the least visible difference first.
    pub rankings: Vec<Ranking>,
    /// What the names of lobes and couplings mean.
    pub meanings: Vec<Meaning>,
    /// Reciprocity, and rough metals by lobes and random walks.
    pub surfaces: SurfaceRows,
}

/// A name with its formula.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Meaning {
    /// Whether it is a specular lobe; else what couples a base to one.
    pub lobe: bool,
    /// The name.
    pub name: String,
    /// The formula.
    pub meaning: String,
}

/// Spheres in the furnace: one specular lobe and reflectance, a row for each coupling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FurnaceStrip {
    /// Specular lobe.
    pub lobe: String,
    /// Reflectance at normal incidence.
    pub f0: f64,
    /// Roughness of each column.
    pub roughness: Vec<f64>,
    /// Those of them that have a column of spheres.
    #[serde(skip)]
    pub drawn: Vec<f64>,
    /// The rows.
    pub rows: Vec<FurnaceStripRow>,
    /// Cosines at which `albedo` is given, increasing.
    #[serde(skip)]
    pub mu: Vec<f64>,
    /// Whether the page shows its spheres, and not only its figures.
    #[serde(skip)]
    pub shown: bool,
}

/// One coupling in the furnace.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FurnaceStripRow {
    /// Coupling.
    pub name: String,
    /// Signed departure of the albedo from 1 with the largest magnitude over mu, by roughness.
    pub worst: Vec<f64>,
    /// `albedo[column][k]` at `mu[k]`.
    #[serde(skip)]
    pub albedo: Vec<Vec<f64>>,
}

/// Spheres under the environment: one specular lobe and reflectance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LitStrip {
    /// Specular lobe.
    pub lobe: String,
    /// Reflectance at normal incidence.
    pub f0: f64,
    /// Roughness of each column.
    pub roughness: Vec<f64>,
    /// Relative noise of the reference (root mean square error of a channel over the root mean
    /// square channel), by roughness.
    pub noise: Vec<f64>,
    /// HDR-FLIP between the reference's two halves, by roughness: twice the noise that its picture
    /// has, and far more than what is left of it between two pictures under the same directions.
    pub flip_of_noise: Vec<f64>,
    /// The rows; the reference is the first and differs from itself by nothing.
    pub rows: Vec<LitRow>,
    /// Whether the page shows its pictures, and not only its figures.
    #[serde(skip)]
    pub shown: bool,
}

/// One coupling under the environment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LitRow {
    /// Coupling.
    pub name: String,
    /// Mean HDR-FLIP against the reference over the pixels of the sphere, by roughness.
    pub flip: Vec<f64>,
    /// The same against the reciprocal reference.
    pub flip_reciprocal: Vec<f64>,
    /// Half the difference between the two halves' `flip`: its standard error, by roughness.
    pub error: Vec<f64>,
    /// The spheres as shown, linear RGB in [0, 1]; none of a row without pictures.
    #[serde(skip)]
    pub pictures: Vec<Image>,
    /// HDR-FLIP of each pixel, by roughness.
    #[serde(skip)]
    pub maps: Vec<Vec<f64>>,
}

/// The couplings under one specular lobe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ranking {
    /// Specular lobe.
    pub lobe: String,
    /// Reflectances that it is made over.
    pub f0: Vec<f64>,
    /// The couplings, by rising `flip`.
    pub rows: Vec<Ranked>,
}

/// A coupling by three measures over the same reflectances.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ranked {
    /// Coupling.
    pub name: String,
    /// Largest |f(l, v) - f(v, l)| of the base over the mean of their sizes, over the roughnesses
    /// and reflectances of the ranking: rounding if it is reciprocal, 2 at most.
    pub reciprocity: f64,
    /// Whether the diffuse base needs the light's direction too.
    pub directional: bool,
    /// Whether its constants were fitted here.
    pub ours: bool,
    /// Operations of a channel that it adds to the lobe's and to the bare sum of lobe and base.
    pub ops: u32,
    /// Texels that lobe and coupling read.
    pub fetches: u32,
    /// Mean HDR-FLIP under the environment.
    pub flip: f64,
    /// Its standard error, that of the spheres on average: all are lit from the same directions, so
    /// that their errors do not average out.
    pub flip_error: f64,
    /// Mean HDR-FLIP against the reciprocal reference.
    pub flip_reciprocal: f64,
    /// Largest departure from white in the furnace, over all of its roughnesses.
    pub furnace_max: f64,
    /// Root mean square departure under the weight of `fit --weight perceptual`.
    pub perceptual: f64,
}
