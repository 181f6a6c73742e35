//! `lobefit furnace`: a whole BRDF of a shader file in a white furnace, and for reciprocity.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};

use super::origin::{named, origin, quoted};
use super::source::{SourceOptions, say_left_out};
use crate::audit::Grade;
use crate::foreign::{self, LeftOut, ShaderFunction};
use crate::furnace::{self, Allowance, Asked, FurnaceFindings, Role};
use lobefit::cli::CliError;
use lobefit::cli::declared;
use lobefit::cli::options::{ThreadsOption, not_negative};
use lobefit::cli::output::{Outcome, print};
use lobefit::cli::progress::Spinner;
use lobefit::store::{self, Files, Folder};

const EXAMPLES: &str = "\
Examples:
  lobefit furnace brdf.wgsl --function ggx                does it gain energy, is it reciprocal?
  lobefit furnace brdf.hlsl --function ggx --limit 0.01   in CI: exit 1 above 1.01, or if f(l, v) is off f(v, l) by 1 %
  lobefit furnace brdf.glsl --function f --role dir=l --role eye=v --set metallic=0

Arguments are known by their names: a normal, view, light or half vector, tangents, cosines between them (NdotL, n_dot_l, NoL),
a roughness or alpha, colours and F0, which are white. --role says what a name does not: n, v, l, h, t, b, a cosine as n.l, roughness or white.

Exit codes:
  0  without a limit: whatever the verdict is; with --limit X: no energy is above 1 + X, and without --one-way f(l, v) within X of f(v, l);
     with --max-loss X: no energy is below 1 - X, and --limit is 0.005 where it is not given
  1  with a limit: an energy is beyond it or its error bars hold it, f is not reciprocal, or has values that are no numbers
  2  options, or a file or function that cannot be read
  3  --out, or standard output, cannot be written";

/// Whether a function holds the cosine of the light.
#[derive(Clone, Copy, ValueEnum)]
enum CosineOption {
    Included,
    Absent,
}

/// Measure a whole BRDF of a shader file in a white furnace, and for reciprocity
#[derive(Parser)]
#[command(name = "lobefit furnace", bin_name = "lobefit furnace", version, after_help = EXAMPLES)]
struct Options {
    /// Shader (WGSL, GLSL, HLSL)
    pub file: PathBuf,
    #[command(flatten)]
    pub source: SourceOptions,
    /// What an argument is
    #[arg(long, value_name = "NAME=ROLE", value_parser = role)]
    pub role: Vec<(String, Role)>,
    /// Values of the roughness, as the function takes it
    #[arg(long, value_name = "R,..", value_delimiter = ',', value_parser = not_negative,
          default_values_t = [0.1, 0.25, 0.5, 0.75, 1.0])]
    pub roughness: Vec<f64>,
    /// Whether the function holds the cosine of the light, where that is not to be found out
    #[arg(long, value_name = "IS")]
    pub cosine: Option<CosineOption>,
    /// Largest energy above 1, and largest difference of f(l, v) and f(v, l) as a share, that is accepted
    #[arg(long, value_name = "X", value_parser = not_negative)]
    pub limit: Option<f64>,
    /// Largest energy below 1 that is accepted; without it any, as a lobe alone loses light between facets
    #[arg(long, value_name = "X", value_parser = not_negative)]
    pub max_loss: Option<f64>,
    /// Accept a function that is not reciprocal: --limit is on energy alone
    #[arg(long)]
    pub one_way: bool,
    /// Folder for NAME.furnace.html and NAME.furnace.json
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print what was found as JSON on standard output
    #[arg(long)]
    pub json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Errors of energies are brought below it, or below a quarter of a limit.
const TOLERANCE: f64 = 1e-3;

/// Runs the verb on its arguments (the first is the program's name).
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    declared::verb(arguments, |options| verb(&options))
}

fn role(text: &str) -> Result<(String, Role), String> {
    let (name, word) = text.split_once('=').ok_or("NAME=ROLE is called for")?;
    Ok((name.into(), furnace::role(word)?))
}

