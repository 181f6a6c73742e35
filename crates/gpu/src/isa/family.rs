//! Families of GPUs, and the drivers that compile for them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::counts::{self, LineError};
use super::worker::Machine;
use crate::GpuError;
use lobefit::timing::isa::Counts;

/// The script that builds drivers and shims.
const SCRIPT: &str = "crates/gpu/drivers/mesa.sh DIR";

/// A driver that compiles for GPUs that are not there.
pub(super) struct Driver {
    /// Its name in records: of a driver for one vendor the vendor's.
    pub name: &'static str,
    /// The vendor's name, which stands for [`Driver::usual`].
    vendor: &'static str,
    /// What the driver's own name holds, or its device's.
    pub word: &'static str,
    /// Of a driver that does not state what it compiles but prints it: where that is in what it
    /// prints.
    pub listing: Option<fn(&str) -> &str>,
    /// The variable of the environment that takes a family.
    variable: &'static str,
    /// The rest of the environment.
    environment: &'static [(&'static str, &'static str)],
    /// What stands in the folder of drivers.
    built: Built,
    /// Its families, as [`pairs`] reads them: each with the value of the variable.
    families: &'static str,
    /// Families that are taken where none are named.
    usual: &'static [&'static str],
    /// What its statistics and its assembly say.
    count: fn(&Machine) -> Result<Counts, LineError>,
}

/// What a driver takes from the folder of drivers.
enum Built {
    /// Nothing: it is installed, and needs no device.
    Nothing,
    /// A shim that stands for the device.
    Shim(&'static str),
    /// A shim, and the driver itself by its manifest.
    Whole(&'static str, &'static str),
}

/// Pairs of words, `name=value`, of which those that are equal are written once.
pub(super) fn pairs(words: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    words.split_whitespace().map(|word| word.split_once('=').unwrap_or((word, word)))
}

/// Debian's packages.
pub(super) const INSTALL: &str =
    "install Mesa's Vulkan drivers and the loader (Debian: mesa-vulkan-drivers libvulkan1)";

/// All of them. What no other has is taken for a family of the first.
pub(super) const DRIVERS: [Driver; 4] = [
    // Mesa's driver for AMD GPUs, whose null device compiles for any of them. It judges names itself.
    Driver {
        name: "radv",
        vendor: "amd",
        word: "radv",
        listing: None,
        variable: "RADV_FORCE_FAMILY",
        environment: &[("VK_LOADER_DRIVERS_SELECT", "*radeon*")],
        built: Built::Nothing,
        families: "tahiti hawaii tonga polaris10 vega10 vega20 raven navi10 navi21 navi22 vangogh rembrandt gfx1036 gfx1100 gfx1101 gfx1102",
        usual: &["polaris10", "navi21", "gfx1100"],
        count: counts::amd,
    },
    // Mesa's driver for Intel GPUs; the shim answers in place of the kernel.
    Driver {
        name: "intel",
        vendor: "intel",
        word: "Intel open-source Mesa driver",
        listing: None,
        variable: "INTEL_STUB_GPU_PLATFORM",
        environment: &[("VK_LOADER_DRIVERS_SELECT", "*intel_icd*")],
        built: Built::Shim("libintel_noop_drm_shim.so"),
        families: "skl kbl cfl icl tgl rkl adl rpl dg1 dg2",
        usual: &["skl", "tgl", "dg2"],
        count: counts::intel,
    },
    // Mesa's driver for Qualcomm Adreno GPUs.
    Driver {
        name: "adreno",
        vendor: "adreno",
        word: "turnip",
        listing: None,
        variable: "FD_GPU_ID",
        environment: &[],
        built: Built::Whole("libfreedreno_noop_drm_shim.so", "freedreno.json"),
        families: "a618=618 a630=630 a660=660",
        usual: &["a660"],
        count: counts::adreno,
    },
    // Mesa's driver for Arm Mali GPUs, which prints what it compiles.
    Driver {
        name: "mali",
        vendor: "mali",
        word: "Panfrost",
        listing: Some(counts::mali_listing),
        variable: "PAN_GPU_ID",
        environment: &[
            ("PAN_I_WANT_A_BROKEN_VULKAN_DRIVER", "1"),
            ("BIFROST_MESA_DEBUG", "shaders,shaderdb"),
        ],
        built: Built::Whole("libpanfrost_noop_drm_shim.so", "panfrost.json"),
        families: "g52=7212 g76=7211",
        usual: &["g52"],
        count: counts::mali,
    },
];

impl Driver {
    /// The environment of a process that compiles for a family, `folder` being that of drivers.
    pub fn environment(
        &self,
        family: &str,
        folder: Option<&Path>,
    ) -> Result<BTreeMap<&'static str, PathBuf>, GpuError> {
        let value = pairs(self.families).find(|(name, _)| *name == family).map_or(family, |(_, value)| value);
        let mut environment = BTreeMap::from([(self.variable, PathBuf::from(value))]);
        environment.insert("MESA_SHADER_CACHE_DISABLE", "1".into());
        environment.extend(self.environment.iter().map(|(name, value)| (*name, PathBuf::from(value))));
        let files = match self.built {
            Built::Nothing => return Ok(environment),
            Built::Shim(shim) => vec![("LD_PRELOAD", shim)],
            Built::Whole(shim, manifest) => vec![("LD_PRELOAD", shim), ("VK_DRIVER_FILES", manifest)],
        };
        let without = || {
            GpuError::Driver(format!(
                "--isa: family {family}: compiling for {} takes --drivers DIR, a folder that {SCRIPT} writes",
                self.name
            ))
        };
        let folder = folder.ok_or_else(without)?;
        for (variable, name) in files {
            // A loader looks for what is no absolute path elsewhere.
            let path = std::path::absolute(folder.join(name)).ok().filter(|path| path.is_file());
            let missing = || {
                let folder = folder.display();
                GpuError::Driver(format!("--drivers {folder}: holds no {name}; {SCRIPT} writes it"))
            };
            environment.insert(variable, path.ok_or_else(missing)?);
        }
        Ok(environment)
    }

