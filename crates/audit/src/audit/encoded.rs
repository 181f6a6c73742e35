//! Values that were encoded, for display or to hold more than the format can: a table that fits only
//! once that is undone.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::apart;
use super::best::{Best, Case, best, promising, truth_of};
use super::defects::stored;
use super::plain::{CLAMPED, Plain, worst};
use super::table::{AuditedTable, Source};
use super::{Audit, AuditError, FITS, Fit};
use crate::foreign::{Channel, Step};
use lobefit_math::{ops, srgb};
use lobefit_truth::quantity::Quantity;

/// Most axes of a table of which this is tried: of three every try takes seconds, and pictures have
/// two.
const AXES: usize = 2;

/// An encoding: a line of [`ENCODINGS`].
#[derive(Debug)]
pub struct Encoding {
    /// The word of `--encoding`.
    pub word: &'static str,
    /// Its name.
    pub name: &'static str,
    /// What to do about it.
    pub remedy: &'static str,
    /// The value of what is stored, at a texel whose alpha is given,
    decode: fn(f64, f64) -> f64,
    /// times this.
    factor: f64,
    /// The step of a decoded value, of values with this step.
    step: fn(Step) -> Step,
    /// Whether it takes the alpha beside three colours of 8 bits, which is no channel then.
    takes_alpha: bool,
}

/// Every encoding for display, or to hold more than the format can; a constant factor is one too.
pub static ENCODINGS: [Encoding; 6] = [
    Encoding {
        word: "srgb",
        name: "sRGB",
        remedy: "its values were encoded for display: store them as they are, or sample it as an sRGB texture",
        decode: |x, _| srgb::decoded(x),
        step: |stored| match stored {
            Step::Unorm(bits) => Step::Srgb((1 << bits) - 1),
            _ => Step::None,
        },
        factor: 1.0,
        takes_alpha: false,
    },
    Encoding {
        word: "gamma-2.2",
        name: "gamma 2.2",
        remedy: "its values were encoded for display: store them as they are",
        decode: |x, _| ops::pow(x, 2.2),
        step: |stored| of_power(stored, 22),
        factor: 1.0,
        takes_alpha: false,
    },
    Encoding {
        word: "gamma-2",
        name: "gamma 2",
        remedy: "its values are square roots: store them as they are, or square what is sampled",
        decode: |x, _| x * x,
        step: |stored| of_power(stored, 20),
        factor: 1.0,
        takes_alpha: false,
    },
    Encoding {
        word: "rgbe",
        name: "RGBE",
        remedy: "decode it before it is filtered: the mean of two exponents is no exponent of the mean",
        decode: |x, alpha| x * 255.0 / 256.0 * ops::pow(2.0, 255.0 * alpha - 128.0),
        step: |_| Step::Rgbe,
        factor: 1.0,
        takes_alpha: true,
    },
    Encoding {
        word: "rgbd-2.2",
        name: "RGBD of gamma 2.2",
        remedy: "decode it before it is filtered: the mean of two divisors is no divisor of the mean",
        decode: |x, alpha| ops::pow(x, 2.2) / alpha,
        step: |_| Step::Rgbd(22),
        factor: 1.0,
        takes_alpha: true,
    },
    Encoding {
        word: "rgbd",
        name: "RGBD",
        remedy: "decode it before it is filtered: the mean of two divisors is no divisor of the mean",
        decode: |x, alpha| x / alpha,
        step: |_| Step::Rgbd(10),
        factor: 1.0,
        takes_alpha: true,
    },
];

/// The step of values that were encoded by a power, in tenths.
fn of_power(stored: Step, tenths: u32) -> Step {
    if let Step::Unorm(bits) = stored { Step::Gamma((1 << bits) - 1, tenths) } else { Step::None }
}

/// Factors that have a name, and it: of a normalisation that is left out or counted twice.
const FACTORS: [(f64, &str); 6] =
    [(PI, "pi"), (1.0 / PI, "1/pi"), (2.0, "2"), (0.5, "1/2"), (4.0, "4"), (0.25, "1/4")];

/// A factor is one of these within this share of it, and 1 as well.
const NEAR: f64 = 0.02;

/// Of two encodings that a table follows a later one is taken where it leaves this share of the misfit.
const NEARER: f64 = 0.9;

/// What a factor may leave of what it explains, the share by which it changes values.
const EXPLAINED: f64 = 0.1;

/// Share of the largest loss that the smallest is below.
const SMALL: f64 = 0.01;

/// How the word of a constant factor begins.
const TIMES: &str = "times=";

impl PartialEq for Encoding {
    fn eq(&self, other: &Encoding) -> bool {
        self.word == other.word
    }
}

