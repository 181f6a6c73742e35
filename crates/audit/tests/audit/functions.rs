//! Published fits as shader functions: what their arguments mean, which lobe they were fitted to,
//! and how far off they are, from values alone. The figures are of shared tables of published fits
//! on another grid, so they agree to a few per cent.

use lobefit::data::Smith;
use lobefit_audit::audit::{
    Audit, AuditError, Column, Fit, Fixed, Form, Scale, Source, audit, sampled, sampled_inverse,
};
use lobefit_audit::foreign::{ForeignError, ShaderFunction, Surroundings};
use lobefit_truth::quantity::{self, Quantity};

/// Knarkowicz 2014: of gloss 1 - alpha^(1/4), separable Smith. Karis 2014. Pesce 2019. Enterprise
/// PBR: of alpha.
const FITS: &str = "
fn knarkowicz(g: f32, nov: f32) -> vec2<f32> {
  let b = saturate(min(-.1688 * g + 1.895 * g * g, .9903 - 4.853 * nov + 8.404 * nov * nov - 5.069 * nov * nov * nov));
  let e = saturate(.6045 + 1.699 * g - .5228 * nov - 3.603 * g * g + 1.404 * g * nov + .1939 * nov * nov + 2.661 * g * g * g);
  return vec2<f32>(b, e);
}
fn karis(f0: vec3<f32>, roughness: f32, nov: f32) -> vec3<f32> {
  let t = min((1.0 - roughness) * (1.0 - roughness), exp2(-9.28 * nov)) * (1.0 - roughness) + .0425 - .0275 * roughness;
  return f0 * (1.04 - .572 * roughness - 1.04 * t) + 1.04 * t + .022 * roughness - .04 - 0.0 * roughness;
}
fn pesce(a: f32, m: f32) -> f32 { return 1.0 + 2.0 * a * a * m; }
fn enterprise(y: f32, mu: f32) -> f32 {
  return 1.0 - 1.4594 * y * mu * (-.20277 + y * (2.772 + y * (-2.6175 + .73343 * y)))
    * (3.09507 + mu * (-9.11369 + mu * (15.8884 + mu * (-13.70343 + 4.51786 * mu))));
}
fn crude(roughness: f32, mu: f32) -> f32 { return 1.0 - 0.6 * pow(roughness, 2.2) * pow(mu, 0.4); }
fn nothing(x: f32, y: f32) -> f32 { return sin(20.0 * x) * cos(13.0 * y); }
fn infinite(x: f32, y: f32) -> f32 { return log(-x) + y; }
fn three(x: f32, y: f32, k: f32) -> f32 { return x * y * k; }
";

/// The functions of a source of which nothing else is known.
fn read_functions(
    bytes: &[u8],
    file: &str,
    entry: Option<&str>,
) -> Result<Vec<ShaderFunction>, ForeignError> {
    lobefit_audit::foreign::read_functions(bytes, file, entry, &Surroundings::default())
}

fn of(name: &str) -> &'static dyn Quantity {
    quantity::find(name).unwrap()
}

/// The verdict as it is printed.
fn said(found: &Audit) -> String {
    found.verdict(None).to_string()
}

fn run(name: &str) -> Audit {
    let function = read_functions(FITS.as_bytes(), "fits.wgsl", Some(name)).unwrap().remove(0);
    let shipped = sampled(&function, of("ggx-reflection"), &[], &[]).unwrap();
    let found =
        audit(&shipped, quantity::find("ggx-reflection").unwrap(), &Fixed::default(), &|_| ()).unwrap();
    assert_eq!(found.source, Source::Function);
    eprintln!("{}", said(&found));
    found
}

fn scales(found: &Audit) -> Vec<(Scale, bool)> {
    found.best().axes.iter().map(|a| (a.scale, a.reversed)).collect()
}

fn near(value: f64, published: f64, share: f64) {
    assert!((value / published - 1.0).abs() < share, "{value}, published {published}");
}

