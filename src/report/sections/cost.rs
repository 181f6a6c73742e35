//! The page of what accuracy costs: charts of formulas, what the next digit costs, and integrators.

use std::cmp::Ordering;

use super::{SCREEN, figures, offline, words};
use crate::emit::manifest::TableEntry;
use crate::report::numbers::{brief, grouped, significant};
use crate::report::{
    Block, CostJob, CostPoint, CostSearch, CostUnit, Costs, Dot, GpuRecord, GpuRow, Page, ReportError,
    Scatter, Section, Spread,
};

/// Errors that a reader may ask for, falling.
const LIMITS: [f64; 10] = [0.1, 0.03, 0.01, 0.003, 0.001, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6];

/// The limits of the conclusion.
const FROM: f64 = 0.1;
const TO: f64 = 0.01;

/// Points of which more make a chart wide.
const MANY: usize = 30;

pub(super) fn page(costs: &Costs) -> Result<Page, ReportError> {
    let mut sections = vec![frontiers(costs)?, digits(costs)];
    sections.extend(vendors(costs));
    sections.extend(halves(costs));
    sections.extend(searches(costs));
    for record in &costs.offline {
        sections.extend(offline::section(record)?);
    }
    Ok(Page::new("What accuracy costs", costs.origin.clone(), conclusion(costs) + LEAD, sections))
}

const LEAD: &str = "Every formula of the catalogue beside published ones: its largest error over the whole domain, in f32, against what its \
    compiled code costs on the GPUs of a vendor. Records of reports/isa and reports/gpu hold the counts and times; docs/cost.md says how they \
    are made.";

/// What a factor of ten costs, of the job with the most formulas.
fn conclusion(costs: &Costs) -> String {
    let Some(job) = costs.jobs.iter().max_by_key(|job| job.points.len()) else { return String::new() };
    let ends = |of: usize| Some((cheapest(job, of, FROM)?.0, cheapest(job, of, TO)?.0));
    let Some((from, to)) = ends(0) else { return String::new() };
    let each = costs.units.iter().enumerate().skip(1).filter_map(|(of, unit)| {
        let (from, to) = ends(of)?;
        Some(format!("{} on {}", significant(to / from, 2), unit.name))
    });
    format!(
        "An error of {TO} in place of {FROM} takes {} operations in place of {}, {} times as many; in compiled code or measured time the factor is {} ({}).\n",
        brief(to, 3),
        brief(from, 3),
        significant(to / from, 2),
        each.collect::<Vec<_>>().join(", "),
        job.title
    )
}

/// The least cost of a formula within an error, and its name; of several the most accurate.
fn cheapest(job: &CostJob, of: usize, limit: f64) -> Option<(f64, &str)> {
    let within = job.points.iter().filter(|point| point.error <= limit);
    let costs = within.filter_map(|point| Some((point.costs[of]?, point)));
    let best = costs.min_by(|(a, p), (b, q)| a.total_cmp(b).then(p.error.total_cmp(&q.error)));
    best.map(|(cost, point)| (cost, point.name.as_str()))
}

const CODE: &str = "In f32, of the whole shader: it loads the inputs, and stores them and the result. The cost is that of this shader less that \
    of the same one without the formula.";

