//! The lobe that a probe's chain is prefiltered with: one of a word, or a table in a file of its
//! own.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer};

use super::SceneError;
use super::limits;
use super::name;
use super::number::{In, NotNegative, QuarterTurn, Version, Whole, Width};
use super::value::{List, Text, TextRule, from_file};
use lobefit_strict::read_object;
use lobefit_truth::optics::kernel::{self, Kernel, TableLobe};

/// A word, or the path of a table.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum KernelWord {
    Known(Kernel),
    File(String),
}

/// What a string has to be.
struct KernelText;

impl TextRule for KernelText {
    const EXPECTED: &'static str = "ndf, half, half-cosine, or the relative path of a .json file, in quotes";

    fn check(text: &str) -> Result<(), String> {
        if Kernel::ALL.iter().any(|kernel| kernel.word() == text) {
            return Ok(());
        }
        if !text.ends_with(".json") {
            return Err(format!(
                "`{text}` is none of ndf, half and half-cosine, and no path of a .json file with a table"
            ));
        }
        name::relative(text, ".json")
    }
}

impl<'de> Deserialize<'de> for KernelWord {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Text::<KernelText>::deserialize(deserializer)?.0;
        let known = Kernel::ALL.into_iter().find(|kernel| kernel.word() == text);
        Ok(known.map_or(KernelWord::File(text), KernelWord::Known))
    }
}

impl JsonSchema for KernelWord {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Kernel".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let words = Kernel::WORDS;
        json_schema!({ "anyOf": [
            { "type": "string", "enum": words },
            { "type": "string", "pattern": "\\.json$", "maxLength": limits::STRING_BYTES },
        ] })
    }
}

/// A name that functions are named by.
struct FunctionPart;

/// Longest name of a kernel.
const NAME_BYTES: usize = 32;

impl TextRule for FunctionPart {
    const EXPECTED: &'static str = "a name of small letters, digits and single hyphens in quotes";

    fn check(text: &str) -> Result<(), String> {
        let parts = || text.split('-');
        let plain = |part: &str| {
            !part.is_empty() && part.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit())
        };
        if text.len() > NAME_BYTES
            || !parts().all(plain)
            || !text.starts_with(|c: char| c.is_ascii_lowercase())
        {
            return Err(format!(
                "`{text}` is no name for functions: small letters, digits and single hyphens between them, a letter first, at most \
                 {NAME_BYTES} characters"
            ));
        }
        if Kernel::ALL.iter().any(|kernel| kernel.name() == text) {
            return Err(format!("`{text}` is the name of a lobe that has a formula; give another"));
        }
        Ok(())
    }
}

/// The lobe that a renderer's cubemaps are prefiltered with, as a table: its weight over the angle
/// at some widths. With x the energy that GGX's lobe D(theta/2) of the same width holds inside an
/// angle, its density over x is interpolated: between angles by monotone cubics, between widths
/// linearly in ln alpha; below the narrowest width the density over x is that of the narrowest. A
/// dozen widths or more leave 0.001 of the energy.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Kernel")]
#[serde(deny_unknown_fields, expecting = "an object that describes a kernel")]
struct KernelFile {
    /// Version of this format: 1.
    #[allow(dead_code, reason = "reading it is the check")]
    schema_version: Whole<Version>,
    /// What functions for such chains are named by: small letters, digits and single hyphens, at
    /// most 32, a letter first.
    name: Text<FunctionPart>,
    /// The lobe at some widths, the narrowest first; the last is of alpha 1.
    lobes: List<Lobe, { limits::KERNEL_LOBES }>,
}

/// The lobe of one width.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "KernelLobe")]
#[serde(deny_unknown_fields, expecting = "an object that describes a lobe")]
struct LobeFile {
    /// Its width alpha: GGX's of the level that is prefiltered with it.
    alpha: In<Width>,
    /// Angles from the axis in radians, rising from 0 to at most pi/2 = 1.5707963; at least 8.
    /// Beyond the last the lobe is 0.
    theta: List<In<QuarterTurn>, { limits::KERNEL_ANGLES }>,
    /// Weight of the radiance per solid angle at every angle, in any unit: the lobe is normalised.
    density: List<In<NotNegative>, { limits::KERNEL_ANGLES }>,
}

/// A lobe as read.
struct Lobe(TableLobe);

impl TryFrom<LobeFile> for Lobe {
    type Error = String;

    fn try_from(file: LobeFile) -> Result<Self, String> {
        Ok(Lobe(TableLobe {
            alpha: file.alpha.0,
            theta: file.theta.0.into_iter().map(|x| x.0).collect(),
            density: file.density.0.into_iter().map(|x| x.0).collect(),
        }))
    }
}

from_file!(Lobe, LobeFile);

/// Reads the table of a kernel; `file` is its name in messages.
///
/// # Errors
/// What is no such table, with its place and field.
pub fn kernel(bytes: &[u8], file: &str) -> Result<Kernel, SceneError> {
    let table: KernelFile = read_object(bytes, file, limits::STRING_BYTES)?;
    let lobes: Vec<TableLobe> = table.lobes.0.into_iter().map(|lobe| lobe.0).collect();
    kernel::tabulated(&table.name.0, &lobes).map_err(|error| SceneError::Whole {
        file: file.into(),
        path: error.path(),
        message: error.message,
    })
}

/// The JSON Schema of a kernel's file.
pub fn kernel_schema() -> Schema {
    schemars::schema_for!(KernelFile)
}
