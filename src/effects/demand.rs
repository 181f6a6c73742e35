//! What a scene wants of an effect: a demand for each material or probe, merged into jobs.

use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use super::BakeError;
use crate::approximate::{CallOps, Emission, Entry, Formulas, Region};
use crate::data::AlphaMap;
use crate::report::words;
use crate::scene::{Goals, Output, Scene, smallest_rough};

/// Narrowest roughness range of a table, and of a fit beside inputs that vary but mu and ior: one value has
/// no axis to interpolate along, and formulas of all inputs are hardly determined by it, so it is widened
/// about itself to this width; the figure is a choice, small beside the curvature of E in roughness.
pub const ROUGHNESS_WIDTH_MIN: f64 = 0.01;

/// Largest ratio of ior - 1 at the ends of a range beside one roughness: formulas of mu and ior are chosen
/// for 1.3 to 1.7, a ratio of 2.33; over 1.1 to 2.5 those of all inputs err less.
const INDICES_RATIO: f64 = 2.5;

/// Range by input.
pub type Ranges = BTreeMap<&'static str, [f64; 2]>;

/// The range of an input that a material spans, and how narrow the range of its job may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Smallest and largest value.
    pub range: [f64; 2],
    least: Least,
    one: One,
}

/// Whether a job of one value keeps it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum One {
    /// It becomes a range.
    Never,
    /// Where every other input but mu and ior has one value too: there are formulas of these alone.
    Alone,
    /// There are formulas without the input.
    Always,
}

/// The narrowest range of a job, inside a domain.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Least {
    /// One value.
    Point,
    /// This difference of its ends.
    Width(f64, [f64; 2]),
    /// This ratio of its ends.
    Ratio(f64, [f64; 2]),
}

/// What one material or probe wants of an effect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demand {
    /// Name of the job that it joins; demands of one job have one name.
    pub job: Cow<'static, str>,
    /// Place of the job among the effect's; equal ranks keep the order of first mention.
    pub rank: usize,
    /// Place of the material or probe in its list of the scene.
    pub of: usize,
    /// Place of the want, where the material has several.
    pub item: usize,
    /// Name of the material or probe.
    pub name: String,
    /// Field of the scene that holds the goals: `materials[0].wants.fit`.
    pub field: String,
    /// Why, as a sentence; [`Called`](super::Called) takes it.
    pub because: String,
    /// Domain by input, each once: a scene may have a hundred thousand demands.
    pub spans: Vec<(&'static str, Span)>,
    /// What must be met.
    pub goals: Goals,
    /// The layer of the material whose roughness it is of; none of the specular lobe and of probes.
    pub layer: Option<&'static str>,
    /// What its call of a formula takes.
    pub call: CallOps,
}

/// The budget of a job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Most operations of a call; any number where the demands state no budget.
    pub max_ops: Option<u32>,
    /// What such a call takes.
    pub call: CallOps,
}

/// What calls a function: a material by one of its layers, or a probe.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Caller {
    /// Name of the material or probe.
    pub name: String,
    /// As [`Demand::layer`].
    pub layer: Option<&'static str>,
}

/// A limit that materials or probes set: one emitted fit of at most `max_ops` operations within
/// `max_error`, or the table within it.
#[derive(Clone, Debug, PartialEq)]
pub struct Promise {
    /// Most operations; `None`: any.
    pub max_ops: Option<u32>,
    /// Largest error of the use.
    pub max_error: f64,
    /// Who sets it: name of the material or probe, and the field.
    pub by: Vec<(String, String)>,
}

/// Demands that one fit or table serves.
///
/// Merge rule: the hull of the ranges; the largest `max_ops`; every norm that is wanted; the
/// strictest `max_error`. Where several fits are emitted, each different pair of `max_ops` and
/// `max_error` is a [`Promise`] of its own, since an error belongs to its number of operations, and
/// a material content with fewer operations finds such fits among the others. Where one is emitted,
/// one promise is left: the strictest error within the largest budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// Name, unique in its plan.
    pub name: String,
    /// Hull of the demands' ranges, widened where it is too narrow.
    pub ranges: Ranges,
    /// The goals of all demands together.
    pub goals: Goals,
    /// What must hold of the result, each by itself.
    pub promises: Vec<Promise>,
    /// The demands, in the scene's order.
    pub demands: Vec<Demand>,
}

impl Span {
    /// A range that may be one value.
    pub fn new(range: [f64; 2]) -> Span {
        Span { range, least: Least::Point, one: One::Alone }
    }

