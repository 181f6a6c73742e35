//! Values over the reflectance f0 at normal incidence, from two numbers of a lobe: its albedo
//! E = A + B, and B, the albedo at f0 = 0 by Schlick's Fresnel.

use super::Quantity;

/// How the values of a quantity for every f0 are made of E and B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverF0 {
    /// The quantity with the outputs E and B.
    pub lobe: &'static dyn Quantity,
    /// What is made of them.
    pub form: F0Form,
}

/// A value made of E = A + B and the loss L = 1 - E, with g = 1 - f0 and a = A/E.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum F0Form {
    /// f0 A + B = f0 E + g B: the albedo.
    Albedo,
    /// L + g A: 1 less the albedo.
    Rest,
    /// g a.
    Share,
    /// g (a + L (1 - g a)).
    Recycled,
}

/// The parts of an albedo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts {
    /// E.
    pub e: f64,
    /// A.
    pub a: f64,
    /// B.
    pub b: f64,
    /// 1 - E.
    pub loss: f64,
}

impl Parts {
    /// The parts of E and B.
    pub fn new(e: f64, b: f64) -> Parts {
        Parts { e, a: e - b, b, loss: 1.0 - e }
    }
}

impl F0Form {
    /// The value at f0 in [0, 1]; E above 0.
    pub fn value(self, Parts { e, a, b, loss }: Parts, f0: f64) -> f64 {
        let g = 1.0 - f0;
        match self {
            F0Form::Albedo => f0 * e + g * b,
            F0Form::Rest => loss + g * a,
            F0Form::Share => g * (a / e),
            F0Form::Recycled => g * (a / e + loss * (1.0 - g * (a / e))),
        }
    }

    /// Whether the value is affine in f0.
    pub fn is_affine(self) -> bool {
        self != F0Form::Recycled
    }
}
