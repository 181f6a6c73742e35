//! E, A, B and loss of an isotropic lobe that reflects: `ggx-reflection`, `beckmann-reflection`.

use rayon::prelude::*;

use super::{
    ALPHA, Asked, Choice, Facts, Fresnel, MU, Quantity, Rule, Trace, Truth, Use, Variant, check_unit,
};
use crate::integrate::monte_carlo::{self, Draw, Run, Sampled, SampledReflection};
use crate::integrate::reflection::{Effort, Interpolant, Known, albedo_of, on_one_panel, split_of};
use crate::integrate::walk::{Walks, white};
use crate::integrate::{Estimate, IntegrateError, PanelRule, reflection};
use crate::optics::Smith;
use crate::optics::beckmann::Beckmann;
use crate::optics::distribution::{Distribution, Ggx};
use crate::optics::schlick_smith::SchlickSmith;

/// The directional albedo E = A + B for F = 1 of a lobe with a distribution of normals, its parts
/// for f0 A + B, and 1 - E.
///
/// The loss is within 1e-6 of itself where mu >= 1e-4. Beckmann's falls faster than any power as
/// alpha goes to 0, and is held to that above 1e-12.
pub struct Reflection {
    facts: Facts,
    by: &'static dyn Lobes,
    /// Whether it is the lobe of the path tracer and of the random walk.
    is_walked: bool,
}

const fn facts(name: &'static str) -> Facts {
    Facts {
        name,
        inputs: &[ALPHA, MU],
        outputs: &["E", "A", "B", "loss", "error"],
        choices: &[Choice::Smith],
        tolerance: reflection::TOLERANCE,
        smallest_alpha: reflection::SMALLEST_ALPHA,
        fresnel: Some(Fresnel::One),
        draws: &Draw::ALL,
        ..Facts::NONE
    }
}

/// `ggx-reflection`.
pub static GGX_REFLECTION: Reflection = {
    static LOBE: Lobed<Ggx> = Lobed::new(Ggx);
    Reflection { facts: facts(reflection::QUANTITY), by: &LOBE, is_walked: true }
};

/// `beckmann-reflection`.
pub static BECKMANN_REFLECTION: Reflection = {
    static LOBE: Lobed<Beckmann> = Lobed::new(Beckmann);
    Reflection { facts: facts("beckmann-reflection"), by: &LOBE, is_walked: false }
};

/// `ggx-reflection` as renderers compute it that follow Karis (2013): with Schlick's shadowing, by k
/// = alpha/2, k = (roughness + 1)^2/8 and k = alpha. Of their correlated variants that of the first alone has
/// a source: Lambda with alpha + (1 - alpha) mu for its root is the joint form of Hammon (2017) and Unreal.
pub static SCHLICK_SMITH: [Reflection; 3] = {
    static LOBES: [Lobed<SchlickSmith>; 3] = [
        Lobed::new(SchlickSmith::of_images),
        Lobed::new(SchlickSmith::of_lights),
        Lobed::new(SchlickSmith::of_alpha),
    ];
    const fn of(by: &'static Lobed<SchlickSmith>) -> Reflection {
        Reflection { facts: facts(reflection::QUANTITY), by, is_walked: false }
    }
    [of(&LOBES[0]), of(&LOBES[1]), of(&LOBES[2])]
};

/// Largest error of E and B at many points, by one rule of eight nodes a panel: measured 6.1e-8
/// over alpha and mu in [1e-4, 1], held by `tests/effects/reflection_field.rs`. The texels of
/// tables are made with sixteen and are better.
pub const TRUTH_ERROR: f64 = 1e-7;

/// Nodes of the rule on one panel.
const WHOLE: [usize; 6] = [8, 16, 24, 32, 40, 48];

/// Least points of one task.
const CHUNK: usize = 256;

/// Smallest alpha and mu of the rule: an f32 next to 1e-4 is among them.
const RULE_FROM: f64 = 1e-4 * (1.0 - 1e-6);

/// From so many points on, values come from an interpolant, of which a tile takes some hundred
/// integrals.
const MANY: usize = 30_000;

/// The rule of the ladder by which truths at many points are made, texels by the one after it. A
/// Gaussian tail takes twice the nodes: with eight B is off by 2e-6.
const fn first<D: Distribution>() -> usize {
    D::REACH.is_finite() as usize
}

/// A distribution of normals, and what is known of its E and B.
struct Lobed<D> {
    /// The distribution of a width.
    lobe: fn(f64) -> D,
    /// For each Smith form, E alone, and E and B.
    known: [[Interpolant<D>; 2]; 2],
}

/// What depends on the distribution of normals, behind a pointer: so no package that names a
/// reflection compiles its kernels again.
trait Lobes: Sync {
    /// As [`Reflection::texel`].
    fn texel(&self, smith: Smith, place: (f64, f64), split: bool) -> (f64, f64);

