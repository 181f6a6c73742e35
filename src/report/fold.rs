//! What a page shows at once, and what a reader opens: a page that is not opened is a few screens.

use std::collections::BTreeSet;

use super::page::{Block, Card, Choice, Page, Section, TextTable};
use super::sections::words;

/// Pixels of a page of usual width before a reader opens anything; what is estimated here is off by
/// some percent.
const TALL: f64 = 5800.0;

/// Width of a page's content in pixels, of its text, and of a character of its tables and of its text.
const WIDTH: f64 = 1160.0;
const TEXT: f64 = 780.0;
const CELL: f64 = 7.2;
const LETTER: f64 = 7.8;

/// How much wider a bold character is.
const BOLD: f64 = 1.12;

/// Pixels of a table that is folded whatever room there is.
const LONG: f64 = 900.0;

/// Pixels of what stands before the sections and after them without contents and lead, and of a
/// section's title.
const FRAME: f64 = 280.0;
const HEAD: f64 = 85.0;

/// Blocks behind a line that says what they are, and how many.
pub fn folded(what: &str, blocks: Vec<Block>) -> Block {
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

/// The section with all but its first blocks behind a line.
pub fn folded_after(open: usize, mut section: Section) -> Section {
    let rest = section.blocks.split_off(open.min(section.blocks.len()));
    if !rest.is_empty() {
        section.blocks.push(folded(if open == 0 { "Details" } else { "More" }, rest));
    }
    section
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

/// The blocks of each section: those that find room, then a fold with the others.
pub(super) fn fitted(page: &Page) -> Vec<Vec<Block>> {
    let head = |section: &Section| HEAD + of_text(&section.lead);
    let contents = 32.0 + 24.0 * (page.sections.len() as f64 / 3.0).ceil();
    let lead: f64 = page.lead.lines().map(of_text).sum();
    let mut left = TALL - FRAME - contents - lead - page.sections.iter().map(head).sum::<f64>();
    let fit = |section: &Section| {
        let mut open = 0;
        let mut blocks = section.blocks.clone();
        said_once(&mut blocks, &mut BTreeSet::new());
        let all: Vec<Block> = blocks.iter().map(shortened).collect();
        for block in &all {
            let height = height(block);
            if height > left {
                break;
            }
            left -= height;
            open += 1;
        }
        let mut blocks = all;
        if open < blocks.len() {
            while open > 0 && matches!(blocks[open - 1], Block::Heading { .. } | Block::Approximation { .. })
            {
                open -= 1;
            }
            let rest = blocks.split_off(open);
            // What is folded already needs no second line before it.
            match rest[..] {
                [Block::Fold { .. }] => blocks.extend(rest),
                _ => blocks.push(folded(if open == 0 { "Show" } else { "More" }, rest)),
            }
        }
        blocks
    };
    page.sections.iter().map(fit).collect()
}

/// Takes away what a caption above has said. Parts of a switch are seen one at a time: each keeps its own.
fn said_once(blocks: &mut [Block], said: &mut BTreeSet<String>) {
    for block in blocks {
        match block {
            Block::Figures { caption, .. } | Block::Table(TextTable { caption, .. })
                if !said.insert(caption.clone()) =>
            {
                caption.clear();
            }
            Block::Fold { blocks, .. } | Block::Packed(blocks) => said_once(blocks, said),
            _ => {}
        }
    }
}

/// A block, or what opens it where it is a table so long that nothing else would find room.
fn shortened(block: &Block) -> Block {
    match block {
        Block::Table(table) if of_table(table) > LONG => {
            let summary = format!("Table of {} rows", table.rows.len());
            Block::Fold { summary, blocks: vec![block.clone()] }
        }
        _ => block.clone(),
    }
}

/// Lines that a text takes in a width.
fn lines(text: &str, width: f64) -> f64 {
    (text.chars().count() as f64 * LETTER / width).ceil().max(1.0)
}

/// A paragraph; none where it says nothing.
fn of_text(text: &str) -> f64 {
    if text.is_empty() { 0.0 } else { 24.0 * lines(text, TEXT) + 16.0 }
}

fn of_caption(caption: &str) -> f64 {
    if caption.is_empty() { 0.0 } else { 22.0 * lines(caption, TEXT) + 6.0 }
}

/// About as many pixels as a block is tall.
fn height(block: &Block) -> f64 {
    match block {
        Block::Text { text } => of_text(text),
        Block::Heading { .. } | Block::Approximation { .. } => 30.0,
        Block::Code { text } => 21.0 * text.lines().count() as f64 + 48.0,
        Block::Facts { rows } => rows.iter().map(|(_, value)| 24.0 * lines(value, 600.0)).sum::<f64>() + 16.0,
        Block::Links { rows } => 24.0 * rows.len() as f64 + 32.0,
        Block::Figures { svg, caption } => pictures(svg) + of_caption(caption) + 40.0,
        Block::Table(table) => of_table(table) + of_caption(&table.caption) + 40.0,
        Block::Fold { .. } => 64.0,
        Block::Packed(blocks) => blocks.iter().map(height).sum(),
        // Its page is made for it: never folded.
        Block::Live { .. } => 0.0,
        Block::Cards(cards) if is_paired(cards) => {
            // The drawing stands below the choice.
            let tallest = |pair: &[Card]| pair.iter().map(|card| of_card(card, 1)).fold(0.0, f64::max);
            cards.chunks(2).map(tallest).sum()
        }
        Block::Cards(cards) => cards.iter().map(|card| of_card(card, 3)).sum(),
        Block::Switch { of, .. } => {
            let own = |(_, blocks): &(String, Vec<Block>)| blocks.iter().map(height).sum();
            of.iter().map(own).fold(40.0, f64::max)
        }
    }
}

/// Whether cards stand side by side: those with one choice each.
pub(super) fn is_paired(cards: &[Card]) -> bool {
    cards.len() > 1 && cards.iter().all(|card| card.choices.len() == 1)
}

/// A card whose choices stand side by side, of which so many or more leave no room for the drawing.
fn of_card(card: &Card, full: usize) -> f64 {
    let code = |(_, text): &(String, String)| 20.0 * text.lines().count() as f64;
    let choice = |c: &Choice| 190.0 + 24.0 * c.facts.len() as f64 + c.code.first().map_or(0.0, code);
    let tallest = card.choices.iter().map(choice).fold(0.0, f64::max);
    let svg = card.svg.as_ref().map_or(0.0, |[desk, _]| pictures(std::slice::from_ref(desk)));
    175.0 + if card.choices.len() < full { tallest.max(svg) } else { tallest + svg }
}

/// The width or the height of a drawing; infinite where it does not say it.
pub(super) fn size(svg: &str, name: &str) -> f64 {
    let rest = svg.split_once(&format!(" {name}=\"")).map_or("", |(_, rest)| rest);
    rest.split('"').next().and_then(|number| number.parse().ok()).unwrap_or(f64::INFINITY)
}

/// Drawings that flow into rows; one that does not say its size finds no room.
fn pictures(svg: &[String]) -> f64 {
    let (mut total, mut across, mut tallest) = (0.0, 0.0, 0.0_f64);
    for one in svg {
        let (width, height) = (size(one, "width"), size(one, "height"));
        if across > 0.0 && across + width > WIDTH {
            total += tallest + 12.0;
            (across, tallest) = (0.0, 0.0);
        }
        across += width + 16.0;
        tallest = tallest.max(height);
    }
    total + tallest
}

/// Rows whose cells wrap where the columns do not all find room. As in a browser a column is as wide as its
/// longest word at least, one of figures as its longest figure, and what room there is beyond is shared by
/// what each would take more.
fn of_table(table: &TextTable) -> f64 {
    let length = |text: &str| text.chars().count() as f64 * CELL;
    let word =
        |text: &str| text.split_inclusive([' ', '_']).map(|word| length(word.trim_end())).fold(0.0, f64::max);
    let widest = |i: usize, of: &dyn Fn(&str) -> f64| {
        let cells = table.rows.iter().filter_map(|row| row.get(i)).map(|cell| of(cell));
        cells.fold(0.0, f64::max)
    };
    let heads = table.columns.iter().enumerate();
    let widths: Vec<(f64, f64)> = heads
        .map(|(i, (name, is_figures))| {
            let most = widest(i, &length);
            let least = if *is_figures { most } else { widest(i, &word) };
            let least = least.max(BOLD * word(name));
            (least, most.max(BOLD * length(name)).min(544.0).max(least))
        })
        .collect();
    let [least, most] = [widths.iter().map(|w| w.0).sum::<f64>(), widths.iter().map(|w| w.1).sum()];
    let spare = WIDTH - 20.0 * widths.len() as f64 - least;
    let share = (spare / (most - least).max(1.0)).clamp(0.0, 1.0);
    let of_row = |lengths: &mut dyn Iterator<Item = f64>| {
        let lines =
            lengths.zip(&widths).map(|(l, (least, most))| (l / (least + (most - least) * share)).ceil());
        21.0 * lines.fold(1.0, f64::max) + 9.0
    };
    let head = of_row(&mut table.columns.iter().map(|(name, _)| BOLD * length(name)));
    head + table.rows.iter().map(|row| of_row(&mut row.iter().map(|cell| length(cell)))).sum::<f64>()
}
