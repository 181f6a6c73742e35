//! Emitted functions of numbers as GPUs may run them: subnormal numbers flushed, sums of products fused,
//! quotients and square roots off by 2.5 ulp; and outside of the domains that they state.

use std::cell::Cell;
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

use crate::emit_support::{
    self,
    example::{baked, text},
};
use lobefit::approximate::Fit;
use lobefit::bake::Baked;
use lobefit::data::{Half, Smith, Source, Use};
use lobefit::effects::table::{Lookup, Point};
use lobefit_math::ops;
use lobefit_promises::promises;
use lobefit_shade::code::Language;
use lobefit_shade::{Kind, Precision, Real, Tape};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{GGX_REFLECTION, Variant};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

thread_local! {
    /// How far quotients and roots lie from the nearest number, in ulp.
    static OFF: Cell<i32> = const { Cell::new(0) };
    /// Whether min and max of a NaN and a number are the number, as IEEE 754's minNum and maxNum have it.
    static DROPS: Cell<bool> = const { Cell::new(false) };
}

/// f32 that flushes subnormal numbers, and whose quotients and roots are [`OFF`].
#[derive(Clone, Copy, PartialEq, Debug)]
struct Loose(f32);

/// min and max are a choice by `<` and by `>`: the first operand unless the second lies beyond it.
impl PartialOrd for Loose {
    fn partial_cmp(&self, other: &Loose) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
    fn lt(&self, other: &Loose) -> bool {
        self.0 < other.0 || (DROPS.get() && other.0.is_nan())
    }
    fn gt(&self, other: &Loose) -> bool {
        self.0 > other.0 || (DROPS.get() && other.0.is_nan())
    }
}

fn flushed(x: f32) -> Loose {
    Loose(if x.is_subnormal() { 0.0 * x } else { x })
}

/// A quotient or a root as a GPU may give it; exact where it is a power of two or no finite number.
fn off(x: f32) -> Loose {
    let is_exact = x == 0.0 || !x.is_finite() || x.to_bits() << 9 == 0;
    let moved = OFF.get();
    flushed(if is_exact { x } else { f32::from_bits(x.to_bits().wrapping_add_signed(moved)) })
}

macro_rules! arithmetic {
    ($($operator:ident $call:ident $round:ident),*) => { $(
        impl $operator for Loose {
            type Output = Loose;
            fn $call(self, other: Loose) -> Loose {
                $round($operator::$call(flushed(self.0).0, flushed(other.0).0))
            }
        }
    )* };
}
arithmetic!(Add add flushed, Sub sub flushed, Mul mul flushed, Div div off);

impl Neg for Loose {
    type Output = Loose;
    fn neg(self) -> Loose {
        Loose(-self.0)
    }
}

impl Real for Loose {
    const ZERO: Loose = Loose(0.0);
    const ONE: Loose = Loose(1.0);
    const NAN: Loose = Loose(f32::NAN);
    fn literal(x: f32) -> Loose {
        Loose(x)
    }
    fn fma(self, y: Loose, z: Loose) -> Loose {
        flushed(self.0.fma(y.0, z.0))
    }
    fn magnitude(self) -> Loose {
        Loose(self.0.magnitude())
    }
    fn whole(self) -> Loose {
        Loose(self.0.whole())
    }
    fn root(self) -> Loose {
        off(self.0.root())
    }
    fn e_power(self) -> Loose {
        flushed(self.0.e_power())
    }
    fn two_power(self) -> Loose {
        flushed(self.0.two_power())
    }
    fn natural_log(self) -> Loose {
        Loose(self.0.natural_log())
    }
    fn binary_log(self) -> Loose {
        Loose(self.0.binary_log())
    }
    fn sine(self) -> Loose {
        Loose(self.0.sine())
    }
    fn cosine(self) -> Loose {
        Loose(self.0.cosine())
    }
    fn power(self, y: Loose) -> Loose {
        flushed(self.0.power(y.0))
    }
}

/// A metal below a sheen, by every formula.
static CLOTH: LazyLock<Baked> = LazyLock::new(|| {
    baked(
        r#"{"schema_version": 1, "name": "cloth", "reports": false, "pick": "all", "materials": [
        {"name": "cloth", "kind": "metal", "f0": 0.9, "roughness": [0.3, 1],
         "sheen": {"roughness": [0.07, 1]}, "wants": {"fit": {"max_ops": 1}}}]}"#,
    )
});

