//! Why there is no machine code.

use ash::vk;

/// Why a driver compiles nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VulkanError {
    /// There is no Vulkan loader on the machine.
    #[error("no Vulkan loader: {reason}")]
    Loader {
        /// What the system said.
        reason: String,
    },
    /// No device is of the driver that was asked for.
    #[error("no device of the driver {driver}; drivers found: {}", if found.is_empty() { "none".into() } else { found.join(", ") })]
    NoDevice {
        /// The driver, by the name that it gives itself.
        driver: String,
        /// Drivers that there are.
        found: Vec<String>,
    },
    /// The driver does not say what it compiled.
    #[error("{device}: the driver has no {what}")]
    Lacks {
        /// Name of the device.
        device: String,
        /// What is missing.
        what: &'static str,
    },
    /// A call failed.
    #[error("{call}: {result}")]
    Call {
        /// The function of the API.
        call: &'static str,
        /// What it returned.
        result: vk::Result,
    },
}

/// Names the call in its error.
pub(crate) fn named<T>(call: &'static str, done: Result<T, vk::Result>) -> Result<T, VulkanError> {
    done.map_err(|result| VulkanError::Call { call, result })
}
