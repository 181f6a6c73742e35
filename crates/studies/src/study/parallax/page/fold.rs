//! What a reader opens: everything that is neither answer nor overview.

use lobefit::report::words;
use lobefit::report::{Block, Section};

/// Blocks behind a line that says what they are, and how many.
pub(super) fn of(what: &str, blocks: Vec<Block>) -> Block {
    let mut counts = [0, 0];
    count(&blocks, &mut counts);
    let [figures, tables] = counts;
    let of = [(figures, "figure", "figures"), (tables, "table", "tables")];
    let counted: Vec<String> =
        of.into_iter().filter(|(n, ..)| *n > 0).map(|(n, one, many)| words::count(n, one, many)).collect();
    let summary =
        if counted.is_empty() { what.to_string() } else { format!("{what}: {}", counted.join(", ")) };
    Block::Fold { summary, blocks }
}

/// Figures and tables among blocks.
fn count(blocks: &[Block], counts: &mut [usize; 2]) {
    for block in blocks {
        match block {
            Block::Figures { svg, .. } => counts[0] += svg.len(),
            Block::Table(_) => counts[1] += 1,
            Block::Fold { blocks, .. } => count(blocks, counts),
            _ => {}
        }
    }
}

/// The section with all but its first blocks behind a line.
pub(super) fn after(open: usize, mut section: Section) -> Section {
    let rest = section.blocks.split_off(open.min(section.blocks.len()));
    if !rest.is_empty() {
        section.blocks.push(of(if open == 0 { "Details" } else { "More" }, rest));
    }
    section
}
