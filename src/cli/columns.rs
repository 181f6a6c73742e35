//! Results as columns on a terminal: a header, then rows, each column as wide as its widest cell.

/// Which side of its column a cell stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// The lines of a table, of its columns those with a filled cell; none without rows.
pub fn lines<const N: usize>(header: [(&str, Side); N], rows: &[[String; N]]) -> Vec<String> {
    if rows.is_empty() {
        return Vec::new();
    }
    let width = |k: usize| {
        let cells = rows.iter().map(|row| row[k].chars().count());
        cells.chain([header[k].0.chars().count()]).max().unwrap_or_default()
    };
    let widths: [usize; N] = std::array::from_fn(width);
    let is_filled = |k: &usize| rows.iter().any(|row| !row[*k].is_empty());
    let filled: Vec<usize> = (0..N).filter(is_filled).collect();
    let line = |cells: [&str; N]| {
        let padded = filled.iter().map(|&k| match header[k].1 {
            Side::Left => format!("{:<1$}", cells[k], widths[k]),
            Side::Right => format!("{:>1$}", cells[k], widths[k]),
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_string()
    };
    let body = rows.iter().map(|row| line(row.each_ref().map(String::as_str)));
    std::iter::once(line(header.map(|(name, _)| name))).chain(body).collect()
}
