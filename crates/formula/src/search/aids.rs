//! What forms may have beside sums of powers: what is always tried, what only where it pays.

use super::SearchJob;
use super::space;
use crate::fitting::FittingError;
use lobefit::approximate::target::{Target, TargetError};
use lobefit::data::Use;
use lobefit::report::words::operations;
use lobefit_fit::search::{Aid, Helper, Link, Progress, SearchAxis, SearchSamples, Space, Trial, scout};

/// A kind of function beside sums of powers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AidKind {
    /// 1 - mu.
    Complement,
    /// 1 / (mu + k alpha).
    Reciprocal,
    /// sqrt(mu), sqrt(roughness).
    Root,
    /// exp2(-k mu), exp2(-k roughness).
    Decay,
    /// 1 / sqrt(mu + k alpha).
    InverseRoot,
    /// exp2 of the whole form.
    Exp2,
    /// The root of the whole form.
    RootOf,
    /// The whole form squared.
    Square,
}

/// Which of them a search uses.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Aids {
    /// Complement and reciprocal, where they suit the quantity; and of the others those that pay in
    /// narrow searches.
    #[default]
    Auto,
    /// These, whether they pay or not.
    These(Vec<AidKind>),
}

/// What was tried beforehand.
#[derive(Clone, Debug)]
pub struct Tried {
    /// The function searched for, where a formula is made of two.
    pub part: Option<&'static str>,
    /// What was tried, as a formula.
    pub words: String,
    /// What it gained.
    pub trial: Trial,
}

impl Aids {
    /// The first of those asked for that is a function of a whole form.
    pub(super) fn of_whole(&self) -> Option<AidKind> {
        let Aids::These(kinds) = self else { return None };
        kinds.iter().copied().find(|k| matches!(k, AidKind::Exp2 | AidKind::RootOf | AidKind::Square))
    }
}

impl AidKind {
    /// All kinds.
    pub const ALL: [AidKind; 8] = [
        AidKind::Complement,
        AidKind::Reciprocal,
        AidKind::Root,
        AidKind::Decay,
        AidKind::InverseRoot,
        AidKind::Exp2,
        AidKind::RootOf,
        AidKind::Square,
    ];

    /// Name, as in an option.
    pub fn name(self) -> &'static str {
        match self {
            AidKind::Complement => "complement",
            AidKind::Reciprocal => "reciprocal",
            AidKind::Root => "root",
            AidKind::Decay => "decay",
            AidKind::InverseRoot => "inverse-root",
            AidKind::Exp2 => "exp2",
            AidKind::RootOf => "root-of",
            AidKind::Square => "square",
        }
    }

    /// The aids of this kind over these axes. Helpers read mu and roughness where the quantity has
    /// them, else every axis; the reciprocals are homogeneous where mu is as large as alpha, or, of
    /// cloth, as roughness.
    fn aids(self, target: &Target, axes: &[SearchAxis]) -> Vec<Aid> {
        let (mu, rough) = (space::place(axes, "mu"), space::place(axes, "roughness"));
        let both = mu.zip(rough).map(|(x, y)| (x, y, space::order(target)));
        let some: Vec<u8> = mu.into_iter().chain(rough).collect();
        let some = if some.is_empty() { (0..axes.len() as u8).collect() } else { some };
        let helpers = |make: fn(u8) -> Helper| some.iter().map(|axis| Aid::Helper(make(*axis))).collect();
        match self {
            AidKind::Complement => {
                mu.map(|axis| Aid::Helper(Helper::Complement { axis })).into_iter().collect()
            }
            AidKind::Reciprocal => both
                .map(|(x, y, power)| Aid::Helper(Helper::Reciprocal { x, y, power }))
                .into_iter()
                .collect(),
            AidKind::Root => helpers(|axis| Helper::Root { axis }),
            AidKind::Decay => helpers(|axis| Helper::Decay { axis, power: 1 }),
            AidKind::InverseRoot => both
                .map(|(x, y, power)| Aid::Helper(Helper::RootReciprocal { x, y, power }))
                .into_iter()
                .collect(),
            AidKind::Exp2 => vec![Aid::Link(Link::Exp2)],
            AidKind::RootOf => vec![Aid::Link(Link::Root)],
            AidKind::Square => vec![Aid::Link(Link::Square)],
        }
    }
}

