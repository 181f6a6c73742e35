//! How long a bake of each effect of a scene takes beside that of all.

use std::env;
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use super::Options;
use crate::bake::Progress;
use crate::cli::CliError;
use crate::plan::Plan;
use crate::report::{TimedEffect, TimedEffects};
use crate::store;

/// How many bakes [`timed`] makes.
pub(super) fn stages(options: &Options, plan: &Plan) -> usize {
    let from_input = options.scene.scene.as_deref() == Some(Path::new("-"));
    if plan.effects.len() < 2 || from_input { 0 } else { plan.effects.len() + 1 }
}

/// Seconds of a bake of each effect by itself, and of all. Each is a process of its own without the cache,
/// so that none finds what another has integrated. None of a scene of one effect, or from standard input,
/// which can be read once.
pub(super) fn timed(
    options: &Options,
    plan: &Plan,
    progress: &dyn Progress,
) -> Result<Option<TimedEffects>, CliError> {
    if stages(options, plan) == 0 {
        return Ok(None);
    }
    let one = |effect: &'static str| {
        progress.stage(&format!("bake of {effect} alone"));
        Ok(TimedEffect { effect: effect.into(), seconds: seconds(options, Some(effect))? })
    };
    let alone = plan.effects.iter().map(|called| one(called.effect)).collect::<Result<_, CliError>>()?;
    progress.stage("bake of all effects");
    Ok(Some(TimedEffects { alone, all: seconds(options, None)? }))
}

/// Seconds of a process that bakes an effect, or all, into a folder that is then removed.
fn seconds(options: &Options, only: Option<&str>) -> Result<f64, CliError> {
    let folder = store::temporary()?;
    let failed = |program: &Path, reason| CliError::NotRun { program: program.display().to_string(), reason };
    let program = env::current_exe().map_err(|reason| failed(Path::new("lobefit"), reason))?;
    let mut command = Command::new(&program);
    command.args(["bake", "--no-cache", "--quiet", "--out"]).arg(folder.path());
    if options.scene.textures.textures {
        command.arg("--textures");
    }
    let numbers = [
        ("--quantile", options.scene.textures.quantile.map(|share| share.to_string())),
        ("--threads", options.threads.threads.map(|count| count.to_string())),
        ("--only", only.map(String::from)),
    ];
    for (name, value) in numbers.iter().filter_map(|(name, value)| Some((name, value.as_ref()?))) {
        command.args([OsStr::new(name), OsStr::new(value)]);
    }
    // Last, for its name may begin as an option does.
    command.arg("--").args(&options.scene.scene);
    let start = Instant::now();
    let output = command.stdin(Stdio::null()).output().map_err(|reason| failed(&program, reason))?;
    let seconds = start.elapsed().as_secs_f64();
    if output.status.success() {
        return Ok(seconds);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let said = said.trim().trim_start_matches("error: ").to_owned();
    Err(CliError::Alone { effects: only.unwrap_or("all effects").into(), said })
}
