//! `lobefit plan`: what a scene calls for, what it leaves out and why.

use std::fmt::Write;

use clap::Args;
use lobefit_import::{About, Note};
use serde::Serialize;

use super::CliError;
use super::input;
use super::options::SceneOption;
use super::output::{Outcome, print, print_json};
use crate::effects::Called;
use crate::emit::header::short;
use crate::plan::{self, Plan};
use crate::scene::UNNAMED;
use crate::scene::escape::visible;

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit plan                          the built-in scene
  lobefit plan scene.json               a scene of your own
  lobefit plan room.glb                 the materials of a glTF file; of MaterialX: room.mtlx
  lobefit plan room.glb --textures      the same over the values of its images
  lobefit plan scene.json --json        the same for machines";

/// Reasons of an effect that are named.
const REASONS: usize = 3;

/// Options of `plan`.
#[derive(Args)]
pub(super) struct Options {
    #[command(flatten)]
    scene: SceneOption,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Print no messages beside the result (there are none)
    #[arg(long, short)]
    quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let input = input::load(&options.scene)?;
    let plan = plan::plan(&input.scene);
    if options.json {
        print_json(&Planned { plan: &plan, notes: &input.scene.notes })?
    } else {
        print(text(&plan, &input.scene.notes).as_bytes())?
    }
    Ok(Outcome::Done)
}

/// The plan for machines.
#[derive(Serialize)]
struct Planned<'a> {
    #[serde(flatten)]
    plan: &'a Plan,
    /// What a foreign file says that the scene does not hold.
    #[serde(skip_serializing_if = "<[Note]>::is_empty")]
    notes: &'a [Note],
}

/// Most characters of a list of effects that reasons are aligned after.
const COLUMN: usize = 32;

/// The plan for people.
fn text(plan: &Plan, notes: &[Note]) -> String {
    let named = plan.scene != UNNAMED;
    let mut out = if named { format!("scene {}\n", visible(&plan.scene)) } else { String::new() };
    if plan.is_empty() {
        out += "nothing to bake\n";
    }
    for effect in &plan.effects {
        out += &effect_text(effect);
    }
    out += "left out\n";
    let of_one_reason = plan.left_out.chunk_by(|a, b| a.reason == b.reason).map(|all| {
        (all.iter().map(|left| left.effect).collect::<Vec<_>>().join(", "), visible(&all[0].reason))
    });
    let left_out: Vec<_> = of_one_reason.collect();
    let widths = left_out.iter().map(|(effects, _)| effects.len());
    let width = widths.filter(|width| *width <= COLUMN).max().unwrap_or(0);
    for (effects, reason) in left_out {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  {effects:<width$}  {reason}");
    }
    for (about, title) in [(About::Missing, "not in this version"), (About::Reading, "notes")] {
        let all: Vec<&Note> = notes.iter().filter(|note| note.about == about).collect();
        if !all.is_empty() {
            let _ = writeln!(out, "{title}");
        }
        for note in all {
            let _ = writeln!(out, "  {}", visible(&note.to_string()));
        }
    }
    out
}

fn effect_text(effect: &Called) -> String {
    let all = bytes(effect.bytes, effect.bytes_at_most);
    let mut out = format!("{}: in all {all}, about {:.1} s on one core\n", effect.effect, effect.seconds);
    let shown = if effect.reasons.len() > REASONS + 1 { REASONS } else { effect.reasons.len() };
    for reason in &effect.reasons[..shown] {
        let _ = writeln!(out, "  because {}", visible(reason));
    }
    if shown < effect.reasons.len() {
        let _ = writeln!(out, "  because of {} more (--json names them)", effect.reasons.len() - shown);
    }
    for job in &effect.jobs {
        let ranges: Vec<String> = job
            .ranges
            .iter()
            .map(|(name, [lo, hi])| match lo == hi {
                true => format!("{name} {}", short(*lo)),
                false => format!("{name} {} to {}", short(*lo), short(*hi)),
            })
            .collect();
        let over = if ranges.is_empty() { String::new() } else { format!("over {}; ", ranges.join(", ")) };
        let _ = writeln!(
            out,
            "  {}: {}; {over}{}; {}; about {:.1} s",
            job.name,
            job.said(),
            job.limit(),
            bytes(job.bytes, job.bytes_at_most),
            job.seconds
        );
        if let Some(merging) = &job.merging {
            let _ = writeln!(out, "    merged: {}", visible(merging));
        }
    }
    out
}

fn bytes(count: u64, at_most: bool) -> String {
    format!("{}{count} bytes", if at_most { "at most " } else { "" })
}
