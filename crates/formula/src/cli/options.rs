//! What `fit` is asked: options, their syntax, and the job that they make.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Parser;

use super::after_help;
use crate::fitting::{Demand, FittingError, Job};
use crate::search::{AidKind, Aids, SearchJob};
use lobefit::approximate::target::{TargetError, TargetSpec};
use lobefit::cli::CliError;
use lobefit::cli::input::kernel;
use lobefit::cli::options::{Gpus, NEUTRAL, ThreadsOption, gpus, language, positive, quantity_column, smith};
use lobefit::cli::word::Words;
use lobefit::data::{AlphaMap, Smith, Use};
use lobefit::scene::limits;
use lobefit::store;
use lobefit_fit::Goal;
use lobefit_shade::code::Language;
use lobefit_shade::{Hypothesis, Precision};
use lobefit_truth::quantity::{Choice, Quantity, Variant};

/// Starting points where no number is asked for.
const STARTS: u16 = 8;

/// Fit a formula of your own to a quantity, or search for formulas (--search)
#[derive(Parser)]
#[command(name = "lobefit fit", bin_name = "lobefit fit", after_help = after_help())]
pub(super) struct Options {
    /// WGSL file with the formula (`-`: standard input)
    #[arg(required_unless_present = "search", conflicts_with = "search")]
    pub hypothesis: Option<PathBuf>,
    /// Search for formulas instead of fitting one
    #[arg(long, requires = "max_ops", conflicts_with_all = ["norm", "weight", "range", "rising", "falling", "precision", "starts", "allow_undetermined", "language"])]
    pub search: bool,
    /// Most operations of a formula (--search only), 1 to 64
    #[arg(long, value_name = "N", requires = "search", conflicts_with = "hypothesis", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub max_ops: Option<u32>,
    /// GPUs on which formulas are to be cheap (--search only), by a model of the vendor's compiled
    /// code: amd, intel, adreno, mali or nvidia; neutral counts operations
    #[arg(long, value_name = "VENDOR", requires = "search", conflicts_with = "hypothesis", value_parser = gpus(), default_value = NEUTRAL)]
    pub cost: Gpus,
    /// Forms of each cost that are built upon, and twice as many nested sums (--search only): more
    /// take longer and may find better ones; without it, 24
    #[arg(long, value_name = "N", requires = "search", conflicts_with = "hypothesis", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub width: Option<u16>,
    /// What forms may have beside sums of powers (--search only): auto (what pays in narrow
    /// searches beforehand, which are printed), none, or some of complement (1 - mu), reciprocal
    /// (1 / (mu + k alpha)), root, decay (exp2(-k mu)), inverse-root; exp2, root-of, square (of the
    /// whole form)
    #[arg(long, value_name = "H", requires = "search", conflicts_with = "hypothesis", value_delimiter = ',', value_parser = helper(), default_value = "auto")]
    pub helpers: Vec<Asked>,
    /// Quantity and column that the formula approximates; without a column, the quantity's first
    #[arg(long, value_name = "QUANTITY[:COLUMN]", value_parser = to())]
    pub to: To,
    /// What it is used as, one of the uses below; without it, the quantity's own use, f0-blend for
    /// a formula of f0 and an albedo, else value
    #[arg(long = "use", value_name = "USE", value_parser = used_as())]
    pub used_as: Option<Use>,
    /// What the constants minimise: max, rms, p=P (the p-norm, 2 <= P <= 1000); several make
    /// several fits
    #[arg(long, value_name = "NORM", value_parser = goal, default_value = "max")]
    pub norm: Vec<Goal>,
    /// Weight of the error that is minimised: a WGSL expression of the inputs, as `mu`, or
    /// `perceptual`: how much of an error at mu is seen on spheres in the furnace and under a sky
    /// (with --norm rms). Certificates are not weighted
    #[arg(long, value_name = "EXPRESSION", allow_hyphen_values = true)]
    pub weight: Option<String>,
    /// Range of an input; without it roughness 0.02..1, mu 0.01..1, f0 0..1, ior 1..2, alpha_x and
    /// alpha_y 0.02..1
    #[arg(long, value_name = "INPUT=LOW..HIGH", value_parser = domain)]
    pub domain: Vec<(String, [f64; 2])>,
    /// Value of an input that is a word (side, specular, kernel, which may be a .json file with its
    /// table), or one number for an input
    #[arg(long, value_name = "INPUT=VALUE", value_parser = fix)]
    pub fix: Vec<(String, String)>,
    /// The formula equals the truth, or VALUE, wherever the input has this value
    #[arg(long, value_name = "INPUT=AT[:VALUE]", value_parser = exact)]
    pub exact: Vec<Demand>,
    /// The formula stays within these ends; either may be left out
    #[arg(long, value_name = "LOW..HIGH", value_parser = range, allow_hyphen_values = true)]
    pub range: Option<Demand>,
    /// The formula never falls as this input rises
    #[arg(long, value_name = "INPUT")]
    pub rising: Vec<String>,
    /// The formula never rises as this input rises
    #[arg(long, value_name = "INPUT")]
    pub falling: Vec<String>,
    /// Divisors keep their sign in the domain: always asked for and proven, with or without this
    /// option
    #[arg(long)]
    pub positive_denominator: bool,
    /// Arithmetic of a certificate; the first is the main one
    #[arg(long, value_name = "P", value_parser = precision(), default_value = "f32")]
    pub precision: Vec<Precision>,
    /// Shadowing form
    #[arg(long, value_name = "S", value_parser = smith(), default_value = "correlated")]
    pub smith: Smith,
    /// How roughness becomes alpha
    #[arg(long, value_name = "MAP", value_parser = alpha_map(), default_value = "roughness^2")]
    pub alpha_map: AlphaMap,
    /// Starting points of the search, 1 to 1024
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), default_value_t = STARTS)]
    pub starts: u16,
    /// Accept parameters that coincide or do not matter, and tell which; without it they are an
    /// error
    #[arg(long)]
    pub allow_undetermined: bool,
    /// Largest error of the main certificate; above it the exit code is 1
    #[arg(long, value_name = "E", value_parser = positive)]
    pub limit: Option<f64>,
    /// Languages to write; without it, all of them. A search writes WGSL alone, with which `lobefit fit`
    /// goes on to the others
    #[arg(long, value_name = "L", value_delimiter = ',', value_parser = language())]
    pub language: Vec<Language>,
    /// Folder for the page, the figures and the code, created if missing
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// File for operations and errors of what was found (--search only), shown on the page of costs by
    /// `lobefit cost --page` where it lies in reports/searches
    #[arg(long, value_name = "FILE.json", requires = "search", conflicts_with = "hypothesis")]
    pub record: Option<PathBuf>,
    #[command(flatten)]
    pub threads: ThreadsOption,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// One word of --helpers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Asked {
    Auto,
    None,
    This(AidKind),
}