/// The include files whose functions are tried.
fn files() -> [&'static Baked; 7] {
    let of_values: [&Baked; 4] =
        [&crate::dielectric::COATS, &crate::clearcoat::LACQUER, &crate::width::PANES, &crate::eon::CLAY];
    let [coats, lacquer, panes, clay] = of_values;
    [&emit_support::baked().0, &crate::furnace_coupling::BAKED, coats, lacquer, panes, clay, &CLOTH]
}

/// A channel of a function of numbers.
struct Channel {
    /// The function's name, and that of the channel behind a dot where it has several.
    name: String,
    /// Whether it may be below 0: of a direction or normal, or of a texel, which a sampler clamps.
    is_signed: bool,
    tape: Tape,
}

/// The functions of numbers that a file holds, by name, each by all of its channels.
fn functions() -> Vec<Channel> {
    let (mut found, mut seen) = (Vec::new(), BTreeSet::new());
    for baked in files() {
        let text = text(baked, Language::Wgsl);
        let functions = emit_support::functions(&text);
        for name in functions.keys() {
            let module = emit_support::module(name, &functions);
            let takes_numbers = !module.contains("texture_") && !module.contains("array<");
            if !takes_numbers || !seen.insert((*name).to_owned()) {
                continue;
            }
            let source = lobefit_shade::Source::parse("lobefit.wgsl", &module).expect("it parses");
            let channels = match source.function(name).expect("its name").result {
                Kind::Number => 1,
                Kind::Vector(size) => usize::from(size),
                ref other => panic!("{name}: {other:?}"),
            };
            for channel in 0..channels {
                let tape = source.tape(name, channel).expect("a function of numbers");
                let inputs = tape.inputs();
                let is_signed =
                    channel < 3 && inputs.iter().any(|input| input == "ray.x") || name.contains("_uv");
                assert!(point(&mut Pcg64::seed_from_u64(1), &tape, false).is_some(), "{name}: {inputs:?}");
                let suffix = if channels == 1 { String::new() } else { format!(".{}", AXES[channel]) };
                found.push(Channel { name: format!("{name}{suffix}"), is_signed, tape });
            }
        }
    }
    found
}

/// Names of channels.
const AXES: [&str; 4] = ["x", "y", "z", "w"];

/// Where an input lies: in the domains that functions state, and where a renderer may put it.
const RANGES: [(&str, [f32; 2], [f32; 2]); 24] = [
    ("roughness", [0.02, 1.0], [0.0, 1.0]),
    ("mu", [0.01, 1.0], [1e-4, 1.0]),
    ("n_dot_v", [0.01, 1.0], [1e-4, 1.0]),
    ("n_dot_l", [0.01, 1.0], [1e-4, 1.0]),
    ("mip", [0.0, 6.0], [0.0, 6.0]),
    ("f0", [0.0, 1.0], [0.0, 1.0]),
    ("ior", [1.1, 2.0], [1.0, 3.0]),
    ("mean_length", [0.7, 1.0], [0.5, 1.0]),
    ("light_radius", [0.0, 0.3], [0.0, 0.5]),
    ("coat_roughness", [0.01, 1.0], [0.0, 1.0]),
    ("rho", [1.0 / 16.0, 8.0], [1e-3, 1e3]),
    ("e", [0.3, 1.0], [0.1, 1.0]),
    ("e_v", [0.0, 1.0], [-0.1, 1.0]),
    ("e_l", [0.0, 1.0], [-0.1, 1.0]),
    ("escape", [0.3, 1.0], [0.1, 1.0]),
    ("average", [0.1, 1.0], [0.1, 1.0]),
    ("texel", [0.0, 1.0], [0.0, 1.0]),
    ("albedo", [0.0, 1.0], [0.0, 1.0]),
    ("sheen_color", [0.0, 1.0], [0.0, 1.0]),
    ("lobe", [0.0, 1.0], [0.0, 1.0]),
    ("f", [0.0, 1.0], [0.0, 1.0]),
    ("f_ss", [0.0, 1.0], [0.0, 1.0]),
    ("anisotropy", [0.0, 1.0], [0.0, 1.0]),
    ("cos2_phi", [0.0, 1.0], [0.0, 1.0]),
];

/// Points of each function.
const POINTS: usize = 4_000;

