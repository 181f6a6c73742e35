//! Ways of reading a table of the sources' layout: as it is laid out, and as the sources read it.

use crate::data::{Axis, Registration, Table, Warp};
use crate::effects::table::SliceAxis;

/// The table as the sources' shader sees it at one slice: mu (its root for glass) and roughness as texture
/// coordinates, which a texture unit takes for texel centres; the layer rounded to the nearest of 32 a unit, not interpolated.
///
/// The result has two equal slices, so that a trilinear lookup returns that layer.
pub fn as_the_sources_read(table: &Table, slice: SliceAxis, value: f64) -> Table {
    let [columns, rows, slices] = table.size();
    let unit = match slice {
        SliceAxis::Anisotropy => value * value,
        SliceAxis::Ior => value - 1.0,
    };
    let layer = ((unit * slices as f64).round() as usize).min(slices - 1);
    let mut read = table.clone();
    for channel in &mut read.channels {
        let plane = &channel.texels[layer * columns * rows..(layer + 1) * columns * rows];
        channel.texels = [plane, plane].concat();
    }
    let centred =
        |axis: &Axis| Axis { registration: Registration::Centre, min: 0.0, max: 1.0, ..axis.clone() };
    let slices = Axis { size: 2, warp: Warp::Linear, min: 0.0, max: 4.0, ..centred(&table.axes[2]) };
    read.axes = vec![centred(&table.axes[0]), centred(&table.axes[1]), slices];
    read
}
