//! Findings that look like those of a bake, from a smooth stand-in for E: the report takes any
//! plain data.

use std::collections::BTreeMap;

use lobefit::data::{
    AlphaMap, Axis, Certificate, Cost, Registration, Smith, Surface, TexelFormat, Use, Warp,
};
use lobefit::report::*;
use lobefit_math::ops;

/// A stand-in with the shape of GGX's E: the closed form mu ln(1 + 1/mu) of the loss at alpha = 1,
/// and for small alpha a valley of depth 0.11 at mu = 1.11 alpha.
pub fn albedo(roughness: f64, mu: f64) -> f64 {
    let alpha = roughness * roughness;
    let rough = mu * ops::log(1.0 + 1.0 / mu);
    let x = ops::log(mu / (1.11 * alpha)) / 0.9;
    1.0 - alpha * rough - (1.0 - alpha) * 0.11 * ops::exp(-x * x)
}

/// Published fits: name, operations, largest furnace error, RMS, roughness and mu of the largest.
const PUBLISHED: [(&str, u32, f64, f64, f64, f64); 15] = [
    ("pesce-linear", 3, 0.144, 0.077, 0.67, 0.32),
    ("pesce-square", 1, 0.908, 0.129, 1.0, 0.01),
    ("karis-mobile", 19, 1.120, 0.215, 1.0, 0.01),
    ("lazarov", 6, 0.591, 0.161, 1.0, 1.0),
    ("narkowicz-2014", 10, 1.006, 0.139, 1.0, 0.01),
    ("narkowicz-poly", 19, 0.592, 0.075, 1.0, 0.01),
    ("materialx-rational", 52, 0.097, 0.013, 0.09, 0.01),
    ("ray-tracing-gems", 43, 0.605, 0.078, 1.0, 0.01),
    ("pesce-iwanicki", 21, 0.379, 0.074, 1.0, 0.01),
    ("ross", 30, 0.693, 0.247, 1.0, 1.0),
    ("unreal-wip", 27, 0.068, 0.015, 0.13, 0.02),
    ("dassault", 15, 0.119, 0.049, 0.42, 0.19),
    ("tauray", 24, 0.104, 0.013, 0.36, 0.01),
    ("urp", 9, 0.908, 0.129, 1.0, 0.01),
    ("schlick-roughness", 0, 0.693, 0.247, 1.0, 1.0),
];

/// Our fits: name, formula, operations, norm, size of the error.
const FITS: [(&str, &str, u32, &str, f64); 9] = [
    ("n_linear_max", "N = 1 + 1.8943 alpha^2 mu", 3, "max", 0.128),
    ("n_linear_rms", "N = 1 + 2.1071 alpha^2 mu", 3, "rms", 0.16),
    ("n_sqrt", "N = 1 + c alpha sqrt(mu)", 7, "max", 0.081),
    ("n_rational_9", "N = (1 + a alpha mu) / (1 + b alpha)", 9, "max", 0.048),
    ("n_rational_13", "x = mu / (mu + alpha)\nN = 1 + alpha (p x + q x^2)", 13, "max", 0.0204),
    ("n_rational_13_rms", "x = mu / (mu + alpha)\nN = 1 + alpha (p x + q x^2)", 13, "rms", 0.031),
    ("n_rational_17", "x = mu / (mu + alpha)\nN = 1 + alpha (p x + q x^2 + r x alpha)", 17, "max", 0.0148),
    (
        "n_rational_20",
        "x = mu / (mu + alpha)\nN = 1 + alpha (p x + q x^2 + r x alpha + s x^3)",
        20,
        "max",
        0.0102,
    ),
    ("n_rational_31", "N = P(x, alpha) / Q(x, alpha)", 31, "max", 0.0031),
];

fn domain() -> BTreeMap<String, [f64; 2]> {
    BTreeMap::from([("mu".into(), [0.01, 1.0]), ("roughness".into(), [0.02, 1.0])])
}

