//! Finer and finer rules, until a value is known as well as it is asked for.

use super::IntegrateError;

/// What is asked for: the quantity and the place are named by errors alone.
pub(crate) struct Goal<'a> {
    /// The quantity.
    pub quantity: &'static str,
    /// Writes the place.
    pub place: &'a dyn Fn() -> String,
    /// Largest error.
    pub tolerance: f64,
}

impl Goal<'_> {
    /// The first value of a ladder of rules whose error is within the tolerance. `bounded` makes it, with its
    /// error, of what two rules give that follow each other; none where that is not finite.
    pub fn climb<R, V, T>(
        &self,
        ladder: impl IntoIterator<Item = R>,
        by: impl Fn(R) -> Result<V, IntegrateError>,
        bounded: impl Fn(&V, &V) -> Option<(T, f64)>,
    ) -> Result<T, IntegrateError> {
        let &Goal { quantity, place, tolerance } = self;
        let (mut coarse, mut reached) = (None, f64::INFINITY);
        for rule in ladder {
            let fine = by(rule)?;
            if let Some(coarse) = coarse {
                let not_finite = || IntegrateError::NotFinite { quantity, place: place() };
                let (value, error) = bounded(&coarse, &fine).ok_or_else(not_finite)?;
                if error <= tolerance {
                    return Ok(value);
                }
                reached = error;
            }
            coarse = Some(fine);
        }
        Err(IntegrateError::Tolerance { quantity, place: place(), reached, tolerance })
    }
}
