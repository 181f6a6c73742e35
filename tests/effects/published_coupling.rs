//! The published coupling factors of the catalogue have the errors that the published comparison
//! prints: on its grid of 200 x 200, within 2 % or one unit of the last digit.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use crate::published_support;

use std::sync::LazyLock;

use lobefit::approximate::Entry;
use lobefit::data::Smith;
use lobefit::effects::coupling::{OWN_SPECULAR, PUBLISHED};
use lobefit::effects::reflection::PUBLISHED_BLENDS;
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;
use lobefit_truth::quantity::Specular;
use published_support::forms::{BIASES, NORMALISATIONS};
use published_support::{Grid, differs, evaluate, figures};

static GRID: LazyLock<Grid> = LazyLock::new(|| Grid::new(Smith::Correlated));

/// f0 of the page's columns under a bare lobe, and under the others.
const F0: [f32; 6] = [0.02, 0.04, 0.08, 0.2, 0.5, 1.0];
const FEW: [f32; 3] = [0.04, 0.2, 0.5];

/// In the page's order.
const LOBES: [Specular; 3] = [Specular::Single, Specular::Compensated, Specular::Normalised];

/// What a lobe of reflectance f0 and albedo e is multiplied by.
fn multiplier(specular: Specular, f0: f64, e: f64) -> f64 {
    match specular {
        Specular::Single => 1.0,
        Specular::Normalised => 1.0 / e,
        Specular::Compensated => 1.0 + f0 * (1.0 / e - 1.0),
    }
}

/// Light of the lobe alone; its multiplier has the albedo `e`.
fn lobe(grid: &Grid, specular: Specular, f0: f32, e: &[f64]) -> Vec<f64> {
    let f0 = f64::from(f0);
    let one = |i: usize| (f0 * (grid.e[i] - grid.b[i]) + grid.b[i]) * multiplier(specular, f0, e[i]);
    (0..e.len()).map(one).collect()
}

/// What lobe and base together are off 1 at an f0, by factor and albedo of the multiplier.
struct Row<'a> {
    grid: &'a Grid,
    factor: &'a dyn Fn(Specular, f32) -> Vec<f64>,
    albedo: Option<Vec<f64>>,
}

impl Row<'_> {
    fn off(&self, specular: Specular, f0: f32) -> Vec<f64> {
        let lobe = lobe(self.grid, specular, f0, self.albedo.as_ref().unwrap_or(&self.grid.e));
        lobe.iter().zip((self.factor)(specular, f0)).map(|(lobe, factor)| lobe + factor - 1.0).collect()
    }

    fn differences(&self, id: &str, printed: [&str; 4]) -> Vec<String> {
        let mut out = Vec::new();
        for (specular, (cell, f0)) in LOBES.into_iter().zip(printed.iter().zip([&F0[..], &FEW, &FEW])) {
            for (f0, figure) in f0.iter().zip(figures(cell)) {
                let max = self.off(specular, *f0).into_iter().fold(0.0, |m: f64, d| m.max(d.abs()));
                out.extend(differs(&format!("{id} {} at {f0}", specular.name()), max, figure));
            }
        }
        for (specular, figure) in LOBES.into_iter().zip(printed[3].split_whitespace()) {
            let squares = F0.iter().flat_map(|f0| self.off(specular, *f0)).map(|d| d * d);
            let rms = (squares.sum::<f64>() / (F0.len() * self.grid.e.len()) as f64).sqrt();
            out.extend(differs(&format!("{id} {} rms", specular.name()), rms, figure));
        }
        out
    }
}

fn alpha(name: &str, r: f64) -> f64 {
    if name == "alpha" { r * r } else { r }
}

/// Rows of factors that are the same under every lobe: the columns of the bare lobe, of the
/// compensated and of the normalised one, RMS.
const PURE: [(&str, [&str; 4]); 8] = [
    ("none", [".95/.95/.95/.96/.97/1.0", ".95/.96/.98", ".95/.96/.98", ".42 .48 .49"]),
    ("f0", [".93/.91/.87/.76/.47/.69", ".91/.76/.48", ".91/.76/.48", ".156 .112 .115"]),
    ("fresnel", [".89/.87/.84/.74/.48/.69", ".87/.73/.47", ".87/.73/.45", ".205 .169 .157"]),
    ("gltf", [".90/.89/.85/.74/.46/.69", ".89/.74/.46", ".89/.74/.46", ".153 .106 .109"]),
    ("ashikhmin_shirley", [".92/.90/.86/.76/.50/.69", ".90/.75/.48", ".89/.74/.46", ".295 .269 .252"]),
    ("schlick_roughness", [".28/.27/.24/.16/.35/.69", ".27/.16/.17", ".26/.16/.09", ".119 .045 .031"]),
    ("pesce", [".29/.285/.27/.24/.35/.69", ".285/.24/.17", ".281/.23/.15", ".123 .052 .036"]),
    ("dassault", [".22/.22/.21/.27/.47/.69", ".22/.24/.30", ".20/.17/.12", ".151 .094 .067"]),
];

