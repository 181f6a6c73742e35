//! A lobe that a renderer measured or computed itself, as a table of its radiance over the angle at
//! some widths.
//!
//! With x(u; A) = u (1 + A)/(A + u), the energy that the lobe `half` of the width holds inside
//! u = tan^2(theta/2), every lobe of a table is held as a density q over x, which for lobes akin to
//! GGX's varies slowly over all widths:
//!
//!   q = f(theta) dOmega/dx,   dOmega/du = 4 pi/(1 + u)^2,   dx/du = A (1 + A)/(A + u)^2.
//!
//! q is interpolated between angles by cubics that neither overshoot nor fall below 0 (Fritsch and
//! Carlson 1980, slopes by Fritsch and Butland 1984), so that the energy, its integral, is exact in
//! the table and rises; between widths linearly in ln alpha. A table of `half` itself is exact at
//! any width. Below the narrowest width and above the widest the shape over x is that of the
//! nearest.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI};
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use lobefit_math::ops;

use super::Kernel;

/// Why a table is no lobe.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}: {message}", self.path())]
pub struct TableError {
    /// Which lobe of the table, from 0.
    pub lobe: usize,
    /// Its field.
    pub field: Option<&'static str>,
    /// What is wrong and what would be right.
    pub message: String,
}

impl TableError {
    /// The place in the table, as `lobes[3].theta`.
    pub fn path(&self) -> String {
        let field = self.field.map_or_else(String::new, |field| format!(".{field}"));
        format!("lobes[{}]{field}", self.lobe)
    }
}

/// A lobe at one width, as a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableLobe {
    /// Its width: alpha of the level that is prefiltered with it.
    pub alpha: f64,
    /// Angles from the axis, radians, rising from 0 to at most pi/2; beyond the last there is
    /// nothing.
    pub theta: Vec<f64>,
    /// Radiance weight per solid angle at every angle, at least 0, in any unit.
    pub density: Vec<f64>,
}

/// A kernel given as a table.
#[derive(Debug)]
pub struct Tabulated {
    /// What the user calls it.
    name: String,
    /// The name with the first digits of the table's hash.
    word: String,
    formula: String,
    shapes: Vec<Shape>,
}

/// A lobe as a density over x, cubic between nodes.
#[derive(Debug)]
struct Shape {
    ln_alpha: f64,
    nodes: Vec<Node>,
    /// Nodes up to k/n, of n even parts of [0, 1]: where a search for a node begins.
    up_to: Vec<usize>,
}

/// A node: where, and the energy from the axis, its density and the density's slope there; and of the
/// cubic to the next node the inverse of its width and the energy as a polynomial of the part of it, from
/// the first power on.
#[derive(Clone, Copy, Debug)]
struct Node {
    x: f64,
    energy: f64,
    density: f64,
    slope: f64,
    inverse: f64,
    quartic: [f64; 4],
}

/// Fewest angles of a lobe.
pub const ANGLES_MIN: usize = 8;

/// How far the widest width may be from 1.
const WIDEST: f64 = 1e-9;

/// Least step of x between angles: below it densities over x are rounding.
const CLOSEST: f64 = 1e-12;

/// How far from the horizon's x an angle of pi/2 may be that is written with seven digits.
const HORIZON: f64 = 1e-6;

/// Least jump of a density at its end, over its largest.
const JUMP: f64 = 1e-3;

/// Even parts of [0, 1] for each node, of which each knows the nodes up to it.
const PARTS: usize = 4;

/// Hexadecimal digits of a table's hash in its word.
const DIGITS: usize = 12;

/// The kernel of a table of lobes of rising widths up to 1. Kernels of equal tables are equal;
/// clones of a kernel share its table.
///
/// # Errors
/// Widths or angles that do not rise, a density that is negative, a lobe without energy.
pub fn tabulated(name: &str, lobes: &[TableLobe]) -> Result<Kernel, TableError> {
    check_widths(lobes)?;
    let shapes: Vec<Shape> =
        lobes.iter().enumerate().map(|(i, lobe)| Shape::new(i, lobe)).collect::<Result<_, _>>()?;
    check_shapes(lobes, &shapes)?;
    let hash = hash(name, lobes);
    let word = format!("{name}@{}", &hash[..DIGITS]);
    let formula = format!("tabulated at {} widths, blake3 {}", lobes.len(), &hash[..DIGITS]);
    Ok(Kernel::Tabulated(Arc::new(Tabulated { name: name.into(), word, formula, shapes })))
}

