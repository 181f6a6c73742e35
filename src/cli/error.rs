//! Everything that ends a verb early, and its exit code.

use std::io;

use super::points::PointsError;
use crate::bake::{BakeError, PreviousError, ShardError};
use crate::report::ReportError;
use crate::scene::SceneError;
use crate::scene::escape::visible;
use crate::store::StoreError;
use crate::timing::record::RecordError;
use lobefit_fit::FitError;
use lobefit_shade::ShadeError;

/// An error of a package whose verb this package runs: its message, and the exit code for it.
pub trait PackageError: std::error::Error + Send + Sync + 'static {
    /// 1 a check or promise failed, 2 bad input or usage, 3 cannot write.
    fn exit_code(&self) -> u8 {
        2
    }
}

/// Why a verb did not do its work.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CliError {
    /// The scene is refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file could not be read or written.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A file of points is refused.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// Options that contradict each other or the input.
    #[error("{0}")]
    Usage(String),
    /// A file of a hypothesis or a kernel that a scene names and that cannot be read.
    #[error("{}: {field}: {source}", visible(scene))]
    NamedFile {
        /// Scene file as the user named it.
        scene: String,
        /// The field that names the file.
        field: String,
        /// What went wrong.
        source: StoreError,
    },
    /// A hypothesis that is refused for what it says.
    #[error(transparent)]
    Hypothesis(#[from] FitError),
    /// A hypothesis file that is not text.
    #[error("{file}: byte {at} is not UTF-8; save the hypothesis as UTF-8")]
    HypothesisText {
        /// The file.
        file: String,
        /// The first bad byte.
        at: usize,
    },
    /// Results could not be put into JSON.
    #[error("cannot print the result as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// Standard output could not be written.
    #[error("standard output: cannot write: {0}")]
    Output(#[source] io::Error),
    /// The worker threads could not be started.
    #[error("cannot start {threads} threads: {reason}; give --threads a smaller number")]
    Threads {
        /// Threads asked for.
        threads: usize,
        /// What the system said.
        reason: String,
    },
    /// A verb of a package above this one ended early.
    #[error("{0}")]
    Package(Box<dyn PackageError>),
    /// The binary of a verb's package is not there.
    #[error(
        "{package} is not built: build it with `cargo build --release -p {package}`, or put the program {package} beside {program} \
         or on PATH"
    )]
    NotBuilt {
        /// The package, and its binary.
        package: &'static str,
        /// The running program.
        program: String,
    },
    /// The binary of a verb's package is there and cannot be run.
    #[error("cannot run {}: {reason}", visible(program))]
    NotRun {
        /// Path of the binary.
        program: String,
        /// The system's message.
        reason: io::Error,
    },
    /// A bake that was to be timed ended early.
    #[error("the bake of {effects} alone failed: {}", visible(said))]
    Alone {
        /// The effect, or all.
        effects: String,
        /// What it said.
        said: String,
    },
    /// A page could not be made.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// An older bake whose other effects cannot be kept.
    #[error("--only: {0}")]
    Previous(#[from] PreviousError),
    /// Files that are not the shards of a bake.
    #[error(transparent)]
    Shard(#[from] ShardError),
    /// A record of times on a graphics processor that cannot be used.
    #[error("{}: {source}", visible(file))]
    Record {
        /// The record as the user named it.
        file: String,
        /// What is wrong with it.
        source: RecordError,
    },
    /// The bake made nothing.
    #[error(transparent)]
    Bake(#[from] Box<BakeError>),
}

impl From<ShadeError> for CliError {
    fn from(error: ShadeError) -> Self {
        FitError::from(error).into()
    }
}

impl CliError {
    /// 1 a check or promise failed, 2 bad input or usage, 3 cannot write.
    pub fn exit_code(&self) -> u8 {
        match self {
            CliError::Output(_) => 3,
            CliError::Store(error) if error.is_write() => 3,
            CliError::Package(error) => error.exit_code(),
            _ => 2,
        }
    }
}

impl From<BakeError> for CliError {
    fn from(error: BakeError) -> CliError {
        CliError::Bake(Box::new(error))
    }
}
