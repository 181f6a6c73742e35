//! Somebody else's table or shader function against the truth. Every convention that tables are
//! made with is tried (which input runs along which axis, what its coordinate means, where texel i
//! lies, which lobe, what a channel holds); the one that fits best is judged exactly, and what is
//! wrong under it is named.
//!
//! Conventions are ranked by the geometric mean of two root mean squares of the texels' errors, of
//! all and of the best four fifths ([`Misfit`]). A table *fits* a convention if its error is small
//! beside the spread of the truth ([`FITS`]); it is *in no doubt* if the next convention ranks
//! [`CLEAR`] times worse.

mod apart;
mod arguments;
mod axis;
mod best;
mod block;
mod clamp;
mod column;
mod convention;
mod declared;
mod defects;
mod encoded;
mod energy;
mod enlarged;
mod error;
mod errors;
mod extent;
mod factor;
mod first_line;
mod flipped;
mod found;
mod function;
mod judge;
mod line;
mod lobe;
mod lookup;
mod optimised;
mod page;
mod plain;
mod preferred;
mod published;
mod range;
mod sample;
mod scan;
mod screen;
mod spikes;
mod table;
mod truth;
mod two_lobes;
pub(crate) mod verdict;
mod work;

pub use crate::foreign::Channel;
pub use axis::{AxisReading, Input, REGISTRATIONS, Registration, SCALES, Scale, Span};
pub use column::{Base, Column};
pub use convention::{Convention, Fixed, LEFT_OUT, Misfit};
pub use declared::{Declared, Held, declared, declared_findings, stated_quantity};
pub use defects::Defect;
pub use encoded::{ENCODINGS, Encoding};
pub use enlarged::Enlarged;
pub use error::AuditError;
pub use errors::{Drawn, TexelErrors};
pub use extent::Extent;
pub use found::{Audit, ChannelAudit, Fit, Furnace, Other, Tried};
pub use function::{sampled, sampled_inverse};
pub use lobe::{FORMS, Form, Lobe};
pub use lookup::LookupErrors;
pub use page::findings;
pub use plain::Plain;
pub use published::Published;
pub(crate) use sample::everywhere;
pub use table::{AuditedTable, MOST_TEXELS, Source};
pub use truth::Beyond;
pub use two_lobes::TwoLobes;
pub use verdict::{Figure, Grade, Kind, Verdict};
pub(crate) use verdict::{first_line, place};
pub use work::work;

use best::{Best, CLOSE, Case, best, truth_of};
use defects::{Grain, without};
use errors::Residuals;
use judge::judge;
use lobefit::data::Place;
use lobefit_truth::quantity::{QUANTITIES, Quantity};
use lookup::{Look, Points};
use sample::{Candidate, Sample};
use truth::Truth;

/// Largest root mean square, beside the spread of the truth, with which a channel fits a
/// convention. Published tables that are what they say leave up to 0.023 (sheen of few samples; the
/// LTC magnitude, sampled without the lobe's tail, 0.014); tables of something else left 0.05 and more.
/// To pass without a limit a table has to be closer, but for noise (`FOLLOWS` in the verdict).
pub const FITS: f64 = 0.025;

/// The same of a function, which is an approximation. Published ones leave up to 0.08 against the
/// lobe that they were fitted to; those that leave more (0.16, 0.2, 0.36) were fitted to something
/// else and misread by as much as another convention is.
pub const FUNCTION_FITS: f64 = 0.1;

/// Root mean square over that of the best four fifths of a table of which a part may be of another lobe.
const UNEVEN: f64 = 3.0;

/// How much worse the next convention must rank for the best to be in no doubt, and how much better an
/// unusual reading of a function's arguments for it to be taken.
pub const CLEAR: f64 = 2.0;

/// Conventions that are reported.
const TOLD: usize = 10;

