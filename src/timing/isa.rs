//! Records of what compilers made of the emitted functions: counts of machine instructions for
//! families of GPUs. A record follows from the code and the compiler's version alone.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::Versioned;
use super::listings::Listings;
use super::record::RecordError;
use crate::emit::include::Include;
use crate::emit::manifest::{Entries, Manifest};
use crate::store::{Files, MANIFEST};

/// Version of the form, and of the way of counting.
pub const VERSION: u32 = 2;

/// The folder of a bake in which records are looked for.
pub const FOLDER: &str = "reports/isa";

/// Digits of a hash that a record holds.
const DIGITS: usize = 16;

/// What a compiler made of the functions of a scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IsaRecord {
    /// [`VERSION`].
    pub schema_version: u32,
    /// The command that makes it.
    pub command: String,
    /// Name of the scene.
    pub scene: String,
    /// The driver that compiles, or the compiler: `radv`, `intel`, `nvidia-nvrtc`.
    pub driver: String,
    /// The driver's version: `22.3.6`.
    pub version: String,
    /// What could not be compiled.
    pub left_out: Vec<IsaLeftOut>,
    /// What was compiled, by the names of the functions.
    pub functions: BTreeMap<String, IsaFunction>,
    /// By function, family and precision.
    pub rows: Vec<IsaRow>,
    /// Machine code, of a record that has the family by which the vendor is priced
    /// ([`super::priced`]).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub listings: Option<Listings>,
}

/// A function of the bake.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IsaFunction {
    /// Operations by the model, where the manifest states them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ops: Option<u32>,
    /// The beginning of the hash of its code, [`Include::hash`].
    pub source: String,
}

impl IsaFunction {
    /// A function whose code has a hash.
    pub fn of(hash: &str, ops: Option<u32>) -> IsaFunction {
        IsaFunction { ops, source: hash.chars().take(DIGITS).collect() }
    }

    /// Whether code with a hash is its code.
    pub fn is(&self, hash: &str) -> bool {
        IsaFunction::of(hash, None).source == self.source
    }
}

/// A function on a family. Instructions, bytes and cycles are those of a shader that calls the
/// function once, above those of the same shader without the call.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct IsaRow {
    /// The function's name in the emitted code.
    pub function: String,
    /// The family, by the driver's name of it.
    pub family: String,
    /// Of its numbers.
    pub precision: Precision,
    /// What was counted.
    #[serde(flatten)]
    pub counts: Counts,
}

/// A function that is not valid in a precision.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct IsaLeftOut {
    /// The function.
    pub function: String,
    /// The precision.
    pub precision: Precision,
    /// What the compiler of WGSL says.
    pub reason: String,
}

/// The numbers that a function computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// 32 bits.
    F32,
    /// 16 bits.
    F16,
    /// 16 bits, two evaluations at once in vectors of two.
    F16Packed,
}

impl Precision {
    /// All of them.
    pub const ALL: [Precision; 3] = [Precision::F32, Precision::F16, Precision::F16Packed];
    /// The words of all.
    pub const WORDS: [&str; 3] = ["f32", "f16", "f16-packed"];

    /// The word that records have.
    pub fn word(self) -> &'static str {
        Precision::WORDS[self as usize]
    }
}

/// What a compiled function costs. Kinds of instructions are disjoint; hints and waits are of no
/// kind. What a compiler does not state is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Instructions that compute, in every lane, and are neither transcendental nor moves of
    /// literals.
    pub vector: i64,
    /// Reciprocals, roots, exponentials, logarithms, sines and cosines.
    pub transcendental: i64,
    /// Instructions that compute once for all lanes, loads of uniforms and descriptors among them,
    /// where the GPU has any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scalar: Option<i64>,
    /// Loads, stores and samples.
    pub memory: i64,
    /// Moves of literals into registers.
    pub moves: i64,
    /// Turns in which the arithmetic pipe issues, or waits: instructions and the empty ones between
    /// them (Adreno), tuples of two instructions (Mali).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slots: Option<i64>,
    /// Vector registers of the whole shader.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vgprs: Option<i64>,
    /// Scalar registers of the whole shader.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sgprs: Option<i64>,
    /// Waves of the whole shader that are in flight at once, as the driver counts them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waves: Option<i64>,
    /// Registers spilled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spills: Option<i64>,
    /// Bytes of code.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bytes: Option<i64>,
    /// Cycles from the beginning of a wave to its end, as the compiler estimates them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latency: Option<i64>,
    /// Cycles between the ends of two waves, as the compiler estimates them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inverse_throughput: Option<i64>,
}

