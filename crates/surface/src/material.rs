//! A material: a GGX lobe over a diffuse base.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use lobefit_shade::Hypothesis;
use lobefit_truth::optics::Smith;

use crate::SurfaceError;
use crate::albedos::{ALPHA, check};

/// What becomes of the specular lobe of single scattering. E is the lobe's albedo for F = 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Lobe {
    /// It is drawn as it is.
    Single,
    /// Divided by E(v) (Pesce 2019).
    Normalised,
    /// Times 1 + f0 (1/E(v) - 1) (Fdez-Aguera 2019; Turquin 2019).
    Compensated,
    /// A second lobe is added (Kulla and Conty 2017), coloured by the series from the second
    /// reflection on, F_avg^2 E_avg/(1 - F_avg (1 - E_avg)).
    KullaConty,
    /// The same with the series from the first reflection on, F_avg E_avg/(1 - F_avg (1 - E_avg)),
    /// as some engines write it.
    KullaContyOnce,
}

impl Lobe {
    /// All of them.
    pub const ALL: [Lobe; 5] =
        [Lobe::Single, Lobe::Normalised, Lobe::Compensated, Lobe::KullaConty, Lobe::KullaContyOnce];

    /// The word used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Lobe::Single => "single",
            Lobe::Normalised => "normalised",
            Lobe::Compensated => "compensated",
            Lobe::KullaConty => "kulla-conty",
            Lobe::KullaContyOnce => "kulla-conty, from the first",
        }
    }

    /// What becomes of the lobe in a formula that a reader of tables can follow.
    pub fn meaning(self) -> &'static str {
        match self {
            Lobe::Single => "D G F/(4 n·l n·v) as it is: loses the light that facets send to one another",
            Lobe::Normalised => "divided by E(v), the albedo of the single lobe with F = 1 (Pesce 2019)",
            Lobe::Compensated => "times 1 + f0 (1/E(v) − 1) (Fdez-Agüera 2019; Turquin 2019)",
            Lobe::KullaConty => {
                "a second lobe is added (Kulla and Conty 2017), coloured by all reflections from the second on, \
                 F_avg² E_avg/(1 − F_avg (1 − E_avg))"
            }
            Lobe::KullaContyOnce => {
                "the same coloured by all reflections from the first on, F_avg E_avg/(1 − F_avg (1 − E_avg)), as some engines write it"
            }
        }
    }

    /// Whether f(l, v) = f(v, l) by its formula.
    pub fn is_reciprocal(self) -> bool {
        matches!(self, Lobe::Single | Lobe::KullaConty | Lobe::KullaContyOnce)
    }
}

/// What the diffuse base is multiplied with. F is Fresnel's reflectance of the material,
/// mu_v = n.v.
#[derive(Clone, Debug, PartialEq)]
pub enum Coupling {
    /// 1.
    None,
    /// 1 - f0.
    OneMinusF0,
    /// 1 - F(n.v).
    OneMinusFresnel,
    /// (21/20)(1 - F(l))(1 - F(v))/(1 - f0) with Schlick's F.
    FresnelProduct,
    /// 1 - F(v.h), as glTF's appendix B.
    HalfVector,
    /// Ashikhmin and Shirley 2000.
    AshikhminShirley,
    /// The product of what the lobe of the Enterprise PBR Shading Model leaves at l and at v, by
    /// its own fit (Dassault Systemes).
    Dassault,
    /// 1 less Schlick's Fresnel with a roughness term.
    SchlickRoughness,
    /// mix(1 - F(n.v), 1 - f0, roughness) (Pesce 2019).
    Pesce,
    /// 1 less the albedo of the specular lobe as it is drawn, at v: exact in energy for a white
    /// base.
    OneMinusOwnSpecular,
    /// The reciprocal product of what the specular lobe, as it is drawn, leaves at l and at v, over
    /// its average (Kelemen and Szirmay-Kalos 2001): exact in energy for a white base.
    Kelemen,
    /// The same with the light that goes back and forth between base and lobe: the one that knows
    /// the base's albedo.
    Interreflected,
    /// A formula of (roughness, alpha, mu, f0), at v.
    Factor(Factor),
    /// Such a formula made reciprocal, f(l) f(v)/f_avg: as the average of f(l) is f_avg, it sends
    /// back f(v) of a white base as the formula does, with the same error in the furnace. f_avg is
    /// a constant of the material. Below [`Factor::least_mu`] f is taken there.
    Symmetrised(Factor),
}

