//! f(l, v) of a material.

use std::f64::consts::FRAC_1_PI;
use std::sync::Arc;

use crate::SurfaceError;
use crate::albedos::{Albedos, Column};
use crate::material::{Base, Coupling, FactorAt, Lobe, Material};
use lobefit_math::vector::dot;
use lobefit_truth::optics::ggx::{self, Vec3};
use lobefit_truth::optics::multiscatter::{self, Bounces};
use lobefit_truth::optics::{diffuse, fresnel};

/// A material ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Surface {
    material: Material,
    albedos: Arc<Albedos>,
    /// Whether all channels have the same f0 and albedo, and so the same of everything.
    grey: bool,
    /// Colour of the second lobe, and what it absorbs; 0 and 1 without one.
    series: [f64; 3],
    absorbed: [f64; 3],
    /// Average of what the specular lobe leaves, and of the factor of the base.
    left_avg: [f64; 3],
    factor_avg: [f64; 3],
}

/// What a surface knows of one of its two directions, from the cosine alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Cosine to the normal, in [0, 1].
    pub mu: f64,
    /// Albedos of the lobe.
    pub column: Column,
    /// 1 less the albedo of the specular lobe as it is drawn, by channel.
    pub left: [f64; 3],
    stretched: f64,
    /// Multiplier of the lobe if this is the view.
    boost: [f64; 3],
    /// Factor of the base for couplings of one side.
    factor: [f64; 3],
}

/// The BRDF in two parts, without the cosine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts {
    /// Specular lobe, with what was added to it.
    pub specular: [f64; 3],
    /// Diffuse base.
    pub base: [f64; 3],
}

/// The facet that mirrors one direction into the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Its normal, the half vector.
    pub half: Vec3,
    /// Cosine between the normal and either direction.
    pub cosine: f64,
    /// 1 - cosine.
    pub complement: f64,
}

impl Facet {
    /// The facet between two directions of unit length, not opposite to one another.
    pub fn between(a: Vec3, b: Vec3) -> Facet {
        let sum = [0, 1, 2].map(|i| a[i] + b[i]);
        let difference = [0, 1, 2].map(|i| a[i] - b[i]);
        // |a + b| = 2 cos and |a - b| = 2 sin of the angle to the half vector: no cancellation at either end.
        let length = dot(sum, sum).sqrt();
        let cosine = (0.5 * length).min(1.0);
        let complement = 0.25 * dot(difference, difference) / (1.0 + cosine);
        Facet { half: sum.map(|x| x / length), cosine, complement }
    }
}

impl Surface {
    /// A surface of a material: integrates the albedos of its alpha (tens of milliseconds).
    ///
    /// # Errors
    /// A property outside its range; an integral that is not finite.
    pub fn new(material: &Material) -> Result<Surface, SurfaceError> {
        material.check()?;
        let albedos = Albedos::new(material.smith, material.alpha)?;
        Surface::with(material, Arc::new(albedos))
    }

    /// A surface with albedos that were integrated before, of the same shadowing and alpha.
    ///
    /// # Errors
    /// A property outside its range; albedos of another lobe.
    pub fn with(material: &Material, albedos: Arc<Albedos>) -> Result<Surface, SurfaceError> {
        material.check()?;
        fits(material, &albedos)?;
        let f0 = material.f0;
        let f_avg = f0.map(fresnel::schlick_average);
        let (e, loss) = (albedos.average.e, albedos.average.loss);
        let bounces = match material.lobe {
            Lobe::KullaConty => Some(Bounces::FromSecond),
            Lobe::KullaContyOnce => Some(Bounces::FromFirst),
            _ => None,
        };
        let of = |f: fn(Bounces, f64, f64, f64) -> f64, none: f64| {
            f_avg.map(|f_avg| bounces.map_or(none, |bounces| f(bounces, f_avg, e, loss)))
        };
        let (series, absorbed) = (of(multiscatter::series, 0.0), of(multiscatter::absorbed, 1.0));
        let (material, none) = (material.clone(), [0.0; 3]);
        let same = |x: &[f64; 3]| x.iter().all(|y| *y == x[0]);
        let grey = same(&f0) && material.base.as_ref().is_none_or(|base| same(&base.albedo));
        let mut surface =
            Surface { material, albedos, grey, series, absorbed, left_avg: none, factor_avg: none };
        surface.left_avg = surface.albedos.average_of(|_, column| surface.left(column));
        if let Some(Base { coupling: Coupling::Symmetrised(_), .. }) = surface.material.base {
            surface.factor_avg = surface.albedos.average_of(|mu, _| surface.factor(mu, &none));
        }
        Ok(surface)
    }