fn hash(name: &str, lobes: &[TableLobe]) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(name.as_bytes());
    for lobe in lobes {
        hasher.update(&(lobe.theta.len() as u64).to_le_bytes());
        for x in [lobe.alpha].iter().chain(&lobe.theta).chain(&lobe.density) {
            hasher.update(&x.to_bits().to_le_bytes());
        }
    }
    hasher.finalize().to_hex().to_string()
}

fn check_widths(lobes: &[TableLobe]) -> Result<(), TableError> {
    let fail = |lobe, message: String| Err(TableError { lobe, field: Some("alpha"), message });
    let Some(last) = lobes.last() else {
        let message = "is missing: the list is empty, and a lobe of alpha 1 is called for".into();
        return Err(TableError { lobe: 0, field: None, message });
    };
    if let Some(i) = lobes.iter().position(|lobe| !(lobe.alpha > 0.0 && lobe.alpha <= 1.0)) {
        return fail(i, format!("{} is outside (0, 1]", lobes[i].alpha));
    }
    if let Some(i) = lobes.windows(2).position(|pair| pair[1].alpha <= pair[0].alpha) {
        return fail(
            i + 1,
            format!("{} does not follow {}; widths rise", lobes[i + 1].alpha, lobes[i].alpha),
        );
    }
    if (last.alpha - 1.0).abs() > WIDEST {
        let message = format!(
            "{} is the widest; the last lobe is that of alpha 1, which a saturated fetch takes",
            last.alpha
        );
        return fail(lobes.len() - 1, message);
    }
    Ok(())
}

/// Refuses lobes that do not widen: the cone of half of the energy is larger the larger the width.
fn check_shapes(lobes: &[TableLobe], shapes: &[Shape]) -> Result<(), TableError> {
    let half: Vec<f64> =
        lobes.iter().zip(shapes).map(|(lobe, shape)| shape.median(lobe.alpha * lobe.alpha)).collect();
    let Some(i) = half.windows(2).position(|pair| pair[1] <= pair[0]) else { return Ok(()) };
    let [before, after] = [half[i], half[i + 1]].map(|u| 2.0 * ops::atan(u.sqrt()));
    let message = format!(
        "half of the energy is within {after:.4} radians of the axis, of the lobe before within {before:.4}: lobes widen with alpha"
    );
    Err(TableError { lobe: i + 1, field: Some("density"), message })
}

impl Tabulated {
    /// What the user calls it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The name with the first digits of the table's hash: no other table has it.
    pub fn word(&self) -> &str {
        &self.word
    }

    pub(super) fn formula(&self) -> &str {
        &self.formula
    }

    pub(super) fn is_cut(&self) -> bool {
        self.shapes.iter().any(Shape::is_cut)
    }

    pub(super) fn angles(&self) -> usize {
        self.shapes.iter().map(|shape| shape.nodes.len()).max().unwrap_or(0)
    }
}

impl PartialEq for Tabulated {
    fn eq(&self, other: &Tabulated) -> bool {
        self.word == other.word
    }
}

impl Eq for Tabulated {}

impl Hash for Tabulated {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.word.hash(state);
    }
}

impl PartialOrd for Tabulated {
    fn partial_cmp(&self, other: &Tabulated) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Tabulated {
    fn cmp(&self, other: &Tabulated) -> Ordering {
        self.word.cmp(&other.word)
    }
}

/// Two lobes of a table and how far a width is from the first to the second.
#[derive(Clone, Debug)]
pub(super) struct Blend {
    table: Arc<Tabulated>,
    lower: usize,
    upper: usize,
    weight: f64,
}

impl Blend {
    /// The lobe of a width above 0.
    pub(super) fn new(table: &Arc<Tabulated>, alpha: f64) -> Blend {
        let (x, shapes) = (ops::log(alpha), &table.shapes);
        let after = shapes.partition_point(|shape| shape.ln_alpha <= x);
        let (lower, upper) = (after.saturating_sub(1), after.min(shapes.len() - 1));
        let step = shapes[upper].ln_alpha - shapes[lower].ln_alpha;
        let weight = if step > 0.0 { (x - shapes[lower].ln_alpha) / step } else { 0.0 };
        Blend { table: Arc::clone(table), lower, upper, weight }
    }

