//! What to bake, and what came of it.

use serde::{Deserialize, Serialize};

use super::{Region, SliceAxis};
use crate::data::{Axis, Channel, Decode, Layout, Serves, Smith, Table, TableError, TexelFormat, Warp};

/// Tables to bake that share their integrals: one for each side.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// Names of the tables.
    pub names: Vec<String>,
    /// Shadowing form.
    pub smith: Smith,
    /// Texels along each axis, at least 2.
    pub size: Vec<usize>,
    /// Texel format.
    pub format: TexelFormat,
    /// Coordinates.
    pub layout: Layout,
    /// What the table is looked up for.
    pub serves: Serves,
    /// Where the lookup must hold.
    pub region: Region,
}

impl Spec {
    /// How a texel becomes E.
    pub fn decode(&self) -> Decode {
        Decode::of(self.layout, self.serves)
    }

    /// The size, of as many axes as the family's tables have.
    ///
    /// # Errors
    /// Another number of axes.
    pub fn sizes<const AXES: usize>(&self) -> Result<[usize; AXES], BuildError> {
        let axes = || BuildError::Axes { table: self.names.join(" "), axes: self.size.len() };
        self.size.as_slice().try_into().map_err(|_| axes())
    }

    /// The error of a layout that a family does not have.
    pub(in crate::effects) fn no_layout(&self) -> BuildError {
        BuildError::Layout { table: self.names.join(" "), layout: self.layout.name() }
    }

    /// A table of channels for each name. An axis of one texel, the last one, is none of the table's.
    pub(in crate::effects) fn tables(
        &self,
        quantity: &str,
        axes: &[Axis],
        channels: Vec<Vec<Channel>>,
    ) -> Result<Vec<Table>, BuildError> {
        let axes: Vec<Axis> = axes.iter().filter(|axis| axis.size > 1).cloned().collect();
        let table = |(name, channels): (&String, Vec<Channel>)| {
            let table = Table {
                name: name.clone(),
                quantity: quantity.into(),
                smith: Some(self.smith),
                alpha_map: self.region.alpha_map,
                axes: axes.clone(),
                channels,
                format: self.format,
            };
            table.validate()?;
            Ok(table)
        };
        self.names.iter().zip(channels).map(table).collect()
    }
}

/// What a table or a set of truths took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Made {
    /// Integrand evaluations, checks included; 0 where they are not counted.
    pub evaluations: u64,
    /// Worst difference from direct integrals with more nodes at the points checked, the tolerance
    /// of those added where they are no tighter; of integrals that are direct themselves, their
    /// tolerance.
    pub integration: f64,
}

/// Why a table could not be made or measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] lobefit_truth::integrate::IntegrateError),
    /// A table's shape or values.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A table cannot be read.
    #[error(transparent)]
    Lookup(#[from] super::LookupError),
    /// A size of another number of axes.
    #[error("table {table}: a size of {axes} axes, which the layout does not have")]
    Axes {
        /// Table's name.
        table: String,
        /// Axes given.
        axes: usize,
    },
    /// A region without slices where the table has them.
    #[error("a table with slices has no range of them")]
    Slices,
    /// A layout that the effect does not have.
    #[error("table {table}: the {layout} layout is not one of this effect")]
    Layout {
        /// Table's name.
        table: String,
        /// The layout.
        layout: &'static str,
    },
}

/// Nodes in ln(alpha) for targets that are interpolated to about 1e-4, which
/// [`check`](super::check) measures: E has its nearest singularities at imaginary part pi/2
/// (alpha^2 negative), so n nodes on a range of half length h leave exp(-n asinh(pi/(2 h))); at
/// least 8.
pub(in crate::effects) fn alpha_nodes(alpha: [f64; 2]) -> usize {
    use lobefit_math::ops;
    let rate = ops::asinh(std::f64::consts::PI / ops::log(alpha[1] / alpha[0]).max(1e-3));
    ((ops::log(2e4) / rate).ceil() as usize).max(8)
}

/// Smallest index of refraction from which slices linear in it do better than slices that crowd at 1.
const APART: f64 = 1.1;

/// The axis of slices along the index of refraction.
pub(in crate::effects) fn ior_axis(size: usize, range: [f64; 2]) -> Axis {
    let warp = if range[0] < APART { Warp::Ior } else { Warp::Linear };
    Axis::ends(SliceAxis::Ior.name(), size, warp, range)
}
