//! The plain reading of a table, without a word about it: it takes texels for centres (or for end
//! points, where they lie about those), axes for rising ones, a roughness for a roughness, an average
//! for an average, the cosine for what runs along x of two axes, the index along z of three, and the lobe
//! for the one that the quantity's name stands for. A table that is right only under another reading is
//! wrong as it will be used, unless the user says that it is meant so.

use super::AuditError;
use super::arguments::is_gloss;
use super::axis::{AxisReading, Input, Scale};
use super::best::Case;
use super::column::Column;
use super::convention::{Convention, meanings};
use super::encoded::Encoding;
use super::errors::Residuals;
use super::judge::judge;
use super::lobe::Lobe;
use super::sample::{Candidate, Sample};
use super::table::{AuditedTable, Source};
use super::truth::Truth;
use super::verdict::{along, number};
use lobefit::data::{Place, Smith};

/// Places along each of three axes at which a plain reading is judged of a table with more than
/// [`super::JUDGED_TEXELS`]: every one is an integral of its own.
const PLACES: usize = 16;

/// Channels in words.
const PLACES_OF: [&str; 4] = ["first", "second", "third", "fourth"];

/// What a clamp of an input is called.
pub(super) const CLAMPED: &str = " clamped to ";

/// The column of an error, and where it is.
pub type Where = (Column, Place);

/// A table under the plain reading, where the best reading is another.
#[derive(Clone, Debug, PartialEq)]
pub struct Plain {
    /// That reading.
    pub convention: Convention,
    /// What the best reading has that no reader assumes unless the file says so, in words.
    pub untold: Vec<String>,
    /// Options that say it.
    pub options: String,
    /// Texels that were judged, and texels in all.
    pub texels: [usize; 2],
    /// Largest error at those that were judged; infinite where the truth cannot be had at any.
    pub max: f64,
    /// The column of that, and where; none where the truth cannot be had.
    pub at: Option<Where>,
    /// What the best reading decodes and this one takes as it is stored.
    pub encoding: Option<&'static Encoding>,
}

impl Plain {
    /// Whether nothing but the lobe is another, or the clamps of inputs: files of such have a use of their
    /// own, and only a limit fails them for it.
    pub fn is_of_another_use(&self, best: &Convention) -> bool {
        let own = &self.convention;
        let axes = own.axes.iter().zip(&best.axes).all(|(own, best)| own.like(best));
        axes && own.columns == best.columns && self.encoding.is_none()
    }
}