fn at(roughness: f64, mu: f64) -> BTreeMap<String, f64> {
    BTreeMap::from([("mu".into(), mu), ("roughness".into(), roughness)])
}

/// A smooth error of the given size that changes sign over the domain.
fn ripple(size: f64, roughness: f64, mu: f64) -> f64 {
    size * ops::sin(7.0 * roughness + 2.0 * mu) * ops::cos(5.0 * mu * (1.0 + roughness)) * roughness.sqrt()
}

fn certificate(max_abs: f64, rms: f64, place: (f64, f64)) -> Certificate {
    Certificate {
        max_abs,
        max_rel: max_abs,
        rms,
        mean: -rms / 7.0,
        at: at(place.0, place.1),
        domain: domain(),
        precision: "f32".into(),
        points: 1 << 20,
    }
}

fn approximation(name: &str, ops: u32, certificate: Certificate) -> ApproximationFinding {
    ApproximationFinding {
        name: name.into(),
        quantity: "ggx-reflection".into(),
        column: "E".into(),
        used_as: Use::NORMALISATION,
        smith: Some(Smith::Correlated),
        source: "fitted".into(),
        published: false,
        table: false,
        norm: "max".into(),
        coefficients: vec![("p".into(), 0.1), ("q".into(), -1.594_326_6)],
        certificate,
        cost: Cost { ops, fetches: 0, bytes: 0 },
    }
}

fn grid() -> (Ruler, Ruler) {
    (Ruler::even("roughness", 0.02, 1.0, 96), Ruler::even("mu", 0.01, 1.0, 96))
}

fn fit((name, formula, _, _, size): (&str, &str, u32, &str, f64)) -> FitFinding {
    let curve = |roughness: f64| {
        let mu = Ruler::even("mu", 0.01, 1.0, 100).values;
        let truth: Vec<f64> = mu.iter().map(|&m| 1.0 / albedo(roughness, m)).collect();
        let off = mu.iter().zip(&truth).map(|(&m, t)| t * (1.0 + ripple(size, roughness, m)));
        FitCurve { roughness, fit: off.collect(), mu, truth }
    };
    let (x, y) = grid();
    FitFinding {
        name: name.into(),
        shown_as: "one of the synthetic fits".into(),
        formula: formula.into(),
        value: "N = 1/E".into(),
        curves: [0.1, 0.3, 0.5, 0.8, 1.0].map(curve).to_vec(),
        error: Field::sample("E N − 1", true, x, y, |r, m| ripple(size, r, m)),
    }
}

fn table(name: &str, size: usize) -> TableFinding {
    let axis = |name: &str, warp| Axis {
        name: name.into(),
        size,
        registration: Registration::Centre,
        warp,
        min: 0.0,
        max: 1.0,
    };
    let axes = [axis("mu", Warp::Homogeneous), axis("roughness", Warp::Linear)];
    let texels = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        (0..size * size)
            .map(|i| {
                let roughness = axes[1].node(i / size, Surface::<f64>::rough(0.0));
                f(roughness, axes[0].node(i % size, Surface::<f64>::rough(roughness * roughness)))
            })
            .collect()
    };
    let figure = |max: f64| ErrorFigure { max, rms: Some(max / 6.0), at: at(0.0731, 0.0123) };
    let channel = |name: &str, texels: Vec<f64>| ChannelFinding { name: name.into(), texels };
    let (x, y) = grid();
    TableFinding {
        name: name.into(),
        files: vec![format!("tables/{name}.exr")],
        quantity: "ggx-reflection".into(),
        smith: Some(Smith::Correlated),
        alpha_map: AlphaMap::RoughnessSquared,
        decode: "E = E, B = B".into(),
        note: String::new(),
        ops: 9,
        evaluations: 0,
        format: TexelFormat::F16,
        bytes: (size * size * 4) as u64,
        channels: vec![
            channel("E", texels(&albedo)),
            channel("B", texels(&|r, m| (1.0 - r) * ops::pow(1.0 - m, 5.0) * 0.8)),
        ],
        axes: axes.to_vec(),
        errors: vec![
            ("integration (bound)".into(), ErrorFigure { max: 1e-7, rms: None, at: Default::default() }),
            ("quantisation of E".into(), figure(2.44e-4)),
            ("lookup of E".into(), figure(5.91e-4)),
        ],
        lookup_error: vec![Field::sample("lookup error of E", true, x, y, |r, m| {
            5.9e-4 * ops::sin(90.0 * m) * ops::sin(80.0 * r) * ops::exp(-4.0 * m)
        })],
    }
}

