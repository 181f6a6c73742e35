//! `lobefit fit --search`: formulas for a quantity.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::Options;
use crate::cli::CliError;
use crate::cli::output::{Outcome, print, say};
use crate::fit::search::Progress;
use crate::fitting::search::{self, SearchJob};
use crate::scene::escape::visible;
use crate::store::Folder;

pub(super) fn run(options: &Options, job: &SearchJob) -> Result<Outcome, CliError> {
    let mut folder = options.out.as_deref().map(Folder::open_flat).transpose()?;
    let bar = Bar::new(options.quiet || options.json);
    let (searched, files) = options.threads.install(|| {
        let searched = search::run(job, &|progress| bar.tell(progress))?;
        let kept = folder.is_some() && searched.problem(job.limit).is_none();
        let files = if kept { search::files(job, &searched)? } else { Default::default() };
        Ok((searched, files))
    })?;
    drop(bar);
    if options.json {
        print(&search::document(job, &searched)?)?;
    } else if !options.quiet {
        let shown: String = search::summary(&searched).lines().map(|line| visible(line) + "\n").collect();
        print(shown.as_bytes())?;
    }
    if let Some(problem) = searched.problem(job.limit) {
        say(&problem);
        if folder.is_some() {
            say("nothing written");
        }
        return Ok(Outcome::Failed);
    }
    if let Some(folder) = &mut folder {
        let written = folder.write(&files)?;
        if !options.quiet && !options.json {
            let (new, same) = (written.written.len(), written.unchanged.len());
            print(format!("\n{new} files written, {same} unchanged\n").as_bytes())?;
        }
    }
    Ok(Outcome::Done)
}

/// A bar of the costs gone through, on a terminal.
struct Bar(ProgressBar);

impl Bar {
    fn new(quiet: bool) -> Bar {
        let shown = !quiet && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(1), target);
        if let Ok(style) = ProgressStyle::with_template("{spinner} [{bar:24}] {msg} [{elapsed}]") {
            bar.set_style(style);
        }
        Bar(bar)
    }

    fn tell(&self, at: &Progress) {
        self.0.set_length(at.sweeps as u64 * u64::from(at.max_ops));
        self.0.set_position(at.sweep as u64 * u64::from(at.max_ops) + u64::from(at.ops));
        self.0.set_message(format!("{} operations: {:.5} after {} forms", at.ops, at.best, at.forms));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
