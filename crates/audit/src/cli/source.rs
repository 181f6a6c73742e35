//! Options of a shader's source: the function that is meant, and what stands around the file.

use std::path::PathBuf;

use clap::Args;

use super::origin::named;
use super::words::setting;
use crate::foreign::{ForeignError, LeftOut, ShaderFunction, Surroundings, holds_functions, read_functions};
use lobefit::cli::output::say;
use lobefit::report::words;

#[derive(Args)]
pub(super) struct SourceOptions {
    /// Function of a shader; `name(float, vec3)` where several have that name
    #[arg(long, value_name = "NAME")]
    pub function: Option<String>,
    /// Macro of a shader's preprocessor
    #[arg(long, value_name = "NAME[=VALUE]")]
    pub define: Vec<String>,
    /// Folder that a shader may include files from, or a file that stands before it
    #[arg(long, value_name = "DIR")]
    pub include: Vec<PathBuf>,
    /// Value of an argument that is no input; a vector or a structure may be set by its name
    #[arg(long, value_name = "NAME=VALUE", value_parser = setting)]
    pub set: Vec<(String, f64)>,
}

impl SourceOptions {
    /// The functions that may be meant, of a file's bytes.
    pub fn read(&self, bytes: &[u8], file: &str) -> Result<Vec<ShaderFunction>, ForeignError> {
        let around = Surroundings { defines: self.define.clone(), includes: self.include.clone() };
        read_functions(bytes, file, self.function.as_deref(), &around)
    }

    /// Whether a file has functions of its own, as far as it can be read.
    pub fn holds_functions(&self, bytes: &[u8], file: &str) -> bool {
        let around = Surroundings { defines: self.define.clone(), includes: self.include.clone() };
        holds_functions(bytes, file, &around)
    }

    /// The options as they are typed.
    pub fn words(&self) -> impl Iterator<Item = String> {
        let function = self.function.iter().map(|f| named("--function", f));
        let define = self.define.iter().map(|d| named("--define", d));
        let include = self.include.iter().map(|i| named("--include", &i.display().to_string()));
        let set = self.set.iter().map(|(name, value)| named("--set", &format!("{name}={value}")));
        function.chain(define).chain(include).chain(set)
    }
}

/// Functions left out that are named.
const NAMED: usize = 4;

/// Says which functions of a file are left out, each with the reason.
pub(super) fn say_left_out(file: &str, all: &[LeftOut]) {
    if all.is_empty() {
        return;
    }
    let mut named: Vec<String> =
        all.iter().take(NAMED).map(|one| format!("`{}` ({})", one.name, one.reason)).collect();
    let others = all.len() - named.len();
    named.extend((others > 0).then(|| words::count(others, "other", "others")));
    say(&format!("{file}: left out: {}", named.join(", ")));
}
