//! Checks shared by the figures: each names the section and the field that fails.

use crate::ReportError;

/// Every value is finite and there is at least one.
pub fn values(section: &str, field: &str, values: &[f64]) -> Result<(), ReportError> {
    filled(section, field, values.len())?;
    match values.iter().position(|v| !v.is_finite()) {
        Some(i) => Err(not_finite(section, &format!("{field}[{i}]"))),
        None => Ok(()),
    }
}

/// The value is finite.
pub fn finite(section: &str, field: &str, value: f64) -> Result<(), ReportError> {
    if value.is_finite() { Ok(()) } else { Err(not_finite(section, field)) }
}

/// A list has at least one entry.
pub fn filled(section: &str, field: &str, len: usize) -> Result<(), ReportError> {
    if len > 0 {
        return Ok(());
    }
    Err(ReportError::Empty { section: section.into(), field: field.into() })
}

/// A list has the expected number of entries.
pub fn size(section: &str, field: &str, found: usize, expected: usize) -> Result<(), ReportError> {
    if found == expected {
        return Ok(());
    }
    Err(ReportError::Size { section: section.into(), field: field.into(), found, expected })
}

/// Values are finite, non-empty and strictly increasing.
pub fn increasing(section: &str, field: &str, list: &[f64]) -> Result<(), ReportError> {
    values(section, field, list)?;
    match list.windows(2).position(|w| w[1] <= w[0]) {
        Some(i) => Err(domain(section, &format!("{field}[{}]", i + 1), "does not increase")),
        None => Ok(()),
    }
}

/// The error for a field that breaks its domain.
pub fn domain(section: &str, field: &str, problem: &str) -> ReportError {
    ReportError::Domain { section: section.into(), field: field.into(), problem: problem.into() }
}

fn not_finite(section: &str, field: &str) -> ReportError {
    ReportError::NotFinite { section: section.into(), field: field.into() }
}
