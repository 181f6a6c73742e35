//! What was found out, as pictures and pages. Plain data in, bytes out; nothing is measured here.
//!
//! [`index`] is the overview of a bake, [`draft`] is the page of one of its effects and its
//! figures, [`timings_page`] the [`Timings`] of `lobefit cost`. Each builds a [`Page`], a list of
//! [`Section`]s of [`Block`]s; a new effect adds a section from the figures there are ([`HeatMap`],
//! [`Curves`], [`Scatter`], [`Spheres`], [`Bars`]). The same data gives the same bytes for any
//! number of threads: rows of pictures are computed in parallel and joined in order, coordinates
//! have fixed decimals, and nothing reads a clock.

mod bar;
mod cost;
pub mod explore;
mod findings;
mod fold;
mod gpu;
mod html;
mod json;
mod offline;
mod page;
pub(crate) mod sections;
mod timings;

use serde::{Deserialize, Serialize};

use crate::emit::manifest::Manifest;
use crate::store::Files;
pub use bar::{bar_from, without_absent};
pub use cost::{CostJob, CostPoint, CostSearch, CostUnit, Costs};
pub use findings::{
    Answer, ApproximationFinding, AverageFinding, AverageFit, ChannelFinding, EffectFinding, ErrorFigure,
    Findings, FitCurve, FitFinding, Furnace, FurnaceRow, LeftOut, Measured, Offer, Origin, Purpose, Role,
    SCHEMA_VERSION, SkySpheres, TableFinding,
};
pub use fold::{folded, folded_after};
pub use gpu::{GpuAgainst, GpuClock, GpuDevice, GpuError, GpuKind, GpuLeftOut, GpuRecord, GpuRow, GpuSpread};
pub use html::html;
pub use json::document;
pub use lobefit_figures::{
    Annotation, Bar, Bars, Cells, Curves, Dot, Field, Figure, Frontiers, Gallery, HeatMap, Image, Panel,
    Pixels, ReportError, Ruler, Scale, Scatter, Series, Shade, SphereRow, Spheres, Spread, Style, Tick, Tile,
    Worst, check, disc, displayed, luminance, signed,
};
pub use lobefit_math::numbers;
pub use offline::{OfflineRecord, OfflineStudy};
pub use page::{Block, Card, Choice, Names, Page, Section, TextTable, figures_of, place_of};
pub use sections::{figures, words};
pub use timings::{
    TimedApproximation, TimedEffect, TimedEffects, TimedEstimator, TimedLookup, TimedTableRun, TimedTables,
    Timings,
};

/// A file to be written: path relative to the bake's folder, and its bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Relative path with `/` between its parts.
    pub path: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// The page of an effect without its conclusion, and the files beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    effect: String,
    page: Page,
    beside: Vec<File>,
}

impl Draft {
    /// `reports/<effect>.html`, its lead after a conclusion, and the files beside it.
    pub fn files(self, conclusion: &str) -> Vec<File> {
        let path = format!("reports/{}.html", self.effect);
        let lead = [conclusion, &self.page.lead].join("\n").trim().to_string();
        let text = html(&Page { lead, ..self.page });
        std::iter::once(file(&path, text.into_bytes())).chain(self.beside).collect()
    }
}

/// A page of sections, and `reports/<effect>.json` of its figures.
///
/// # Errors
/// Data that is not finite, empty where it must not be, or of mismatched size, by section and
/// field.
pub fn draft(effect: &str, mut page: Page, figures: &impl Serialize) -> Result<Draft, ReportError> {
    page.origin = page.origin.with_figures(&format!("{effect}.json"));
    let figures = json::document(&format!("{effect}.json"), figures)?;
    let beside = vec![file(&format!("reports/{effect}.json"), figures)];
    Ok(Draft { effect: effect.into(), page, beside })
}