impl Coupling {
    /// All but formulas.
    pub const ALL: [Coupling; 12] = [
        Coupling::None,
        Coupling::OneMinusF0,
        Coupling::OneMinusFresnel,
        Coupling::FresnelProduct,
        Coupling::HalfVector,
        Coupling::AshikhminShirley,
        Coupling::Dassault,
        Coupling::SchlickRoughness,
        Coupling::Pesce,
        Coupling::OneMinusOwnSpecular,
        Coupling::Kelemen,
        Coupling::Interreflected,
    ];

    /// The words used in tables.
    pub fn name(&self) -> Cow<'_, str> {
        let name = match self {
            Coupling::None => "none",
            Coupling::OneMinusF0 => "1 - f0",
            Coupling::OneMinusFresnel => "1 - F(n.v)",
            Coupling::FresnelProduct => "21/20 (1 - F(l))(1 - F(v))",
            Coupling::HalfVector => "1 - F(v.h)",
            Coupling::AshikhminShirley => "Ashikhmin-Shirley",
            Coupling::Dassault => "Dassault",
            Coupling::SchlickRoughness => "1 - Schlick-roughness",
            Coupling::Pesce => "Pesce 2019",
            Coupling::OneMinusOwnSpecular => "1 - own specular",
            Coupling::Kelemen => "Kelemen-Szirmay-Kalos",
            Coupling::Interreflected => "Kelemen, with the base's albedo",
            Coupling::Factor(factor) => &factor.name,
            Coupling::Symmetrised(factor) => return Cow::Owned(format!("{}, reciprocal", factor.name)),
        };
        Cow::Borrowed(name)
    }

    /// The factor of the base in a formula that a reader of tables can follow.
    pub fn meaning(&self) -> Cow<'_, str> {
        let text = match self {
            Coupling::None => "1",
            Coupling::OneMinusF0 => "1 − f0",
            Coupling::OneMinusFresnel => "1 − F(n·v), Schlick’s Fresnel at the view",
            Coupling::FresnelProduct => "21/20 (1 − F(n·l))(1 − F(n·v))/(1 − f0)",
            Coupling::HalfVector => "1 − F(v·h), Fresnel of the facet, as in appendix B of glTF",
            Coupling::AshikhminShirley => {
                "28/23 (1 − f0)(1 − (1 − n·l/2)⁵)(1 − (1 − n·v/2)⁵) (Ashikhmin and Shirley 2000)"
            }
            Coupling::Dassault => {
                "(1 − E(l))(1 − E(v))/(1 − E_avg) by the fits of the Enterprise PBR Shading Model (Dassault Systèmes)"
            }
            Coupling::SchlickRoughness => {
                "1 − f0 − (max(1 − roughness, f0) − f0)(1 − n·v)⁵, Schlick’s Fresnel with a roughness term"
            }
            Coupling::Pesce => "mix(1 − F(n·v), 1 − f0, roughness) (Pesce 2019)",
            Coupling::OneMinusOwnSpecular => {
                "1 less the albedo of the lobe above, as it is drawn, at the view: exact in energy"
            }
            Coupling::Kelemen => {
                "left(l) left(v)/left_avg, left = 1 less the albedo of the lobe above, as it is drawn (Kelemen and Szirmay-Kalos 2001): \
                 exact in energy and reciprocal"
            }
            Coupling::Interreflected => {
                "left(l) left(v)/(1 − ρ (1 − left_avg)): the same with the light that goes back and forth between lobe and a base of albedo ρ"
            }
            Coupling::Factor(_) => "a formula of roughness, n·v and f0",
            Coupling::Symmetrised(factor) => {
                return Cow::Owned(format!("f(l) f(v)/f_avg with the formula f = {}", factor.name));
            }
        };
        Cow::Borrowed(text)
    }

    /// Whether f(l, v) = f(v, l) by its formula.
    pub fn is_reciprocal(&self) -> bool {
        !matches!(
            self,
            Coupling::OneMinusFresnel
                | Coupling::SchlickRoughness
                | Coupling::Pesce
                | Coupling::OneMinusOwnSpecular
                | Coupling::Factor(_)
        )
    }
}

/// Where a factor is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorAt {
    /// sqrt(alpha).
    pub roughness: f64,
    /// GGX alpha.
    pub alpha: f64,
    /// Cosine of the view.
    pub mu: f64,
    /// Reflectance at normal incidence of the channel.
    pub f0: f64,
}

/// A formula for the factor of the base.
#[derive(Clone)]
pub struct Factor {
    name: String,
    ops: Option<u32>,
    least_mu: f64,
    formula: Arc<dyn Fn(&FactorAt) -> f64 + Send + Sync>,
}

