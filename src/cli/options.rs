//! Options that several verbs share, and their ranges.

use std::path::PathBuf;

use clap::Args;

use super::CliError;
use super::word::Words;
use crate::bake::{SHARDS, Shard};
use crate::data::{Smith, Vendor};
use crate::effects::catalogue;
use crate::scene::limits;
use lobefit_shade::code::Language;
use lobefit_truth::integrate::monte_carlo::{Draw, Points};
use lobefit_truth::quantity::{self, QUANTITIES, Quantity};

/// The scene of a verb.
#[derive(Args)]
pub struct SceneOption {
    /// Scene file (JSON, glTF: .gltf, .glb, or MaterialX: .mtlx; `-`: standard input); without it, the
    /// built-in scene
    pub scene: Option<PathBuf>,
    /// Its textures.
    #[command(flatten)]
    pub textures: TexturesOption,
}

/// What is read of a scene's textures.
#[derive(Args)]
pub struct TexturesOption {
    /// Read the images of a glTF or MaterialX file, in it or in its folder: their values narrow the ranges
    #[arg(long)]
    pub textures: bool,
    /// Share of the texels that is left out at each end of an image's values, in [0, 0.5)
    #[arg(long, value_name = "SHARE", requires = "textures", value_parser = quantile)]
    pub quantile: Option<f64>,
}

fn quantile(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.0..0.5).contains(&share) => Ok(share),
        _ => Err("a number from 0 to below 0.5 is called for".into()),
    }
}

/// Whether a verb that bakes makes pages.
#[derive(Args)]
pub struct PagesOption {
    /// Make no pages, as `"reports": false` in the scene
    #[arg(long)]
    pub no_reports: bool,
}

/// The worker threads of a verb. They change how long it takes and no byte of what it writes.
#[derive(Args)]
pub struct ThreadsOption {
    /// Worker threads, 1 to 256; without it, one per core
    #[arg(long, value_name = "N", value_parser = threads)]
    pub threads: Option<usize>,
}

impl ThreadsOption {
    /// Runs work on the threads asked for.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> Result<T, CliError> + Send) -> Result<T, CliError> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = self.threads.unwrap_or(cores.min(limits::THREADS));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|e| CliError::Threads { threads, reason: e.to_string() })?.install(work)
    }
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if (1..=limits::THREADS).contains(&n) => Ok(n),
        _ => Err(format!("a whole number from 1 to {} is called for", limits::THREADS)),
    }
}

/// The name of an effect.
pub fn effect() -> Words<String> {
    Words::one_of("effect", catalogue().iter().map(|effect| (effect.name(), effect.name().into())))
}

/// One of the pieces of a bake.
pub fn shard(text: &str) -> Result<Shard, String> {
    Shard::parse(text)
        .ok_or_else(|| format!("K/N with whole numbers, K from 1 to N, N at most {SHARDS}, is called for"))
}

/// The names of all quantities.
fn quantities() -> Vec<&'static str> {
    QUANTITIES.iter().map(|quantity| quantity.name()).collect()
}

/// The quantity of a name.
///
/// # Errors
/// The names that there are.
pub fn quantity_of(name: &str) -> Result<&'static dyn Quantity, String> {
    quantity::find(&name.to_ascii_lowercase())
        .ok_or_else(|| format!("no such quantity in this version; there are {}", quantities().join(", ")))
}

/// The name of a quantity.
pub fn quantity() -> Words<&'static dyn Quantity> {
    Words::read(quantities(), quantity_of)
}

/// `QUANTITY[:COLUMN]`, as a reader of quantity and column has it.
pub fn quantity_column<T: Clone + Send + Sync + 'static>(
    read: impl Fn(&'static dyn Quantity, Option<&str>) -> Result<T, String> + Send + Sync + 'static,
) -> Words<T> {
    Words::read(quantities(), move |text| {
        let (name, column) = text.split_once(':').map_or((text, None), |(name, of)| (name, Some(of)));
        read(quantity_of(name)?, column)
    })
}

/// A shadowing form.
pub fn smith() -> Words<Smith> {
    Words::one_of("shadowing form", [Smith::Correlated, Smith::Separable].map(|form| (form.name(), form)))
}

/// What a sample of Monte Carlo draws.
pub fn draw() -> Words<Draw> {
    Words::one_of("draw", Draw::ALL.map(|draw| (draw.name(), draw)))
}

/// The points that drive the samples of Monte Carlo.
pub fn sequence() -> Words<Points> {
    Words::one_of("sequence", Points::ALL.map(|points| (points.name(), points)))
}

/// A vendor of GPUs.
pub fn vendor() -> Words<Vendor> {
    Words::one_of("vendor", Vendor::ALL.map(|vendor| (vendor.word(), vendor)))
}

/// The word for no vendor: the cost is in operations.
pub const NEUTRAL: &str = "neutral";

/// The vendor by whose GPUs costs are counted; none: by operations.
#[derive(Clone, Copy, Debug)]
pub struct Gpus(pub Option<Vendor>);

/// A vendor's GPUs, or neutral.
pub fn gpus() -> Words<Gpus> {
    let vendors = Vendor::ALL.map(|vendor| (vendor.word(), Gpus(Some(vendor))));
    Words::one_of("vendor", vendors.into_iter().chain([(NEUTRAL, Gpus(None))]))
}

/// A language of the emitted code.
pub fn language() -> Words<Language> {
    Words::one_of("language", Language::ALL.map(|language| (language.name(), language)))
}

/// A finite number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("a finite number above 0 is called for".into()),
    }
}

/// A finite number, 0 or above.
pub fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x >= 0.0 => Ok(x),
        _ => Err("a finite number, 0 or above, is called for".into()),
    }
}