    /// A range whose job is at least `width` wide, inside a domain.
    pub fn at_least(range: [f64; 2], width: f64, domain: [f64; 2]) -> Span {
        Span { range, least: Least::Width(width, domain), one: One::Never }
    }

    /// A range whose job's ends have at least this ratio, inside a domain.
    pub fn by_ratio(range: [f64; 2], ratio: f64, domain: [f64; 2]) -> Span {
        Span { range, least: Least::Ratio(ratio, domain), one: One::Never }
    }

    /// A range of roughness.
    pub fn roughness(range: [f64; 2], map: AlphaMap) -> Span {
        Span::at_least(range, ROUGHNESS_WIDTH_MIN, [smallest_rough(map), 1.0])
    }

    /// Of fits: one value stays one where every other input but mu and ior has one too, or wherever
    /// formulas without the input are `given`.
    pub fn or_one(self, given: bool) -> Span {
        Span { one: if given { One::Always } else { One::Alone }, ..self }
    }

    /// The range, or where it is too narrow for a job, a wider one about it inside the domain, in
    /// the digits that a person would write.
    pub fn widened(self) -> [f64; 2] {
        let [low, high] = self.range;
        match self.least {
            Least::Width(width, domain) if high - low < width => {
                let middle = 0.5 * (low + high);
                let lo = (middle - 0.5 * width).max(domain[0]).min(domain[1] - width);
                [tidy(lo).min(low), tidy(lo + width).min(domain[1]).max(high)]
            }
            Least::Ratio(ratio, domain) if high < ratio * low => {
                let lo = (low / ratio.sqrt()).clamp(domain[0], domain[1] / ratio);
                [lo.min(low), (lo * ratio).min(domain[1]).max(high)]
            }
            _ => self.range,
        }
    }

    /// The range, and that of its job where it is too narrow: `0.3, widened to 0.295 to 0.305`. Of fits the
    /// range alone: whether one value stays one is the job's to say.
    pub fn text(self) -> String {
        let (own, job) = (range_text(self.range), self.widened());
        let is_one = self.range[0] == self.range[1];
        if job == self.range || (is_one && self.one != One::Never) {
            return own;
        }
        format!("{own}, widened to {}", range_text(job))
    }
}

/// A sum without the rounding errors behind its ninth decimal.
fn tidy(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}

/// `0.3`, `0.1 to 0.4`, in four digits.
pub fn range_text(range: [f64; 2]) -> String {
    let [lo, hi] = range.map(|x| format!("{x:.3e}").parse().unwrap_or(x));
    if lo == hi { format!("{lo}") } else { format!("{lo} to {hi}") }
}