/// Places along every axis: in the sieve, in a round by the quick truth, in the first exact one, in
/// the last, and where the best is judged (2 axes or fewer, and 3).
const SIEVE: [usize; 2] = [10, 6];
const QUICK_ROUND: [usize; 2] = [24, 12];
const ROUND: [usize; 2] = [24, 9];
const LAST: [usize; 2] = [128, 16];
const WHOLE: [usize; 2] = [4096, 64];

/// Most texels of a table of three axes that are all judged: every one is an integral of its own. A
/// larger one is judged at 64 places along each axis, and passes no limit.
pub const JUDGED_TEXELS: usize = 1 << 19;

/// Most texels of a table of two axes of which all errors are held at once. Of a larger one a lattice
/// is held, and the rest is looked through for the largest error.
const HELD_TEXELS: usize = 1 << 19;
const HELD_SIDE: usize = 256;

/// Most texels that a page shows of a table of two axes; of more a lattice.
const SHOWN_TEXELS: usize = 1 << 18;
const SHOWN_SIDE: usize = 256;

/// Conventions after the quick round.
const QUICK_KEPT: [usize; 2] = [80, 12];

/// Conventions that rank this many times worse than the best go into the last round with the
/// figures of the one before.
const FAR: [f64; 2] = [f64::INFINITY, 4.0];

/// Number of inputs of a quantity that are axes of a table of it.
pub fn inputs_of(quantity: &dyn Quantity) -> usize {
    quantity.inputs().iter().filter(|input| !input.optional).count()
}

/// Names of the quantities that can be audited.
pub(crate) fn audited() -> String {
    let audited = QUANTITIES.iter().filter(|quantity| truth::spec(**quantity).is_some());
    audited.map(|quantity| quantity.name()).collect::<Vec<_>>().join(", ")
}

/// Conventions of which clamps are tried.
const CLAMPED: [usize; 2] = [TOLD, 1];

/// Audits a table as a quantity. `progress` hears of the stages.
///
/// Errors: a table with values that are no numbers, of a size that has not the quantity's axes, or
/// options that contradict it.
pub fn audit(
    audited: &AuditedTable,
    quantity: &dyn Quantity,
    fixed: &Fixed,
    progress: &dyn Fn(&str),
) -> Result<Audit, AuditError> {
    let stored = apart::with_sum(audited.checked()?, quantity, fixed);
    let table = match fixed.encoding {
        Some(encoding) => encoding.decoded(&stored)?,
        None => stored,
    };
    let live = table.live(fixed.meanings.as_ref().map(Vec::len))?;
    let case = Case { table: &table, live: &live, fixed, progress };
    let chosen = best(&case, quantity)?.ok_or_else(|| {
        let reason = format!("no texel lies in the domain of {} under any convention tried", quantity.name());
        AuditError::refused(&table.what, reason)
    })?;
    let mut done = chosen.audit(&case)?;
    let Best { truth, found, sieved, off } = chosen;
    let part = |c: &ChannelAudit| c.defects.iter().any(|d| matches!(d, Defect::Part { .. }));
    if let Some(encoding) = encoded::found(&case, quantity, &done)? {
        let decoded = Fixed { encoding: Some(encoding), ..fixed.clone() };
        let read = audit(audited, quantity, &decoded, progress)?;
        if read.fit != Fit::None {
            return encoding.beside(read, &case, quantity);
        }
    }
    done.excuse_factors();
    let uneven = |(m, k): (&Option<Misfit>, &usize)| {
        let rounding = Grain::of(&table, *k, fixed).rms(table.channels[*k].values.iter().copied());
        m.is_some_and(|m| without(m.rms, rounding) > UNEVEN * without(m.trimmed, rounding))
    };
    let uneven = off > CLOSE && found[0].fitted.misfits.iter().zip(&live).any(uneven);
    let odd = uneven || done.fit != Fit::Whole || done.channels.iter().any(part);
    if odd && table.source == Source::Table {
        progress("whether it is of two lobes");
        if let Some((found, parts)) = of_two_lobes(&truth, &case, [found, sieved.list.clone()])? {
            done = finish(&truth, &case, &found, Some(parts))?;
        }
    }
    scan::through(&truth, &case, &mut done)?;
    let under = |fixed: &Fixed| audit(audited, quantity, fixed, progress);
    if let Some(known) = published::again(&mut done, &table, (fixed, quantity), &under)? {
        return Ok(known);
    }
    let done = apart::with_others(done, &case, quantity, &sieved)?;
    apart::with_half(done, &case, quantity)
}