    /// As [`Reflection::known`].
    fn known(&self, smith: Smith, split: bool) -> &dyn Known;

    /// Values at a point.
    fn at(
        &self,
        of: (&'static str, Smith),
        place: (f64, f64),
        tolerance: f64,
    ) -> Result<reflection::Reflection, IntegrateError>;

    /// E and B at points within their domain.
    fn many(
        &self,
        of: (&'static str, Smith),
        places: &[(f64, f64)],
        split: bool,
        tolerance: f64,
    ) -> Result<Vec<(f64, f64)>, IntegrateError>;

    /// Values by Monte Carlo.
    fn drawn(
        &self,
        of: (&'static str, Smith),
        place: (f64, f64),
        run: Run,
    ) -> Result<SampledReflection, IntegrateError>;

    /// As [`Quantity::rules`].
    fn rules(&self, smith: Smith, place: (f64, f64)) -> Vec<Rule<'static>>;

    /// The path tracer's draws.
    fn traced(&self, smith: Smith, place: (f64, f64)) -> Trace<'static>;
}

impl<D: Distribution> Lobed<D> {
    const fn new(lobe: fn(f64) -> D) -> Lobed<D> {
        let known = [
            [
                Interpolant::new(lobe, Smith::Correlated, false),
                Interpolant::new(lobe, Smith::Correlated, true),
            ],
            [Interpolant::new(lobe, Smith::Separable, false), Interpolant::new(lobe, Smith::Separable, true)],
        ];
        Lobed { lobe, known }
    }

    fn interpolant(&self, smith: Smith, split: bool) -> &Interpolant<D> {
        &self.known[usize::from(smith == Smith::Separable)][usize::from(split)]
    }
}

impl<D: Distribution + 'static> Lobes for Lobed<D> {
    fn texel(&self, smith: Smith, (alpha, mu): (f64, f64), split: bool) -> (f64, f64) {
        let effort = &Effort::ladder()[1 + first::<D>()];
        match split {
            true => split_of(smith, (self.lobe)(alpha), mu, effort),
            false => (albedo_of(smith, (self.lobe)(alpha), mu, &effort.outer), 0.0),
        }
    }

    fn known(&self, smith: Smith, split: bool) -> &dyn Known {
        self.interpolant(smith, split)
    }

    fn at(
        &self,
        (name, smith): (&'static str, Smith),
        (alpha, mu): (f64, f64),
        tolerance: f64,
    ) -> Result<reflection::Reflection, IntegrateError> {
        reflection::reflection_of(name, smith, (self.lobe)(alpha), mu, tolerance)
    }

    fn many(
        &self,
        of: (&'static str, Smith),
        places: &[(f64, f64)],
        split: bool,
        tolerance: f64,
    ) -> Result<Vec<(f64, f64)>, IntegrateError> {
        let fast = Fast::new(self, of.1, split, places);
        let one = |place: &(f64, f64)| match fast.at(place, tolerance) {
            Some(known) => Ok(known),
            None => self.at(of, *place, tolerance).map(|v| (v.e, v.b)),
        };
        places.par_iter().with_min_len(CHUNK).map(one).collect()
    }

    fn drawn(
        &self,
        (name, smith): (&'static str, Smith),
        (alpha, mu): (f64, f64),
        run: Run,
    ) -> Result<SampledReflection, IntegrateError> {
        monte_carlo::reflection_of(name, smith, (self.lobe)(alpha), mu, run)
    }

    fn rules(&self, smith: Smith, (alpha, mu): (f64, f64)) -> Vec<Rule<'static>> {
        let lobe = (self.lobe)(alpha);
        let whole = |n: usize| {
            let rule = PanelRule::new(n);
            Box::new(move || on_one_panel(smith, lobe, mu, &rule)) as Box<dyn Fn() -> f64>
        };
        let graded = |effort: &'static Effort| {
            Box::new(move || albedo_of(smith, lobe, mu, &effort.outer)) as Box<dyn Fn() -> f64>
        };
        vec![
            Rule { name: "one panel", steps: WHOLE.map(whole).into() },
            Rule { name: "graded panels", steps: Effort::ladder().iter().map(graded).collect() },
        ]
    }

    fn traced(&self, smith: Smith, (alpha, mu): (f64, f64)) -> Trace<'static> {
        monte_carlo::traced(smith, (self.lobe)(alpha), monte_carlo::view(mu))
    }
}

/// E and B at points without a bound of their own.
struct Fast<'a, D> {
    smith: Smith,
    lobe: fn(f64) -> D,
    /// Whether B is asked for; else it is NaN.
    split: bool,
    /// For many points, where a tile of integrals serves thousands.
    known: Option<&'a Interpolant<D>>,
}

impl<'a, D: Distribution> Fast<'a, D> {
    fn new(of: &'a Lobed<D>, smith: Smith, split: bool, places: &[(f64, f64)]) -> Fast<'a, D> {
        let known = (places.len() >= MANY).then(|| of.interpolant(smith, split));
        known.inspect(|known| known.cover(places));
        Fast { smith, lobe: of.lobe, split, known }
    }

    /// E and B; none where no rule is known to keep the tolerance.
    fn at(&self, &(alpha, mu): &(f64, f64), tolerance: f64) -> Option<(f64, f64)> {
        if let Some(known) = self.known.and_then(|known| known.at(alpha, mu)) {
            return Some(known);
        }
        let effort = &Effort::ladder()[first::<D>()];
        match self.split {
            _ if alpha != 0.0 && alpha.min(mu) < RULE_FROM => self.bounded(alpha, mu, tolerance),
            true => Some(split_of(self.smith, (self.lobe)(alpha), mu, effort)),
            false => Some((albedo_of(self.smith, (self.lobe)(alpha), mu, &effort.outer), f64::NAN)),
        }
    }

    /// E alone where the first rule is not enough, from a pair of rules.
    fn bounded(&self, alpha: f64, mu: f64, tolerance: f64) -> Option<(f64, f64)> {
        if self.split {
            return None;
        }
        let by = |effort: &Effort| albedo_of(self.smith, (self.lobe)(alpha), mu, &effort.outer);
        let e = Estimate::from_slow_pair(by(&Effort::ladder()[1]), by(&Effort::ladder()[2]), 1.0);
        (e.error <= tolerance).then_some((e.value, f64::NAN))
    }
}

impl Reflection {
    /// E and B at a texel, of rules with room to spare; B is 0 without `split`.
    pub fn texel(&self, smith: Smith, place: (f64, f64), split: bool) -> (f64, f64) {
        self.by.texel(smith, place, split)
    }