/// A quantity, and one of its columns.
#[derive(Clone, Debug)]
pub(super) struct To {
    quantity: &'static dyn Quantity,
    column: Option<String>,
}

impl Options {
    /// Reads the formula and puts the job together.
    pub(super) fn job(&self) -> Result<Job, CliError> {
        let file = self.hypothesis.as_deref().unwrap_or(Path::new("-"));
        let (name, source) = read(file)?;
        let hypothesis = Hypothesis::parse(&name, &source)?;
        Ok(Job {
            hypothesis,
            spec: self.spec()?,
            goals: once(&self.norm),
            weight: self.weight.clone(),
            demands: self.demands(),
            precisions: once(&self.precision),
            starts: usize::from(self.starts),
            allow_undetermined: self.allow_undetermined,
            limit: self.limit,
            languages: if self.language.is_empty() { Language::ALL.to_vec() } else { once(&self.language) },
            command: self.command(),
        })
    }

    /// The job of a search.
    pub(super) fn search_job(&self) -> Result<SearchJob, CliError> {
        Ok(SearchJob {
            spec: self.spec()?,
            max_ops: self.max_ops.unwrap_or_default(),
            cost: self.cost.0,
            width: self.width.map(usize::from),
            aids: self.aids()?,
            demands: self.demands(),
            limit: self.limit,
            command: self.command(),
        })
    }

