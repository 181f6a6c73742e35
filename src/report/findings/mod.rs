//! Everything a bake found out, as plain data: filled by the one who ran the jobs, shown by the
//! page, and written as it is to `reports/<effect>.json`.

mod answer;
mod approximation;
mod furnace;
mod spheres;
mod table;

use serde::{Deserialize, Serialize};

use super::Field;
use crate::scene::UNNAMED;

pub use crate::emit::manifest::{EffectFinding, LeftOut};
pub use answer::{Answer, Measured, Offer, Purpose, Role};
pub use approximation::{ApproximationFinding, AverageFinding, AverageFit, FitCurve, FitFinding};
pub use furnace::{Furnace, FurnaceRow};
pub use spheres::SkySpheres;
pub use table::{ChannelFinding, ErrorFigure, TableFinding};

/// Version of the shape of the reports' JSON files.
pub const SCHEMA_VERSION: u32 = 1;

/// What made a page: enough to make it again, and nothing that changes from run to run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// Name of the scene, as the user wrote it.
    pub scene: String,
    /// Hash of the recipe.
    pub recipe: String,
    /// Version of the tool.
    pub tool: String,
    /// Command that makes the page again.
    pub command: String,
    /// The pages that are written with it, and the JSON file of its figures: what they show, and their
    /// file. Every page links them.
    #[serde(skip)]
    pub pages: Vec<(String, String)>,
}

impl Origin {
    /// The file of the page's figures.
    pub(crate) fn figures(&self) -> Option<&str> {
        self.pages.iter().map(|(_, file)| file.as_str()).find(|file| file.ends_with(".json"))
    }

    /// The same with a file of figures beside the page.
    pub fn with_figures(mut self, file: &str) -> Origin {
        self.pages.push(("JSON".into(), file.into()));
        self
    }

    /// The scene as a reader knows it; nothing of one without a name.
    pub fn scene_words(&self) -> &str {
        match self.scene.as_str() {
            UNNAMED => "",
            "default" => "built-in scene",
            named => named,
        }
    }

    /// Title of a page: what it is of what; a scene without a name adds none.
    pub fn title(&self, page: &str, of: &str) -> String {
        [page, self.scene_words(), of]
            .into_iter()
            .filter(|part| !part.is_empty())
            .collect::<Vec<_>>()
            .join(": ")
    }
}

/// What the bake of a scene found out.
///
/// Empty lists are fine where the scene called for nothing of the kind: the page then says so or
/// leaves the section out. Lists inside an entry must be filled.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// What made it.
    pub origin: Origin,
    /// What the scene called for.
    pub effects: Vec<EffectFinding>,
    /// What was left out.
    pub left_out: Vec<LeftOut>,
    /// Tables, with their errors.
    pub tables: Vec<TableFinding>,
    /// Truths over their inputs: E over roughness and mu.
    pub truths: Vec<Field>,
    /// What to see in them.
    #[serde(skip)]
    pub caption: String,
    /// Every approximation, ours and published, in the order in which the page lists them.
    pub approximations: Vec<ApproximationFinding>,
    /// Fits shown beside their truth; each names one of `approximations`.
    pub fits: Vec<FitFinding>,
    /// Fits of the average albedo over roughness.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub averages: Option<AverageFinding>,
    /// Spheres in a white environment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub furnace: Option<Furnace>,
    /// Spheres under a sky, of each value a picture.
    #[serde(skip)]
    pub spheres: Vec<SkySpheres>,
}

impl Findings {
    /// Adds those of more values to the same page.
    pub fn join(&mut self, more: Findings) {
        self.left_out.extend(more.left_out);
        self.tables.extend(more.tables);
        self.truths.extend(more.truths);
        self.caption = format!("{} {}", self.caption, more.caption);
        self.approximations.extend(more.approximations);
        self.fits.extend(more.fits);
        self.spheres.extend(more.spheres);
    }

    /// Nothing yet.
    pub fn new(origin: Origin) -> Findings {
        Findings {
            origin,
            effects: Vec::new(),
            left_out: Vec::new(),
            tables: Vec::new(),
            truths: Vec::new(),
            caption: String::new(),
            approximations: Vec::new(),
            fits: Vec::new(),
            averages: None,
            furnace: None,
            spheres: Vec::new(),
        }
    }
}