    /// Names of its families, for messages.
    pub fn families(&self) -> String {
        let names: Vec<&str> = pairs(self.families).map(|(name, _)| name).collect();
        names.join(", ")
    }

    /// What a shader costs; `function` stands for it in messages.
    pub fn counts(&self, function: &str, machine: &Machine) -> Result<Counts, GpuError> {
        let reason = |e: LineError| GpuError::Bake { place: function.into(), reason: e.to_string() };
        (self.count)(machine).map_err(reason)
    }

    /// The driver of a record.
    pub fn of_record(name: &str) -> Result<&'static Driver, GpuError> {
        let found = DRIVERS.iter().find(|driver| driver.name == name);
        let none = || {
            GpuError::Driver(format!(
                "--isa: `lobefit cost --isa` compiles by no driver {name}: a record of it is read, and not made again here"
            ))
        };
        found.ok_or_else(none)
    }
}

/// Counts of a shader from what a driver states of it, and from the assembly that it states or
/// prints; the driver by its name in records.
///
/// # Errors
/// No driver of this name, a statistic that is missing, an instruction that is not known.
pub fn counted(driver: &str, statistics: &BTreeMap<String, i64>, assembly: &str) -> Result<Counts, GpuError> {
    let driver = Driver::of_record(driver)?;
    let assembly = driver.listing.map_or(assembly, |listing| listing(assembly)).to_owned();
    driver.counts(driver.name, &Machine { statistics: statistics.clone(), assembly })
}

/// Drivers and their families, by what the user typed: names of families, or of vendors.
pub(super) fn chosen(words: &[String]) -> Vec<(&'static Driver, Vec<String>)> {
    let named = words.iter().map(|word| {
        let vendor = DRIVERS.iter().find(|driver| driver.vendor == word);
        match vendor {
            Some(driver) => (driver, driver.usual.iter().map(|name| (*name).to_owned()).collect()),
            None => {
                let has = |driver: &&Driver| pairs(driver.families).any(|(name, _)| name == word);
                (DRIVERS.iter().find(has).unwrap_or(&DRIVERS[0]), vec![word.clone()])
            }
        }
    });
    let groups = lobefit_math::groups(named, |(driver, _): &(&Driver, Vec<String>)| driver.name);
    let once = |(_, group): (_, Vec<(&'static Driver, Vec<String>)>)| {
        let (driver, mut seen) = (group[0].0, BTreeSet::new());
        let families = group.into_iter().flat_map(|(_, families)| families);
        (driver, families.filter(|family| seen.insert(family.clone())).collect())
    };
    groups.into_iter().map(once).collect()
}