/// A chart of each job, for each unit.
fn frontiers(costs: &Costs) -> Result<Section, ReportError> {
    let mut of = Vec::new();
    for (i, unit) in costs.units.iter().enumerate() {
        let charts: Vec<Scatter> = costs.jobs.iter().filter_map(|job| chart(job, i, unit)).collect();
        let caption = format!(
            "Largest error against cost: {}. Lower is more accurate, further left is cheaper. Stairs join the formulas of ours that \
             no other beats in both.",
            unit.unit
        );
        // The first chart of operations stands in the page, for readers without scripts.
        let (open, rest) = charts.split_at(usize::from(i == 0).min(charts.len()));
        let rest = vec![figures(rest, &caption)?];
        let mut blocks = if open.is_empty() {
            vec![Block::Packed(rest)]
        } else {
            let summary = "What else formulas stand for".into();
            vec![figures(open, &caption)?, Block::Fold { summary, blocks: rest }]
        };
        if !unit.code.is_empty() {
            let code = unit.code.iter().flat_map(|(name, text)| {
                [Block::Heading { text: name.clone() }, Block::Code { text: text.clone() }]
            });
            blocks.push(Block::Fold {
                summary: format!("Machine code of {}", words::count(unit.code.len(), "formula", "formulas")),
                blocks: std::iter::once(Block::Text { text: CODE.into() }).chain(code).collect(),
            });
        }
        of.push((unit.name.clone(), blocks));
    }
    of.extend(costs.times.iter().map(|times| {
        (format!("{}: {}", times.device.adapter, times.origin.scene_words()), vec![measured(times)])
    }));
    if !costs.tables.is_empty() {
        of.push(("bytes of tables".into(), vec![tables(costs)]));
    }
    Ok(Section::new(
        "frontiers",
        "Error against cost",
        "One frontier for each thing that formulas stand for. The pointer names every point.",
        vec![Block::Switch { name: "unit".into(), of }],
    ))
}

fn chart(job: &CostJob, of: usize, unit: &CostUnit) -> Option<Scatter> {
    let dot = |point: &CostPoint| {
        let x = point.costs[of]?;
        let CostPoint { name, error, published, .. } = point;
        (*error > 0.0).then(|| Dot { name: name.clone(), x, y: *error, published: *published, table: false })
    };
    let dots: Vec<Dot> = job.points.iter().filter_map(dot).collect();
    let x = if unit.counted.is_empty() {
        unit.name.clone()
    } else {
        format!("{} on {}", unit.counted, unit.name)
    };
    words::worth_a_chart(&dots).then(|| Scatter {
        title: job.title.clone(),
        x: (format!("{x} (square-root scale)"), Spread::Root),
        y: (job.metric.clone(), Spread::Log),
        size: if dots.len() > MANY { (1040.0, 420.0) } else { (480.0, 260.0) },
        dots,
    })
}

/// Times of the functions of another scene.
fn measured(record: &GpuRecord) -> Block {
    let timed = record.rows.iter().filter(|row| row.resolved());
    let row = |row: &GpuRow| {
        let error = row.error.as_ref()?;
        let name = row.function.as_ref().unwrap_or(&row.name);
        let (picoseconds, screen) = (1e3 * row.nanoseconds.median, 1e-3 * row.nanoseconds.median * SCREEN);
        let [call, screen] = [picoseconds, screen].map(|time| significant(time, 3));
        Some(vec![name.clone(), call, screen, words::max(error.max), error.used_as.metric.into()])
    };
    let columns = "function|ps per call>|µs at 4K, a call for each pixel>|largest error there>|which error";
    let caption = format!(
        "Measured on {}, throughput of the full device; functions of another scene ({}). The errors are those at the \
         points of the run; the certificates are searched for the worst and so larger.",
        record.device.adapter,
        record.origin.scene_words()
    );
    Block::Table(words::table(columns, timed.filter_map(row).collect(), &caption))
}

/// Tables of the built-in scene.
fn tables(costs: &Costs) -> Block {
    let row = |table: &TableEntry| {
        let size: Vec<String> = table.axes.iter().map(|axis| axis.size.to_string()).collect();
        let error = words::max(table.error.lookup.max);
        vec![table.name.clone(), size.join(" × "), grouped(table.bytes), table.cost.ops.to_string(), error]
    };
    let columns = "table|size in texels|bytes>|operations beside a fetch>|largest lookup error>";
    let rows = costs.tables.iter().map(row).collect();
    Block::Table(words::table(columns, rows, "The tables that the built-in scene emits."))
}

/// What the next digit costs: for each limit the cheapest formula, and the ratio to the row before.
fn digits(costs: &Costs) -> Section {
    let unit = |unit: &CostUnit| match unit.counted.as_str() {
        "" => unit.name.clone(),
        counted => format!("{}: {counted}", unit.name),
    };
    let units: Vec<String> = costs.units.iter().map(unit).collect();
    let blocks = costs.jobs.iter().flat_map(|job| {
        let columns = words::figures_after("within>|formula of fewest operations", units.iter().cloned());
        let mut table = words::table(&columns, rows(job, units.len()), "");
        // Set apart, for a metric may have bars.
        table.columns[0].0 = format!("{} within", job.metric);
        [Block::Heading { text: job.title.clone() }, Block::Table(table)]
    });
    Section::new(
        "digits",
        "What the next digit costs",
        "The least cost of a formula within an error, in each unit, and how many times the row above it is. Each unit may have a formula of its \
            own; the one named has the fewest operations.",
        blocks.collect(),
    )
}

