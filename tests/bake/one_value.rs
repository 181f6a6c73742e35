//! Materials whose inputs have one value: functions of what varies, for a few operations.

use crate::baked_support::bake_scene;
use lobefit::approximate::Fit;
use lobefit::bake::Baked;
use lobefit::effects::table::{Lookup, Point};
use lobefit::scene::Scene;
use lobefit_shade::Source;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::optics::Smith;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{
    DiffuseCoupling, GGX_GLASS, GGX_REFLECTION, GgxAverage, GgxCoat, Quantity, RefractedWidth, Specular,
    Variant,
};

/// The scene of docs/scene.md.
const LAMP: &str = r#"{ "schema_version": 1, "name": "lamp", "materials": [
  { "name": "foot", "kind": "metal", "f0": 0.9, "roughness": 0.4, "wants": { "fit": { "average": true, "blend": true } } },
  { "name": "lacquer", "kind": "dielectric", "ior": 1.5, "roughness": 0.4, "base": { "albedo": 0.5 }, "wants": { "fit": {} },
    "coat": { "roughness": [0.05, 0.3], "ior": 1.5 } },
  { "name": "shade", "kind": "glass", "ior": 1.52, "roughness": 0.4, "wants": { "fit": {} } }
] }"#;

fn baked(text: &str) -> Baked {
    let text = text.replacen("\"name\"", r#""reports": false, "languages": ["wgsl"], "name""#, 1);
    bake_scene(&Scene::from_json(text.as_bytes(), "lamp.json").expect("a scene")).expect("a bake")
}

fn code(baked: &Baked) -> String {
    String::from_utf8(baked.files["fits/lobefit.wgsl"].clone()).expect("UTF-8")
}

/// A function of the include file at inputs by the names of its arguments.
fn value(source: &Source, name: &str, inputs: [(&str, f64); 4]) -> f64 {
    let tape = source.tape(name, 0).unwrap_or_else(|e| panic!("{name}: {e}"));
    let of = |name: &String| inputs.iter().find(|(input, _)| input == name).expect("an input").1 as f32;
    f64::from(tape.at(&tape.inputs().iter().map(of).collect::<Vec<f32>>(), &[]))
}

#[test]
fn functions_are_of_what_varies_and_keep_their_arguments() {
    let baked = baked(LAMP);
    let text = code(&baked);
    let page = include_str!("../../docs/scene.md");
    assert!(page.contains(LAMP), "docs/scene.md has another scene than this test");
    let mut lacking = Vec::new();
    for signature in [
        "ggx_energy_compensation(roughness: f32, n_dot_v: f32)",
        "ggx_average_albedo(roughness: f32)",
        "ggx_directional_albedo(roughness: f32, n_dot_v: f32, f0: f32)",
        "diffuse_coupling(roughness: f32, n_dot_v: f32, f0: f32)",
        "coat_escape(roughness: f32, ior: f32)",
        "ggx_glass_energy_compensation_outside(roughness: f32, n_dot_v: f32, ior: f32)",
        "ggx_glass_energy_compensation_inside(roughness: f32, n_dot_v: f32, ior: f32)",
    ] {
        assert!(text.contains(&format!("fn {signature} -> f32 {{")), "{signature} is not in\n{text}");
        let name = &signature[..signature.find('(').expect("arguments")];
        let fit = baked.fits.iter().find(|fit| fit.emitted && fit.hypothesis.name() == name);
        let a = &fit.unwrap_or_else(|| panic!("no fit {name}")).approximation;
        assert!(
            ["cosine_", "roughness_1", "constant_"].iter().any(|of| a.name.starts_with(of)),
            "{name}: {}",
            a.name
        );
        let row = format!("| `{name}` | `{}` | {} | {} |", a.name, a.cost.ops, a.certificate.max_abs);
        if !page.contains(&row) {
            lacking.push(row);
        }
    }
    assert!(lacking.is_empty(), "docs/scene.md has no row\n{}", lacking.join("\n"));
}

/// A function of the include file, and what it stands for at roughness 0.4.
struct Case<'a> {
    name: &'a str,
    quantity: &'a dyn Quantity,
    variant: Variant,
    column: &'a str,
}

