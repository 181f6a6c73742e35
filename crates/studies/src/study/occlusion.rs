//! Occlusion culling by depth that arrives late, of the example's scene or of the user's
//! (`lobefit-occlusion`).

use serde::Serialize;
use serde_json::Value;

use super::{REDUCED, Size, Study, StudyError};
use lobefit::bake::Progress;
use lobefit::report::{Origin, Page, document};
use lobefit::scene::{Culling, Scene};
use lobefit_occlusion::study::{self, Results};
use lobefit_occlusion::{CODE, page};

/// The scene.
const SCENE: &[u8] = include_bytes!("../../../../examples/culling.json");

/// The study.
pub struct Occlusion {
    /// Name and culling of the user's scene; none: the example's.
    pub own: Option<(String, Culling)>,
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
        let mut culling = self.own.as_ref().map_or_else(example, |(_, own)| Ok(own.clone()))?;
        if size == Size::Reduced {
            culling.buffer = culling.buffer.map(|n| (n / 2).max(16));
            culling.grid = culling.grid.map(|n| (n / 2).max(2));
        }
        Ok(culling)
    }
}

impl Study for Occlusion {
    fn name(&self) -> &'static str {
        "occlusion"
    }

    fn about(&self) -> &'static str {
        "occlusion buffers from depth that is frames old: seconds"
    }

    fn of_scene(&self, scene: &Scene) -> Option<Box<dyn Study>> {
        let own = (scene.name.clone(), scene.culling.clone()?);
        Some(Box::new(Occlusion { own: Some(own) }))
    }

    fn scene(&self) -> Option<&str> {
        self.own.as_ref().map(|(name, _)| name.as_str())
    }

    fn parameters(&self, size: Size) -> Result<Value, StudyError> {
        Ok(serde_json::json!({ "code": CODE, "culling": self.culling(size)? }))
    }

    fn made(
        &self,
        size: Size,
        origin: Origin,
        progress: &dyn Progress,
    ) -> Result<(Page, Vec<u8>), StudyError> {
        progress.stage("occlusion buffers");
        let results = study::results(&self.culling(size)?);
        let mut page = page::page(&results, origin.clone())?;
        if size == Size::Reduced {
            page.lead.insert_str(0, REDUCED);
        }
        Ok((page, document("results.json", &Document { origin, results })?))
    }
}
