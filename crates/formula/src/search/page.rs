//! The page of a search over forms.

use super::{SearchPage, SearchRow};
use lobefit::report::{Block, Page, ReportError, Scatter, Section, Spread, TextTable, figures, words};

/// The page: what was asked, the frontier, the formulas.
pub(super) fn page(findings: &SearchPage) -> Result<Page, ReportError> {
    Ok(Page {
        title: format!("lobefit search: {}", findings.name),
        origin: findings.origin.clone(),
        lead: format!(
            "Formulas found for a quantity, from the cheapest to the most accurate: what accuracy costs. Figures in full digits: \
             {}.json, beside this page.",
            findings.name
        ),
        sections: vec![asked(findings), frontier(findings)?, formulas(findings)],
    })
}

fn asked(findings: &SearchPage) -> Section {
    Section {
        id: "asked".into(),
        title: "What was asked".into(),
        lead: "The quantity, how the formulas are used, and what was searched.".into(),
        blocks: [vec![Block::Facts { rows: findings.asked.clone() }], tried(findings)].concat(),
    }
}

fn tried(findings: &SearchPage) -> Vec<Block> {
    if findings.tried.is_empty() {
        return Vec::new();
    }
    let rows = findings.tried.iter().map(|(what, outcome)| vec![what.clone(), outcome.clone()]).collect();
    let caption = "What forms might have beside sums of powers, each tried by itself in a search of few forms, operations and samples: \
                   where it made the error smallest against the same search without it. What takes away 3 % or more is used; of \
                   factors of terms, the best two.";
    vec![Block::Table(words::table(&[("tried", false), ("gained", false)], rows, caption))]
}

fn frontier(findings: &SearchPage) -> Result<Section, ReportError> {
    let metric = findings.used_as.metric;
    let mut blocks = Vec::new();
    if words::worth_a_chart(&findings.dots) && findings.dots.iter().all(|d| d.y > 0.0) {
        let scatter = Scatter {
            title: "cost against error".into(),
            x: (format!("{} (square-root scale)", findings.unit), Spread::Root),
            y: (format!("largest {metric}"), Spread::Log),
            dots: findings.dots.clone(),
            size: (760.0, 460.0),
        };
        let caption = format!(
            "Largest {metric} over the domain against {} of an evaluation. The stairs join the forms found, each marked with its \
             operations; published formulas are rings.",
            findings.unit
        );
        blocks.push(figures(&[scatter], &caption)?);
    }
    blocks.push(Block::Table(found(findings)));
    if !findings.others.is_empty() {
        blocks.push(Block::Table(others(findings)));
    }
    Ok(Section {
        id: "frontier".into(),
        title: "Cost against error".into(),
        lead: "Each form is the most accurate one found at its cost; its error is measured in f32 at points that were not searched on."
            .into(),
        blocks,
    })
}

fn found(findings: &SearchPage) -> TextTable {
    let columns = [
        ("name", false),
        ("ops", true),
        ("max", true),
        ("RMS", true),
        ("where", false),
        ("best possible", true),
    ];
    let row = |r: &SearchRow| {
        let c = &r.certificate;
        let bound = if r.bound > 0.0 { words::mean(r.bound) } else { "–".into() };
        vec![
            r.name.clone(),
            r.ops.to_string(),
            words::max(c.max_abs),
            words::mean(c.rms),
            words::place(&c.at),
            bound,
        ]
    };
    let caption = "Best possible: no constants of this form bring the largest error on the samples below this, by proof; a dash where \
                   the form has constants for which nothing is proven.";
    words::table(&columns, findings.rows.iter().map(row).collect(), caption)
}

fn others(findings: &SearchPage) -> TextTable {
    let columns = [("the catalogue's", false), ("ops", true), ("max", true), ("RMS", true)];
    let row = |(name, ops, max, rms, _): &(String, u32, f64, f64, bool)| {
        vec![name.clone(), ops.to_string(), words::max(*max), words::mean(*rms)]
    };
    let caption = "What there was before, measured at the same points: fits of the catalogue with the constants that their files \
                   declare, published formulas in grey.";
    let mut table = words::table(&columns, findings.others.iter().map(row).collect(), caption);
    table.muted = findings.others.iter().map(|o| o.4).collect();
    table
}

fn formulas(findings: &SearchPage) -> Section {
    let blocks = findings.rows.iter().flat_map(|r| {
        let heading = format!("{}: {}", r.name, words::operations(r.ops));
        [Block::Heading { text: heading }, Block::Code { text: r.source.trim_end().into() }]
    });
    Section {
        id: "formulas".into(),
        title: "The formulas".into(),
        lead: "As written to the files beside this page; each is a hypothesis that lobefit fit takes.".into(),
        blocks: blocks.collect(),
    }
}
