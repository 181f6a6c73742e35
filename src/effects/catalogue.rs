//! The effects of this version: a line for each.

use super::anisotropy::Anisotropy;
use super::coupling::DiffuseCoupling;
use super::effect::Effect;
use super::glass::Glass;
use super::parallax::Parallax;
use super::reflection::Reflection;
use super::sheen::Sheen;

/// Every effect, in the order of plans, include files and manifests.
pub fn catalogue() -> &'static [&'static dyn Effect] {
    &[&Reflection, &Anisotropy, &Glass, &DiffuseCoupling, &Sheen, &Parallax]
}

/// The effect of a name.
pub fn named(catalogue: &[&'static dyn Effect], name: &str) -> Option<&'static dyn Effect> {
    catalogue.iter().copied().find(|effect| effect.name() == name)
}
