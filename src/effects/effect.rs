//! What an effect declares. The plan, the bake and its files loop over a catalogue of such values
//! and know none of them by name.

use std::collections::BTreeSet;
use std::fmt;

use super::context::Context;
use super::demand::{Demand, Job};
use super::value::{self, ValueFits};
use super::{BakeError, Called, JobSummary, Made};
use crate::approximate::target::Target;
use crate::approximate::{Entry, SafeRange};
use crate::report::TimedLookup;
use crate::scene::{Material, Scene};
use lobefit_fit::FitError;
use lobefit_shade::Hypothesis;

/// Lines for the head of the include files, and the texts in the emitted code of which any calls
/// for them.
pub type Note = (&'static [&'static str], &'static [&'static str]);

/// Measures the seconds of one execution.
pub type Clock<'a> = &'a dyn Fn(&mut dyn FnMut()) -> f64;

/// Seconds of a page and its pictures on one core, where an effect does not say otherwise.
const REPORT_S: f64 = 0.7;

/// What is said of an effect whatever the scene.
pub struct Profile {
    /// Its name in options, files and the manifest.
    pub name: &'static str,
    /// Its fits of one value over roughness and mu, by the names of their jobs.
    pub fits: &'static [ValueFits<'static>],
    /// Names, beside those of the formulas, that its emitted functions have.
    pub functions: &'static [&'static str],
    /// How names of its other emitted functions begin.
    pub prefixes: &'static [&'static str],
    /// Shader sources beside those of the formulas that its results depend on.
    pub texts: &'static [&'static str],
    /// The lobe of its quantities, for the head of the include files.
    pub lobe: fn(&Scene) -> String,
    /// What the head of the include files says of its functions.
    pub notes: &'static [Note],
    /// Whether its bakes add to the live page ([`Made::explored`](super::Made::explored)).
    pub is_explored: bool,
    /// What of a material's lobe its approximations do not know: `anisotropy`.
    pub without: fn(&Material) -> Option<&'static str>,
}

impl Profile {
    /// Of an effect that has none of this.
    pub const NONE: Profile = Profile {
        name: "",
        fits: &[],
        functions: &[],
        prefixes: &[],
        texts: &[],
        lobe: |scene| format!("alpha = {}", scene.alpha.name()),
        notes: &[],
        is_explored: false,
        without: |_| None,
    };
}

/// One thing that a scene can call for. Its folder holds everything of it; one line in the
/// [catalogue](super::catalogue) adds it.
pub trait Effect: Sync {
    /// What is said of it.
    fn profile(&self) -> &Profile;

    /// [`Profile::name`].
    fn name(&self) -> &'static str {
        self.profile().name
    }

    /// What the scene's materials or probes want of it, in the scene's order.
    fn demands(&self, scene: &Scene) -> Vec<Demand>;

    /// Why a scene without demands leaves it out.
    fn left_out(&self, scene: &Scene) -> String;

    /// Why materials of a scene that ask for it get nothing; none where none asks.
    fn unserved(&self, _: &Scene) -> Option<String> {
        None
    }

    /// What a plan says of the jobs: one summary for each table and each family of fits.
    fn expects(&self, _scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        value::expects(self.profile().fits, jobs)
    }

    /// Stages that the bake of the jobs announces, but for its page.
    fn stages(&self, _scene: &Scene, jobs: &[Job]) -> usize {
        jobs.len()
    }

    /// Seconds of its page on one core.
    fn report_seconds(&self, _scene: &Scene, _jobs: &[Job]) -> f64 {
        REPORT_S
    }

    /// Its formulas, those with free parameters and published ones, each once.
    fn formulas(&self) -> Vec<&'static Entry> {
        let mut known = BTreeSet::new();
        let all = self.profile().fits.iter().flat_map(|fits| fits.own.entries().chain(fits.published));
        all.filter(|entry| known.insert(entry.file)).collect()
    }

    /// The formulas that compete where the user searches for one to this target.
    fn formulas_for(&self, target: &Target) -> Vec<&'static Entry> {
        let suits = |fits: &&ValueFits| {
            let own = (fits.quantity.name(), fits.column, fits.used_as(), fits.side);
            own == (target.quantity.name(), target.column, target.used_as, target.variant.side)
        };
        self.profile()
            .fits
            .iter()
            .filter(suits)
            .flat_map(|fits| fits.own.entries().chain(fits.published))
            .collect()
    }

    /// What fits of them keep beyond the target's domain.
    fn safe_range_for(&self, _target: &Target) -> Option<SafeRange> {
        None
    }

    /// Whether a scene may name formulas of the user's for the target.
    fn takes_formulas_for(&self, _target: &Target) -> bool {
        false
    }

    /// Operations of a formula, with what it takes beside its own text.
    ///
    /// # Errors
    /// A formula of the catalogue that does not parse.
    fn operations(&self, formula: &Hypothesis) -> Result<u32, FitError> {
        Ok(formula.tape().cost_ops())
    }

    /// Every shader source that its results depend on: part of a bake's recipe.
    fn sources(&self) -> Vec<&'static str> {
        let formulas = self.formulas().into_iter().map(|entry| entry.source);
        formulas.chain(self.profile().texts.iter().copied()).collect()
    }

    /// Names, beside those of the formulas, that its emitted functions have.
    fn functions(&self) -> Vec<String> {
        self.profile().functions.iter().copied().map(String::from).collect()
    }

    /// Times of what its functions do beside the tables and the fits of a bake.
    fn timed(&self, _scene: &Scene, _seconds: Clock) -> Vec<TimedLookup> {
        Vec::new()
    }

    /// Makes its jobs: fits and tables with their entries, code, and page.
    ///
    /// # Errors
    /// A formula or a domain that is refused; a truth that cannot be integrated.
    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        value::bake(self.profile().fits, called, context)
    }
}

impl fmt::Debug for dyn Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl PartialEq for dyn Effect {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}
