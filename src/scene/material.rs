//! A material: metal, dielectric or glass, its roughness range and its reflectance.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};

use super::goals::Goals;
use super::layers::{Base, Coat, Mixed, Sheen};
use super::limits::{EXACT_IOR, GLASS_IOR, PATH_TRACER_IOR, SMOOTH_ALPHA};
use super::name::Name;
use super::number::{DielectricIor, GlassIor, In, Ior, Numbers, Span, Unit, inside};
use super::table::TableWant;
use super::value::{Maybe, Text, Word, about, from_file};
use super::wants::{OpenWants, Wants};
use crate::data::{AlphaMap, Layout, Ndf};
use lobefit_truth::optics::fresnel::f0_of_ior;
use lobefit_truth::quantity::Specular;

/// What a material is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Reflects only.
    Metal,
    /// Reflects at its surface and scatters below it.
    Dielectric,
    /// Reflects and refracts at its surface, and scatters nowhere.
    Glass,
}

impl Kind {
    /// The word used in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Metal => "metal",
            Kind::Dielectric => "dielectric",
            Kind::Glass => "glass",
        }
    }
}

/// What kind of specular lobe a material has: what may be wanted of it follows from that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lobe {
    /// It reflects, and the azimuth does not matter.
    Isotropic,
    /// It reflects, wider along one tangent than along the other.
    Anisotropic,
    /// It reflects and transmits.
    Glass,
    /// It reflects and transmits, wider along one tangent than along the other.
    AnisotropicGlass,
}

impl Lobe {
    /// Whether it transmits.
    pub fn is_glass(self) -> bool {
        matches!(self, Lobe::Glass | Lobe::AnisotropicGlass)
    }

    /// Tables that stand for a wanted table: of glass two, for rays from outside and from inside.
    pub fn sides(self) -> usize {
        if self.is_glass() { 2 } else { 1 }
    }
}

/// A validated material.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Material {
    /// Name, unique in its scene, without control characters; escape it where it is printed.
    pub name: String,
    /// Metal, dielectric or glass.
    pub kind: Kind,
    /// Reflectance at normal incidence, per colour channel, in [0, 1]; of glass `None`: `ior` says
    /// it.
    pub f0: Option<[f64; 3]>,
    /// Index of refraction where the scene gave that: of a dielectric one number in (1, 4], of
    /// glass a range in [1, 3].
    #[serde(serialize_with = "one_or_range")]
    pub ior: Option<[f64; 2]>,
    /// Roughness range in [0, 1], lo <= hi.
    pub roughness: [f64; 2],
    /// The distribution of its facets' normals.
    // Absent at its default: the hash of a scene of GGX is that of the versions before it.
    #[serde(skip_serializing_if = "ggx")]
    pub distribution: Ndf,
    /// Range of the anisotropy in [0, 1], lo <= hi: aspect = sqrt(1 - 0.9 anisotropy),
    /// alpha_x = alpha / aspect, alpha_y = alpha aspect (Burley 2012, "Physically Based Shading at
    /// Disney"). 0 to 0: isotropic.
    // Absent at its default: the hash of an isotropic scene is that of the versions before it.
    #[serde(skip_serializing_if = "isotropic")]
    pub anisotropy: [f64; 2],
    /// Its sheen layer, if it has one.
    // Absent where there is none, for the same reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sheen: Option<Sheen>,
    /// Its coat, if it has one: of dielectrics.
    // Absent where there is none, for the same reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coat: Option<Coat>,
    /// Its diffuse base, if it has one: of dielectrics.
    // Absent where there is none, for the same reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<Base>,
    /// The dielectric that it is mixed with: of metals.
    // Absent where there is none, for the same reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mixed: Option<Mixed>,
    /// What is wanted of its specular lobe.
    pub wants: Wants,
}

fn ggx(distribution: &Ndf) -> bool {
    *distribution == Ndf::Ggx
}

fn isotropic(anisotropy: &[f64; 2]) -> bool {
    anisotropy[1] == 0.0
}

/// One number where both ends are equal: the normal form of `1.5` and of `[1.5, 1.5]`.
fn one_or_range<S: Serializer>(range: &Option<[f64; 2]>, serializer: S) -> Result<S::Ok, S::Error> {
    match range {
        Some([lo, hi]) if lo == hi => Some(lo).serialize(serializer),
        range => range.serialize(serializer),
    }
}

