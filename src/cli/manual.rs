//! `lobefit completions` and `lobefit man`: what shells and `man` know of the program, from the
//! same declarations as its help.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_complete::Shell;
use clap_mangen::Man;

use super::CliError;
use super::output::{Outcome, print};
use crate::store::{Files, Folder};

pub(super) const COMPLETIONS: &str = "\
Examples:
  lobefit completions bash > /etc/bash_completion.d/lobefit
  lobefit completions zsh > ~/.zfunc/_lobefit
  lobefit completions fish > ~/.config/fish/completions/lobefit.fish";

pub(super) const MAN: &str = "\
Examples:
  lobefit man ~/.local/share/man/man1   then: man lobefit, man lobefit-bake, ...";

/// Options of `completions`.
#[derive(Args)]
pub(super) struct CompletionOptions {
    /// Shell that completes
    pub shell: Shell,
}

/// Options of `man`.
#[derive(Args)]
pub(super) struct ManOptions {
    /// Folder for lobefit.1 and a page for each verb; made if it is not there
    pub dir: PathBuf,
}

/// Prints the completions of a program.
pub(super) fn completions(options: &CompletionOptions, mut program: Command) -> Result<Outcome, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut program, "lobefit", &mut script);
    print(&script)?;
    Ok(Outcome::Done)
}

/// Writes the manual pages of a program and of its verbs.
pub(super) fn man(options: &ManOptions, program: Command) -> Result<Outcome, CliError> {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let verbs = program.get_subcommands().cloned();
    let mut pages = Files::new();
    for command in verbs.chain([program.clone()]) {
        let (man, mut page) = (Man::new(command), Vec::new());
        man.render(&mut page).map_err(CliError::Output)?;
        pages.insert(man.get_filename(), page);
    }
    Folder::open_flat(&options.dir)?.write(&pages)?;
    Ok(Outcome::Done)
}
