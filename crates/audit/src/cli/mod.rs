//! `lobefit audit`: somebody else's table or shader function against the truth.

mod furnace;
mod judged;
mod ltc;
mod origin;
mod shipped;
mod sidecar;
mod source;
mod stated;
mod tables;
mod words;

use std::ffi::OsString;
use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use crate::audit::{
    self, Audit, AuditedTable, Column, Encoding, Fixed, Form, Input, LEFT_OUT, Registration, Scale,
};
use crate::cost;
use crate::foreign::{self, RawFormat};
use crate::report::{self, AuditFindings, AuditOtherwise};
use lobefit::cli::CliError;
use lobefit::cli::declared;
use lobefit::cli::options::{ThreadsOption, not_negative};
use lobefit::cli::output::{Outcome, print};
use lobefit::cli::progress::Spinner;
use lobefit::store::{self, Files, Folder, StoreError};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::quantity::Quantity;
use source::{SourceOptions, say_left_out};
use words::{
    Ranged, Size, at, axis, column, encoding, floor, form, range, raw_format, registration, side, size,
    wanted,
};

const EXAMPLES: &str = "\
Examples:
  lobefit audit dfg.exr --as ggx-reflection             how is this table meant, and how far off is it?
  lobefit audit lut.png --as ggx-reflection:E --limit 0.01   in CI: exit 1 if E is off by more than 0.01
  lobefit audit shader.tables --as ggx-glass --symbol table_ggx_glass_E --size 16x16x16
  lobefit audit brdf.wgsl --as ggx-reflection --function env_brdf_approx
  lobefit audit brdf.wgsl --as ggx-reflection --function env_brdf_approx --isa   and what does it cost, beside our formulas?
  lobefit audit lut.bin --as ggx-reflection --size 64x64 --raw-format f32 --out report
  lobefit audit ltc_1.dds --as ltc --scales ltc_2.dds --limit 0.1   area lights: a pair of tables of a linearly transformed cosine
  lobefit audit tables/ggx-dfg-correlated-32x32.exr     a table of this tool says itself what it stands for

What is not given is tried: --axes takes alpha, roughness, alpha^(1/3), alpha^(1/4), alpha^2, gloss; mu, sqrt(mu), theta, sqrt(1-mu), mu^2; ior, eta (1/ior), ior-1,
f0, 1/ior..ior (from inside, then from outside), ior=1.1..2.2 (evenly between two ends), ...;
`1-` before a word for an axis that falls. --registration takes centre, endpoint, left, right, one-high, one-low, end-high, end-low.
--smith takes correlated, separable, and of others' reflection schlick (k = alpha/2), schlick-lights (k = (roughness + 1)^2/8), schlick-alpha, joint-approx;
of sheen neubelt, estevez-kulla.

Exit codes:
  0  with --limit: the table or function fits and is within it; without --limit: whatever the verdict is, FAIL and UNKNOWN too,
     but for the two cases of 1
  1  with --limit: over it, not all judged, or no convention fits; without --limit: no convention fits that options (--axes,
     --registration, --smith, --side, --meaning, --encoding, --clamp) leave open, or
     the file is not what its own attribute `lobefit`, or its sidecar NAME.json, says
  2  options, or a file that cannot be read or judged
  3  --out, or standard output, cannot be written

--limit is judged at the texels of a table, not at lookups between them, which the verdict tells of; at evenly spaced arguments of a function;
and of a file with that attribute at lookups, at texels and between them, where it claims something: the verdict says what its axes cover
beyond. It holds for the table as it is best read and as it will be read: texels off their centres or end points, axes that fall or are
transposed (the cosine along y of two axes, an index not along z of three), powers of roughness, B before A, E at normal incidence for an average, and another shadowing than the
quantity's own are over it unless options say that they are meant.";

