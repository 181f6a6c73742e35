//! The binary: everything is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    lobefit_formula::run(std::env::args_os())
}