/// A box about 0, a place and a probe in it and a ray, by coordinates: from the wall to the middle, and
/// beyond the wall. One ray of eight is along an axis.
fn room(random: &mut Pcg64, beyond: bool) -> Vec<(&'static str, [f32; 3])> {
    let mut each = |low: f32, high: f32| AXES3.map(|_| low + (high - low) * random.random::<f32>());
    let (low, high) = (each(-3.0, -1.0), each(1.0, 3.0));
    let reach = if beyond { 9.0 } else { 0.999 };
    let (place, probe, ray) = (each(-reach, reach), each(-0.9, 0.9), each(-1.0, 1.0));
    let length = ray.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-3);
    let along = random.random_range(0..24);
    let ray = AXES3.map(|k| if along < 3 { f32::from(u8::from(k == along)) } else { ray[k] / length });
    vec![("low", low), ("high", high), ("place", place), ("probe", probe), ("ray", ray)]
}

const AXES3: [usize; 3] = [0, 1, 2];

/// A point of a function, on an end of an input's range or between; `None` of a function with another
/// input.
fn point(random: &mut Pcg64, tape: &Tape, beyond: bool) -> Option<Vec<f32>> {
    let mut drawn: Vec<(&str, f32)> = Vec::new();
    for (name, inside, outside) in &RANGES {
        let [low, high] = if beyond { outside } else { inside };
        let between = low + (high - low) * random.random::<f32>();
        let near = low + (high - low) * ops::powf(10.0, -6.0 * random.random::<f32>());
        drawn.push((name, [*low, *high, between, between, near, near][random.random_range(0..6)]));
    }
    let of = |name: &str| drawn.iter().find(|(other, _)| *other == name).map(|(_, x)| *x);
    let part: f32 = random.random();
    let room = room(random, beyond);
    let value = |input: &String| match input.as_str() {
        "alpha" => of("roughness").map(|r| r * r),
        // What lookups round edges by.
        "bend" => of("roughness").map(|r| (1.2 * r * r).max(0.003)),
        // B is a part of E.
        "b" => of("e").map(|e| e * part),
        "l_dot_v" => {
            let (v, l) = (of("n_dot_v")?, of("n_dot_l")?);
            Some(v * l + ((1.0 - v * v) * (1.0 - l * l)).sqrt() * (2.0 * part - 1.0))
        }
        // The swing of the loss over the azimuth, which falls with the anisotropy and leaves E above 0.
        "texel.y" | "texel.z" | "texel.w" if tape.inputs().contains(&"anisotropy".to_owned()) => {
            Some((1.0 - of("texel")?) / 3.0 * of("anisotropy")? * part)
        }
        // A bias that leaves A above 0.
        "texel.y" if tape.inputs().contains(&"n_dot_v".to_owned()) => {
            let x = 1.0 - of("n_dot_v")?;
            Some((1.0 - x * x * (x * x) * x) * part)
        }
        name => {
            let (base, axis) = name.split_once('.').unwrap_or((name, ""));
            let place = room.iter().find(|(other, _)| *other == base);
            place.and_then(|(_, x)| Some(x[AXES.iter().position(|a| *a == axis)?])).or_else(|| of(base))
        }
    };
    tape.inputs().iter().map(value).collect()
}

/// A function's values as GPUs may compute them: as it is written and fused, and off either way.
fn loosely(written: &Tape, fused: &Tape, x: &[f32]) -> Vec<f32> {
    let x: Vec<Loose> = x.iter().map(|x| Loose(*x)).collect();
    let with = |moved: i32| {
        OFF.set(moved);
        [written, fused].map(|tape| tape.at(&x, &[]).0)
    };
    [0, -2, 2].into_iter().flat_map(with).collect()
}

/// How far a value moves on another machine, over 1 and its own size: a tenth of the fourth digit of the
/// most accurate formula's error.
const MOVES: f32 = 3e-6;

/// The same of a formula that errs more: a tenth of the fourth digit of its own error.
const OF_ERROR: f32 = 1e-3;

/// How far a level of a chain moves, which is a logarithm: a fiftieth of what 8 bits between levels show.
const LEVELS: f32 = 1.2e-5;

/// How far the normal of a proxy turns in an edge, times the width of that edge: edges move by 2.5 ulp of 1
/// over a distance.
const TURNS: f32 = 3e-7;

/// What a value may fall below 0 by where a renderer puts an input beyond the stated domain.
const DARK: f32 = 1e-6;

/// What a movement is multiplied by: that of a proxy's normal by the width of its edges, that of a level by
/// less.
fn edge(name: &str, tape: &Tape, x: &[f32]) -> f32 {
    let bend = tape.inputs().iter().zip(x).find(|(input, _)| *input == "bend");
    match name {
        name if name.starts_with("parallax_meet") && !name.ends_with(".w") => {
            bend.map_or(1.0, |(_, bend)| (bend * MOVES / TURNS).min(1.0))
        }
        name if name.starts_with("parallax_") && name.ends_with("_log_7.w") => MOVES / LEVELS,
        _ => 1.0,
    }
}

