//! The integrals and the differences.

use lobefit::data::Place;
use serde::Serialize;
use std::f64::consts::PI;

use super::roles::{HALF, LIGHT, NORMAL, Role, Roles, TANGENT, VIEW, is_f0, roles};
use super::rule::{Nodes, Vector, direction, dot, half, lights};
use crate::audit::AuditError;
use crate::foreign::ShaderFunction;

/// What is asked.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// Roles of arguments, by name.
    pub roles: Vec<(String, Role)>,
    /// Values of arguments, by name.
    pub set: Vec<(String, f64)>,
    /// Values of the roughness.
    pub roughness: Vec<f64>,
    /// Whether the function holds the cosine of the light, if it is said.
    pub cosine: Option<bool>,
    /// Errors of energies are brought below it.
    pub tolerance: f64,
}

/// Whether a function holds the cosine of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Cosine {
    /// Whether it does.
    pub included: bool,
    /// How it is known: `stated`, `found`, or `assumed` where f is not reciprocal either way.
    pub known: &'static str,
}

/// The energy of a channel, and by how much the last two rules differ.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Energy {
    /// By the finer rule.
    pub value: f64,
    /// How far the coarser rule is from it, and rounding.
    pub error: f64,
}

/// Energies at one roughness and view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cell {
    /// Where: `roughness`, if the function has one, and `mu`.
    pub at: Place,
    /// By channel.
    pub energy: Vec<Energy>,
}

/// The largest difference of f(l, v) and f(v, l).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Broken {
    /// The difference over the larger of both, or over `LEAST` where both are smaller.
    pub share: f64,
    /// Both, without the cosine.
    pub values: [f64; 2],
    /// Which of the channels.
    pub channel: usize,
    /// `roughness`, `mu_l`, `mu_v`, `phi` between both.
    pub at: Place,
}

/// A value that is no number, or is negative.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unusable {
    /// The value in words.
    pub value: String,
    /// How many of the points have one.
    pub points: usize,
    /// Where the first is, or the first that is no number.
    pub at: Place,
}

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Furnace {
    /// Arguments and what they were given.
    pub arguments: Vec<(String, String)>,
    /// Whether it holds the cosine of the light.
    pub cosine: Cosine,
    /// Names of the channels that differ.
    pub channels: Vec<String>,
    /// Roughness slowest.
    pub cells: Vec<Cell>,
    /// The cell of the largest energy, closed in on from the largest of the others, with its channel.
    pub most: (Cell, usize),
    /// The same of the least.
    pub least: (Cell, usize),
    /// f(l, v) beside f(v, l).
    pub reciprocity: Broken,
    /// Values that are no reflectance, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unusable: Option<Unusable>,
}

/// Cosines of the view.
pub(super) const VIEWS: [f64; 8] = [0.02, 0.05, 0.1, 0.2, 0.35, 0.55, 0.8, 1.0];

/// An F0 that a Fresnel term is seen at: at 1 it is 1 throughout.
pub(super) const DARK: f32 = 0.04;

/// A value of f that is none beside it: a hundredth of a white Lambert surface's has an energy of
/// a hundredth.
pub(super) const LEAST: f64 = 0.01 / PI;

/// Nodes of the rules, one after the other until two differ by less than the tolerance.
const RULES: [Nodes; 5] = [[4, 2, 6], [6, 3, 10], [8, 4, 15], [11, 6, 22], [15, 8, 30]];

/// Share of a rule's error that the next has at least.
const CHANCE: f64 = 0.5;

/// What rounding in f32 leaves in an energy.
const ROUNDING: f64 = 1e-6;

/// A BRDF at work.
struct Brdf<'a> {
    function: &'a ShaderFunction,
    roles: Roles,
    /// Results that differ from those before them.
    channels: Vec<usize>,
    cosine: Cosine,
    bad: Option<Unusable>,
}

/// Directions and a roughness.
#[derive(Clone, Copy)]
struct Point {
    light: Vector,
    view: Vector,
    roughness: f64,
}

impl Point {
    fn given(&self, role: Role) -> f32 {
        let of = |d: usize| match d {
            NORMAL => [0.0, 0.0, 1.0],
            VIEW => self.view,
            LIGHT => self.light,
            HALF => half(self.light, self.view),
            TANGENT => [1.0, 0.0, 0.0],
            _ => [0.0, 1.0, 0.0],
        };
        (match role {
            Role::Component(d, k) => of(d)[k],
            Role::Cosine(a, b) => dot(of(a), of(b)),
            Role::Roughness => self.roughness,
            Role::Square => self.roughness * self.roughness,
            Role::White => 1.0,
            Role::Value(x) => f64::from(x),
        }) as f32
    }

