//! Why nothing was measured on a graphics processor, or compiled for one.

use std::path::PathBuf;

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
    /// The device was not opened.
    #[error("--gpu: {adapter}: {reason}; take another with --adapter")]
    Refused {
        /// Name of the device.
        adapter: String,
        /// What the driver said.
        reason: String,
    },
    /// The device or its driver failed at work.
    #[error("--gpu: {adapter}, {doing}: {reason}; take another with --adapter, or less work with --reduced")]
    Failed {
        /// Name of the device.
        adapter: String,
        /// What it was to do.
        doing: String,
        /// What the driver said.
        reason: String,
    },
    /// The clock stood still, or ran back.
    #[error("--gpu: {adapter}, {doing}: the clock did not advance")]
    Clock {
        /// Name of the device.
        adapter: String,
        /// What was timed.
        doing: String,
    },
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
    /// There is no driver that compiles.
    #[error("--isa: no driver {driver}: {reason}; {install}")]
    NoDriver {
        /// The driver.
        driver: &'static str,
        /// What the system said.
        reason: String,
        /// What to install.
        install: &'static str,
    },
    /// Drivers for the family's vendor are built by a script.
    #[error(
        "--isa: family {family}: compiling for {driver} takes --drivers DIR, a folder that {script} writes"
    )]
    NoFolder {
        /// The family that was asked for.
        family: String,
        /// The driver.
        driver: &'static str,
        /// The script.
        script: &'static str,
    },
    /// A folder that is not the script's.
    #[error("--drivers {}: holds no {file}; {script} writes it", folder.display())]
    NotInFolder {
        /// The folder.
        folder: PathBuf,
        /// The file.
        file: &'static str,
        /// The script.
        script: &'static str,
    },
    /// A record of what this program does not run.
    #[error(
        "--isa: `lobefit cost --isa` compiles by no driver {name}: a record of it is read, and not made again here"
    )]
    NoSuchDriver {
        /// The driver's name in the record.
        name: String,
    },
    /// Families of several drivers where one is called for.
    #[error("--isa: {option} takes families of one driver: a record is of one; found {}", drivers.join(", "))]
    Several {
        /// The option.
        option: &'static str,
        /// The drivers.
        drivers: Vec<&'static str>,
    },
    /// A driver does not know a family, or failed at it.
    #[error("--isa: {driver}: family {family}: {reason}; --families takes {families}")]
    Family {
        /// The driver.
        driver: &'static str,
        /// The family that was asked for.
        family: String,
        /// What the driver said.
        reason: String,
        /// Families that there are.
        families: String,
    },
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