    fn aids(&self) -> Result<Aids, CliError> {
        let kinds = once(&self.helpers).into_iter().filter_map(|asked| match asked {
            Asked::This(kind) => Some(kind),
            Asked::Auto | Asked::None => None,
        });
        match (self.helpers.as_slice(), self.helpers.iter().all(|asked| matches!(asked, Asked::This(_)))) {
            ([Asked::Auto], _) => Ok(Aids::Auto),
            ([Asked::None], _) | (_, true) => Ok(Aids::These(kinds.collect())),
            _ => Err(CliError::Usage("--helpers: auto and none stand alone".into())),
        }
    }

    fn spec(&self) -> Result<TargetSpec, CliError> {
        let To { quantity, column } = self.to.clone();
        let (mut domain, mut variant) = (BTreeMap::new(), Variant::from(self.smith));
        let twice = |option: &str, input: &str| {
            CliError::Usage(format!("{option} {input}: the input is given twice; give it once"))
        };
        for (input, range) in &self.domain {
            if domain.insert(input.clone(), *range).is_some() {
                return Err(twice("--domain", input));
            }
        }
        for (input, value) in &self.fix {
            let known = match value.parse::<f64>() {
                Ok(x) => domain.insert(input.clone(), [x, x]).is_some(),
                Err(_) => choose(&mut variant, quantity, input, value)?,
            };
            if known {
                return Err(twice("--fix", input));
            }
        }
        let (used_as, alpha_map) = (self.used_as, self.alpha_map);
        Ok(TargetSpec { quantity, column, used_as, variant, alpha_map, domain })
    }

    fn demands(&self) -> Vec<Demand> {
        let rising = self.rising.iter().cloned().map(Demand::Rising);
        let falling = self.falling.iter().cloned().map(Demand::Falling);
        self.exact.iter().chain(&self.range).cloned().chain(rising).chain(falling).collect()
    }

    /// The command in a fixed order of options, without those that change no byte of a result and
    /// without the folders of this run.
    fn command(&self) -> String {
        let mut words = vec!["lobefit fit".to_string()];
        let mut push = |option: &str, value: String| {
            words.push(if value.contains([' ', '*', '(', '<', '>', ';']) {
                format!("{option}'{value}'")
            } else {
                format!("{option}{value}")
            });
        };
        if let Some(file) = &self.hypothesis {
            push("", file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned());
        }
        if self.search {
            push("--search", String::new());
        }
        self.max_ops.iter().for_each(|n| push("--max-ops ", n.to_string()));
        self.cost.0.iter().for_each(|vendor| push("--cost ", vendor.word().into()));
        self.width.iter().for_each(|n| push("--width ", n.to_string()));
        if self.helpers != [Asked::Auto] {
            let names: Vec<&str> = once(&self.helpers).into_iter().map(Asked::name).collect();
            push("--helpers ", names.join(","));
        }
        let column = self.to.column.as_ref().map_or(String::new(), |c| format!(":{c}"));
        push("--to ", format!("{}{column}", self.to.quantity.name()));
        self.used_as.iter().for_each(|u| push("--use ", u.name.into()));
        if self.norm != [Goal::Max] {
            self.norm.iter().for_each(|goal| push("--norm ", goal_name(*goal)));
        }
        self.weight.iter().for_each(|w| push("--weight ", w.clone()));
        self.domain.iter().for_each(|(i, [a, b])| push("--domain ", format!("{i}={a}..{b}")));
        self.fix.iter().for_each(|(i, v)| push("--fix ", format!("{i}={}", without_folder(i, v))));
        self.demands().iter().for_each(|d| push("--", demand_option(d)));
        if self.precision != [Precision::F32] {
            self.precision.iter().for_each(|p| push("--precision ", p.name().into()));
        }
        if self.smith != Smith::default() {
            push("--smith ", self.smith.name().into());
        }
        if self.alpha_map != AlphaMap::default() {
            push("--alpha-map ", self.alpha_map.name().into());
        }
        if self.starts != STARTS {
            push("--starts ", self.starts.to_string());
        }
        if self.allow_undetermined {
            push("--allow-undetermined", String::new());
        }
        self.limit.iter().for_each(|l| push("--limit ", l.to_string()));
        let languages: Vec<&str> = once(&self.language).iter().map(|l| l.name()).collect();
        if !languages.is_empty() {
            push("--language ", languages.join(","));
        }
        words.join(" ")
    }
}