/// The plain reading of a table; none if the best one is plain, or what is not is said by the user.
pub(super) fn plain(truth: &Truth, case: &Case, best: &Candidate) -> Result<Option<Plain>, AuditError> {
    let Case { table, live, fixed, .. } = *case;
    let convention = best.convention(truth, live, table.channels.len());
    let mut read = convention.clone();
    let (mut said, mut options) = (Vec::new(), Vec::new());
    for (name, axis) in table.axes.iter().zip(&mut read.axes) {
        let own = *axis;
        if fixed.axes.is_none() {
            scaled(name, table.source, axis);
        }
        if fixed.registrations.is_none() && table.source == Source::Table {
            axis.registration = axis.registration.plain();
        }
        if (own.scale, own.reversed) != (axis.scale, axis.reversed) {
            said.push((own.words(), name.clone()));
        }
        if own.registration != axis.registration {
            said.push((own.registration.words().to_string(), name.clone()));
        }
    }
    if let Some(both) = transposed(table.source, &convention.axes).filter(|_| fixed.axes.is_none()) {
        let named = both.map(|axis| (convention.axes[axis].scale.name().into(), table.axes[axis].clone()));
        said.splice(..0, named);
        read.axes.swap(both[0], both[1]);
    }
    let mut untold = along(&said);
    let lobe = usual_lobe(truth, best.lobe);
    if lobe != best.lobe && fixed.form.is_none() {
        read.lobe = truth.lobes[lobe];
        untold.push(convention.lobe.form.words.into());
        options.push(format!("--smith {}", convention.lobe.form.word));
    }
    let differs = |a: &AxisReading, b: &AxisReading| (a.scale, a.reversed) != (b.scale, b.reversed);
    if read.axes.iter().zip(&convention.axes).any(|(a, b)| differs(a, b)) {
        let word = |a: &AxisReading| format!("{}{}", if a.reversed { "1-" } else { "" }, a.scale.name());
        options.push(format!("--axes {}", list(&convention.axes, word)));
    }
    let shifted =
        |a: &&AxisReading| fixed.registrations.is_none() && a.registration != a.registration.plain();
    if table.source == Source::Table && convention.axes.iter().any(|a| shifted(&a)) {
        options.push(format!("--registration {}", list(&convention.axes, |a| a.registration.name().into())));
    }
    let at = |wanted: Column| convention.columns.iter().position(|c| *c == Some(wanted));
    let mut judged = live.to_vec();
    if let (Some(a), Some(b), None) = (at(Column::A), at(Column::B), &fixed.meanings) {
        let next = if b < a { b } else { a + 1 };
        // Channels before A that hold nothing are fetched all the same.
        let is_late = b > a && a > 0 && (0..a).all(|k| convention.columns[k].is_none());
        let is_apart = (b > next || is_late) && table.source == Source::Table;
        if b < a {
            read.columns.swap(a, b);
            untold.push("B before A".into());
        } else if is_apart {
            if is_late {
                read.columns.swap(0, a);
                read.columns.swap(1, b);
            } else {
                read.columns.swap(next, b);
            }
            let read: Vec<usize> = (0..read.columns.len()).filter(|k| read.columns[*k].is_some()).collect();
            judged.extend(read);
            untold.push(format!(
                "B in the {} channel, A in the {}",
                PLACES_OF[b.min(3)],
                PLACES_OF[a.min(3)]
            ));
        }
        if b < a || is_apart {
            options.push(format!("--meaning {}", meanings(&convention.columns)));
        }
    }
    for column in
        read.columns.iter_mut().flatten().filter(|_| fixed.meanings.is_none() && fixed.column.is_none())
    {
        let told = match column {
            Column::Normal => Column::Average,
            Column::NormalLoss => Column::AverageLoss,
            _ => continue,
        };
        untold.push(column.words());
        options.push(format!("--as {}:'{}'", truth.spec.quantity.name(), column.name()));
        *column = told;
    }
    let is_of_another_use = untold.is_empty() || untold.len() == 1 && read.lobe != convention.lobe;
    // Of what is misread otherwise clamps say nothing.
    for (axis, n) in read.axes.iter_mut().zip(&table.size).filter(|_| is_of_another_use) {
        let input = axis.scale.input();
        let bare = AxisReading { floor: 0.0, ..*axis };
        // What clamps one line alone, at an end, is no other use.
        let lines = (0..*n).filter(|i| bare.node(*i, *n) <= axis.floor).count();
        if fixed.floor(input).is_none() && lines > 1 {
            let floor = number(axis.floor);
            untold.push(format!("{}{CLAMPED}{floor}", input.name()));
            options.push(format!("--clamp {}={floor}", input.name()));
            *axis = bare;
        }
    }
    if untold.is_empty() {
        return Ok(None);
    }
    let lobe = if fixed.form.is_none() { lobe } else { best.lobe };
    judged.sort();
    judged.dedup();
    let (max, judged, at) = worst(truth, table, &judged, lobe, &read)?;
    let texels = [judged, table.size.iter().product()];
    let options = options.join(" ");
    Ok(Some(Plain { convention: read, untold, options, texels, max, at, encoding: None }))
}

fn list(axes: &[AxisReading], word: impl Fn(&AxisReading) -> String) -> String {
    axes.iter().map(word).collect::<Vec<_>>().join(",")
}