/// The same of findings of fits and tables over roughness and mu, and `reports/furnace.svg`, the
/// spheres before and after, where they have a furnace.
///
/// # Errors
/// As [`draft`].
pub fn page(effect: &str, findings: &Findings) -> Result<Draft, ReportError> {
    let mut drafted = draft(effect, sections::of_findings(effect, findings)?, findings)?;
    let picture = sections::furnace::picture(findings)?;
    drafted.beside.extend(picture.map(|svg| file("reports/furnace.svg", svg.into_bytes())));
    Ok(drafted)
}

/// The data of [`index`].
pub const INDEX: &str = "reports/index.json";

/// The answers of the effects of a bake.
#[derive(Debug, Serialize, Deserialize)]
pub struct Answers {
    /// What made them; none where they are read back.
    #[serde(default, skip_deserializing, skip_serializing_if = "Option::is_none")]
    pub origin: Option<Origin>,
    /// In the order of the manifest.
    pub answers: Vec<Answer>,
}

/// An answer in the digits of its file, so that the overview is the same whether it was read back.
///
/// # Errors
/// A figure that is not finite.
pub fn settled(answer: Answer) -> Result<Answer, ReportError> {
    let bytes = json::document("index.json", &answer)?;
    serde_json::from_slice(&bytes).map_err(|e| gpu::refused("index", &e))
}

/// `reports/index.html`: what to take of a bake, with links to the pages of its effects; and, where
/// there is anything to take, the answers as `reports/index.json`.
///
/// # Errors
/// As [`draft`].
pub fn index(
    origin: Origin,
    answers: Vec<Answer>,
    (manifest, files): (&Manifest, &Files),
) -> Result<Vec<File>, ReportError> {
    let record = gpu::recorded()?;
    let drawn = sections::answers::Drawn { manifest, files, record: Some(&record) };
    let any = answers.iter().any(|answer| !answer.purposes.is_empty());
    let linked = if any { origin.clone().with_figures("index.json") } else { origin.clone() };
    let text = html(&sections::of_index(linked, &answers, &drawn)?);
    let mut made = vec![file("reports/index.html", text.into_bytes())];
    if any {
        let data = Answers { origin: Some(origin), answers };
        made.push(file(INDEX, json::document("index.json", &data)?));
    }
    Ok(made)
}

/// The live page, with times of functions that are recorded as they are emitted here.
///
/// # Errors
/// As [`draft`].
pub fn explore(
    page: explore::ExplorePage,
    (manifest, files): (&Manifest, &Files),
) -> Result<File, ReportError> {
    let record = gpu::recorded()?;
    let drawn = sections::answers::Drawn { manifest, files, record: Some(&record) };
    Ok(file(explore::EXPLORE, html(&sections::of_explore(page, &drawn)?).into_bytes()))
}

/// `reports/timings.html` and `reports/timings.json` of a measurement.
///
/// # Errors
/// As [`draft`].
pub fn timings_page(timings: &Timings) -> Result<Vec<File>, ReportError> {
    let figures = json::document("timings.json", timings)?;
    let text = html(&sections::of_timings(timings)?);
    Ok(vec![file("reports/timings.html", text.into_bytes()), file("reports/timings.json", figures)])
}

/// The page of times on a graphics processor as HTML, and its record as JSON; the page names the
/// hash of the record's bytes.
///
/// # Errors
/// As [`draft`].
pub fn gpu_page(record: &GpuRecord) -> Result<(String, Vec<u8>), ReportError> {
    let figures = json::document("gpu.json", record)?;
    let hash = blake3::hash(&figures).to_hex();
    Ok((html(&sections::of_gpu(record, &hash)?), figures))
}

/// A record of what accuracy costs offline, as JSON.
///
/// # Errors
/// As [`draft`].
pub fn offline_record(record: &OfflineRecord) -> Result<Vec<u8>, ReportError> {
    json::document("offline.json", record)
}

/// The page of what accuracy costs, as HTML.
///
/// # Errors
/// As [`draft`].
pub fn cost_page(costs: &Costs) -> Result<String, ReportError> {
    Ok(html(&sections::of_costs(costs)?))
}

fn file(path: &str, bytes: Vec<u8>) -> File {
    File { path: path.into(), bytes }
}
