//! `lobefit cost SCENE --page FILE.html`: the page of what accuracy costs.

use std::path::Path;

use super::super::CliError;
use super::super::input::{self, Input};
use super::super::output::{Outcome, print};
use super::super::progress::Bar;
use super::from::{bake_in, counts_in, offline_in, searches_in, times_in};
use super::{Options, origin};
use crate::bake::{BakeError, Baked, Selection};
use crate::emit::manifest::Manifest;
use crate::plan;
use crate::report::{CostSearch, Costs, GpuRecord, OfflineRecord, bar_from, cost_page};
use crate::store::{Cache, Files, Folder, MANIFEST};
use crate::timing::costs::costs;
use crate::timing::isa::IsaRecord;

/// Where the page lies beside those of a bake.
pub const PAGE: &str = "reports/cost.html";

/// Bakes the scene in memory, and writes the page of its formulas by the records.
pub(super) fn verb(options: &Options, path: &Path) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    let beside = Beside::read(&options.records)?;
    let mut folder = Folder::open_flat(path.parent().unwrap_or(Path::new("")))?;
    let (progress, cache) = (Bar::new(options.quiet, (&input.scene, &plan), 0), Cache::of_user());
    let page = options.threads.install(|| {
        let selection = Selection { cache: cache.as_ref(), ..Selection::default() };
        let baked = input.bake(&plan, selection, &progress)?;
        beside.page(&input, &baked, (options, path))
    })?;
    drop(progress);
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    folder.write(&Files::from([(name, page.into_bytes())]))?;
    if !options.quiet {
        print(format!("{} written\n", path.display()).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// What the page takes from the folder of the records.
pub struct Beside {
    counts: Vec<IsaRecord>,
    times: Vec<GpuRecord>,
    offline: Vec<OfflineRecord>,
    searches: Vec<CostSearch>,
    manifest: Manifest,
}

impl Beside {
    /// Reads records, and the manifest of the bake beside them.
    ///
    /// # Errors
    /// A file that is no record; a folder without a manifest of this version.
    pub fn read(folder: &Path) -> Result<Beside, CliError> {
        let (counts, times, offline) = (counts_in(folder)?, times_in(folder)?, offline_in(folder)?);
        let searches = searches_in(folder)?;
        let (files, _) = bake_in(folder)?;
        let manifest = Manifest::read(files.get(MANIFEST).map_or(&[], Vec::as_slice))?;
        Ok(Beside { counts, times, offline, searches, manifest })
    }

    /// The page at `path` of the formulas of a scene, which is baked.
    ///
    /// # Errors
    /// A bake without formulas; a page that refuses its data.
    pub fn page(
        self,
        input: &Input,
        baked: &Baked,
        (options, path): (&Options, &Path),
    ) -> Result<String, CliError> {
        let scene = &input.scene.name;
        let (timed, times): (Vec<GpuRecord>, Vec<GpuRecord>) =
            self.times.into_iter().partition(|record| record.origin.scene == *scene);
        let (units, jobs) = costs(baked, scene, &self.counts, &timed)?;
        let mut origin = origin(input, &plan::plan(&input.scene), &command(options, path))?;
        if path == Path::new(PAGE) {
            origin.pages = bar_from("").map_err(BakeError::from)?;
            origin = origin.with_figures("../manifest.json");
        }
        let (tables, searches, offline) = (self.manifest.entries.tables, self.searches, self.offline);
        Ok(cost_page(&Costs { origin, units, jobs, tables, times, searches, offline })
            .map_err(BakeError::from)?)
    }
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
