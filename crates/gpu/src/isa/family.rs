//! Families of GPUs and the drivers that compile for them, each in a process of its own.

use std::collections::BTreeMap;
use std::env;
use std::io::{self, Read, Write};
use std::process::{Command, ExitCode, Stdio};

use serde::{Deserialize, Serialize};

use super::counts::{self, LineError};
use crate::GpuError;
use lobefit::timing::isa::Counts;
use lobefit_vulkan::{Compiler, VulkanError};

/// First argument of the process that compiles; the second is the name of a driver.
pub(crate) const WORKER: &str = "--compile-by";

/// How that process ends where there is no such driver.
const NO_DRIVER: u8 = 4;

/// The entry point of every shader.
pub(super) const ENTRY: &std::ffi::CStr = c"isa_main";

/// A driver that compiles for GPUs that are not there.
pub(super) struct Driver {
    /// The name that it gives itself.
    pub name: &'static str,
    /// The variable of the environment that takes a family.
    variable: &'static str,
    /// The rest of the environment.
    environment: &'static [(&'static str, &'static str)],
    /// Names of families, for messages; the driver judges.
    families: &'static str,
    /// What to install.
    install: &'static str,
    /// What its statistics and its assembly say.
    count: fn(&Machine) -> Result<Counts, LineError>,
}

/// Mesa's driver for AMD GPUs, whose null device compiles for any of them.
pub(super) const RADV: Driver = Driver {
    name: "radv",
    variable: "RADV_FORCE_FAMILY",
    environment: &[("MESA_SHADER_CACHE_DISABLE", "1"), ("VK_LOADER_DRIVERS_SELECT", "*radeon*")],
    families: "tahiti, hawaii, tonga, polaris10, vega10, vega20, raven, navi10, navi21, navi22, vangogh, rembrandt, gfx1036, \
               gfx1100, gfx1101, gfx1102, as far as the installed version knows them",
    install: "install Mesa's Vulkan drivers and the loader (Debian: mesa-vulkan-drivers libvulkan1)",
    count: counts::amd,
};

/// A shader to compile.
#[derive(Serialize, Deserialize)]
pub(super) struct Source {
    /// SPIR-V.
    pub words: Vec<u32>,
    /// It computes in f16.
    pub half: bool,
}

/// What a driver made of a shader.
#[derive(Serialize, Deserialize)]
pub(super) struct Machine {
    /// Its statistics by name.
    pub statistics: BTreeMap<String, i64>,
    /// The code as text.
    pub assembly: String,
}

/// What a driver made of all shaders.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    /// Its version, in its own words.
    version: String,
    /// None where the family does not compute in f16 and the shader does.
    pub machines: Vec<Option<Machine>>,
}

impl Driver {
    /// Compiles shaders for a family, in a process of its own: a driver reads the family once, and
    /// ends the process where it does not know it.
    pub fn compile(&self, family: &str, sources: &[Source]) -> Result<Answer, GpuError> {
        let failed = |reason: &str| GpuError::Family {
            driver: self.name,
            family: family.into(),
            reason: reason.trim().to_owned(),
            families: self.families,
        };
        let shaders = serde_json::to_vec(sources).map_err(|e| failed(&e.to_string()))?;
        let io = |e: io::Error| failed(&e.to_string());
        let program = env::current_exe().map_err(io)?;
        let mut child = Command::new(program)
            .args([WORKER, self.name])
            .env(self.variable, family)
            .envs(self.environment.iter().copied())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(io)?;
        // A process that ends before it has read everything says why on its way out.
        let _ = child.stdin.take().map(|mut stdin| stdin.write_all(&shaders));
        let output = child.wait_with_output().map_err(io)?;
        let said = String::from_utf8_lossy(&output.stderr);
        match output.status.code() {
            Some(0) => serde_json::from_slice(&output.stdout).map_err(|e| failed(&e.to_string())),
            Some(code) if code == i32::from(NO_DRIVER) => Err(GpuError::NoDriver {
                driver: self.name,
                reason: said.trim().to_owned(),
                install: self.install,
            }),
            _ if said.trim().is_empty() => Err(failed(&output.status.to_string())),
            _ => Err(failed(&said)),
        }
    }

    /// What a shader costs; `function` stands for it in messages.
    pub fn counts(&self, function: &str, machine: &Machine) -> Result<Counts, GpuError> {
        let reason = |e: LineError| GpuError::Bake { place: function.into(), reason: e.to_string() };
        (self.count)(machine).map_err(reason)
    }
}

impl Answer {
    /// The version without the project's name: `22.3.6` of `Mesa 22.3.6`.
    pub fn version(&self) -> String {
        let version =
            self.version.split_whitespace().find(|word| word.starts_with(|c: char| c.is_ascii_digit()));
        version.unwrap_or(&self.version).to_owned()
    }
}

/// The process that compiles: shaders as JSON on standard input, what became of them on standard
/// output.
pub(crate) fn worker(driver: &str) -> ExitCode {
    let compiler = match Compiler::open(driver) {
        Ok(compiler) => compiler,
        Err(error) => {
            let _ = writeln!(io::stderr(), "{error}");
            return ExitCode::from(NO_DRIVER);
        }
    };
    match answer(&compiler) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "{error}");
            ExitCode::FAILURE
        }
    }
}

fn answer(compiler: &Compiler) -> Result<(), Box<dyn std::error::Error>> {
    let mut text = Vec::new();
    io::stdin().read_to_end(&mut text)?;
    let sources: Vec<Source> = serde_json::from_slice(&text)?;
    let compiled = |source: &Source| -> Result<Option<Machine>, VulkanError> {
        if source.half && !compiler.half {
            return Ok(None);
        }
        let compiled = compiler.compile(&source.words, ENTRY)?;
        Ok(Some(Machine { statistics: compiled.statistics, assembly: compiled.assembly }))
    };
    let machines = sources.iter().map(compiled).collect::<Result<Vec<_>, _>>()?;
    serde_json::to_writer(io::stdout().lock(), &Answer { version: compiler.version.clone(), machines })?;
    Ok(())
}