impl Case<'_> {
    /// The fit, whose stated error is nearly reached and not exceeded at points of mu and ior.
    fn holds<'b>(&self, baked: &'b Baked, source: &Source, [mu, ior]: [&[f64]; 2]) -> &'b Fit {
        let Case { name, quantity, variant, column } = self;
        let all = |x: f64| vec![f64::from(x as f32); mu.len()];
        let alpha = f64::from(0.4_f32 * 0.4_f32);
        let columns = [("alpha", all(alpha)), ("mu", mu.into()), ("f0", all(0.04)), ("ior", ior.into())];
        let known = |input: &str| quantity.inputs().iter().any(|own| own.name == input);
        let points = Points::new(columns.into_iter().filter(|(input, _)| known(input)));
        let truth =
            quantity.truth(variant, &points, &[*column], quantity.tolerance(variant)).expect("a truth");
        let [truth] = truth.arrays();
        let fit = baked.fits.iter().find(|fit| fit.hypothesis.name() == *name).expect(name);
        let (residual, stated) = (fit.approximation.used_as.residual, fit.approximation.certificate.max_abs);
        let error = |i: usize| {
            let inputs = [("roughness", 0.4), ("n_dot_v", mu[i]), ("f0", 0.04), ("ior", ior[i])];
            residual.of(value(source, name, inputs), truth[i]).abs()
        };
        let worst = (0..mu.len()).map(error).fold(0.0, f64::max);
        assert!(worst <= stated * (1.0 + 1e-3) + 1e-7, "{name}: {worst}, stated {stated}");
        assert!(worst >= 0.9 * stated || stated < 1e-6, "{name}: {stated} is stated, {worst} found");
        fit
    }
}

/// At cosines of their own: the certificate is of other points.
#[test]
fn each_is_within_its_error_of_the_truth() {
    let baked = baked(LAMP);
    let source = Source::parse("lobefit.wgsl", &code(&baked)).expect("WGSL");
    let mu: Vec<f64> =
        (0..400).map(|i| f64::from((0.01 + 0.99 * (f64::from(i) + 0.37) / 400.0) as f32)).collect();
    let all = |x: f64| vec![f64::from(x as f32); mu.len()];
    let correlated = || Variant::from(Smith::Correlated);
    let glass = |side| Variant { side: Some(side), ..correlated() };
    let coupled = Variant { specular: Some(Specular::Normalised), ..correlated() };
    let cases: [(&str, &dyn Quantity, Variant, &str, f64); 5] = [
        ("ggx_energy_compensation", GGX_REFLECTION, correlated(), "E", 1.0),
        ("ggx_average_albedo", &GgxAverage, correlated(), "E_avg", 1.0),
        ("diffuse_coupling", &DiffuseCoupling, coupled, "factor", 1.0),
        ("ggx_glass_energy_compensation_outside", GGX_GLASS, glass(Side::Outside), "E", 1.52),
        ("ggx_glass_energy_compensation_inside", GGX_GLASS, glass(Side::Inside), "E", 1.52),
    ];
    for (name, quantity, variant, column, ior) in cases {
        Case { name, quantity, variant, column }.holds(&baked, &source, [&mu, &all(ior)]);
    }
}

