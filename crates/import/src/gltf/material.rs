//! One material of glTF as a surface: what each extension means for the lobes.

use lobefit_math::srgb;
use lobefit_strict::number::{In, Numbers};
use lobefit_strict::value::Maybe;

use super::Wrong;
use super::document::{Extensions, Glossiness, Material, Metallic, Texture};
use super::images::Images;
use crate::note::Said;
use crate::scene::Parts;
use crate::surface::{Reflectance, Shape, Surface, f0_of};
use crate::texture::Extremes;

/// Index of refraction where a material states none.
const IOR: f64 = 1.5;

/// Channels of an image.
const R: usize = 0;
const G: usize = 1;
const B: usize = 2;
const A: usize = 3;

/// What those of a colour are called.
const COLOUR: [&str; 3] = ["red of its colour", "green of its colour", "blue of its colour"];

/// The materials of a scene that a material of glTF calls for; without `images` each texture holds
/// anything.
pub(super) fn parts(material: &Material, images: Option<&mut Images>) -> Result<Parts, Wrong> {
    let mut look = Look { images, said: Said::default() };
    let with = &material.extensions;
    if with.unlit.0.is_some() {
        look.said.reading("unlit: it has no lobe");
        return Ok(Parts { parts: Vec::new(), said: look.said });
    }
    let mut surface = match &with.glossiness.0 {
        Some(glossiness) => of_glossiness(glossiness, &mut look)?,
        None => of_metalness(&material.pbr_metallic_roughness, with, &mut look)?,
    };
    layers(with, &mut surface, &mut look)?;
    Ok(surface.parts(look.said))
}

/// Metallic-roughness.
fn of_metalness(of: &Metallic, with: &Extensions, look: &mut Look) -> Result<Surface, Wrong> {
    let both = &of.metallic_roughness_texture;
    let metalness = look.range("metalness", number(&of.metallic_factor, 1.0), both, B)?;
    let roughness = look.range("roughness", number(&of.roughness_factor, 1.0), both, G)?;
    let colour = look.colour(rgba(&of.base_color_factor), &of.base_color_texture)?;
    let ior = with.ior.0.as_ref().map_or(IOR, |own| number(&own.ior, IOR));
    let transmission = match &with.transmission.0 {
        Some(own) => {
            let factor = number(&own.transmission_factor, 0.0);
            look.range("transmission", factor, &own.transmission_texture, R)?
        }
        None => [0.0; 2],
    };
    Ok(Surface {
        metalness,
        f0: colour,
        albedo: colour,
        base_roughness: [0.0; 2],
        shape: shape(roughness, with, look)?,
        reflectance: reflectance(ior, with, look)?,
        transmission,
        is_solid: with.volume.0.as_ref().is_some_and(|own| number(&own.thickness_factor, 0.0) > 0.0),
        refracted: roughness,
        ior: [ior; 2],
        dispersion: with.dispersion.0.as_ref().map_or(0.0, |own| number(&own.dispersion, 0.0)),
        sheen: None,
        coat: None,
    })
}

/// The reflectance of a dielectric: its index, or f0 where `KHR_materials_specular` changes that.
/// None where its factor, which scales F90 as well, is 0.
fn reflectance(ior: f64, with: &Extensions, look: &mut Look) -> Result<Option<Reflectance>, Wrong> {
    let Some(specular) = &with.specular.0 else { return Ok(Some(Reflectance::Ior(ior))) };
    let factor = number(&specular.specular_factor, 1.0);
    let [least, factor] = look.range("specular", factor, &specular.specular_texture, A)?;
    if factor == 0.0 {
        return Ok(None);
    }
    if least < 1.0 {
        look.said.missing(F90);
    }
    let tint = rgb(&specular.specular_color_factor, 1.0);
    let colour = look.colour(tint, &specular.specular_color_texture)?;
    let is_textured = specular.specular_texture.0.is_some() || specular.specular_color_texture.0.is_some();
    if is_textured {
        look.said.reading(F0_TEXTURE);
    }
    if !is_textured && least == 1.0 && colour == [1.0; 3] {
        return Ok(Some(Reflectance::Ior(ior)));
    }
    Ok(Some(Reflectance::F0(colour.map(|c| (f0_of(ior) * c).min(1.0) * factor))))
}

