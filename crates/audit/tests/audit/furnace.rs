//! Whole BRDFs in a white furnace: what their energy is by other means, what gains energy, what is
//! not reciprocal.

use std::sync::Mutex;

use lobefit::data::Smith;
use lobefit_audit::audit::Grade;
use lobefit_audit::foreign::{ShaderFunction, Surroundings, read_functions};
use lobefit_audit::furnace::{Allowance, Asked, Furnace, furnace, judgement, role};
use lobefit_truth::integrate::reflection::{Effort, split};

fn read(text: &str, file: &str, name: &str) -> ShaderFunction {
    let found = read_functions(text.as_bytes(), file, Some(name), &Surroundings::default());
    found.unwrap_or_else(|e| panic!("{e}")).remove(0)
}

fn within(limit: Option<f64>) -> Allowance {
    Allowance { limit, ..Allowance::default() }
}

fn measured(text: &str, file: &str, name: &str, roughness: &[f64]) -> Furnace {
    let asked = Asked { roughness: roughness.to_vec(), tolerance: 1e-3, ..Asked::default() };
    furnace(&read(text, file, name), &asked, &|_| ()).unwrap_or_else(|e| panic!("{e}"))
}

/// Correlated GGX of Walter et al. 2007 and Heitz 2014, F = 1.
const GGX: &str = "
    const PI: f32 = 3.14159265;
    fn ggx(n: vec3<f32>, v: vec3<f32>, l: vec3<f32>, alpha: f32) -> f32 {
        let h = normalize(l + v);
        let nl = max(dot(n, l), 1e-6);
        let nv = max(dot(n, v), 1e-6);
        let a2 = alpha * alpha;
        let d = dot(n, h) * dot(n, h) * (a2 - 1.0) + 1.0;
        let gv = nl * sqrt(a2 + (1.0 - a2) * nv * nv);
        let gl = nv * sqrt(a2 + (1.0 - a2) * nl * nl);
        return a2 / (PI * d * d) * 0.5 / (gv + gl);
    }
    fn twice(n_dot_l: f32, n_dot_v: f32, color: vec3<f32>) -> vec3<f32> {
        return color * select(0.0, n_dot_l * n_dot_v, n_dot_l > 0.0) * 2.25;
    }";

#[test]
fn the_energy_of_ggx_is_its_directional_albedo() {
    let found = measured(GGX, "g.wgsl", "ggx", &[0.06, 0.5]);
    assert!(found.cells.len() == 16 && found.unusable.is_none());
    for cell in &found.cells {
        let (alpha, mu) = (cell.at["roughness"], cell.at["mu"]);
        let truth = split(Smith::Correlated, alpha, mu, &Effort::ladder()[1]).0;
        let energy = cell.energy[0];
        // 1e-4 is what f32 leaves of a narrow peak.
        assert!((energy.value - truth).abs() < energy.error + 1e-4, "{alpha} {mu}: {energy:?}, {truth}");
        assert!(energy.error < 2e-3, "{alpha} {mu}: {energy:?}");
    }
    assert!(found.reciprocity.share < 1e-5 && !found.cosine.included && found.cosine.known == "found");
    assert_eq!(judgement("ggx", &found, within(Some(0.01))).grade, Grade::Pass);
    let losing = |loss: f64| judgement("ggx", &found, Allowance { loss: Some(loss), ..within(Some(0.01)) });
    let verdict = losing(0.01);
    assert!(verdict.grade == Grade::Fail && verdict.line.contains("loses energy"), "{}", verdict.line);
    assert_eq!(losing(0.9).grade, Grade::Pass);
}

#[test]
fn a_lambert_surface_returns_its_albedo_with_and_without_the_cosine() {
    let glsl = "vec3 plain(vec3 albedo) { return albedo / 3.14159265; }
        vec3 lambert(vec3 lightDir, vec3 viewDir, vec3 normal, vec3 albedo) { return plain(0.8 * albedo); }
        vec3 lit(vec3 lightDir, vec3 viewDir, vec3 normal, vec3 albedo) { return plain(0.8 * albedo) * max(dot(normal, lightDir), 0.0); }";
    for (name, included) in [("lambert", false), ("lit", true)] {
        let found = measured(glsl, "l.glsl", name, &[1.0]);
        assert_eq!((found.cosine.included, found.cosine.known), (included, "found"), "{name}");
        assert_eq!(found.channels, ["x"], "a grey result is one channel");
        for cell in &found.cells {
            let energy = cell.energy[0];
            assert!((energy.value - 0.8).abs() <= energy.error.min(1e-3), "{name} {:?}: {energy:?}", cell.at);
        }
        assert_eq!(judgement(name, &found, within(None)).grade, Grade::Pass);
    }
}

