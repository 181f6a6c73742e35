//! What may be searched: inputs, the point where a form must be exact, helpers, limits; and the
//! samples.

use super::helper::Helper;
use super::link::Link;
use super::scout::Aid;
use crate::FitError;
use lobefit_shade::{Domain, Features, Hypothesis, ShadeError};

/// An independent input with the arguments that are its powers.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchAxis {
    /// Arguments of the formula, by name and power, rising: `[("roughness", 1), ("alpha", 2)]`. The
    /// first has power 1 and names the axis. What is given as an argument costs nothing.
    pub arguments: Vec<(String, u32)>,
    /// Highest power of this axis in a term.
    pub degree: u8,
}

/// A value that a form takes exactly where some inputs are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Anchor {
    /// The value: 1 for a normalisation.
    pub value: f32,
    /// Indices of the axes at whose 0 it is taken.
    pub zeros: Vec<usize>,
}

/// What is searched.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// Beginning of the names of the formulas that are found; their operations are appended:
    /// `ggx_norm_` gives `ggx_norm_13`.
    pub name: String,
    /// First line of their documentation.
    pub title: String,
    /// Inputs.
    pub axes: Vec<SearchAxis>,
    /// Where forms must be exact; none: forms are plain quotients.
    pub anchor: Option<Anchor>,
    /// Name of a further argument t, none of the axes: the formulas are 1 - t times forms, and
    /// searched for t = 0.
    pub faded: Option<String>,
    /// Functions of the inputs that may be factors of terms.
    pub helpers: Vec<Helper>,
    /// Those of the helpers that are there because they paid: the best forms without them are
    /// measured too.
    pub admitted: Vec<Helper>,
    /// What every form's value is put into.
    pub link: Option<Link>,
    /// Links with which a search is done again.
    pub links: Vec<Link>,
    /// Most operations, by [`lobefit_shade::Tape::cost_ops`].
    pub max_ops: u32,
    /// What the kinds of work cost, where the frontier is to be by their sum; none: by operations.
    pub prices: Option<Features>,
    /// Forms of each cost that are built upon.
    pub width: usize,
    /// Times that all costs are gone through.
    pub sweeps: usize,
    /// Most free coefficients.
    pub coefficients: usize,
    /// Where the forms must have no pole; axes and derived inputs named as the arguments are. None:
    /// not proven.
    pub domain: Option<Domain>,
}

/// Residuals `scale f(inputs) - target` that a search minimises the largest of.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchSamples {
    /// One column per axis of the space: its first argument.
    pub axes: Vec<Vec<f64>>,
    /// Factor of the formula's value.
    pub scale: Vec<f64>,
    /// What the product should be.
    pub target: Vec<f64>,
}

/// How many times as many forms are solved where they are priced: of 24 that are built upon, 16.
const PRICED: usize = 4;

/// Powers that a term may have of axes and helpers together.
pub(super) const SLOTS: usize = 6;

/// Forms of each cost that are built upon, usually.
const WIDTH: usize = 24;

impl Space {
    /// A space over axes with the usual limits: width 24, 3 sweeps, 14 coefficients, no helpers, no
    /// anchor.
    pub fn new(name: &str, axes: Vec<SearchAxis>, max_ops: u32) -> Space {
        Space {
            name: name.to_string(),
            title: String::new(),
            axes,
            anchor: None,
            faded: None,
            helpers: Vec::new(),
            admitted: Vec::new(),
            link: None,
            links: Vec::new(),
            max_ops,
            prices: None,
            width: WIDTH,
            sweeps: 3,
            coefficients: 14,
            domain: None,
        }
    }

    /// What a formula costs.
    pub(super) fn price(&self, formula: &Hypothesis) -> f64 {
        let tape = formula.tape();
        self.prices.map_or_else(|| f64::from(tape.cost_ops()), |prices| prices.price(&tape.features()))
    }

    /// How many forms of a number of operations are solved on all samples, where `count` are when
    /// only the most accurate of them matters: others may be cheaper.
    pub(super) fn finalists(&self, count: usize) -> usize {
        if self.prices.is_some() { PRICED * count } else { count }
    }

    /// What is kept where `count` are in a space of the usual width.
    pub(super) fn widened(&self, count: usize) -> usize {
        (count * self.width).div_ceil(WIDTH)
    }

