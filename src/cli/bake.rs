//! `lobefit bake`: the main job.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Deserialize;
use serde::de::IgnoredAny;

use super::calls::{MARK, cosines, table};
use super::check::{FILE_BYTES, for_shaders};
use super::options::{PagesOption, SceneOption, ThreadsOption, effect, shard};
use super::output::{Outcome, files, print, say, say_broken, say_each};
use super::progress::Bar;
use super::{CliError, input, input::Input};
use crate::bake::{Baked, Selection, Shard, changed, previous, recipe, sign};
use crate::data::{Engine, natural};
use crate::effects::{PATH_TRACER, PATH_TRACER_CONVENTIONS, rule};
use crate::emit::call::Call;
use crate::emit::container::SIDECAR;
use crate::plan::{self, Plan};
use crate::report::without_absent;
use crate::scene::Scene;
use crate::scene::escape::visible;
use crate::store::{self, Cache, Files, Folder, MANIFEST, Written};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit bake                          the built-in scene, into the current folder
  lobefit bake scene.json --out assets  a scene of your own, into assets/
  lobefit bake --only anisotropy,glass  these effects again; the others stay as they are
  lobefit bake scene.json --shard 2/3 --out shards
                                        the second of three pieces, for `lobefit merge`

Writes tables/ fits/ reports/ and manifest.json in the output folder and nothing else. Files that an older bake left
there and this one does not have are removed.";

/// Options of `bake`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    pub scene: SceneOption,
    #[command(flatten)]
    pub pages: PagesOption,
    #[command(flatten)]
    pub output: OutputOptions,
    /// Bake these effects only and keep what an older bake of the same recipe, by the same build of
    /// lobefit, left in the output folder of the others. An effect that the scene does not call for
    /// is refused with the reason from the plan
    #[arg(long, value_name = "EFFECT", value_delimiter = ',', value_parser = effect())]
    pub only: Vec<String>,
    /// Make piece K of N, the file shard-K-of-N.lobefit in the output folder and nothing else; `lobefit
    /// merge` puts the pieces together. An effect is in one piece
    #[arg(long, value_name = "K/N", value_parser = shard, conflicts_with_all = ["only", "json"])]
    pub shard: Option<Shard>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Compute everything, and keep nothing for other bakes (see `lobefit cache`)
    #[arg(long)]
    pub no_cache: bool,
}

/// Where a bake goes, and what it says at its end.
#[derive(Args)]
pub(super) struct OutputOptions {
    /// Output folder, created if missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    /// Print the manifest as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?.with(&options.pages);
    let plan = plan::plan(&input.scene);
    refuse_uncalled(&options.only, &plan)?;
    refuse_to_empty(&options.output.out, &input, &plan)?;
    // Before the work: an output that cannot be written is known now, not after it.
    let (out, quiet) = (&options.output.out, options.output.quiet || options.output.json);
    let folder = if options.shard.is_some() { Folder::open_flat(out)? } else { Folder::open(out)? };
    if !quiet {
        input::say_notes(&input.scene.notes);
        let doubted = plan.effects.iter().flat_map(|called| &called.jobs).filter(|job| job.doubt.is_some());
        say_each("note", &doubted.map(|job| format!("{}: {}", job.name, job.said())).collect::<Vec<_>>());
    }
    let progress = Bar::new(quiet, (&input.scene, &plan), 0);
    let cache = if options.no_cache { None } else { Cache::of_user() };
    if let Some(shard) = options.shard {
        let made = options.threads.install(|| input.shard(&plan, shard, cache.as_ref(), &progress))?;
        drop(progress);
        say_failed(cache.as_ref());
        return write_shard(shard, made, folder, options);
    }
    let selection = Selection { cache: cache.as_ref(), whole: true, ..selection(options, &input, &plan)? };
    let baked = options.threads.install(|| input.bake(&plan, selection, &progress))?;
    drop(progress);
    say_failed(cache.as_ref());
    finish(baked, (&input.scene, &plan), folder, &options.output)
}

/// How many effects a manifest has: the rest of it is not kept, for anybody may have written it.
#[derive(Deserialize)]
struct Effects {
    #[serde(default)]
    effects: Vec<IgnoredAny>,
}