fn furnace() -> Furnace {
    let roughness = vec![0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 1.0];
    let mu = Ruler::even("mu", 0.0, 1.0, 128).values;
    let row = |name: &str, f: &dyn Fn(f64, f64) -> f64| FurnaceRow {
        of: String::new(),
        name: name.into(),
        factors: roughness.iter().map(|&r| mu.iter().map(|&m| f(r, m.max(1e-3))).collect()).collect(),
    };
    let mut rows =
        vec![row("uncompensated", &albedo), row("ggx-dfg 32x32 f16", &|r, m| 1.0 + ripple(5e-4, r, m))];
    for (name, _, _, _, size) in FITS {
        rows.push(row(name, &|r, m| 1.0 + ripple(size, r, m)));
    }
    rows.push(row("exact", &|_, _| 1.0));
    Furnace { rows, roughness, mu, amplification: 10.0 }
}

/// A parabola, and one fit that misses it by a wave.
fn averages() -> AverageFinding {
    let roughness = Ruler::even("roughness", 0.02, 1.0, 33);
    let truth: Vec<f64> = roughness.values.iter().map(|r| 1.0 - 0.5 * r * r).collect();
    let off = |(r, t): (&f64, &f64)| t + 1e-4 * ops::sin(9.0 * r);
    let values = roughness.values.iter().zip(&truth).map(off).collect();
    AverageFinding {
        name: "E_avg".into(),
        fits: vec![AverageFit { name: "eavg_5".into(), values }],
        truth,
        roughness,
    }
}

/// What made the synthetic page.
pub fn origin() -> Origin {
    Origin {
        scene: "default".into(),
        recipe: "b3-5f1c9a0e77d2".into(),
        tool: "0.1.0".into(),
        command: "lobefit bake --out .".into(),
        pages: Vec::new(),
    }
}