fn verb(options: &Options) -> Result<Outcome, CliError> {
    let bytes = store::read(&options.file, foreign::limits::BYTES)?;
    let function = function(options, &bytes)?;
    // A folder that cannot be written is an error before the work.
    let mut folder = options.out.as_deref().map(Folder::open_flat).transpose()?;
    let progress = Spinner::new(options.quiet || options.json);
    let asked = Asked {
        roles: options.role.clone(),
        set: options.source.set.clone(),
        roughness: options.roughness.clone(),
        cosine: options.cosine.map(|c| matches!(c, CosineOption::Included)),
        tolerance: options.limit.iter().chain(&options.max_loss).fold(TOLERANCE, |all, x| all.min(x / 4.0)),
    };
    let told = |stage: &str| progress.stage(stage);
    let found = options.threads.install(|| Ok(furnace::furnace(&function, &asked, &told)?))?;
    drop(progress);
    let name = options.file.file_name().map_or(String::new(), |n| n.to_string_lossy().into_owned());
    let allowance = Allowance { limit: options.limit, loss: options.max_loss, one_way: options.one_way };
    let judgement = furnace::judgement(&format!("{} ({name})", function.name), &found, allowance);
    let is_limited = options.limit.is_some() || options.max_loss.is_some();
    let passed = is_limited.then_some(judgement.grade == Grade::Pass);
    let found = FurnaceFindings {
        origin: origin(&bytes, &command(options, &name)),
        file: name.clone(),
        function: function.signature,
        limit: options.limit,
        passed,
        judgement,
        furnace: found,
    };
    let (page, figures) = furnace::furnace_page(&found)?;
    if let Some(folder) = &mut folder {
        let html = (format!("{name}.furnace.html"), page.into_bytes());
        folder.write(&Files::from([html, (format!("{name}.furnace.json"), figures.clone())]))?;
    }
    if options.json {
        print(&figures)?;
    } else if !options.quiet {
        print(found.text().as_bytes())?;
    }
    Ok(if passed == Some(false) { Outcome::Failed } else { Outcome::Done })
}

/// The function that is meant.
fn function(options: &Options, bytes: &[u8]) -> Result<ShaderFunction, CliError> {
    let file = options.file.display().to_string();
    let mut found = options.source.read(bytes, &file)?;
    if found.len() > 1 {
        let asked =
            Asked { roles: options.role.clone(), set: options.source.set.clone(), ..Asked::default() };
        let mut left_out = std::mem::take(&mut found[0].left_out);
        let unfit = |f: &ShaderFunction| furnace::unfit(f, &asked);
        if found.iter().any(|f| unfit(f).is_none()) {
            let why = |f: &ShaderFunction| Some(LeftOut::new(&f.signature, &unfit(f)?.reason()));
            left_out.extend(found.iter().filter_map(why));
            found.retain(|f| unfit(f).is_none());
        }
        found[0].left_out = left_out;
    }
    if !options.quiet {
        say_left_out(&file, &found[0].left_out);
    }
    let names: Vec<&str> = found.iter().map(|f| f.signature.as_str()).collect();
    match names.as_slice() {
        [_] => Ok(found.remove(0)),
        _ => Err(CliError::Usage(format!(
            "{file}: holds several functions that may be meant: `{}`; choose one by --function",
            names.join("`, `")
        ))),
    }
}

/// The command that makes the report again.
fn command(options: &Options, name: &str) -> Vec<String> {
    let rough: Vec<String> = options.roughness.iter().map(f64::to_string).collect();
    let cosine = options.cosine.and_then(|c| c.to_possible_value());
    let roles = options.role.iter().map(|(n, role)| named("--role", &format!("{n}={}", role.words())));
    ["lobefit furnace".to_string(), quoted(name)]
        .into_iter()
        .chain(options.source.words())
        .chain(roles)
        .chain([named("--roughness", &rough.join(","))])
        .chain(cosine.map(|c| named("--cosine", c.get_name())))
        .chain(options.limit.map(|l| named("--limit", &l.to_string())))
        .chain(options.max_loss.map(|x| named("--max-loss", &x.to_string())))
        .chain(options.one_way.then(|| "--one-way".to_string()))
        .collect()
}
