//! What a reader takes from a bake: for each thing that an effect makes, what there is to choose.

use serde::{Deserialize, Serialize};

use super::Furnace;
use crate::data::Cost;

/// The answer of one effect.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// Name of the effect.
    pub effect: String,
    /// What was found, in one sentence; empty where nothing is called.
    pub conclusion: String,
    /// A sentence for each of the purposes that it leaves out.
    pub also: Vec<String>,
    /// For each thing that it makes.
    pub purposes: Vec<Purpose>,
}

/// What approximations of one column of a quantity, made for one use, there are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Purpose {
    /// Name: the function that is recommended.
    pub name: String,
    /// What it is, in words.
    pub about: String,
    /// What its error does not say of it, in sentences; empty where the error says all.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub caution: String,
    /// What its error is, in words.
    pub metric: String,
    /// What error the scene limits, in words, where that is another; else empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub limited: String,
    /// At most one of each role.
    pub choices: Vec<Offer>,
    /// Every approximation, ours and published.
    pub measured: Vec<Measured>,
    /// Spheres in a white environment: without compensation, then a row for each choice that has
    /// one, named as its role.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub furnace: Option<Furnace>,
    /// Whether it is called beside the purpose before it, from the other side of the same surface.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_other_side: bool,
}

impl Purpose {
    /// What an error of it is: that which the scene limits, if that is another.
    pub fn kept(&self) -> &str {
        if self.limited.is_empty() { &self.metric } else { &self.limited }
    }
}

/// What a choice is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Fewer operations than the cheap.
    Cheapest,
    /// Fewer operations than the recommended, at a larger error.
    Cheap,
    /// What the scene's promises ask for.
    Recommended,
    /// More operations than the recommended, for who can afford them.
    Accurate,
    /// A fetch instead of arithmetic.
    Table,
}

impl Role {
    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Role::Cheapest => "cheapest",
            Role::Cheap => "cheap",
            Role::Recommended => "recommended",
            Role::Accurate => "accurate",
            Role::Table => "table",
        }
    }
}

/// Something to call.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Offer {
    /// What for.
    pub role: Role,
    /// Name of the approximation.
    pub name: String,
    /// The emitted function; none where this scene does not emit it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub function: Option<String>,
    /// Largest and root mean square error; none of what has no certificate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<[f64; 2]>,
    /// What the error is of, where it is not that of the purpose.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub metric: String,
    /// The error that the scene limits, where that is another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limited: Option<f64>,
    /// What a reader should know before taking it, in a sentence; empty where its figures say all.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
    /// Cost of a call.
    pub cost: Cost,
    /// Operations of its form for three channels, where a material calls that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coloured: Option<u32>,
    /// Its code by language, where it is not emitted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub code: Vec<(String, String)>,
    /// What a scene says to have it, where it is not emitted and longer than code to copy.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub asked: String,
}

impl Offer {
    /// Of an emitted function or none: what it costs and what it is off by.
    pub fn new(
        role: Role,
        name: &str,
        function: Option<String>,
        (cost, error): (Cost, Option<[f64; 2]>),
    ) -> Offer {
        Offer {
            role,
            name: name.into(),
            function,
            error,
            metric: String::new(),
            limited: None,
            note: String::new(),
            cost,
            coloured: None,
            code: Vec::new(),
            asked: String::new(),
        }
    }

    /// The error that a scene limits.
    pub fn kept(&self) -> Option<f64> {
        self.limited.or(self.error.map(|[max, _]| max))
    }
}

/// A measured approximation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Name.
    pub name: String,
    /// Operations.
    pub ops: u32,
    /// Largest and root mean square error.
    pub error: [f64; 2],
    /// The error that the scene limits, where that is another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limited: Option<f64>,
    /// Somebody else's.
    pub published: bool,
    /// A table.
    pub table: bool,
}