    fn swapped(self) -> Point {
        Point { light: self.view, view: self.light, ..self }
    }

    fn place(&self, has_roughness: bool) -> Place {
        let azimuth = |d: Vector| lobefit_math::ops::atan2(d[1], d[0]);
        let phi = (azimuth(self.light) - azimuth(self.view)).abs();
        let phi = if phi > PI { 2.0 * PI - phi } else { phi };
        let mut place: Place = [("mu_l", self.light[2]), ("mu_v", self.view[2]), ("phi", phi)]
            .map(|(n, x)| (n.to_string(), x))
            .into();
        if has_roughness {
            place.insert("roughness".into(), self.roughness);
        }
        place
    }
}

/// Why it is not known what every argument of a function is given, if it is not.
pub fn unfit(function: &ShaderFunction, asked: &Asked) -> Option<AuditError> {
    roles(function, &asked.roles, &asked.set, &asked.roughness).err()
}

/// A BRDF in the furnace. `progress` hears of the stages.
///
/// # Errors
/// Arguments whose role is not known; what cannot be run, with its place.
pub fn furnace(
    function: &ShaderFunction,
    asked: &Asked,
    progress: &dyn Fn(&str),
) -> Result<Furnace, AuditError> {
    progress("whether it holds the cosine of the light");
    let roles = roles(function, &asked.roles, &asked.set, &asked.roughness)?;
    let arguments = roles.named.clone();
    let all: Vec<usize> = (0..function.results.len()).collect();
    let cosine = Cosine { included: asked.cosine.unwrap_or(false), known: "stated" };
    let mut brdf = Brdf { function, roles, channels: all, cosine, bad: None };
    let rough = if brdf.has_roughness() { asked.roughness.clone() } else { vec![1.0] };
    brdf.look(&rough, asked.cosine)?;
    let mut cells = Vec::new();
    for r in &rough {
        progress(&match brdf.has_roughness() {
            true => format!("the white furnace at roughness {r}"),
            false => "the white furnace".to_string(),
        });
        for mu in VIEWS {
            cells.push(brdf.cell(*r, mu, asked.tolerance)?);
        }
    }
    progress("the largest and the least energy");
    let most = brdf.extreme(&cells, &rough, 1.0, asked.tolerance)?;
    let least = brdf.extreme(&cells, &rough, -1.0, asked.tolerance)?;
    progress("reciprocity");
    let mut reciprocity = brdf.reciprocity(&rough)?;
    if brdf.darken() {
        let dark = brdf.reciprocity(&rough)?;
        if dark.share > reciprocity.share {
            let f0 = ("f0".to_string(), f64::from(DARK));
            reciprocity = Broken { at: dark.at.into_iter().chain([f0]).collect(), ..dark };
        }
    }
    let channels = brdf.channels.iter().map(|k| brdf.name(*k)).collect();
    let Brdf { cosine, bad, .. } = brdf;
    Ok(Furnace { arguments, cosine, channels, cells, most, least, reciprocity, unusable: bad })
}

