//! Drivers compile in a process of their own, one for each family: they read the family once, and
//! end the process where they do not know it.

use std::collections::BTreeMap;
use std::env;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};

use serde::{Deserialize, Serialize};

use super::family::{DRIVERS, Driver, INSTALL};
use crate::GpuError;
use lobefit_vulkan::Compiler;

/// First argument of that process; the second is the name of a driver, the third the file that it
/// answers in.
pub(crate) const WORKER: &str = "--compile-by";

/// How it ends where there is no such driver.
const NO_DRIVER: u8 = 4;

/// The entry point of every shader.
pub(super) const ENTRY: &std::ffi::CStr = c"isa_main";

/// A line of its own before what a driver prints of a shader.
const MARK: &str = "lobefit compiles the next shader";

/// A shader to compile.
#[derive(Serialize, Deserialize)]
pub(super) struct Source {
    /// SPIR-V.
    pub words: Vec<u32>,
    /// It computes in f16.
    pub half: bool,
}

/// What a driver made of a shader.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Machine {
    /// Its statistics by name.
    pub statistics: BTreeMap<String, i64>,
    /// The code as text; of a driver that does not state it what it printed.
    pub assembly: String,
}

/// What a driver made of all shaders.
#[derive(Serialize, Deserialize)]
pub(super) struct Answer {
    /// Its version.
    pub version: String,
    /// None where the family does not compute in f16 and the shader does.
    pub machines: Vec<Option<Machine>>,
}

impl Driver {
    /// Compiles shaders for a family; `folder` is that of drivers.
    pub fn compile(
        &self,
        family: &str,
        folder: Option<&Path>,
        sources: &[Source],
    ) -> Result<Answer, GpuError> {
        let environment = self.environment(family, folder)?;
        let failed = |reason: &str| {
            let (driver, reason, families) = (self.name, reason.trim(), self.families());
            GpuError::Driver(format!(
                "--isa: {driver}: family {family}: {reason}; --families takes {families}"
            ))
        };
        let io = |e: io::Error| failed(&e.to_string());
        let shaders = serde_json::to_vec(sources).map_err(|e| failed(&e.to_string()))?;
        let place = lobefit::store::temporary().map_err(|e| failed(&e.to_string()))?;
        let [answer, log] = ["answer", "log"].map(|name| place.path().join(name));
        // Both streams in one file, so that what is printed stays in order.
        let streams = File::create(&log).map_err(io)?;
        let mut child = Command::new(env::current_exe().map_err(io)?)
            .args([WORKER.as_ref(), self.name.as_ref(), answer.as_os_str()])
            .envs(environment)
            .stdin(Stdio::piped())
            .stdout(streams.try_clone().map_err(io)?)
            .stderr(streams)
            .spawn()
            .map_err(io)?;
        // A process that ends before it has read everything says why on its way out.
        let _ = child.stdin.take().map(|mut stdin| stdin.write_all(&shaders));
        let status = child.wait().map_err(io)?;
        let printed = fs::read(&log).map_err(io)?;
        let printed = String::from_utf8_lossy(&printed);
        let mark = format!("{MARK}\n");
        let (first, parts) = printed.split_once(&mark).unwrap_or((&printed, ""));
        match status.code() {
            Some(0) => {
                let bytes = fs::read(&answer).map_err(io)?;
                let mut answer: Answer =
                    serde_json::from_slice(&bytes).map_err(|e| failed(&e.to_string()))?;
                if let Some(listing) = self.listing {
                    let machines = answer.machines.iter_mut().flatten().zip(parts.split(&mark));
                    machines.for_each(|(machine, printed)| machine.assembly = listing(printed).to_owned());
                }
                Ok(answer)
            }
            Some(code) if code == i32::from(NO_DRIVER) => {
                let (driver, reason) = (self.name, first.trim());
                Err(GpuError::Driver(format!("--isa: no driver {driver}: {reason}; {INSTALL}")))
            }
            _ => {
                let said = parts.rsplit(&mark).next().filter(|said| !said.is_empty()).unwrap_or(first);
                Err(failed(&if said.trim().is_empty() { status.to_string() } else { said.into() }))
            }
        }
    }
}

/// The process that compiles: shaders as JSON on standard input, what became of them in a file.
pub(crate) fn worker(driver: &str, answer: &Path) -> ExitCode {
    let failed = |error: &dyn std::fmt::Display, code: ExitCode| {
        let _ = writeln!(io::stderr(), "{error}");
        code
    };
    let Some(driver) = DRIVERS.iter().find(|of| of.name == driver) else {
        return failed(&format!("no driver {driver}"), ExitCode::FAILURE);
    };
    match Compiler::open(driver.word, driver.listing.is_none()) {
        Err(error) => failed(&error, ExitCode::from(NO_DRIVER)),
        Ok(compiler) => match compiled(&compiler, answer) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => failed(&error, ExitCode::FAILURE),
        },
    }
}

fn compiled(compiler: &Compiler, answer: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let mut text = Vec::new();
    io::stdin().read_to_end(&mut text)?;
    let sources: Vec<Source> = serde_json::from_slice(&text)?;
    let mut machines = Vec::new();
    for source in &sources {
        if source.half && !compiler.half {
            machines.push(None);
            continue;
        }
        writeln!(io::stdout(), "{MARK}")?;
        let compiled = compiler.compile(&source.words, ENTRY)?;
        machines.push(Some(Machine { statistics: compiled.statistics, assembly: compiled.assembly }));
    }
    let version = compiler.version.clone();
    serde_json::to_writer(File::create(answer)?, &Answer { version, machines })?;
    Ok(())
}