impl Material {
    /// What its specular lobe is multiplied with: a metal's has a colour, a dielectric's is what its base is
    /// made for.
    pub fn specular(&self) -> Specular {
        match self.kind {
            Kind::Metal => Specular::Compensated,
            _ => self.base.as_ref().map_or(Specular::Normalised, |base| base.specular),
        }
    }

    /// The diffuse base, where it sends back light.
    pub fn lit_base(&self) -> Option<&Base> {
        self.base.as_ref().filter(|base| !base.is_black())
    }

    /// That base, where its lobe is another than Lambert's.
    pub fn rough_base(&self) -> Option<&Base> {
        self.lit_base().filter(|base| base.is_rough())
    }

    /// That base, where it lies below a lobe with the exact Fresnel term.
    pub fn exact_base(&self) -> Option<&Base> {
        self.lit_base().filter(|_| self.is_exact())
    }

    /// Whether its lobe is asked for with the exact Fresnel term, and not with Schlick's.
    pub fn is_exact(&self) -> bool {
        self.wants.exact_fresnel.is_some() && self.wants.fit.is_none() && self.wants.tables.is_empty()
    }

    /// The goals of its functions: of the specular lobe and of its layers.
    pub(super) fn goals_mut(&mut self) -> impl Iterator<Item = &mut Goals> {
        let fit = self.wants.fit.iter_mut().map(|fit| &mut fit.goals);
        let fit = fit.chain(self.wants.exact_fresnel.iter_mut().map(|exact| &mut exact.goals));
        let fit = fit.chain(self.wants.refracted_width.iter_mut().map(|value| &mut value.goals));
        let fit = fit.chain(self.wants.widened.iter_mut().map(|widened| &mut widened.goals));
        let fit = fit.chain(self.coat.iter_mut().map(|coat| &mut coat.goals));
        let base = self.base.iter_mut().map(|base| &mut base.goals);
        fit.chain(base).chain(self.sheen.iter_mut().map(|sheen| &mut sheen.goals))
    }

    /// The tables that it asks for, each with the field that lists it: of its lobe and of its layers.
    pub fn tables(&self) -> impl Iterator<Item = (&'static str, usize, &TableWant)> {
        let own = self.wants.tables.iter().enumerate().map(|(j, table)| ("wants", j, table));
        let exact = self.wants.exact_fresnel.iter().flat_map(|exact| exact.tables.iter().enumerate());
        let layer = self.sheen.iter().flat_map(|sheen| sheen.tables.iter().enumerate());
        let beside = exact.map(|(j, table)| (EXACT_FRESNEL, j, table));
        own.chain(beside).chain(layer.map(|(j, table)| ("sheen", j, table)))
    }

    /// The same, to change them.
    pub(super) fn tables_mut(&mut self) -> impl Iterator<Item = (&'static str, &mut TableWant)> {
        let exact = self.wants.exact_fresnel.iter_mut().flat_map(|exact| &mut exact.tables);
        let layer = self.sheen.iter_mut().flat_map(|sheen| &mut sheen.tables);
        let own = self.wants.tables.iter_mut().map(|table| ("wants", table));
        own.chain(exact.map(|table| (EXACT_FRESNEL, table))).chain(layer.map(|table| ("sheen", table)))
    }

    /// What kind of specular lobe it has.
    pub fn lobe(&self) -> Lobe {
        lobe(self.kind, self.anisotropy)
    }

    /// The part of the roughness range whose lobe is rough (alpha >= [`SMOOTH_ALPHA`]), or `None`
    /// for a smooth material.
    pub fn rough_range(&self, map: AlphaMap) -> Option<[f64; 2]> {
        rough_part(self.roughness, map)
    }
}

/// The field of what is wanted with the exact Fresnel term.
pub const EXACT_FRESNEL: &str = "wants.exact_fresnel";

/// The part of a roughness range whose lobe is rough.
pub(super) fn rough_part([lo, hi]: [f64; 2], map: AlphaMap) -> Option<[f64; 2]> {
    (map.alpha(hi) >= SMOOTH_ALPHA).then(|| [lo.max(smallest_rough(map)), hi])
}

/// The roughness at which alpha is [`SMOOTH_ALPHA`]: the root of the map, whose alpha is not below
/// it in f64.
pub fn smallest_rough(map: AlphaMap) -> f64 {
    map.roughness(SMOOTH_ALPHA)
}

