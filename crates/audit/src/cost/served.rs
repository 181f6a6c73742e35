//! What a function serves that formulas of ours serve too, and how far off it is in that.

use std::collections::BTreeMap;

use crate::audit::{Audit, Column, everywhere};

/// A use of a quantity that we have formulas for.
pub(super) struct Served {
    /// The quantity.
    pub quantity: &'static str,
    /// The use, by the manifest's word.
    pub used_as: Use,
    /// What the error is of, for readers.
    pub error: &'static str,
    /// Fields of a material that calls for all these formulas.
    pub material: &'static str,
}

/// What an albedo is used as.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    /// N with E N = 1.
    Normalisation,
    /// f0 A + B.
    Blend,
    /// The albedo itself.
    Value,
}

/// All of them.
const SERVED: [Served; 4] = [
    Served {
        quantity: "ggx-reflection",
        used_as: Use::Normalisation,
        error: "the furnace error |E N - 1|",
        material: r#""wants": {"fit": {}}"#,
    },
    Served {
        quantity: "ggx-reflection",
        used_as: Use::Blend,
        error: "that of f0 A + B for the worst f0",
        material: r#""wants": {"fit": {"blend": true}}"#,
    },
    Served {
        quantity: "ggx-average",
        used_as: Use::Value,
        error: "that of E_avg",
        material: r#""wants": {"fit": {"average": true}}"#,
    },
    Served {
        quantity: "sheen-charlie",
        used_as: Use::Value,
        error: "that of E",
        material: r#""sheen": {"roughness": [0.1, 1]}, "wants": {"fit": {}}"#,
    },
];

/// What a function serves by its best reading; none where we have no formula for it.
pub(super) fn served(audit: &Audit) -> Option<&'static Served> {
    let used_as = |of: &&Served| of.quantity == audit.quantity && of.used_as.error(audit, 0).is_some();
    // A and B are for any f0: E of their sum is not all that they are used as.
    SERVED.iter().filter(used_as).max_by_key(|of| of.used_as == Use::Blend)
}

impl Use {
    /// The manifest's word.
    pub fn word(self) -> &'static str {
        match self {
            Use::Normalisation => "normalisation",
            Use::Blend => "f0-blend",
            Use::Value => "value",
        }
    }

    /// The largest error over the places of a domain; infinite where a normalisation by an albedo of
    /// 0 or less is called for; none where no place lies in it.
    pub fn worst(self, audit: &Audit, domain: &BTreeMap<String, [f64; 2]>) -> Option<f64> {
        let axes = audit.best().axes.iter().zip(&audit.places).zip(&audit.size);
        let along = axes.map(|((axis, places), size)| -> Vec<bool> {
            let range = domain.get(axis.scale.input().name());
            let within = |x: f64| range.is_none_or(|[low, high]| (*low..=*high).contains(&x));
            places.iter().map(|i| within(axis.node(*i, *size))).collect()
        });
        let along: Vec<Vec<bool>> = along.collect();
        let inside = everywhere(along.iter().map(Vec::as_slice));
        let places = (0..inside.len()).filter(|place| inside[*place]);
        let errors = places.map(|place| self.error(audit, place));
        errors.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::max)
    }

    /// The magnitude of the error at a place; none where the channels are not for this use.
    fn error(self, audit: &Audit, place: usize) -> Option<f64> {
        let held = |wanted: &dyn Fn(Column) -> bool| {
            audit.channels.iter().find(|channel| channel.column.is_some_and(wanted))
        };
        let off = |column: Column| Some(held(&|own| own == column)?.map[place]);
        if self == Use::Blend {
            let bias = off(Column::B)?;
            let albedo = off(Column::E).or_else(|| Some(off(Column::A)? + bias))?;
            return Some(bias.abs().max(albedo.abs()));
        }
        let normal = [Column::Normal, Column::NormalLoss];
        let channel = held(&|own| own.albedo(0.5).is_some() && !normal.contains(&own))?;
        let (column, truth) = (channel.column?, channel.truth[place]);
        let (held, truth) = (column.albedo(truth + channel.map[place])?, column.albedo(truth)?);
        Some(match self {
            Use::Value => (held - truth).abs(),
            _ if held > 0.0 => (truth / held - 1.0).abs(),
            _ => f64::INFINITY,
        })
    }
}
