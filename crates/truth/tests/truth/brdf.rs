//! The integral of any BRDF against the reductions that know more: GGX, Beckmann, sheen.

use lobefit_math::ops;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::brdf::{Brdf, albedo};
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::optics::distribution::{Distribution, Ggx};
use lobefit_truth::optics::ggx::Vec3;
use lobefit_truth::quantity::sheen::lobe as sheen;
use lobefit_truth::quantity::{
    BECKMANN_REFLECTION, Choice, Facts, GGX_REFLECTION, Input, Quantity, SheenCharlie, Variant,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Tolerance of the integrals, and points that are compared.
const TOLERANCE: f64 = 1e-7;
const POINTS: u64 = 300;

fn half(v: Vec3, l: Vec3) -> Vec3 {
    let sum = [v[0] + l[0], v[1] + l[1], v[2] + l[2]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
    sum.map(|x| x / length)
}

/// D G2/(4 mu_v mu_l) cos(theta_l) as the textbook has it.
fn microfacets<D>(smith: Smith, lobe: D) -> Brdf<'static>
where
    D: Distribution + 'static,
{
    let weighted = move |v: Vec3, l: Vec3| {
        let (of_view, of_light) = (lobe.lambda(v[2]), lobe.lambda(l[2]));
        let g2 = match smith {
            Smith::Correlated => 1.0 / (1.0 + of_view + of_light),
            Smith::Separable => 1.0 / ((1.0 + of_view) * (1.0 + of_light)),
        };
        lobe.density(half(v, l)) * g2 / (4.0 * v[2])
    };
    Brdf { weighted: Box::new(weighted), width: lobe.alpha() }
}

fn charlie(alpha: f64) -> Brdf<'static> {
    let weighted =
        move |v: Vec3, l: Vec3| sheen::distribution(alpha, half(v, l)) * sheen::lit(v[2], l[2]) / 4.0;
    // sin^(1/alpha) of the half vector's angle has a kink at the mirror direction.
    Brdf { weighted: Box::new(weighted), width: 1e-3 }
}

/// The largest difference of a BRDF's albedo from E of a quantity at points with alpha and mu
/// logarithmic from `low`.
fn worst(
    quantity: &'static dyn Quantity,
    smith: Smith,
    low: [f64; 2],
    brdf: impl Fn(f64) -> Brdf<'static> + Sync,
) -> f64 {
    let off = |index: u64| {
        let mut random = Pcg64::seed_from_u64(99_000 + index);
        let [alpha, mu] = low.map(|low| ops::pow(low, random.random()));
        let found = albedo("a BRDF", &brdf(alpha), mu, TOLERANCE).expect("an integral");
        let variant = Variant::from(smith).of(quantity.choices());
        let exact = quantity.at(&variant, &[alpha, mu], 1e-9).expect("in the domain")[0];
        let off = (found.value - exact).abs();
        assert!(off <= found.error + 1e-9, "{quantity:?} {alpha} {mu}: {off:e} of {:e}", found.error);
        off
    };
    (0..POINTS).into_par_iter().map(off).reduce(|| 0.0, f64::max)
}

#[test]
fn brdfs_have_the_albedos_of_their_reductions() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let ggx = worst(GGX_REFLECTION, smith, [1e-3, 1e-3], |alpha| microfacets(smith, Ggx(alpha)));
        let beckmann =
            worst(BECKMANN_REFLECTION, smith, [1e-2, 1e-2], |alpha| microfacets(smith, Beckmann(alpha)));
        println!("{smith:?}: GGX {ggx:e}, Beckmann {beckmann:e}");
    }
    println!("sheen {:e}", worst(&SheenCharlie, Smith::Correlated, [0.05, 1e-2], charlie));
}

/// Half of a diffuse lobe and half of GGX's: a quantity that gives its BRDF and nothing else.
struct Glossy;

impl Quantity for Glossy {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "glossy",
                inputs: &[Input::new("alpha", [1e-3, 1.0]), Input::new("mu", [1e-6, 1.0])],
                outputs: &["E", "error"],
                choices: &[Choice::Smith],
                tolerance: 1e-7,
                smallest_alpha: 1e-3,
                ..Facts::NONE
            }
        }
    }

    fn brdf(&self, variant: &Variant, x: &[f64]) -> Result<Brdf<'_>, IntegrateError> {
        let ggx = microfacets(variant.smith.unwrap_or_default(), Ggx(x[0]));
        let weighted = move |v: Vec3, l: Vec3| 0.5 * (ggx.weighted)(v, l) + 0.5 * l[2] / std::f64::consts::PI;
        Ok(Brdf { weighted: Box::new(weighted), width: x[0] })
    }
}

#[test]
fn a_quantity_that_gives_its_brdf_has_a_truth() {
    for (alpha, mu) in [(0.01, 0.9), (0.3, 0.05), (1.0, 1.0)] {
        let variant = Variant::from(Smith::Separable);
        let found = Glossy.at(&variant, &[alpha, mu], 1e-7).expect("a truth");
        let exact = 0.5 + 0.5 * GGX_REFLECTION.at(&variant, &[alpha, mu], 1e-9).expect("E")[0];
        assert!((found[0] - exact).abs() <= found[1], "{alpha} {mu}: {found:?} {exact}");
    }
    assert!(SheenCharlie.brdf(&Variant::default(), &[0.5, 0.5]).is_err());
}
