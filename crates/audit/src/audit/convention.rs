//! A whole convention, what of it is given, and how well one fits.

use super::AuditError;
use super::arguments::role;
use super::axis::{AxisReading, Input, REGISTRATIONS, Registration, Scale};
use super::column::Column;
use super::encoded::Encoding;
use super::lobe::{Form, Lobe};
use super::table::{AuditedTable, Source};
use super::truth::Truth;
use lobefit_math::lanes::{self, LANES};
use lobefit_truth::integrate::glass::Side;

/// The word of `--meaning` for a channel that is left out.
pub const LEFT_OUT: &str = "-";

/// What tells the inputs of a function, as no option does.
pub(super) const NAMES: &str = "the names of its arguments";

/// The column that is asked for behind the quantity.
pub(super) const COLUMN: &str = "the column of --as";

/// The option that states what channels hold.
pub(super) const MEANING: &str = "--meaning";

/// One way to read a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Convention {
    /// How every axis is read, in the table's order.
    pub axes: Vec<AxisReading>,
    /// Which lobe.
    pub lobe: Lobe,
    /// What every channel holds; none for one that is not judged.
    pub columns: Vec<Option<Column>>,
}

/// What the user says of a table: everything else is tried.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fixed {
    /// Scale of every axis and whether it is reversed.
    pub axes: Option<Vec<(Scale, bool)>>,
    /// Registration of every axis, or one for all.
    pub registrations: Option<Vec<Registration>>,
    /// Shadowing form.
    pub form: Option<&'static Form>,
    /// Side of the ray.
    pub side: Option<Side>,
    /// What the channels hold, in their order; none of one that is left out.
    pub meanings: Option<Vec<Option<Column>>>,
    /// The one column that is asked for.
    pub column: Option<Column>,
    /// Least values that inputs were clamped to.
    pub floors: Vec<(Input, f64)>,
    /// Of a slice of a table: the input that does not run along an axis of it, and its value.
    pub at: Option<(Input, f64)>,
    /// What the values are decoded from.
    pub encoding: Option<&'static Encoding>,
    /// Samples that each texel is the mean of.
    pub samples: Option<u32>,
    /// Texels of each channel that are drawn for whoever integrates them again.
    pub points: usize,
    /// Of a function: what the names of its arguments tell.
    pub roles: Option<Vec<Option<Input>>>,
    /// Of a function: what the names of its results tell, by live channel.
    pub told: Vec<Option<Column>>,
    /// Of a function of two arguments: each is given what the name of the other tells.
    pub swapped: bool,
    /// Of a function: its argument that is named for an index of refraction was given 1/ior, as
    /// [`sampled_inverse`](super::sampled_inverse) does.
    pub inverse: bool,
    /// Of a function: ranges of inputs in which it is judged.
    pub domain: Vec<(Input, [f64; 2])>,
}

impl Fixed {
    /// Whether nothing but the column, and where and how strictly it is judged, is given.
    pub fn is_free(&self) -> bool {
        let free =
            Fixed { swapped: false, inverse: false, at: None, samples: None, points: 0, ..self.clone() };
        Fixed { column: None, domain: Vec::new(), ..free } == Fixed::default()
    }

    /// The same without one of what is given, and at last without all of it; by the option. Of a function
    /// the names of its arguments are given.
    pub fn without(&self, table: &AuditedTable) -> Vec<(&'static str, Fixed)> {
        let roles: Vec<Option<Input>> = table.axes.iter().map(|name| role(name)).collect();
        let are_named = matches!(roles[..], [first, second] if first != second);
        let of_function = table.source == Source::Function && self.axes.is_none() && are_named;
        let own = || self.clone();
        let Fixed { inverse, at, samples, points, .. } = *self;
        let free = Fixed { inverse, at, samples, points, ..Fixed::default() };
        let all = [
            ("--smith", Fixed { form: None, ..own() }),
            ("--side", Fixed { side: None, ..own() }),
            ("--registration", Fixed { registrations: None, ..own() }),
            ("--axes", Fixed { axes: None, ..own() }),
            (MEANING, Fixed { meanings: None, ..own() }),
            ("--encoding", Fixed { encoding: None, ..own() }),
            ("--clamp", Fixed { floors: Vec::new(), ..own() }),
            (COLUMN, Fixed { column: None, ..own() }),
            (NAMES, Fixed { swapped: of_function, ..own() }),
            ("those options", Fixed { column: self.column, domain: self.domain.clone(), ..free }),
        ];
        all.into_iter().filter(|(_, fixed)| fixed != self).collect()
    }