#[test]
fn gloss_is_told_and_so_is_the_lobe_that_was_fitted() {
    let found = run("knarkowicz");
    assert_eq!(scales(&found), [(Scale::RoughnessFourth, true), (Scale::Mu, false)]);
    assert_eq!(found.best().lobe.form.smith, Some(Smith::Separable));
    assert_eq!(found.best().columns, [Some(Column::B), Some(Column::E)]);
    let e = found.channels[1].errors.as_ref().unwrap();
    // Against separable Smith E is off by .011 in the root mean square, and by .062 at most for
    // mu >= 0.01; here mu begins at 0.004.
    assert!((0.062..0.12).contains(&e.max), "{}", e.max);
    near(e.rms, 0.011, 0.1);
    assert!(said(&found).contains("gloss = 1 - alpha^(1/4)"), "{}", said(&found));
}

#[test]
fn a_blend_over_f0_is_taken_apart() {
    let found = run("karis");
    assert_eq!(found.best().columns, [Some(Column::B), Some(Column::E)]);
    assert_eq!(found.best().lobe.form.smith, Some(Smith::Correlated));
    // .504/.134 against the lobe of the use, for mu >= 0.01: here it begins at 0.004.
    let e = found.channels[1].errors.as_ref().unwrap();
    near(e.max, 0.504, 0.1);
    near(e.rms, 0.134, 0.1);
    assert!(said(&found).contains("B. Karis, Physically Based Shading on Mobile, 2014"), "{}", said(&found));
    // A sixth of the spread is no fit of anything, and that is said.
    assert_eq!(found.fit, Fit::None);
    assert!(
        said(&found).contains("no approximation of ggx-reflection: it is held against "),
        "{}",
        said(&found)
    );
    assert!(found.channels[0].name.contains("f0 = 0"), "{}", found.channels[0].name);
}

#[test]
fn a_normalisation_and_an_albedo_of_alpha_are_told() {
    // 1 + 2 a^2 mu is so far from 1/E either way that only its column is clear; that it is open is
    // told.
    let found = run("pesce");
    assert_eq!(found.best().columns, [Some(Column::Inverse)]);
    assert!(found.margin < 1.2 && said(&found).contains("Certainty: open"), "{}", said(&found));
    let alpha = |t: &lobefit_audit::audit::Tried| t.convention.axes[0].scale == Scale::Alpha;
    assert!(found.tried.iter().take(2).any(alpha), "{:?}", found.tried);
    assert!(!said(&found).contains("published formula"), "{}", said(&found));
    let found = run("enterprise");
    assert!(said(&found).contains("Dassault Systemes"), "{}", said(&found));
    assert_eq!(scales(&found), [(Scale::Alpha, false), (Scale::Mu, false)]);
    assert_eq!(found.best().columns, [Some(Column::E)]);
    let e = found.channels[0].errors.as_ref().unwrap();
    near(e.max, 0.117, 0.03);
    near(e.rms, 0.045, 0.06);
}

#[test]
fn a_function_saturates_where_a_table_lacks_a_format() {
    let text = include_str!("../../../../fits/lobefit.wgsl").to_string()
        + "\nfn saturated(a: f32, m: f32) -> f32 { return min(ggx_energy_compensation(a, m), 1.5); }";
    let function = read_functions(text.as_bytes(), "s.wgsl", Some("saturated")).unwrap().remove(0);
    let shipped = sampled(&function, of("ggx-reflection"), &[], &[]).unwrap();
    let found = audit(&shipped, of("ggx-reflection"), &Fixed::default(), &|_| ()).unwrap();
    assert!(said(&found).contains("the function saturates there"), "{}", said(&found));
    assert!(!said(&found).contains("in a format"), "{}", said(&found));
}

