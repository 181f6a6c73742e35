//! `lobefit bake`: the main job.

use std::path::PathBuf;

use clap::Args;

use super::options::{SceneOption, ThreadsOption, effect};
use super::output::{Outcome, print, say};
use super::progress::Bar;
use super::{CliError, input, input::Input};
use crate::bake::{Baked, Selection, previous, recipe, sign};
use crate::emit::header::{operations, place, short};
use crate::plan::{self, Plan};
use crate::scene::escape::visible;
use crate::store::{Folder, MANIFEST, Written};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit bake                          the built-in scene, into the current folder
  lobefit bake scene.json --out assets  a scene of your own, into assets/
  lobefit bake --only anisotropy,glass  these effects again; the others stay as they are

Writes tables/ fits/ reports/ and manifest.json in the output folder and nothing else. Files that an older bake left
there and this one does not have are removed.";

/// Options of `bake`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    pub scene: SceneOption,
    /// Output folder, created if missing
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    /// Bake these effects only and keep what an older bake of the same recipe, by the same build of
    /// lobefit, left in the output folder of the others. An effect that the scene does not call for
    /// is refused with the reason from the plan
    #[arg(long, value_name = "EFFECT", value_delimiter = ',', value_parser = effect)]
    pub only: Vec<String>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the manifest as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    refuse_uncalled(&options.only, &plan)?;
    // Before the work: an output that cannot be written is known now, not after it.
    let mut folder = Folder::open(&options.out)?;
    let progress = Bar::new(options.quiet || options.json, &plan, 0);
    let selection = selection(options, &input, &plan)?;
    let mut baked = options.threads.install(|| input.bake(&plan, selection, &progress))?;
    drop(progress);
    for promise in &baked.broken {
        say(&format!("promise not kept: {}", visible(promise)));
    }
    if !baked.broken.is_empty() {
        say("nothing written");
        return Ok(Outcome::Failed);
    }
    sign(&mut baked.files);
    let written = folder.write(&baked.files)?;
    if options.json {
        print(baked.files.get(MANIFEST).map_or(&[], Vec::as_slice))?;
    } else if !options.quiet {
        print(summary(&plan, &baked, &written).as_bytes())?;
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
fn selection(options: &Options, input: &Input, plan: &Plan) -> Result<Selection, CliError> {
    if options.only.is_empty() {
        return Ok(Selection::default());
    }
    let recipe = recipe(&input.scene, plan, &input.hypotheses)?;
    let kept = previous(&options.out, &recipe, plan, &options.only)?;
    Ok(Selection { only: options.only.clone(), kept })
}

/// What was made, a line each.
fn summary(plan: &Plan, baked: &Baked, written: &Written) -> String {
    let mut lines = Vec::new();
    for a in baked.tables.iter().map(|t| &t.approximation) {
        let at = place(&a.certificate.at);
        lines.push(format!(
            "{}: lookup error {} at {at}; {} bytes",
            a.name, a.certificate.max_abs, a.cost.bytes
        ));
    }
    let emitted = baked.fits.iter().filter(|f| f.emitted && f.wraps.is_none());
    for a in emitted.map(|f| &f.approximation) {
        let (c, ops) = (&a.certificate, a.cost.ops);
        lines.push(format!("{}: {}, max error {}, rms {}", a.name, operations(ops), c.max_abs, short(c.rms)));
    }
    for d in &baked.dropped {
        // A hypothesis that is too dear is so in any norm.
        let norm = if d.norm == "any" { String::new() } else { format!(" ({})", d.norm) };
        lines.push(format!("{}{norm} left out: {}", d.hypothesis, d.reason));
    }
    if plan.is_empty() {
        lines.push("the scene calls for no effect:".into());
        lines.extend(plan.left_out.iter().map(|l| format!("  {}: {}", l.effect, l.reason)));
    }
    let (new, same, gone) = (written.written.len(), written.unchanged.len(), written.removed.len());
    lines.push(format!("{new} files written, {same} unchanged, {gone} removed"));
    // Reasons quote the scene's names.
    lines.iter().map(|line| visible(line) + "\n").collect()
}
