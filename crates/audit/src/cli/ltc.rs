//! `lobefit audit FILE --as ltc`: tables of a linearly transformed cosine.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use super::words::{Ranged, Size, range, raw_format, size};
use crate::audit::Input;
use crate::foreign::{self, ForeignTable, Hints, RawFormat};
use crate::ltc::{LtcFindings, pair};
use lobefit::cli::CliError;
use lobefit::cli::declared;
use lobefit::cli::options::{ThreadsOption, not_negative};
use lobefit::cli::output::{Outcome, print, print_json};
use lobefit::cli::word::Words;
use lobefit::data::Smith;
use lobefit::store;
use lobefit_ltc::{Lobe, Setting};

/// Places along both axes.
const PLACES: usize = 24;

/// What `--as` calls them.
const LOBES: [(&str, Lobe); 3] = [
    ("ltc", Lobe::Ggx(Smith::Correlated)),
    ("ltc:ggx-separable", Lobe::Ggx(Smith::Separable)),
    ("ltc:sheen", Lobe::Charlie),
];

/// Measure tables of a linearly transformed cosine against its lobe
#[derive(Parser)]
#[command(name = "lobefit audit", bin_name = "lobefit audit", version)]
struct Options {
    /// Table of matrices m11, m31, m13, m33, or a file of both tables
    file: PathBuf,
    /// Lobe that it is measured against
    #[arg(long = "as", value_name = "LTC", value_parser = Words::one_of("lobe", LOBES))]
    lobe: Lobe,
    /// Table of E and B, where that is a file of its own
    #[arg(long, value_name = "FILE")]
    scales: Option<PathBuf>,
    /// Ranges of roughness (alpha = roughness^2) and mu
    #[arg(long, value_name = "INPUT=LOW..HIGH,..", value_delimiter = ',', value_parser = range)]
    domain: Vec<(Ranged, [f64; 2])>,
    /// Texels along both axes: `64x64`
    #[arg(long, value_name = "WxH[xD]", value_parser = size)]
    size: Option<Size>,
    /// Values of a texel
    #[arg(long, value_name = "N")]
    channels: Option<usize>,
    /// How numbers lie in a file that does not say
    #[arg(long, value_name = "F", value_parser = raw_format())]
    raw_format: Option<RawFormat>,
    /// Name of the array of the matrices in a text
    #[arg(long, value_name = "NAME")]
    symbol: Option<String>,
    /// Largest error of a square light, of E and of B that is accepted
    #[arg(long, value_name = "E", value_parser = not_negative)]
    limit: Option<f64>,
    #[command(flatten)]
    threads: ThreadsOption,
    /// Print what was found as JSON on standard output
    #[arg(long)]
    json: bool,
    /// Say nothing but errors
    #[arg(long, short)]
    quiet: bool,
}

/// Whether the words of `lobefit audit` ask for this.
pub(super) fn is_meant(words: &[OsString]) -> bool {
    let names = |word: &OsStr| word.to_str().is_some_and(|word| word == "ltc" || word.starts_with("ltc:"));
    let after = words.windows(2).any(|pair| pair[0] == "--as" && names(&pair[1]));
    let joined = |word: &OsString| {
        word.to_str().and_then(|word| word.strip_prefix("--as=")).map(OsStr::new).is_some_and(names)
    };
    after || words.iter().any(joined)
}

/// Runs it on the words.
pub(super) fn run(words: Vec<OsString>) -> ExitCode {
    declared::verb(words, verb)
}

fn verb(options: Options) -> Result<Outcome, CliError> {
    let mut tables = read(&options, &options.file)?;
    if let Some(scales) = &options.scales {
        if tables.first().is_some_and(|table| table.channels.len() > 4) {
            let message = "--scales: a file of 8 channels has E and B itself; leave --scales out";
            return Err(CliError::Usage(message.into()));
        }
        tables.truncate(1);
        tables.extend(read(&options, scales)?);
    }
    let both = pair(&tables)?;
    let setting = setting(&options)?;
    let found =
        options.threads.install(|| Ok(LtcFindings::new(&both, &tables[0], &setting, options.limit)?))?;
    if options.json {
        print_json(&found)?;
    } else if !options.quiet {
        print(found.text().as_bytes())?;
    }
    Ok(if found.passed() { Outcome::Done } else { Outcome::Failed })
}

fn setting(options: &Options) -> Result<Setting, CliError> {
    let mut setting = Setting { lobe: options.lobe, roughness: [0.1, 1.0], mu: [0.01, 1.0], places: PLACES };
    for (ranged, [low, high]) in &options.domain {
        let of = match ranged {
            Ranged::Roughness => &mut setting.roughness,
            Ranged::Input(Input::Mu) => &mut setting.mu,
            Ranged::Input(_) => {
                return Err(CliError::Usage("--domain: of ltc it is of roughness and mu".into()));
            }
        };
        if !(0.0 <= *low && low < high && *high <= 1.0) {
            return Err(CliError::Usage(format!("--domain: {low} to {high} is not within 0 to 1")));
        }
        *of = [*low, *high];
    }
    Ok(setting)
}

/// The tables of a file; of a text with `--symbol` that one alone.
fn read(options: &Options, file: &Path) -> Result<Vec<ForeignTable>, CliError> {
    let bytes = store::read(file, foreign::limits::BYTES)?;
    let size = options.size.clone().map(|size| size.0);
    let Options { channels, raw_format: format, symbol, .. } = options;
    let hints = Hints { size, channels: *channels, format: *format, symbol: symbol.clone(), layer: None };
    Ok(foreign::read_table(&bytes, &file.display().to_string(), &hints)?)
}
