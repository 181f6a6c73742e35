//! The figures, each a value that draws itself into SVG; they know values, labels and colours, and
//! nothing of what is reported.

mod axes;
mod bars;
mod canvas;
pub mod check;
mod colour;
mod colour_bar;
mod curves;
mod error;
mod field;
mod font;
mod gallery;
mod heat_map;
mod hover;
mod image;
mod labels;
mod legend;
mod raster;
mod scale;
mod scatter;
mod spheres;

pub use bars::{Bar, Bars};
pub(crate) use colour::LINES;
pub use colour::Shade;
pub use curves::{Annotation, Curves, Panel, Series, Style};
pub use error::ReportError;
pub use field::{Field, Ruler, drawn, drawn_lists};
pub use font::WOFF;
pub use gallery::{Cells, Gallery, Tile};
pub use heat_map::{HeatMap, Worst, signed};
pub use image::{Image, displayed, luminance};
pub use raster::Pixels;
pub use scale::{Scale, Spread, Tick};
pub use scatter::{Dot, Frontiers, Scatter, frontier};
pub use spheres::{SphereRow, Spheres, disc};

use scale::name as words_of;

/// Anything that draws itself as a piece of SVG markup to be put into a page.
pub trait Figure {
    /// The markup, one `<svg>` element; the same bytes for the same data.
    ///
    /// # Errors
    /// Non-finite, empty or mismatched data, by figure and field.
    fn svg(&self) -> Result<String, ReportError>;
}
