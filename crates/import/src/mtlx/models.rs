//! The surface shaders of MaterialX as surfaces, each with the defaults of its specification.

use lobefit_strict::SceneError;
use lobefit_strict::number::{Interval, NotNegative, Unit};

use super::inputs::Inputs;
use crate::gltf::material::{F90, FILM, widths};
use crate::limits::GLASS_IOR;
use crate::note::Said;
use crate::surface::{Reflectance, Shape, Surface, f0_of};

/// A model: a shader to its surface.
type Model = fn(&mut Inputs) -> Result<Surface, SceneError>;

/// The models that are read, by the names of their nodes.
pub(super) const MODELS: [(&str, Model); 4] = [
    ("open_pbr_surface", open_pbr),
    ("standard_surface", standard),
    ("gltf_pbr", gltf),
    ("UsdPreviewSurface", usd_preview),
];

const WHITE: [f64; 3] = [1.0; 3];
const BLACK: [f64; 3] = [0.0; 3];

/// Highest index of refraction: its f0 is 1.
const HIGHEST: f64 = 1e30;

lobefit_strict::intervals! {
    /// Index of refraction that is not below 1, of which [`Inputs::ior`] takes care; an infinite one, as glTF
    /// has it, is none of MaterialX.
    Index = 1.0, HIGHEST, false, "[0, 1e30]";
    /// What is added to a roughness.
    Signed = -1.0, 1.0, false, "[-1, 1]";
}

/// Smallest of Abbe's numbers that is planned; those of glasses are 20 to 90.
const ABBE: f64 = 1.0;

impl Inputs<'_, '_, '_, '_, '_> {
    /// A weight or a roughness.
    fn unit(&mut self, name: &str, default: f64) -> Result<[f64; 2], SceneError> {
        self.number::<Unit>(name, default, Unit::MAX)
    }

    /// Whether a weight is above 0 somewhere.
    fn has(&mut self, name: &str) -> Result<bool, SceneError> {
        Ok(self.number::<NotNegative>(name, 0.0, 1.0)?[1] > 0.0)
    }

    /// An index of refraction; a constant below 1 stands for the other side of the interface, whose f0 is the
    /// same.
    fn ior(&mut self, name: &str, default: f64) -> Result<[f64; 2], SceneError> {
        match self.one_constant(name)? {
            Some(ior) if (0.0..1.0).contains(&ior) => {
                let text = format!("`{name}` is below 1: it is planned as 1/{name}, which has the same f0");
                self.said.reading(text);
                Ok([ior.recip().min(HIGHEST); 2])
            }
            _ => self.number::<Index>(name, default, GLASS_IOR),
        }
    }

    /// Roughness and index of refraction of a clear coat of a weight, if it is there; an index without a
    /// name is the default.
    fn coat(
        &mut self,
        weight: &str,
        (roughness, default): (&str, f64),
        (name, ior): (Option<&str>, f64),
    ) -> Result<Option<[[f64; 2]; 2]>, SceneError> {
        if !self.has(weight)? {
            return Ok(None);
        }
        let ior = name.map_or(Ok([ior; 2]), |name| self.ior(name, ior))?;
        Ok(Some([self.unit(roughness, default)?, ior]))
    }

    /// Khronos' dispersion of the smallest number of Abbe, whose spread is the largest: 20 is 1.
    fn dispersion(&mut self, name: &str, abbe: f64) -> f64 {
        if abbe < ABBE {
            self.said
                .missing(format!("`{name}` is below {ABBE} somewhere: its glass is planned as of {ABBE}"));
        }
        20.0 / abbe.max(ABBE)
    }

    /// Says of each weight that is above 0 what this version lacks.
    fn lacks(&mut self, layers: &[(&str, &str)]) -> Result<(), SceneError> {
        for (weight, text) in layers {
            if self.has(weight)? {
                self.said.missing(*text);
            }
        }
        Ok(())
    }
}

const SUBSURFACE: &str = "subsurface scattering: this version's base scatters where the light meets it";