#[test]
fn an_index_of_refraction_runs_from_1_to_2() {
    let text = "fn glass(ior: f32, alpha: f32, cos_theta: f32) -> f32 {
      let r = (ior - 1.0) / (ior + 1.0);
      return select(-1.0, r * r + (1.0 - r * r) * pow(1.0 - cos_theta, 5.0), ior > 1.0) + 0.0 * alpha;
    }
    fn bare(m: f32, a: f32, x: f32) -> f32 { return 0.2 * (x - 1.0) + 0.5 * m * (1.0 - a); }";
    let read = |name: &str| read_functions(text.as_bytes(), "g.wgsl", Some(name)).unwrap().remove(0);
    let shipped = sampled(&read("glass"), of("ggx-glass"), &[], &[]).unwrap();
    assert!(shipped.channels[0].values.iter().all(|v| *v > 0.0), "an index of 1 or less was asked for");
    let fixed = Fixed { column: Some(Column::R), ..Fixed::default() };
    let found = audit(&shipped, quantity::find("ggx-glass").unwrap(), &fixed, &|_| ()).unwrap();
    assert_eq!(scales(&found)[0], (Scale::Ior, false));
    assert!(said(&found).contains("the argument ior given ior"), "{}", said(&found));
    // Words of a name tell, not letters within one; and only where the quantity has an index.
    let named = |name: &str, of: &dyn Quantity| {
        let text = text.replace("x: f32", &format!("{name}: f32")).replace("(x -", &format!("({name} -"));
        let function = read_functions(text.as_bytes(), "g.wgsl", Some("bare")).unwrap().remove(0);
        let set = if of.name() == "ggx-glass" { vec![] } else { vec![("a".to_string(), 1.0)] };
        let values = sampled(&function, of, &set, &[]).unwrap().channels.remove(0).values;
        values.iter().all(|v| *v > 0.0)
    };
    for (name, told) in [
        ("ior", true),
        ("specularIOR", true),
        ("iorInside", true),
        ("IORValue", true),
        ("relative_ior2", true),
        ("interior", false),
        ("prior", false),
        ("iord", false),
    ] {
        assert_eq!(named(name, of("ggx-glass")), told, "{name}");
        assert!(!named(name, of("ggx-reflection")), "{name}");
    }
    // The user says what a name does not.
    let told = sampled(&read("bare"), of("ggx-glass"), &[], &[Scale::Mu, Scale::Alpha, Scale::Ior]).unwrap();
    let [first, last] = [0, told.channels[0].values.len() - 400].map(|i| told.channels[0].values[i]);
    assert!((last - first - 0.2 * 0.95).abs() < 1e-6, "{first} {last}");
}

#[test]
fn an_index_may_be_given_the_other_way_round() {
    // Fresnel's reflectance of a smooth interface by eta = 1/ior; it has no value for a ray from
    // inside.
    let text = "fn fresnel(eta: f32, alpha: f32, mu: f32) -> f32 {
      let c = sqrt(max(0.0, 1.0 - eta * eta * (1.0 - mu * mu)));
      let s = (eta * mu - c) / (eta * mu + c);
      let p = (mu - eta * c) / (mu + eta * c);
      return select(-1.0 - eta * mu, 0.5 * (s * s + p * p), eta <= 1.0) + 0.0 * alpha;
    }";
    let function = read_functions(text.as_bytes(), "g.wgsl", Some("fresnel")).unwrap().remove(0);
    let glass = of("ggx-glass");
    let inverse = sampled_inverse(&function, glass, &[]).unwrap().expect("eta is an index");
    assert!(inverse.channels[0].values.iter().all(|v| *v >= 0.0), "eta is at most 1");
    let fixed = Fixed { column: Some(Column::R), ..Fixed::default() };
    let run =
        |shipped: &_, inverse| audit(shipped, glass, &Fixed { inverse, ..fixed.clone() }, &|_| ()).unwrap();
    let plain = run(&sampled(&function, glass, &[], &[]).unwrap(), false);
    let (own, other) = (run(&inverse, true), plain.tried[0].rank);
    assert_eq!(scales(&own)[0], (Scale::Eta, false));
    assert_eq!(own.best().lobe.side.map(|s| s.name()), Some("outside"));
    let best = plain.beside(own);
    assert!(scales(&best)[0] == (Scale::Eta, false) && best.tried[0].rank < 0.5 * other, "{}", said(&best));
    assert!(said(&best).contains("the argument eta given eta (eta = 1/ior)"), "{}", said(&best));
    assert!(best.tried.iter().any(|t| t.convention.axes[0].scale == Scale::Ior) || best.margin.is_finite());
    // A quantity without an index has no such argument.
    let function = read_functions(FITS.as_bytes(), "fits.wgsl", Some("pesce")).unwrap().remove(0);
    assert_eq!(sampled_inverse(&function, of("ggx-reflection"), &[]), Ok(None));
}

