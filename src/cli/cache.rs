//! `lobefit cache`: what bakes have left so that others need not make it again.

use clap::{Args, Subcommand};

use super::CliError;
use super::output::{Outcome, print};
use crate::store::{Cache, Held};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit cache         where the cache is, and what it holds
  lobefit cache clear   remove everything in it

`lobefit bake` keeps what each effect made, and its fits, certificates, truths and texels, each by a hash of all that determines it: the code
of lobefit itself among it. Files are the same with the cache and without (--no-cache). It lies in the folder that LOBEFIT_CACHE names, else in lobefit/ among the system's caches,
and holds 1 GiB at most; what was read longest ago goes first.";

/// Options of `cache`.
#[derive(Args)]
pub(super) struct Options {
    #[command(subcommand)]
    deed: Option<Deed>,
}

#[derive(Subcommand)]
enum Deed {
    /// Remove every entry
    Clear,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let Some(cache) = Cache::of_user() else {
        print(b"no cache: the system has no place for one, and LOBEFIT_CACHE names none\n")?;
        return Ok(Outcome::Done);
    };
    let folder = cache.folder().display();
    let line = match options.deed {
        None => format!("{folder}: {}\n", words(cache.held()?)),
        Some(Deed::Clear) => format!("{folder}: {} removed\n", words(cache.clear()?)),
    };
    print(line.as_bytes())?;
    Ok(Outcome::Done)
}

fn words(Held { entries, bytes }: Held) -> String {
    let entries = if entries == 1 { "1 entry".to_string() } else { format!("{entries} entries") };
    format!("{entries}, {:.1} MiB", bytes as f64 / f64::from(1 << 20))
}
