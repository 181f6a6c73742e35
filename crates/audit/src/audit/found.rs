//! What an audit finds out, as plain data.

use super::axis::Input;
use super::column::Column;
use super::convention::{Convention, Misfit};
use super::defects::Defect;
use super::encoded::Encoding;
use super::errors::{Drawn, TexelErrors};
use super::lobe::{Form, Lobe};
use super::lookup::LookupErrors;
use super::plain::Plain;
use super::published::Published;
use super::table::Source;
use super::truth::Beyond;
use super::two_lobes::TwoLobes;
use super::verdict::{Figure, Verdict};
use lobefit::data::Place;
use lobefit::report::words;
use serde::Serialize;

/// How a table fits its best convention, the better first; in JSON `whole`, `part` or `none`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Fit {
    /// Its errors are small beside the spread of the truth.
    Whole,
    /// A part of it fits and the rest does not: stale or damaged.
    Part,
    /// It fits none.
    #[default]
    None,
}

/// A convention that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// The convention.
    pub convention: Convention,
    /// Figures of the channels that are judged, by channel.
    pub misfits: Vec<Option<Misfit>>,
    /// What it ranks by.
    pub rank: f64,
}

/// The furnace: E over the E that the table makes the shader believe, less 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Furnace {
    /// The column of the table's E, or the one that two are halves of.
    pub column: Column,
    /// Least and largest; infinite where the table's E is 0 or less.
    pub range: [f64; 2],
    /// Where the magnitude is largest; the first such place.
    pub at: Place,
    /// Texels where the table's E is 0 or less, of which no compensation can be made.
    pub dark: usize,
}

/// What a channel holds that follows no column of the quantity.
#[derive(Clone, Debug, PartialEq)]
pub enum Other {
    /// Another quantity, judged as that.
    Quantity(Box<Audit>),
    /// The same as the channel of this name.
    Same(String),
    /// Nothing that is known.
    Unknown,
}

/// A channel under the best convention.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChannelAudit {
    /// Its name.
    pub name: String,
    /// What it holds; none if it is constant or not asked for.
    pub column: Option<Column>,
    /// Its value, if it is constant and was not asked for.
    pub constant: Option<f64>,
    /// What it holds, if it was left out because it is foreign to the quantity.
    pub other: Option<Other>,
    /// Its errors at the texels, where it is judged.
    pub errors: Option<TexelErrors>,
    /// Their root mean square beside what the truth spans, of an albedo at most 1, without what noise,
    /// rounding and the samples that were stated explain.
    pub left: f64,
    /// Texels that were drawn from those that are judged, as many as were asked for.
    pub points: Vec<Drawn>,
    /// How it fits.
    pub fit: Fit,
    /// Signed errors of the texels, the first axis fastest, of at most 64 (three axes) or 4096
    /// places along each; empty if not judged.
    pub map: Vec<f64>,
    /// The truth at those texels.
    pub truth: Vec<f64>,
    /// What is wrong with it.
    pub defects: Vec<Defect>,
    /// Its lookup with the best registration.
    pub lookup: Option<LookupErrors>,
    /// Its lookup as a texture unit does it without a remap of the coordinates.
    pub plain_lookup: Option<LookupErrors>,
}

