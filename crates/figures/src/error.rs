//! What can be wrong with the data of a report.

/// Data that cannot be shown truthfully, or a page that could not be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A number is NaN or infinite.
    #[error("report, {section}: {field} is not finite")]
    NotFinite {
        /// Section of the page or type of the figure.
        section: String,
        /// Field, with its index.
        field: String,
    },
    /// A list that a figure is drawn from has no entries.
    #[error("report, {section}: {field} is empty")]
    Empty {
        /// Section of the page or type of the figure.
        section: String,
        /// Field.
        field: String,
    },
    /// Two lists that belong together differ in length.
    #[error("report, {section}: {field} has {found} entries, expected {expected}")]
    Size {
        /// Section of the page or type of the figure.
        section: String,
        /// Field.
        field: String,
        /// Entries found.
        found: usize,
        /// Entries called for.
        expected: usize,
    },
    /// A number or name breaks the field's stated domain.
    #[error("report, {section}: {field} {problem}")]
    Domain {
        /// Section of the page or type of the figure.
        section: String,
        /// Field.
        field: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The drawing layer, the PNG encoder or the template refused; a defect of this program.
    #[error("report, {section}: drawing failed: {reason}")]
    Drawing {
        /// Section of the page or type of the figure.
        section: String,
        /// What the layer said.
        reason: String,
    },
}