/// A material.
#[derive(Deserialize, JsonSchema)]
// A diffuse base and a coat are a dielectric's. Exactly one of `f0` and `ior`: a metal `f0`, a dielectric
// either, glass `ior`. Tables with a third axis are for anisotropic materials and for glass, of
// whose fits only the goals are open, and those of GGX without anisotropy.
#[schemars(rename = "Material", extend(
    "oneOf" = [{ "required": ["f0"] }, { "required": ["ior"] }],
    "anyOf" = [
        { "required": ["f0"], "properties": {
            "kind": { "const": "metal" }, "base": false, "coat": false,
            "wants": { "properties": { "exact_fresnel": false, "refracted_width": false } },
        } },
        { "required": ["f0"], "properties": {
            "kind": { "const": "dielectric" }, "mixed": false,
            "wants": { "properties": { "exact_fresnel": false, "refracted_width": false } },
        } },
        { "properties": {
            "kind": { "const": "dielectric" }, "mixed": false,
            "ior": { "type": "number", "exclusiveMinimum": 1.0 },
            "wants": { "properties": { "exact_fresnel": false, "refracted_width": false } },
        } },
        { "required": ["ior"], "properties": {
            "kind": { "const": "dielectric" }, "mixed": false,
            "ior": { "type": "number", "exclusiveMinimum": 1.0, "maximum": EXACT_IOR },
            "wants": { "properties": {
                "refracted_width": false,
                "exact_fresnel": { "properties": { "tables": { "items": { "properties": {
                    "layout": { "const": "dielectric" },
                    "serves": { "const": "albedo" },
                    "format": { "enum": ["f16", "f32"] },
                } } } } },
            } },
        } },
        {
            "required": ["ior"],
            "properties": {
                "kind": { "const": "glass" },
                "ior": { "maximum": GLASS_IOR, "items": { "maximum": GLASS_IOR } },
                "base": false,
                "coat": false,
                "mixed": false,
                "wants": { "properties": { "exact_fresnel": false } },
            },
            "anyOf": [
                { "properties": { "wants": { "properties": { "fit": false } } } },
                { "properties": {
                    "anisotropy": { "maximum": 0.0, "items": { "maximum": 0.0 } },
                    "wants": { "properties": { "fit": { "properties": {
                        "average": { "const": false }, "multiscatter": { "const": false }, "blend": { "const": false },
                        "hypotheses": { "maxItems": 0 },
                    } } } },
                } },
            ],
        },
    ],
    "allOf" = [{ "anyOf": [
        { "properties": { "distribution": { "const": "ggx" } } },
        { "properties": {
            "anisotropy": { "maximum": 0.0, "items": { "maximum": 0.0 } }, "coat": false, "mixed": false,
            "base": { "anyOf": [{ "required": ["roughness"] }, { "required": ["albedo"], "properties": { "albedo": { "maximum": 0.0, "items": { "maximum": 0.0 } } } }] },
            "wants": { "properties": {
                "exact_fresnel": false, "refracted_width": false, "widened": false,
                "fit": { "properties": { "average": { "const": false }, "multiscatter": { "const": false } } },
                "tables": { "items": { "properties": { "layout": { "enum": ["homogeneous", "plain", "plain-squared", "optimised"] } } } },
            } },
        } },
    ] }, { "anyOf": [
        { "required": ["coat"] },
        { "properties": { "wants": { "properties": { "widened": { "properties": { "coat": { "const": false } } } } } } },
    ] }, { "anyOf": [
        { "properties": { "mixed": false } },
        { "properties": { "anisotropy": { "maximum": 0.0, "items": { "maximum": 0.0 } }, "wants": { "required": ["fit"] } } },
    ] }, {
        "anyOf": [
            { "required": ["anisotropy"], "properties": { "wants": { "properties": { "exact_fresnel": false, "tables": { "items": {
                "anyOf": [
                    { "required": ["layout"], "properties": { "layout": { "not": { "const": "dielectric" } } } },
                    { "properties": { "layout": false, "serves": { "const": "albedo" } } },
                ],
            } } } } } },
            { "properties": {
                "kind": { "const": "glass" },
                "anisotropy": { "maximum": 0.0, "items": { "maximum": 0.0 } },
                "wants": { "properties": { "tables": { "items": { "properties": {
                    "layout": { "enum": ["optimised", "path-tracer"] },
                    "serves": { "const": "albedo" },
                } } } } },
            } },
            { "properties": {
                "kind": { "enum": ["metal", "dielectric"] },
                "anisotropy": { "maximum": 0.0, "items": { "maximum": 0.0 } },
                "wants": { "properties": { "tables": { "items": { "properties": {
                    "layout": { "enum": ["homogeneous", "plain", "plain-squared", "area-lights"] },
                    "size": { "maxItems": 2 },
                } } } } },
            } },
        ],
    }],
))]
#[serde(deny_unknown_fields, expecting = "an object that describes a material")]
struct MaterialFile {
    /// Name, unique in the scene, without control characters.
    name: Text<Name>,
    /// `metal`, `dielectric`, or `glass`, which transmits light through its rough surface.
    kind: Word<Kind>,
    /// Reflectance at normal incidence: a number, or one for red, green and blue. A metal needs it;
    /// a dielectric has either this or `ior`; glass has none.
    #[serde(default)]
    f0: Maybe<Numbers<In<Unit>, 3, true>>,
    /// Index of refraction: of a dielectric a number in (1, 4]; of glass a number or a range [lo,
    /// hi] in [1, 3].
    #[serde(default)]
    ior: Maybe<Span<Ior, true>>,
    /// Roughness: a number, or the range [lo, hi] that the material's texture spans. Where alpha is
    /// below 0.0001 the surface counts as smooth and calls for no rough specular.
    roughness: Span<Unit, true>,
    /// The distribution of the normals of its facets: `ggx` (the default) or `beckmann`, which has tables
    /// and fits of isotropic lobes and of glass.
    #[serde(default)]
    distribution: Maybe<Word<Ndf>>,
    /// Anisotropy: a number, or the range [lo, hi] that the material's
    /// texture spans; default 0. aspect = sqrt(1 - 0.9 anisotropy), alpha_x = alpha / aspect,
    /// alpha_y = alpha aspect.
    #[serde(default)]
    anisotropy: Maybe<Span<Unit, true>>,
    /// A sheen layer; without it, none.
    #[serde(default)]
    sheen: Maybe<Sheen>,
    /// A clear coat of a dielectric, whose base is diffuse; without it, none.
    #[serde(default)]
    coat: Maybe<Coat>,
    /// The diffuse base of a dielectric; without it, none.
    #[serde(default)]
    base: Maybe<Base>,
    /// The dielectric that a metal is mixed with; without it, none.
    #[serde(default)]
    mixed: Maybe<Mixed>,
    /// What is wanted; without it a table and fits, or of anisotropic materials and of glass a
    /// table with a third axis, with their defaults.
    #[serde(default)]
    wants: Maybe<OpenWants>,
}

