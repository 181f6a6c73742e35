//! What a formula of a quantity is used as. The use decides what its error is.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{QUANTITIES, Quantity};

/// What a formula of an output of a quantity is used as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Use {
    /// The word in options and in the manifest.
    pub name: &'static str,
    /// What the formula is then, in words.
    pub meaning: &'static str,
    /// What its error is.
    pub metric: &'static str,
    /// The error in numbers.
    pub residual: Residual,
    /// Whether the formula has an argument f0 that the quantity does not have, and blends between
    /// the outputs B and E.
    pub blends: bool,
}

/// The error of a formula f whose truth is t.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Residual {
    /// f - t.
    Difference,
    /// t f - 1.
    Product,
    /// f / t - 1.
    Quotient,
}

impl Residual {
    /// Scale and target for a truth: the error is scale f - target.
    pub fn scaled(self, truth: f64) -> [f64; 2] {
        match self {
            Residual::Difference => [1.0, truth],
            Residual::Product => [truth, 1.0],
            Residual::Quotient => [1.0 / truth, 1.0],
        }
    }

    /// The error of a formula whose truth is this.
    pub fn of(self, value: f64, truth: f64) -> f64 {
        let [scale, target] = self.scaled(truth);
        scale * value - target
    }

    /// The value without an error.
    pub fn ideal(self, truth: f64) -> f64 {
        match self {
            Residual::Difference | Residual::Quotient => truth,
            Residual::Product => 1.0 / truth,
        }
    }
}

impl Use {
    /// As the output itself.
    pub const VALUE: Use = Use {
        name: "value",
        meaning: "the column itself",
        metric: "absolute error",
        residual: Residual::Difference,
        blends: false,
    };

    /// As N with E N = 1 of an albedo E.
    pub const NORMALISATION: Use = Use {
        name: "normalisation",
        meaning: "N with E N = 1 of an albedo E, error |E N - 1|",
        metric: "furnace error |E N - 1|",
        residual: Residual::Product,
        blends: false,
    };

    /// As f0 A + B = mix(B, E, f0), of a lobe with Schlick's Fresnel.
    pub const F0_BLEND: Use = Use {
        name: "f0-blend",
        meaning: "f0 A + B = mix(B, E, f0), argument f0",
        metric: "error of f0 A + B, for the worst f0",
        residual: Residual::Difference,
        blends: true,
    };

    /// The uses of every quantity, each once, in the order of the quantities.
    pub fn all() -> Vec<Use> {
        let mut all = Vec::new();
        for (quantity, column) in columns() {
            let more = quantity.uses(column).iter().filter(|one| !all.contains(*one));
            all.extend(more.collect::<Vec<_>>());
        }
        all
    }

    /// The use of a name.
    pub fn of(name: &str) -> Option<Use> {
        Use::all().into_iter().find(|one| one.name == name)
    }

    /// Quantities with the column that has this use, as `ggx-reflection:E`; those of one quantity
    /// where it has any.
    pub fn suits(self, first: &'static dyn Quantity) -> Vec<String> {
        let having: Vec<(&'static dyn Quantity, &str)> =
            columns().filter(|(quantity, column)| quantity.uses(column).contains(&self)).collect();
        let own = having.iter().any(|(quantity, _)| *quantity == first);
        let suits = having.into_iter().filter(|(quantity, _)| !own || *quantity == first);
        suits.map(|(quantity, column)| format!("{}:{column}", quantity.name())).collect()
    }
}

/// Every output but the error of every quantity.
fn columns() -> impl Iterator<Item = (&'static dyn Quantity, &'static str)> {
    QUANTITIES.into_iter().flat_map(|quantity| {
        let columns = quantity.outputs().iter().filter(|column| **column != "error");
        columns.map(move |column| (quantity, *column))
    })
}

impl Serialize for Use {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

impl<'de> Deserialize<'de> for Use {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Use, D::Error> {
        let name = String::deserialize(deserializer)?;
        Use::of(&name).ok_or_else(|| D::Error::custom(format!("no use is called {name}")))
    }
}
