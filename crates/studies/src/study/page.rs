//! What the pages of studies are put together from.

use lobefit::report::numbers::place;
use lobefit::report::words;

/// What the lead of a page of a reduced study begins with.
pub(super) const REDUCED: &str = "REDUCED SIZE, for tests: few points, small pictures, few roughnesses. What it says of better and worse is not the \
     study's. ";

/// The heads of a column of names, and of one of figures at each value.
pub(super) fn columns_at(first: &str, values: &[f64]) -> String {
    words::figures_after(first, values.iter().map(|&x| place(x)))
}

/// A row of a table: its name and its cells.
pub(super) fn row(name: impl Into<String>, cells: impl IntoIterator<Item = String>) -> Vec<String> {
    std::iter::once(name.into()).chain(cells).collect()
}