/// OpenPBR surface 1.1.
fn open_pbr(of: &mut Inputs) -> Result<Surface, SceneError> {
    let weight = of.unit("base_weight", 1.0)?[1];
    let base = scaled(of.colour("base_color", [0.8; 3])?, weight);
    let metalness = of.unit("base_metalness", 0.0)?;
    let specular = of.number::<NotNegative>("specular_weight", 1.0, 1.0)?[1];
    let tint = of.colour("specular_color", WHITE)?;
    let roughness = of.unit("specular_roughness", 0.3)?;
    let ior = of.ior("specular_ior", 1.5)?;
    let strength = of.unit("specular_roughness_anisotropy", 0.0)?;
    let [_, scale] = of.unit("transmission_dispersion_scale", 0.0)?;
    let abbe = "transmission_dispersion_abbe_number";
    let [number, _] = of.number::<NotNegative>(abbe, 20.0, 20.0)?;
    if metalness[1] > 0.0 && tint != WHITE {
        of.said.missing("its metal has a tint at grazing: this version's Fresnel is Schlick's");
    }
    let sheen = sheen(of, ("fuzz_weight", "fuzz_color"), ("fuzz_roughness", 0.5))?;
    if sheen.is_some() {
        of.said.missing("fuzz: this version has the Charlie sheen, another lobe, of the same roughness");
    }
    let coat = of.coat("coat_weight", ("coat_roughness", 0.0), (Some("coat_ior"), 1.6))?;
    // Without darkening the base is as bright as without a coat.
    let [darkest, darkening] = of.unit("coat_darkening", 1.0)?;
    if coat.is_some() && darkest < 1.0 {
        of.said
            .missing("coat_darkening below 1: this version has the whole darkening, to be blended with none");
    }
    let coat = coat.filter(|_| darkening > 0.0);
    of.lacks(&[("thin_film_weight", FILM), ("subsurface_weight", SUBSURFACE)])?;
    Ok(Surface {
        metalness,
        f0: scaled(base, specular.min(1.0)),
        albedo: base,
        base_roughness: of.unit("base_diffuse_roughness", 0.0)?,
        shape: shape(of, roughness, strength, "specular_roughness_anisotropy", open_pbr_widths),
        reflectance: reflectance(ior, specular, tint),
        transmission: of.unit("transmission_weight", 0.0)?,
        is_solid: !of.is_on("geometry_thin_walled")?,
        refracted: roughness,
        ior,
        dispersion: if scale > 0.0 { scale * of.dispersion(abbe, number) } else { 0.0 },
        sheen,
        coat,
    })
}

/// alpha_x = roughness^2 sqrt(2/(1 + (1 - a)^2)), alpha_y = (1 - a) alpha_x.
fn open_pbr_widths(roughness: f64, strength: f64) -> [f64; 2] {
    let aspect = 1.0 - strength;
    let along = roughness * roughness * (2.0 / (1.0 + aspect * aspect)).sqrt();
    [aspect * along, along]
}

/// Autodesk Standard Surface 1.0.1.
fn standard(of: &mut Inputs) -> Result<Surface, SceneError> {
    // Of the version before: 0.8 and white.
    let (weight, colour) = if of.version() == Some("1.0.0") { (0.8, 1.0) } else { (1.0, 0.8) };
    let weight = of.unit("base", weight)?[1];
    let base = scaled(of.colour("base_color", [colour; 3])?, weight);
    let metalness = of.unit("metalness", 0.0)?;
    let specular = of.unit("specular", 1.0)?[1];
    let tint = of.colour("specular_color", WHITE)?;
    let roughness = of.unit("specular_roughness", 0.2)?;
    let ior = of.ior("specular_IOR", 1.5)?;
    let strength = of.unit("specular_anisotropy", 0.0)?;
    let extra = of.number::<Signed>("transmission_extra_roughness", 0.0, 1.0)?;
    // Abbe's number, and 0 for none.
    let [abbe, largest] = of.number::<NotNegative>("transmission_dispersion", 0.0, 100.0)?;
    if metalness[1] > 0.0 {
        of.said
            .missing("its metal has the Fresnel of a conductor: this version has Schlick's of the same f0");
    }
    // Its roughness is alpha.
    let sheen =
        sheen(of, ("sheen", "sheen_color"), ("sheen_roughness", 0.3))?.map(|range| range.map(f64::sqrt));
    let coat = of.coat("coat", ("coat_roughness", 0.1), (Some("coat_IOR"), 1.5))?;
    of.lacks(&[("thin_film_thickness", FILM), ("subsurface", SUBSURFACE)])?;
    let base_roughness = of.unit("diffuse_roughness", 0.0)?;
    if base_roughness[1] > 0.0 {
        of.said
            .reading("rough diffuse base: Oren and Nayar's lobe is planned as EON's of the same roughness");
    }
    Ok(Surface {
        metalness,
        f0: base,
        albedo: base,
        base_roughness,
        shape: shape(of, roughness, strength, "specular_anisotropy", standard_widths),
        reflectance: reflectance(ior, specular, tint),
        transmission: of.unit("transmission", 0.0)?,
        is_solid: !of.is_on("thin_walled")?,
        refracted: [0, 1].map(|k| (roughness[k] + extra[k]).clamp(0.0, 1.0)),
        ior,
        dispersion: if largest > 0.0 { of.dispersion("transmission_dispersion", abbe) } else { 0.0 },
        sheen,
        coat,
    })
}

/// aspect = sqrt(1 - min(a, 0.98)), alpha_x = min(roughness^2/aspect, 1), alpha_y = roughness^2 aspect.
fn standard_widths(roughness: f64, strength: f64) -> [f64; 2] {
    let (alpha, aspect) = (roughness * roughness, (1.0 - strength.min(0.98)).sqrt());
    [alpha * aspect, (alpha / aspect).min(1.0)]
}