    /// The material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Albedos of its lobe.
    pub fn albedos(&self) -> &Arc<Albedos> {
        &self.albedos
    }

    /// f(l, v) by channel, without the cosine; 0 if either direction (of unit length) is not above
    /// the horizon.
    pub fn evaluate(&self, light: Vec3, view: Vec3) -> [f64; 3] {
        let parts = self.parts(light, view);
        [0, 1, 2].map(|i| parts.specular[i] + parts.base[i])
    }

    /// [`Surface::evaluate`] in its two parts.
    pub fn parts(&self, light: Vec3, view: Vec3) -> Parts {
        if light[2] <= 0.0 || view[2] <= 0.0 {
            return Parts::default();
        }
        self.between(&self.side(light[2]), &self.side(view[2]), light, view)
    }

    /// What is known of a direction by its cosine in [0, 1]: a renderer makes it once for the view.
    pub fn side(&self, mu: f64) -> Side {
        let column = self.albedos.at(mu);
        let left = self.left(&column);
        let boost = self.material.f0.map(|f0| match self.material.lobe {
            Lobe::Normalised => 1.0 / column.e,
            Lobe::Compensated => multiscatter::compensation(f0, column.e, column.loss),
            Lobe::Single | Lobe::KullaConty | Lobe::KullaContyOnce => 1.0,
        });
        let stretched = ggx::stretched_length(self.material.alpha, mu);
        Side { mu, column, left, stretched, boost, factor: self.factor(mu, &left) }
    }

    /// What this surface knows of a direction of which another one, of the same lobe, knows
    /// `common`: the same but for its own factor.
    pub fn own_side(&self, common: &Side) -> Side {
        Side { factor: self.factor(common.mu, &common.left), ..*common }
    }

    /// The BRDF between two directions above the horizon, each with its [`Side`].
    pub fn between(&self, light: &Side, view: &Side, to_light: Vec3, to_view: Vec3) -> Parts {
        let facet = Facet::between(to_light, to_view);
        Parts { specular: self.specular(light, view, &facet), base: self.base(light, view, &facet) }
    }

    /// The specular part, the same for every base.
    pub fn specular(&self, light: &Side, view: &Side, facet: &Facet) -> [f64; 3] {
        let lobe = ggx::distribution(self.material.alpha, facet.half)
            * ggx::visibility(self.material.smith, view.mu, view.stretched, light.mu, light.stretched);
        let reflectance = self.reflectance(facet.complement);
        let second =
            multiscatter::kulla_conty(light.column.loss, view.column.loss, self.albedos.average.loss);
        self.channels(|i| lobe * reflectance[i] * view.boost[i] + second * self.series[i])
    }

    /// A value for each channel; of a grey surface it is computed once.
    fn channels(&self, f: impl Fn(usize) -> f64) -> [f64; 3] {
        if self.grey { [f(0); 3] } else { [0, 1, 2].map(f) }
    }

    /// Whether the base depends on more than the two cosines.
    pub fn knows_facets(&self) -> bool {
        matches!(&self.material.base, Some(Base { coupling: Coupling::HalfVector, .. }))
    }

    /// Albedo of the specular lobe as it is drawn, by channel: 1 - left.
    pub fn specular_albedo(&self, mu: f64) -> [f64; 3] {
        self.left(&self.albedos.at(mu)).map(|left| 1.0 - left)
    }

    /// Average of what the specular lobe leaves over the hemisphere, by channel.
    pub fn left_average(&self) -> [f64; 3] {
        self.left_avg
    }

    /// Reflectance of a facet at the complement of a cosine, 1 - cosine.
    fn reflectance(&self, complement: f64) -> [f64; 3] {
        self.channels(|i| fresnel::schlick(self.material.f0[i], complement))
    }