fn check_axes(table: &AuditedTable, truth: &Truth) -> Result<(), AuditError> {
    let (axes, inputs) = (table.size.len(), truth.spec.inputs.len());
    if axes == inputs {
        return Ok(());
    }
    let advice = match (axes, inputs) {
        (1, _) => "a table over roughness alone may be meant --as ggx-average".into(),
        (2, 1) => "a table over mu and roughness may be meant --as ggx-reflection".into(),
        (2, 3) => "--at says which input is the same throughout, as --at anisotropy=0.5".into(),
        (3, 2) => format!("--layer takes one of its slices, 0 to {}", table.size[2] - 1),
        _ => "give --size WxHxD as the table is laid out".into(),
    };
    let names = truth.spec.inputs.iter().map(|i| i.name()).collect::<Vec<_>>().join(", ");
    let (size, quantity) = (&table.size, truth.spec.quantity.name());
    let reason =
        format!("a table of {size:?} texels, but {quantity} has {inputs} inputs ({names}); {advice}");
    Err(AuditError::refused(&table.what, reason))
}

/// The conventions with that first which tells the two parts of a table apart, if it is of two;
/// `found` and what the sieve let through.
fn of_two_lobes(
    truth: &Truth,
    case: &Case,
    [mut found, sieved]: [Vec<Candidate>; 2],
) -> Result<Option<(Vec<Candidate>, TwoLobes)>, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let class = usize::from(table.size.len() == 3);
    let some = Sample::new(table, live, QUICK_ROUND[class], false);
    let places = whole(truth, found[0].lobe, &table.size);
    let all = Sample::new(table, live, places, false);
    let grains: Vec<Grain> = live.iter().map(|k| Grain::of(table, *k, fixed)).collect();
    let Some((candidate, parts)) =
        two_lobes::found(truth, [&some, &all], (fixed, &grains), &sieved, &found[0])?
    else {
        return Ok(None);
    };
    let fixed = Fixed { meanings: Some(candidate.fitted.columns.clone()), ..fixed.clone() };
    let last = Sample::new(table, live, LAST[class], false);
    let again = judge::rejudge(truth, &last, &fixed, vec![candidate], Truth::ranked)?;
    if again.is_empty() {
        return Ok(None);
    }
    found.retain(|c| !again.iter().any(|a| a.like(c)));
    Ok(Some(([again, found].concat(), parts)))
}

/// Of conventions that a sieve let through those that fit best, no two of them alike but for clamps.
fn candidates(truth: &Truth, case: &Case, sieved: Vec<Candidate>) -> Result<Vec<Candidate>, AuditError> {
    let Case { table, live, fixed, progress } = *case;
    let class = usize::from(table.size.len() == 3);
    progress("the best conventions on more texels");
    // The outermost texels of a table that was made larger are the same, which is no clamp.
    let mut fixed = fixed.clone();
    if Enlarged::of(table, live).is_some() {
        fixed.floors.extend([Input::Alpha, Input::Mu].map(|input| (input, 0.0)));
    }
    let (fixed, case) = (&fixed, &Case { fixed: &fixed, ..*case });
    let more = Sample::new(table, live, QUICK_ROUND[class], false);
    let found = range::shown(truth, case, &more, judge::rejudge(truth, &more, fixed, sieved, Truth::quick)?)?;
    let hopeless = found.first().map(|first| is_hopeless(truth, &more, first)).transpose()?;
    if hopeless.unwrap_or(true) && table.source == Source::Table {
        return flipped::rising_first(truth, case, &more, distinct(found));
    }
    let found = screen::best(found, QUICK_KEPT[class]);
    let more = Sample::new(table, live, ROUND[class], false);
    let found = judge::rejudge(truth, &more, fixed, found, Truth::ranked)?;
    let mut clamped = Vec::new();
    for (k, candidate) in screen::best(found, TOLD).into_iter().enumerate() {
        let floored = k < CLAMPED[class] && table.source == Source::Table;
        clamped.push(if floored { clamp::with_floors(truth, &more, fixed, &candidate)? } else { candidate });
    }
    let last = Sample::new(table, live, LAST[class], false);
    let far = FAR[class] * clamped.iter().map(|c| c.fitted.rank).fold(f64::INFINITY, f64::min);
    let (near, far): (Vec<Candidate>, Vec<Candidate>) =
        clamped.into_iter().partition(|c| c.fitted.rank <= far);
    let near = judge::rejudge(truth, &last, fixed, near, Truth::ranked)?;
    let found = distinct(screen::best([near, far].concat(), TOLD));
    let found = flipped::rising_first(truth, case, &last, found)?;
    if found.is_empty() { Ok(found) } else { preferred::plain_first(truth, case, found) }
}