/// Specular-glossiness, which glTF had before: a dielectric of this f0 over a diffuse base.
fn of_glossiness(of: &Glossiness, look: &mut Look) -> Result<Surface, Wrong> {
    let texture = &of.specular_glossiness_texture;
    let glossiness = number(&of.glossiness_factor, 1.0);
    let [low, high] = look.range("glossiness", glossiness, texture, A)?;
    let f0 = look.colour(rgb(&of.specular_factor, 1.0), texture)?;
    if texture.0.is_some() {
        look.said.reading(F0_TEXTURE);
    }
    let albedo = look.colour(rgba(&of.diffuse_factor), &of.diffuse_texture)?;
    let roughness = [1.0 - high, 1.0 - low];
    Ok(Surface {
        metalness: [if albedo == [0.0; 3] { 1.0 } else { 0.0 }; 2],
        f0,
        albedo,
        base_roughness: [0.0; 2],
        shape: Shape { roughness, anisotropy: [0.0; 2] },
        reflectance: Some(Reflectance::F0(f0)),
        transmission: [0.0; 2],
        is_solid: false,
        refracted: roughness,
        ior: [IOR; 2],
        dispersion: 0.0,
        sheen: None,
        coat: None,
    })
}

/// The reflecting lobe: glTF has alpha_b = roughness^2 and alpha_t = mix(alpha_b, 1, strength^2).
fn shape(roughness: [f64; 2], with: &Extensions, look: &mut Look) -> Result<Shape, Wrong> {
    let isotropic = Shape { roughness, anisotropy: [0.0; 2] };
    let Some(own) = &with.anisotropy.0 else { return Ok(isotropic) };
    let strength = number(&own.anisotropy_strength, 0.0);
    let strength = look.range("anisotropy", strength, &own.anisotropy_texture, B)?;
    if strength[1] == 0.0 {
        return Ok(isotropic);
    }
    look.said.reading(
        "anisotropy: with alpha_b and alpha_t of glTF call functions with roughness = (alpha_t alpha_b)^(1/4) and anisotropy = (1 - alpha_b/alpha_t)/0.9",
    );
    Ok(Shape::of([roughness, strength], widths, &mut look.said))
}

/// Alpha across and along the grain.
pub(crate) fn widths(roughness: f64, strength: f64) -> [f64; 2] {
    let across = roughness * roughness;
    [across, across + (1.0 - across) * strength * strength]
}

/// Layers above and effects beside the lobes: sheen and coat, and what this version leaves out.
fn layers(with: &Extensions, surface: &mut Surface, look: &mut Look) -> Result<(), Wrong> {
    if let Some(sheen) = &with.sheen.0
        && look.colour(rgb(&sheen.sheen_color_factor, 0.0), &sheen.sheen_color_texture)? != [0.0; 3]
    {
        let factor = number(&sheen.sheen_roughness_factor, 0.0);
        surface.sheen = Some(look.range("sheen roughness", factor, &sheen.sheen_roughness_texture, A)?);
    }
    if let Some(own) = &with.clearcoat.0
        && look.is_there("clear coat", number(&own.clearcoat_factor, 0.0), &own.clearcoat_texture, R)?
    {
        let factor = number(&own.clearcoat_roughness_factor, 0.0);
        let roughness =
            look.range("roughness of the clear coat", factor, &own.clearcoat_roughness_texture, G)?;
        surface.coat = Some([roughness, [IOR; 2]]);
    }
    if let Some(own) = &with.iridescence.0
        && look.is_there("iridescence", number(&own.iridescence_factor, 0.0), &own.iridescence_texture, R)?
    {
        look.said.missing(FILM);
    }
    if let Some(own) = &with.diffuse_transmission.0
        && look.is_there(
            "diffuse transmission",
            number(&own.diffuse_transmission_factor, 0.0),
            &own.diffuse_transmission_texture,
            A,
        )?
    {
        look.said.missing("diffuse transmission: this version has no base that lets light through: it is planned as one that does not");
    }
    Ok(())
}

