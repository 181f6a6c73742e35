//! E, A, B and loss of an isotropic lobe that reflects: `ggx-reflection`, `beckmann-reflection`.

use rayon::prelude::*;

use super::{
    ALPHA, Asked, Choice, Facts, Fresnel, MU, Quantity, Rule, Trace, Truth, Use, Variant, check_unit,
};
use crate::integrate::monte_carlo::{self, Draw, Run, Sampled};
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
///
/// A lobe stands behind a pointer, so that no package that names one compiles its kernels again.
pub trait Reflection: Quantity {
    /// E and B at a texel, of rules with room to spare; B is 0 without `split`.
    fn texel(&self, smith: Smith, place: (f64, f64), split: bool) -> (f64, f64);

    /// E, and B where `split` says so, at millions of points.
    fn known(&self, smith: Smith, split: bool) -> &dyn Known;
}

/// `ggx-reflection`.
pub static GGX_REFLECTION: &dyn Reflection = {
    static LOBE: Lobe<Ggx> = Lobe::new(reflection::QUANTITY, Ggx, true);
    &LOBE
};

/// `beckmann-reflection`.
pub static BECKMANN_REFLECTION: &dyn Reflection = {
    static LOBE: Lobe<Beckmann> = Lobe::new("beckmann-reflection", Beckmann, false);
    &LOBE
};

/// `ggx-reflection` as renderers compute it that follow Karis (2013): with Schlick's shadowing, by k
/// = alpha/2, k = (roughness + 1)^2/8 and k = alpha. Of their correlated variants that of the first alone has
/// a source: Lambda with alpha + (1 - alpha) mu for its root is the joint form of Hammon (2017) and Unreal.
pub static SCHLICK_SMITH: [&dyn Reflection; 3] = {
    static LOBES: [Lobe<SchlickSmith>; 3] = [
        Lobe::new(reflection::QUANTITY, SchlickSmith::of_images, false),
        Lobe::new(reflection::QUANTITY, SchlickSmith::of_lights, false),
        Lobe::new(reflection::QUANTITY, SchlickSmith::of_alpha, false),
    ];
    [&LOBES[0], &LOBES[1], &LOBES[2]]
};

/// Largest error of E and B at many points, by one rule of eight nodes a panel: measured 6.1e-8
/// over alpha and mu in [1e-4, 1], held by `tests/effects/reflection_field.rs`. The texels of
/// tables are made with sixteen and are better.
pub const TRUTH_ERROR: f64 = 1e-7;

/// Nodes of the rule on one panel.
const WHOLE: [usize; 6] = [8, 16, 24, 32, 40, 48];

/// Least points of one task: of E, which takes 1 us, and of B, which takes 30 and below alpha = 1e-4 some
/// thousand.
const CHUNKS: [usize; 2] = [256, 8];

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

/// The quantity of a distribution of normals, and what is known of its E and B.
struct Lobe<D> {
    facts: Facts,
    /// The distribution of a width.
    lobe: fn(f64) -> D,
    /// Whether it is the lobe of the path tracer and of the random walk.
    is_walked: bool,
    /// For each Smith form, E alone, and E and B.
    known: [[Interpolant<D>; 2]; 2],
}

impl<D: Distribution> Lobe<D> {
    const fn new(name: &'static str, lobe: fn(f64) -> D, is_walked: bool) -> Lobe<D> {
        let facts = Facts {
            name,
            inputs: &[ALPHA, MU],
            outputs: &["E", "A", "B", "loss", "error"],
            choices: &[Choice::Smith],
            tolerance: reflection::TOLERANCE,
            smallest_alpha: reflection::SMALLEST_ALPHA,
            fresnel: Some(Fresnel::One),
            draws: &Draw::ALL,
            ..Facts::NONE
        };
        let known = [
            [
                Interpolant::new(lobe, Smith::Correlated, false),
                Interpolant::new(lobe, Smith::Correlated, true),
            ],
            [Interpolant::new(lobe, Smith::Separable, false), Interpolant::new(lobe, Smith::Separable, true)],
        ];
        Lobe { facts, lobe, is_walked, known }
    }

    fn interpolant(&self, smith: Smith, split: bool) -> &Interpolant<D> {
        &self.known[usize::from(smith == Smith::Separable)][usize::from(split)]
    }

    fn value(
        &self,
        smith: Smith,
        (alpha, mu): (f64, f64),
        tolerance: f64,
    ) -> Result<reflection::Reflection, IntegrateError> {
        reflection::reflection_of(self.facts.name, smith, (self.lobe)(alpha), mu, tolerance)
    }
}

impl<D: Distribution + 'static> Reflection for Lobe<D> {
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
    fn new(of: &'a Lobe<D>, smith: Smith, split: bool, places: &[(f64, f64)]) -> Fast<'a, D> {
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

impl<D: Distribution + 'static> Quantity for Lobe<D> {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn uses(&self, column: &str) -> &'static [Use] {
        if column == "E" { &[Use::VALUE, Use::NORMALISATION, Use::F0_BLEND] } else { &[Use::VALUE] }
    }

    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let smith = variant.smith(self.name())?;
        let v = self.value(smith, (x[0], x[1]), tolerance)?;
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
        let smith = variant.smith(self.name())?;
        let fast = Fast::new(self, smith, split, &inputs);
        let one = |place: &(f64, f64)| match fast.at(place, tolerance) {
            Some(known) => Ok(known),
            None => self.value(smith, *place, tolerance).map(|v| (v.e, v.b)),
        };
        let chunk = CHUNKS[usize::from(split && fast.known.is_none())];
        let rows: Vec<(f64, f64)> =
            inputs.par_iter().with_min_len(chunk).map(one).collect::<Result<_, IntegrateError>>()?;
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
        let v = monte_carlo::reflection_of(self.name(), smith, (self.lobe)(x[0]), x[1], run)?;
        Ok(vec![v.e, v.a, v.b, v.loss])
    }

    fn rules(&self, variant: &Variant, x: &[f64]) -> Result<Vec<Rule<'_>>, IntegrateError> {
        let (smith, lobe, mu) = (variant.smith(self.name())?, (self.lobe)(x[0]), x[1]);
        let whole = |n: usize| {
            let rule = PanelRule::new(n);
            Box::new(move || on_one_panel(smith, lobe, mu, &rule)) as Box<dyn Fn() -> f64>
        };
        let graded = |effort: &'static Effort| {
            Box::new(move || albedo_of(smith, lobe, mu, &effort.outer)) as Box<dyn Fn() -> f64>
        };
        Ok(vec![
            Rule { name: "one panel", steps: WHOLE.map(whole).into() },
            Rule { name: "graded panels", steps: Effort::ladder().iter().map(graded).collect() },
        ])
    }

    fn traced(&self, variant: &Variant, x: &[f64]) -> Option<Trace<'_>> {
        let smith = variant.smith.filter(|_| self.is_walked)?;
        Some(monte_carlo::traced(smith, (self.lobe)(x[0]), monte_carlo::view(x[1])))
    }

    fn walked(&self, x: &[f64], walks: Walks) -> Option<Result<Sampled, IntegrateError>> {
        self.is_walked.then(|| white(x[0], [x[1]; 2], walks))
    }
}