#[test]
fn roughness_with_its_alpha_and_directions_are_arguments() {
    let text = "
      fn both(roughness: f32, alpha: f32, mu: f32) -> f32 { return 1.0 - 0.4 * alpha * mu + 0.1 * (roughness * roughness - alpha); }
      fn view(n: vec3<f32>, v: vec3<f32>, alpha: f32) -> f32 {
        return 1.0 - 0.4 * alpha * dot(n, v) + 9.0 * (length(v) - 1.0) + v.y;
      }";
    let read = |name: &str| read_functions(text.as_bytes(), "g.wgsl", Some(name)).unwrap().remove(0);
    let both = sampled(&read("both"), of("ggx-reflection"), &[], &[]).unwrap();
    assert_eq!(both.axes, ["roughness (and alpha its square)", "mu"]);
    let at = |i: usize| (i as f64 + 0.5) / 128.0;
    let wanted = |r: usize, m: usize| 1.0 - 0.4 * at(r) * at(r) * at(m);
    assert!((both.channels[0].values[40 * 128 + 100] - wanted(100, 40)).abs() < 1e-6);
    let view = sampled(&read("view"), of("ggx-reflection"), &[], &[]).unwrap();
    assert_eq!(view.axes, ["dot(n, v)", "alpha"]);
    assert!((view.channels[0].values[40 * 128 + 100] - (1.0 - 0.4 * at(40) * at(100))).abs() < 1e-5);
}

#[test]
fn a_fit_that_this_tool_wrote_has_its_certificate() {
    let quantity = quantity::find("ggx-reflection").unwrap();
    for (language, text) in [
        ("lobefit.wgsl", include_str!("../../../../fits/lobefit.wgsl")),
        ("lobefit.glsl", include_str!("../../../../fits/lobefit.glsl")),
    ] {
        let function =
            read_functions(text.as_bytes(), language, Some("ggx_energy_compensation")).unwrap().remove(0);
        let found = audit(
            &sampled(&function, of("ggx-reflection"), &[], &[]).unwrap(),
            quantity,
            &Fixed::default(),
            &|_| (),
        )
        .unwrap();
        assert_eq!(found.best().columns, [Some(Column::Inverse)]);
        let manifest: serde_json::Value =
            serde_json::from_str(include_str!("../../../../manifest.json")).unwrap();
        let fits = manifest["fits"].as_array().unwrap();
        let own = fits.iter().find(|f| f["function"] == "ggx_energy_compensation").unwrap();
        let certified = own["certificate"]["max_abs"].as_f64().unwrap();
        let furnace = found.furnace.as_ref().unwrap().range;
        let worst = furnace[0].abs().max(furnace[1].abs());
        // The audit judges cosines down to 0.001, where the certificate begins at 0.01.
        assert!((0.98..2.0).contains(&(worst / certified)), "{worst}, certified {certified}");
    }
}

#[test]
fn what_is_no_fit_is_told() {
    let found = run("nothing");
    assert_eq!(found.fit, Fit::None);
    assert!(
        said(&found).contains("no approximation of ggx-reflection under any reading"),
        "{}",
        said(&found)
    );
    let read = |name: &str| read_functions(FITS.as_bytes(), "fits.wgsl", Some(name)).unwrap().remove(0);
    let quantity = quantity::find("ggx-reflection").unwrap();
    let bad = sampled(&read("infinite"), of("ggx-reflection"), &[], &[]).unwrap();
    let error = audit(&bad, quantity, &Fixed::default(), &|_| ()).unwrap_err();
    assert!(matches!(error, AuditError::Refused { .. }), "{error}");
    let left = sampled(&read("three"), of("ggx-reflection"), &[], &[]).unwrap_err();
    assert!(left.to_string().contains("--set"), "{left}");
    assert!(sampled(&read("three"), of("ggx-reflection"), &[("k".into(), 1.0)], &[]).is_ok());
    let absent = sampled(&read("three"), of("ggx-reflection"), &[("q".into(), 1.0)], &[]).unwrap_err();
    assert!(absent.to_string().contains("x, y, k"), "{absent}");
}