/// A scene that calls for nothing would remove all that lies in a folder of another bake: an empty list is
/// more often a mistake of what wrote it. A folder whose bake has no effects has nothing to lose.
fn refuse_to_empty(out: &Path, input: &Input, plan: &Plan) -> Result<(), CliError> {
    if !plan.is_empty() {
        return Ok(());
    }
    let bytes = store::read(&out.join(MANIFEST), FILE_BYTES).ok();
    let old = bytes.and_then(|bytes| serde_json::from_slice::<Effects>(&bytes).ok());
    if old.is_none_or(|manifest| manifest.effects.is_empty()) {
        return Ok(());
    }
    Err(CliError::Usage(format!(
        "{}: it calls for nothing, and {} holds a bake, of which nothing would stay: remove it by hand, or name another folder",
        input.name,
        out.display()
    )))
}

/// Says why a cache could not be written.
fn say_failed(cache: Option<&Cache>) {
    if let Some(error) = cache.and_then(Cache::failed) {
        say(&format!("note: nothing is kept for other bakes: {}", visible(&error.to_string())));
    }
}

/// Whether promises of the scene are not kept, which is said: nothing is written then.
fn is_broken(broken: &[String]) -> bool {
    say_broken(broken);
    if !broken.is_empty() {
        say("nothing written");
    }
    !broken.is_empty()
}