/// The smallest range that holds both.
pub fn hull(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

impl Demand {
    /// What calls the functions of its job.
    pub fn caller(&self) -> Caller {
        Caller { name: self.name.clone(), layer: self.layer }
    }

    /// Who sets the limit on the error: name, and field.
    pub fn limit(&self) -> (String, String) {
        (self.name.clone(), format!("{}.max_error", self.field))
    }
}

impl Promise {
    /// `max_error 0.01 within 20 operations, wanted by gold (materials[0].wants.fit.max_error)`.
    pub fn text(&self) -> String {
        let within =
            self.max_ops.map_or_else(String::new, |ops| format!(" within {}", words::operations(ops)));
        format!("max_error {}{within}, wanted by {}", self.max_error, self.wanted_by())
    }

    /// Who asks for it, with the field of each: `gold (materials[0].wants.fit.max_error)`.
    pub fn wanted_by(&self) -> String {
        listed(&self.by)
    }
}

/// Names with their fields.
pub fn listed(by: &[(String, String)]) -> String {
    by.iter().map(|(name, field)| format!("{name} ({field})")).collect::<Vec<_>>().join(", ")
}

impl Job {
    fn new(demand: &Demand) -> Job {
        Job {
            name: demand.job.to_string(),
            ranges: Ranges::new(),
            goals: demand.goals.clone(),
            promises: Vec::new(),
            demands: Vec::new(),
        }
    }

    /// Takes a demand.
    fn join(&mut self, demand: Demand) {
        for &(input, span) in &demand.spans {
            let all = self.ranges.entry(input).or_insert(span.range);
            *all = hull(*all, span.range);
        }
        self.goals.join(&demand.goals);
        self.demands.push(demand);
    }

    /// A promise for each pair of operations and error that is wanted.
    pub(super) fn promise_each(&mut self) {
        // Places of promises, by operations and the bits of the error.
        let mut known = BTreeMap::new();
        for demand in &self.demands {
            let Goals { max_ops, max_error: Some(max_error), .. } = demand.goals else { continue };
            let place = *known.entry((max_ops, max_error.to_bits())).or_insert(self.promises.len());
            match self.promises.get_mut(place) {
                Some(promise) => promise.by.push(demand.limit()),
                None => self.promises.push(Promise { max_ops, max_error, by: vec![demand.limit()] }),
            }
        }
    }

    /// One promise for one fit.
    pub(super) fn promise_once(&mut self) {
        let Goals { max_ops, max_error, .. } = self.goals;
        let strictest = self.demands.iter().filter(|demand| demand.goals.max_error == max_error);
        let by = strictest.map(Demand::limit).collect();
        self.promises = max_error.map(|max_error| Promise { max_ops, max_error, by }).into_iter().collect();
    }

    /// Whether a bake of it may not keep what the scene asks for.
    pub fn is_promised(&self) -> bool {
        !self.promises.is_empty() || self.goals.max_ops.is_some()
    }

    /// What became of goals that differ: `max_ops 5 of a and 20 of b became 20`, and which call takes more
    /// than that, for what it does beside the formula.
    pub fn merging(&self) -> Option<String> {
        let ops = |goals: &Goals| goals.max_ops.map_or_else(|| "no limit".to_string(), |n| n.to_string());
        let error = |goals: &Goals| goals.max_error.map_or_else(|| "no limit".to_string(), |e| e.to_string());
        let budget = became("max_ops", self, &ops).map(|text| text + &self.beyond().unwrap_or_default());
        let parts = [budget, became("max_error", self, &error)];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// The call that takes most of those that take more than the budget: of three channels, where a formula
    /// for one may take all of it.
    fn beyond(&self) -> Option<String> {
        let Budget { max_ops: Some(most), call } = self.budget() else { return None };
        let bounded = self.demands.iter().filter(|demand| demand.goals.max_ops.is_some());
        let calls = bounded.map(|demand| (demand.call.ops(call.left(most)), &demand.name));
        let (ops, name) = calls.min_by_key(|(ops, _)| Reverse(*ops))?;
        (ops > most).then(|| format!(", and a call of `{name}` takes up to {ops}"))
    }

    fn widen(&mut self) {
        let hulls = self.ranges.clone();
        let is_one = |input: &str| hulls.get(input).is_some_and(|[low, high]| low == high);
        let spans = || self.demands.iter().flat_map(|demand| demand.spans.iter().copied());
        let is_near = |[low, high]: &[f64; 2]| low > &1.0 && high - 1.0 <= INDICES_RATIO * (low - 1.0);
        let stays = |(input, span): (&str, Span)| {
            input == "mu"
                || (input == "ior" && hulls.get(input).is_some_and(is_near))
                || (is_one(input) && span.one != One::Never)
        };
        if spans().all(stays) {
            return;
        }
        for (input, span) in spans().filter(|(i, s)| !(is_one(i) && s.one == One::Always)) {
            if let Some(range) = self.ranges.get_mut(input) {
                *range = Span { range: *range, ..span }.widened();
            }
        }
    }

    /// The range of an input.
    ///
    /// # Errors
    /// An input that no demand has: a defect of the effect.
    pub fn range(&self, input: &str) -> Result<[f64; 2], BakeError> {
        let lacks = || BakeError::Internal(format!("job {}: no range of {input}", self.name));
        self.ranges.get(input).copied().ok_or_else(lacks)
    }

    /// The hull of the demands' own ranges of an input, as narrow as it is.
    ///
    /// # Errors
    /// As [`Job::range`].
    pub fn own_range(&self, input: &str) -> Result<[f64; 2], BakeError> {
        let spans = self.demands.iter().flat_map(|demand| &demand.spans);
        let own = spans.filter(|(name, _)| *name == input).map(|(_, span)| span.range);
        own.reduce(hull).map_or_else(|| self.range(input), Ok)
    }

    /// Those of formulas that are for the inputs that vary.
    pub fn formulas<'a>(&self, own: Formulas<'a>) -> &'a [Entry] {
        own.over(self.ranges.iter().map(|(input, range)| (*input, *range)), false)
    }

    /// Its region of roughness and mu.
    ///
    /// # Errors
    /// As [`Job::range`].
    pub fn region(&self, alpha_map: AlphaMap) -> Result<Region, BakeError> {
        Ok(Region { roughness: self.range("roughness")?, mu: self.range("mu")?, alpha_map })
    }

    /// What calls its functions, each once.
    pub fn callers(&self) -> Vec<Caller> {
        let mut seen = BTreeSet::new();
        self.demands.iter().map(Demand::caller).filter(|caller| seen.insert(caller.clone())).collect()
    }

    /// The budget that leaves the formula most; of equal ones that whose call takes most counts.
    pub fn budget(&self) -> Budget {
        let mut calls = BTreeMap::new();
        for demand in &self.demands {
            let call: &mut CallOps = calls.entry(demand.goals.max_ops).or_default();
            *call = demand.call.max(*call);
        }
        let of = |demand: &Demand| {
            let max_ops = demand.goals.max_ops;
            Budget { max_ops, call: calls.get(&max_ops).copied().unwrap_or_default() }
        };
        let left = |budget: &Budget| budget.max_ops.map_or(u32::MAX, |most| budget.call.left(most));
        let none = Budget { max_ops: None, call: CallOps::default() };
        self.demands.iter().map(of).max_by_key(left).unwrap_or(none)
    }

    /// What is emitted of its fits, under the name of their role.
    pub fn emission(&self, scene: &Scene, role: &str) -> Emission {
        let Output { pick, arguments, cost, budget, every_error, float, reports: shown, .. } = scene.output;
        let (role, max_error) = (role.into(), self.goals.max_error);
        let own =
            Emission { pick, arguments, cost, budget, every_error, float, shown, ..Emission::default() };
        let alone = self.demands.iter().filter(|demand| demand.goals.max_error.is_none());
        let within = alone.filter_map(|demand| Some(demand.call.left(demand.goals.max_ops?))).max();
        Emission { role, max_error, within, call: self.budget().call, ..own }
    }

    /// Who sets the budget, with the field of each: `gold (materials[0].wants.fit)`.
    pub fn bounded_by(&self) -> String {
        let most = self.budget().max_ops;
        let bounding = self.demands.iter().filter(|demand| demand.goals.max_ops == most);
        let by: Vec<_> = bounding.map(|demand| (demand.name.clone(), demand.field.clone())).collect();
        listed(&by)
    }

    /// The materials that set the strictest limit, with the field of each:
    /// `gold (materials[0].wants.tables[0].max_error)`.
    pub fn limited_by(&self) -> String {
        let strictest = self.promises.iter().filter(|p| Some(p.max_error) == self.goals.max_error);
        strictest.map(Promise::wanted_by).collect::<Vec<_>>().join(", ")
    }
}

