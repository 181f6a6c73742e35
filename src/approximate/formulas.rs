//! Formulas of ours by the inputs that vary: a scene of one roughness calls for a function of the cosine
//! alone, or of it and the index of refraction, one of one index for a function of an input less.

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

/// A polynomial of coefficients by Horner's scheme.
macro_rules! horner {
    ($x:literal; $last:literal) => {
        $last
    };
    ($x:literal; $first:literal $last:literal) => {
        concat!($first, " + ", $x, " * ", $last)
    };
    ($x:literal; $first:literal $($rest:literal)+) => {
        concat!($first, " + ", $x, " * (", horner!($x; $($rest)+), ")")
    };
}

/// A formula of one input: operations, what it is, parameters after a0 and where their search begins, and
/// coefficients of the dividend and the divisor, or of one polynomial.
macro_rules! of_one_input {
    ($family:literal $x:literal $of:literal; $operations:literal $is:literal; $($free:literal)+ = $start:literal;
     $($c:literal)+ $(/ $($d:literal)+)?) => {
        Entry {
            file: concat!($family, "_", $operations, ".wgsl"),
            source: concat!(
                "override a0: f32 = 1.0;\n",
                $("override ", $free, ": f32 = ", $start, ";\n",)+
                "\n/// Of ", $of, " alone: every other input has one value.\n/// ", $is, ".\n",
                "fn ", $family, "_", $operations, "(", $x, ": f32) -> f32 {\n",
                of_one_input!($x; $($c)+ $(/ $($d)+)?),
                "}\n",
            ),
            publication: None,
        }
    };
    ($x:literal; $($c:literal)+) => {
        concat!("    return ", horner!($x; $($c)+), ";\n")
    };
    ($x:literal; $($c:literal)+ / $($d:literal)+) => {
        concat!(
            "    let dividend = ", horner!($x; $($c)+), ";\n",
            "    let divisor = ", horner!($x; $($d)+), ";\n",
            "    return dividend / divisor;\n",
        )
    };
    ($family:literal $x:literal $of:literal) => {
        [
            of_one_input!($family $x $of; 1 "One operation: a polynomial"; "a1" = "0.1"; "a0" "a1"),
            of_one_input!($family $x $of; 2 "Two operations: a polynomial";
                "a1" "a2" = "0.1"; "a0" "a1" "a2"),
            of_one_input!($family $x $of; 3 "Three operations: a polynomial";
                "a1" "a2" "a3" = "0.1"; "a0" "a1" "a2" "a3"),
            of_one_input!($family $x $of; 4 "Four operations: a polynomial";
                "a1" "a2" "a3" "a4" = "0.1"; "a0" "a1" "a2" "a3" "a4"),
            of_one_input!($family $x $of; 5 "Five operations: a polynomial";
                "a1" "a2" "a3" "a4" "a5" = "0.1"; "a0" "a1" "a2" "a3" "a4" "a5"),
            of_one_input!($family $x $of; 7 "Seven operations: a quotient";
                "a1" "b1" = "1.0"; "a0" "a1" / "1.0" "b1"),
            of_one_input!($family $x $of; 8 "Eight operations: a quotient, whose divisor has no linear term";
                "a1" "a2" "b0" = "1.0"; "a0" "a1" "a2" / "b0" $x),
            of_one_input!($family $x $of; 9 "Nine operations: a quotient";
                "a1" "a2" "b1" "b2" = "1.0"; "a0" "a1" "a2" / "1.0" "b1" "b2"),
            of_one_input!($family $x $of; 10 "Ten operations: a quotient, whose divisor has no square";
                "a1" "a2" "a3" "b0" "b1" = "1.0"; "a0" "a1" "a2" "a3" / "b0" "b1" $x),
            of_one_input!($family $x $of; 11 "Eleven operations: a quotient";
                "a1" "a2" "a3" "b1" "b2" "b3" = "1.0"; "a0" "a1" "a2" "a3" / "1.0" "b1" "b2" "b3"),
            of_one_input!($family $x $of; 12 "Twelve operations: a quotient";
                "a1" "a2" "a3" "a4" "b1" "b2" "b3" = "1.0"; "a0" "a1" "a2" "a3" "a4" / "1.0" "b1" "b2" "b3"),
            of_one_input!($family $x $of; 13 "Thirteen operations: a quotient";
                "a1" "a2" "a3" "a4" "b1" "b2" "b3" "b4" = "1.0";
                "a0" "a1" "a2" "a3" "a4" / "1.0" "b1" "b2" "b3" "b4"),
        ]
    };
}

/// Where mu alone varies: of each number of operations the one that errs least over most roughnesses, of
/// polynomials, and of quotients of degree up to 4 with and without terms left out.
const COSINES: [Entry; 12] = of_one_input!("cosine" "mu" "the cosine of the view");

/// The same in roughness, where it alone varies.
const ROUGHNESSES: [Entry; 12] = of_one_input!("roughness" "roughness" "roughness");

/// The same in the index of refraction.
const INDICES: [Entry; 12] = of_one_input!("ior" "ior" "the index of refraction");

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

/// Where mu and the index of refraction vary: what errs least over rough glass from outside and inside and
/// over its reflection alone, at roughness 0.15, 0.4 and 0.8 and over indices of 1.3 to 1.7, of what searches
/// there found.
const COSINES_OF_INDICES: [Entry; 13] = own![
    "cosine_ior_3",
    "cosine_ior_4",
    "cosine_ior_5",
    "cosine_ior_6",
    "cosine_ior_7",
    "cosine_ior_square_8",
    "cosine_ior_9",
    "cosine_ior_decay_9",
    "cosine_ior_decay_10",
    "cosine_ior_square_11",
    "cosine_ior_12",
    "cosine_ior_quotient_12",
    "cosine_ior_quotient_13",
];

/// Of mu and the index of refraction: those of mu alone, which are enough for a narrow range of indices, and
/// those of both.
const WITH_INDICES: [Entry; 12 + COSINES_OF_INDICES.len()] = joined(&COSINES, &COSINES_OF_INDICES);

/// One list after another.
const fn joined<const N: usize>(first: &[Entry], second: &[Entry]) -> [Entry; N] {
    let mut all = [first[0]; N];
    let mut i = 0;
    while i < N {
        all[i] = if i < first.len() { first[i] } else { second[i - first.len()] };
        i += 1;
    }
    all
}

/// Those of every quantity.
pub fn of_fewer_inputs() -> impl Iterator<Item = &'static Entry> {
    static ALL: [&[Entry]; 6] =
        [&CONSTANTS, &COSINES, &ROUGHNESSES, &INDICES, &COSINE_BLENDS, &COSINES_OF_INDICES];
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
            (["ior"], false) => &INDICES,
            (["ior", "mu"] | ["mu", "ior"], false) => &WITH_INDICES,
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
