//! What a long verb is doing: a bar on a terminal, lines in a log.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::output::say;
use crate::bake::Progress;
use crate::effects::{self, Called};
use crate::plan::Plan;
use crate::scene::Scene;

/// A bar on standard error with the stage's name; a line for each stage where standard error is no
/// terminal; nothing where quiet is asked for.
pub struct Bar {
    bar: ProgressBar,
    lines: bool,
}

impl Bar {
    /// Starts the bar of the stages of a scene's plan and `more` of the verb's own.
    pub fn new(quiet: bool, (scene, plan): (&Scene, &Plan), more: usize) -> Bar {
        let terminal = std::io::stderr().is_terminal();
        let shown = !quiet && terminal;
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some((stages(scene, plan) + more) as u64), target);
        if let Ok(style) = ProgressStyle::with_template("{spinner} [{bar:24}] {pos}/{len} {msg} [{elapsed}]")
        {
            bar.set_style(style);
        }
        if shown {
            bar.enable_steady_tick(Duration::from_millis(100));
        }
        Bar { bar, lines: !quiet && !terminal }
    }
}

/// Stages that a bake announces: each job, and the page of each effect.
fn stages(scene: &Scene, plan: &Plan) -> usize {
    let pages = usize::from(scene.output.reports);
    let of = |called: &Called| {
        let effect = effects::named(effects::catalogue(), called.effect);
        effect.map_or(called.work.len(), |effect| effect.stages(scene, &called.work)) + pages
    };
    plan.effects.iter().map(of).sum()
}

impl Progress for Bar {
    fn stage(&self, name: &str) {
        // The stage that begins is not done yet.
        if !self.bar.message().is_empty() {
            self.bar.inc(1);
        }
        self.bar.set_message(name.to_string());
        if self.lines {
            say(&format!("[{}/{}] {name}", self.bar.position() + 1, self.bar.length().unwrap_or_default()));
        }
    }
}

/// A spinner with the stage's name, for a verb whose stages are not counted beforehand.
pub struct Spinner(ProgressBar);

impl Spinner {
    /// Starts it; nothing is shown where standard error is no terminal, or quiet is asked for.
    pub fn new(quiet: bool) -> Spinner {
        let shown = !quiet && std::io::stderr().is_terminal();
        let bar = if shown { ProgressBar::new_spinner() } else { ProgressBar::hidden() };
        if shown {
            bar.enable_steady_tick(Duration::from_millis(100));
        }
        Spinner(bar)
    }

    /// Names the stage that begins.
    pub fn stage(&self, name: &str) {
        self.0.set_message(name.to_string());
    }
}

impl Progress for Spinner {
    fn stage(&self, name: &str) {
        Spinner::stage(self, name);
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
