//! Rows of spheres in a white environment, seen from afar: the furnace.
//!
//! A convex sphere in light of radiance 1 from everywhere shows at each point the radiance
//! `factor(mu)`, mu being the cosine between view and normal: sqrt(1 - r^2) at distance r from the
//! centre of the disc. A perfect compensation has factor 1 and cannot be told from its
//! surroundings.

use rayon::prelude::*;

use super::canvas::{Align, Canvas, Frame, INK, SMALL, TEXT, picture, sheet};
use super::hover::{self, Cells, Hover};
use super::{Figure, Shade, colour_bar, font, raster};
use lobefit_math::numbers;

use crate::{ReportError, check};

/// Pixels of the picture per pixel of the page.
const DENSITY: usize = 1;

/// Radius of a sphere over the side of its cell.
const RADIUS: f64 = 0.45;

/// Widest line of a row's name in pixels of the page, and the most lines: what a cell has room for.
const NAMES: f64 = 150.0;
const NAME_LINES: usize = 4;

/// Samples per pixel and axis where the sphere's edge passes.
const EDGE: usize = 8;

/// One row: a name and, for each column, the factor at each mu.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereRow<'a> {
    /// Name at the left.
    pub name: String,
    /// `factors[column][k]` at `mu[k]`; linear between, constant beyond the ends.
    pub factors: &'a [Vec<f64>],
}

/// A table of spheres.
#[derive(Clone, Debug, PartialEq)]
pub struct Spheres<'a> {
    /// Line above the picture.
    pub title: String,
    /// Name of the columns' variable.
    pub column_name: String,
    /// Value of each column.
    pub columns: &'a [f64],
    /// Cosines at which factors are given, increasing.
    pub mu: &'a [f64],
    /// The rows.
    pub rows: Vec<SphereRow<'a>>,
    /// What the colours mean: departure from white, or radiance.
    pub shade: Shade,
    /// Label of the colour bar.
    pub unit: String,
    /// Side of a sphere's cell in pixels of the page.
    pub cell: usize,
}

impl Figure for Spheres<'_> {
    fn svg(&self) -> Result<String, ReportError> {
        self.check()?;
        let mut names: f64 = 40.0;
        for row in &self.rows {
            for line in font::wrap(&row.name, SMALL, NAMES, NAME_LINES)? {
                names = names.max(font::width(&line, SMALL)?);
            }
        }
        let left = names + 12.0;
        let (width, height) = ((self.columns.len() * self.cell) as f64, (self.rows.len() * self.cell) as f64);
        let frame = Frame { left, top: 48.0, right: left + width, bottom: 48.0 + height };
        let size = (self.columns.len() * self.cell * DENSITY, self.rows.len() * self.cell * DENSITY);
        let png = raster::png(&self.title, size, &self.render(), self.shade)?;
        let under = picture(&png, frame, false) + &colour_bar::under(&self.title, frame, self.shade)?;
        let width = frame.right + colour_bar::space(frame, self.shade, &self.unit)?;
        let width = width.max(font::width(&self.title, TEXT)? + 8.0);
        let svg = sheet(&self.title, (width, frame.bottom + 12.0), &under, |c| self.label(c, frame))?;
        let cells = Cells {
            frame: hover::corners(frame),
            rows: self.rows.iter().map(|row| row.name.clone()).collect(),
            columns: self.columns.iter().map(|&value| numbers::brief(value, 2)).collect(),
            name: self.column_name.clone(),
            unit: self.unit.clone(),
            radius: Some(RADIUS),
            kinds: None,
            shade: Some(self.shade.into()),
        };
        hover::with(&svg, &Hover::Cells(cells))
    }
}