    /// The energy from the axis to u in [0, 1], of a lobe of squared width `a2`.
    pub(super) fn within(&self, a2: f64, u: f64) -> f64 {
        let x = half(a2, u);
        self.mixed(|shape| shape.energy(x))
    }

    /// Its derivative by u.
    pub(super) fn density(&self, a2: f64, u: f64) -> f64 {
        let x = half(a2, u);
        self.mixed(|shape| shape.density(x)) * half_slope(a2, u)
    }

    fn mixed(&self, of: impl Fn(&Shape) -> f64) -> f64 {
        let [lower, upper] = [self.lower, self.upper].map(|i| &self.table.shapes[i]);
        if self.weight == 0.0 {
            return of(lower);
        }
        (1.0 - self.weight) * of(lower) + self.weight * of(upper)
    }
}

/// x(u; A).
fn half(a2: f64, u: f64) -> f64 {
    (u * (1.0 + a2) / (a2 + u)).min(1.0)
}

/// dx/du.
fn half_slope(a2: f64, u: f64) -> f64 {
    a2 * (1.0 + a2) / ((a2 + u) * (a2 + u))
}

impl Shape {
    fn new(index: usize, lobe: &TableLobe) -> Result<Shape, TableError> {
        let fail = |field, message: String| TableError { lobe: index, field: Some(field), message };
        check_lobe(lobe).map_err(|(field, message)| fail(field, message))?;
        let a2 = lobe.alpha * lobe.alpha;
        let at = |(&theta, &density): (&f64, &f64)| {
            let t = ops::tan(0.5 * theta);
            let u = (t * t).min(1.0);
            (half(a2, u), density * 4.0 * PI / ((1.0 + u) * (1.0 + u) * half_slope(a2, u)))
        };
        let (x, q): (Vec<f64>, Vec<f64>) = lobe.theta.iter().zip(&lobe.density).map(at).unzip();
        if let Some(i) = x.windows(2).position(|pair| pair[1] - pair[0] < CLOSEST) {
            let message =
                format!("{} is too close to {} for a lobe of this alpha", lobe.theta[i + 1], lobe.theta[i]);
            return Err(fail("theta", message));
        }
        let slopes = slopes(&x, &q);
        let mut nodes: Vec<Node> = Vec::with_capacity(x.len());
        for i in 0..x.len() {
            let energy = nodes.last().map_or(0.0, |last| {
                let h = x[i] - last.x;
                last.energy + h * (0.5 * (last.density + q[i]) + h / 12.0 * (last.slope - slopes[i]))
            });
            let (inverse, quartic) = (0.0, [0.0; 4]);
            nodes.push(Node { x: x[i], energy, density: q[i], slope: slopes[i], inverse, quartic });
        }
        let whole = nodes.last().map_or(0.0, |node| node.energy);
        if !(whole.is_finite() && whole > 0.0 && (1.0 / whole).is_finite()) {
            return Err(fail(
                "density",
                format!("the lobe's energy is {whole:e}; some of its densities are above 0"),
            ));
        }
        for node in &mut nodes {
            node.energy /= whole;
            node.density /= whole;
            node.slope /= whole;
        }
        for i in 1..nodes.len() {
            let [a, b] = [nodes[i - 1], nodes[i]];
            let h = b.x - a.x;
            nodes[i - 1].inverse = 1.0 / h;
            nodes[i - 1].quartic = [
                a.density,
                0.5 * h * a.slope,
                b.density - a.density - h * (2.0 * a.slope + b.slope) / 3.0,
                0.5 * (a.density - b.density) + 0.25 * h * (a.slope + b.slope),
            ]
            .map(|c| h * c);
        }
        let parts = PARTS * nodes.len();
        let part = |k: usize| nodes.partition_point(|node| node.x <= k as f64 / parts as f64);
        let up_to = (0..=parts).map(part).collect();
        Ok(Shape { ln_alpha: ops::log(lobe.alpha), nodes, up_to })
    }

    /// Whether the density jumps to 0 before the horizon, as far as a file writes pi/2, by a part of its
    /// largest that shows.
    fn is_cut(&self) -> bool {
        let most = self.nodes.iter().map(|node| node.density).fold(0.0, f64::max);
        self.nodes.last().is_some_and(|last| 1.0 - last.x > HORIZON && last.density > JUMP * most)
    }