    /// Refuses what cannot be meant for a table of this many axes and channels.
    pub(super) fn check(&self, truth: &Truth, axes: usize, channels: usize) -> Result<(), AuditError> {
        let refuse =
            |option, value: String, reason: String| Err(AuditError::Option { option, value, reason });
        if let Some(given) = &self.axes {
            let names = given.iter().map(|(s, _)| s.name()).collect::<Vec<_>>().join(",");
            if given.len() != axes {
                return refuse("--axes", names, format!("the table has {axes} axes"));
            }
            let mut inputs: Vec<Input> = given.iter().map(|(s, _)| s.input()).collect();
            let mut wanted = truth.spec.inputs.to_vec();
            inputs.sort();
            wanted.sort();
            if inputs != wanted {
                let wanted: Vec<&str> = wanted.iter().map(|i| i.name()).collect();
                let reason = format!("{} has the inputs {}", truth.spec.quantity.name(), wanted.join(", "));
                return refuse("--axes", names, reason);
            }
        }
        if let Some(given) = &self.registrations
            && given.len() != 1
            && given.len() != axes
        {
            let names = given.iter().map(|s| s.name()).collect::<Vec<_>>().join(",");
            return refuse("--registration", names, format!("one word or {axes} are called for"));
        }
        if let Some(given) = &self.meanings
            && given.len() != channels
        {
            return refuse(
                "--meaning",
                meanings(given),
                format!(
                    "{channels} channels vary; a word for each of those is called for, or one for every channel"
                ),
            );
        }
        if let Some(given) = self.meanings.as_ref().filter(|given| given.iter().all(Option::is_none)) {
            return refuse("--meaning", meanings(given), "every channel is left out".into());
        }
        if let Some((input, floor)) = self.floors.iter().find(|(input, _)| !truth.spec.inputs.contains(input))
        {
            let reason = format!("{} has no such input", truth.spec.quantity.name());
            return refuse("--clamp", format!("{}={floor:?}", input.name()), reason);
        }
        let unknown = |c: &&Column| !truth.spec.columns.contains(c);
        let asked = self.meanings.iter().flatten().flatten().chain(&self.column);
        if let Some(bad) = asked.into_iter().find(unknown) {
            let names: Vec<&str> = truth.spec.columns.iter().map(|c| c.name()).collect();
            let reason = format!("{} has {}", truth.spec.quantity.name(), names.join(", "));
            return refuse("--meaning", bad.name().into(), reason);
        }
        Ok(())
    }

    /// The ways to read axis `axis` as an input.
    pub(super) fn readings(&self, axis: usize, input: Input) -> Vec<AxisReading> {
        let scales: Vec<(Scale, bool)> = match (&self.axes, &self.roles) {
            (Some(given), _) => {
                given.get(axis).copied().filter(|(s, _)| s.input() == input).into_iter().collect()
            }
            (None, Some(roles)) => argument(input, roles.get(axis).copied().flatten(), self.inverse),
            (None, None) => input.scales().flat_map(|s| [(s, false), (s, true)]).collect(),
        };
        let registrations: Vec<Registration> = match &self.registrations {
            Some(given) if given.len() == 1 => given.clone(),
            Some(given) => given.get(axis).copied().into_iter().collect(),
            None => REGISTRATIONS.to_vec(),
        };
        let both = |(scale, reversed): (Scale, bool)| {
            let floor = self.floor(input).unwrap_or(0.0);
            let reading = |r: &Registration| AxisReading { floor, ..AxisReading::new(scale, *r, reversed) };
            registrations.iter().map(reading).collect::<Vec<_>>()
        };
        scales.into_iter().flat_map(both).collect()
    }

    /// The clamp of an input, if it is given.
    pub(super) fn floor(&self, input: Input) -> Option<f64> {
        self.floors.iter().find(|(own, _)| *own == input).map(|(_, floor)| *floor)
    }