impl Brdf<'_> {
    fn has_roughness(&self) -> bool {
        self.roles.of.iter().any(|r| matches!(r, Role::Roughness | Role::Square))
    }

    /// Gives every F0 that was white the [`DARK`] one; whether there is any.
    fn darken(&mut self) -> bool {
        let white = |(name, role): &(&String, &mut Role)| **role == Role::White && is_f0(name);
        let all = self.function.inputs.iter().zip(&mut self.roles.of).filter(white);
        all.map(|(_, role)| *role = Role::Value(DARK)).count() > 0
    }

    fn name(&self, result: usize) -> String {
        match self.function.results[result].as_str() {
            "" => "f".into(),
            name => name.into(),
        }
    }

    /// Values by channel; those that are no numbers are taken note of and count as 0.
    fn values(&mut self, points: &[Point]) -> Result<Vec<Vec<f64>>, AuditError> {
        let column = |role: &Role| points.iter().map(|p| p.given(*role)).collect::<Vec<f32>>();
        let columns: Vec<Vec<f32>> = self.roles.of.iter().map(column).collect();
        let results = self.function.evaluate(&columns);
        let results = results.map_err(|e| AuditError::refused(&self.function.signature, e.to_string()))?;
        let channels: Vec<usize> = self.channels.clone();
        let mut out = Vec::new();
        for k in channels {
            let mut list = Vec::with_capacity(points.len());
            for (value, point) in results[k].iter().zip(points) {
                let value = f64::from(*value);
                if !value.is_finite() || value < 0.0 {
                    self.note(value, point);
                }
                list.push(if value.is_finite() { value } else { 0.0 });
            }
            out.push(list);
        }
        Ok(out)
    }

    fn note(&mut self, value: f64, point: &Point) {
        let at = point.place(self.has_roughness());
        let value = if value.is_finite() { format!("{value:.3e}") } else { "not a number".into() };
        // What is no number is worse than what is negative.
        let worse = |before: &Unusable| value.starts_with("not") && !before.value.starts_with("not");
        match &mut self.bad {
            Some(before) if worse(before) => *before = Unusable { value, points: before.points + 1, at },
            Some(before) => before.points += 1,
            None => self.bad = Some(Unusable { value, points: 1, at }),
        }
    }

    /// Finds the channels that differ, and whether the cosine is in the function.
    fn look(&mut self, rough: &[f64], stated: Option<bool>) -> Result<(), AuditError> {
        let points: Vec<Point> = pairs(rough).collect();
        let swapped: Vec<Point> = points.iter().map(|p| p.swapped()).collect();
        let (one, other) = (self.values(&points)?, self.values(&swapped)?);
        let own = |k: usize| (&one[k], &other[k]);
        let differs = |k: &usize| (0..*k).all(|j| own(j) != own(*k));
        let kept: Vec<usize> = (0..one.len()).filter(differs).collect();
        // Sums of differences of f, and of f over the cosine, each over the sum of both.
        let unlike = |by: &dyn Fn(&Point) -> f64| {
            let sum = |sign: f64| -> f64 {
                let each = |k: &usize| {
                    let pairs = one[*k].iter().zip(&other[*k]).zip(points.iter().zip(&swapped));
                    pairs.map(|((a, b), (p, q))| (a / by(p) + sign * b / by(q)).abs()).sum::<f64>()
                };
                kept.iter().map(each).sum()
            };
            sum(-1.0) / sum(1.0).max(f64::MIN_POSITIVE)
        };
        let (plain, divided) = (unlike(&|_| 1.0), unlike(&|p| p.light[2]));
        if stated.is_none() {
            let known = if plain.min(divided) <= 0.1 * plain.max(divided) { "found" } else { "assumed" };
            let included = known == "found" && divided < plain;
            self.cosine = Cosine { included, known };
        }
        self.channels = kept;
        Ok(())
    }

    /// The energies at one roughness and view.
    fn cell(&mut self, roughness: f64, mu: f64, tolerance: f64) -> Result<Cell, AuditError> {
        let view = direction(mu, 0.0);
        let mut energy: Vec<Energy> =
            vec![Energy { value: f64::NAN, error: f64::INFINITY }; self.channels.len()];
        for (round, nodes) in RULES.into_iter().enumerate() {
            let lights = lights(view, nodes);
            let points: Vec<Point> =
                lights.iter().map(|(light, _)| Point { light: *light, view, roughness }).collect();
            let cosine = |light: Vector| if self.cosine.included { 1.0 } else { light[2] };
            let weights: Vec<f64> = lights.iter().map(|(l, weight)| weight * cosine(*l)).collect();
            for (energy, values) in energy.iter_mut().zip(self.values(&points)?) {
                let value = weights.iter().zip(values).map(|(weight, value)| weight * value).sum::<f64>();
                let moved = if round == 0 { f64::INFINITY } else { (value - energy.value).abs() };
                // Two rules may agree by chance: three that do are asked for.
                let before = if round > 1 { energy.error * CHANCE } else { 0.0 };
                let error = moved.max(before) + ROUNDING * value.abs();
                *energy = Energy { value, error };
            }
            if energy.iter().all(|e| e.error <= tolerance) {
                break;
            }
        }
        let mut at: Place = [("mu".to_string(), mu)].into();
        if self.has_roughness() {
            at.insert("roughness".into(), roughness);
        }
        Ok(Cell { at, energy })
    }

    /// The cell of the largest energy times a sign, from that of the cells, by steps between.
    fn extreme(
        &mut self,
        cells: &[Cell],
        rough: &[f64],
        sign: f64,
        tolerance: f64,
    ) -> Result<(Cell, usize), AuditError> {
        let best = |cell: &Cell| {
            let energies = cell.energy.iter().map(|e| sign * e.value).enumerate();
            energies.fold((0, f64::NEG_INFINITY), |best, (k, e)| if e > best.1 { (k, e) } else { best })
        };
        let mut found = &cells[0];
        let mut place = 0;
        for (i, cell) in cells.iter().enumerate() {
            if best(cell).1 > best(found).1 {
                (found, place) = (cell, i);
            }
        }
        let mut found = found.clone();
        let between = |list: &[f64], at: f64, step: f64| {
            let k = at + step;
            let (low, share) = (k.floor().clamp(0.0, (list.len() - 1) as f64), k - k.floor());
            let next = list[(low as usize + 1).min(list.len() - 1)];
            (0.0..=(list.len() - 1) as f64)
                .contains(&k)
                .then(|| list[low as usize] * (1.0 - share) + next * share)
        };
        let (mut i, mut j) = ((place / VIEWS.len()) as f64, (place % VIEWS.len()) as f64);
        for step in [0.5, 0.25] {
            let (here, steps) = ((i, j), [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)]);
            for (di, dj) in steps {
                let at = between(rough, here.0, di).zip(between(&VIEWS, here.1, dj));
                let Some((r, mu)) = at.filter(|_| self.has_roughness() || di == 0.0) else { continue };
                let cell = self.cell(r, mu, tolerance)?;
                if best(&cell).1 > best(&found).1 {
                    (found, i, j) = (cell, here.0 + di, here.1 + dj);
                }
            }
        }
        let channel = best(&found).0;
        Ok((found, channel))
    }

    /// The largest difference of f(l, v) and f(v, l), from the largest of a grid.
    fn reciprocity(&mut self, rough: &[f64]) -> Result<Broken, AuditError> {
        let mut points: Vec<Point> = pairs(rough).collect();
        let mut worst: Option<(f64, [f64; 2], usize, Point)> = None;
        for round in 0..4 {
            let swapped: Vec<Point> = points.iter().map(|p| p.swapped()).collect();
            let (one, other) = (self.values(&points)?, self.values(&swapped)?);
            for (k, (a, b)) in one.iter().zip(&other).enumerate() {
                for (i, point) in points.iter().enumerate() {
                    let scale = |p: &Point| if self.cosine.included { 1.0 / p.light[2] } else { 1.0 };
                    let values = [a[i] * scale(point), b[i] * scale(&swapped[i])];
                    let larger = values[0].abs().max(values[1].abs()).max(LEAST);
                    let share = (values[0] - values[1]).abs() / larger;
                    if worst.as_ref().is_none_or(|w| share > w.0) {
                        worst = Some((share, values, k, *point));
                    }
                }
            }
            let Some((_, _, _, at)) = worst else { break };
            points = around(at, 0.1 / f64::from(1 << (2 * round)));
        }
        let (share, values, channel, at) = worst
            .ok_or_else(|| AuditError::refused(&self.function.signature, "it has no channel".to_string()))?;
        Ok(Broken { share, values, channel, at: at.place(self.has_roughness()) })
    }
}