impl Asked {
    fn name(self) -> &'static str {
        match self {
            Asked::Auto => "auto",
            Asked::None => "none",
            Asked::This(kind) => kind.name(),
        }
    }
}

fn demand_option(demand: &Demand) -> String {
    let end = |x: f64| if x.is_finite() { x.to_string() } else { String::new() };
    match demand {
        Demand::Exact { input, at, value: None } => format!("exact {input}={at}"),
        Demand::Exact { input, at, value: Some(value) } => format!("exact {input}={at}:{value}"),
        Demand::Range { low, high } => format!("range {}..{}", end(*low), end(*high)),
        Demand::Rising(input) => format!("rising {input}"),
        Demand::Falling(input) => format!("falling {input}"),
    }
}

fn goal_name(goal: Goal) -> String {
    match goal {
        Goal::Max => "max".into(),
        Goal::Rms => "rms".into(),
        Goal::Power(p) => format!("p={p}"),
    }
}

/// Each value once, in the order given.
fn once<T: Copy + PartialEq>(values: &[T]) -> Vec<T> {
    let mut kept: Vec<T> = Vec::new();
    for value in values {
        if !kept.contains(value) {
            kept.push(*value);
        }
    }
    kept
}

/// Makes a choice of a variant; whether it was made before.
fn choose(variant: &mut Variant, quantity: &dyn Quantity, input: &str, word: &str) -> Result<bool, CliError> {
    let refuse = |reason: String| {
        CliError::from(FittingError::from(TargetError::Word { input: input.into(), reason }))
    };
    let choices = quantity.choices().iter().filter(|choice| **choice != Choice::Smith);
    let Some(choice) = choices.copied().find(|choice| choice.name() == input) else {
        let name = quantity.name();
        return Err(refuse(format!(
            "{name} has no such input of words; fix a number by a range of one value"
        )));
    };
    let known = variant.word(choice).is_some();
    if choice == Choice::Kernel {
        variant.kernel = Some(kernel(word)?);
    } else if !variant.choose(choice, word) {
        return Err(refuse(format!("{word} is not one of {}", choice.words().join(", "))));
    }
    Ok(known)
}

/// The value of an input, of a kernel in a file the file's name.
fn without_folder<'a>(input: &str, value: &'a str) -> &'a str {
    let file = || Path::new(value).file_name().and_then(|name| name.to_str());
    if input == "kernel" { file().unwrap_or(value) } else { value }
}

/// The name and the text of the formula's file.
fn read(path: &Path) -> Result<(String, String), CliError> {
    let (name, bytes) = if path.as_os_str() == "-" {
        let name = "<stdin>".to_string();
        let bytes = store::read_stream(std::io::stdin().lock(), &name, limits::HYPOTHESIS_BYTES)?;
        (name, bytes)
    } else {
        (path.display().to_string(), store::read(path, limits::HYPOTHESIS_BYTES)?)
    };
    match String::from_utf8(bytes) {
        Ok(text) => Ok((name, text)),
        Err(e) => Err(CliError::HypothesisText { file: name, at: e.utf8_error().valid_up_to() }),
    }
}