#[test]
fn what_gains_energy_is_found_at_its_worst_place() {
    // f = 2.25 nl nv: the energy is 2.25 nv 2 pi/3, largest at normal incidence.
    let found = measured(GGX, "g.wgsl", "twice", &[]);
    let (cell, channel) = &found.most;
    let wanted = 2.25 * 2.0 * std::f64::consts::PI / 3.0;
    assert!((cell.energy[*channel].value - wanted).abs() < 2e-3 && cell.at["mu"] == 1.0, "{cell:?}");
    assert!((found.least.0.energy[0].value - 0.02 * wanted).abs() < 1e-3);
    let verdict = judgement("twice", &found, within(Some(0.01)));
    assert!(
        verdict.grade == Grade::Fail && verdict.line.starts_with("FAIL white furnace: twice gains energy")
    );
    assert!(verdict.line.contains("4.712") && verdict.line.contains("mu 1"), "{}", verdict.line);
    assert!(verdict.points.len() <= 5, "{:?}", verdict.points);
}

/// At a reflectance of 1 no Fresnel term shows: one that prefers a direction does at another.
#[test]
fn what_a_reflectance_of_one_hides_is_said() {
    for (argument, hides) in
        [("specular_color", true), ("F0", true), ("albedo", false), ("reflectance", false)]
    {
        let glsl =
            format!("float f(vec3 l, vec3 v, vec3 n, float {argument}) {{ return 0.3 * {argument}; }}");
        let points = judgement("f", &measured(&glsl, "f.glsl", "f", &[]), within(None)).points.concat();
        let said = format!("Where {argument} is 1 a Fresnel term is 1 throughout");
        assert_eq!(points.contains(&said), hides, "{points}");
    }
    let one_sided = "float f(vec3 l, vec3 v, vec3 n, float f0) {
        return 0.3 * (f0 + (1.0 - f0) * pow(1.0 - dot(n, v), 5.0)); }";
    let verdict = judgement("f", &measured(one_sided, "f.glsl", "f", &[]), within(None));
    assert!(verdict.line.starts_with("FAIL white furnace: f is not reciprocal"), "{}", verdict.line);
    assert!(verdict.line.contains("f0 0.04"), "{}", verdict.line);
}

/// A factor that is counted twice or not at all is named: of a white Lambert surface.
#[test]
fn constant_factors_are_named() {
    let pi = std::f64::consts::PI;
    for (value, named) in [
        (1.0, "It is nearly pi: "),
        (4.0 / pi, "It is nearly 4: "),
        (1.0 / (pi * pi), "It is nearly 1/pi: "),
        (0.25 / pi, "It is nearly 1/4: "),
        (0.5 / pi, "Energy: 0.500"),
    ] {
        let glsl = format!("float f(vec3 l, vec3 v, vec3 n) {{ return {value:.9}; }}");
        let points = judgement("f", &measured(&glsl, "f.glsl", "f", &[]), within(None)).points.concat();
        assert!(points.contains(named), "{points}");
    }
}

