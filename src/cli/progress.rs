//! What a long verb is doing: a bar on a terminal, lines in a log.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

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

/// Between lines of a log about work whose stages are not counted.
const LINES_APART: Duration = Duration::from_secs(10);

/// A spinner with the stage's name, for a verb whose stages are not counted beforehand; where standard
/// error is no terminal, the stage that begins as a line with the seconds so far, where ten have gone
/// since the last.
pub struct Spinner {
    bar: ProgressBar,
    begun: Instant,
    /// When the last line of a log was written; none where no line is.
    line: Option<Mutex<Instant>>,
}

impl Spinner {
    /// Starts it; nothing is shown where quiet is asked for.
    pub fn new(quiet: bool) -> Spinner {
        let terminal = std::io::stderr().is_terminal();
        let shown = !quiet && terminal;
        let bar = if shown { ProgressBar::new_spinner() } else { ProgressBar::hidden() };
        if shown {
            bar.enable_steady_tick(Duration::from_millis(100));
        }
        let begun = Instant::now();
        Spinner { bar, begun, line: (!quiet && !terminal).then(|| Mutex::new(begun)) }
    }

    /// Names the stage that begins.
    pub fn stage(&self, name: &str) {
        self.bar.set_message(name.to_string());
        let Some(Ok(mut last)) = self.line.as_ref().map(Mutex::lock) else { return };
        if last.elapsed() >= LINES_APART {
            *last = Instant::now();
            say(&format!("[{} s] {name}", self.begun.elapsed().as_secs()));
        }
    }
}

impl Progress for Spinner {
    fn stage(&self, name: &str) {
        Spinner::stage(self, name);
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