fn pure(name: &str) -> &'static Entry {
    static ALL: LazyLock<Vec<Entry>> = LazyLock::new(|| PUBLISHED.to_vec());
    let full = format!("coupling_{name}");
    ALL.iter().find(|e| e.name() == full).unwrap_or_else(|| panic!("{full} is not in the catalogue"))
}

fn none_differ(differences: &[String]) {
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

#[test]
fn factors_that_engines_ship() {
    assert_eq!(PUBLISHED.len(), PURE.len());
    let row = |(name, printed): &(&str, [&str; 4])| {
        let factor = |_, f0: f32| evaluate(pure(name), &GRID, f0, alpha);
        Row { grid: &GRID, factor: &factor, albedo: None }.differences(name, *printed)
    };
    none_differ(&PURE.iter().flat_map(row).collect::<Vec<_>>());
}

#[test]
fn factors_fed_with_another_roughness() {
    let squared = |_: &str, r: f64| r * r;
    let pesce = |_, f0: f32| evaluate(pure("pesce"), &GRID, f0, squared);
    let printed = [".52/.51/.49/.43/.35/.69", ".51/.43/.27", ".51/.42/.26", ".143 .088 .074"];
    let mut out = Row { grid: &GRID, factor: &pesce, albedo: None }.differences("mix at alpha", printed);
    let fourth = |_: &str, r: f64| r * r * r * r;
    let dassault = |_, f0: f32| evaluate(pure("dassault"), &GRID, f0, fourth);
    let printed = [".56/.55/.53/.46/.47/.69", ".55/.46/.30", ".55/.46/.29", ".167 .118 .095"];
    out.extend(
        Row { grid: &GRID, factor: &dassault, albedo: None }.differences("dassault at alpha^2", printed),
    );
    none_differ(&out);
}

/// 1 less a fitted lobe: the lobe above is multiplied by what its own fit says.
const OWN: [(&str, [&str; 4]); 5] = [
    ("karis", [".08/.08/.09/.14/.28/.50", ".08/.17/.44", ".14/.30/.61", ".066 .098 .105"]),
    ("materialx_m1", [".046/.045/.043/.047/.065/.096", ".045/.046/.066", ".045/.048/.066", ".006 .006 .007"]),
    ("ue5", [".082/.081/.080/.078/.073/.065", ".081/.079/.074", ".085/.082/.076", ".007 .008 .008"]),
    (
        "ray_tracing_gems",
        [".044/.043/.054/.094/.193/.359", ".043/.107/.259", ".069/.158/.325", ".025 .036 .039"],
    ),
    ("tauray", [".086/.084/.080/.070/.073/.092", ".084/.070/.077", ".084/.070/.082", ".009 .010 .010"]),
];

/// The figure of the page that is not met, and what is measured in its place: it was measured on 60
/// x 60 points.
const EXCEPTION: &str = "materialx_m1 compensated at 0.2: 0.04742, printed .046";

fn own(grid: &Grid, name: &str, printed: [&str; 4]) -> Vec<String> {
    let factor = |specular: Specular, f0: f32| {
        let full = format!("coupling_{}_{name}", specular.name());
        let own = OWN_SPECULAR.iter().find(|own| own.entry.name() == full).expect("in the catalogue");
        assert_eq!(own.specular, specular);
        evaluate(&own.entry, grid, f0, alpha)
    };
    let blend =
        PUBLISHED_BLENDS.into_iter().find(|b| b.name() == format!("ggx_blend_{name}")).expect("a blend");
    let albedo = Some(evaluate(&blend, grid, 1.0, alpha));
    Row { grid, factor: &factor, albedo }.differences(name, printed)
}

#[test]
fn one_less_a_fitted_lobe() {
    assert_eq!(OWN_SPECULAR.len(), 3 * OWN.len());
    let differences: Vec<String> =
        OWN.iter().flat_map(|(name, printed)| own(&GRID, name, *printed)).collect();
    assert_eq!(differences, [EXCEPTION]);
    let (name, printed) = OWN[1];
    let (figure, _) = EXCEPTION.split_once(':').expect("a figure");
    let coarse = own(&Grid::of(Smith::Correlated, 60), name, printed);
    assert!(coarse.iter().all(|difference| !difference.starts_with(figure)), "{}", coarse.join("\n"));
}

/// B/E of the page's re-fits of the normalised factor.
const REFITS: [(&str, &str, [&str; 4]); 4] = [
    ("7 ops", "B5", [".072/.070/.066/.14/.35/.69", ".071/.11/.17", ".102/.085/.053", ".115 .032 .016"]),
    ("8 ops", "k6", [".085/.084/.081/.14/.35/.69", ".084/.11/.17", ".077/.064/.040", ".115 .032 .016"]),
    ("15 ops", "k13", [".094/.094/.095/.14/.35/.69", ".090/.11/.17", ".019/.016/.010", ".115 .032 .005"]),
    ("18 ops", "k16", [".094/.094/.095/.14/.35/.69", ".090/.11/.17", ".012/.010/.006", ".116 .034 .004"]),
];

fn share(name: &str) -> Vec<f64> {
    let (_, form, ..) = BIASES.iter().find(|(id, ..)| *id == name).expect("a form");
    GRID.map(|r, mu| form(r, r * r, mu))
}

fn albedo(name: &str) -> Vec<f64> {
    let (_, form, _) = NORMALISATIONS.iter().find(|(id, ..)| *id == name).expect("a form");
    GRID.map(|r, mu| 1.0 / form(r, r * r, mu))
}

#[test]
fn the_pages_own_fits() {
    let mut out = Vec::new();
    for (id, name, printed) in REFITS {
        let share = share(name);
        let factor = |_, f0: f32| share.iter().map(|b| (1.0 - f64::from(f0)) * (1.0 - b)).collect();
        out.extend(Row { grid: &GRID, factor: &factor, albedo: None }.differences(id, printed));
    }
    for (id, e, b, printed) in [
        (
            "pair C",
            "q13",
            "k13",
            [".021/.021/.021/.020/.019/.019", ".021/.020/.019", ".022/.021/.020", ".006 .007 .007"],
        ),
        (
            "pair D",
            "q20",
            "k16",
            [".016/.016/.015/.014/.011/.010", ".016/.014/.012", ".017/.015/.012", ".004 .004 .004"],
        ),
    ] {
        let (e, b) = (albedo(e), share(b));
        let factor = |specular: Specular, f0: f32| {
            let f0 = f64::from(f0);
            let pairs = e.iter().zip(&b);
            pairs.map(|(e, b)| 1.0 - e * (b + f0 * (1.0 - b)) * multiplier(specular, f0, *e)).collect()
        };
        out.extend(Row { grid: &GRID, factor: &factor, albedo: Some(e.clone()) }.differences(id, printed));
    }
    none_differ(&out);
}

/// Formulas that depend on the light stand in the catalogue as their mean over the lights of a
/// white environment.
#[test]
fn formulas_of_the_light_are_their_means() {
    let rule = Gauss::new(96);
    let mean = |mu: f64, f: &dyn Fn(f64, f64) -> f64| {
        let mut sum = 0.0;
        for (x, w) in rule.nodes.iter().zip(&rule.weights) {
            let (l, azimuths) = (0.5 * (1.0 + x), 256);
            let sines = ((1.0 - l * l) * (1.0 - mu * mu)).sqrt();
            for k in 0..azimuths {
                let phi = std::f64::consts::PI * (f64::from(k) + 0.5) / f64::from(azimuths);
                let vh = (0.5 * (1.0 + l * mu + sines * ops::cos(phi))).max(0.0).sqrt();
                sum += w * l * f(l, vh) / f64::from(azimuths);
            }
        }
        sum
    };
    let five = |x: f64| x * x * x * x * x;
    for mu in [0.01_f32, 0.2, 0.5, 0.83, 1.0] {
        let m = f64::from(mu);
        for (f0, a) in [(0.04_f32, 0.3_f32), (0.4, 0.9)] {
            let f = f64::from(f0);
            let at = |name: &str| {
                let hypothesis =
                    lobefit_shade::Hypothesis::parse(pure(name).file, pure(name).source).expect("parses");
                let column = |input: &String| {
                    vec![[mu, f0, a][["mu", "f0", "alpha"].iter().position(|n| n == input).expect("known")]]
                };
                let inputs: Vec<Vec<f32>> = hypothesis.inputs().iter().map(column).collect();
                f64::from(hypothesis.tape().evaluate(&inputs, &[]).expect("finite")[0])
            };
            let gltf = mean(m, &|_, vh| (1.0 - f) * (1.0 - five(1.0 - vh)));
            assert!((at("gltf") - gltf).abs() < 1e-5, "{mu} {f0}: {} {gltf}", at("gltf"));
            let side = |c: f64| 1.0 - five(1.0 - 0.5 * c);
            let both = mean(m, &|l, _| 28.0 / 23.0 * (1.0 - f) * side(l) * side(m));
            assert!((at("ashikhmin_shirley") - both).abs() < 1e-6, "{mu} {f0}: {both}");
            let y = f64::from(a);
            let weight = 1.0 - five(1.0 - y);
            let facing =
                |c: f64| (f + (1.0 - f) * five(1.0 - c)) * (1.0 - weight) + (0.04762 + 0.95238 * f) * weight;
            let average = f - (0.33263 * y + 0.072359) * (1.0 - f) * f;
            let coupled = mean(m, &|l, _| (1.0 - facing(l)) * (1.0 - facing(m)) / (1.0 - average));
            assert!((at("dassault") - coupled).abs() < 1e-5, "{mu} {f0}: {coupled}");
            let product = mean(m, &|l, _| 1.05 * (1.0 - f) * (1.0 - five(1.0 - l)) * (1.0 - five(1.0 - m)));
            assert!((at("fresnel") - product).abs() < 1e-6, "{mu} {f0}: {product}");
        }
    }
}