/// For each formula of the frontier by operations what is cheaper on the GPUs of a vendor and errs no
/// more; none where nothing is.
fn vendors(costs: &Costs) -> Option<Section> {
    let mut most = vec![0.0_f64; costs.units.len()];
    let mut blocks = Vec::new();
    for job in &costs.jobs {
        let mut rows = Vec::new();
        for own in frontier(job) {
            let cheaper = |of: usize| {
                let (cost, name) = cheapest(job, of, own.error)?;
                let saved = 1.0 - cost / own.costs[of].filter(|own| *own > cost && cost > 0.0)?;
                Some((saved, format!("{name} −{}\u{a0}%", brief(100.0 * saved, 2))))
            };
            let found: Vec<Option<(f64, String)>> = (1..costs.units.len()).map(cheaper).collect();
            for (most, found) in most[1..].iter_mut().zip(&found) {
                *most = found.as_ref().map_or(*most, |(saved, _)| most.max(*saved));
            }
            if found.iter().any(Option::is_some) {
                let cells = found.into_iter().map(|found| found.map_or("same".into(), |(_, text)| text));
                rows.push([own.name.clone(), words::max(own.error)].into_iter().chain(cells).collect());
            }
        }
        if !rows.is_empty() {
            let units =
                costs.units[1..].iter().fold(String::new(), |all, unit| format!("{all}|{}", unit.name));
            let columns = format!("fewest operations|largest error>{units}");
            blocks.push(Block::Heading { text: job.title.clone() });
            blocks.push(Block::Table(words::table(&columns, rows, &job.metric)));
        }
    }
    let saved = costs.units[1..].iter().zip(&most[1..]);
    let saved = saved.map(|(unit, most)| format!("{} {} %", unit.name, brief(100.0 * most, 2)));
    let lead = format!(
        "Of the formulas that the frontier by operations holds, those for which another costs less on the GPUs of a vendor and errs no more: its \
            name and what it saves, of compiled code or of measured time. The most that is saved: {}.",
        saved.collect::<Vec<_>>().join(", ")
    );
    (!blocks.is_empty()).then(|| Section::new("vendors", "What a vendor's own frontier saves", &lead, blocks))
}

/// The formulas of ours that none of as few operations beats, by rising operations.
fn frontier(job: &CostJob) -> Vec<&CostPoint> {
    let mut own: Vec<&CostPoint> = job.points.iter().filter(|point| !point.published).collect();
    own.sort_by(|a, b| {
        a.costs[0].partial_cmp(&b.costs[0]).unwrap_or(Ordering::Equal).then(a.error.total_cmp(&b.error))
    });
    let mut least = f64::INFINITY;
    own.retain(|point| {
        let better = point.error < least;
        least = least.min(point.error);
        better
    });
    own
}

/// More than this part of its error in single precision a formula adds in half, where it has a row.
const ADDED: f64 = 0.05;

/// What half precision changes of the frontier; none where nothing is measured in both.
fn halves(costs: &Costs) -> Option<Section> {
    let mut blocks = Vec::new();
    for job in &costs.jobs {
        let row = |own: &&CostPoint| {
            let within = job.points.iter().filter(|point| !point.published && point.costs[0] <= own.costs[0]);
            let halves = within.filter_map(|point| Some((point.half?, &point.name)));
            let (half, name) = halves.min_by(|a, b| a.0.total_cmp(&b.0))?;
            let differs = *name != own.name || half > (1.0 + ADDED) * own.error;
            differs.then(|| vec![own.name.clone(), words::max(own.error), name.clone(), words::max(half)])
        };
        let rows: Vec<Vec<String>> = frontier(job).iter().filter_map(row).collect();
        if !rows.is_empty() {
            let columns = "best in f32|largest error>|best in f16 for no more operations|largest error>";
            blocks.push(Block::Heading { text: job.title.clone() });
            blocks.push(Block::Table(words::table(columns, rows, &job.metric)));
        }
    }
    let lead = format!(
        "In f16 every operation is rounded, with products fused into sums or without, whichever errs more. At the budgets of operations that \
            stand here another formula is the most accurate, or its error grows by more than {} %.",
        100.0 * ADDED
    );
    (!blocks.is_empty()).then(|| Section::new("halves", "Half precision", lead, blocks))
}

