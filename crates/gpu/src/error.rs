//! Why nothing was measured on a graphics processor, or compiled for one.

use lobefit::cli::{CliError, PackageError};
use lobefit::report::ReportError;

/// Why nothing was measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// There is no device, or none of the name asked for.
    #[error(
        "--gpu: no graphics processor{}; {}",
        wanted.as_ref().map_or_else(String::new, |name| format!(" whose name holds `{name}`")),
        match found.as_slice() {
            [] => "install a Vulkan driver and loader (Debian: mesa-vulkan-drivers libvulkan1)".to_owned(),
            names => format!("--adapter takes a part of one of: {}", names.join(", ")),
        }
    )]
    NoAdapter {
        /// Part of a name that was asked for.
        wanted: Option<String>,
        /// Those that there are.
        found: Vec<String>,
    },
    /// The device was not opened, or it or its driver failed at work.
    #[error("--gpu: {0}")]
    Device(String),
    /// A function returned what is no number.
    #[error("--gpu: {adapter}, {function}: a result is not finite")]
    NotFinite {
        /// Name of the device.
        adapter: String,
        /// The function.
        function: String,
    },
    /// The emitted code or manifest is not as this program writes it.
    #[error("{place}: {reason}")]
    Bake {
        /// The file, or the function.
        place: String,
        /// What is wrong.
        reason: String,
    },
    /// No driver compiles, or not for what was asked for.
    #[error("{0}")]
    Driver(String),
    /// The page refused its data.
    #[error(transparent)]
    Report(#[from] ReportError),
}

impl PackageError for GpuError {}

impl From<GpuError> for CliError {
    fn from(error: GpuError) -> CliError {
        CliError::Package(Box::new(error))
    }
}