/// The space with what the job asks for: given, or, of `usual` and what pays; and what was tried.
/// `whole`: forms may be put into functions.
pub(super) fn aided(
    mut space: Space,
    usual: &[AidKind],
    whole: bool,
    asked: (&Target, &SearchJob),
    samples: &SearchSamples,
    progress: &dyn Fn(&Progress),
) -> Result<(Space, Vec<Trial>), FittingError> {
    let (target, job) = asked;
    let of = |kinds: &[AidKind], axes: &[SearchAxis]| -> Vec<Aid> {
        let aids = kinds.iter().flat_map(|kind| kind.aids(target, axes));
        aids.filter(|aid| whole || matches!(aid, Aid::Helper(_))).collect()
    };
    let kinds = match &job.aids {
        Aids::Auto => usual,
        Aids::These(kinds) => kinds,
    };
    for aid in of(kinds, &space.axes) {
        match aid {
            Aid::Helper(helper) => space.helpers.push(helper),
            Aid::Link(link) => space.links.push(link),
        }
    }
    if let Aids::These(kinds) = &job.aids {
        let nothing = |kind: &&AidKind| kind.aids(target, &space.axes).is_empty();
        if let Some(kind) = kinds.iter().find(nothing) {
            let reason = "it takes mu, or mu and roughness, and they have no range here".into();
            return Err(TargetError::Edge { setting: "helpers", input: kind.name().into(), reason }.into());
        }
        return Ok((space, Vec::new()));
    }
    let others: Vec<AidKind> = AidKind::ALL[2..].to_vec();
    let trials = scout(&space, &of(&others, &space.axes), samples, progress)?;
    for trial in trials.iter().filter(|t| t.admitted) {
        match trial.aid {
            Aid::Helper(helper) => {
                space.helpers.push(helper);
                space.admitted.push(helper);
            }
            Aid::Link(link) => space.links.push(link),
        }
    }
    Ok((space, trials))
}

/// What a search by itself begins with: a value falls off from grazing by powers of 1 - mu; factors
/// of the furnace are rational in mu already. A smooth lobe depends on mu/alpha alone, and the rim
/// of cloth on mu/roughness: one reciprocal makes both degree 0.
pub(super) fn usual(target: &Target) -> &'static [AidKind] {
    match target.used_as {
        Use::VALUE => &[AidKind::Complement, AidKind::Reciprocal],
        _ => &[AidKind::Reciprocal],
    }
}

/// Trials with their names.
pub(super) fn named(axes: &[SearchAxis], part: Option<&'static str>, trials: Vec<Trial>) -> Vec<Tried> {
    let argument = |axis: u8, power: u8| -> String {
        let arguments = &axes[axis as usize].arguments;
        let own = arguments.iter().find(|(_, p)| *p == u32::from(power));
        own.map_or_else(|| format!("{}^{power}", arguments[0].0), |(name, _)| name.clone())
    };
    let words = |aid: Aid| match aid {
        Aid::Helper(Helper::Complement { axis }) => format!("1 - {}", argument(axis, 1)),
        Aid::Helper(Helper::Root { axis }) => format!("sqrt({})", argument(axis, 1)),
        Aid::Helper(Helper::Decay { axis, power }) => format!("exp2(-k {})", argument(axis, power)),
        Aid::Helper(Helper::Reciprocal { x, y, power }) => {
            format!("1 / ({} + k {})", argument(x, 1), argument(y, power))
        }
        Aid::Helper(Helper::RootReciprocal { x, y, power }) => {
            format!("1 / sqrt({} + k {})", argument(x, 1), argument(y, power))
        }
        Aid::Link(Link::Exp2) => "exp2(form)".into(),
        Aid::Link(Link::Root) => "sqrt(form)".into(),
        Aid::Link(Link::Square) => "form squared".into(),
    };
    trials.into_iter().map(|trial| Tried { part, words: words(trial.aid), trial }).collect()
}

impl Tried {
    /// What came of it, in words.
    pub fn outcome(&self) -> String {
        let Trial { gain, ops, admitted, .. } = self.trial;
        // Less than the printed digits.
        if gain < 5e-4 {
            return "no gain: not used".into();
        }
        let used = if admitted { "used" } else { "not used" };
        format!("{:.1} % less error at {}: {used}", 100.0 * gain, operations(ops))
    }
}