impl Factor {
    /// A formula under a name, of unknown cost.
    pub fn new(name: &str, formula: impl Fn(&FactorAt) -> f64 + Send + Sync + 'static) -> Factor {
        Factor { name: name.to_string(), ops: None, least_mu: 0.0, formula: Arc::new(formula) }
    }

    /// A fitted hypothesis of any of the inputs roughness, alpha, mu and f0, evaluated in f64.
    ///
    /// # Errors
    /// Another input; another number of coefficients than the hypothesis has parameters.
    pub fn fitted(name: &str, hypothesis: &Hypothesis, coefficients: &[f32]) -> Result<Factor, SurfaceError> {
        let shape = |what: &str, wanted: String, found: String| SurfaceError::Factor {
            name: name.to_string(),
            what: what.to_string(),
            wanted,
            found,
        };
        let known = ["roughness", "alpha", "mu", "f0"];
        let place = |input: &String| known.iter().position(|k| k == input);
        if let Some(input) = hypothesis.inputs().iter().find(|input| place(input).is_none()) {
            return Err(shape("inputs", known.join(", "), input.clone()));
        }
        let (wanted, found) = (hypothesis.parameters().len(), coefficients.len());
        if wanted != found {
            return Err(shape("coefficients", wanted.to_string(), found.to_string()));
        }
        let order: Vec<usize> = hypothesis.inputs().iter().filter_map(place).collect();
        let (tape, coefficients) = (hypothesis.tape().clone(), coefficients.iter().map(|c| f64::from(*c)));
        let coefficients: Vec<f64> = coefficients.collect();
        let ops = Some(hypothesis.tape().cost_ops());
        let factor = Factor::new(name, move |at| {
            let all = [at.roughness, at.alpha, at.mu, at.f0];
            let inputs: Vec<f64> = order.iter().map(|i| all[*i]).collect();
            tape.at(&inputs, &coefficients)
        });
        Ok(Factor { ops, ..factor })
    }

    /// The same, made for cosines from `least_mu`: [`Coupling::Symmetrised`], which needs it at
    /// every light, takes it there below. A rational formula may have a pole where it was not
    /// fitted.
    pub fn above(self, least_mu: f64) -> Factor {
        Factor { least_mu, ..self }
    }

    /// The least cosine that it is made for.
    pub fn least_mu(&self) -> f64 {
        self.least_mu
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Operations of one evaluation, if they are known.
    pub fn ops(&self) -> Option<u32> {
        self.ops
    }

    /// Its value.
    pub fn at(&self, at: &FactorAt) -> f64 {
        (self.formula)(at)
    }
}

impl fmt::Debug for Factor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Factor").field(&self.name).finish()
    }
}

/// Formulas are the same if they are one and the same.
impl PartialEq for Factor {
    fn eq(&self, other: &Factor) -> bool {
        self.name == other.name && Arc::ptr_eq(&self.formula, &other.formula)
    }
}

/// A diffuse base.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// Albedo by channel, in [0, 1].
    pub albedo: [f64; 3],
    /// What the lobe above leaves for it.
    pub coupling: Coupling,
}

/// A GGX lobe over a diffuse base or over nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Form of the shadowing.
    pub smith: Smith,
    /// GGX alpha, in [1e-4, 1].
    pub alpha: f64,
    /// Reflectance of a facet at normal incidence by channel, in [0, 1]; Schlick's Fresnel beyond.
    pub f0: [f64; 3],
    /// What becomes of the lobe.
    pub lobe: Lobe,
    /// The base.
    pub base: Option<Base>,
}

impl Material {
    /// A metal: no base, Schlick's Fresnel, correlated shadowing.
    pub fn metal(alpha: f64, f0: [f64; 3], lobe: Lobe) -> Material {
        Material { smith: Smith::Correlated, alpha, f0, lobe, base: None }
    }

    /// A white base under Schlick's Fresnel with one f0, correlated shadowing.
    pub fn white(alpha: f64, f0: f64, lobe: Lobe, coupling: Coupling) -> Material {
        let base = Some(Base { albedo: [1.0; 3], coupling });
        Material { smith: Smith::Correlated, alpha, f0: [f0; 3], lobe, base }
    }

    pub(crate) fn check(&self) -> Result<(), SurfaceError> {
        check("alpha", self.alpha, ALPHA)?;
        self.f0.iter().try_for_each(|f0| check("f0", *f0, [0.0, 1.0]))?;
        let albedo = self.base.iter().flat_map(|base| &base.albedo);
        albedo.into_iter().try_for_each(|rho| check("base albedo", *rho, [0.0, 1.0]))
    }
}
