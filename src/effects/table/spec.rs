//! What to bake, and what came of it.

use super::Region;
use crate::data::{Axis, Channel, Layout, Smith, Table, TableError, TexelFormat};

/// A table of three axes to bake.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// Name of the table.
    pub name: String,
    /// Shadowing form.
    pub smith: Smith,
    /// Columns, rows, slices, at least 2 each.
    pub size: [usize; 3],
    /// Texel format.
    pub format: TexelFormat,
    /// Coordinates.
    pub layout: Layout,
    /// Where the lookup must hold.
    pub region: Region,
}

impl Spec {
    /// The table of these channels.
    pub(in crate::effects) fn table(
        &self,
        quantity: &str,
        axes: [Axis; 3],
        channels: Vec<Channel>,
    ) -> Result<Table, TableError> {
        let table = Table {
            name: self.name.clone(),
            quantity: quantity.into(),
            smith: self.smith,
            alpha_map: self.region.alpha_map,
            axes: axes.to_vec(),
            channels,
            format: self.format,
        };
        table.validate()?;
        Ok(table)
    }
}

/// What a table or a set of truths took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Made {
    /// Integrand evaluations, checks included.
    pub evaluations: u64,
    /// Worst difference from direct integrals with more nodes at the points checked, the tolerance of those added where they are no
    /// tighter; of integrals that are direct themselves, their tolerance.
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
    /// A layout that the effect does not have.
    #[error("table {table}: the {layout} layout is not one of this effect")]
    Layout {
        /// Table's name.
        table: String,
        /// The layout.
        layout: &'static str,
    },
}

/// One channel.
pub(in crate::effects) fn channel(name: &str, texels: Vec<f64>) -> Channel {
    Channel { name: name.into(), texels }
}

/// Nodes in ln(alpha) for targets that are interpolated to about 1e-4, which [`check`](super::check) measures: E has its nearest singularities at imaginary part pi/2
/// (alpha^2 negative), so n nodes on a range of half length h leave exp(-n asinh(pi/(2 h))); at least 8.
pub(in crate::effects) fn alpha_nodes(alpha: [f64; 2]) -> usize {
    use lobefit_math::ops;
    let rate = ops::asinh(std::f64::consts::PI / ops::log(alpha[1] / alpha[0]).max(1e-3));
    ((ops::log(2e4) / rate).ceil() as usize).max(8)
}
