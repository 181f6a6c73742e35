//! The bar of links that the pages of the built-in scene share with those of studies and of times.

use std::path::Path;

use serde_json::Value;

use super::ReportError;
use super::gpu::refused;
use crate::store::Files;

/// The answers of the built-in scene, which name its effects.
const ANSWERS: &str = include_str!("../../reports/index.json");

/// Pages that other commands put beside those of the built-in scene, as they lie in the repository
/// of this program: their word in the bar, what they show, and their file.
const BESIDE: [(&str, &str, &str); 6] = [
    ("costs", "What accuracy costs: every formula on the GPUs of every vendor", "cost.html"),
    ("probes", "Study: lookups of probes in rooms whose light is known", "studies/parallax/index.html"),
    ("bases", "Study: diffuse bases under specular lobes", "studies/coupling/index.html"),
    (
        "stability",
        "Study: hard cases, the textbook's formula beside the stable one",
        "studies/stability/index.html",
    ),
    ("culling", "Study: occlusion buffers from depth that is frames old", "studies/occlusion/index.html"),
    ("times", "Times of the functions on an NVIDIA H200", "gpu/nvidia-h200.html"),
];

/// What the bar of a page of the built-in scene's bake has after the pages of the bake; nothing of
/// another scene's.
pub(super) fn beside(command: &str) -> String {
    if command == "lobefit bake" { links() } else { String::new() }
}

fn links() -> String {
    BESIDE.map(|(word, title, file)| format!("<a href=\"{file}\" title=\"{title}\">{word}</a>\n")).concat()
}

/// Takes the links to pages beside those of a bake out of its pages, unless all of those pages lie in
/// `root`, the folder of the bake: that of the repository.
pub fn without_absent(files: &mut Files, root: &Path) {
    if BESIDE.iter().all(|(.., file)| root.join("reports").join(file).is_file()) {
        return;
    }
    let links = links();
    for (_, bytes) in files.iter_mut().filter(|(name, _)| name.ends_with(".html")) {
        let at = bytes.windows(links.len()).position(|window| window == links.as_bytes());
        at.map(|at| bytes.drain(at..at + links.len()));
    }
}

/// The whole bar, for a page that no bake writes; `up` leads from its folder to `reports/`.
///
/// # Errors
/// Answers of another version: a defect of this program.
pub fn bar_from(up: &str) -> Result<Vec<(String, String)>, ReportError> {
    let answers: Value = serde_json::from_str(ANSWERS).map_err(|e| refused("index", &e))?;
    let effects = answers["answers"].as_array().into_iter().flatten();
    let effects = effects.filter_map(|answer| answer["effect"].as_str());
    let of_bake = ["index", "explore"].into_iter().chain(effects);
    let of_bake = of_bake.map(|page| (page.to_string(), format!("{up}{page}.html")));
    Ok(of_bake.chain(BESIDE.map(|(word, _, file)| (word.to_string(), format!("{up}{file}")))).collect())
}
