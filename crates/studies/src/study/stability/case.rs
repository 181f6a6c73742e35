//! The hard cases: what is computed, by which form, and what is promised of ours.

use super::naive;
use crate::study::StudyError;
use lobefit::effects::reflection::NORMALISATIONS;
use lobefit_math::sum::pairwise;
use lobefit_shade::Hypothesis;
use lobefit_shade::tape::Half;
use lobefit_truth::integrate::glass::{self, Side};
use lobefit_truth::integrate::reflection::{TOLERANCE, reflection};
use lobefit_truth::optics::{Smith, fresnel, ggx};

/// A hard case.
pub struct Case {
    /// Its name in the oracle.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// What the distance from the limit is.
    pub distance: &'static str,
    /// Why the naive form fails, and what ours does.
    pub why: &'static str,
    /// The naive form; of half precision the name of a formula.
    pub naive: &'static str,
    /// Where it is met.
    pub met: &'static str,
    /// Our form, in mathematics.
    pub ours: &'static str,
    /// What is called.
    pub called: &'static str,
    /// Largest relative error that ours may have.
    pub promise: f64,
    /// Ours, of the inputs of the oracle.
    pub value: fn(&[f64]) -> Result<f64, StudyError>,
}

/// The formulas of half precision.
const HALF: [&str; 2] = ["ggx_norm_i12", "ggx_norm_i14"];

/// All of them.
pub const CASES: [Case; 10] = [
    Case {
        name: "peak",
        title: "α → 0: the peak of GGX",
        distance: "α, with tan θ = α",
        why: "Near the peak n·h is 1 − α²/2, so the sum 1 − (n·h)² (1 − α²) is as small as α² and has only the digits that n·h has left \
              beyond the 1; the x of the half vector has them all.",
        naive: naive::PEAK,
        met: "Karis 2013, most tutorials",
        ours: "D = d²/π, d = 1/(α (x²/α² + y²/α² + z²)), (x, y, z) = h",
        called: "truth::optics::ggx::distribution",
        promise: 1e-14,
        value: |x| Ok(ggx::distribution(x[0], [x[1], 0.0, x[2]])),
    },
    Case {
        name: "loss",
        title: "α → 0: the energy that a lobe loses",
        distance: "α, at μ = 1",
        why: "The loss falls as α² and E is 1 to all digits before long: even a table of E without any error has no loss in it, so the \
              loss is integrated itself.",
        naive: naive::LOSS,
        met: "LUTs of E for compensation (Kulla and Conty 2017, Turquin 2019)",
        ours: "1 − E = ∫ (G1 − G2) D/(4 μ) dl above the horizon + ∫ G1 D/(4 μ) dl below it",
        called: "truth::integrate::reflection::reflection",
        promise: 1e-6,
        value: |x| Ok(reflection(Smith::Correlated, x[1], 1.0, TOLERANCE)?.loss),
    },
    Case {
        name: "lambda",
        title: "α → 0: Smith’s Λ",
        distance: "α, at μ = 0.6",
        why: "The root is 1 + t/2 for a small t = α² tan² θ: subtracting 1 leaves its rounding. Times its conjugate the difference \
              becomes a quotient in which nothing cancels.",
        naive: naive::LAMBDA,
        met: "Heitz 2014, eq. 72, as printed",
        ours: "Λ = t/(2 (1 + √(1 + t))), t = α² tan² θ",
        called: "truth::optics::ggx::lambda",
        promise: 1e-14,
        value: |x| Ok(ggx::lambda(x[0], x[1])),
    },
    Case {
        name: "grazing",
        title: "μ → 0: the denominator 4 n·v n·l",
        distance: "n·v, with α = 0.3 and n·l = 0.5",
        why: "G2 falls to 0 with n·v and so does the denominator, whose guard against 0 soon outweighs it; with the cosines cancelled \
              by hand the quotient is finite and needs no guard.",
        naive: naive::GRAZING,
        met: "the “+ 0.0001” of tutorials",
        ours: "G2/(4 μ_v μ_l) = 1/(2 (μ_l s_v + μ_v s_l)), s = √(μ² + α² (1 − μ²))",
        called: "truth::optics::ggx::visibility",
        promise: 1e-14,
        value: |x| {
            let [s_v, s_l] = [x[1], x[2]].map(|mu| ggx::stretched_length(x[0], mu));
            Ok(ggx::visibility(Smith::Correlated, x[1], s_v, x[2], s_l))
        },
    },
    Case {
        name: "ior",
        title: "Index of refraction → 1: Fresnel",
        distance: "ior − 1, at cos θ = 0.7",
        why: "Both numerators are differences of nearly equal products, and their squares fall as (ior − 1)²; divided by the sum \
              beforehand they hold the factor ior − 1 exactly.",
        naive: naive::IOR,
        met: "textbooks, pbrt’s FrDielectric",
        ours: "r_s = (1 − η²)/(η c + c_t)², r_p = (1 − η²)(c² − η² s²)/(c + η c_t)², 1 − η² = (ior − 1)(ior + 1)/ior²",
        called: "truth::optics::fresnel::dielectric",
        promise: 1e-14,
        value: |x| Ok(fresnel::dielectric(x[0], x[1])),
    },
    Case {
        name: "critical",
        title: "Critical angle: the light that leaves glass",
        distance: "cos θ less that of the critical angle, ior 1.5",
        why: "What leaves falls to 0 as the root of the distance. Schlick’s curve by the cosine within the glass knows nothing of it: it lets \
              most light out at the very angle from which all is reflected.",
        naive: naive::CRITICAL,
        met: "Ray Tracing in One Weekend",
        ours: "1 − F with c_t = √(1 − η² + η² c²); F = 1 where the root has no value",
        called: "truth::integrate::glass::glass, alpha 0",
        promise: 1e-8,
        value: |x| Ok(glass::glass(Smith::Correlated, 0.0, x[1], x[0], Side::Inside, glass::TOLERANCE)?.t),
    },
    Case {
        name: "total",
        title: "Total internal reflection in glass",
        distance: "cos θ below the critical angle’s, ior 1.5",
        why: "Beyond the critical angle there is no refracted ray: the root of its cosine has no value, and one NaN spreads over a picture. Where the \
              radicand is not above 0, all is reflected.",
        naive: naive::TOTAL,
        met: "Fresnel’s equations with no branch before the root",
        ours: "F = 1 where 1 − η² + η² c² ≤ 0, and as above elsewhere",
        called: "truth::integrate::glass::glass, alpha 0",
        promise: 1e-8,
        value: |x| Ok(glass::glass(Smith::Correlated, 0.0, x[1], x[0], Side::Inside, glass::TOLERANCE)?.r),
    },
    Case {
        name: "anisotropy",
        title: "Extreme anisotropy: Λ along the grain",
        distance: "α_y/α_x, with α_x = 1 and x/y = α_y/α_x",
        why: "Along the grain α_x² less nearly all of itself is to leave α_y²: at 1:100 four digits are gone, at 1:10 000 all of an f32. \
              The sum of two squares keeps them.",
        naive: naive::ANISOTROPY,
        met: "Heitz 2014, eq. 80, with cos² φ = 1 − sin² φ",
        ours: "Λ = t/(2 (1 + √(1 + t))), t = ((α_x x)² + (α_y y)²)/z²",
        called: "truth::optics::ggx::lambda_towards",
        promise: 1e-14,
        value: |x| Ok(ggx::lambda_towards([x[0], x[1]], [x[2], x[3], x[4]])),
    },
    Case {
        name: "sum",
        title: "Ten million samples in one sum",
        distance: "1/samples",
        why: "Once the sum is a few million times a weight, each addition rounds the weight to the sum’s last digit, and always in the same \
              direction; halves of halves, in f64, are added to their like.",
        naive: naive::SUM,
        met: "accumulation buffers in f32",
        ours: "sum(a ++ b) = sum(a) + sum(b), blocks of 128, in f64",
        called: "math::sum::pairwise",
        promise: 1e-14,
        value: |x| Ok(pairwise(&weights(x[0] as u32))),
    },
    Case {
        name: "half",
        title: "Half precision: energy compensation",
        distance: "α = μ",
        why: "An f16 ends at 65 504, which 1/(μ + k α) to the third power passes at once; multiplied by α first, the ratio stays \
              below 1 and so does every power of it.",
        naive: HALF[0],
        met: "a formula of our own for f32, 12 operations",
        ours: "polynomial of α/(μ + k α), α and μ",
        called: "fits/hypotheses/ggx_norm_i14.wgsl in f16",
        promise: 0.0125,
        value: |x| in_half(HALF[1], &["roughness", "alpha", "mu"], x),
    },
];