/// Measure a table or shader function that somebody ships against the truth
#[derive(Parser)]
#[command(name = "lobefit audit", bin_name = "lobefit audit", version, after_help = EXAMPLES)]
struct Options {
    /// Table (EXR, DDS, PNG, KTX2, NPY, raw numbers, a text with an array) or shader (WGSL, GLSL, HLSL)
    pub file: PathBuf,
    /// Quantity that it is measured as, and the column that is asked for; a table of this tool says its own
    #[arg(long = "as", value_name = "QUANTITY[:COLUMN]", value_parser = wanted())]
    pub stands_for: Option<Wanted>,
    /// What runs along x, y, z: `mu,roughness`
    #[arg(long, value_name = "A,B,..", value_delimiter = ',', value_parser = axis)]
    pub axes: Vec<(Scale, bool)>,
    /// Where texels lie, of all axes or of each
    #[arg(long, value_name = "R,..", value_delimiter = ',', value_parser = registration())]
    pub registration: Vec<Registration>,
    /// Shadowing form; of sheen `neubelt`, `estevez-kulla`
    #[arg(long, value_name = "S", value_parser = form())]
    pub smith: Option<&'static Form>,
    /// Where the ray comes from, of glass
    #[arg(long, value_name = "SIDE", value_parser = side())]
    pub side: Option<Side>,
    /// What the channels that vary hold: `A,B`, `E`, `1-E`, `1/E`, ...; `-` leaves one out
    #[arg(long, value_name = "M,..", value_delimiter = ',', allow_hyphen_values = true)]
    pub meaning: Vec<String>,
    /// Least values that inputs were clamped to, in place of a guess: `alpha=0.02,mu=0.001`
    #[arg(long, value_name = "INPUT=X,..", value_delimiter = ',', value_parser = floor)]
    pub clamp: Vec<(Input, f64)>,
    /// What its values are decoded from before they are read
    #[arg(long, value_name = "E", value_parser = encoding)]
    pub encoding: Option<&'static Encoding>,
    /// Samples that each texel is the mean of: what so many leave is no defect
    #[arg(long, value_name = "N")]
    pub samples: Option<NonZero<u32>>,
    /// Texels of each channel, or points of a function, that --json and --out list with value and truth
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub points: usize,
    /// Texels along each axis, x fastest: `64x64`
    #[arg(long, value_name = "WxH[xD]", value_parser = size)]
    pub size: Option<Size>,
    /// Values of a texel
    #[arg(long, value_name = "N")]
    pub channels: Option<usize>,
    /// How numbers lie in a file that does not say
    #[arg(long, value_name = "F", value_parser = raw_format())]
    pub raw_format: Option<RawFormat>,
    /// Name of the array in a text
    #[arg(long, value_name = "NAME")]
    pub symbol: Option<String>,
    /// Name of the layer of an EXR file, or number of the slice of any table of three axes, from 0
    #[arg(long, value_name = "NAME")]
    pub layer: Option<String>,
    /// Of a table of two axes of a quantity of three: which input is the same throughout, as `ior=1.5`
    #[arg(long, value_name = "INPUT=X", value_parser = at)]
    pub at: Option<(Input, f64)>,
    #[command(flatten)]
    pub source: SourceOptions,
    /// Ranges in which a function is judged: `mu=0.01..1,alpha=0.02..1`, or of roughness, alpha =
    /// roughness^2 unless the axis alpha^(1/3) or alpha^(1/4) is stated; of both, where both hold
    #[arg(long, value_name = "INPUT=LOW..HIGH,..", value_delimiter = ',', value_parser = range)]
    pub domain: Vec<(Ranged, [f64; 2])>,
    /// Compile the function for three families of AMD GPUs, and beside it our formulas of the same use
    #[arg(long)]
    pub isa: bool,
    /// Largest error that is accepted: at a texel, at a function's points, at a lookup of a file
    /// that says how it is looked up
    #[arg(long, value_name = "E", value_parser = not_negative)]
    pub limit: Option<f64>,
    /// Folder for NAME.audit.html and NAME.audit.json
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

/// A quantity, and the column that is asked for.
type Wanted = (&'static dyn Quantity, Option<Column>);

/// What was read of the file.
struct Read {
    audited: AuditedTable,
    /// A function with its index of refraction given as 1/ior, where it has one and nobody says how
    /// it is given.
    inverse: Option<AuditedTable>,
    /// The function itself.
    function: Option<foreign::ShaderFunction>,
    /// What the file is, in words.
    holds: String,
    /// What it says of itself, or nothing.
    note: String,
    /// Why what is said of it is not followed.
    refused: Option<String>,
}

/// Runs the verb on its arguments (the first is the program's name), or the verb `furnace` if it
/// follows.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let mut arguments: Vec<OsString> = arguments.into_iter().collect();
    if arguments.get(1).is_some_and(|word| word == "furnace") {
        arguments.remove(1);
        return furnace::run(arguments);
    }
    if ltc::is_meant(&arguments) {
        return ltc::run(arguments);
    }
    declared::verb(arguments, verb)
}

fn verb(options: Options) -> Result<Outcome, CliError> {
    let bytes = read(&options)?;
    let options = &options;
    let is_shader = is_shader(options, &bytes);
    other_kind(options, is_shader)?;
    let wanted = tables::wanted(options, &bytes, is_shader)?;
    let read = if is_shader { shader } else { tables::table };
    let Read { mut audited, inverse, function, holds, note, refused } = read(options, wanted, &bytes)?;
    // A folder that cannot be written is an error before the work.
    let folder = options.out.as_deref().map(Folder::open_flat).transpose()?;
    let own = fixed(options, wanted)?;
    let progress = Spinner::new(options.quiet || options.json);
    let (said, refused) = match stated::stated(options, wanted, &own, &audited, &note, &progress)? {
        Ok(said) => (said, refused),
        Err(refused) => (None, Some(refused)),
    };
    if let Some(said) = &said {
        // What it says of its size is known to agree with the file.
        audited =
            AuditedTable { size: said.size.clone(), axes: AuditedTable::axes_of(said.size.len()), ..audited };
    }
    if let Some(said) = said.as_ref().filter(|said| said.holds()) {
        drop(progress);
        let found = audit::declared_findings(
            said,
            origin::origin(&bytes, &origin::audit(options, wanted)),
            &file_name(options),
            &holds,
            options.limit,
        );
        return publish(options, folder, &found);
    }
    let judge = |fixed: &Fixed| {
        options
            .threads
            .install(|| Ok(judged::judged(&audited, inverse.as_ref(), wanted.0, fixed, &progress)?))
    };
    let mut done = judge(&own)?;
    let is_understood = done.fit == audit::Fit::Whole;
    let lacking = refused.or_else(|| if is_understood { None } else { sidecar::lacking(options, &bytes) });
    let otherwise = |without: &str, audit: &Audit| AuditOtherwise {
        without: without.into(),
        verdict: audit.verdict(options.limit),
    };
    let mut beside = said.as_ref().map(|_| otherwise("its statement", &done));
    if done.fit == audit::Fit::None {
        // What is known as it is needs no other names, nor is anything said of those that do not matter.
        let is_known = done.published.is_some();
        for (without, fixed) in own.without(&audited) {
            progress.stage(&format!("the same without {without}"));
            let other = judge(&fixed)?;
            let follows =
                other.fit == audit::Fit::Whole || fixed.swapped && other.published.is_some() && !is_known;
            if follows || !fixed.swapped && !is_known {
                beside = Some(otherwise(without, &other));
            }
            if !follows {
                continue;
            }
            if own.form.is_some() && fixed.form.is_none() {
                // Of another lobe: how far off it is from the one that is said, read as it is.
                let read = other.best().axes.iter();
                let (axes, registrations) = read.map(|a| ((a.scale, a.reversed), a.registration)).unzip();
                done = judge(&Fixed { axes: Some(axes), registrations: Some(registrations), ..own.clone() })?;
            }
            (done.excluded, done.published) = (Some(without), other.published);
            break;
        }
    }
    done.shipped = shipped::shipped(&bytes, done.quantity)?;
    done.remarks.extend(lacking.map(|lacking| format!("{lacking}.")));
    let priced = function.filter(|_| options.isa);
    let price = |function| options.threads.install(|| cost::cost(&function, &done, &progress));
    let cost = priced.map(price).transpose()?;
    drop(progress);
    let origin = origin::origin(&bytes, &origin::audit(options, wanted));
    let found = audit::findings(&done, origin, &file_name(options), &holds, options.limit);
    let mut found = AuditFindings { cost, otherwise: beside, ..found };
    if let Some(said) = &said {
        let (verdict, figure) = (said.verdict(options.limit), said.figure(options.limit));
        found = AuditFindings { passed: Some(false), verdict, figure, ..found };
    }
    publish(options, folder, &found)
}

/// The file's bytes.
fn read(options: &Options) -> Result<Vec<u8>, CliError> {
    match store::read(&options.file, foreign::limits::BYTES) {
        Err(StoreError::TooLarge { path, limit }) => Err(CliError::Usage(format!(
            "{}: larger than {limit} bytes ({} MiB), the most that is read: a table of 1024 x 1024 texels of four singles takes a quarter of \
             that; give it at the size at which it is shipped, its largest level alone, or its slices one by one",
            path.display(),
            limit >> 20
        ))),
        other => Ok(other?),
    }
}

/// Writes and prints what was found.
fn publish(
    options: &Options,
    mut folder: Option<Folder>,
    found: &AuditFindings,
) -> Result<Outcome, CliError> {
    let (page, figures) = report::audit_page(found)?;
    if let Some(folder) = &mut folder {
        let name = file_name(options);
        let html = (format!("{name}.audit.html"), page.into_bytes());
        folder.write(&Files::from([html, (format!("{name}.audit.json"), figures.clone())]))?;
    }
    if options.json {
        print(&figures)?;
    } else if !options.quiet {
        let cost = found.cost.as_ref().map_or_else(String::new, |cost| format!("\n{}", cost.text()));
        let beside = found.otherwise.as_ref().map_or_else(String::new, AuditOtherwise::text);
        print(format!("{}\n{beside}{cost}", found.verdict).as_bytes())?;
    }
    Ok(if found.passed == Some(false) { Outcome::Failed } else { Outcome::Done })
}

/// Extensions of shaders.
const SHADERS: [&str; 14] = [
    "wgsl", "wesl", "glsl", "frag", "vert", "comp", "fs", "vs", "glslh", "hlsl", "hlsli", "usf", "ush",
    "slang",
];

const SCRIPTS: [&str; 4] = ["js", "mjs", "ts", "mts"];

/// Whether a file is read as a shader's functions: also a header or a text of which one is named, and
/// not a shader that holds arrays alone, which are read as those of a text; only one with arrays is
/// parsed for that.
fn is_shader(options: &Options, bytes: &[u8]) -> bool {
    let holds_functions = || options.source.holds_functions(bytes, &options.file.display().to_string());
    let is_of_arrays = || foreign::holds_arrays(bytes) && !holds_functions();
    options.source.function.is_some() || has_extension_of_shaders(options) && !is_of_arrays()
}

fn has_extension_of_shaders(options: &Options) -> bool {
    // `chunk.glsl.js` is a shader in a script.
    let script = options.file.extension().is_some_and(|e| SCRIPTS.iter().any(|script| e == *script));
    let stem = options.file.file_stem().map(PathBuf::from).filter(|_| script);
    let extension = stem.as_ref().unwrap_or(&options.file).extension();
    let extension = extension.map(|e| e.to_string_lossy().to_ascii_lowercase());
    extension.is_some_and(|e| SHADERS.contains(&e.as_str()))
}

/// What so many samples leave of a texel's mean is no defect: a function has no texels.
const SAMPLES: &str = "--samples";

/// Refuses options that mean nothing for the kind of file.
fn other_kind(options: &Options, shader: bool) -> Result<(), CliError> {
    let (kind, given) = if shader {
        let given = [
            ("--registration", !options.registration.is_empty()),
            ("--size", options.size.is_some()),
            ("--channels", options.channels.is_some()),
            ("--raw-format", options.raw_format.is_some()),
            ("--symbol", options.symbol.is_some()),
            ("--layer", options.layer.is_some()),
            ("--at", options.at.is_some()),
            ("--encoding", options.encoding.is_some()),
            (SAMPLES, options.samples.is_some()),
        ];
        ("a shader", given.into_iter().filter(|g| g.1).map(|g| g.0).next())
    } else {
        let given = [
            ("--set", !options.source.set.is_empty()),
            ("--isa", options.isa),
            ("--domain", !options.domain.is_empty()),
            ("--define", !options.source.define.is_empty()),
            ("--include", !options.source.include.is_empty()),
        ];
        ("a table", given.into_iter().filter(|g| g.1).map(|g| g.0).next())
    };
    let advice = match given {
        Some(SAMPLES) => {
            "only of tables, whose texels are means of so many samples: of a function that loops over samples set their number, if it is an \
             argument, by --set; at how many points a function is judged follows from what it costs, the first line says how many, --domain says \
             where, and --points N lists some"
        }
        _ if shader => "only of tables",
        _ => "only of shader functions: --function names one",
    };
    given.map_or(Ok(()), |option| {
        let file = options.file.display();
        Err(CliError::Usage(format!("{option}: {file} is read as {kind}, and this is {advice}")))
    })
}

/// The function that is meant as a table, and what the file is.
fn shader(options: &Options, wanted: Wanted, bytes: &[u8]) -> Result<Read, CliError> {
    let file = options.file.display().to_string();
    let functions = options.source.read(bytes, &file)?;
    let mut left_out = functions.first().map_or_else(Vec::new, |function| function.left_out.clone());
    let inputs = audit::inputs_of(wanted.0);
    let scales: Vec<Scale> = options.axes.iter().map(|a| a.0).collect();
    let mut found = Vec::new();
    let mut refused = None;
    for function in &functions {
        match audit::sampled(function, wanted.0, &options.source.set, &scales) {
            Ok(sampled) => found.push((sampled, function)),
            Err(error) => {
                left_out.push(foreign::LeftOut::new(&function.signature, &error.reason()));
                refused = refused.or(Some(error));
            }
        }
    }
    if !options.quiet && !found.is_empty() {
        say_left_out(&file, &left_out);
    }
    let names: Vec<&str> = found.iter().map(|f| f.1.signature.as_str()).collect();
    let names = names.join("`, `");
    match (found.len(), refused) {
        (0, Some(error)) if functions.len() == 1 => Err(error.into()),
        (0, Some(error)) => {
            let names: Vec<&str> = functions.iter().map(|f| f.signature.as_str()).collect();
            Err(CliError::Usage(format!(
                "{error}; {file} holds `{}`: choose one by --function, and say by --set what is no input",
                names.join("`, `")
            )))
        }
        (0, None) => Err(CliError::Usage(format!("{file}: holds no function"))),
        (1, _) => {
            let (function, source) = found.swap_remove(0);
            let holds = format!("shader, function {} of {}", function.what, function.axes.join(", "));
            let what = format!("{} ({})", function.what, file_name(options));
            let inverse = match scales.is_empty() {
                true => audit::sampled_inverse(source, wanted.0, &options.source.set)?,
                false => None,
            };
            let inverse = inverse.map(|inverse| AuditedTable { what: what.clone(), ..inverse });
            let audited = AuditedTable { what, ..function };
            Ok(Read {
                audited,
                inverse,
                function: Some(source.clone()),
                holds,
                note: String::new(),
                refused: None,
            })
        }
        _ => Err(CliError::Usage(format!(
            "{file}: holds several functions of {inputs} inputs: `{names}`; choose one by --function"
        ))),
    }
}

fn fixed(options: &Options, wanted: Wanted) -> Result<Fixed, CliError> {
    let meaning = |word: &String| match word.as_str() {
        LEFT_OUT => Ok(None),
        word => column(wanted.0, word).map(Some),
    };
    let meanings: Vec<Option<Column>> =
        options.meaning.iter().map(meaning).collect::<Result<_, String>>().map_err(CliError::Usage)?;
    Ok(Fixed {
        axes: Some(options.axes.clone()).filter(|a| !a.is_empty()),
        registrations: Some(options.registration.clone()).filter(|r| !r.is_empty()),
        form: options.smith,
        side: options.side,
        meanings: Some(meanings).filter(|m| !m.is_empty()),
        column: wanted.1,
        floors: options.clamp.clone(),
        at: options.at,
        encoding: options.encoding,
        samples: options.samples.map(NonZero::get),
        points: options.points,
        domain: words::domain(&options.domain, &options.axes),
        ..Fixed::default()
    })
}

fn file_name(options: &Options) -> String {
    options.file.file_name().map_or(String::new(), |n| n.to_string_lossy().into_owned())
}

/// The file's name with the array's: verdicts depend on no folder.
fn named(options: &Options, array: &str) -> String {
    if array.is_empty() { file_name(options) } else { format!("{} ({array})", file_name(options)) }
}