impl Encoding {
    /// The encoding of a word of `--encoding`: one of a list, or `times=F`.
    pub fn find(word: &str) -> Option<&'static Encoding> {
        let named = |name: &str| FACTORS.iter().find(|(_, own)| *own == name).map(|(factor, _)| *factor);
        let number = |text: &str| named(text).or_else(|| text.parse().ok());
        let factor = word.strip_prefix(TIMES).and_then(number).filter(|f| f.is_finite() && *f > 0.0);
        ENCODINGS.iter().find(|own| own.word == word).or_else(|| factor.map(Encoding::times))
    }

    /// That of values which are all so many times what they should be.
    fn times(factor: f64) -> &'static Encoding {
        let near = |own: &&(f64, &str)| (factor / own.0 - 1.0).abs() < NEAR;
        let (factor, name) = match FACTORS.iter().find(near) {
            Some((factor, name)) => (*factor, name.to_string()),
            None => (factor, format!("{factor}")),
        };
        // A run has few.
        let leak = |text: String| -> &'static str { Box::leak(text.into_boxed_str()) };
        Box::leak(Box::new(Encoding {
            word: leak(format!("{TIMES}{name}")),
            name: leak(format!("times {name}")),
            remedy: leak(format!("divide its values by {name}: they are {name} times what they should be")),
            decode: |x, _| x,
            factor: 1.0 / factor,
            step: |stored| stored,
            takes_alpha: false,
        }))
    }

    /// Whether values are colours, 0 to 1, which a linear picture does not hold.
    fn is_of_colours(&self) -> bool {
        self.factor == 1.0
    }

    /// The share by which a factor changes values.
    fn changes(&self) -> f64 {
        (self.factor - 1.0).abs()
    }

    /// A table without the encoding; none of one that cannot have it.
    fn undone(&self, table: &AuditedTable) -> Option<AuditedTable> {
        // Beside colours alpha is none of them; beside B or E it is the scale of f0.
        let is_beside_colours = table.channels.iter().any(|c| ["R", "G", "Y"].contains(&c.name.as_str()));
        let is_plane = |c: &&Channel| c.name == "A" && is_beside_colours;
        let alpha = table.channels.iter().find(is_plane);
        // What the format says is decoded already.
        if self.is_of_colours() && matches!(table.step, Step::Srgb(_)) {
            return None;
        }
        let colours = table.channels.iter().filter(|c| !self.is_of_colours() || !is_plane(c));
        let alphas = match (alpha, self.takes_alpha) {
            (Some(alpha), true) if table.channels.len() == 4 && table.step == Step::Unorm(8) => &alpha.values,
            (_, true) => return None,
            (_, false) => &table.channels[0].values,
        };
        let decoded = |c: &Channel| {
            let both = c.values.par_iter().zip(&**alphas);
            let values = both.map(|(x, alpha)| self.factor * (self.decode)(*x, *alpha));
            Channel { name: c.name.clone(), values: values.collect::<Vec<_>>().into() }
        };
        let channels: Vec<Channel> = colours.map(decoded).collect();
        let finite = channels.iter().flat_map(|c| c.values.iter()).all(|v| v.is_finite());
        let unit = table.channels.iter().flat_map(|c| c.values.iter()).all(|v| (0.0..=1.0).contains(v));
        let first = table.channels.iter().find(|c| c.varies()).unwrap_or(&table.channels[0]);
        let step = (self.step)(stored(table.step, &first.values));
        let decoded = AuditedTable { channels, step, scale: self.factor, ..table.clone() };
        // A Radiance picture is linear, and so is a function.
        let is_picture = unit && table.step != Step::Rgbe && table.source == Source::Table;
        let held = !self.is_of_colours() || is_picture;
        (finite && held && !decoded.channels.is_empty()).then_some(decoded)
    }

    /// Its name, of an encoding for display behind some words.
    pub(super) fn said(&self, encoded: &str) -> String {
        if self.is_of_colours() { format!("{encoded}{}", self.name) } else { self.name.into() }
    }

    /// The table that the user says is encoded so.
    pub(super) fn decoded(&self, table: &AuditedTable) -> Result<AuditedTable, AuditError> {
        let alpha = if self.takes_alpha { " beside an alpha of 8 bits above 0" } else { "" };
        self.undone(table).ok_or_else(|| AuditError::Option {
            option: "--encoding",
            value: self.word.into(),
            reason: format!("{} is not encoded so: colours from 0 to 1{alpha} are called for", table.what),
        })
    }

    /// An audit of the decoded table, which nobody said to be encoded, with how far off the stored values are
    /// under the convention of the decoded ones.
    pub(super) fn beside(
        &'static self,
        read: Audit,
        stored: &Case,
        quantity: &dyn Quantity,
    ) -> Result<Audit, AuditError> {
        let told = read.plain.clone();
        let mut convention = told.as_ref().map_or(read.best(), |plain| &plain.convention).clone();
        for (axis, own) in
            convention.axes.iter_mut().zip(&read.best().axes).filter(|(axis, own)| axis.like(own))
        {
            axis.floor = own.floor;
        }
        let (mut untold, mut options) =
            told.map_or((Vec::new(), String::new()), |plain| (plain.untold, plain.options + " "));
        untold.retain(|word| !word.contains(CLAMPED));
        untold.insert(0, format!("values {}", self.said("encoded as ")));
        options += &format!("--encoding {}", self.word);
        let truth = truth_of(stored.table, quantity, stored.fixed, &[convention.lobe.form])?;
        let lobe = truth.lobes.iter().position(|lobe| *lobe == convention.lobe).unwrap_or(0);
        let held = |k: &usize| convention.columns.get(*k).is_some_and(Option::is_some);
        let live: Vec<usize> = stored.live.iter().copied().filter(held).collect();
        let (max, judged, at) = worst(&truth, stored.table, &live, lobe, &convention)?;
        let texels = [judged, stored.table.size.iter().product()];
        let plain = Plain { convention, untold, options, texels, max, at, encoding: Some(self) };
        Ok(Audit { plain: Some(plain), fixed: !stored.fixed.is_free(), ..read })
    }
}