/// Writes the file of a shard, which keeps its promises.
fn write_shard(
    shard: Shard,
    (bytes, broken): (Vec<u8>, Vec<String>),
    mut folder: Folder,
    options: &Options,
) -> Result<Outcome, CliError> {
    if is_broken(&broken) {
        return Ok(Outcome::Failed);
    }
    let name = shard.file();
    folder.write(&Files::from([(name.clone(), bytes)]))?;
    if !options.output.quiet {
        print(format!("{} written\n", options.output.out.join(name).display()).as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// Writes a bake that keeps its promises, and says what it gives.
pub(super) fn finish(
    mut baked: Baked,
    (scene, plan): (&Scene, &Plan),
    mut folder: Folder,
    output: &OutputOptions,
) -> Result<Outcome, CliError> {
    if is_broken(&baked.broken) {
        return Ok(Outcome::Failed);
    }
    without_absent(&mut baked.files, &output.out);
    let changed = changed_since(&output.out, &baked)?;
    sign(&mut baked.files);
    let written = folder.write(&baked.files)?;
    if output.json {
        print(baked.files.get(MANIFEST).map_or(&[], Vec::as_slice))?;
    } else if !output.quiet {
        let lines = [
            summary((scene, plan), &baked, &output.out),
            written_files(&baked, &written, changed, &output.out),
        ];
        // Reasons quote the scene's names.
        print(lines.concat().iter().map(|line| visible(line) + "\n").collect::<String>().as_bytes())?;
    }
    Ok(Outcome::Done)
}

/// An effect asked for by name must be one that the scene calls for.
fn refuse_uncalled(only: &[String], plan: &Plan) -> Result<(), CliError> {
    let uncalled = |name: &&String| !plan.effects.iter().any(|e| e.effect == **name);
    let Some(name) = only.iter().find(uncalled) else { return Ok(()) };
    let left_out = plan.left_out.iter().find(|l| l.effect == *name);
    let reason = left_out.map_or("it is not called for", |l| l.reason.as_str());
    Err(CliError::Usage(format!("--only {}: {}", name, visible(reason))))
}

/// The effects to bake, with the parts of the others that lie in the output folder.
fn selection(options: &Options, input: &Input, plan: &Plan) -> Result<Selection<'static>, CliError> {
    if options.only.is_empty() {
        return Ok(Selection::default());
    }
    let recipe = recipe(&input.scene, plan, &input.hypotheses)?;
    let kept = previous(&options.output.out, &recipe, plan, &options.only)?;
    Ok(Selection { only: options.only.clone(), kept, ..Selection::default() })
}

/// What was made: what each material and probe calls, or everything where more than one function of
/// a job is emitted; then what was left out.
fn summary((scene, plan): (&Scene, &Plan), baked: &Baked, out: &Path) -> Vec<String> {
    let mut lines = table(&baked.calls, scene.output.cost, scene);
    lines.extend(recommended(&baked.calls));
    lines.extend(cosines(&baked.calls, scene));
    let own = baked.calls.iter().any(|call| call.function.starts_with(PATH_TRACER));
    lines.extend(own.then(|| PATH_TRACER_CONVENTIONS.into()));
    for job in plan.effects.iter().flat_map(|effect| &effect.jobs) {
        lines.extend(job.merging.as_ref().map(|merging| format!("{}: {merging}", job.name)));
    }
    // A hypothesis that costs too much is so in any norm, and is the user's: of ours those are passed over.
    let (dear, ours): (Vec<_>, Vec<_>) = baked.dropped.iter().partition(|dropped| dropped.norm == "any");
    lines.extend(dear.iter().map(|dropped| format!("{} left out: {}", dropped.hypothesis, dropped.reason)));
    if !ours.is_empty() {
        // Formulas of fewer inputs have one name in every effect.
        let mut by_effect: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        ours.iter()
            .for_each(|dropped| by_effect.entry(&dropped.effect).or_default().push(&dropped.hypothesis));
        let several = by_effect.len() > 1;
        let of_effect = |(effect, mut names): (&str, Vec<&str>)| {
            names.sort_by(|a, b| natural(a, b));
            names.dedup();
            let of = if several { format!(" of {effect}") } else { String::new() };
            names.join(", ") + &of
        };
        let names = by_effect.into_iter().map(of_effect).collect::<Vec<_>>().join("; ");
        lines.push(format!("without a reliable fit over this scene's ranges, and left out: {names} (why: manifest.json, fits_left_out)"));
    }
    if plan.is_empty() {
        lines.push("the scene calls for no effect:".into());
        lines.extend(plan.left_out.iter().map(|l| format!("  {}: {}", l.effect, l.reason)));
    }
    lines.extend(read_by_engines(baked, out));
    lines
}

/// What of an older bake in the output folder a shader reads otherwise now; none where there is no older
/// bake.
fn changed_since(out: &Path, baked: &Baked) -> Result<Option<Vec<String>>, CliError> {
    let files = baked.files.keys().map(String::as_str);
    let found = store::read_set(out, files, FILE_BYTES)?;
    Ok(found.contains_key(MANIFEST).then(|| changed(&baked.files, &found)))
}

/// How many files were written, and what that changes for shaders.
fn written_files(baked: &Baked, written: &Written, changed: Option<Vec<String>>, out: &Path) -> Vec<String> {
    let mut lines: Vec<String> = changed.iter().map(|changed| for_shaders(changed)).collect();
    let index = out.join("reports/index.html");
    let page = if baked.files.contains_key("reports/index.html") {
        format!("; {}", index.display())
    } else {
        String::new()
    };
    lines.push(format!("{}, {} removed{page}", files(written), written.removed.len()));
    lines
}

/// What the mark before a function means; none where no function is marked.
fn recommended(calls: &[Call]) -> Option<String> {
    let mut rules: Vec<String> = calls.iter().filter(|call| call.is_preferred(calls)).map(rule).collect();
    rules.sort_by(|a, b| natural(a, b));
    rules.dedup();
    (!rules.is_empty()).then(|| format!("{MARK} is recommended: {}", rules.join("; ")))
}

/// The engine that a file of a pair of area lights is for; none of all others.
fn engine_of(file: &str) -> Option<Engine> {
    Engine::ALL.into_iter().find(|engine| file.ends_with(&format!(".{}", engine.extension())))
}

/// The files that an engine reads, without what describes tables: include files and tables, as a
/// shell would write them.
fn read_by_engines(baked: &Baked, out: &Path) -> Option<String> {
    let of = |verb: &str, start: &str| {
        let read = baked.files.keys().filter(|file| !file.ends_with(SIDECAR) && engine_of(file).is_none());
        let mut ends: Vec<&str> = read.filter_map(|file| file.strip_prefix(start)).collect();
        ends.sort_by(|a, b| natural(a, b));
        let at = out.join(start).display().to_string();
        match ends[..] {
            [] => None,
            [end] => Some(format!("{verb} {at}{end}")),
            _ => Some(format!("{verb} {at}{{{}}}", ends.join(","))),
        }
    };
    let mut parts: Vec<String> =
        [of("include", "fits/lobefit."), of("load", "tables/")].into_iter().flatten().collect();
    for (file, engine) in baked.files.keys().filter_map(|file| Some((file, engine_of(file)?))) {
        parts.push(format!("for {} load {}", engine.name(), out.join(file).display()));
    }
    (!parts.is_empty()).then(|| parts.join("; "))
}
