//! The pages of a formula that was fitted and of a search.

mod findings;
mod fit;
mod search;

pub use findings::{FitCard, FitPage, FitSlice, SearchPage, SearchRow, SliceCurve};

use lobefit::report::{ReportError, html};

/// The page of a formula that the user fits, as HTML.
///
/// # Errors
/// Data that is not finite, empty where it must not be, or of mismatched size, by section and
/// field.
pub fn fit_page(findings: &FitPage) -> Result<String, ReportError> {
    Ok(html(&fit::page(findings)?))
}

/// The page of a search over forms, as HTML.
///
/// # Errors
/// As [`fit_page`].
pub fn search_page(findings: &SearchPage) -> Result<String, ReportError> {
    Ok(html(&search::page(findings)?))
}
