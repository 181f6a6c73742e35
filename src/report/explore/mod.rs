//! What the live page draws: quantities with what stands for them, as GLSL and texels. Every text
//! of a function is what the printer of the include files prints.

mod truth;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Furnace, Origin, ReportError, check};
use crate::data::{Certificate, Cost, Smith, TexelFormat};
use lobefit_truth::quantity::{F0Form, Parts, Specular};
pub use truth::{ROWS, SIDE, TruthTexels, across, between, view};

/// The file of the live page.
pub const EXPLORE: &str = "reports/explore.html";

/// The live page.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplorePage {
    /// What made it.
    pub origin: Origin,
    /// What the effects draw, in their order.
    pub effects: Vec<ExploredEffect>,
}

/// What one effect draws.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExploredEffect {
    /// The effect.
    pub effect: String,
    /// Its quantities.
    pub shown: Vec<Explored>,
}

/// A quantity over roughness and mu, and f0 where `drawn` has it, with what stands for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Explored {
    /// Its name in the address of the page: a word.
    pub name: String,
    /// Title.
    pub title: String,
    /// What the spheres show.
    pub lead: String,
    /// How a sphere shows it.
    pub drawn: Drawn,
    /// Shadowing form of the lobe under a light.
    pub smith: Smith,
    /// alpha as a GLSL expression of `roughness`.
    pub alpha: String,
    /// f0 of the first picture.
    pub f0: f64,
    /// The truth.
    pub truth: TruthTexels,
    /// What stands for it; the first pair with the page is the first and the first emitted.
    pub approximations: Vec<ExploredApproximation>,
    /// The first picture where nothing can be drawn live: radiance in a white furnace.
    pub spheres: Furnace,
}

/// How a sphere shows a quantity. `explore.glsl` has the same by the words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drawn {
    /// N with E N = 1: a metal's lobe with the factor 1 + f0 (N - 1).
    Compensation,
    /// f0 A + B: the light that a lobe sends back.
    Albedo,
    /// The factor of a white base below a lobe that is multiplied so; the lobe is exact.
    Base(Specular),
    /// The column itself.
    Value,
}

impl Drawn {
    /// What a value should be, from the parts of an albedo; a column is their E.
    pub fn truth(self, parts: Parts, f0: f64) -> f64 {
        match self {
            Drawn::Compensation => 1.0 / parts.e,
            Drawn::Albedo => F0Form::Albedo.value(parts, f0),
            Drawn::Base(specular) => specular.form().value(parts, f0),
            Drawn::Value => parts.e,
        }
    }

    /// The light that a sphere with this value sends back in a white furnace.
    pub fn light(self, value: f64, parts: Parts, f0: f64) -> f64 {
        match self {
            Drawn::Compensation => F0Form::Albedo.value(parts, f0) * (1.0 + f0 * (value - 1.0)),
            Drawn::Base(_) => 1.0 - self.truth(parts, f0) + value,
            Drawn::Albedo | Drawn::Value => value,
        }
    }

    /// What a shader without an approximation has: what the reader knows it as, and GLSL.
    pub fn without(self) -> Option<(&'static str, &'static str)> {
        match self {
            Drawn::Compensation => Some(("single scattering", "1.0")),
            Drawn::Albedo => {
                Some(("Schlick's Fresnel alone", "f0 + (1.0 - f0) * pow(max(1.0 - mu, 0.0), 5.0)"))
            }
            Drawn::Base(_) => Some(("base added to the lobe", "1.0")),
            Drawn::Value => None,
        }
    }
}

/// Where an approximation stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Standing {
    /// No approximation: what a shader does that knows nothing of the quantity.
    Without,
    /// A function of the include files.
    Emitted,
    /// A table of the bake.
    Table,
    /// Ours, not emitted: no formula is as cheap and more accurate.
    Frontier,
    /// Somebody else's.
    Published,
}

/// What stands for a quantity: GLSL, cost and certificate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExploredApproximation {
    /// Its name, unique in the quantity.
    pub name: String,
    /// Where it stands.
    pub standing: Standing,
    /// `fitted`, or the publication.
    pub source: String,
    /// GLSL functions; empty where an expression is all.
    pub text: String,
    /// A GLSL expression of `roughness`, `alpha`, `mu` or `n_dot_v`, `f0`, and `live_texels` where
    /// there are any.
    pub call: String,
    /// What it takes.
    pub cost: Cost,
    /// Its error; none without an approximation.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub certificate: Option<Certificate>,
    /// The table that it reads.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub texels: Option<TableTexels>,
}

/// Texels of a table of two axes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TableTexels {
    /// Texels along each axis.
    pub size: [usize; 2],
    /// Channels of a texel.
    pub channels: usize,
    /// How a number is stored.
    pub format: TexelFormat,
    /// Base64 of the texels, little endian, channels side by side.
    pub data: String,
}

/// Recorded times of emitted functions, one call for each pixel of 3840 by 2160.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Times {
    /// The graphics processor.
    pub device: String,
    /// By function.
    pub microseconds: BTreeMap<String, f64>,
}

/// How the names of the live page's own GLSL begin.
pub const PREFIX: &str = "live_";

/// Begins the data in the page.
const OPEN: &str = "<script type=\"application/json\" id=\"explored\">";

/// The data of the page: colours of signed values as base64, times, and what the effects draw.
#[derive(Serialize)]
struct Written<'a> {
    ramp: &'a str,
    times: &'a Times,
    effects: &'a [ExploredEffect],
}

/// The same read back.
#[derive(Deserialize)]
struct Read {
    effects: Vec<ExploredEffect>,
}

/// The data as an element of the page; no text in it can end the element.
///
/// # Errors
/// A number that is not finite.
pub fn document(ramp: &str, times: &Times, effects: &[ExploredEffect]) -> Result<String, ReportError> {
    let refused =
        |e: serde_json::Error| ReportError::Drawing { section: EXPLORE.into(), reason: e.to_string() };
    for explored in effects.iter().flat_map(|effect| &effect.shown) {
        check::finite(EXPLORE, &format!("{}: truth.error", explored.name), explored.truth.error)?;
    }
    let json = serde_json::to_string(&Written { ramp, times, effects }).map_err(refused)?;
    Ok(format!("{OPEN}{}</script>\n", json.replace('<', "\\u003c")))
}

/// What the effects draw on a page that was written; none where the page holds no such data.
pub fn read(html: &str) -> Option<Vec<ExploredEffect>> {
    let data = html.split_once(OPEN)?.1.split_once("</script>")?.0;
    serde_json::from_str::<Read>(data).ok().map(|read| read.effects)
}
