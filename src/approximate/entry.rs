//! The files of the catalogue. They are what a person writes; they are compiled in, so that nothing
//! depends on the working directory.

use lobefit_shade::Hypothesis;

/// One WGSL file of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// File name.
    pub file: &'static str,
    /// WGSL source.
    pub source: &'static str,
    /// The publication, for a formula with published constants.
    pub publication: Option<&'static str>,
}

impl Entry {
    /// Name of its function: that of the file.
    pub fn name(&self) -> &'static str {
        self.file.trim_start_matches("published/").trim_end_matches(".wgsl")
    }

    /// Whether the formula has an argument of this name; what does not parse has none, and is
    /// refused where it is fitted.
    pub fn takes(&self, input: &str) -> bool {
        let parsed = Hypothesis::parse(self.file, self.source);
        parsed.is_ok_and(|h| h.inputs().iter().any(|i| i == input))
    }
}

/// Hypotheses of ours, by name.
macro_rules! own {
    ($($name:literal),* $(,)?) => {
        [$($crate::approximate::Entry {
            file: concat!($name, ".wgsl"),
            source: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/fits/hypotheses/", $name, ".wgsl")),
            publication: None,
        }),*]
    };
}

/// Published formulas, by name and publication.
macro_rules! published {
    ($($name:literal by $publication:literal),* $(,)?) => {
        [$($crate::approximate::Entry {
            file: concat!("published/", $name, ".wgsl"),
            source: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/fits/hypotheses/published/", $name, ".wgsl")),
            publication: Some($publication),
        }),*]
    };
}

pub(crate) use own;
pub(crate) use published;