/// glTF PBR, as glTF itself has it.
fn gltf(of: &mut Inputs) -> Result<Surface, SceneError> {
    let colour = of.colour("base_color", WHITE)?;
    let metalness = of.unit("metallic", 1.0)?;
    let roughness = of.unit("roughness", 1.0)?;
    let specular = of.unit("specular", 1.0)?;
    if specular[1] > 0.0 && specular[0] < 1.0 {
        of.said.missing(F90);
    }
    let tint = of.colour("specular_color", WHITE)?;
    let ior = of.ior("ior", 1.5)?;
    let strength = of.unit("anisotropy_strength", 0.0)?;
    let dispersion = of.number::<NotNegative>("dispersion", 0.0, 1.0)?[1];
    let is_black = of.colour("sheen_color", BLACK)? == BLACK;
    let sheen = if is_black { None } else { Some(of.unit("sheen_roughness", 0.0)?) };
    let coat = of.coat("clearcoat", ("clearcoat_roughness", 0.0), (None, 1.5))?;
    of.lacks(&[("iridescence", FILM)])?;
    Ok(Surface {
        metalness,
        f0: colour,
        albedo: colour,
        base_roughness: [0.0; 2],
        shape: shape(of, roughness, strength, "anisotropy_strength", widths),
        reflectance: match specular[1] {
            0.0 => None,
            weight => Some(reflectance(ior, weight, tint).unwrap_or(Reflectance::F0(BLACK))),
        },
        transmission: of.unit("transmission", 0.0)?,
        is_solid: of.has("thickness")?,
        refracted: roughness,
        ior,
        dispersion,
        sheen,
        coat,
    })
}

/// USD Preview Surface 2.6. What is not opaque is a wall without a volume.
fn usd_preview(of: &mut Inputs) -> Result<Surface, SceneError> {
    let colour = of.colour("diffuseColor", [0.18; 3])?;
    let has_f0 = of.is_on("useSpecularWorkflow")?;
    let roughness = of.unit("roughness", 0.5)?;
    let ior = of.ior("ior", 1.5)?;
    let opacity = of.unit("opacity", 1.0)?;
    let is_cut_out = of.has("opacityThreshold")?;
    let coat = of.coat("clearcoat", ("clearcoatRoughness", 0.01), (Some("ior"), 1.5))?;
    Ok(Surface {
        metalness: if has_f0 { [0.0; 2] } else { of.unit("metallic", 0.0)? },
        f0: colour,
        albedo: colour,
        base_roughness: [0.0; 2],
        shape: Shape { roughness, anisotropy: [0.0; 2] },
        reflectance: if has_f0 {
            Some(Reflectance::F0(of.colour("specularColor", BLACK)?))
        } else {
            reflectance(ior, 1.0, WHITE)
        },
        transmission: if is_cut_out { [0.0; 2] } else { [1.0 - opacity[1], 1.0 - opacity[0]] },
        is_solid: false,
        refracted: roughness,
        ior,
        dispersion: 0.0,
        sheen: None,
        coat,
    })
}

/// The roughness of a sheen of a weight and a colour, if it is there.
fn sheen(
    of: &mut Inputs,
    (weight, colour): (&str, &str),
    (roughness, default): (&str, f64),
) -> Result<Option<[f64; 2]>, SceneError> {
    if !of.has(weight)? || of.colour(colour, WHITE)? == BLACK {
        return Ok(None);
    }
    of.unit(roughness, default).map(Some)
}

/// The lobe of two widths.
fn shape(
    of: &mut Inputs,
    roughness: [f64; 2],
    strength: [f64; 2],
    name: &str,
    widths: fn(f64, f64) -> [f64; 2],
) -> Shape {
    let said: &mut Said = &mut of.said;
    if strength[1] > 0.0 {
        said.reading(format!(
            "`{name}`: with its alpha_x and alpha_y along and across the grain call functions with roughness = (alpha_x alpha_y)^(1/4) \
             and anisotropy = (1 - alpha_y/alpha_x)/0.9"
        ));
    }
    Shape::of([roughness, strength], widths, said)
}

/// The reflectance of a dielectric at its largest index; none without a specular lobe.
fn reflectance([_, ior]: [f64; 2], weight: f64, tint: [f64; 3]) -> Option<Reflectance> {
    if weight == 0.0 || tint == BLACK {
        None
    } else if weight == 1.0 && tint == WHITE {
        Some(Reflectance::Ior(ior))
    } else {
        Some(Reflectance::F0(scaled(tint, f0_of(ior) * weight).map(|f0| f0.min(1.0))))
    }
}

fn scaled(colour: [f64; 3], factor: f64) -> [f64; 3] {
    colour.map(|c| c * factor)
}