/// The first `n` weights of samples, in (1/4, 1/3]: a Kronecker sequence of the golden ratio.
pub fn weights(n: u32) -> Vec<f64> {
    let weight = |i: u32| f64::from((1 << 24) - (i.wrapping_mul(2_654_435_769) >> 10)) / 16_777_216.0 / 3.0;
    (0..n).map(weight).collect()
}

/// A formula of the catalogue in f16, with the inputs of these names.
pub fn in_half(formula: &str, names: &[&str], inputs: &[f64]) -> Result<f64, StudyError> {
    let unknown = || StudyError::Unfitted { name: formula.into() };
    let entry = NORMALISATIONS.iter().find(|entry| entry.name() == formula).ok_or_else(unknown)?;
    let hypothesis = Hypothesis::parse(entry.file, entry.source)?;
    let half = |x: f64| Half::nearest(x as f32);
    Ok(f64::from(evaluated(&hypothesis, names, inputs, half, half)?.to_f32()))
}

/// A formula in a precision: inputs by their names, parameters by `parameter` from their values.
pub fn evaluated<R: lobefit_shade::Real>(
    hypothesis: &Hypothesis,
    names: &[&str],
    inputs: &[f64],
    input: impl Fn(f64) -> R,
    parameter: impl Fn(f64) -> R,
) -> Result<R, StudyError> {
    let column = |name: &String| {
        let at = names.iter().position(|known| known == name);
        at.map(|at| input(inputs[at])).ok_or_else(|| StudyError::Unfitted { name: name.clone() })
    };
    let columns: Vec<R> = hypothesis.inputs().iter().map(column).collect::<Result<_, _>>()?;
    let starts: Vec<R> = hypothesis.starts().into_iter().map(parameter).collect();
    Ok(hypothesis.tape().at(&columns, &starts))
}