/// Pairs of directions over the hemisphere, at every roughness.
fn pairs(rough: &[f64]) -> impl Iterator<Item = Point> {
    const COSINES: [f64; 5] = [0.05, 0.2, 0.45, 0.75, 0.98];
    const AZIMUTHS: [f64; 4] = [0.3, 1.2, 2.2, 3.1];
    rough.iter().flat_map(|roughness| {
        COSINES.into_iter().enumerate().flat_map(move |(i, l)| {
            // Each pair once.
            COSINES.into_iter().take(i).flat_map(move |v| {
                let point = move |phi| Point {
                    light: direction(l, phi),
                    view: direction(v, 0.0),
                    roughness: *roughness,
                };
                AZIMUTHS.into_iter().map(point)
            })
        })
    })
}

/// Points around one, within the hemisphere.
fn around(at: Point, step: f64) -> Vec<Point> {
    let phi = lobefit_math::ops::atan2(at.light[1], at.light[0]);
    let steps = [-step, 0.0, step];
    let mut out = Vec::new();
    for dl in steps {
        for dv in steps {
            for dp in steps {
                let cosine = |x: f64, d: f64| (x + d).clamp(0.01, 1.0);
                out.push(Point {
                    light: direction(cosine(at.light[2], dl), phi + 3.0 * dp),
                    view: direction(cosine(at.view[2], dv), 0.0),
                    roughness: at.roughness,
                });
            }
        }
    }
    out
}
