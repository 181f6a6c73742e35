//! What an audited function costs in compiled instructions, as the page and the terminal show it.

use std::collections::BTreeMap;

use serde::Serialize;

use lobefit::cli::columns::{Side, lines};
use lobefit::report::{Block, Section, words};
use lobefit::timing::isa::Counts;

/// A function beside our formulas of the same use. Each is compiled alone, in f32; counts are above
/// those of the same shader without the function.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditCost {
    /// Driver and version: `radv-22.3.6`.
    pub compiler: String,
    /// What the function and our formulas are used as, by the manifest's word; none where we have no
    /// formula for it.
    #[serde(rename = "use", skip_serializing_if = "Option::is_none")]
    pub used_as: Option<String>,
    /// What errors are of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_of: Option<String>,
    /// The shadowing that errors are held against; none of a quantity that has one alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lobe: Option<String>,
    /// Where errors are compared, by input: the domain of our certificates.
    pub domain: BTreeMap<String, [f64; 2]>,
    /// By family of GPUs.
    pub families: Vec<AuditFamily>,
}

/// What is compiled for a family.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditFamily {
    /// The family, by the driver's name of it.
    pub family: String,
    /// The audited function.
    pub audited: AuditCompiled,
    /// Of our formulas whose error is no larger the one that takes the fewest instructions, a
    /// transcendental one counted as four.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cheapest: Option<AuditCompiled>,
    /// Of our formulas that take no more instructions the one whose error is smallest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most_accurate: Option<AuditCompiled>,
}

/// A function that is compiled for a family.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AuditCompiled {
    /// The function.
    pub function: String,
    /// Its largest error; none where it is not finite or not compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// What was counted.
    #[serde(flatten)]
    pub counts: Counts,
}

/// Columns of the table.
const COLUMNS: &str = "family|vector>|transc.>|moves>|latency>|max error>|function|which";

/// Cells of the table.
type Row = [String; 8];

const AUDITED: &str = "audited";
const CHEAPEST: &str = "ours: the cheapest of no larger error";
const NONE_CHEAPEST: &str = "ours: none of so small an error";
const MOST_ACCURATE: &str = "ours: the most accurate of no more instructions";
const NONE_MOST_ACCURATE: &str = "ours: none of so few instructions";
const BOTH: &str = "ours: the cheapest of no larger error, and the most accurate of no more instructions";

impl AuditCost {
    /// What was compiled, and what errors are of.
    fn lead(&self) -> String {
        let compiled =
            format!("Compiled alone by {}, in f32, above the same shader without it.", self.compiler);
        let Some(error) = self.error_of.as_ref().filter(|_| !self.domain.is_empty()) else {
            return format!("{compiled} lobefit has no formula that serves the same.");
        };
        let range = |(input, [low, high]): (&String, &[f64; 2])| format!("{input} {low} to {high}");
        let domain: Vec<String> = self.domain.iter().map(range).collect();
        let lobe = self.lobe.as_ref().map_or_else(String::new, |lobe| format!(" of {lobe}"));
        format!("{compiled} Max error: {error}{lobe}, over {}.", domain.join(" and "))
    }

    /// A row for each function of each family.
    fn rows(&self) -> Vec<Row> {
        let compared = !self.domain.is_empty();
        self.families.iter().flat_map(|family| family.rows(compared)).collect()
    }

    /// For the terminal: a line for each row.
    pub fn text(&self) -> String {
        let heads = words::heads(COLUMNS);
        let head = |k: usize| (heads[k].0.as_str(), if heads[k].1 { Side::Right } else { Side::Left });
        format!("{}\n{}\n", self.lead(), lines(std::array::from_fn(head), &self.rows()).join("\n"))
    }

    /// For the page.
    pub(super) fn section(&self) -> Section {
        let rows = self.rows().into_iter().map(Vec::from);
        let table = words::table(COLUMNS, rows.collect(), "");
        Section::new("cost", "Compiled instructions", self.lead(), vec![Block::Table(table)])
    }
}

impl AuditFamily {
    /// The audited function and, where ours are `compared`, the two of ours.
    fn rows(&self, compared: bool) -> Vec<Row> {
        let row = |of: Option<&AuditCompiled>, which: &str| {
            let cell = |count: Option<i64>| count.map_or_else(|| "-".into(), |count| count.to_string());
            let counts = of.map(|of| of.counts);
            let [vector, transcendental, moves, latency] = [
                counts.map(|counts| counts.vector),
                counts.map(|counts| counts.transcendental),
                counts.map(|counts| counts.moves),
                counts.and_then(|counts| counts.latency),
            ]
            .map(cell);
            let error = of.and_then(|of| of.error).map_or_else(|| "-".into(), words::max);
            let name = of.map_or("-", |of| &of.function).to_owned();
            [self.family.clone(), vector, transcendental, moves, latency, error, name, which.into()]
        };
        let mut rows = vec![row(Some(&self.audited), AUDITED)];
        let (cheapest, most_accurate) = (self.cheapest.as_ref(), self.most_accurate.as_ref());
        if cheapest.is_some() && cheapest == most_accurate {
            rows.push(row(cheapest, BOTH));
        } else if compared {
            rows.push(row(cheapest, if cheapest.is_some() { CHEAPEST } else { NONE_CHEAPEST }));
            let which = if most_accurate.is_some() { MOST_ACCURATE } else { NONE_MOST_ACCURATE };
            rows.push(row(most_accurate, which));
        }
        rows
    }
}
