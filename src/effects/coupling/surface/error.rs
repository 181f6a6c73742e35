//! What can go wrong with a surface.

use crate::effects::BakeError;
use lobefit_shade::ShadeError;
use lobefit_truth::integrate::IntegrateError;

/// Why there is no surface or no measure of it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// A property of the material lies outside its range or is not a number.
    #[error("surface: {input} = {value:?} is outside [{:?}, {:?}]", range[0], range[1])]
    Domain {
        /// Property of the material, or input of a measure.
        input: &'static str,
        /// Its value.
        value: f64,
        /// Its range.
        range: [f64; 2],
    },
    /// A value came out NaN or infinite.
    #[error("surface at alpha = {alpha:?}, mu = {mu:?}: the {what} is not finite")]
    NotFinite {
        /// What was computed.
        what: &'static str,
        /// GGX alpha.
        alpha: f64,
        /// Cosine of the view.
        mu: f64,
    },
    /// Albedos of another lobe were handed in.
    #[error("surface: the material has {property} {wanted}, the albedos handed in are for {found}")]
    Albedos {
        /// What differs.
        property: &'static str,
        /// The material's.
        wanted: String,
        /// That of the albedos.
        found: String,
    },
    /// A formula for the factor of the base that does not fit.
    #[error("surface: the formula {name} has {what} {found}, wanted: {wanted}")]
    Factor {
        /// Its name.
        name: String,
        /// What does not fit.
        what: String,
        /// What may be.
        wanted: String,
        /// What it has.
        found: String,
    },
    /// The hemispherical rule does not settle.
    #[error(
        "surface at alpha = {alpha:?}, mu = {mu:?}: the furnace is known to {reached:e} only, not to {tolerance:e}"
    )]
    Tolerance {
        /// GGX alpha.
        alpha: f64,
        /// Cosine of the view.
        mu: f64,
        /// Error bound reached.
        reached: f64,
        /// Error bound wanted.
        tolerance: f64,
    },
    /// Nothing to measure.
    #[error("surface: the {what} is empty")]
    Empty {
        /// What.
        what: &'static str,
    },
    /// A formula whose cost is counted does not parse, a defect of this program.
    #[error("surface: {0}")]
    Formula(Box<ShadeError>),
    /// A truth that a measure compares with cannot be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
}

impl From<SurfaceError> for BakeError {
    fn from(error: SurfaceError) -> BakeError {
        BakeError::Effect(Box::new(error))
    }
}