/// No two candidates that differ in clamps alone.
fn distinct(list: Vec<Candidate>) -> Vec<Candidate> {
    let mut distinct: Vec<Candidate> = Vec::new();
    for candidate in list {
        if distinct.len() < TOLD && !distinct.iter().any(|d| d.like(&candidate)) {
            distinct.push(candidate);
        }
    }
    distinct
}

/// Whether some channel of a table is far from the best convention at half of its texels, so that no
/// closer look makes a part of it fit.
fn is_hopeless(truth: &Truth, sample: &Sample, first: &Candidate) -> Result<bool, AuditError> {
    let judgement = judge(truth, sample, &first.axes, first.lobe, Truth::quick)?;
    let far = |(values, column): (&Vec<f64>, &Option<Column>)| {
        let residuals = column.map(|column| Residuals::new(sample, &judgement, column, values));
        residuals.is_some_and(|r| r.median() > screen::PROMISING * r.bounded(&r.judged))
    };
    Ok(sample.values.iter().zip(&first.fitted.columns).any(far))
}

/// Places along every axis at which the best convention is judged: all, but of a table that is too
/// large for that.
fn whole(truth: &Truth, lobe: usize, size: &[usize]) -> usize {
    let (most, places) = match size.len() {
        _ if truth.specs[lobe].costly => (WHOLE[1] * WHOLE[1], WHOLE[1]),
        3 => (JUDGED_TEXELS, WHOLE[1]),
        _ => (HELD_TEXELS, HELD_SIDE),
    };
    if size.iter().product::<usize>() > most { places } else { usize::MAX }
}

