//! The truth of a quantity over whole tensors of inputs, fast enough to try thousands of
//! conventions.

mod albedo;
mod aniso;
mod average;
mod azimuth;
mod glass;
mod plane;
mod solid;

pub(super) use albedo::{albedo, is_albedo};
pub(super) use aniso::aniso;
pub(super) use average::average;
pub(super) use azimuth::azimuth;
pub(super) use glass::glass;
pub(super) use plane::{beckmann, ggx};

use super::AuditError;
use super::axis::Input;
use super::column::Column;
use lobefit::data::Smith;
use lobefit_truth::integrate::glass::Side;

/// Which lobe a truth is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    /// Shadowing form; none where the quantity has but one.
    pub smith: Option<Smith>,
    /// Where the ray comes from; none where there is but one side.
    pub side: Option<Side>,
}

impl Lobe {
    /// `height-correlated Smith, rays from inside`.
    pub fn words(&self) -> String {
        let smith = self.smith.map(|s| match s {
            Smith::Correlated => "height-correlated Smith",
            Smith::Separable => "separable Smith",
        });
        let side = self.side.map(|s| match s {
            Side::Outside => "rays from outside",
            Side::Inside => "rays from inside",
        });
        [smith, side].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// What is integrated once for all audits of a process.
type Once<T> = std::sync::OnceLock<T>;

/// What `made` makes, unless it was made before. It is not made under a lock: a thread that waits
/// for others in it may be given another audit.
fn once<T>(
    kept: &'static Once<T>,
    made: impl FnOnce() -> Result<T, AuditError>,
) -> Result<&'static T, AuditError> {
    if let Some(kept) = kept.get() {
        return Ok(kept);
    }
    let made = made()?;
    Ok(kept.get_or_init(|| made))
}

/// Place of a shadowing form among what is kept of each.
fn place_of(smith: Smith) -> usize {
    usize::from(smith == Smith::Separable)
}

/// Two base values (see [`Column`]) at every combination of the inputs given, the first input
/// fastest.
pub(super) type Values = Vec<[f64; 2]>;

/// A quantity's truth.
pub(super) trait Truth: Sync {
    /// Name of the quantity.
    fn quantity(&self) -> &'static str;
    /// Its inputs; tensors are given in this order.
    fn inputs(&self) -> &'static [Input];
    /// The lobes to be tried.
    fn lobes(&self) -> &[Lobe];
    /// What its channels may hold.
    fn columns(&self) -> &'static [Column];
    /// Range of an input in which the truth can be had; texels outside are not judged.
    fn range(&self, input: Input) -> [f64; 2];
    /// Whether a texel with this value of an input is judged.
    fn judges(&self, input: Input, x: f64) -> bool {
        let [low, high] = self.range(input);
        (low..=high).contains(&x)
    }
    /// Values within about 1e-3, for trying many conventions; inputs are moved into the range.
    fn quick(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        self.exact(lobe, at)
    }
    /// Values within [`Truth::bound`]; inputs lie in the range.
    fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError>;
    /// Largest error of an exact value.
    fn bound(&self) -> f64;
}
