//! A surface as every model of a foreign file has it, and the materials of a scene that it calls for.

use lobefit_strict::number::{DielectricIor, Interval};
use lobefit_truth::optics::fresnel::f0_of_ior;
use serde_json::{Value, json};

use super::limits::GLASS_IOR;
use super::note::Said;
use super::scene::{Fields, Part, Parts, span, tidy};

/// Half of the spread of the index over the visible wavelengths, over ior - 1, of Khronos' dispersion
/// of 1, which is 20 over Abbe's number: n_F - n_C = (n - 1)/V.
const DISPERSION: f64 = 0.025;

/// Roughness and anisotropy of a lobe, as a scene has them: alpha = roughness^2 = sqrt(alpha_x alpha_y),
/// alpha_y/alpha_x = 1 - 0.9 anisotropy.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub roughness: [f64; 2],
    pub anisotropy: [f64; 2],
}

/// What the reflectance of a dielectric is stated by.
#[derive(Clone, Debug)]
pub(crate) enum Reflectance {
    Ior(f64),
    F0([f64; 3]),
}

/// What is said of a coat.
const COAT: &str = "clear coat: this version has the albedo of its lobe and its darkening of a diffuse base, and neither its colour nor how it widens the lobes below";

/// A metal, a dielectric over its base, glass, or a mixture of these; ranges over its textures, and of
/// colours the largest value.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    /// Share of the metal.
    pub metalness: [f64; 2],
    /// Reflectance of the metal at normal incidence.
    pub f0: [f64; 3],
    /// Albedo of the diffuse base of the dielectric.
    pub albedo: [f64; 3],
    /// Roughness of that base itself: 0 is Lambert's.
    pub base_roughness: [f64; 2],
    /// The lobe.
    pub shape: Shape,
    /// Of the dielectric; none where it has no specular lobe.
    pub reflectance: Option<Reflectance>,
    /// Share of the dielectric that lets light through.
    pub transmission: [f64; 2],
    /// Whether that is a solid, and no thin wall.
    pub is_solid: bool,
    /// Roughness of the transmitted lobe.
    pub refracted: [f64; 2],
    /// Index of refraction of the solid, and Khronos' dispersion.
    pub ior: [f64; 2],
    pub dispersion: f64,
    /// Roughness of a sheen layer.
    pub sheen: Option<[f64; 2]>,
    /// Roughness and index of refraction of a clear coat.
    pub coat: Option<[[f64; 2]; 2]>,
}

impl Surface {
    /// The materials of the scene that it calls for.
    pub fn parts(&self, mut said: Said) -> Parts {
        let mut parts = Vec::new();
        let mut add = |kind, fields| parts.push(Part { kind, fields });
        if self.metalness[1] > 0.0 {
            let mut own = self.shaped(vec![("f0", json!(self.f0.map(tidy)))]);
            own.extend(self.mixed(&mut said));
            add("metal", own);
        }
        if self.metalness[0] < 1.0 {
            let is_clear = self.transmission[1] > 0.0;
            let is_glass = is_clear && self.is_solid && self.glass(&mut add, &mut said);
            if is_clear && !self.is_solid {
                said.missing(
                    "transmission without a volume, or with one of no thickness, is a thin wall: this version has its reflection and not its transmitted lobe",
                );
            }
            // The reflection of what glass does not stand for stays.
            let is_opaque = self.transmission[0] < 1.0 || !is_glass;
            if let Some(stated) = self.reflectance.as_ref().filter(|_| is_opaque) {
                let mut own = self.shaped(vec![reflectance(stated)]);
                // What lets all light through scatters none below its surface.
                if self.transmission[0] < 1.0 && self.albedo != [0.0; 3] {
                    own.push(("base", self.base()));
                }
                add("dielectric", own);
            } else if is_opaque
                && (self.sheen.is_some() || self.coat.is_some() || self.base_roughness[1] > 0.0)
            {
                said.reading("it has no specular lobe: the scene has a smooth one, which calls for nothing");
                add("dielectric", vec![("f0", json!(0)), ("roughness", json!(0)), ("base", self.base())]);
            }
        }
        if let Some(roughness) = self.sheen {
            match parts.iter_mut().rfind(|part| part.kind != "glass") {
                Some(part) => part.fields.push(("sheen", json!({ "roughness": span(roughness) }))),
                None => said.missing("sheen over glass: this version has none: it is left out"),
            }
        }
        if let Some([roughness, ior]) = self.coat {
            let range = ior.map(|ior| ior.clamp(1.0, GLASS_IOR));
            if range != ior {
                let [from, to] = ior.map(tidy);
                said.missing(format!(
                    "its coat's indices of refraction are [{from}, {to}]: coats end at 1 and 3"
                ));
            }
            let coat = json!({ "roughness": span(roughness), "ior": span(range) });
            let has_base = |part: &&mut Part| part.fields.iter().any(|(name, _)| *name == "base");
            let bare =
                ["metal", "glass"].into_iter().filter(|kind| parts.iter().any(|part| part.kind == *kind));
            let bare: Vec<&str> = bare.collect();
            match parts.iter_mut().find(has_base) {
                Some(part) => {
                    part.fields.push(("coat", coat));
                    said.missing(COAT);
                    for kind in bare {
                        said.missing(format!(
                            "clear coat over its share of {kind}: this version has none, and the {kind} is planned bare"
                        ));
                    }
                }
                None => said.missing("clear coat over no diffuse base, a metal or glass: this version has none, and the whole coat is left out"),
            }
        }
        Parts { parts, said }
    }