    /// E, and B where `split` says so, at millions of points.
    pub fn known(&self, smith: Smith, split: bool) -> &'static dyn Known {
        self.by.known(smith, split)
    }
}

impl Quantity for Reflection {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn uses(&self, column: &str) -> &'static [Use] {
        if column == "E" { &[Use::VALUE, Use::NORMALISATION, Use::F0_BLEND] } else { &[Use::VALUE] }
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let v = self.by.at((self.name(), smith), (x[0], x[1]), tolerance)?;
        Ok(vec![v.e, v.a, v.b, v.loss, v.error])
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        let Asked { variant, outputs, tolerance, .. } = *asked;
        if tolerance < TRUTH_ERROR || asked.wants(&["loss", "error"]) {
            return Ok(None);
        }
        let [alpha, mu] = asked.columns(self)?;
        check_unit(self, "alpha", alpha, self.smallest_alpha())?;
        check_unit(self, "mu", mu, 0.0)?;
        let inputs: Vec<(f64, f64)> = alpha.iter().copied().zip(mu.iter().copied()).collect();
        let split = outputs.iter().any(|output| *output != "E");
        let rows = self.by.many((self.name(), variant.smith(self.name())?), &inputs, split, tolerance)?;
        let of = |output: &str, (e, b): &(f64, f64)| match output {
            "E" => *e,
            "B" => *b,
            _ => e - b,
        };
        Ok(Some(Truth { error: TRUTH_ERROR, ..Truth::of(outputs, &rows, of) }))
    }

    fn tolerance_of_many(&self, _: &Variant) -> f64 {
        TRUTH_ERROR
    }

    fn microseconds(&self, outputs: &[&str]) -> f64 {
        let most = |output: &&str| match *output {
            "E" => 1.0,
            "A" | "B" => 30.0,
            _ => 100.0,
        };
        outputs.iter().map(most).fold(0.0, f64::max)
    }

    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let v = self.by.drawn((self.name(), smith), (x[0], x[1]), run)?;
        Ok(vec![v.e, v.a, v.b, v.loss])
    }

    fn rules(&self, variant: &Variant, x: &[f64]) -> Result<Vec<Rule<'_>>, IntegrateError> {
        Ok(self.by.rules(variant.smith(self.name())?, (x[0], x[1])))
    }

    fn traced(&self, variant: &Variant, x: &[f64]) -> Option<Trace<'_>> {
        let smith = variant.smith.filter(|_| self.is_walked)?;
        Some(self.by.traced(smith, (x[0], x[1])))
    }

    fn walked(&self, x: &[f64], walks: Walks) -> Option<Result<Sampled, IntegrateError>> {
        self.is_walked.then(|| white(x[0], [x[1]; 2], walks))
    }
}
