//! Which fits get pictures: a reader's time is short, and most fits are beaten by another.

use super::context::Context;
use crate::approximate::Fit;
use crate::data::Use;

/// Our versions of the source post's two formulas: shown beside the published constants whether
/// beaten or not.
const REFITTED: [&str; 2] = ["ggx_norm_n1.wgsl", "ggx_norm_n2.wgsl"];

/// A fit to be shown, and why it is.
pub struct Selected<'a> {
    /// The fit.
    pub fit: &'a Fit,
    /// What earns it a picture, as it reads after a number of fits.
    pub because: &'static str,
}

/// The emitted fits of a whole column (no part of a pair) for a use that are worth a picture, in
/// the order given.
pub fn selected<'a>(fits: &'a [Fit], column: &str, used_as: Use, context: &Context) -> Vec<Selected<'a>> {
    let of_use = |f: &&Fit| {
        let a = &f.approximation;
        a.used_as == used_as && a.column == column && f.emitted
    };
    let emitted: Vec<&Fit> = fits.iter().filter(of_use).collect();
    emitted
        .iter()
        .filter_map(|fit| Some(Selected { fit, because: reason(fit, &emitted, context)? }))
        .collect()
}

fn reason(fit: &Fit, emitted: &[&Fit], context: &Context) -> Option<&'static str> {
    let error = |f: &Fit| f.approximation.certificate.max_abs;
    let ops = |f: &Fit| f.approximation.cost.ops;
    let file = fit.hypothesis.file();
    let beats = |o: &&Fit| {
        (ops(o) <= ops(fit) && error(o) < error(fit)) || (ops(o) < ops(fit) && error(o) <= error(fit))
    };
    let better_twin = || emitted.iter().any(|o| o.hypothesis.file() == file && error(o) < error(fit));
    if fit.norm() == "published" {
        Some("of the source, with published constants")
    } else if context.hypotheses.iter().any(|user| user.source == fit.hypothesis.source()) {
        Some("of the user")
    } else if !emitted.iter().any(beats) {
        Some("on the frontier")
    } else if REFITTED.contains(&file) && !better_twin() {
        Some("of the source's form, with fitted constants")
    } else {
        None
    }
}