/// A whole bake's worth of findings.
pub fn findings() -> Findings {
    let mut approximations: Vec<ApproximationFinding> = FITS
        .iter()
        .map(|&(name, _, ops, norm, size)| {
            let error = certificate(size, size * 0.4, (0.86, 0.34));
            ApproximationFinding { norm: norm.into(), ..approximation(name, ops, error) }
        })
        .collect();
    for (size, max) in [(32, 5.9e-4), (64, 1.4e-4)] {
        let cost = Cost { ops: 7, fetches: 1, bytes: size * size * 4 };
        let name = format!("ggx-dfg {size}x{size} f16");
        let base = approximation(&name, 7, certificate(max, max / 6.0, (0.073, 0.0123)));
        approximations.push(ApproximationFinding {
            table: true,
            norm: String::new(),
            coefficients: Vec::new(),
            cost,
            ..base
        });
    }
    for (name, ops, max, rms, roughness, mu) in PUBLISHED {
        let base = approximation(name, ops, certificate(max, rms, (roughness, mu)));
        approximations.push(ApproximationFinding {
            published: true,
            norm: "published".into(),
            source: "A. Author, \"A Fit\", course notes 2014".into(),
            ..base
        });
    }
    let average = approximation("eavg_5", 5, certificate(1e-4, 4e-5, (0.17, 1.0)));
    let quantity = "ggx-average".into();
    approximations.push(ApproximationFinding {
        quantity,
        column: "E_avg".into(),
        used_as: Use::VALUE,
        ..average
    });
    let (x, y) = grid();
    Findings {
        origin: origin(),
        effects: vec![EffectFinding {
            effect: "reflection".into(),
            because: vec![
                "material brushed-steel is a rough metal".into(),
                "material varnish has ior 1.5".into(),
            ],
            reasons: Vec::new(),
            ranges: domain(),
            approximation: "ggx-dfg 32x32 f16; n_rational_13".into(),
            expected_error: Some(0.021),
            limit: "error within 0.021".into(),
            measured_error: Some(0.02041),
            metric: "furnace error |E N − 1|".into(),
        }],
        left_out: vec![
            LeftOut { effect: "glass".into(), reason: "no material transmits".into() },
            LeftOut { effect: "sheen".into(), reason: "no material has a sheen colour".into() },
        ],
        tables: vec![table("ggx-dfg-correlated-32-f16", 32), table("ggx-dfg-correlated-64-f16", 64)],
        truths: vec![
            Field::sample("E", false, x.clone(), y.clone(), albedo),
            Field::sample("1/E", false, x, y, |r, m| 1.0 / albedo(r, m)),
        ],
        caption: "E has a valley along the diagonal.".into(),
        approximations,
        fits: FITS.map(fit).to_vec(),
        averages: Some(averages()),
        furnace: Some(furnace()),
        spheres: Vec::new(),
    }
}

/// A measurement's worth of timings.
#[allow(dead_code)] // not every test file that shares this one measures time
pub fn timings() -> Timings {
    let findings = findings();
    let timed = |a: &ApproximationFinding| TimedApproximation {
        name: a.name.clone(),
        quantity: a.quantity.clone(),
        column: a.column.clone(),
        used_as: a.used_as,
        nanoseconds: 0.4 + 0.13 * f64::from(a.cost.ops) + 3.0 * f64::from(a.cost.fetches),
        ops: a.cost.ops,
        max_error: a.certificate.max_abs,
        published: a.published,
        table: a.table,
    };
    Timings {
        origin: Origin { command: "lobefit cost".into(), ..findings.origin.clone() },
        device: "an imaginary processor, 2 cores".into(),
        tables: Some(timed_tables()),
        effects: Some(TimedEffects {
            alone: [("reflection", 6.1), ("glass", 2.4)]
                .map(|(effect, seconds)| TimedEffect { effect: effect.into(), seconds })
                .to_vec(),
            all: 8.0,
        }),
        evaluations: findings.approximations.iter().map(timed).collect(),
        lookups: vec![TimedLookup {
            lookup: "a box with smooth edges, 1 fetch".into(),
            fetches: 1,
            nanoseconds: 151.5,
        }],
    }
}

/// Three tables that take a second at 1e-6.
fn timed_tables() -> TimedTables {
    let run = |tolerance: f64, smith| TimedTableRun {
        instructions: "best",
        tolerance,
        smith,
        reflection_seconds: 0.1 / tolerance.sqrt().sqrt() / 10.0,
        glass_seconds: 0.3 / tolerance.sqrt().sqrt() / 10.0,
        evaluations: (1e7 / tolerance.sqrt().sqrt()) as u64,
        worst: 0.4 * tolerance,
        checked: 2_000,
    };
    TimedTables {
        threads: 2,
        texels: 131_072 + 2 * 524_288,
        runs: [1e-4, 1e-5, 1e-6, 1e-7]
            .into_iter()
            .flat_map(|t| [run(t, Smith::Separable), run(t, Smith::Correlated)])
            .collect(),
        estimator: TimedEstimator {
            samples_per_second: [2.4e7, 1.9e7],
            deviation: [0.31, 0.29],
            samples_per_texel: 1e7,
            seconds: 6.1e5,
        },
    }
}