/// The encoding of a table that fits nothing as it is stored, but does when its values are decoded; none
/// if it does not.
pub(super) fn found(
    case: &Case,
    quantity: &dyn Quantity,
    done: &Audit,
) -> Result<Option<&'static Encoding>, AuditError> {
    let fixed = case.fixed;
    let said = fixed.meanings.as_ref().map(Vec::len);
    if done.fit != Fit::None || case.table.size.len() > AXES || fixed.encoding.is_some() {
        return Ok(None);
    }
    let mut nearest: Option<(f64, &Encoding)> = None;
    for encoding in ENCODINGS.iter().chain(factors(case, quantity)) {
        let Some(linear) = encoding.undone(case.table) else { continue };
        let Ok(live) = linear.live(said) else { continue };
        if said.is_some_and(|said| said != live.len()) {
            continue;
        }
        let case = Case { table: &linear, live: &live, fixed, progress: &|_| () };
        let likely: Vec<usize> = promising(&case, quantity)?.into_iter().map(|place| live[place]).collect();
        // A channel of another quantity does not condemn the others.
        let some = said.is_none() && likely.len() > 1;
        let all = likely.len() == live.len() || some;
        let case = Case { live: &likely, ..case };
        let whole = if all { off(&case, quantity)? } else { f64::INFINITY };
        let off = match whole <= FITS {
            false if some && encoding.is_of_colours() && apart::following(&case, quantity)?.len() > 1 => FITS,
            _ => whole,
        };
        // sRGB and a gamma are near to each other. A factor makes more of the difference than is left.
        let most = if encoding.is_of_colours() { FITS } else { FITS.min(EXPLAINED * encoding.changes()) };
        if off <= most && nearest.is_none_or(|(least, _)| off < NEARER * least) {
            nearest = Some((off, encoding));
        }
    }
    Ok(nearest.map(|(_, encoding)| encoding))
}

/// Constant factors that a table may have: of a lobe whose albedo is 1 where it is smooth the largest value,
/// and those that have a name of one channel that may be the loss, which is 0 there.
fn factors(case: &Case, quantity: &dyn Quantity) -> Vec<&'static Encoding> {
    let named = || FACTORS[..4].iter().map(|(factor, _)| Encoding::times(*factor));
    if !quantity.outputs().contains(&"B") {
        return named().collect();
    }
    let values = || case.live.iter().flat_map(|k| case.table.channels[*k].values.iter());
    let [least, most] = values().fold([f64::INFINITY, 0.0], |[least, most], v| [least.min(*v), most.max(*v)]);
    let may_be_loss = case.live.len() == 1 && least < SMALL * most;
    // Three digits: a texel is not quite smooth.
    let most = format!("{most:.2e}").parse().unwrap_or(most);
    let of_most = (most > 0.0 && (most - 1.0_f64).abs() > NEAR).then(|| Encoding::times(most));
    let rest = named().filter(|own| may_be_loss && Some(*own) != of_most);
    of_most.into_iter().chain(rest).collect()
}

/// Whether a table follows a convention, as far as some of its texels tell.
pub(super) fn follows(case: &Case, quantity: &dyn Quantity) -> Result<bool, AuditError> {
    Ok(off(case, quantity)? <= FITS)
}

/// The largest misfit of a channel under the best convention, as far as some of its texels tell.
fn off(case: &Case, quantity: &dyn Quantity) -> Result<f64, AuditError> {
    // Of numbers that mean nothing all channels may be near to one column.
    let is_one = |best: &Best| {
        let columns = &best.found[0].fitted.columns;
        columns.len() > 1 && columns.iter().all(|column| *column == columns[0])
    };
    Ok(best(case, quantity)?.filter(|best| !is_one(best)).map_or(f64::INFINITY, |best| best.off))
}