/// What was found out.
#[derive(Clone, Debug, PartialEq)]
pub struct Audit {
    /// File and array.
    pub what: String,
    /// Quantity.
    pub quantity: &'static str,
    /// What the values are of.
    pub source: Source,
    /// Size of the table without axes of one texel.
    pub size: Vec<usize>,
    /// Names of its axes.
    pub axes: Vec<String>,
    /// Places along every axis at which the maps are given.
    pub places: Vec<Vec<usize>>,
    /// How the whole fits: as its worst channel.
    pub fit: Fit,
    /// The conventions, the best first.
    pub tried: Vec<Tried>,
    /// Rank of the next that differs over that of the first; infinite if there is none.
    pub margin: f64,
    /// Whether part of the convention was given by the user.
    pub fixed: bool,
    /// The shadowing form that the user stated.
    pub form: Option<&'static Form>,
    /// Of a slice: the input that is the same throughout, and its value.
    pub at: Option<(Input, f64)>,
    /// Without which options it follows a convention, where it follows none that they leave open: one, as
    /// `--smith`, or all.
    pub excluded: Option<&'static str>,
    /// Whether the user said which channels are meant: others may be constant.
    pub excused: bool,
    /// The plain reading, where the best reading is another and the user did not say that the other
    /// is meant.
    pub plain: Option<Plain>,
    /// Of a table of a shadowing form that the quantity's variants do not have: the lobe that its
    /// name stands for, and the largest error held against that.
    pub departure: Option<(Lobe, f64)>,
    /// Of a table of A and B, lookups of f0 A + B at the f0 in [0, 1] where they are worst.
    pub blend: Option<LookupErrors>,
    /// The channels.
    pub channels: Vec<ChannelAudit>,
    /// The furnace, where the channels make an albedo.
    pub furnace: Option<Furnace>,
    /// The parts of a table that was made with two shadowing forms; the best convention is that of
    /// the larger part.
    pub two_lobes: Option<TwoLobes>,
    /// Why texels are not judged, where some are not.
    pub beyond: Vec<Beyond>,
    /// Bound of the truth's own error.
    pub truth_error: f64,
    /// What its values were decoded from.
    pub encoding: Option<&'static Encoding>,
    /// Of a function: the published formula whose values it has.
    pub published: Option<Published>,
    /// Which known file it is, in a sentence.
    pub shipped: Option<String>,
    /// What else is to be said of it, in sentences.
    pub remarks: Vec<String>,
}

impl Audit {
    /// Of no factor of all channels a channel may have one of its own: it fits but for that.
    pub(super) fn excuse_factors(&mut self) {
        for channel in self.channels.iter_mut().filter(|c| c.fit == Fit::None) {
            let is_scaled = channel.defects.iter().any(|d| matches!(d, Defect::Factor { .. }));
            channel.fit = if is_scaled { Fit::Whole } else { Fit::None };
        }
        let judged = self.channels.iter().filter(|c| c.column.is_some());
        self.fit = judged.map(|c| c.fit).fold(Fit::Whole, Fit::max);
    }

    /// Of two audits of the same function, whose arguments were given other things, the one that
    /// fits better, with the conventions of both.
    pub fn beside(self, other: Audit) -> Audit {
        let (mut best, rest) =
            if other.tried[0].rank < self.tried[0].rank { (other, self) } else { (self, other) };
        best.tried.extend(rest.tried);
        best.tried.sort_by(|a, b| a.rank.total_cmp(&b.rank));
        best.tried.truncate(super::TOLD);
        best.margin = super::margin(&best.tried.iter().map(|t| t.rank).collect::<Vec<_>>());
        best
    }

    /// The verdict; `limit` is the largest error that the user allows.
    pub fn verdict(&self, limit: Option<f64>) -> Verdict {
        super::verdict::of(self, limit)
    }

    /// The best convention.
    pub fn best(&self) -> &Convention {
        &self.tried[0].convention
    }

    /// Largest error at a texel of any judged channel, of one of another quantity too.
    pub fn worst(&self) -> f64 {
        super::verdict::worst(self, true).map_or(0.0, |(_, errors)| errors.max)
    }

    /// The name of a channel in words: beside red, blue is not B, nor alpha A.
    pub(super) fn channel(&self, name: &str) -> String {
        let colours = self.channels.iter().any(|c| c.name == "R");
        match name {
            "B" if colours => "B(lue)".into(),
            "A" if colours => "A(lpha)".into(),
            other => other.into(),
        }
    }

