//! The page of a search over forms.

use super::output::subject;
use super::{Point, SearchJob, Searched};
use crate::fitting::catalogue::CatalogueFit;
use crate::fitting::document::{hash, of_target, origin};
use lobefit::data::Model;
use lobefit::report::{Block, Dot, Page, ReportError, Scatter, Section, Spread, TextTable, figures, words};

/// The page: what was asked, the frontier, the formulas.
///
/// # Errors
/// Data that cannot be shown, by section and field.
pub(super) fn page(job: &SearchJob, searched: &Searched) -> Result<Page, ReportError> {
    let name = searched.name();
    Ok(Page {
        title: format!("lobefit search: {name}"),
        origin: origin(&name, &job.command, hash(&[&job.command])),
        lead: format!(
            "{}\nFormulas found for a quantity, from the cheapest to the most accurate: what accuracy costs. Figures in full digits: \
             {name}.json, beside this page.",
            conclusion(searched)
        ),
        sections: vec![asked(job, searched), frontier(searched)?, formulas(searched)],
    })
}

/// What the ends of the frontier take and keep.
fn conclusion(searched: &Searched) -> String {
    let kept = |point: &Point| {
        format!("at most {} in {}", words::max(point.certificate.max_abs), words::operations(point.ops))
    };
    let metric = searched.target.used_as.metric;
    match &searched.points[..] {
        [] => "No formula was found.".into(),
        [one] => format!("One formula was found: {metric} {}.", kept(one)),
        [cheapest, .., best] => {
            let found = searched.points.len();
            format!("{found} formulas were found: {metric} {}, and {}.", kept(cheapest), kept(best))
        }
    }
}

fn asked(job: &SearchJob, searched: &Searched) -> Section {
    let mut rows = of_target(&searched.target);
    rows.push(("Most operations".into(), job.max_ops.to_string()));
    if !searched.anchor.is_empty() {
        rows.push(("Exact".into(), searched.anchor.clone()));
    }
    if let Some(Model { family, unit, compiler, .. }) = &searched.model {
        rows.push(("Cheap on".into(), format!("{family}, by a model of {compiler}: {unit}")));
    }
    let blocks = [vec![Block::Facts { rows }], tried(searched)].concat();
    let lead = "The quantity, how the formulas are used, and what was searched.";
    Section::new("asked", "What was asked", lead, blocks)
}

fn tried(searched: &Searched) -> Vec<Block> {
    if searched.tried.is_empty() {
        return Vec::new();
    }
    let rows = searched.tried.iter().map(|tried| vec![subject(tried), tried.outcome()]).collect();
    let caption = "What forms might have beside sums of powers, each tried by itself in a search of few forms, operations and samples: \
                   where it made the error smallest against the same search without it. What takes away 3 % or more is used; of \
                   factors of terms, the best two.";
    vec![Block::Table(words::table("tried|gained", rows, caption))]
}

fn frontier(searched: &Searched) -> Result<Section, ReportError> {
    let metric = searched.target.used_as.metric;
    let unit = searched.model.as_ref().map_or("operations", |model| &model.unit);
    let dots = dots(searched);
    let mut blocks = Vec::new();
    if words::worth_a_chart(&dots) && dots.iter().all(|d| d.y > 0.0) {
        let scatter = Scatter {
            title: "cost against error".into(),
            x: (format!("{unit} (square-root scale)"), Spread::Root),
            y: (format!("largest {metric}"), Spread::Log),
            dots,
            size: (760.0, 460.0),
        };
        let caption = format!(
            "Largest {metric} over the domain against {unit} of an evaluation. The stairs join the forms found, each marked with its \
             operations; published formulas are rings."
        );
        blocks.push(figures(&[scatter], &caption)?);
    }
    blocks.push(Block::Table(found(searched)));
    if !searched.catalogue.is_empty() {
        blocks.push(Block::Table(others(searched)));
    }
    let lead = "Each form is the most accurate one found at its cost; its error is measured in f32 at points that were not searched on.";
    Ok(Section::new("frontier", "Cost against error", lead, blocks))
}

/// Cost against error: the frontier, and published formulas.
fn dots(searched: &Searched) -> Vec<Dot> {
    let dot = |name: String, x: f64, y: f64, published| Dot { name, x, y, published, table: false };
    let ours = searched.points.iter().map(|p| dot(p.ops.to_string(), p.price, p.certificate.max_abs, false));
    let others = searched.catalogue.iter().filter(|r| r.published);
    ours.chain(others.map(|r| dot(r.name.clone(), r.price, r.max, true))).collect()
}

fn found(searched: &Searched) -> TextTable {
    let columns = "name|ops>|max>|RMS>|where|best possible>";
    let row = |r: &Point| {
        let c = &r.certificate;
        let bound = if r.bound > 0.0 { words::mean(r.bound) } else { "–".into() };
        vec![
            r.hypothesis.name().to_string(),
            r.ops.to_string(),
            words::max(c.max_abs),
            words::mean(c.rms),
            words::place(&c.at),
            bound,
        ]
    };
    let caption = "Best possible: no constants of this form bring the largest error on the samples below this, by proof; a dash where \
                   the form has constants for which nothing is proven.";
    words::table(columns, searched.points.iter().map(row).collect(), caption)
}

fn others(searched: &Searched) -> TextTable {
    let columns = "the catalogue's|ops>|max>|RMS>";
    let row =
        |r: &CatalogueFit| vec![r.name.clone(), r.ops.to_string(), words::max(r.max), words::mean(r.rms)];
    let caption = "What there was before, measured at the same points: fits of the catalogue with the constants that their files \
                   declare, published formulas in grey.";
    let mut table = words::table(columns, searched.catalogue.iter().map(row).collect(), caption);
    table.muted = searched.catalogue.iter().map(|r| r.published).collect();
    table
}

fn formulas(searched: &Searched) -> Section {
    let blocks = searched.points.iter().flat_map(|r| {
        let heading = format!("{}: {}", r.hypothesis.name(), words::operations(r.ops));
        [Block::Heading { text: heading }, Block::Code { text: r.hypothesis.source().trim_end().into() }]
    });
    let lead = "As written to the files beside this page; each is a hypothesis that lobefit fit takes.";
    Section::new("formulas", "The formulas", lead, blocks.collect())
}
