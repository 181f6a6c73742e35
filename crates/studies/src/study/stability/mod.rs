//! Hard cases of numerics: textbook forms beside those that this project uses, both against truths
//! made independently (`tests/oracle/stability.py`) along the approach to a limit.

mod case;
mod measure;
mod naive;
mod page;

use serde::Serialize;
use serde_json::Value;

use super::{Size, Study, StudyError};
use lobefit::bake::Progress;
use lobefit::report::{Origin, Page, document};
pub use measure::{Approach, Measured, measured};

/// The truths.
pub const ORACLE: &str = include_str!("../../../tests/oracle/stability.json");

/// The study.
pub struct Stability;

/// What is written.
#[derive(Serialize)]
struct Results<'a> {
    origin: Origin,
    cases: &'a [Measured],
}

impl Study for Stability {
    fn name(&self) -> &'static str {
        "stability"
    }

    fn code(&self) -> &'static str {
        env!("LOBEFIT_STUDY_STABILITY")
    }

    fn about(&self) -> &'static str {
        "naive forms beside stable ones, where numerics is hard: seconds"
    }

    /// Its truths: one size alone.
    fn parameters(&self, size: Size) -> Result<Value, StudyError> {
        Ok(Value::from(vec![format!("{size:?}"), blake3::hash(ORACLE.as_bytes()).to_string()]))
    }

    fn made(
        &self,
        size: Size,
        origin: Origin,
        progress: &dyn Progress,
    ) -> Result<(Page, Vec<u8>), StudyError> {
        progress.stage("hard cases");
        let cases = measured()?;
        let results = document("results.json", &Results { origin: origin.clone(), cases: &cases })?;
        Ok((page::page(&cases, size, origin)?, results))
    }
}
