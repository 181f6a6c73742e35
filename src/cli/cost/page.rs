//! `lobefit cost SCENE --page FILE.html`: the page of what accuracy costs.

use std::path::Path;

use super::super::CliError;
use super::super::input;
use super::super::output::{Outcome, print};
use super::super::progress::Bar;
use super::from::{bake_in, counts_in, times_in};
use super::{Options, origin};
use crate::bake::{BakeError, Selection};
use crate::effects::reflection::bake::findings::reported;
use crate::emit::manifest::Manifest;
use crate::plan;
use crate::report::{Costs, bar_from, cost_page};
use crate::store::{Files, Folder, MANIFEST};
use crate::timing::costs::costs;

/// Where the page lies beside those of a bake.
pub const PAGE: &str = "reports/cost.html";

/// Bakes the scene in memory, and writes the page of its formulas by the records.
pub(super) fn verb(options: &Options, path: &Path) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    let (counts, times) = (counts_in(&options.records)?, times_in(&options.records)?);
    let (files, _) = bake_in(&options.records)?;
    let manifest: Manifest = serde_json::from_slice(files.get(MANIFEST).map_or(&[], Vec::as_slice))?;
    let mut folder = Folder::open_flat(path.parent().unwrap_or(Path::new("")))?;
    let progress = Bar::new(options.quiet, &plan, 0);
    let page = options.threads.install(|| {
        let baked = input.bake(&plan, Selection::default(), &progress)?;
        let (units, jobs) = costs(&baked, &input.scene.name, &counts)?;
        let mut origin = origin(&input, &plan, &command(options, path))?;
        if path == Path::new(PAGE) {
            origin.pages = bar_from("").map_err(BakeError::from)?;
        }
        let studies = reported(input.scene.smith)?;
        let costs = Costs { origin, units, jobs, tables: manifest.entries.tables, times, studies };
        Ok(cost_page(&costs).map_err(BakeError::from)?)
    })?;
    drop(progress);
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    folder.write(&Files::from([(name, page.into_bytes())]))?;
    if !options.quiet {
        print(format!("{} written\n", path.display()).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// What was typed, as the page tells it.
fn command(options: &Options, path: &Path) -> String {
    let scene =
        options.scene.scene.as_ref().map_or_else(String::new, |scene| format!(" {}", scene.display()));
    let records = match options.records.as_path() {
        folder if folder == Path::new(".") => String::new(),
        folder => format!(" --records {}", folder.display()),
    };
    format!("lobefit cost{scene} --page {}{records}", path.display())
}