#[test]
fn a_lobe_that_prefers_a_direction_is_found() {
    let hlsl = "float f(float3 N, float3 V, float3 L, half roughness)
        {
            float nv = saturate(dot(N, V));
            return (1 + roughness * (nv - 0.5)) / 3.14159265;
        }";
    let found = measured(hlsl, "f.hlsl", "f", &[0.2, 0.5]);
    assert_eq!(found.cosine.known, "assumed");
    let broken = &found.reciprocity;
    // The larger value is at a view along the normal: (r (1 - mu))/(1 + r/2) of it.
    assert!((broken.share - 0.5 * 0.99 / 1.25).abs() < 0.02, "{broken:?}");
    assert!(
        broken.at["roughness"] == 0.5 && (broken.at["mu_l"] - broken.at["mu_v"]).abs() > 0.9,
        "{broken:?}"
    );
    let verdict = judgement("f", &found, within(Some(0.3)));
    assert!(verdict.grade == Grade::Fail && verdict.line.contains("is not reciprocal"), "{}", verdict.line);
    assert_eq!(judgement("f", &found, within(Some(0.5))).grade, Grade::Pass);
    // Neither way symmetric: whether the cosine is in it must be stated.
    let one_way = Allowance { one_way: true, ..within(Some(0.3)) };
    let verdict = judgement("f", &found, one_way);
    assert!(
        verdict.grade == Grade::Unknown && verdict.line.contains("`--cosine included` or `--cosine absent`"),
        "{}",
        verdict.line
    );
    let asked = Asked { cosine: Some(false), roughness: vec![0.5], tolerance: 1e-3, ..Asked::default() };
    let stated = furnace(&read(hlsl, "f.hlsl", "f"), &asked, &|_| ()).unwrap_or_else(|e| panic!("{e}"));
    let verdict = judgement("f", &stated, one_way);
    assert!(verdict.grade == Grade::Pass && verdict.line.contains("gains no energy"), "{}", verdict.line);
}

/// Every roughness is a stage of its own.
#[test]
fn the_stages_are_told() {
    let stages = Mutex::new(Vec::new());
    let told = |stage: &str| stages.lock().unwrap().push(stage.to_string());
    let asked = Asked { roughness: vec![0.5, 1.0], tolerance: 0.1, ..Asked::default() };
    furnace(&read(GGX, "f.wgsl", "ggx"), &asked, &told).unwrap();
    let energies = ["the white furnace at roughness 0.5", "the white furnace at roughness 1"];
    let all = stages.into_inner().unwrap();
    assert!(all.len() == 5 && energies.iter().all(|stage| all.contains(&(*stage).to_string())), "{all:?}");
}

#[test]
fn arguments_are_known_by_name_or_said() {
    let text = "struct Material { vec3 baseColor; float roughness; float metallic; vec3 unused; };
        float f(Material m, vec3 a, vec3 eye, float LdotH) { return m.roughness * m.baseColor.x * a.z * eye.z + m.metallic * LdotH; }
        float nan(vec3 l, vec3 v) { return sqrt(l.z * v.z - 0.2); }";
    let function = read(text, "f.glsl", "f");
    let asked = Asked { roughness: vec![0.5], tolerance: 1e-2, ..Asked::default() };
    let refused = |asked: &Asked| furnace(&function, asked, &|_| ()).unwrap_err().to_string();
    let message = refused(&asked);
    assert!(
        message.contains("what m.metallic, a.z is given is not known") && message.contains("--role"),
        "{message}"
    );
    let roles = vec![("a".to_string(), role("l").unwrap())];
    let asked = Asked { roles, set: vec![("m.metallic".into(), 0.0)], ..asked };
    let found = furnace(&function, &asked, &|_| ()).unwrap();
    let named: Vec<String> = found.arguments.iter().map(|(name, role)| format!("{name}={role}")).collect();
    assert_eq!(
        named,
        ["m.baseColor=1 (white)", "m.roughness=roughness", "m.metallic=0", "a=l", "eye=v", "LdotH=l.h"]
    );
    let unknown = Asked { set: vec![("q".into(), 0.0)], ..asked.clone() };
    assert!(refused(&unknown).contains("--set"), "{}", refused(&unknown));
    // What is no number is named with its place.
    let found = furnace(&read(text, "f.glsl", "nan"), &asked, &|_| ()).unwrap_err().to_string();
    assert!(found.contains("--role"), "{found}");
    let found = measured(text, "f.glsl", "nan", &[1.0]);
    let bad = found.unusable.as_ref().expect("a root of what is negative");
    assert!(
        bad.value == "not a number" && bad.points > 1 && bad.at["mu_l"] * bad.at["mu_v"] < 0.2,
        "{bad:?}"
    );
    let verdict = judgement("nan", &found, within(Some(10.0)));
    assert!(
        verdict.grade == Grade::Fail && verdict.points[0].starts_with("Values: not a number"),
        "{verdict:?}"
    );
}

