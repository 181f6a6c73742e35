//! The fits of this effect: normalisations, averages, and blends f0 A + B.

use super::Reflection;
use crate::approximate::target::TargetSpec;
use crate::approximate::{self, CallOps, Emission, FitSet, FitStageError, Formulas, Memo, Region, Wanted};
use crate::data::{Norm, Pick, Smith, Source, Use};
use lobefit_shade::Hypothesis;
use lobefit_truth::quantity::{GgxAverage, Quantity, Variant};

/// What to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FitSpec {
    /// Shadowing form.
    pub smith: Smith,
    /// Where the fits must hold.
    pub region: Region,
    /// Most operations of a fit; none: any.
    pub max_ops: Option<u32>,
    /// Errors to minimise.
    pub norms: Vec<Norm>,
    /// Also fit the average albedo.
    pub average: bool,
    /// Most operations of a fit of it; none: any.
    pub average_ops: Option<u32>,
    /// Also fit f0 A + B.
    pub blend: bool,
    /// The user's hypotheses: file name and WGSL source.
    pub hypotheses: Vec<(String, String)>,
    /// What is emitted: of the normalisations; of the others without their limit and budget.
    pub emission: Emission,
}

/// Everything that the spec asks for: normalisations of ours, the user's, averages, blends, and the
/// published normalisations, of which the formulas of the source post are emitted where all are.
///
/// # Errors
/// A region outside of the quantities' domain; a hypothesis of the user's that cannot be fitted.
pub fn fit_all(of: &Reflection, spec: &FitSpec, memo: &Memo) -> Result<FitSet, FitStageError> {
    let wanted = spec.normalisations(of);
    let mut set = approximate::fit_all(&wanted, memo)?;
    let ours = set.fits.iter().take_while(|fit| fit.approximation.source == Source::Fitted).count();
    let mut published = set.fits.split_off(ours);
    for fit in &mut published {
        let seed = of.seeds.iter().any(|seed| seed.name() == fit.approximation.name);
        let affordable = wanted.too_dear(&fit.hypothesis)?.is_none();
        fit.emitted = spec.emission.pick == Pick::All && seed && affordable;
    }
    if spec.average {
        set.join(&spec.averages(of), memo)?;
    }
    if spec.blend {
        set.join(&spec.blends(of), memo)?;
    }
    set.fits.extend(published);
    Ok(set)
}

impl FitSet {
    /// Adds the fits of another use; formulas of it that cost too much are noted.
    fn join(&mut self, wanted: &Wanted, memo: &Memo) -> Result<(), FitStageError> {
        for entry in wanted.formulas() {
            let formula = Hypothesis::parse(entry.file, entry.source)?;
            self.dropped.extend(wanted.too_dear(&formula)?);
        }
        let more = approximate::fit_all(wanted, memo)?;
        let role = &wanted.emission.role;
        self.unserved.extend(more.nearest.map(|nearest| FitSet::unkept(role, &nearest)));
        self.fits.extend(more.fits);
        self.dropped.extend(more.dropped);
        Ok(())
    }
}

impl FitSpec {
    fn normalisations(&self, of: &Reflection) -> Wanted<'_> {
        Wanted {
            own: Formulas::of(of.normalisations),
            user: &self.hypotheses,
            published: of.seeds.iter().chain(of.published).collect(),
            emission: self.emission.clone(),
            ..self.of(of.lobe, "E", Use::NORMALISATION)
        }
    }

    fn averages(&self, of: &Reflection) -> Wanted<'_> {
        let mut wanted = Wanted {
            own: Formulas::of(of.averages),
            // What it is for divides by 1 - E_avg.
            emission: Emission { most_accurate: true, ..self.emission_as(of.roles[1]) },
            ..self.of(&GgxAverage, "E_avg", Use::VALUE)
        };
        wanted.max_ops = self.average_ops;
        wanted.spec.domain.remove("mu");
        wanted
    }

    fn blends(&self, of: &Reflection) -> Wanted<'_> {
        let published = of.published_blends.iter().collect();
        let emission = self.emission_as(of.roles[2]);
        Wanted { own: Formulas::of(of.blends), published, emission, ..self.of(of.lobe, "E", Use::F0_BLEND) }
    }

    /// What is emitted of fits for another use: the limit on the error is not theirs, and nothing
    /// is called beside them.
    fn emission_as(&self, role: &str) -> Emission {
        let max_error = self.emission.every_error;
        Emission {
            role: role.into(),
            max_error,
            call: CallOps::default(),
            beside_price: 0.0,
            ..self.emission.clone()
        }
    }

    /// No formula for a column of a quantity in a use, over the region.
    fn of(&self, quantity: &'static dyn Quantity, column: &str, used_as: Use) -> Wanted<'_> {
        let domain = [("roughness", self.region.roughness), ("mu", self.region.mu)];
        Wanted {
            spec: TargetSpec {
                quantity,
                column: Some(column.into()),
                used_as: Some(used_as),
                variant: Variant::from(self.smith),
                alpha_map: self.region.alpha_map,
                domain: domain.into_iter().map(|(name, range)| (name.to_string(), range)).collect(),
            },
            own: Formulas::default(),
            user: &[],
            published: Vec::new(),
            norms: &self.norms,
            max_ops: self.max_ops,
            safe_range: None,
            emission: Emission::default(),
        }
    }
}