    /// What was not judged, for which it passes no limit: texels that were not sampled, or constant
    /// channels that no option leaves out.
    pub fn unjudged(&self) -> Option<String> {
        let sampled = |c: &ChannelAudit| c.errors.as_ref().map_or(0, |e| e.unsampled);
        if let Some(n) = self.channels.iter().map(sampled).max().filter(|n| *n > 0) {
            let texels = words::count(n, "texel was", "texels were");
            return Some(format!("{texels} not sampled: audit the table in slices"));
        }
        let dead = self.channels.iter().filter(|c| c.constant.is_some() && !self.excused && !self.pads(c));
        let names: Vec<String> = dead.map(|c| self.channel(&c.name)).collect();
        if !names.is_empty() {
            let advice =
                "give --meaning for every channel to judge it, or for those that vary to leave it out";
            return Some(format!("channel {} is constant: {advice}", names.join(", ")));
        }
        let foreign = self.channels.iter().find(|c| c.other == Some(Other::Unknown))?;
        let word = |c: &ChannelAudit| c.column.map_or("-", Column::name);
        let words: Vec<&str> = self.channels.iter().filter(|c| c.constant.is_none()).map(word).collect();
        Some(format!(
            "channel {} follows nothing that is known: give --meaning {} to leave it out",
            self.channel(&foreign.name),
            words.join(",")
        ))
    }

    /// Whether a channel only fills a pixel up, as blue or alpha beside two channels of a table do: it
    /// is 0 or 1 throughout, and what the others hold is the whole energy.
    pub(super) fn pads(&self, channel: &ChannelAudit) -> bool {
        let held = |column| self.channels.iter().any(|c| c.column == Some(column));
        let whole = [Column::E, Column::Loss, Column::Inverse, Column::Excess, Column::RT, Column::LossRT];
        let halves = [[Column::A, Column::B], [Column::R, Column::T]];
        let is_whole =
            whole.into_iter().any(held) || halves.into_iter().any(|both| both.into_iter().all(held));
        is_whole && channel.constant.is_some_and(|x| x == 0.0 || x == 1.0)
    }

    /// The furnace error |E N - 1| of a function that is a normalisation: what a limit is on, as 1/E may
    /// be large.
    pub fn furnace_error(&self) -> Option<f64> {
        let held = || self.channels.iter().filter_map(|c| c.column);
        let is_one = held().next().is_some() && held().all(Column::is_normalisation);
        let furnace = self.furnace.as_ref().filter(|f| f.dark == 0 && self.source == Source::Function)?;
        (is_one && self.plain.is_none()).then(|| furnace.range[0].abs().max(furnace.range[1].abs()))
    }

    /// The plain reading where the verdict is on it: with a limit that it alone is over; without one, where a
    /// reader would have to be told of more than another shadowing.
    pub fn misread(&self, limit: Option<f64>) -> Option<&Plain> {
        let plain = self.plain.as_ref().filter(|_| self.fit != Fit::None)?;
        let decides = match limit {
            Some(limit) => self.fit == Fit::Whole && self.worst() <= limit && plain.max > limit,
            None => {
                self.fit == Fit::Whole && self.two_lobes.is_none() && !plain.is_of_another_use(self.best())
            }
        };
        decides.then_some(plain)
    }

    /// The shadowing that a published formula was fitted to, where it is held against another.
    pub(super) fn made_for(&self) -> Option<&'static Form> {
        self.published.as_ref()?.made_for.filter(|form| *form != self.best().lobe.form)
    }

    /// The published formula that a function is, which is no approximation of what it is held against.
    pub(super) fn misfit(&self) -> Option<&Published> {
        self.published.as_ref().filter(|_| self.fit == Fit::None && self.excluded.is_none())
    }

    /// The figure that the verdict is on: of the error, the place and the kind; none where nothing is judged.
    pub fn figure(&self, limit: Option<f64>) -> Option<Figure> {
        super::verdict::figure(self, limit)
    }

    /// Whether all of it fits, and the figure that the verdict is on is within a limit.
    pub fn keeps(&self, limit: f64) -> bool {
        self.fit == Fit::Whole && self.figure(Some(limit)).is_some_and(|figure| figure.value <= limit)
    }

    /// Whether it is what it is said to be: it fits, all of it was judged, and no texel is off by
    /// more than the limit, as it is best read and as it will be read. With nothing given by the
    /// user and no limit an audit only tells.
    pub fn passes(&self, limit: Option<f64>) -> bool {
        match limit {
            Some(limit) => self.keeps(limit) && self.unjudged().is_none(),
            None => !self.fixed || self.fit != Fit::None,
        }
    }
}