impl TryFrom<MaterialFile> for Material {
    type Error = String;

    fn try_from(file: MaterialFile) -> Result<Self, String> {
        let kind = file.kind.0;
        let f0 = file.f0.0.map(|Numbers([r, g, b])| [r.0, g.0, b.0]);
        let ior = file.ior.0.map(|n| n.0);
        let f0 = reflectance(kind, f0, ior)?;
        let anisotropy = file.anisotropy.0.map_or([0.0; 2], |range| range.0);
        let lobe = lobe(kind, anisotropy);
        let wants = file.wants.0.map_or_else(|| OpenWants::default(lobe), Ok)?.of(lobe)?;
        if kind == Kind::Glass {
            check_path_tracer(&wants, ior)?;
        }
        let suits =
            kind == Kind::Dielectric && lobe == Lobe::Isotropic && ior.is_some_and(|n| n[1] <= EXACT_IOR);
        if wants.exact_fresnel.is_some() && !suits {
            let message =
                format!("it is of dielectrics with an `ior` of at most {EXACT_IOR} and without anisotropy");
            return Err(about("wants.exact_fresnel", message));
        }
        if wants.widened.as_ref().is_some_and(|widened| widened.coat) && file.coat.0.is_none() {
            return Err(about("wants.widened.coat", "the material has no `coat`"));
        }
        let thick = |coat: &Coat| !(1.05..=2.0).contains(&coat.ior[0]) || coat.ior[1] > 2.0;
        if wants.widened.as_ref().is_some_and(|widened| widened.coat)
            && file.coat.0.as_ref().is_some_and(thick)
        {
            return Err(about("wants.widened.coat", "it is of a coat with an `ior` of 1.05 to 2"));
        }
        let (name, roughness, sheen) = (file.name.0, file.roughness.0, file.sheen.0);
        let (coat, base, mixed) = (file.coat.0, file.base.0, file.mixed.0);
        for (layer, is_there) in [("base", base.is_some()), ("coat", coat.is_some())] {
            if is_there && kind != Kind::Dielectric {
                return Err(format!("`{layer}` is for dielectrics; leave it out of {}", of_kind(kind)));
            }
        }
        if mixed.is_some() && kind != Kind::Metal {
            return Err(format!("`mixed` is for metals; leave it out of {}", of_kind(kind)));
        }
        if mixed.is_some() && lobe == Lobe::Anisotropic {
            return Err(about("mixed", "its functions are of isotropic lobes; leave it or `anisotropy` out"));
        }
        if mixed.is_some() && wants.fit.is_none() {
            return Err(about("mixed", "what mixes takes the value of a function; ask for `fit` in `wants`"));
        }
        let distribution = file.distribution.0.map_or_else(Ndf::default, |word| word.0);
        let material = Material {
            name,
            kind,
            f0,
            ior,
            roughness,
            distribution,
            anisotropy,
            sheen,
            coat,
            base,
            mixed,
            wants,
        };
        match distribution {
            Ndf::Ggx => Ok(material),
            Ndf::Beckmann => material.of_beckmann(),
        }
    }
}