/// The coordinate that a reader takes an axis for. Roughness and alpha are both passed as they are;
/// their powers come of squaring once too often. An argument that is named for gloss is one,
/// 1 - roughness.
fn scaled(name: &str, source: Source, axis: &mut AxisReading) {
    let gloss = source == Source::Function && is_gloss(name);
    if axis.scale.input() == Input::Alpha {
        let usual = matches!(axis.scale, Scale::Roughness | Scale::Alpha) && !gloss;
        axis.scale = if usual { axis.scale } else { Scale::Roughness };
    }
    // A split sum is looked up with the cosine itself.
    if axis.scale.input() == Input::Mu && source == Source::Table {
        axis.scale = Scale::Mu;
    }
    axis.reversed = gloss && axis.scale.input() == Input::Alpha;
}

/// Whether an argument of a function is what a reader takes it for.
pub(super) fn is_usual(name: &str, axis: &AxisReading) -> bool {
    let mut usual = *axis;
    scaled(name, Source::Function, &mut usual);
    let named_otherwise = axis.scale == Scale::Alpha && name.to_lowercase().contains("rough");
    usual == *axis && !named_otherwise && (axis.scale.input() != Input::Mu || axis.scale == Scale::Mu)
}

/// The lobe that a quantity's name stands for: height-correlated where it is of Smith's.
fn usual_lobe(truth: &Truth, own: usize) -> usize {
    let lobes = &truth.lobes;
    let usual = |l: &Lobe| {
        let is_form = l.form.integrand.is_none() && l.form.smith != Some(Smith::Separable);
        is_form && (l.side, l.both) == (lobes[own].side, lobes[own].both)
    };
    if usual(&lobes[own]) { own } else { lobes.iter().position(usual).unwrap_or(own) }
}

/// How far a table of a form that the quantity's variants do not have is from the one that its
/// name stands for, otherwise read as it is best read; none of any other table.
pub(super) fn departure(
    truth: &Truth,
    case: &Case,
    best: &Candidate,
) -> Result<Option<(Lobe, f64)>, AuditError> {
    let Case { table, live, .. } = *case;
    let lobe = usual_lobe(truth, best.lobe);
    if lobe == best.lobe {
        return Ok(None);
    }
    let convention = best.convention(truth, live, table.channels.len());
    let (max, ..) = worst(truth, table, live, lobe, &convention)?;
    Ok(Some((truth.lobes[lobe], max)))
}

/// The axes that are exchanged: a table of two axes is looked up at (mu, roughness), and the slices of one of
/// three are of one index each.
fn transposed(source: Source, axes: &[AxisReading]) -> Option<[usize; 2]> {
    let inputs: Vec<Input> = axes.iter().map(|a| a.scale.input()).collect();
    match inputs[..] {
        _ if source != Source::Table => None,
        [Input::Alpha, Input::Mu] => Some([0, 1]),
        [Input::Ior, _, _] => Some([0, 2]),
        [_, Input::Ior, _] => Some([1, 2]),
        _ => None,
    }
}

/// Largest error of any judged channel under a reading, infinite where the truth cannot be had at any texel,
/// how many texels were judged, and the column and place of the error.
pub(super) fn worst(
    truth: &Truth,
    table: &AuditedTable,
    live: &[usize],
    lobe: usize,
    read: &Convention,
) -> Result<(f64, usize, Option<Where>), AuditError> {
    let whole = super::whole(truth, lobe, &table.size);
    let solid = whole != usize::MAX && table.size.len() == 3;
    let sample = Sample::new(table, live, if solid { PLACES } else { whole }, false);
    let judgement = judge(truth, &sample, &read.axes, lobe, Truth::exact)?;
    let mut most: Option<(f64, Where)> = None;
    for (place, k) in live.iter().enumerate() {
        let Some(column) = read.columns[*k] else { continue };
        let residuals = Residuals::new(&sample, &judgement, column, &sample.values[place]);
        if residuals.judged.is_empty() {
            continue;
        }
        let figures = residuals.figures(|texel| super::inputs_at(read, &table.size, texel));
        if most.as_ref().is_none_or(|most| figures.max > most.0) {
            most = Some((figures.max, (column, figures.at)));
        }
    }
    let judged = judgement.judged.iter().filter(|j| **j).count();
    let (max, at) = most.map_or((f64::INFINITY, None), |(max, at)| (max, Some(at)));
    Ok((max, judged, at))
}
