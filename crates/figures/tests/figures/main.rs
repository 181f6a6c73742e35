//! Figures, as their SVG has them.

mod pictures;
mod plot;
