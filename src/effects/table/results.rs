//! Tables with slices as the page of their effect shows them.

use serde::Serialize;

use crate::data::Cost;
use crate::report::sections::words;
use crate::report::{EffectFinding, ErrorFigure, Field, Furnace, Offer, Origin, Role, TableFinding};

/// What a bake found out about an effect whose tables have slices.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SlicedFindings {
    /// What made it.
    pub origin: Origin,
    /// What called for it.
    pub effect: EffectFinding,
    /// The tables.
    pub tables: Vec<TableFinding>,
    /// The path tracer's method beside ours; none without a table in its layout.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path_tracer: Option<PathTracerFinding>,
    /// Truths over roughness and mu at some slices, which their names tell.
    pub truths: Vec<Field>,
    /// What a shader gets from each layout.
    pub furnaces: Vec<FurnaceFinding>,
    /// What the mean over the azimuth of the view costs, a finding for each domain of tables.
    #[serde(rename = "azimuth", skip_serializing_if = "Vec::is_empty")]
    pub ways: Vec<WaysFinding>,
}

/// What the tables in the path tracer's layout took, and what its own method takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PathTracerFinding {
    /// Texels of the tables.
    pub texels: u64,
    /// Integrand evaluations of ours, checks included.
    pub evaluations: u64,
    /// Worst difference of our texels from direct integrals at those checked, before rounding to
    /// the texel format.
    pub worst: f64,
    /// Samples that the path tracer draws for all texels.
    pub samples: f64,
    /// Standard error that these leave, root mean square over texels spread over the table:
    /// measured with fewer samples and scaled.
    pub noise: f64,
}

/// Spheres under one condition.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FurnaceFinding {
    /// The condition: `anisotropy 0.5`, `index of refraction 1.5, from inside`.
    pub title: String,
    /// The spheres; rows are lookups.
    pub furnace: Furnace,
}

/// What a table of the azimuth's mean leaves out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WaysFinding {
    /// Where the errors are the largest of: `roughness 0.02 to 1, anisotropy 0 to 1`.
    pub domain: String,
    /// Where the fields are drawn: `roughness 0.7, anisotropy 1`.
    pub at: String,
    /// Error over azimuth and mu of each way.
    pub fields: Vec<Field>,
    /// Each way: name, largest error over the domain, root mean square, bytes of texels.
    pub ways: Vec<Way>,
}

impl WaysFinding {
    /// The functions of means, each with what it is off by at one azimuth and the function that is
    /// not.
    pub fn cautions(&self) -> impl Iterator<Item = (String, String)> + '_ {
        let resolved = self.ways.iter().filter(|way| way.resolved);
        let best = resolved.min_by(|a, b| a.error.max.total_cmp(&b.error.max));
        let instead = best.map_or_else(String::new, |way| {
            format!(
                "; {} takes the azimuth and is off by at most {}",
                way.function,
                words::max(way.error.max)
            )
        });
        self.ways.iter().filter(|way| !way.resolved).map(move |way| {
            let text = format!(
                "It returns the mean of E over the azimuth of the view: at one azimuth E is off by at most {}{instead}.",
                words::max(way.error.max)
            );
            (way.function.clone(), text)
        })
    }
}

impl WaysFinding {
    /// The function that is off by least, and the mean that takes fewer operations in its place.
    pub fn cheaper(&self) -> Option<(String, Offer)> {
        let best = self.ways.iter().filter(|way| way.resolved);
        let best = best.min_by(|a, b| a.error.max.total_cmp(&b.error.max))?;
        let means = self.ways.iter().filter(|way| !way.resolved && way.ops < best.ops);
        let mean = means.min_by_key(|way| way.ops)?;
        let cost = Cost { ops: mean.ops, fetches: 1, bytes: mean.bytes };
        let error = mean.error.rms.map(|rms| [mean.error.max, rms]);
        let offer = Offer {
            note: "It returns the mean over the azimuth of the view; the error is that of taking it at one azimuth."
                .into(),
            ..Offer::new(Role::Cheap, &mean.table, Some(mean.function.clone()), (cost, error))
        };
        Some((best.function.clone(), offer))
    }
}

/// One way to get E at an azimuth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Way {
    /// Its name.
    pub name: String,
    /// Its table.
    #[serde(skip)]
    pub table: String,
    /// The function that looks it up.
    #[serde(skip)]
    pub function: String,
    /// Whether it holds the azimuth.
    #[serde(skip)]
    pub resolved: bool,
    /// Its error over the whole domain.
    pub error: ErrorFigure,
    /// Bytes of texels.
    pub bytes: u64,
    /// Operations beside the fetch.
    pub ops: u32,
}