/// Below the domain they have no pole: finite and not negative down to grazing.
#[test]
fn none_has_a_pole_at_grazing() {
    let every = LAMP.replacen("\"name\"", r#""pick": "all", "name""#, 1);
    let baked = baked(&every);
    let mu: Vec<f64> = (0..=1000).map(|i| f64::from((f64::from(i) * 1e-5) as f32)).collect();
    let all = |x: f64| vec![f64::from(x as f32); mu.len()];
    let columns = [("roughness", all(0.4)), ("alpha", all(0.16)), ("mu", mu.clone()), ("ior", all(1.52))];
    let points = Points::new(columns);
    let mut looked_at = 0;
    for fit in baked.fits.iter().filter(|fit| fit.emitted && fit.approximation.name.starts_with("cosine")) {
        let values = fit.values_for(&points, 0.04).expect("finite values");
        for (value, mu) in values.iter().zip(&mu) {
            assert!((0.0..3.0).contains(value), "{}: {value} at n_dot_v {mu}", fit.hypothesis.name());
            looked_at += 1;
        }
    }
    assert!(looked_at > 20_000, "{looked_at}");
}

/// One roughness beside a range of the index, however narrow but not over all: formulas of these two alone.
/// Within their errors of the truth, at cosines and indices of their own.
#[test]
fn one_roughness_stays_one_beside_a_range_of_the_index() {
    let of = |[low, high]: [f64; 2]| {
        let lacquer = |name: &str, ior: f64| {
            format!(
                r#"{{"name": "{name}", "kind": "dielectric", "ior": {ior}, "roughness": 0.4,
                 "wants": {{"exact_fresnel": {{}}}}, "coat": {{"roughness": 0.4, "ior": {ior}}}}}"#
            )
        };
        format!(
            r#"{{"schema_version": 1, "name": "pane", "materials": [
               {{"name": "a", "kind": "glass", "ior": [{low}, {high}], "roughness": 0.4,
                 "wants": {{"fit": {{}}, "refracted_width": {{}}}}}}, {}, {}]}}"#,
            lacquer("b", low),
            lacquer("c", high)
        )
    };
    let correlated = || Variant::from(Smith::Correlated);
    let glass = |side| Variant { side: Some(side), ..correlated() };
    let wide = Scene::from_json(of([1.1, 2.5]).as_bytes(), "pane.json").expect("a scene");
    let wide = lobefit::plan::plan(&wide);
    assert_eq!(wide.jobs("glass-outside")[0].ranges["roughness"], [0.395, 0.405]);
    for [low, high] in [[1.4, 1.6], [1.5, 1.504]] {
        let text = of([low, high]);
        let scene = Scene::from_json(text.as_bytes(), "pane.json").expect("a scene");
        let plan = lobefit::plan::plan(&scene);
        for effect in ["glass-outside", "glass-inside", "width"] {
            let called = plan.effects.iter().find(|called| called.effect == effect).expect("called");
            let ranges = &called.jobs[0].ranges;
            assert_eq!((ranges["roughness"], ranges["ior"]), ([0.4; 2], [low, high]), "{effect}");
        }
        let baked = baked(&text);
        let source = Source::parse("lobefit.wgsl", &code(&baked)).expect("WGSL");
        let uneven = |step: f64, [low, high]: [f64; 2]| -> Vec<f64> {
            let at = |i: u32| low + (high - low) * (f64::from(i) * step + 0.37).fract();
            (0..2000).map(|i| f64::from(at(i) as f32)).collect()
        };
        let (mu, ior) = (uneven(0.618034, [0.01, 1.0]), uneven(0.754878, [low, high]));
        let cases: [(&str, &dyn Quantity, Variant, &str, u32); 5] = [
            ("ggx_dielectric_albedo", GGX_GLASS, glass(Side::Outside), "R", 3),
            ("ggx_glass_energy_compensation_outside", GGX_GLASS, glass(Side::Outside), "E", 5),
            ("ggx_glass_energy_compensation_inside", GGX_GLASS, glass(Side::Inside), "E", 7),
            ("refracted_roughness", &RefractedWidth, correlated(), "roughness_refracted", 4),
            ("coat_escape", &GgxCoat, correlated(), "escape", 3),
        ];
        for (name, quantity, variant, column, most) in cases {
            let fit = Case { name, quantity, variant, column }.holds(&baked, &source, [&mu, &ior]);
            let (ops, stated) = (fit.approximation.cost.ops, fit.approximation.certificate.max_abs);
            assert!(ops <= most && stated <= 0.02, "{name}: {ops} operations, {stated}");
        }
    }
}

#[test]
fn a_limit_that_is_not_kept_names_the_table_that_keeps_it() {
    let text = r#"{"schema_version": 1, "name": "m", "reports": false, "languages": ["wgsl"], "materials": [
        {"name": "m", "kind": "metal", "f0": 0.9, "roughness": 0.5, "wants": {"fit": {"max_ops": 5, "max_error": 0.001}}}]}"#;
    let baked = bake_scene(&Scene::from_json(text.as_bytes(), "m.json").expect("a scene")).expect("a bake");
    let said = baked.broken.join("\n");
    assert!(said.contains("max_error 0.001") && said.contains("table"), "{said}");
}

/// A number takes no argument, and its function no line for one.
#[test]
fn a_number_makes_nothing_of_alpha() {
    let text = LAMP.replacen("\"name\"", r#""arguments": "alpha", "name""#, 1);
    let code = code(&baked(&text));
    let from = code.find("fn ggx_average_albedo(alpha: f32) -> f32 {").expect("the function");
    let body = &code[from..from + code[from..].find('}').expect("an end")];
    assert!(!body.contains("let "), "{body}");
}

/// A quotient whose pole and zero nearly cancel fits to 1e-4 in real numbers, and is off by 0.008 in f32 at
/// places that no list of points knows.
#[test]
fn what_f32_rounds_away_is_left_out() {
    let text = r#"{"schema_version": 1, "name": "m", "reports": false, "languages": ["wgsl"], "pick": "all", "materials": [
        {"name": "m", "kind": "glass", "ior": 1.33, "roughness": 0.05, "wants": {"fit": {"norms": ["max", "rms"]}}}]}"#;
    let baked = bake_scene(&Scene::from_json(text.as_bytes(), "m.json").expect("a scene")).expect("a bake");
    let said: Vec<String> = baked.dropped.iter().map(|left| left.reason.clone()).collect();
    assert!(said.iter().any(|why| why.contains("f32 rounds its values by up to")), "{said:#?}");
    let mu: Vec<f32> = (0..50_000).map(|i| 0.01 + 0.99 * (i as f32 + 0.37) / 50_000.0).collect();
    let wide = |column: &[f32]| column.iter().map(|x| f64::from(*x)).collect::<Vec<f64>>();
    for fit in baked.fits.iter().filter(|fit| fit.hypothesis.inputs() == ["mu"]) {
        let (tape, coefficients) = (fit.hypothesis.tape(), fit.coefficients());
        let rounded = tape.evaluate(std::slice::from_ref(&mu), &coefficients).expect("values");
        let exact = tape.evaluate(&[wide(&mu)], &wide(&coefficients)).expect("values");
        let off = rounded.iter().zip(&exact).map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max);
        let stated = fit.approximation.certificate.max_abs;
        assert!(off <= f64::max(2e-6, 0.2 * stated), "{}: {off}, {stated}", fit.hypothesis.name());
    }
}