#[test]
fn functions_bear_what_hardware_does() {
    let mut moved = Vec::new();
    for Channel { name, tape, .. } in functions() {
        let (mut random, fused) = (Pcg64::seed_from_u64(3), tape.contracted());
        let mut worst = (0.0_f32, Vec::new());
        for _ in 0..POINTS {
            let x = point(&mut random, &tape, false).expect("known inputs");
            let written = tape.at(&x, &[]);
            for value in loosely(&tape, &fused, &x) {
                let off = (value - written).abs() / (1.0 + written.abs()) * edge(&name, &tape, &x);
                if off.is_nan() || off > worst.0 {
                    worst = (off, x.clone());
                }
            }
        }
        println!("{name}: {:e} {:?} {:?}", worst.0, tape.inputs(), worst.1);
        let fit = files().into_iter().flat_map(|of| &of.fits).find(|fit| fit.hypothesis.name() == name);
        let stated = fit.map_or(0.0, |fit| fit.approximation.certificate.max_abs as f32);
        let allowed = MOVES.max(OF_ERROR * stated);
        if worst.0.is_nan() || worst.0 > allowed {
            moved.push(format!("{name}: {:e} at {:?} {:?}", worst.0, tape.inputs(), worst.1));
        }
    }
    assert!(moved.is_empty(), "{moved:#?}");
}

#[test]
fn functions_return_what_a_renderer_survives() {
    let mut deadly = Vec::new();
    let mut excused: BTreeSet<&str> = promises().beyond.iter().map(|e| e.name.as_str()).collect();
    for Channel { name, is_signed, tape } in functions() {
        let (mut random, fused) = (Pcg64::seed_from_u64(5), tape.contracted());
        let mut worst = (0.0_f32, Vec::new());
        for _ in 0..POINTS {
            let x = point(&mut random, &tape, true).expect("known inputs");
            for value in loosely(&tape, &fused, &x).into_iter().chain([tape.at(&x, &[])]) {
                let below = if !value.is_finite() {
                    f32::INFINITY
                } else if is_signed {
                    0.0
                } else {
                    -value
                };
                if below > worst.0 {
                    worst = (below, x.clone());
                }
            }
        }
        if worst.0 > DARK && !(worst.0.is_finite() && excused.remove(name.as_str())) {
            deadly.push(format!("{name}: {:e} at {:?} {:?}", -worst.0, tape.inputs(), worst.1));
        }
    }
    assert!(deadly.is_empty(), "{deadly:#?}");
    assert!(excused.is_empty(), "docs/promises.json: these need no exception: {excused:?}");
}

/// What a compensation gains at cosines below its domain, beyond its error: `docs/promises.json`.
const GAINED: f64 = 0.08;

#[test]
fn below_its_cosines_a_compensation_gains_little() {
    let roughness = (0..=40).map(|i| 0.02 + 0.98 * f64::from(i) / 40.0);
    let cosines = || (0..=24).map(|i| ops::pow(10.0, -4.0 + 2.0 * f64::from(i) / 24.0));
    let places: Vec<[f64; 2]> = roughness.flat_map(|r| cosines().map(move |mu| [r, mu])).collect();
    let column = |of: fn(&[f64; 2]) -> f64| places.iter().map(|at| f64::from(of(at) as f32)).collect();
    let columns = [
        ("roughness", column(|at| at[0])),
        ("alpha", column(|at| at[0] * at[0])),
        ("mu", column(|at| at[1])),
    ];
    let points = Points::new(columns);
    let variant = Variant::from(Smith::Correlated);
    let truth = GGX_REFLECTION.truth(&variant, &points, &["E"], GGX_REFLECTION.tolerance(&variant));
    let [truth] = truth.expect("a truth").arrays();
    let is_own = |fit: &&Fit| {
        fit.approximation.used_as == Use::NORMALISATION && fit.approximation.source == Source::Fitted
    };
    let (mut gained, mut worst) = (Vec::new(), 0.0_f64);
    for fit in emit_support::baked().0.fits.iter().filter(is_own) {
        let values = fit.values_for(&points, 1.0).expect("finite values");
        let gain = values.iter().zip(&truth).map(|(n, e)| f64::from(*n) * e - 1.0).fold(f64::MIN, f64::max);
        let beyond = gain - fit.approximation.certificate.max_abs;
        worst = worst.max(beyond);
        gained.extend((beyond > GAINED).then(|| format!("{}: {gain}", fit.approximation.name)));
    }
    println!("at most {worst} beyond the error");
    assert!(worst > 0.5 * GAINED && gained.is_empty(), "{worst} {gained:#?}");
}

