//! The effects that a scene can call for, and what a plan says of them.

use std::collections::BTreeMap;

use serde::Serialize;

use super::merge::hull;

/// The names of effects, as the contract fixes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "the words are the contract's; `reason` says what each is")]
pub enum EffectName {
    Reflection,
    Anisotropy,
    Glass,
    DiffuseCoupling,
    Sheen,
    Clearcoat,
    OrenNayar,
    Parallax,
    Occlusion,
}

impl EffectName {
    /// All of them, in the contract's order.
    pub const ALL: [EffectName; 9] = [
        EffectName::Reflection,
        EffectName::Anisotropy,
        EffectName::Glass,
        EffectName::DiffuseCoupling,
        EffectName::Sheen,
        EffectName::Clearcoat,
        EffectName::OrenNayar,
        EffectName::Parallax,
        EffectName::Occlusion,
    ];

    /// The word used in options and in the manifest.
    pub fn name(self) -> &'static str {
        match self {
            EffectName::Reflection => "reflection",
            EffectName::Anisotropy => "anisotropy",
            EffectName::Glass => "glass",
            EffectName::DiffuseCoupling => "diffuse-coupling",
            EffectName::Sheen => "sheen",
            EffectName::Clearcoat => "clearcoat",
            EffectName::OrenNayar => "oren-nayar",
            EffectName::Parallax => "parallax",
            EffectName::Occlusion => "occlusion",
        }
    }

    /// The effect of a name.
    pub fn from_name(name: &str) -> Option<EffectName> {
        EffectName::ALL.into_iter().find(|e| e.name() == name)
    }
}

/// One job of an effect, for people and scripts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JobSummary {
    /// Name of the table; `normalisation` for the fits.
    pub name: String,
    /// What it is, in words.
    pub approximation: String,
    /// Domain by input.
    pub ranges: BTreeMap<&'static str, [f64; 2]>,
    /// Bytes of texels; the most that there can be where `bytes_at_most`.
    pub bytes: u64,
    /// Whether the bake chooses the size.
    pub bytes_at_most: bool,
    /// The error that the scene allows; `None` where it sets no limit.
    pub expected_error: Option<f64>,
    /// Expected time on one core.
    pub seconds: f64,
}

/// An effect that the scene calls for: the jobs, and their sum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Effect {
    /// Its name.
    pub effect: EffectName,
    /// The materials or probes that call for it, and why: one sentence each.
    pub because: Vec<String>,
    /// Hull of the jobs' domains, by input.
    pub ranges: BTreeMap<&'static str, [f64; 2]>,
    /// The jobs' approximations in words.
    pub approximation: String,
    /// Bytes of texels of all jobs; the most that there can be where `bytes_at_most`.
    pub bytes: u64,
    /// Whether the bake chooses the size of a table.
    pub bytes_at_most: bool,
    /// The largest error that the scene allows any of the jobs; `None` where one of them has no limit.
    pub expected_error: Option<f64>,
    /// Expected time of all jobs and of their report on one core.
    pub seconds: f64,
    /// The jobs one by one.
    pub jobs: Vec<JobSummary>,
}

/// An effect that is left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftOut {
    /// Its name.
    pub effect: EffectName,
    /// Why: not called for, or called for and not available in this version.
    pub reason: String,
}

impl Effect {
    /// An effect of these jobs and a report that takes `report` seconds.
    pub(super) fn new(
        effect: EffectName,
        because: Vec<String>,
        jobs: Vec<JobSummary>,
        report: f64,
    ) -> Effect {
        let mut ranges: BTreeMap<&'static str, [f64; 2]> = BTreeMap::new();
        for (&input, &range) in jobs.iter().flat_map(|job| &job.ranges) {
            let all = ranges.entry(input).or_insert(range);
            *all = hull(*all, range);
        }
        Effect {
            effect,
            because,
            ranges,
            approximation: jobs.iter().map(|j| j.approximation.as_str()).collect::<Vec<_>>().join("; "),
            bytes: jobs.iter().map(|j| j.bytes).sum(),
            bytes_at_most: jobs.iter().any(|j| j.bytes_at_most),
            expected_error: jobs.iter().try_fold(0.0_f64, |worst, j| j.expected_error.map(|e| worst.max(e))),
            seconds: jobs.iter().map(|j| j.seconds).sum::<f64>() + report,
            jobs,
        }
    }
}
