//! A page: a list of sections, each a list of blocks.

use super::Origin;

/// A page of sections.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// Title.
    pub title: String,
    /// What made it.
    pub origin: Origin,
    /// What the reader is about to see, in paragraphs on lines of their own; the first of several
    /// is the conclusion.
    pub lead: String,
    /// The sections; the table of contents lists them.
    pub sections: Vec<Section>,
}

/// A titled part of a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Anchor: lower-case letters and hyphens.
    pub id: String,
    /// Title.
    pub title: String,
    /// What the section shows and how to read it.
    pub lead: String,
    /// Its content.
    pub blocks: Vec<Block>,
}

impl Page {
    /// A page of these parts.
    pub fn new(
        title: impl Into<String>,
        origin: Origin,
        lead: impl Into<String>,
        sections: Vec<Section>,
    ) -> Page {
        Page { title: title.into(), origin, lead: lead.into(), sections }
    }
}

impl Section {
    /// A section of these parts.
    pub fn new(
        id: impl Into<String>,
        title: impl Into<String>,
        lead: impl Into<String>,
        blocks: Vec<Block>,
    ) -> Section {
        Section { id: id.into(), title: title.into(), lead: lead.into(), blocks }
    }
}

/// A piece of a section. All text is plain and escaped on the way into the page; only `svg` is
/// markup.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Text {
        /// The words.
        text: String,
    },
    /// A heading below the section's.
    Heading {
        /// The words.
        text: String,
    },
    /// The heading of an approximation's own figures, which a link may lead to.
    Approximation {
        /// Its name.
        name: String,
    },
    /// Text in a fixed pitch, its lines kept.
    Code {
        /// The lines.
        text: String,
    },
    /// Name and value pairs.
    Facts {
        /// The pairs.
        rows: Vec<(String, String)>,
    },
    /// Links to other pages of the report: what they show, and their file.
    Links {
        /// The pairs.
        rows: Vec<(String, String)>,
    },
    /// Drawings side by side, as many as fit, with one caption.
    Figures {
        /// Markup from [`super::Figure::svg`].
        svg: Vec<String>,
        /// What to see in them.
        caption: String,
    },
    /// A table.
    Table(TextTable),
    /// What the page draws itself.
    Live {
        /// The element with the data ([`super::explore::document`]).
        data: String,
        /// What stands there where it cannot draw.
        still: Vec<Block>,
    },
    /// What to take, a card for each thing that is made.
    Cards(Vec<Card>),
    /// Blocks of which one is seen at a time, each behind its label.
    Switch {
        /// What is switched: an identifier, unique in its page.
        name: String,
        /// The blocks; the first are seen at first.
        of: Vec<(String, Vec<Block>)>,
    },
    /// Blocks that the page holds packed until their part of a switch is seen.
    Packed(Vec<Block>),
    /// Blocks that are shown when their line is opened.
    Fold {
        /// The line.
        summary: String,
        /// What it opens.
        blocks: Vec<Block>,
    },
}

/// What to take of what was made for one purpose.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Anchor.
    pub id: String,
    /// Name of what is called.
    pub title: String,
    /// What it is.
    pub about: String,
    /// Where more of it stands: words, and a file.
    pub link: (String, String),
    /// What there is to choose from.
    pub choices: Vec<Choice>,
    /// A drawing beside or below them: for a wide window, and for a narrow one.
    pub svg: Option<[String; 2]>,
}

/// One choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What it is chosen for: `cheap`.
    pub role: String,
    /// Whether it stands out.
    pub recommended: bool,
    /// The call.
    pub call: String,
    /// Figures.
    pub facts: Vec<(String, String)>,
    /// What else there is to know; may be empty.
    pub note: String,
    /// Code to copy, by language; the first is seen at once.
    pub code: Vec<(String, String)>,
}

/// A table of text.
#[derive(Clone, Debug, PartialEq)]
pub struct TextTable {
    /// Heads of the columns, and whether they hold figures (aligned right).
    pub columns: Vec<(String, bool)>,
    /// Cells by row.
    pub rows: Vec<Vec<String>>,
    /// Rows to set back in grey: somebody else's.
    pub muted: Vec<bool>,
    /// The column of names that a reader follows or comes to, if there is one.
    pub names: Option<Names>,
    /// What to see in it.
    pub caption: String,
}

/// What the names in a column lead to.
#[derive(Clone, Debug, PartialEq)]
pub struct Names {
    /// The column.
    pub column: usize,
    /// Whether a link may lead to a row, by its name: once on a page.
    pub places: Vec<bool>,
    /// The address that each row's name leads to, if any.
    pub links: Vec<Option<String>>,
}

/// The place of an approximation on its effect's page, as a link has it after `#`: its row among all.
pub fn place_of(name: &str) -> String {
    name.replace(' ', "-")
}

/// The place of its own figures, where a page has these.
pub fn figures_of(name: &str) -> String {
    format!("figures-{}", place_of(name))
}
