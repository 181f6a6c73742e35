//! Formulas of ours by the inputs that vary: a scene of one roughness calls for a function of the cosine
//! alone, one of one index of refraction for a function of an input less.

use super::target::TargetSpec;
use super::{Entry, own};

/// Formulas with free parameters for one quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Formulas<'a> {
    /// Of all inputs.
    pub all: &'a [Entry],
    /// Of roughness and mu, for where every other input has one value.
    pub flat: &'a [Entry],
}

/// Where every input has one value.
const CONSTANTS: [Entry; 1] = own!["constant_0"];

/// Where mu alone varies: of each number of operations the one that errs least over most roughnesses, of
/// polynomials, and of quotients of degree up to 4 with and without terms left out.
const COSINES: [Entry; 12] = own![
    "cosine_1",
    "cosine_2",
    "cosine_3",
    "cosine_4",
    "cosine_5",
    "cosine_7",
    "cosine_8",
    "cosine_9",
    "cosine_10",
    "cosine_11",
    "cosine_12",
    "cosine_13",
];

/// The same in roughness, where it alone varies.
const ROUGHNESSES: [Entry; 12] = own![
    "roughness_1",
    "roughness_2",
    "roughness_3",
    "roughness_4",
    "roughness_5",
    "roughness_7",
    "roughness_8",
    "roughness_9",
    "roughness_10",
    "roughness_11",
    "roughness_12",
    "roughness_13",
];

/// f0 A + B where mu and f0 vary.
const COSINE_BLENDS: [Entry; 10] = own![
    "cosine_blend_5",
    "cosine_blend_7",
    "cosine_blend_8",
    "cosine_blend_9",
    "cosine_blend_10",
    "cosine_blend_11",
    "cosine_blend_13",
    "cosine_blend_14",
    "cosine_blend_15",
    "cosine_blend_18",
];

/// Those of every quantity.
pub fn of_fewer_inputs() -> impl Iterator<Item = &'static Entry> {
    static ALL: [&[Entry]; 4] = [&CONSTANTS, &COSINES, &ROUGHNESSES, &COSINE_BLENDS];
    ALL.into_iter().flatten()
}

impl<'a> Formulas<'a> {
    /// Of all inputs, whatever varies.
    pub const fn of(all: &'a [Entry]) -> Formulas<'a> {
        Formulas { all, flat: &[] }
    }

    /// Those for the ranges of the inputs but the f0 of a blend.
    pub fn over<'s>(self, ranges: impl Iterator<Item = (&'s str, [f64; 2])>, blends: bool) -> &'a [Entry] {
        let (one, varying): (Vec<_>, Vec<_>) = ranges.partition(|(_, [low, high])| low == high);
        if one.is_empty() || self.all.is_empty() {
            return self.all;
        }
        let varying: Vec<&str> = varying.into_iter().map(|(input, _)| input).collect();
        match (varying.as_slice(), blends) {
            ([], false) => &CONSTANTS,
            (["mu"], false) => &COSINES,
            (["mu"], true) => &COSINE_BLENDS,
            (["roughness"], false) => &ROUGHNESSES,
            (["mu", "roughness"] | ["roughness", "mu"], false) if !self.flat.is_empty() => self.flat,
            _ => self.all,
        }
    }

    /// Whether there are formulas without the inputs beside roughness and mu.
    pub fn is_flat(self) -> bool {
        !self.flat.is_empty()
    }

    /// All there are of the quantity, whatever varies.
    pub fn entries(self) -> impl Iterator<Item = &'a Entry> {
        self.all.iter().chain(self.flat)
    }

    /// Whether formulas are of the quantity, so that their names say what they are of.
    pub fn names(self, formulas: &[Entry]) -> bool {
        std::ptr::eq(formulas, self.all) || std::ptr::eq(formulas, self.flat)
    }

    /// Those for a target.
    pub fn suiting(self, spec: &TargetSpec) -> &'a [Entry] {
        self.over(spec.ranges(), spec.used_as.is_some_and(|used_as| used_as.blends))
    }
}
