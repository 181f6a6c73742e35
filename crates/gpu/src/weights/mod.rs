//! Prices of kinds of work on the GPUs of each vendor: least squares over what its compiler makes of
//! every formula.

mod cli;

use std::collections::{BTreeMap, BTreeSet};

pub(crate) use cli::verb;
use lobefit::data::{Agreement, Model, Vendor, Weights};
use lobefit::emit::include::Include;
use lobefit::report::GpuRecord;
use lobefit::timing::isa::{Counts, IsaRecord, IsaRow, Precision};
use lobefit::timing::priced::{Priced, TIMED, priced, timed};
use lobefit_math::correlation::Correlation;
use lobefit_shade::{Features, ShadeError, Source, Tape};

/// The command that makes the committed prices.
const COMMAND: &str = "lobefit cost --weights --from DIR --records . --record src/data/weights.json";

/// Sweeps of the descent: more than any of the vendors takes.
const SWEEPS: usize = 100_000;

/// Decimals of a price and of a correlation.
const DECIMALS: f64 = 1e3;

/// A vendor's model, and what it was compared with.
struct Fitted {
    /// The vendor.
    vendor: Vendor,
    /// The model.
    model: Model,
    /// By device of the vendor: recorded times.
    times: Vec<Times>,
}

/// Recorded times on a device against costs.
struct Times {
    /// The device.
    device: String,
    /// Of the neutral operations.
    operations: Option<Correlation>,
    /// Of the model.
    model: Option<Correlation>,
    /// Of the compiled code.
    compiled: Option<Correlation>,
    /// Picoseconds of a vector instruction, a move of a literal and a transcendental instruction,
    /// by least squares.
    picoseconds: [f64; TIMED],
}

/// A function of numbers that a vendor's record has.
struct Formula {
    name: String,
    tape: Tape,
    counts: Counts,
    compiled: f64,
    /// What its form for three channels costs, where there is one.
    coloured: Option<f64>,
}