fn finish(
    truth: &Truth,
    case: &Case,
    found: &[Candidate],
    two_lobes: Option<TwoLobes>,
) -> Result<Audit, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let class = usize::from(table.size.len() == 3);
    let sample = Sample::new(table, live, whole(truth, found[0].lobe, &table.size), false);
    let shown =
        if sample.dims().iter().product::<usize>() > SHOWN_TEXELS { SHOWN_SIDE } else { WHOLE[class] };
    let (places, shown) = sample.thinned(shown);
    let best = &found[0];
    let convention = best.convention(truth, live, table.channels.len());
    let judgement = judge(truth, &sample, &best.axes, best.lobe, Truth::exact)?;
    let points = match table.source {
        Source::Table => Some(Points::new(truth, &convention, best.lobe, &table.size)?),
        Source::Function => None,
    };
    let sum = energy::Sum::of(&sample, &convention, live);
    let enlarged = Enlarged::of(table, live);
    let factors = factor::of_some(case, (&sample, &judgement), &convention);
    let flips = flipped::of_some(case, (&sample, &judgement), &convention);
    let lobes = match (&two_lobes, &enlarged) {
        (None, None) => two_lobes::of_some(truth, case, (&sample, &judgement), best)?,
        _ => vec![None; table.channels.len()],
    };
    let alone =
        factors.into_iter().zip(flips).zip(lobes).map(|((factor, flip), lobe)| factor.or(flip).or(lobe));
    let mut alone: Vec<Option<Defect>> = alone.collect();
    let (mut channels, mut mended) = (Vec::new(), table.clone());
    for (k, channel) in table.channels.iter().enumerate() {
        let place = live.iter().position(|l| *l == k);
        let column = convention.columns[k];
        let (Some(place), Some(column)) = (place, column) else {
            let constant = (place.is_none() && !channel.varies()).then(|| channel.values[0]);
            let same = table.same(k).filter(|_| place.is_none() && constant.is_none());
            let other = same.map(|first| Other::Same(table.channels[first].name.clone()));
            let name = channel.name.clone();
            channels.push(ChannelAudit { name, constant, other, ..ChannelAudit::default() });
            continue;
        };
        let residuals = Residuals::new(&sample, &judgement, column, &sample.values[place]);
        let at = |texel: &[usize]| inputs_at(&convention, &table.size, texel);
        let grain = Grain::of(table, k, fixed);
        let alpha = |texel: &[usize]| at(texel).get("alpha").copied();
        let defects = match (table.source, &two_lobes) {
            (_, Some(parts)) => vec![Defect::OtherLobe(parts.clone())],
            (Source::Table, None) if enlarged.is_some() => {
                enlarged.iter().cloned().map(Defect::Enlarged).collect()
            }
            (Source::Table, None) => defects::defects(&residuals, grain, alone[k].take(), alpha),
            (Source::Function, None) => defects::of_function(&residuals),
        };
        let mut defects = defects::dead(table, &channel.values).chain(defects).collect::<Vec<_>>();
        let errors = residuals.figures(at);
        let looked = |registration| -> Result<Option<LookupErrors>, AuditError> {
            let look = Look { size: &table.size, values: &channel.values, column, registration };
            Ok(points.as_ref().map(|p| p.errors(&look)).transpose()?.flatten())
        };
        optimised::mend(&residuals, &defects, &mut mended.channels[k].values);
        if two_lobes.is_none() && table.source == Source::Table {
            let sum = sum.as_ref().filter(|sum| sum.channel == k);
            energy::energy(&residuals, sum, grain, alpha, &mut defects);
        }
        let left = defects::left(&residuals, &defects);
        channels.push(ChannelAudit {
            name: channel.name.clone(),
            column: Some(column),
            fit: if two_lobes.is_some() {
                Fit::Part
            } else {
                fit(table.source, left, &residuals, &errors, &defects)
            },
            truth: shown.iter().map(|i| residuals.truth(*i)).collect(),
            map: shown.iter().map(|i| residuals.errors[*i]).collect(),
            errors: Some(errors),
            left,
            points: residuals.drawn(fixed.points, at),
            defects,
            lookup: looked(None)?,
            plain_lookup: looked(Some(Registration::Centre))?,
            ..ChannelAudit::default()
        });
    }
    // What is missing of a sum is a part of neither half.
    let is_missing = |c: &ChannelAudit| c.defects.iter().any(|d| matches!(d, Defect::MissingLoss { .. }));
    if channels.iter().any(|c| is_missing(c) && c.column.is_some_and(Column::is_part)) {
        let halves = channels.iter_mut().filter(|c| c.column.is_some_and(Column::is_part));
        halves.for_each(|c| c.defects.retain(|d| !matches!(d, Defect::Part { .. })));
    }
    if let Some(points) = &points {
        optimised::excused(points, &convention, [table, &mended], &mut channels);
    }
    let blend = points.as_ref().map(|p| lookup::blended(p, table, &convention)).transpose()?.flatten();
    let furnace = energy::furnace((table, &convention), &sample, &judgement, live, sum.as_ref());
    let judged = channels.iter().filter(|c| c.column.is_some());
    let plain = plain::plain(truth, case, best)?;
    let departure = plain::departure(truth, case, best)?;
    Ok(Audit {
        plain,
        blend,
        departure,
        what: table.what.clone(),
        quantity: truth.spec.quantity.name(),
        source: table.source,
        size: table.size.clone(),
        axes: table.axes.clone(),
        places,
        fit: judged.map(|c| c.fit).fold(Fit::Whole, Fit::max),
        tried: found.iter().map(|c| tried(c, truth, live, table.channels.len())).collect(),
        margin: two_lobes.as_ref().map_or(margin(&ranks(found)), |m| apart(found, m)),
        fixed: !fixed.is_free(),
        form: fixed.form,
        at: fixed.at,
        excluded: None,
        excused: fixed.meanings.is_some() || fixed.column.is_some(),
        channels,
        furnace,
        two_lobes,
        beyond: sample::beyond(truth, &sample, &best.axes, best.lobe),
        truth_error: truth.specs[best.lobe].bound,
        published: None,
        shipped: None,
        encoding: fixed.encoding,
        remarks: Vec::new(),
    })
}

