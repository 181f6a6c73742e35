//! The audit of a table, or of a function of whose index of refraction nobody says which way round
//! it is.

use crate::audit::{Audit, AuditError, AuditedTable, Fixed, audit};
use lobefit::cli::progress::Spinner;
use lobefit_truth::quantity::Quantity;

/// The audit; with `inverse`, which is a function given 1/ior, the one of both that fits better.
pub(super) fn judged(
    audited: &AuditedTable,
    inverse: Option<&AuditedTable>,
    quantity: &dyn Quantity,
    fixed: &Fixed,
    progress: &Spinner,
) -> Result<Audit, AuditError> {
    let told = |stage: &str| progress.stage(stage);
    let own = audit(audited, quantity, fixed, &told);
    let Some(inverse) = inverse else { return own };
    let other = audit(inverse, quantity, &Fixed { inverse: true, ..fixed.clone() }, &told);
    match (own, other) {
        (Ok(own), Ok(other)) => Ok(own.beside(other)),
        (Ok(own), Err(error)) => Ok(noted(own, "eta = 1/ior", &error)),
        (Err(error), Ok(other)) => Ok(noted(other, "ior", &error)),
        (Err(error), Err(_)) => Err(error),
    }
}

/// The one that could be made, with why the other could not.
fn noted(mut made: Audit, given: &str, error: &AuditError) -> Audit {
    made.remarks.push(format!("Given {given} for its index it cannot be judged: {error}."));
    made
}