/// Why a vendor has no model.
#[derive(Debug, thiserror::Error)]
enum FitError {
    /// Emitted code outside the dialect.
    #[error(transparent)]
    Shader(#[from] ShadeError),
    /// No form for three channels beside its formula, by which a coloured call is priced.
    #[error("its record of {0} has no function for three channels (`_rgb`): bake a metal, and record it")]
    Colourless(String),
}

/// Fits a model to each vendor whose record of the scene is there.
///
/// # Errors
/// As [`FitError`].
fn fitted(
    include: &Include,
    scene: &str,
    records: &[IsaRecord],
    times: &[GpuRecord],
) -> Result<Vec<Fitted>, FitError> {
    let mut all = Vec::new();
    for vendor in Vendor::ALL {
        let priced = priced(vendor);
        let mut of = records.iter().filter(|record| record.driver == priced.driver && record.scene == scene);
        let Some(record) = of.next() else { continue };
        let formulas = formulas(include, record, &priced)?;
        if formulas.is_empty() {
            continue;
        }
        let own = times.iter().filter(|times| times.origin.scene == scene && times.is_of(vendor));
        let model = model(&priced, record, &formulas)?;
        let times = own.map(|times| against(times, include, &model, &formulas)).collect();
        all.push(Fitted { vendor, model, times });
    }
    Ok(all)
}

/// The file of the models.
fn weights(fitted: &[Fitted]) -> Weights {
    let vendors = fitted.iter().map(|of| (of.vendor, of.model.clone())).collect();
    Weights { command: COMMAND.into(), vendors }
}

/// Functions of numbers with their tapes, whose code is that of the record.
fn formulas(include: &Include, record: &IsaRecord, priced: &Priced) -> Result<Vec<Formula>, ShadeError> {
    let mut formulas = Vec::new();
    let of = |row: &&IsaRow| row.family == priced.family && row.precision == Precision::F32;
    let cost = |row: &IsaRow| {
        let current = include.hash(&row.function).is_some_and(|hash| record.is_of(&row.function, &hash));
        (priced.cost)(&row.counts).filter(|_| current && record.ops(&row.function).is_some())
    };
    let rows: BTreeMap<&str, &IsaRow> =
        record.rows.iter().filter(of).map(|row| (&*row.function, row)).collect();
    for (&name, &row) in &rows {
        let Some((code, compiled)) = include.code(name).zip(cost(row)) else { continue };
        let Some(tape) = tape(name, &code)? else { continue };
        let coloured = rows.get(&*format!("{name}_rgb")).and_then(|row| cost(row));
        formulas.push(Formula { name: name.into(), tape, counts: row.counts, compiled, coloured });
    }
    Ok(formulas)
}

/// The operations of a function from numbers to a number; none of another.
fn tape(name: &str, code: &str) -> Result<Option<Tape>, ShadeError> {
    if ["vec", "texture", "array", "struct"].iter().any(|word| code.contains(word)) {
        return Ok(None);
    }
    Source::parse("fits/lobefit.wgsl", code)?.tape(name, 0).map(Some)
}

fn model(priced: &Priced, record: &IsaRecord, formulas: &[Formula]) -> Result<Model, FitError> {
    let every: Vec<&Formula> = formulas.iter().collect();
    let prices = prices(&every);
    let pairs = |cost: &dyn Fn(&Formula) -> f64| {
        agreement(&formulas.iter().map(|of| (cost(of), of.compiled)).collect::<Vec<_>>())
    };
    let named = Features::NAMES.into_iter().map(String::from).zip(prices.all());
    let beside = formulas.iter().filter_map(|of| Some(of.coloured? - of.compiled));
    let beside: Vec<f64> = beside.collect();
    if beside.is_empty() {
        return Err(FitError::Colourless(record.compiler()));
    }
    Ok(Model {
        family: priced.family.into(),
        compiler: record.compiler(),
        unit: priced.unit.into(),
        prices: named.collect(),
        coloured: decimals(beside.iter().sum::<f64>() / beside.len() as f64),
        agreement: pairs(&|of| prices.price(&of.tape.features())),
        left_out: left_out(formulas),
        operations: pairs(&|of| f64::from(of.tape.cost_ops())),
    })
}

/// Costs of formulas by prices in which neither they nor their twins of the other norm took part.
fn left_out(formulas: &[Formula]) -> Agreement {
    const PARTS: usize = 10;
    let stem = |of: &Formula| of.name.trim_end_matches("_rms").to_owned();
    let stems: BTreeSet<String> = formulas.iter().map(stem).collect();
    let parts: BTreeMap<String, usize> = stems.into_iter().zip((0..PARTS).cycle()).collect();
    let part = |of: &Formula| parts.get(&stem(of)).copied().unwrap_or_default();
    let mut pairs = Vec::new();
    for k in 0..PARTS {
        let others: Vec<&Formula> = formulas.iter().filter(|of| part(of) != k).collect();
        let prices = prices(&others);
        let own = formulas.iter().filter(|of| part(of) == k);
        pairs.extend(own.map(|of| (prices.price(&of.tape.features()), of.compiled)));
    }
    agreement(&pairs)
}

/// A correlation as files have it; zeros of too few formulas.
fn agreement(pairs: &[(f64, f64)]) -> Agreement {
    let of = |c: Correlation| Agreement {
        pearson: decimals(c.values),
        spearman: decimals(c.ranks),
        formulas: c.count,
    };
    Correlation::of(pairs).map(of).unwrap_or_default()
}

fn decimals(x: f64) -> f64 {
    (DECIMALS * x).round() / DECIMALS
}

/// Costs against the times of a device.
fn against(times: &GpuRecord, include: &Include, model: &Model, formulas: &[Formula]) -> Times {
    let timed_formulas: Vec<(&Formula, f64)> =
        formulas.iter().filter_map(|of| Some((of, times.nanoseconds(&of.name, include)?))).collect();
    let pairs = |cost: &dyn Fn(&Formula) -> f64| {
        Correlation::of(&timed_formulas.iter().map(|(of, time)| (cost(of), *time)).collect::<Vec<_>>())
    };
    let rows: Vec<_> = timed_formulas.iter().map(|(of, time)| (timed(&of.counts), 1e3 * time)).collect();
    Times {
        device: times.device.adapter.clone(),
        operations: pairs(&|of| f64::from(of.tape.cost_ops())),
        model: pairs(&|of| model.cost(&of.tape)),
        compiled: pairs(&|of| of.compiled),
        picoseconds: least_squares(&rows),
    }
}

fn prices(formulas: &[&Formula]) -> Features {
    let rows: Vec<_> = formulas.iter().map(|of| (of.tape.features().all(), of.compiled)).collect();
    Features::of(least_squares(&rows).map(decimals))
}

/// Prices of kinds of work, from how much of each kind a row has and what it costs: the least squares
/// among prices that are not negative, by coordinate descent on the normal equations.
pub fn least_squares<const N: usize>(rows: &[([f64; N], f64)]) -> [f64; N] {
    let (mut matrix, mut right) = ([[0.0; N]; N], [0.0; N]);
    for (row, cost) in rows {
        for i in 0..N {
            right[i] += row[i] * cost;
            for j in 0..N {
                matrix[i][j] += row[i] * row[j];
            }
        }
    }
    let mut prices = [0.0_f64; N];
    for _ in 0..SWEEPS {
        let before = prices;
        for i in (0..N).filter(|&i| matrix[i][i] > 0.0) {
            let rest: f64 = (0..N).filter(|&j| j != i).map(|j| matrix[i][j] * prices[j]).sum();
            prices[i] = ((right[i] - rest) / matrix[i][i]).max(0.0);
        }
        if prices == before {
            break;
        }
    }
    prices
}