    /// The lobes to be tried, by their place.
    pub(super) fn lobes(&self, truth: &Truth) -> Vec<usize> {
        let fits = |l: &Lobe| {
            self.form.is_none_or(|form| l.form == form)
                && self.side.is_none_or(|s| !l.both && l.side.is_none_or(|own| own == s))
        };
        (0..truth.lobes.len()).filter(|i| fits(&truth.lobes[*i])).collect()
    }
}

/// Words of what channels hold, as `--meaning` takes them.
pub(super) fn meanings(given: &[Option<Column>]) -> String {
    given.iter().map(|c| c.map_or(LEFT_OUT, Column::name)).collect::<Vec<_>>().join(",")
}

/// What an argument may be given for an input: nobody passes the root of a cosine, and one that is
/// named for a cosine is one.
fn argument(input: Input, role: Option<Input>, inverse: bool) -> Vec<(Scale, bool)> {
    match (input, role) {
        (_, Some(role)) if role != input => Vec::new(),
        (Input::Mu, Some(_)) => vec![(Scale::Mu, false)],
        (Input::Mu, None) => vec![(Scale::Mu, false), (Scale::Mu, true), (Scale::Theta, false)],
        (Input::Ior, Some(_)) => vec![(if inverse { Scale::Eta } else { Scale::Ior }, false)],
        _ => {
            let own = input.scales().filter(|s| !s.is_of_both_sides());
            own.flat_map(|s| [(s, false), (s, true)]).collect()
        }
    }
}

/// How well values fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// Root mean square.
    pub rms: f64,
    /// Root mean square of the four fifths that fit best.
    pub trimmed: f64,
    /// Largest.
    pub max: f64,
}

/// Share of the texels that the trimmed figure keeps, in fifths.
const KEPT_FIFTHS: usize = 4;

impl Misfit {
    /// Of errors, none of them NaN; an empty list fits perfectly.
    pub(super) fn of(errors: &[f64]) -> Misfit {
        let n = errors.len().max(1);
        let kept = errors.len() * KEPT_FIFTHS / 5;
        let (mut squares, mut all, mut most) = (Vec::with_capacity(errors.len()), 0.0, 0.0_f64);
        for error in errors {
            let square = error * error;
            squares.push(square);
            all += square;
            most = most.max(square);
        }
        if kept > 0 && kept < squares.len() {
            squares.select_nth_unstable_by(kept, f64::total_cmp);
        }
        let least: f64 = squares[..kept].iter().sum();
        Misfit {
            rms: (all / n as f64).sqrt(),
            trimmed: (least / kept.max(1) as f64).sqrt(),
            max: most.sqrt(),
        }
    }

    /// A bound of the rank of the errors of values, from below: no square that the trimmed figure leaves out
    /// is above the largest.
    pub(super) fn least_rank(values: &[f64], truths: &[f64]) -> f64 {
        let n = values.len();
        let (values, last) = values.as_chunks::<LANES>();
        let (truths, last_truths) = truths.as_chunks::<LANES>();
        let (mut sums, mut largest) = ([0.0; LANES], [0.0_f64; LANES]);
        for (values, truths) in values.iter().zip(truths) {
            for i in 0..LANES {
                let error = values[i] - truths[i];
                sums[i] += error * error;
                largest[i] = if error * error > largest[i] { error * error } else { largest[i] };
            }
        }
        let squares = last.iter().zip(last_truths).map(|(value, truth)| (value - truth) * (value - truth));
        let sum = lanes::sum(&sums) + squares.clone().sum::<f64>();
        let most = largest.into_iter().chain(squares).fold(0.0, f64::max);
        let kept = n * KEPT_FIFTHS / 5;
        // A part in 1e9 of the sum covers its rounding, which takes another order here than in the
        // figure.
        let least = (sum * (1.0 - 1e-9) - (n - kept) as f64 * most).max(0.0);
        let (rms, trimmed) =
            ((sum * (1.0 - 1e-9) / n.max(1) as f64).sqrt(), (least / kept.max(1) as f64).sqrt());
        ((trimmed + 1e-9) * (rms + 1e-9)).sqrt()
    }

    /// What conventions are ranked by: the geometric mean of both root mean squares. A table of
    /// which a part is stale fits its true convention in the trimmed figure, one with a wrong clamp
    /// shows in the other; 1e-9 keeps an exact fit from hiding what else is wrong.
    pub(super) fn rank(&self) -> f64 {
        ((self.trimmed + 1e-9) * (self.rms + 1e-9)).sqrt()
    }
}
