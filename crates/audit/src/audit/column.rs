//! What a channel may hold: a column of a quantity, or what people store instead of one.

use super::truth::{averaged, spec};
use lobefit_truth::quantity::Quantity;

/// What columns are made of: E and B for reflection, R and T for glass, E_avg and E(mu = 1) for
/// averages; then the scale of transmitted radiance, 1/eta^2 with eta the index beyond the surface
/// over that before it, which is 0 but of glass.
pub type Base = [f64; 3];

/// What a channel holds: a function of [`Base`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// Directional albedo.
    E,
    /// Scale of Schlick's F0.
    A,
    /// Bias of Schlick's F0.
    B,
    /// 1 - E.
    Loss,
    /// 1/E, a normalisation.
    Inverse,
    /// 1/E - 1, the added share of a compensation.
    Excess,
    /// B/E.
    Share,
    /// f0 A + B of one f0, in hundredths: 2, 4 or 8, which most dielectrics lie between.
    At(u8),
    /// Reflected energy of glass.
    R,
    /// Transmitted energy of glass.
    T,
    /// R + T.
    RT,
    /// 1 - R - T.
    LossRT,
    /// 1/(R + T).
    InverseRT,
    /// R/(R + T).
    ShareR,
    /// 1 - R.
    LossR,
    /// T/eta^2, the radiance of what is transmitted.
    RadianceT,
    /// R + T/eta^2, what a path tracer of radiance sums to.
    Radiance,
    /// Cosine-weighted average of E.
    Average,
    /// 1 - E_avg.
    AverageLoss,
    /// 1/E_avg.
    AverageInverse,
    /// Cosine-weighted average of R + T of glass.
    AverageRT,
    /// 1 less that.
    AverageLossRT,
    /// Its inverse.
    AverageInverseRT,
    /// Cosine-weighted average of R of glass.
    AverageR,
    /// E at normal incidence, which passes for an average.
    Normal,
    /// 1 - E at normal incidence.
    NormalLoss,
}

/// Columns of reflection.
pub const REFLECTION: [Column; 10] = [
    Column::E,
    Column::A,
    Column::B,
    Column::Loss,
    Column::Inverse,
    Column::Excess,
    Column::Share,
    Column::At(2),
    Column::At(4),
    Column::At(8),
];
/// Columns of a quantity that has E alone.
pub const ALBEDO: [Column; 4] = [Column::E, Column::Loss, Column::Inverse, Column::Excess];
/// Columns of glass.
pub const GLASS: [Column; 9] = [
    Column::RT,
    Column::LossRT,
    Column::InverseRT,
    Column::R,
    Column::T,
    Column::ShareR,
    Column::LossR,
    Column::RadianceT,
    Column::Radiance,
];
/// Columns of averages.
pub const AVERAGE: [Column; 5] =
    [Column::Average, Column::AverageLoss, Column::AverageInverse, Column::Normal, Column::NormalLoss];
/// Columns of averages of glass.
pub const GLASS_MEAN: [Column; 4] =
    [Column::AverageRT, Column::AverageLossRT, Column::AverageInverseRT, Column::AverageR];
/// Columns of averages of a quantity of which there is no other.
pub const MEAN: [Column; 3] = [Column::Average, Column::AverageLoss, Column::AverageInverse];

/// What members of a structure that hold a column are called, beside its own word.
const MEMBERS: [(&str, &str); 9] = [
    ("scale", "A"),
    ("bias", "B"),
    ("offset", "B"),
    ("albedo", "E"),
    ("loss", "1-E"),
    ("reflected", "R"),
    ("reflectance", "R"),
    ("transmitted", "T"),
    ("transmittance", "T"),
];

/// What a column of one f0 is.
const FIXED: &str = "f0 A + B at that f0, fixed";

impl Column {
    /// What channels of a table of a quantity, or of its averages, may hold; nothing for a quantity
    /// that is not audited.
    pub fn of(quantity: &dyn Quantity) -> Vec<Column> {
        let specs = spec(quantity).into_iter().chain(averaged(quantity));
        specs.flat_map(|spec| spec.columns.iter().copied()).collect()
    }

    /// What results of a function hold by their names, of some columns: the members of a structure, as
    /// `dfg.scale`. Beside a g a single letter is a colour.
    pub(super) fn named(results: &[&str], columns: &[Column]) -> Vec<Option<Column>> {
        let member = |name: &str| name.rsplit('.').next().unwrap_or(name).to_ascii_lowercase();
        let are_colours = results.iter().any(|name| member(name) == "g");
        let of = |name: &&str| {
            let member = member(name);
            let word =
                MEMBERS.iter().find(|(own, _)| *own == member).map_or(member.as_str(), |(_, word)| word);
            let is_told = |column: &&Column| column.name().eq_ignore_ascii_case(word);
            columns.iter().find(is_told).copied().filter(|_| !(are_colours && member.len() == 1))
        };
        results.iter().map(of).collect()
    }

