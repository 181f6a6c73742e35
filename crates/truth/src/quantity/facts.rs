//! What is said of a quantity in data.

use super::Choice;
use crate::integrate::monte_carlo::Draw;

/// An input: a number of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// Its name, in files of points the name of its column.
    pub name: &'static str,
    /// Smallest and largest value.
    pub domain: [f64; 2],
    /// The range of a fit that asks for none.
    pub usual: [f64; 2],
    /// Whether it is a ratio: points are even in its logarithm.
    pub is_ratio: bool,
    /// Values at which ways to compute a quantity are compared: an easy one and a hard one.
    pub studied: [f64; 2],
    /// Whether it may be absent. `Quantity::at` then takes a NaN in its place, and the truth is
    /// the mean over the input.
    pub optional: bool,
}

impl Input {
    /// An input that must be given; its usual range is what [0, 1] has of the domain.
    pub const fn new(name: &'static str, domain: [f64; 2]) -> Input {
        let all = Input { name, domain, usual: domain, studied: domain, is_ratio: false, optional: false };
        all.usually([domain[0].max(0.0), domain[1].min(1.0)])
    }

    /// The same with another usual range; it is studied in its middle and near its lower end.
    pub const fn usually(self, usual: [f64; 2]) -> Input {
        let [low, high] = usual;
        Input { usual, studied: [0.5 * (low + high), low + (high - low) / 64.0], ..self }
    }

    /// The same, studied at an easy and at a hard value.
    pub const fn studied(self, studied: [f64; 2]) -> Input {
        Input { studied, ..self }
    }
}

/// What is said of a quantity whatever its variant.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// Its name, as `ggx-reflection`.
    pub name: &'static str,
    /// Its inputs, in the order in which `Quantity::at` takes them.
    pub inputs: &'static [Input],
    /// Its outputs, in the order in which `Quantity::at` gives them; the last is the error.
    pub outputs: &'static [&'static str],
    /// What a variant of it says. Nothing else of a [`Variant`](super::Variant) is looked at.
    pub choices: &'static [Choice],
    /// The largest error where no tolerance is asked for: the quantity's promise.
    pub tolerance: f64,
    /// The smallest alpha above 0 at which there is a truth. At 0 itself, a mirror, there may be
    /// one all the same.
    pub smallest_alpha: f64,
    /// The Fresnel term of the lobe whose directional albedo is its output E, if any.
    pub fresnel: Option<Fresnel>,
    /// Whether its values change most where mu is about alpha, as those of a microfacet lobe do;
    /// else where mu is about the roughness.
    pub changes_at_alpha: bool,
    /// A remark for who lists the quantities; empty where inputs and outputs say all.
    pub remark: &'static str,
    /// What `Quantity::second_opinion` may draw; empty where it draws in a way of its own, whatever the
    /// run says.
    pub draws: &'static [Draw],
}

impl Facts {
    /// Of a quantity that has none of this.
    pub const NONE: Facts = Facts {
        name: "",
        inputs: &[],
        outputs: &[],
        choices: &[],
        tolerance: 0.0,
        smallest_alpha: 0.0,
        fresnel: None,
        changes_at_alpha: true,
        remark: "",
        draws: &[],
    };
}

/// The Fresnel term in an albedo.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fresnel {
    /// F = 1.
    One,
    /// The exact term of a dielectric.
    Dielectric,
}
