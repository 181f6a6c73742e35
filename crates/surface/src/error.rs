//! What can go wrong with a surface.

use lobefit_shade::ShadeError;
use lobefit_truth::integrate::IntegrateError;

/// Why there is no surface or no measure of it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// A property out of range, albedos of another lobe, a rule that does not settle, nothing to measure.
    #[error("surface{0}")]
    Refused(String),
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
    /// A formula whose cost is counted does not parse, a defect of this program.
    #[error("surface: {0}")]
    Formula(Box<ShadeError>),
    /// A truth that a measure compares with cannot be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
}
