//! `lobefit fit --search`: formulas for a quantity.

use super::Options;
use crate::search::{self, SearchJob};
use lobefit::cli::CliError;
use lobefit::cli::output::{Outcome, print, say};
use lobefit::cli::progress::Spinner;
use lobefit::scene::escape::visible;
use lobefit::store::Folder;
use lobefit_fit::search::Progress;

pub(super) fn run(options: &Options, job: &SearchJob) -> Result<Outcome, CliError> {
    let mut folder = options.out.as_deref().map(Folder::open_flat).transpose()?;
    let spinner = Spinner::new(options.quiet || options.json);
    spinner.stage("integrating");
    let (searched, files) = options.threads.install(|| {
        let searched = search::run(job, &|at| spinner.stage(&told(at)))?;
        let kept = folder.is_some() && searched.problem(job.limit).is_none();
        let files = if kept { search::files(job, &searched)? } else { Default::default() };
        Ok((searched, files))
    })?;
    drop(spinner);
    if options.json {
        print(&search::document(job, &searched)?)?;
    } else if !options.quiet {
        let summary = search::summary(&searched, folder.is_some());
        let shown: String = summary.lines().map(|line| visible(line) + "\n").collect();
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
            print(super::written_files(options, &written).as_bytes())?;
        }
    }
    Ok(Outcome::Done)
}

/// How far a search is.
fn told(at: &Progress) -> String {
    let Progress { trial, sweep, sweeps, ops, max_ops, forms, best, .. } = at;
    let trial = trial.map_or(String::new(), |[k, count]| format!("what pays ({k} of {count}): "));
    format!(
        "{trial}sweep {} of at most {sweeps}, {ops} of {max_ops} operations, {forms} forms tried, error {best:.5} so far",
        sweep + 1
    )
}