/// Rank of the first that differs over that of the best: E at normal incidence is the same for both
/// forms of Smith. Below 1 where a plain reading is preferred.
fn margin(ranks: &[f64]) -> f64 {
    let times = ranks.iter().map(|rank| rank / ranks[0]);
    times.skip(1).find(|t| (t - 1.0).abs() >= 1e-6).unwrap_or(f64::INFINITY)
}

/// Root mean square of the best with one lobe over that of both together. In the rank the texels of one lobe
/// alone may be left out.
fn apart(found: &[Candidate], two_lobes: &TwoLobes) -> f64 {
    let of = |c: &Candidate| c.fitted.misfits.iter().flatten().map(|misfit| misfit.rms).fold(0.0, f64::max);
    found.iter().map(of).fold(f64::INFINITY, f64::min) / two_lobes.rms
}

fn ranks(found: &[Candidate]) -> Vec<f64> {
    found.iter().map(|c| c.fitted.rank).collect()
}

fn tried(c: &Candidate, truth: &Truth, live: &[usize], channels: usize) -> Tried {
    let mut misfits = vec![None; channels];
    for (place, misfit) in live.iter().zip(&c.fitted.misfits) {
        misfits[*place] = *misfit;
    }
    Tried { convention: c.convention(truth, live, channels), misfits, rank: c.fitted.rank }
}

/// How well a channel fits, of which so much is `left`: a table but for noise up to twice what fits, and for
/// what its samples leave where the user states them.
fn fit(source: Source, left: f64, residuals: &Residuals, errors: &TexelErrors, defects: &[Defect]) -> Fit {
    let misfit = residuals.misfit(&residuals.judged);
    let is_stated = defects.iter().any(|d| matches!(d, Defect::Sampled { .. }));
    let most = if is_stated { screen::PROMISING } else { 2.0 * FITS };
    let (allowed, explained) = match source {
        Source::Table => (FITS, misfit <= most && left <= FITS),
        Source::Function => (FUNCTION_FITS, false),
    };
    if defects.iter().any(|d| matches!(d, Defect::Flipped { .. } | Defect::ChannelLobe { .. })) {
        return Fit::Part;
    }
    if misfit <= allowed || explained {
        let dead = defects.iter().any(|d| matches!(d, Defect::Dead { .. }));
        return if dead { Fit::Part } else { Fit::Whole };
    }
    let spread = residuals.bounded(&residuals.judged);
    let explained =
        |d: &Defect| matches!(d, Defect::Part { .. } | Defect::Clamped { .. } | Defect::Enlarged(_));
    if defects.iter().any(explained) && errors.median <= allowed * spread { Fit::Part } else { Fit::None }
}

/// The inputs of a texel.
fn inputs_at(convention: &Convention, size: &[usize], texel: &[usize]) -> Place {
    let along = convention.axes.iter().zip(texel).zip(size);
    along.map(|((axis, i), n)| (axis.scale.input().name().to_string(), axis.node(*i, *n))).collect()
}