/// A roughness that shows nowhere but where it is stated was taken for one that the function does not use.
#[test]
fn a_stated_roughness_is_looked_at() {
    let text = "fn f(l: vec3<f32>, v: vec3<f32>, roughness: f32) -> f32 {
        return select(1.0, 1.5, roughness < 0.05) / 3.14159265;
    }";
    let found = measured(text, "f.wgsl", "f", &[0.04, 0.5]);
    let verdict = judgement("f", &found, within(None));
    assert!(verdict.grade == Grade::Fail && found.most.0.at["roughness"] == 0.04, "{verdict:?}");
    assert!(verdict.line.contains("the largest energy sampled is 1.5 \u{b1} "), "{}", verdict.line);
    let squared = "fn f(l: vec3<f32>, v: vec3<f32>, roughness: f32, alpha: f32) -> f32 {
        return (select(0.5, 1.5, alpha < 0.01) + 0.1 * roughness) / 3.14159265;
    }";
    let squared = measured(squared, "f.wgsl", "f", &[0.05, 0.5]);
    assert!(squared.most.0.energy[0].value > 1.5, "{:?}", squared.arguments);
    let unused = "fn f(l: vec3<f32>, v: vec3<f32>, roughness: f32) -> f32 { return 0.3; }";
    let unused = measured(unused, "f.wgsl", "f", &[0.04, 0.5]);
    assert!(unused.cells.len() == 8 && !unused.most.0.at.contains_key("roughness"), "{:?}", unused.arguments);
}

#[test]
fn names_of_arguments_tell_what_they_are() {
    let text = "struct Surface { float TdotH; vec3 baseColor; float specularF90; float metallic; };
        float f(Surface s, float NdotL, float n_dot_v, float dotNH, float _NoV, float LoH, float VdotH, float cosNL,
                float clampedNdotL, float perceptual_roughness, vec3 lightDir, vec3 wo, vec3 normal, vec3 h, vec3 X,
                float mode, vec3 position) {
            return 0.1 * (NdotL + n_dot_v + dotNH + _NoV + LoH + VdotH + cosNL + clampedNdotL + perceptual_roughness
                + s.TdotH + s.baseColor.x + s.specularF90 + lightDir.z + wo.z + normal.z + h.z + X.x) + s.metallic + mode + position.x;
        }";
    let function = read(text, "f.glsl", "f");
    let asked = Asked { roughness: vec![0.5], tolerance: 1e-2, ..Asked::default() };
    let message = furnace(&function, &asked, &|_| ()).unwrap_err().to_string();
    assert!(message.contains("what s.metallic, mode, position.x is given is not known"), "{message}");
    let set = ["s.metallic", "mode", "position"].map(|name| (name.to_string(), 0.0)).to_vec();
    let found = furnace(&function, &Asked { set, ..asked }, &|_| ()).unwrap();
    let named: Vec<String> = found.arguments.iter().map(|(name, role)| format!("{name}={role}")).collect();
    let wanted = "s.TdotH=t.h s.baseColor=1 (white) s.specularF90=1 (white) s.metallic=0 NdotL=n.l n_dot_v=n.v dotNH=n.h \
        _NoV=n.v LoH=l.h VdotH=v.h cosNL=n.l clampedNdotL=n.l perceptual_roughness=roughness lightDir=l wo=v normal=n \
        h=h X=t mode=0 position=0";
    assert_eq!(named.join(" "), wanted);
    for word in ["v.h", "n.l", "t", "roughness"] {
        assert_eq!(role(word).map(|role| role.words()), Ok(word.to_string()));
    }
    assert!(role("view").is_err() && role("v.").is_err());
    // An alpha is the square of a roughness beside it, and the roughness where it is alone.
    for (other, told) in [("NdotL", "roughness"), ("rough", "roughness^2")] {
        let text = format!(
            "float f(float {other}, float alpha, vec3 l, vec3 v) {{ return {other} * alpha * l.z * v.z; }}"
        );
        let asked = Asked { roughness: vec![0.5], tolerance: 1e-2, ..Asked::default() };
        let found = furnace(&read(&text, "f.glsl", "f"), &asked, &|_| ()).unwrap();
        assert_eq!(found.arguments[1], ("alpha".to_string(), told.to_string()));
    }
}