/// The R + T of glass of one index, and the albedo of a brushed metal of one anisotropy, in textures of two
/// axes.
#[test]
fn of_one_value_tables_have_an_axis_less() {
    let scene = |size: &str| {
        format!(
            r#"{{ "schema_version": 1, "name": "t", "materials": [
  {{ "name": "pane", "kind": "glass", "ior": 1.52, "roughness": [0.1, 1], "wants": {{ "tables": [{size}] }} }},
  {{ "name": "rail", "kind": "metal", "f0": 0.9, "roughness": [0.1, 1], "anisotropy": 0.6, "wants": {{ "tables": [{size}, {{ "layout": "azimuth" }}] }} }}
] }}"#
        )
    };
    let baked_by = |size: &str| baked(&scene(size));
    let [flat, solid] = [r#"{ "size": [32, 32] }"#, r#"{ "size": [32, 32, 4] }"#].map(baked_by);
    let axes = |baked: &Baked| -> Vec<Vec<usize>> {
        let sizes =
            baked.tables.iter().map(|t| t.table().expect("texels").axes.iter().map(|a| a.size).collect());
        sizes.collect()
    };
    assert_eq!(axes(&flat), [vec![32, 32], vec![64, 16], vec![32, 32], vec![32, 32]]);
    assert_eq!(axes(&solid), [vec![32, 32, 4], vec![64, 16], vec![32, 32, 4], vec![32, 32, 4]]);
    let text =
        code(&flat).split_whitespace().collect::<Vec<_>>().join(" ").replace("( ", "(").replace(" )", ")");
    for signature in [
        "ggx_glass_albedo_outside(table: texture_2d<f32>, linear_clamp: sampler, roughness: f32, n_dot_v: f32, ior: f32)",
        "ggx_aniso_albedo(table: texture_2d<f32>, linear_clamp: sampler, roughness: f32, n_dot_v: f32)",
    ] {
        assert!(text.contains(&format!("fn {signature} -> f32 {{")), "{signature} is not in\n{text}");
    }
    for (flat, solid) in flat.tables.iter().zip(&solid.tables) {
        let [flat_error, solid_error] = [flat, solid].map(|table| table.errors.lookup.max);
        println!("{}: {flat_error}, of three axes {solid_error}", flat.approximation.name);
        assert!(flat_error <= 1.02 * solid_error, "{}", flat.approximation.name);
    }
    // By the truth itself, of rays from inside.
    let inside = flat.tables.iter().find(|table| table.side == Some(Side::Inside)).expect("a table");
    let lookup = Lookup::new(inside.table().expect("texels"), inside.decode).expect("known axes");
    let variant = Variant { smith: Some(Smith::Correlated), side: Some(Side::Inside), ..Variant::default() };
    for (roughness, mu) in [(0.15_f32, 0.3_f32), (0.4, 0.7), (0.77, 0.05), (1.0, 1.0)] {
        let at = Point { roughness, alpha: roughness * roughness, mu, ior: 1.52, ..Point::default() };
        let given = [at.alpha, mu, 1.52_f32].map(f64::from);
        let truth = GGX_GLASS.at(&variant, &given, 1e-7).expect("in the domain")[2];
        let off = (f64::from(lookup.at(&at).e) - truth).abs();
        assert!(off <= inside.errors.lookup.max, "{roughness} {mu}: {off}");
    }
}

/// Where a table of an axis less does not keep its limit, larger ones of an axis less are said.
#[test]
fn a_limit_of_an_axis_less_is_answered_with_an_axis_less() {
    let text = r#"{ "schema_version": 1, "name": "t", "reports": false, "materials": [
  { "name": "pane", "kind": "glass", "ior": 1.52, "roughness": [0.3, 1], "wants": { "tables": [{ "size": [8, 8], "max_error": 0.001 }] } }] }"#;
    let broken =
        bake_scene(&Scene::from_json(text.as_bytes(), "t.json").expect("a scene")).expect("a bake").broken;
    let said = broken.join("\n");
    assert!(said.contains("16x16:") || said.contains("32x32:"), "{said}");
    assert!(!said.contains("x4") && !said.contains("x2:"), "{said}");
}