/// What is said of an f0 with a texture, of F90, and of a film.
const F0_TEXTURE: &str = "its f0 has a texture: the error of its base's share holds at the largest f0, and `any_f0` of the manifest at every one";
pub(crate) const F90: &str = "specular factor below 1: it scales F90 too, which is 1 in this version: its lobe is planned too bright at grazing view, and its base too dark there";
pub(crate) const FILM: &str = "iridescence: its film changes f0 with the angle, and what is promised for an f0 is void there: this version has no film";

/// A look at a material: its textures, and what is said of it.
struct Look<'l, 'a, 't> {
    images: Option<&'l mut Images<'a, 't>>,
    said: Said,
}

impl Look<'_, '_, '_> {
    /// The range of a factor times a channel of its texture.
    fn range(
        &mut self,
        what: &str,
        factor: f64,
        texture: &Maybe<Texture>,
        channel: usize,
    ) -> Result<[f64; 2], Wrong> {
        // Where the factor is 0 no image is opened for it.
        let Some(texture) = texture.0.as_ref().filter(|_| factor > 0.0) else { return Ok([factor; 2]) };
        let Some(images) = &mut self.images else { return Ok([0.0, factor]) };
        let quantile = images.quantile();
        match images.texture(texture.index)? {
            Ok(channels) => {
                let extremes = channels[channel];
                let rough = |texel: f64| factor * texel;
                let glossy = |texel: f64| 1.0 - factor * texel;
                let roughness: Option<&dyn Fn(f64) -> f64> = match what {
                    "roughness" => Some(&rough),
                    "glossiness" => Some(&glossy),
                    _ => None,
                };
                self.said.beyond(what, &extremes, quantile, roughness);
                Ok(extremes.kept.map(|texel| factor * texel))
            }
            Err(why) => {
                self.said.unknown(what, why, [0.0, factor]);
                Ok([0.0, factor])
            }
        }
    }

    /// The largest values of a colour times those of its texture, which is in sRGB.
    fn colour(&mut self, factor: [f64; 3], texture: &Maybe<Texture>) -> Result<[f64; 3], Wrong> {
        let (Some(texture), Some(images)) = (&texture.0, &mut self.images) else { return Ok(factor) };
        let quantile = images.quantile();
        match images.texture(texture.index)? {
            Ok(channels) => Ok([R, G, B].map(|k| {
                let [kept, all] = [channels[k].kept, channels[k].all].map(|ends| ends.map(srgb::decoded));
                self.said.beyond(COLOUR[k], &Extremes { kept, all }, quantile, None);
                factor[k] * kept[1]
            })),
            Err(why) => {
                for k in [R, G, B] {
                    self.said.unknown(COLOUR[k], why, [0.0, factor[k]]);
                }
                Ok(factor)
            }
        }
    }

    /// Whether a layer is there at all.
    fn is_there(
        &mut self,
        what: &str,
        factor: f64,
        texture: &Maybe<Texture>,
        channel: usize,
    ) -> Result<bool, Wrong> {
        Ok(self.range(what, factor, texture, channel)?[1] > 0.0)
    }
}

fn number<I>(given: &Maybe<In<I>>, default: f64) -> f64 {
    given.0.as_ref().map_or(default, |number| number.0)
}

fn rgb<I>(given: &Maybe<Numbers<In<I>, 3, false>>, default: f64) -> [f64; 3] {
    given.0.as_ref().map_or([default; 3], |of| [0, 1, 2].map(|k| of.0[k].0))
}

/// The colour of a factor with alpha; white without it.
fn rgba<I>(given: &Maybe<Numbers<In<I>, 4, false>>) -> [f64; 3] {
    given.0.as_ref().map_or([1.0; 3], |of| [0, 1, 2].map(|k| of.0[k].0))
}
