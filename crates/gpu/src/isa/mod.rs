//! Machine code of the emitted functions, as compilers of GPU drivers make it. No GPU is needed.

mod cli;
mod counts;
mod family;
mod shader;
mod worker;

pub(crate) use cli::verb;
pub use family::counted;
pub(crate) use worker::{WORKER, worker};

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use family::Driver;
use lobefit::bake::Progress;
use lobefit::cli::CliError;
use lobefit::data::Vendor;
use lobefit::emit::include::Include;
use lobefit::store::{self, Files, MANIFEST};
use lobefit::timing::isa::{IsaFunction, IsaLeftOut, IsaRecord, IsaRow, Precision, VERSION, operations};
use lobefit::timing::listings::Listings;
use lobefit::timing::priced::priced;
use lobefit_shade::code::{Float, Language};
use shader::Shader;
use worker::{Machine, Source};

use crate::GpuError;

/// How a record is made.
const COMMAND: &str = "lobefit cost --isa --record FILE.json";

/// Largest file of code that is read, bytes.
const CODE_BYTES: u64 = 1 << 20;

/// A function to compile.
struct Job {
    function: String,
    precision: Precision,
    /// Its shader and the shader without it, among all shaders.
    shaders: [usize; 2],
}

/// Everything to compile.
#[derive(Default)]
struct Jobs {
    all: Vec<Job>,
    functions: BTreeMap<String, IsaFunction>,
    shaders: Vec<Source>,
    /// Shaders by their text.
    known: BTreeMap<String, usize>,
    left_out: Vec<IsaLeftOut>,
}

/// What the compiler made of everything.
struct Compiled {
    record: IsaRecord,
    assembly: Vec<Listed>,
}

/// Function, family, precision and the code of the whole shader.
type Listed = (String, String, Precision, String);

impl Jobs {
    /// All functions of an include file, in those of the precisions that it can have.
    fn of(include: &Include, files: &Files, precisions: &[Precision]) -> Result<Jobs, GpuError> {
        let wrong = |reason| GpuError::Bake { place: "fits/lobefit.wgsl".into(), reason };
        if include.text.contains(Language::Wgsl.preamble(Float::F16).trim()) {
            let reason = "its functions are in f16; bake without `precision`: those of f32 are compiled in f16 and packed too";
            return Err(wrong(reason.into()));
        }
        let parsed = naga::front::wgsl::parse_str(&include.text);
        let module = parsed.map_err(|e| wrong(e.emit_to_string(&include.text)))?;
        let mut names: Vec<&str> = module.functions.iter().filter_map(|(_, f)| f.name.as_deref()).collect();
        names.sort_unstable();
        let mut jobs = Jobs::default();
        let ops = operations(files)
            .map_err(|e| GpuError::Bake { place: MANIFEST.into(), reason: e.to_string() })?;
        for name in names {
            let wrong = || GpuError::Bake { place: name.into(), reason: "not in the include file".into() };
            let (code, hash) = include.code(name).zip(include.hash(name)).ok_or_else(wrong)?;
            for precision in precisions {
                jobs.add((&code, &hash), &module, name, *precision)?;
            }
        }
        for (name, function) in &mut jobs.functions {
            function.ops = ops.get(name).copied();
        }
        Ok(jobs)
    }

    /// A function of each file, of the file's name, with all that stands beside it.
    fn of_files(files: &[PathBuf], precisions: &[Precision]) -> Result<Jobs, CliError> {
        let mut jobs = Jobs::default();
        for file in files {
            let bytes = store::read(file, CODE_BYTES)?;
            let wrong = |reason: String| GpuError::Bake { place: file.display().to_string(), reason };
            let code = String::from_utf8(bytes).map_err(|e| wrong(e.to_string()))?;
            let module = naga::front::wgsl::parse_str(&code).map_err(|e| wrong(e.emit_to_string(&code)))?;
            let name = file.file_stem().and_then(|name| name.to_str()).unwrap_or_default();
            if !module.functions.iter().any(|(_, f)| f.name.as_deref() == Some(name)) {
                return Err(wrong(format!("declares no function `{name}`, the one of its own name")).into());
            }
            let hash = blake3::hash(code.as_bytes()).to_hex();
            for precision in precisions {
                jobs.add((&code, &hash), &module, name, *precision)?;
            }
        }
        Ok(jobs)
    }

    /// Adds a function by its code, with all that it needs, and the hash of that.
    fn add(
        &mut self,
        (code, hash): (&str, &str),
        module: &naga::Module,
        function: &str,
        precision: Precision,
    ) -> Result<(), GpuError> {
        let place = |reason: &str| GpuError::Bake { place: function.into(), reason: reason.into() };
        let Some(shader) = Shader::of(code, module, function, precision)? else { return Ok(()) };
        match self.shader(&shader.with, precision) {
            Ok(with) => {
                let without = self.shader(&shader.without, precision).map_err(|e| place(&e))?;
                self.functions.insert(function.into(), IsaFunction::of(hash, None));
                self.all.push(Job { function: function.into(), precision, shaders: [with, without] });
                Ok(())
            }
            Err(reason) if precision == Precision::F32 => Err(place(&reason)),
            Err(reason) => {
                let reason = reason.lines().next().unwrap_or_default().to_owned();
                self.left_out.push(IsaLeftOut { function: function.into(), precision, reason });
                Ok(())
            }
        }
    }