/// A material of a kind, as it reads in a sentence.
fn of_kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Metal => "a metal",
        Kind::Dielectric => "a dielectric",
        Kind::Glass => "glass",
    }
}

fn lobe(kind: Kind, anisotropy: [f64; 2]) -> Lobe {
    match kind {
        Kind::Glass if isotropic(&anisotropy) => Lobe::Glass,
        Kind::Glass => Lobe::AnisotropicGlass,
        _ if isotropic(&anisotropy) => Lobe::Isotropic,
        _ => Lobe::Anisotropic,
    }
}

/// The reflectance at normal incidence of what has one, from exactly one of `f0` and `ior`.
fn reflectance(kind: Kind, f0: Option<[f64; 3]>, ior: Option<[f64; 2]>) -> Result<Option<[f64; 3]>, String> {
    match (kind, f0, ior) {
        (Kind::Metal, _, Some(_)) => Err("`ior` is for dielectrics and glass; give the metal's `f0`".into()),
        (Kind::Metal, None, None) => Err("a metal needs `f0`".into()),
        (Kind::Dielectric, None, None) => Err("a dielectric needs `ior` or `f0`".into()),
        (Kind::Dielectric, Some(_), Some(_)) => {
            Err("`ior` and `f0` are both given; a dielectric needs exactly one of them".into())
        }
        (Kind::Metal | Kind::Dielectric, Some(f0), None) => Ok(Some(f0)),
        (Kind::Dielectric, None, Some([n, hi])) => {
            if n != hi {
                return Err(about(
                    "ior",
                    "a dielectric has one index of refraction; a range is for glass. For fits over a range give two materials, of its least and its largest",
                ));
            }
            inside::<DielectricIor>(n, n)
                .map_err(|e| about("ior", format!("{e}, where a dielectric's lies")))?;
            Ok(Some([f0_of_ior(n); 3]))
        }
        (Kind::Glass, Some(_), _) => {
            Err("`f0` is for metals and dielectrics; of glass give `ior` alone".into())
        }
        (Kind::Glass, None, None) => Err("glass needs `ior`".into()),
        (Kind::Glass, None, Some(range)) => {
            for n in range {
                inside::<GlassIor>(n, n)
                    .map_err(|e| about("ior", format!("{e}, where that of glass lies")))?;
            }
            Ok(None)
        }
    }
}

/// The path tracer's tables must reach the material's index of refraction.
fn check_path_tracer(wants: &Wants, ior: Option<[f64; 2]>) -> Result<(), String> {
    let highest = ior.map_or(1.0, |range| range[1]);
    let path_tracer = wants.tables.iter().position(|t| t.layout == Layout::PathTracer);
    match path_tracer.filter(|_| highest > PATH_TRACER_IOR) {
        None => Ok(()),
        Some(i) => {
            let message =
                format!("the path-tracer layout ends at ior {PATH_TRACER_IOR}, the material's at {highest}");
            Err(about(format!("wants.tables[{i}]"), message))
        }
    }
}

from_file!(Material, MaterialFile);
