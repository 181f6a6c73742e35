//! Where the verbs meet the work of the floors below: each function takes a verb's validated input and does it.

use super::CliError;
use super::bake;
use super::check;
use super::cost;
use super::eval;
use super::input::Input;
use super::output::Outcome;
use super::points::Points;
use crate::plan::Plan;
use crate::store::Folder;

/// Bakes the plan into the folder.
pub(super) fn bake(_: &Input, _: &Plan, _: &mut Folder, _: &bake::Options) -> Result<Outcome, CliError> {
    Err(CliError::Unavailable { verb: "bake" })
}

/// Bakes the plan and compares it with the folder; [`Outcome::Failed`] where they differ.
pub(super) fn check(_: &Input, _: &Plan, _: &check::Options) -> Result<Outcome, CliError> {
    Err(CliError::Unavailable { verb: "check" })
}

/// Measures the plan's approximations and integrators, and writes `reports/timings.*` into the folder.
pub(super) fn cost(_: &Input, _: &Plan, _: &mut Folder, _: &cost::Options) -> Result<Outcome, CliError> {
    Err(CliError::Unavailable { verb: "cost" })
}

/// The outputs of the quantity at every row of inputs ([`Points::rows`]), both in the order of the quantity's columns; a
/// row that cannot be computed is refused by [`Points::refuse`].
pub(super) fn evaluate(_: &eval::Options, _: &Points) -> Result<Vec<Vec<f64>>, CliError> {
    Err(CliError::Unavailable { verb: "eval" })
}