    /// The shader of a text.
    fn shader(&mut self, text: &str, precision: Precision) -> Result<usize, String> {
        if let Some(&known) = self.known.get(text) {
            return Ok(known);
        }
        let words = shader::spirv(text)?;
        self.known.insert(text.into(), self.shaders.len());
        self.shaders.push(Source { words, half: precision != Precision::F32 });
        Ok(self.shaders.len() - 1)
    }
}

/// What is to be compiled, and for what.
struct Order<'a> {
    /// Drivers with the families that they compile for.
    drivers: Vec<(&'static Driver, Vec<String>)>,
    /// The folder of drivers.
    folder: Option<&'a Path>,
    precisions: Vec<Precision>,
}

/// Compiles the functions for each driver.
///
/// # Errors
/// No driver, a family that it does not know, assembly that is not understood.
fn compile(
    jobs: &Jobs,
    scene: &str,
    order: &Order<'_>,
    progress: &dyn Progress,
) -> Result<Vec<Compiled>, GpuError> {
    let by = |(driver, families): &(&Driver, Vec<String>)| {
        compile_by(driver, (families, order.folder), jobs, scene, progress)
    };
    order.drivers.iter().map(by).collect()
}

fn compile_by(
    driver: &Driver,
    (families, folder): (&[String], Option<&Path>),
    jobs: &Jobs,
    scene: &str,
    progress: &dyn Progress,
) -> Result<Compiled, GpuError> {
    let (mut rows, mut assembly, mut version) = (Vec::new(), Vec::new(), String::new());
    for family in families {
        progress.stage(family);
        let answer = driver.compile(family, folder, &jobs.shaders)?;
        version = answer.version;
        for job in &jobs.all {
            let [Some(with), Some(without)] = job.shaders.map(|at| answer.machines[at].as_ref()) else {
                continue;
            };
            rows.push(row(driver, job, family, [with, without])?);
            assembly.push((job.function.clone(), family.clone(), job.precision, with.assembly.clone()));
        }
    }
    rows.sort_by(|a, b| a.function.cmp(&b.function));
    let record = IsaRecord {
        schema_version: VERSION,
        command: COMMAND.into(),
        scene: scene.into(),
        driver: driver.name.into(),
        version,
        left_out: jobs.left_out.clone(),
        functions: jobs.functions.clone(),
        rows,
        listings: listings(driver.name, families, &assembly),
    };
    Ok(Compiled { record, assembly })
}

/// Machine code in f32 of the family that stands for the vendor, if it is among those compiled for.
/// A function with other constants, or for three channels, is left to `--assembly`.
fn listings(driver: &str, families: &[String], assembly: &[Listed]) -> Option<Listings> {
    let priced = Vendor::ALL.into_iter().map(priced).find(|priced| priced.driver == driver);
    let family = priced.map(|priced| priced.family).filter(|of| families.iter().any(|f| f == of))?;
    let of = assembly.iter().filter(|(_, of, precision, _)| of == family && *precision == Precision::F32);
    let texts = of
        .filter(|(name, ..)| !["_rms", "_rgb"].iter().any(|end| name.ends_with(end)))
        .map(|(name, .., text)| (name.clone(), tidy(text)))
        .collect();
    Some(Listings { family: family.into(), texts })
}

/// What compilers print beside the instructions.
const REMARKS: [&str; 4] = [";", "Native code", "Push constant", "RANGE"];

/// Machine code without the bytes that encode it, and without remarks.
fn tidy(text: &str) -> String {
    let is_word = |word: &str| word.len() == 8 && word.chars().all(|c| c.is_ascii_hexdigit());
    let encoding = |code: &str| code.split(' ').all(is_word);
    let line = |line: &str| {
        let cut =
            line.rsplit_once("; ").filter(|(_, code)| encoding(code)).map_or(line, |(before, _)| before);
        cut.trim_end().replace('\t', "  ")
    };
    let is_code =
        |line: &String| !line.is_empty() && !REMARKS.iter().any(|with| line.trim_start().starts_with(with));
    text.lines().map(line).filter(is_code).collect::<Vec<_>>().join("\n")
}

fn row(driver: &Driver, job: &Job, family: &str, machines: [&Machine; 2]) -> Result<IsaRow, GpuError> {
    let [with, without] = machines.map(|machine| driver.counts(&job.function, machine));
    Ok(IsaRow {
        function: job.function.clone(),
        family: family.to_owned(),
        precision: job.precision,
        counts: with?.above(&without?),
    })
}