    /// 1 less the albedo of the specular lobe as it is drawn. With k = E less the albedo of the
    /// bare lobe, g A: single loss + k; normalised k/E; compensated
    /// k + loss (1 - f0 (1 - k/E)); Kulla-Conty k + loss (1 - series).
    fn left(&self, at: &Column) -> [f64; 3] {
        self.channels(|i| {
            let kept = (1.0 - self.material.f0[i]) * (at.e - at.b);
            match self.material.lobe {
                Lobe::Single => at.loss + kept,
                Lobe::Normalised => kept / at.e,
                Lobe::Compensated => kept + at.loss * (1.0 - self.material.f0[i] * (1.0 - kept / at.e)),
                Lobe::KullaConty | Lobe::KullaContyOnce => kept + at.loss * self.absorbed[i],
            }
        })
    }

    /// Factor of the base for couplings of one side; 0 for the others.
    fn factor(&self, mu: f64, left: &[f64; 3]) -> [f64; 3] {
        let Some(base) = &self.material.base else { return [0.0; 3] };
        let alpha = self.material.alpha;
        let roughness = alpha.sqrt();
        let reflectance = self.reflectance(1.0 - mu);
        self.channels(|i| match &base.coupling {
            Coupling::None => 1.0,
            Coupling::OneMinusF0 => 1.0 - self.material.f0[i],
            Coupling::OneMinusFresnel => 1.0 - reflectance[i],
            Coupling::SchlickRoughness => diffuse::schlick_roughness(self.material.f0[i], roughness, mu),
            Coupling::Pesce => diffuse::pesce(self.material.f0[i], reflectance[i], roughness),
            Coupling::OneMinusOwnSpecular => left[i],
            Coupling::Factor(factor) => {
                factor.at(&FactorAt { roughness, alpha, mu, f0: self.material.f0[i] })
            }
            Coupling::Symmetrised(factor) => {
                let mu = mu.max(factor.least_mu());
                factor.at(&FactorAt { roughness, alpha, mu, f0: self.material.f0[i] })
            }
            Coupling::FresnelProduct
            | Coupling::HalfVector
            | Coupling::AshikhminShirley
            | Coupling::Dassault
            | Coupling::Kelemen
            | Coupling::Interreflected => 0.0,
        })
    }

    /// The base. Only a coupling that [`Surface::knows_facets`] depends on the facet.
    pub fn base(&self, light: &Side, view: &Side, facet: &Facet) -> [f64; 3] {
        let Some(base) = &self.material.base else { return [0.0; 3] };
        let reflectance = if self.knows_facets() { self.reflectance(facet.complement) } else { [0.0; 3] };
        self.channels(|i| {
            let (f0, rho) = (self.material.f0[i], base.albedo[i]);
            let factor = match &base.coupling {
                Coupling::FresnelProduct => diffuse::fresnel_product(f0, light.mu, view.mu),
                Coupling::HalfVector => 1.0 - reflectance[i],
                Coupling::AshikhminShirley => diffuse::ashikhmin_shirley(f0, light.mu, view.mu),
                Coupling::Kelemen => diffuse::kelemen(light.left[i], view.left[i], self.left_avg[i]),
                Coupling::Interreflected => {
                    diffuse::interreflected(rho, light.left[i], view.left[i], self.left_avg[i])
                }
                Coupling::Symmetrised(_) => {
                    diffuse::kelemen(light.factor[i], view.factor[i], self.factor_avg[i])
                }
                Coupling::Dassault => diffuse::dassault(f0, self.material.alpha, light.mu, view.mu),
                Coupling::None
                | Coupling::OneMinusF0
                | Coupling::OneMinusFresnel
                | Coupling::SchlickRoughness
                | Coupling::Pesce
                | Coupling::OneMinusOwnSpecular
                | Coupling::Factor(_) => view.factor[i],
            };
            rho * FRAC_1_PI * factor
        })
    }
}

fn fits(material: &Material, albedos: &Albedos) -> Result<(), SurfaceError> {
    let refuse = |property: &str, wanted: String, found: String| {
        Err(SurfaceError::Refused(format!(
            ": the material has {property} {wanted}, the albedos handed in are for {found}"
        )))
    };
    if material.smith != albedos.smith {
        return refuse("shadowing", material.smith.name().into(), albedos.smith.name().into());
    }
    if material.alpha != albedos.alpha {
        return refuse("alpha", format!("{:?}", material.alpha), format!("{:?}", albedos.alpha));
    }
    Ok(())
}