impl Counts {
    /// All that are stated, by name.
    pub fn stated(&self) -> Vec<(&'static str, i64)> {
        let all = [
            ("vector", Some(self.vector)),
            ("transcendental", Some(self.transcendental)),
            ("scalar", self.scalar),
            ("memory", Some(self.memory)),
            ("moves", Some(self.moves)),
            ("slots", self.slots),
            ("vgprs", self.vgprs),
            ("sgprs", self.sgprs),
            ("waves", self.waves),
            ("spills", self.spills),
            ("bytes", self.bytes),
            ("latency", self.latency),
            ("inverse_throughput", self.inverse_throughput),
        ];
        all.into_iter().filter_map(|(name, count)| Some((name, count?))).collect()
    }

    /// Counts that must not grow unnoticed: instructions by kind, issue slots, vector registers,
    /// spills. Estimates follow from them.
    pub fn held(&self) -> BTreeMap<&'static str, i64> {
        let held = ["vector", "transcendental", "scalar", "memory", "moves", "slots", "vgprs", "spills"];
        self.stated().into_iter().filter(|(name, _)| held.contains(name)).collect()
    }

    /// Those of a shader above those of the same shader without the function; registers, waves and
    /// spills stay those of the whole.
    pub fn above(&self, without: &Counts) -> Counts {
        let less = |with: Option<i64>, without: Option<i64>| Some(with? - without?);
        Counts {
            vector: self.vector - without.vector,
            transcendental: self.transcendental - without.transcendental,
            scalar: less(self.scalar, without.scalar),
            memory: self.memory - without.memory,
            moves: self.moves - without.moves,
            slots: less(self.slots, without.slots),
            bytes: less(self.bytes, without.bytes),
            latency: less(self.latency, without.latency),
            inverse_throughput: less(self.inverse_throughput, without.inverse_throughput),
            ..*self
        }
    }

    /// Instructions in those of full rate: a transcendental one has a quarter of it.
    pub fn issued(&self) -> i64 {
        self.vector + 4 * self.transcendental
    }
}

/// A count that is larger than in a record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Grown {
    /// The function.
    pub function: String,
    /// The family.
    pub family: String,
    /// The precision.
    pub precision: Precision,
    /// Which count.
    pub count: String,
    /// In the record.
    pub was: i64,
    /// Compiled now.
    pub is: i64,
}

/// What comparing with a record found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Comparison {
    /// Driver and version of the record.
    pub recorded: String,
    /// Driver and version on this machine; counts of another are not compared.
    pub compiled: String,
    /// Rows that were compared.
    pub rows: usize,
    /// Counts that grew.
    pub grown: Vec<Grown>,
}

impl IsaRecord {
    /// A record from its bytes.
    ///
    /// # Errors
    /// Bytes that are no such record, or one of another version.
    pub fn read(bytes: &[u8]) -> Result<IsaRecord, RecordError> {
        let foreign =
            |e: serde_json::Error| RecordError::Foreign { of: "cost --isa --record", reason: e.to_string() };
        let Versioned { schema_version: found } = serde_json::from_slice(bytes).map_err(foreign)?;
        if found != VERSION {
            let reason = format!("schema_version {found}, this version reads {VERSION}");
            return Err(RecordError::Foreign { of: "cost --isa --record", reason });
        }
        serde_json::from_slice(bytes).map_err(foreign)
    }

