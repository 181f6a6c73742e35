//! What the pages of studies are put together from.

use lobefit::report::numbers::place;
use lobefit::report::{Curves, Series, Spread, Style, words};

/// What the lead of a page of a reduced study begins with.
pub(super) const REDUCED: &str = "REDUCED SIZE, for tests: few points, small pictures, few roughnesses. What it says of better and worse is not the \
     study's. ";

/// A line of a chart.
pub(super) fn line(name: impl Into<String>, points: Vec<(f64, f64)>, style: Style) -> Series {
    Series { name: name.into(), points, style, end: None }
}

/// A chart of lines over linear axes of these labels.
pub(super) fn chart(
    title: impl Into<String>,
    [x, y]: [&str; 2],
    series: Vec<Series>,
    size: (f64, f64),
) -> Curves {
    Curves {
        title: title.into(),
        x: (x.into(), Spread::Linear),
        y: (y.into(), Spread::Linear),
        series,
        annotations: Vec::new(),
        guides: Vec::new(),
        y_limits: None,
        size,
    }
}

/// The heads of a column of names, and of one of figures at each value.
pub(super) fn columns_at(first: &str, values: &[f64]) -> String {
    words::figures_after(first, values.iter().map(|&x| place(x)))
}

/// A row of a table: its name and its cells.
pub(super) fn row(name: impl Into<String>, cells: impl IntoIterator<Item = String>) -> Vec<String> {
    std::iter::once(name.into()).chain(cells).collect()
}
