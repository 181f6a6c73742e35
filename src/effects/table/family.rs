//! What an effect declares of its tables. Plan, bake, files, code and page are made from it, once
//! for all effects.

use std::sync::Arc;

use super::{Region, Spec, TableJob};
use crate::approximate::Memo;
use crate::data::{Layout, Ndf, Serves, Smith, Table};
use crate::effects::effect::Profile;
use crate::effects::table::results::WaysFinding;
use crate::effects::table::{BakedTable, BuildError, LookupPoints, Made};
use crate::effects::{Albedo, BakeError, demand::Job};
use crate::scene::{Lobe, Scene};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;

/// The truth at points of a region.
pub struct Truths {
    /// E, and B where it was asked for, of each side.
    pub sides: Vec<Albedo>,
    /// What they took.
    pub made: Made,
    /// The truth elsewhere in the region.
    pub further: Further,
}

/// The truth of one side, by its number, at further points of a region: whatever integrals the first
/// ones share serve these too.
#[derive(Clone)]
pub struct Further(Arc<FurtherFn>);

type FurtherFn = dyn Fn(usize, &LookupPoints, &Memo) -> Result<Albedo, IntegrateError> + Send + Sync;

impl Further {
    /// By a function of the side, the points, and what counts them.
    pub fn new(
        at: impl Fn(usize, &LookupPoints, &Memo) -> Result<Albedo, IntegrateError> + Send + Sync + 'static,
    ) -> Further {
        Further(Arc::new(at))
    }

    /// E, and B where the first points have it, of side `i`.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn at(&self, i: usize, points: &LookupPoints, memo: &Memo) -> Result<Albedo, IntegrateError> {
        (self.0)(i, points, memo)
    }
}

impl std::fmt::Debug for Further {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("Further")
    }
}

/// Tables of one quantity.
pub trait Family: Sync {
    /// How the name of a table in a layout begins: `ggx-dfg`.
    fn prefix(&self, layout: Layout) -> &'static str;

    /// The role of the tables in a layout, from which their functions have their names:
    /// `ggx_albedo`. It stays when size, format or warp do not.
    fn role(&self, layout: Layout, serves: Serves) -> &'static str;

    /// What tells its tables from those of every other family, in a cache.
    fn identity(&self) -> String {
        format!("{} {}", self.prefix(Layout::Homogeneous), self.role(Layout::Homogeneous, Serves::Albedo))
    }

    /// The layouts of one kind of table, of which a message names those that keep a limit; none
    /// where there is one alone.
    fn layouts(&self) -> &'static [Layout] {
        &[]
    }

    /// The sides for which there is a table each: one without a side, or of glass outside and
    /// inside.
    fn sides(&self) -> &'static [Option<Side>] {
        &[None]
    }

    /// What a plan says of a table: `of glass for rays from outside`.
    fn described(&self, job: &TableJob, side: Option<Side>) -> String;

    /// Seconds of job `i` on one core.
    fn seconds(&self, i: usize, jobs: &[TableJob]) -> f64;

    /// What the axes of a layout do not tell of its nodes.
    fn note(&self, _layout: Layout) -> Option<&'static str> {
        None
    }

    /// A table for each name of the spec, texels not yet rounded.
    ///
    /// # Errors
    /// A layout that the family does not have; a truth that cannot be integrated.
    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError>;

    /// Whether the truth of a job must tell more than E in the mean over the azimuth: B, or E at an
    /// azimuth.
    fn finer(&self, _job: &TableJob, _jobs: &[TableJob]) -> bool {
        false
    }

    /// Points at which lookups in a region are judged.
    ///
    /// # Errors
    /// A region without the slices that the tables have.
    fn points(&self, region: &Region, finer: bool) -> Result<LookupPoints, BuildError>;

    /// How many points even in the coordinates of a table of so many texels judge it besides, where the truth
    /// is too dear to close in on the largest error.
    fn judged_at(&self, _texels: usize) -> Option<u32> {
        None
    }

    /// The truth of each side at points: E, and B where it must be `finer` and tables hold it.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    fn truths(
        &self,
        smith: Smith,
        points: &LookupPoints,
        finer: bool,
        memo: &Memo,
    ) -> Result<Truths, IntegrateError>;
}

/// An effect that is a family of tables with slices, and nothing else. It is an
/// [`Effect`](crate::effects::Effect) by it.
pub trait Sliced: Family {
    /// What is said of the effect.
    fn profile(&self) -> &Profile;

    /// The lobe whose materials call for it.
    fn lobe(&self) -> Lobe;

    /// The distribution of normals that they have.
    fn ndf(&self) -> Ndf {
        Ndf::Ggx
    }

    /// The lobe in words: `a rough anisotropic lobe`.
    fn lobe_text(&self) -> &'static str;

    /// Why a scene leaves it out.
    fn left_out(&self, scene: &Scene) -> String;

    /// Why materials of a scene that ask for it get nothing; none where none asks.
    fn unserved(&self, _: &Scene) -> Option<String> {
        None
    }

    /// Seconds of what its page shows beside other tables' pages.
    fn study_seconds(&self, _scene: &Scene, _jobs: &[Job]) -> f64 {
        0.0
    }

    /// Slices that pictures are drawn at, as far as they lie in the range.
    fn shown(&self) -> &'static [f64];

    /// Title of a furnace test at a slice: `Glass, index of refraction 1.5, from inside`.
    fn title(&self, slice: f64, side: Option<Side>) -> String;

    /// Place of a slice in [0, 1] as the path tracer reads its layers.
    fn layer(&self, slice: f64) -> f64;

    /// Standard error of the path tracer's own estimate at a place of the unit cube of its table.
    ///
    /// # Errors
    /// A place outside the domain.
    fn path_tracer_error(&self, place: [f64; 3]) -> Result<f64, IntegrateError>;

    /// Ways to look up a truth that the tables hold a mean of.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    fn ways(&self, _tables: &[BakedTable]) -> Result<Vec<WaysFinding>, BakeError> {
        Ok(Vec::new())
    }
}