fn to() -> Words<To> {
    quantity_column(|quantity, column| {
        let columns = &quantity.outputs()[..quantity.outputs().len() - 1];
        match column {
            Some(column) if !columns.contains(&column) => {
                let name = quantity.name();
                Err(format!("{name} has no column {column}; its columns are {}", columns.join(", ")))
            }
            column => Ok(To { quantity, column: column.map(String::from) }),
        }
    })
}

fn used_as() -> Words<Use> {
    Words::one_of("use", Use::all().into_iter().map(|used_as| (used_as.name, used_as)))
}

fn goal(text: &str) -> Result<Goal, String> {
    let power = |p: &str| p.parse::<f64>().ok().filter(|p| (2.0..=1000.0).contains(p));
    match text {
        "max" => Ok(Goal::Max),
        "rms" => Ok(Goal::Rms),
        _ => text
            .strip_prefix("p=")
            .and_then(power)
            .map(Goal::Power)
            .ok_or_else(|| "max, rms or p=P with P from 2 to 1000 is called for".into()),
    }
}

/// `INPUT=REST`.
fn assignment<'a>(text: &'a str, form: &str) -> Result<(String, &'a str), String> {
    match text.split_once('=') {
        Some((input, rest)) if !input.is_empty() => Ok((input.to_string(), rest)),
        _ => Err(format!("{form} is called for")),
    }
}

fn domain(text: &str) -> Result<(String, [f64; 2]), String> {
    const FORM: &str = "INPUT=LOW..HIGH, as mu=0.01..1,";
    let (input, rest) = assignment(text, FORM)?;
    let (low, high) = rest.split_once("..").ok_or_else(|| format!("{FORM} is called for"))?;
    Ok((input, [number(low)?, number(high)?]))
}

fn number(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err(format!("`{text}` is not a finite number")),
    }
}

fn fix(text: &str) -> Result<(String, String), String> {
    let (input, value) = assignment(text, "INPUT=VALUE, as side=inside,")?;
    if value.parse::<f64>().is_ok_and(|x| !x.is_finite()) {
        return Err(format!("`{value}` is not a finite number"));
    }
    Ok((input, value.to_string()))
}

fn exact(text: &str) -> Result<Demand, String> {
    let (input, rest) = assignment(text, "INPUT=AT or INPUT=AT:VALUE, as alpha=0 or mu=0:1,")?;
    let (at, value) = rest.split_once(':').map_or((rest, None), |(at, value)| (at, Some(value)));
    Ok(Demand::Exact { input, at: number(at)?, value: value.map(number).transpose()? })
}

fn range(text: &str) -> Result<Demand, String> {
    let (low, high) = text.split_once("..").ok_or("LOW..HIGH, as 0..1, is called for")?;
    let end = |text: &str, none: f64| if text.is_empty() { Ok(none) } else { number(text) };
    let (low, high) = (end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?);
    if low > high || (low.is_infinite() && high.is_infinite()) {
        return Err(
            "LOW..HIGH from the smaller to the larger is called for, at least one of them given".into()
        );
    }
    Ok(Demand::Range { low, high })
}

fn precision() -> Words<Precision> {
    Words::one_of("precision", Precision::ALL.map(|precision| (precision.name(), precision)))
}

fn helper() -> Words<Asked> {
    let all = [Asked::Auto, Asked::None].into_iter().chain(AidKind::ALL.map(Asked::This));
    Words::one_of("helper", all.map(|asked| (asked.name(), asked)))
}

fn alpha_map() -> Words<AlphaMap> {
    Words::one_of("alpha map", AlphaMap::ALL.map(|map| (map.name(), map)))
}
