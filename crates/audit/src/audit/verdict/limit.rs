//! Where a limit was judged, which a largest error alone does not tell.

use super::words::{number, place};
use crate::audit::Audit;
use crate::audit::table::Source;

/// Of a table or function whose convention was found: at texels or points, and what lookups between
/// them make of it.
pub fn limit_judged(audit: &Audit, limit: f64) -> String {
    let limit_text = number(limit);
    if audit.source == Source::Function {
        return format!("The limit {limit_text} is judged at those points of the arguments.");
    }
    let worst = audit.channels.iter().filter_map(|c| c.lookup.as_ref());
    let worst = worst.reduce(|a, b| if b.max > a.max { b } else { a });
    match worst {
        Some(lookup) if lookup.max > limit && audit.passes(Some(limit)) => format!(
            "The limit {limit_text} is judged at the texels, which keep it; lookups between them and beyond the outermost do not: they are off by up \
             to {} (at {}).",
            number(lookup.max),
            place(&lookup.at)
        ),
        _ => format!("The limit {limit_text} is judged at the texels, not at lookups between them."),
    }
}