/// Part of an error by which two are not told apart.
const SAME: f64 = 0.005;

/// The formulas beside what a longer search finds; none without a record of formulas that are here.
fn searches(costs: &Costs) -> Option<Section> {
    let beside = |search: &CostSearch| {
        let is_same = |job: &&CostJob| (&job.title, &job.domain) == (&search.title, &search.domain);
        let job = costs.jobs.iter().find(is_same)?;
        let beside = search.found.iter().filter_map(|(ops, error)| {
            let own =
                job.points.iter().filter(|point| !point.published && point.costs[0] <= Some(f64::from(*ops)));
            let best = own.min_by(|a, b| a.error.total_cmp(&b.error))?;
            Some((ops, best, error, best.error / error))
        });
        let (same, others): (Vec<_>, Vec<_>) = beside.partition(|(.., ratio)| (ratio - 1.0).abs() < SAME);
        let row = |(ops, best, error, ratio): (&u32, &CostPoint, &f64, f64)| {
            let [shipped, found] = [best.error, *error].map(words::max);
            vec![ops.to_string(), best.name.clone(), shipped, found, significant(ratio, 3)]
        };
        let rows: Vec<Vec<String>> = others.into_iter().map(row).collect();
        let at = match rows.is_empty() {
            true => "every budget".into(),
            false => words::count(same.len(), "other budget", "other budgets"),
        };
        let (metric, within) = (&job.metric, 100.0 * SAME);
        let caption = format!(
            "{metric}. The same error, within {within} %, was found at {at}. Found by {}.",
            search.command
        );
        let columns = "operations>|best formula|its error>|error found>|ratio>";
        let beside = match rows.is_empty() {
            true => Block::Text { text: caption },
            false => Block::Table(words::table(columns, rows, &caption)),
        };
        Some([Block::Heading { text: job.title.clone() }, beside])
    };
    let blocks: Vec<Block> = costs.searches.iter().filter_map(beside).flatten().collect();
    (!blocks.is_empty()).then(|| {
        Section::new(
            "searches",
            "What a longer search finds",
            "The formulas above, and the frontier of a longer search over the same domain. A ratio above 1 is what is left to find; below 1 the \
                search misses what another found.",
            blocks,
        )
    })
}

/// A row for each limit whose formulas the next limit does not keep.
fn rows(job: &CostJob, units: usize) -> Vec<Vec<String>> {
    let at =
        |limit: f64| -> Vec<Option<f64>> { (0..units).map(|of| Some(cheapest(job, of, limit)?.0)).collect() };
    let next = LIMITS.into_iter().skip(1).map(Some).chain([None]);
    let told =
        LIMITS.into_iter().zip(next).filter(|(limit, next)| next.is_none_or(|next| at(*limit) != at(next)));
    let mut before: Vec<Option<f64>> = vec![None; units];
    let row = |(limit, _): (f64, Option<f64>)| {
        let (_, name) = cheapest(job, 0, limit)?;
        let found = at(limit);
        let cell = |(now, before): (&Option<f64>, &Option<f64>)| match (now, before) {
            (None, _) => "–".into(),
            (Some(now), Some(before)) if before > &0.0 => {
                format!("{} (×{})", brief(*now, 3), significant(now / before, 2))
            }
            (Some(now), _) => brief(*now, 3),
        };
        let cells: Vec<String> = found.iter().zip(&before).map(cell).collect();
        before = found;
        Some([vec![limit.to_string(), name.to_string()], cells].concat())
    };
    told.map_while(row).collect()
}