    /// The dielectric that the metal is mixed with, where it has the same lobe but for its Fresnel term.
    fn mixed(&self, said: &mut Said) -> Option<(&'static str, Value)> {
        if self.metalness[0] == 1.0 {
            return None;
        }
        let part = "metalness between 0 and 1: mix the finished lobes, each with its own compensation, and scale the base by what is no metal";
        let is_isotropic = self.shape.anisotropy[1] == 0.0;
        let Some(of) = self.reflectance.as_ref().filter(|_| is_isotropic) else {
            said.reading(part);
            return None;
        };
        said.reading(format!(
            "{part}; mixing f0 first loses light: the comment of `ggx_mixed_normalised` says how much"
        ));
        let f0 = match *of {
            Reflectance::Ior(ior) => json!(tidy(f0_of(ior))),
            Reflectance::F0(f0) => json!(f0.map(tidy)),
        };
        Some(("mixed", json!({ "metalness": span(self.metalness), "f0": f0 })))
    }

    fn base(&self) -> Value {
        let albedo = self.albedo.map(tidy);
        match self.base_roughness[1] > 0.0 {
            true => json!({ "albedo": albedo, "roughness": span(self.base_roughness) }),
            false => json!({ "albedo": albedo }),
        }
    }

    /// Fields with those of the lobe behind the first.
    fn shaped(&self, mut fields: Fields) -> Fields {
        let Shape { roughness, anisotropy } = &self.shape;
        fields.push(("roughness", span(*roughness)));
        if anisotropy[1] > 0.0 {
            fields.push(("anisotropy", span(*anisotropy)));
        }
        fields
    }

    /// Glass of a solid: from outside and from inside, over the indices that its colours have. Whether
    /// there is any.
    fn glass(&self, add: &mut impl FnMut(&'static str, Fields), said: &mut Said) -> bool {
        let spread = |ior: f64| (ior - 1.0) * DISPERSION * self.dispersion;
        let [low, high] = self.ior;
        let whole = [low - spread(low), high + spread(high)];
        let refused = if low == 0.0 {
            Some("infinite (0 in glTF), and glass ends at 3")
        } else if whole[0] > GLASS_IOR {
            Some("beyond 3, where glass ends")
        } else {
            (high < 1.0).then_some("below 1, that of a vacuum")
        };
        if let Some(why) = refused {
            said.missing(format!("its index of refraction is {why}: its transmitted lobe is left out"));
            return false;
        }
        let range = whole.map(|ior| ior.clamp(1.0, GLASS_IOR));
        if range != whole {
            let [from, to] = whole.map(tidy);
            said.missing(format!(
                "its indices of refraction are [{from}, {to}], and glass ends at 1 and 3: what is promised is void beyond"
            ));
        }
        if !matches!(self.reflectance, Some(Reflectance::Ior(_))) {
            said.missing("specular of glass: this version has the Fresnel term of its index alone");
        }
        if self.shape.anisotropy[1] > 0.0 {
            said.missing("anisotropic glass: this version has tables of isotropic glass alone");
        }
        add("glass", vec![("ior", span(range)), ("roughness", span(self.refracted))]);
        true
    }
}

fn reflectance(of: &Reflectance) -> (&'static str, Value) {
    match *of {
        Reflectance::Ior(ior) if DielectricIor::MIN < ior && ior <= DielectricIor::MAX => ("ior", json!(ior)),
        Reflectance::Ior(ior) => ("f0", json!(tidy(f0_of(ior)))),
        Reflectance::F0(f0) => ("f0", json!(f0.map(tidy))),
    }
}

/// f0 of an index; glTF's 0 stands for an infinite one.
pub(crate) fn f0_of(ior: f64) -> f64 {
    if ior == 0.0 { 1.0 } else { f0_of_ior(ior) }
}

impl Shape {
    /// The lobe of two widths, alpha across and along the grain, over a box of roughness and strength:
    /// both are monotone in either, and along/across falls with roughness and rises with strength.
    pub fn of(
        [roughness, strength]: [[f64; 2]; 2],
        widths: impl Fn(f64, f64) -> [f64; 2],
        said: &mut Said,
    ) -> Shape {
        if strength[1] == 0.0 {
            return Shape { roughness, anisotropy: [0.0; 2] };
        }
        let own = |roughness: f64, strength: f64| {
            let [across, along] = widths(roughness, strength);
            (across * along).sqrt().sqrt()
        };
        let anisotropy = |roughness: f64, strength: f64| {
            // At roughness 0 both widths may be 0: their ratio is the limit there.
            let [across, along] = widths(roughness.max(1e-6), strength);
            (1.0 - across / along) / 0.9
        };
        let [low, high] = [anisotropy(roughness[1], strength[0]), anisotropy(roughness[0], strength[1])];
        if high > 1.0 {
            said.missing(
                "its alpha along the grain is more than 10 times that across it somewhere, where the anisotropy of a scene ends: clamp it to 1 there",
            );
        }
        let corners = roughness.map(|r| strength.map(|s| own(r, s)));
        let roughness = corners
            .as_flattened()
            .iter()
            .fold([f64::INFINITY, 0.0], |[low, high], &r| [r.min(low), r.max(high)]);
        Shape { roughness, anisotropy: [low.clamp(0.0, 1.0), high.clamp(0.0, 1.0)] }
    }
}