    /// The space with an aid in addition; none where the link does not take the anchor's value.
    pub fn with(&self, aid: Aid) -> Option<Space> {
        let mut space = self.clone();
        match aid {
            Aid::Helper(helper) => {
                space.helpers.push(helper);
                space.admitted.push(helper);
            }
            Aid::Link(link) => {
                if let Some(anchor) = &self.anchor {
                    link.base(anchor.value)?;
                }
                space.link = Some(link);
            }
        }
        Some(space)
    }

    /// What P/Q is added to.
    pub(super) fn base(&self) -> Option<f32> {
        let base = |value: f32| self.link.map_or(Some(value), |link| link.base(value));
        self.anchor.as_ref().and_then(|anchor| base(anchor.value)).filter(|value| *value != 0.0)
    }

    /// Checks that the space makes sense and that the samples are its.
    pub(super) fn check(&self, samples: &SearchSamples) -> Result<(), FitError> {
        let bad = |input: &str, message: &str| {
            Err(ShadeError::Domain { input: input.to_string(), message: message.to_string() }.into())
        };
        let name = |k: usize| self.axes[k].arguments.first().map_or("", |(name, _)| name.as_str());
        if self.axes.is_empty() || self.axes.len() + 2 > SLOTS {
            return bad(&self.name, "a search has one to four axes");
        }
        for axis in &self.axes {
            let first = axis.arguments.first();
            let rising = axis.arguments.windows(2).all(|w| w[0].1 < w[1].1);
            if first.is_none_or(|(_, power)| *power != 1) || !rising {
                return bad(&self.name, "the arguments of an axis are powers of the first, rising from 1");
            }
        }
        if let Some(anchor) = &self.anchor
            && let Some(k) = anchor.zeros.iter().find(|k| **k >= self.axes.len())
        {
            return bad(&self.name, &format!("the anchor names axis {k} of {}", self.axes.len()));
        }
        if samples.axes.len() != self.axes.len() {
            let what = format!("{}: columns of axes", self.name);
            return Err(
                ShadeError::Shape { what, found: samples.axes.len(), expected: self.axes.len() }.into()
            );
        }
        let named = samples.axes.iter().enumerate().map(|(k, c)| (name(k), c));
        for (column, values) in named.chain([("scale", &samples.scale), ("target", &samples.target)]) {
            if values.len() != samples.target.len() || values.is_empty() {
                let what = format!("{}: samples of {column}", self.name);
                return Err(ShadeError::Shape {
                    what,
                    found: values.len(),
                    expected: samples.target.len().max(1),
                }
                .into());
            }
            if let Some(index) = values.iter().position(|v| !v.is_finite()) {
                return Err(ShadeError::NotFinite {
                    column: column.to_string(),
                    index,
                    value: values[index],
                }
                .into());
            }
        }
        Ok(())
    }
}

/// Samples that forms are ranked on.
const RANKED: usize = 480;

/// How many of those lie on the edges of the samples' box.
const EDGES: usize = 220;

impl SearchSamples {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.target.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.target.is_empty()
    }

    /// The samples that forms are ranked on.
    pub(super) fn ranked(&self) -> SearchSamples {
        self.some([RANKED, EDGES])
    }

    /// So many of all, and so many of the edges, where largest errors hide.
    pub(super) fn some(&self, [among, on_edges]: [usize; 2]) -> SearchSamples {
        if self.len() <= among + on_edges {
            return self.clone();
        }
        let ends: Vec<[f64; 2]> = self
            .axes
            .iter()
            .map(|column| {
                column.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], x| [lo.min(*x), hi.max(*x)])
            })
            .collect();
        let on_edge =
            |i: &usize| self.axes.iter().zip(&ends).any(|(column, ends)| ends.contains(&column[*i]));
        let all: Vec<usize> = (0..self.len()).collect();
        let edges: Vec<usize> = all.iter().copied().filter(|i| on_edge(i)).collect();
        let mut picked = spread(&all, among);
        picked.extend(spread(&edges, on_edges));
        picked.sort_unstable();
        picked.dedup();
        let pick = |column: &Vec<f64>| picked.iter().map(|&i| column[i]).collect();
        SearchSamples {
            axes: self.axes.iter().map(pick).collect(),
            scale: pick(&self.scale),
            target: pick(&self.target),
        }
    }
}

/// At most `count` of a list, spread over it by the golden ratio.
fn spread(list: &[usize], count: usize) -> Vec<usize> {
    if list.len() <= count {
        return list.to_vec();
    }
    let at = |i: usize| {
        let u = (i as f64 + 0.5) * 0.618_033_988_749_894_9;
        list[(((u - u.floor()) * list.len() as f64) as usize).min(list.len() - 1)]
    };
    (0..count).map(at).collect()
}