/// What became of one goal, where the demands differ in it.
fn became(name: &str, job: &Job, goal: &impl Fn(&Goals) -> String) -> Option<String> {
    let mut values: Vec<(String, &str, BTreeSet<&str>)> = Vec::new();
    let mut places = BTreeMap::new();
    for demand in &job.demands {
        let value = goal(&demand.goals);
        let place = *places.entry(value.clone()).or_insert(values.len());
        match values.get_mut(place) {
            Some((.., names)) => drop(names.insert(&demand.name)),
            None => values.push((value, &demand.name, BTreeSet::from([demand.name.as_str()]))),
        }
    }
    let of = |(value, first, names): &(String, &str, BTreeSet<&str>)| match names.len() {
        1 => format!("{value} of `{first}`"),
        count => format!("{value} of `{first}` and {} more", count - 1),
    };
    let each: Vec<String> = values.iter().map(of).collect();
    let each = match each.as_slice() {
        [] | [_] => return None,
        [first, second, rest @ ..] if rest.len() > 1 => {
            format!("{first}, {second} and {} others", rest.len())
        }
        all => all.join(" and "),
    };
    Some(format!("{name} {each} became {}", goal(&job.goals)))
}

/// The jobs of an effect's demands, which promise nothing yet.
pub fn merged(demands: Vec<Demand>) -> Vec<Job> {
    let mut jobs: Vec<(usize, Job)> = Vec::new();
    for demand in demands {
        let known = jobs.iter().position(|(_, job)| job.name == demand.job);
        let index = known.unwrap_or_else(|| {
            jobs.push((demand.rank, Job::new(&demand)));
            jobs.len() - 1
        });
        jobs[index].1.join(demand);
    }
    jobs.sort_by_key(|(rank, ..)| *rank);
    let mut jobs: Vec<Job> = jobs.into_iter().map(|(_, job)| job).collect();
    jobs.iter_mut().for_each(Job::widen);
    jobs
}