/// A crude split sum: nearer to E than to A, but for the names of its members.
const SPLIT: &str = "
struct Dfg { A: f32, B: f32 }
struct Named { scale: f32, bias: f32, bounces: u32, is_rough: bool }
struct Colour { r: f32, g: f32, b: f32 }
fn split(roughness: f32, mu: f32) -> Dfg {
  return Dfg(1.0 - 0.55 * roughness, 0.4 * pow(1.0 - mu, 5.0) * (1.0 - roughness));
}
fn named(roughness: f32, mu: f32) -> Named {
  let found = split(roughness, mu);
  return Named(found.A, found.B, 2u, roughness > 0.5);
}
fn colour(roughness: f32, mu: f32) -> Colour {
  let found = split(roughness, mu);
  return Colour(1.0, found.B, found.A);
}
fn whole(roughness: f32, mu: f32) -> Dfg {
  let y = roughness * roughness;
  let e = 1.0 - 1.4594 * y * mu * (-.20277 + y * (2.772 + y * (-2.6175 + .73343 * y)))
    * (3.09507 + mu * (-9.11369 + mu * (15.8884 + mu * (-13.70343 + 4.51786 * mu))));
  return Dfg(e, 0.4 * pow(1.0 - mu, 5.0) * (1.0 - roughness));
}
";

#[test]
fn names_of_results_tell_columns() {
    let columns = |name: &str| {
        let function = read_functions(SPLIT.as_bytes(), "split.wgsl", Some(name)).unwrap().remove(0);
        let shipped = sampled(&function, of("ggx-reflection"), &[], &[]).unwrap();
        let found = audit(&shipped, of("ggx-reflection"), &Fixed::default(), &|_| ()).unwrap();
        eprintln!("{}", said(&found));
        found.best().columns.clone()
    };
    let [a, b, e] = [Column::A, Column::B, Column::E].map(Some);
    assert_eq!(columns("split"), [a, b]);
    // Members that are no numbers of a formula are none of the result.
    assert_eq!(columns("named"), [a, b]);
    // The b of a colour is no B.
    assert_eq!(columns("colour"), [None, b, e]);
    // What is E beyond doubt is no A, whatever its name.
    assert_eq!(columns("whole"), [e, b]);
}

/// A crude formula that roughness and its square root fit nearly as well: the usual argument is taken, and no
/// verdict without a word on which is meant.
#[test]
fn two_readings_of_a_crude_function_are_left_open() {
    let found = run("crude");
    assert_eq!((found.fit, found.best().axes[0].scale), (Fit::Whole, Scale::Roughness));
    let text = said(&found);
    let why = "since another reading fits nearly as well, and its own not closely: --axes and --smith say";
    assert!(text.starts_with("UNKNOWN ggx-reflection E: ") && text.contains(why), "{text}");
    let function = read_functions(FITS.as_bytes(), "fits.wgsl", Some("crude")).unwrap().remove(0);
    let shipped = sampled(&function, of("ggx-reflection"), &[], &[]).unwrap();
    let axes = Some(vec![(Scale::Roughness, false), (Scale::Mu, false)]);
    let form = Form::find("correlated");
    let fixed = Fixed { axes, form, ..Fixed::default() };
    let meant = audit(&shipped, of("ggx-reflection"), &fixed, &|_| ()).unwrap();
    assert!(said(&meant).starts_with("PASS "), "{}", said(&meant));
    assert!(found.verdict(Some(0.2)).to_string().starts_with("PASS "), "a limit decides");
}
