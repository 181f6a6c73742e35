//! What an audit found out, and its page.

mod cost;
mod findings;
mod page;

pub use cost::{AuditCompiled, AuditCost, AuditFamily};
pub use findings::{
    AuditAxis, AuditChannel, AuditConvention, AuditCurve, AuditDefect, AuditFindings, AuditFurnace,
    AuditHeld, AuditOtherwise, AuditPlain, AuditPublished,
};

use lobefit::report::{ReportError, document, html};

/// The page of an audit as HTML, and its figures as JSON.
///
/// # Errors
/// Data that is not finite, or empty where it must not be, by section and field.
pub fn audit_page(audit: &AuditFindings) -> Result<(String, Vec<u8>), ReportError> {
    Ok((html(&page::page(audit)?), document("audit.json", audit)?))
}