impl Spheres<'_> {
    fn check(&self) -> Result<(), ReportError> {
        let title = &self.title;
        check::values(title, &self.column_name, self.columns)?;
        check::increasing(title, "mu", self.mu)?;
        check::filled(title, "rows", self.rows.len())?;
        for row in &self.rows {
            check::size(title, &format!("row {}", row.name), row.factors.len(), self.columns.len())?;
            for (j, factors) in row.factors.iter().enumerate() {
                let field = format!("row {}, column {j}", row.name);
                check::size(title, &field, factors.len(), self.mu.len())?;
                check::values(title, &field, factors)?;
            }
        }
        Ok(())
    }

    fn label(&self, canvas: &Canvas, frame: Frame) -> Result<(), ReportError> {
        canvas.text(&self.title, (4.0, 12.0), TEXT, Align::Left, INK)?;
        canvas.text(&self.column_name, (frame.left - 8.0, 36.0), SMALL, Align::Right, INK)?;
        for (j, &value) in self.columns.iter().enumerate() {
            let x = frame.left + (j as f64 + 0.5) * self.cell as f64;
            canvas.text(&numbers::place(value), (x, 36.0), SMALL, Align::Centre, INK)?;
        }
        for (i, row) in self.rows.iter().enumerate() {
            let y = frame.top + (i as f64 + 0.5) * self.cell as f64;
            let lines = font::wrap(&row.name, SMALL, NAMES, NAME_LINES)?;
            for (k, line) in lines.iter().enumerate() {
                let lift = (k as f64 - (lines.len() - 1) as f64 / 2.0) * 14.0;
                canvas.text(line, (frame.left - 8.0, y + lift), SMALL, Align::Right, INK)?;
            }
        }
        colour_bar::draw(canvas, frame, self.shade, &self.unit)
    }

    /// Palette indices of the whole picture, rows of spheres in parallel, joined in order.
    fn render(&self) -> Vec<u8> {
        let stencil = stencil(self.cell * DENSITY, self.mu);
        let strips: Vec<Vec<u8>> = self.rows.par_iter().map(|row| self.strip(row, &stencil)).collect();
        strips.concat()
    }

    fn strip(&self, row: &SphereRow, stencil: &[Pixel]) -> Vec<u8> {
        let side = self.cell * DENSITY;
        let mut levels = Vec::with_capacity(side * side * self.columns.len());
        for line in stencil.chunks(side) {
            for factors in row.factors {
                levels.extend(line.iter().map(|pixel| self.shade.level(self.seen(pixel, factors))));
            }
        }
        levels
    }

    /// What a pixel shows: radiance, or its departure from the environment's 1.
    fn seen(&self, pixel: &Pixel, factors: &[f64]) -> f64 {
        let sphere: f64 = pixel.samples.iter().map(|&(k, f)| between(factors, k, f)).sum();
        let departure = (sphere - pixel.samples.len() as f64) / pixel.taken as f64;
        if matches!(self.shade, Shade::Radiance { .. }) { 1.0 + departure } else { departure }
    }
}

/// Departure from the environment's 1 of each pixel of a square of `side` pixels with a sphere of
/// `radius` pixels in its middle, row by row: `factors[k]` at `mu[k]`, which increase; linear
/// between, constant beyond the ends. Both lists have the same length, not 0.
pub fn disc(side: usize, radius: f64, mu: &[f64], factors: &[f64]) -> Vec<f64> {
    let pixels = (0..side * side).map(|i| pixel(i % side, i / side, side as f64 / 2.0, radius, mu));
    pixels
        .map(|pixel| {
            let sphere: f64 = pixel.samples.iter().map(|&(k, f)| between(factors, k, f) - 1.0).sum();
            sphere / pixel.taken as f64
        })
        .collect()
}

/// Samples of a pixel that hit the sphere, as places in the list of mu, and how many were taken.
struct Pixel {
    samples: Vec<(usize, f64)>,
    taken: usize,
}

/// The pixels of one cell; every sphere has the same.
fn stencil(side: usize, mu: &[f64]) -> Vec<Pixel> {
    let radius = RADIUS * side as f64;
    (0..side * side).map(|i| pixel(i % side, i / side, side as f64 / 2.0, radius, mu)).collect()
}

fn pixel(column: usize, row: usize, centre: f64, radius: f64, mu: &[f64]) -> Pixel {
    let (x, y) = (column as f64 + 0.5 - centre, row as f64 + 0.5 - centre);
    let distance = (x * x + y * y).sqrt();
    // Near the edge mu falls to zero within a pixel: sample it finely; elsewhere its middle stands
    // for it.
    let n = if (distance - radius).abs() < 3.0 { EDGE } else { 1 };
    let offset = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
    let mut samples = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let (dx, dy) = ((x + offset(i)) / radius, (y + offset(j)) / radius);
            let cosine2 = 1.0 - dx * dx - dy * dy;
            if cosine2 >= 0.0 {
                samples.push(place(mu, cosine2.sqrt()));
            }
        }
    }
    Pixel { samples, taken: n * n }
}

/// Interval of `mu` that holds a cosine, and the fraction within it.
fn place(mu: &[f64], cosine: f64) -> (usize, f64) {
    let next = mu.partition_point(|&m| m < cosine).clamp(1, (mu.len() - 1).max(1));
    if mu.len() == 1 {
        return (0, 0.0);
    }
    (next - 1, ((cosine - mu[next - 1]) / (mu[next] - mu[next - 1])).clamp(0.0, 1.0))
}

fn between(factors: &[f64], k: usize, fraction: f64) -> f64 {
    if fraction == 0.0 { factors[k] } else { factors[k] * (1.0 - fraction) + factors[k + 1] * fraction }
}
