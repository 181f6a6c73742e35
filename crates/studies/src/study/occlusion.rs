//! Occlusion culling by depth that arrives late, of the example's scene or of the user's
//! (`lobefit-occlusion`).

use std::borrow::Cow;

use serde::Serialize;
use serde_json::Value;

use super::{Given, REDUCED, Size, Study, StudyError, Timed};
use lobefit::bake::Progress;
use lobefit::cli::CliError;
use lobefit::cli::cost::device;
use lobefit::report::{Origin, Page, document};
use lobefit::scene::{Culling, Scene, World};
use lobefit_import::limits::MESH_BYTES;
use lobefit_import::mesh;
use lobefit_occlusion::choice::{Choices, choices};
use lobefit_occlusion::site::Site;
use lobefit_occlusion::study::{self, Results};
use lobefit_occlusion::times::Times;
use lobefit_occlusion::{CODE, page};

/// The scene.
const SCENE: &[u8] = include_bytes!("../../../../examples/culling.json");

/// The study.
#[derive(Clone)]
pub struct Occlusion {
    /// The user's scene; none: the example's.
    pub own: Option<Own>,
    /// What passes took where they were timed.
    pub times: Option<Times>,
    /// The free parameters, where they were chosen for that.
    pub choices: Option<Choices>,
}

/// What the study takes of a scene of the user's.
#[derive(Clone)]
pub struct Own {
    /// The name of the scene, and its file as it was given.
    names: [String; 2],
    culling: Culling,
    site: Site,
    /// Hash of the file of a world that is a mesh.
    mesh: Option<String>,
}

/// What is written.
#[derive(Serialize)]
struct Document {
    origin: Origin,
    #[serde(flatten)]
    results: Results,
}

impl Occlusion {
    /// What the scene asks for; of the reduced study with a quarter of the texels and an eighth of
    /// the voxels, as far as there are as many.
    fn culling(&self, size: Size) -> Result<Culling, StudyError> {
        let example =
            || Scene::from_json(SCENE, "examples/culling.json")?.culling.ok_or(StudyError::NoCulling);
        let mut culling = self.own.as_ref().map_or_else(example, |own| Ok(own.culling.clone()))?;
        if size == Size::Reduced {
            culling.buffer = culling.buffer.map(|n| (n / 2).max(16));
            culling.grid = culling.grid.map(|n| (n / 2).max(2));
        }
        Ok(culling)
    }

    /// What is looked at.
    fn site(&self, culling: &Culling) -> Result<Cow<'_, Site>, StudyError> {
        match (&self.own, &culling.world) {
            (Some(own), _) => Ok(Cow::Borrowed(&own.site)),
            (None, World::Generated(kind)) => Ok(Cow::Owned(Site::generated(*kind, culling.seed))),
            (None, World::Mesh(_)) => Err(StudyError::NoCulling),
        }
    }
}

impl Study for Occlusion {
    fn name(&self) -> &'static str {
        "occlusion"
    }

    fn code(&self) -> &'static str {
        env!("LOBEFIT_STUDY_OCCLUSION")
    }

    fn about(&self) -> &'static str {
        "occlusion buffers from depth that is frames old: seconds"
    }

    fn of_scene(&self, given: &Given) -> Result<Option<Box<dyn Study>>, CliError> {
        const FIELD: &str = "culling.world";
        let Some(culling) = given.scene.culling.clone() else { return Ok(None) };
        let (site, mesh) = match &culling.world {
            World::Generated(kind) => (Site::generated(*kind, culling.seed), None),
            World::Mesh(path) => {
                let (file, bytes) = given.beside(path, FIELD, MESH_BYTES)?;
                let site = Site::of_mesh(&mesh(&bytes, &file).map_err(|e| given.refused(FIELD, e))?);
                if !study::has_boxes(&culling, &site) {
                    let why = "none of its boxes lies in front of the camera, all of it, in any frame that is measured: it is read in metres, and the camera stands 1.7 m above its ground";
                    return Err(given.refused(FIELD, format!("{file}: {why}")));
                }
                (site, Some(blake3::hash(&bytes).to_hex().to_string()))
            }
        };
        let names = [given.scene.name.clone(), given.file()?];
        Ok(Some(Box::new(Occlusion {
            own: Some(Own { names, culling, site, mesh }),
            times: None,
            choices: None,
        })))
    }

    fn scene(&self) -> Option<[&str; 2]> {
        self.own.as_ref().map(|own| own.names.each_ref().map(String::as_str))
    }

    fn parameters(&self, size: Size) -> Result<Value, StudyError> {
        let mut parameters = serde_json::json!({ "code": CODE, "culling": self.culling(size)? });
        if let Some(hash) = self.own.as_ref().and_then(|own| own.mesh.as_deref()) {
            parameters["mesh"] = Value::from(hash);
        }
        Ok(parameters)
    }

    fn timed(&self, size: Size, command: String) -> Result<Option<Timed>, StudyError> {
        let culling = self.culling(size)?;
        let site = self.site(&culling)?;
        let choices = choices(&culling, &site);
        let times = Times::measured((&culling, &site), &choices.best.trial, [command, device(1)]);
        let record = document("times.json", &times)?;
        // What the page shows is what the record holds: numbers of fewer digits.
        let times = Some(serde_json::from_slice(&record)?);
        let study = Box::new(Occlusion { own: self.own.clone(), times, choices: Some(choices) });
        Ok(Some(Timed { record, study }))
    }

    fn with_times(&self, record: &[u8]) -> Result<Option<Box<dyn Study>>, serde_json::Error> {
        let times = Some(serde_json::from_slice(record)?);
        Ok(Some(Box::new(Occlusion { times, ..self.clone() })))
    }

    fn made(
        &self,
        size: Size,
        origin: Origin,
        progress: &dyn Progress,
    ) -> Result<(Page, Vec<u8>), StudyError> {
        progress.stage("occlusion buffers");
        let culling = self.culling(size)?;
        let site = self.site(&culling)?;
        let choices = self.choices.clone().unwrap_or_else(|| choices(&culling, &site));
        let results = study::results(&culling, &site, choices);
        let mut page = page::page(&results, self.times.as_ref(), origin.clone())?;
        if size == Size::Reduced {
            page.lead.insert_str(0, REDUCED);
        }
        Ok((page, document("results.json", &Document { origin, results })?))
    }
}