    /// The word in options, verdicts and files, and what it is.
    fn told(self) -> (&'static str, &'static str) {
        match self {
            Column::E | Column::RT => ("E", "the albedo"),
            Column::A => ("A", "scale of f0"),
            Column::B => ("B", "bias of f0"),
            Column::Loss | Column::LossRT => ("1-E", "the loss"),
            Column::Inverse | Column::InverseRT => ("1/E", "a normalisation"),
            Column::Excess => ("1/E-1", "the share that a compensation adds"),
            Column::Share => ("B/E", "a ratio"),
            Column::At(2) => ("f0=0.02", FIXED),
            Column::At(4) => ("f0=0.04", FIXED),
            Column::At(_) => ("f0=0.08", FIXED),
            Column::R => ("R", "reflected"),
            Column::T => ("T", "transmitted"),
            Column::ShareR => ("R/E", "a ratio"),
            Column::LossR => ("1-R", "what is not reflected"),
            Column::RadianceT => ("T/eta^2", "transmitted, scaled as radiance"),
            Column::Radiance => ("R+T/eta^2", "the albedo with T scaled as radiance"),
            Column::Average | Column::AverageRT => ("E_avg", "the cosine-weighted average"),
            Column::AverageLoss | Column::AverageLossRT => ("1-E_avg", "the loss"),
            Column::AverageInverse | Column::AverageInverseRT => ("1/E_avg", "a normalisation"),
            Column::AverageR => ("R_avg", "reflected, the cosine-weighted average"),
            Column::Normal => ("E(mu=1)", "E at normal incidence, no average"),
            Column::NormalLoss => ("1-E(mu=1)", "the loss"),
        }
    }

    /// The word in options, verdicts and files.
    pub fn name(self) -> &'static str {
        self.told().0
    }

    /// For readers: the name with what it is.
    pub fn words(self) -> String {
        let (name, what) = self.told();
        format!("{name} ({what})")
    }

    /// Its value.
    pub fn value(self, [first, second, scale]: Base) -> f64 {
        match self {
            Column::E | Column::R | Column::Average | Column::AverageR => first,
            Column::A => first - second,
            Column::B | Column::T | Column::Normal => second,
            Column::Loss | Column::AverageLoss => 1.0 - first,
            Column::Inverse | Column::AverageInverse => 1.0 / first,
            Column::Excess => 1.0 / first - 1.0,
            Column::Share => second / first,
            Column::At(percent) => second + f64::from(percent) / 100.0 * (first - second),
            Column::RT | Column::AverageRT => first + second,
            Column::LossRT | Column::AverageLossRT => 1.0 - first - second,
            Column::InverseRT | Column::AverageInverseRT => 1.0 / (first + second),
            Column::ShareR => first / (first + second),
            Column::NormalLoss => 1.0 - second,
            Column::LossR => 1.0 - first,
            Column::RadianceT => second * scale,
            Column::Radiance => first + second * scale,
        }
    }

    /// How far it moves at most for what it is made of: 1 of E, 1/E^2 of a normalisation.
    pub fn slope(self, base: Base) -> f64 {
        const STEP: f64 = 1e-6;
        let moved = |k: usize| {
            let [mut low, mut high] = [base; 2];
            (low[k], high[k]) = (low[k] - STEP, high[k] + STEP);
            ((self.value(high) - self.value(low)) / (2.0 * STEP)).abs()
        };
        moved(0).max(moved(1))
    }

    /// The albedo that a value of this column stands for; none for those that are parts of one.
    pub fn albedo(self, value: f64) -> Option<f64> {
        match self {
            Column::E | Column::RT | Column::Average | Column::AverageRT | Column::Normal => Some(value),
            Column::Loss
            | Column::LossRT
            | Column::AverageLoss
            | Column::AverageLossRT
            | Column::NormalLoss => Some(1.0 - value),
            Column::Inverse | Column::InverseRT | Column::AverageInverse | Column::AverageInverseRT => {
                Some(1.0 / value)
            }
            Column::Excess => Some(1.0 / (1.0 + value)),
            _ => None,
        }
    }

    /// Whether a lobe is multiplied by it to be white.
    pub fn is_normalisation(self) -> bool {
        use Column::{AverageInverse, AverageInverseRT, Inverse, InverseRT};
        matches!(self, Inverse | InverseRT | AverageInverse | AverageInverseRT)
    }

    /// Whether few tables hold it, so that the verdict takes it only where it is clearly better than
    /// what others hold.
    pub fn is_rare(self) -> bool {
        use Column::{LossR, Radiance, RadianceT, Share, ShareR};
        matches!(self, Share | ShareR | LossR | RadianceT | Radiance)
    }

    /// Whether it is what f0 A + B is made of: at an f0 of 1 a function has their sum.
    pub fn is_part(self) -> bool {
        matches!(self, Column::A | Column::B | Column::Share)
    }

    /// Whether it is of one f0: B is near to all of these columns, so that only clear figures
    /// distinguish them.
    pub fn is_fixed(self) -> bool {
        matches!(self, Column::At(_))
    }
}