    /// Its bytes: JSON, a row a line.
    ///
    /// # Errors
    /// Data that cannot be written as JSON.
    pub fn bytes(&self) -> Result<Vec<u8>, serde_json::Error> {
        let (functions, rows) = (BTreeMap::new(), Vec::new());
        let whole = serde_json::to_string_pretty(&IsaRecord { functions, rows, ..self.clone() })?;
        let line = |(name, function): (&String, &IsaFunction)| {
            Ok(format!("{}:{}", serde_json::to_string(name)?, serde_json::to_string(function)?))
        };
        let functions = self.functions.iter().map(line).collect::<Result<Vec<_>, serde_json::Error>>()?;
        let rows = self.rows.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>()?;
        let lines = |lines: Vec<String>| lines.join(",\n    ");
        let functions = format!("\"functions\": {{\n    {}\n  }}", lines(functions));
        let rows = format!("\"rows\": [\n    {}\n  ]", lines(rows));
        let whole = whole.replacen("\"functions\": {}", &functions, 1);
        Ok((whole.replacen("\"rows\": []", &rows, 1) + "\n").into_bytes())
    }

    /// Driver and version: `radv-22.3.6`, as the name of a record begins.
    pub fn compiler(&self) -> String {
        format!("{}-{}", self.driver, self.version)
    }

    /// Operations by the model of a function, where the manifest states them.
    pub fn ops(&self, function: &str) -> Option<u32> {
        self.functions.get(function)?.ops
    }

    /// Whether a function was compiled from code with a hash.
    pub fn is_of(&self, function: &str, hash: &str) -> bool {
        self.functions.get(function).is_some_and(|of| of.is(hash))
    }

    /// Its families, in order of first mention.
    pub fn families(&self) -> Vec<&str> {
        let mut families: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !families.contains(&row.family.as_str()) {
                families.push(&row.family);
            }
        }
        families
    }

    /// Rows of functions whose code is not that of an include file, or which it lacks: names of the
    /// functions.
    pub fn stale(&self, include: &Include) -> BTreeSet<&str> {
        let current =
            |name: &str, function: &IsaFunction| include.hash(name).is_some_and(|hash| function.is(&hash));
        let other = self.functions.iter().filter(|(name, function)| !current(name, function));
        other.map(|(name, _)| name.as_str()).collect()
    }

    /// What grew from this record to what is compiled now. Another compiler is not compared.
    pub fn compare(&self, now: &IsaRecord) -> Comparison {
        let (recorded, compiled) = (self.compiler(), now.compiler());
        let key = |row: &IsaRow| (row.function.clone(), row.family.clone(), row.precision);
        let all: BTreeMap<_, _> = now.rows.iter().map(|row| (key(row), row)).collect();
        let same = recorded == compiled;
        let pairs = self.rows.iter().filter_map(|was| Some((was, *all.get(&key(was))?)));
        let pairs: Vec<_> = pairs.filter(|_| same).collect();
        let grown = pairs.iter().flat_map(|(was, is)| {
            let (before, after) = (was.counts.held(), is.counts.held());
            let both = before.into_iter().filter_map(move |(name, was)| Some((name, was, *after.get(name)?)));
            both.filter(|(_, before, after)| after > before).map(|(count, before, after)| Grown {
                function: was.function.clone(),
                family: was.family.clone(),
                precision: was.precision,
                count: count.into(),
                was: before,
                is: after,
            })
        });
        Comparison { recorded, compiled, rows: pairs.len(), grown: grown.collect() }
    }
}

impl std::fmt::Display for Grown {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Grown { function, family, precision, count, was, is } = self;
        write!(f, "{function} on {family} in {}: {count} {is}, recorded {was}", precision.word())
    }
}

/// Operations by the model of the functions that a bake's manifest states them of.
///
/// # Errors
/// Files without a manifest of this version.
pub fn operations(files: &Files) -> Result<BTreeMap<String, u32>, serde_json::Error> {
    let manifest = Manifest::read(files.get(MANIFEST).map_or(&[], Vec::as_slice))?;
    let Entries { tables, fits, mips, lookups, calls, .. } = manifest.entries;
    let of = calls.into_iter().map(|entry| (entry.function, entry.cost.ops));
    let of = of.chain(mips.into_iter().map(|entry| (entry.function, entry.ops)));
    let of = of.chain(tables.into_iter().map(|entry| (entry.function, entry.cost.ops)));
    let of = of.chain(lookups.into_iter().map(|entry| (entry.function, entry.cost.ops)));
    Ok(of.chain(fits.into_iter().map(|entry| (entry.function, entry.cost.ops))).collect())
}