    /// The u of the cone that holds half of the energy, to 1e-9.
    fn median(&self, a2: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        while high - low > 1e-9 {
            let middle = 0.5 * (low + high);
            if self.energy(middle) < 0.5 { low = middle } else { high = middle }
        }
        // x of that, back to u
        a2 * high / (1.0 + a2 - high)
    }

    /// The nodes about x and where it is between them; `None` beyond the last.
    fn between(&self, x: f64) -> Option<(&Node, &Node, f64)> {
        let parts = self.up_to.len() - 1;
        let mut after = self.up_to[((x * parts as f64) as usize).min(parts)].max(1);
        // The part's beginning is rounded: a node may lie on either side of it.
        while after > 1 && self.nodes[after - 1].x > x {
            after -= 1;
        }
        while self.nodes.get(after)?.x <= x {
            after += 1;
        }
        let (before, after) = (&self.nodes[after - 1], &self.nodes[after]);
        Some((before, after, (x - before.x) * before.inverse))
    }

    fn density(&self, x: f64) -> f64 {
        let Some((a, b, t)) = self.between(x) else {
            // the end of the last cubic belongs to it
            return self.nodes.last().filter(|last| x <= last.x).map_or(0.0, |last| last.density);
        };
        let h = b.x - a.x;
        let rest = 1.0 - t;
        let ends = a.density * (1.0 + 2.0 * t) * rest * rest + b.density * t * t * (3.0 - 2.0 * t);
        (ends + h * t * rest * (a.slope * rest - b.slope * t)).max(0.0)
    }

    fn energy(&self, x: f64) -> f64 {
        let Some((a, _, t)) = self.between(x) else { return 1.0 };
        let [first, second, third, fourth] = a.quartic;
        (a.energy + t * (first + t * (second + t * (third + t * fourth)))).min(1.0)
    }
}

fn check_lobe(lobe: &TableLobe) -> Result<(), (&'static str, String)> {
    let (theta, density) = (&lobe.theta, &lobe.density);
    if theta.len() < ANGLES_MIN {
        return Err(("theta", format!("{} angles where at least {ANGLES_MIN} are called for", theta.len())));
    }
    if density.len() != theta.len() {
        return Err(("density", format!("{} densities at {} angles", density.len(), theta.len())));
    }
    if theta[0] != 0.0 {
        return Err(("theta", format!("the first angle is {}; the axis, 0, is called for", theta[0])));
    }
    if let Some(i) = theta.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(("theta", format!("{} does not follow {}; angles rise", theta[i + 1], theta[i])));
    }
    if let Some(last) = theta.last().filter(|last| **last > FRAC_PI_2 * (1.0 + 1e-6)) {
        return Err(("theta", format!("{last} is beyond pi/2; lobes cover a hemisphere, in radians")));
    }
    if let Some(i) = density.iter().position(|x| !(*x >= 0.0 && x.is_finite())) {
        return Err((
            "density",
            format!("{} at theta = {} is not a finite number of at least 0", density[i], theta[i]),
        ));
    }
    Ok(())
}

/// Slopes at nodes that keep a cubic between neighbours' values: 0 at an extreme, else a weighted
/// harmonic mean of the chords'; one-sided at the ends, held to three times the chord.
fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let steps: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let chords: Vec<f64> = y.windows(2).zip(&steps).map(|(pair, h)| (pair[1] - pair[0]) / h).collect();
    let inner = |i: usize| {
        let ([before, after], [h, k]) = ([chords[i - 1], chords[i]], [steps[i - 1], steps[i]]);
        if before * after <= 0.0 {
            return 0.0;
        }
        let (v, w) = (2.0 * k + h, k + 2.0 * h);
        (v + w) / (v / before + w / after)
    };
    let last = chords.len() - 1;
    let first = end([steps[0], steps[1]], [chords[0], chords[1]]);
    let final_slope = end([steps[last], steps[last - 1]], [chords[last], chords[last - 1]]);
    std::iter::once(first).chain((1..=last).map(inner)).chain(std::iter::once(final_slope)).collect()
}

/// The slope of the parabola through three nodes at the first, with the sign of its chord and at
/// most three times as steep.
fn end([h, k]: [f64; 2], [chord, next]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h + k) * chord - h * next) / (h + k);
    if slope * chord <= 0.0 {
        0.0
    } else if chord * next <= 0.0 && slope.abs() > 3.0 * chord.abs() {
        3.0 * chord
    } else {
        slope
    }
}