/// What the include files say of a NaN: it comes out as a NaN, or as a finite number where min and max
/// drop it, but for that of a ray. None makes a negative value.
#[test]
fn a_nan_gives_what_the_include_files_say() {
    let mut deadly = Vec::new();
    let (mut dropped, mut lost_values) = (0, 0);
    for Channel { name, is_signed, tape } in functions() {
        let (mut random, fused) = (Pcg64::seed_from_u64(7), tape.contracted());
        for trial in 0..POINTS / 16 {
            let mut x = point(&mut random, &tape, false).expect("known inputs");
            let lost = trial % x.len().max(1);
            x[lost] = f32::NAN;
            DROPS.set((trial / x.len().max(1)).is_multiple_of(2));
            let values = loosely(&tape, &fused, &x);
            DROPS.set(false);
            dropped += values.iter().filter(|value| value.is_finite()).count();
            lost_values += values.iter().filter(|value| value.is_nan()).count();
            let of_ray = tape.inputs().get(lost).is_some_and(|input| input.starts_with("ray."));
            let is_deadly = |value: &f32| match value.is_infinite() {
                true => !of_ray,
                false => *value < -DARK && !is_signed,
            };
            if values.iter().any(is_deadly) {
                deadly.push(format!("{name}: {values:?} at {:?} {x:?}", tape.inputs()));
                break;
            }
        }
    }
    println!("{dropped} values are finite, {lost_values} a NaN");
    assert!(dropped > 0 && lost_values > 0, "{dropped} {lost_values}");
    assert!(deadly.is_empty(), "{deadly:#?}");
}

#[test]
fn lookups_with_weights_of_8_bits_and_in_f16_keep_their_certificates() {
    let mut random = Pcg64::seed_from_u64(8);
    for baked in &emit_support::baked().0.tables {
        let (table, region) = (baked.table().expect("a table"), &baked.region);
        let exact = Lookup::new(table, baked.decode).expect("axes and channels of its decoding");
        let coarse = exact.clone().with_weight_bits(8);
        let Half::Measured(certified_half) = &baked.errors.half else { panic!("{:?}", baked.errors.half) };
        let precision = if certified_half.precision == "f16" { Precision::F16 } else { Precision::F16Fused };
        let half = exact.clone().with_precision(precision);
        let certified = baked.errors.lookup.max + baked.errors.lookup_8_bit.max;
        let slice = region.slices.map_or([0.0, 1.0], |slices| slices.range);
        let (mut worst, mut worst_half) = (0.0_f64, 0.0_f64);
        for _ in 0..POINTS * 10 {
            let mut within = |[low, high]: [f64; 2]| (low + (high - low) * random.random::<f64>()) as f32;
            let (roughness, mu, of_slice) = (within(region.roughness), within(region.mu), within(slice));
            let alpha = region.alpha_map.alpha(f64::from(roughness)) as f32;
            let cos2_phi = within([0.0, 1.0]);
            let point = Point { roughness, alpha, mu, anisotropy: of_slice, ior: of_slice, cos2_phi };
            let [fine, rounded, in_half] = [&exact, &coarse, &half].map(|lookup| lookup.at(&point));
            worst_half = worst_half.max(f64::from((in_half.e - fine.e).abs()));
            let b = rounded.b.unwrap_or(0.0);
            let (e, b) = (f64::from(rounded.e), f64::from(b));
            let most = baked.errors.lookup_8_bit.max;
            let holds = b >= -most && e >= b - most && e <= 1.0 + most;
            assert!(holds, "{} at {point:?}: {rounded:?}", table.name);
            for (fine, rounded) in [(fine.e, e), (fine.b.unwrap_or(0.0), b)] {
                worst = worst.max((f64::from(fine) - rounded).abs());
            }
        }
        println!("{}: {worst:e} of {certified:e}", table.name);
        assert!(worst > 0.0 && worst <= certified, "{}: {worst:e} of {certified:e}", table.name);
        let certified = certified_half.max_abs + baked.errors.lookup.max;
        println!("{} in f16: {worst_half:e} of {certified:e}", table.name);
        assert!(
            worst_half > 0.0 && worst_half <= certified,
            "{}: {worst_half:e} of {certified:e}",
            table.name
        );
    }
}
