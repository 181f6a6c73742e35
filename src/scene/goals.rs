//! The goals of a want: how good and how cheap what is emitted must be.

use serde::Serialize;

use super::number::{ErrorLimit, In, Ops, Whole};
use super::value::{List, Maybe, Word, about, distinct};
use crate::data::Norm;

/// How good and how cheap a fit or a table must be.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Goals {
    /// Most operations of an emitted fit; `None`: any.
    pub max_ops: Option<u32>,
    /// Largest error of the use that at least one emitted fit, or the table, must keep; `None`:
    /// any.
    pub max_error: Option<f64>,
    /// Errors to minimise, each once, in the order max, rms; empty for a table.
    pub norms: Vec<Norm>,
}

/// `norms` as the file has it.
pub(super) type Norms = Maybe<List<Word<Norm>, 2>>;

impl Goals {
    /// A limit on the error alone, as of a table.
    pub fn error(max_error: Option<f64>) -> Goals {
        Goals { max_error, ..Goals::default() }
    }

    /// Adds what another wants of the same job: the most operations, the strictest error, every
    /// norm.
    pub fn join(&mut self, other: &Goals) {
        self.max_ops = self.max_ops.zip(other.max_ops).map(|(a, b)| a.max(b));
        self.max_error = [self.max_error, other.max_error].into_iter().flatten().reduce(f64::min);
        self.norms.extend(&other.norms);
        self.norms.sort();
        self.norms.dedup();
    }

    /// `up to 20 operations, max and rms`.
    pub fn text(&self) -> String {
        let ops = self.max_ops.map_or_else(|| "any number of".into(), |n| format!("up to {n}"));
        let norms: Vec<&str> = self.norms.iter().map(|n| n.name()).collect();
        format!("{ops} operations, {}", norms.join(" and "))
    }

    /// The goals of a file's fields.
    pub(super) fn read(
        max_ops: Maybe<Whole<Ops>>,
        max_error: Maybe<In<ErrorLimit>>,
        given: Norms,
    ) -> Result<Goals, String> {
        let (max_ops, max_error) = (max_ops.0.map(|w| w.0), max_error.0.map(|e| e.0));
        Ok(Goals { max_ops, max_error, norms: norms(given)? })
    }
}

/// The errors to minimise: by default the largest, each once, in the order max, rms.
fn norms(given: Norms) -> Result<Vec<Norm>, String> {
    let Some(List(given)) = given.0 else { return Ok(vec![Norm::Max]) };
    if given.is_empty() {
        return Err(about("norms", "the list is empty; leave the field out for `max`"));
    }
    distinct(given.into_iter().map(|Word(norm)| norm), Norm::name).map_err(|why| about("norms", why))
}
