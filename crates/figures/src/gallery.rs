//! Rows of square pictures, all of one size, with names at the left and above.

use super::canvas::{Align, Canvas, Frame, INK, SMALL, TEXT, picture, sheet};
use super::hover::{self, Hover};
use super::{Figure, Shade, colour_bar, font, raster};
use crate::image::encoded;
use crate::{Image, ReportError, check};

/// Widest line of a row's name in pixels of the page, and the most lines.
const NAMES: f64 = 150.0;
const NAME_LINES: usize = 4;

/// Pixels of the page between the top and the first line of the columns' names, and between their
/// lines; the most lines.
const HEAD: f64 = 36.0;
const LINE: f64 = 14.0;
const HEAD_LINES: usize = 3;

/// Grey of a place without a picture.
const NOTHING: [u8; 3] = [0xd8; 3];

/// What the pictures are, row by row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Linear RGB in [0, 1], encoded for the display by the curve of sRGB.
    Colours(Vec<Vec<Image>>),
    /// Values, coloured by a shade with its bar.
    Values {
        /// `values[row][column]`, each a square row by row from the top.
        values: Vec<Vec<Vec<f64>>>,
        /// What the colours mean.
        shade: Shade,
        /// Label of the colour bar.
        unit: String,
    },
    /// Colours and values beside one another.
    Tiles {
        /// `tiles[row][column]`.
        tiles: Vec<Vec<Tile>>,
        /// What the colours of values mean.
        shade: Shade,
        /// Label of the colour bar.
        unit: String,
    },
}

/// A picture among others.
#[derive(Clone, Debug, PartialEq)]
pub enum Tile {
    /// Linear RGB in [0, 1], encoded for the display by the curve of sRGB.
    Colours(Image),
    /// A square of values, row by row from the top.
    Values(Vec<f64>),
    /// No picture: grey.
    Nothing,
}

impl Tile {
    /// Encoded colour of the mean of some pixels.
    fn pixel(&self, at: &[(usize, f64)], shade: Shade, palette: &[u8]) -> [u8; 3] {
        match self {
            Tile::Colours(image) => mean(at, |i| image.pixels[i]).map(byte),
            Tile::Values(values) => {
                let level = usize::from(shade.level(mean(at, |i| [values[i]])[0]));
                [0, 1, 2].map(|channel| palette[3 * level + channel])
            }
            Tile::Nothing => NOTHING,
        }
    }
}

/// A table of pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Gallery {
    /// Line above the pictures.
    pub title: String,
    /// Name of the columns' variable.
    pub column_name: String,
    /// Name of each column.
    pub columns: Vec<String>,
    /// Name of each row.
    pub rows: Vec<String>,
    /// Pixels along a side of a picture.
    pub side: usize,
    /// Side of a picture in pixels of the page.
    pub cell: f64,
    /// The pictures.
    pub cells: Cells,
}

impl Figure for Gallery {
    fn svg(&self) -> Result<String, ReportError> {
        self.check()?;
        let mut names: f64 = 40.0;
        for row in &self.rows {
            for line in font::wrap(row, SMALL, NAMES, NAME_LINES)? {
                names = names.max(font::width(&line, SMALL)?);
            }
        }
        let left = names.max(font::width(&self.column_name, SMALL)?) + 12.0;
        let (width, height) = (self.columns.len() as f64 * self.cell, self.rows.len() as f64 * self.cell);
        let lines = self.heads()?.iter().map(Vec::len).max().unwrap_or_default();
        let top = HEAD - 2.0 + LINE * lines.max(1) as f64;
        let frame = Frame { left, top, right: left + width, bottom: top + height };
        let (under, bar) = self.pictures(frame)?;
        let svg =
            sheet(&self.title, (frame.right + bar, frame.bottom + 12.0), &under, |c| self.label(c, frame))?;
        hover::with(&svg, &self.hover(frame))
    }
}

impl Gallery {
    fn hover(&self, frame: Frame) -> Hover {
        let (shade, unit, kinds) = match &self.cells {
            Cells::Colours(rows) => {
                (None, String::new(), Some(rows.iter().map(|row| "c".repeat(row.len())).collect()))
            }
            Cells::Values { shade, unit, .. } => (Some((*shade).into()), unit.clone(), None),
            Cells::Tiles { tiles, shade, unit } => {
                let kind = |tile: &Tile| if matches!(tile, Tile::Values(_)) { 'v' } else { 'c' };
                let kinds = tiles.iter().map(|row| row.iter().map(kind).collect()).collect();
                (Some((*shade).into()), unit.clone(), Some(kinds))
            }
        };
        Hover::Cells(hover::Cells {
            frame: hover::corners(frame),
            rows: self.rows.clone(),
            columns: self.columns.clone(),
            name: self.column_name.clone(),
            unit,
            radius: None,
            kinds,
            shade,
        })
    }

    /// The lines of the columns' names.
    fn heads(&self) -> Result<Vec<Vec<String>>, ReportError> {
        self.columns.iter().map(|name| font::wrap(name, SMALL, self.cell - 4.0, HEAD_LINES)).collect()
    }

    fn check(&self) -> Result<(), ReportError> {
        let title = &self.title;
        check::filled(title, "columns", self.columns.len())?;
        check::filled(title, "rows", self.rows.len())?;
        check::filled(title, "side", self.side)?;
        check::finite(title, "cell", self.cell)?;
        let each = |row: usize, column: usize, values: &[f64], pixels: usize| {
            let field = format!("row {}, column {}", self.rows[row], self.columns[column]);
            check::size(title, &field, pixels, self.side * self.side)?;
            check::values(title, &field, values)
        };
        let shape = |rows: usize, columns: Vec<usize>| {
            check::size(title, "cells", rows, self.rows.len())?;
            columns.into_iter().try_for_each(|n| check::size(title, "cells of a row", n, self.columns.len()))
        };
        match &self.cells {
            Cells::Colours(cells) => {
                shape(cells.len(), cells.iter().map(Vec::len).collect())?;
                all(cells, |i, j, image| each(i, j, image.pixels.as_flattened(), image.pixels.len()))
            }
            Cells::Values { values, .. } => {
                shape(values.len(), values.iter().map(Vec::len).collect())?;
                all(values, |i, j, values| each(i, j, values, values.len()))
            }
            Cells::Tiles { tiles, .. } => {
                shape(tiles.len(), tiles.iter().map(Vec::len).collect())?;
                all(tiles, |i, j, tile| match tile {
                    Tile::Colours(image) => each(i, j, image.pixels.as_flattened(), image.pixels.len()),
                    Tile::Values(values) => each(i, j, values, values.len()),
                    Tile::Nothing => Ok(()),
                })
            }
        }
    }

    /// Pixels along a side of a picture as shown: no more than the page has.
    fn shown(&self) -> usize {
        self.side.min(self.cell.ceil() as usize)
    }

    /// The pixels of a picture that one of those shown covers along an axis, with their parts of
    /// it.
    fn covered(&self, i: usize) -> Vec<(usize, f64)> {
        let ratio = self.side as f64 / self.shown() as f64;
        let (from, to) = (i as f64 * ratio, (i + 1) as f64 * ratio);
        let part = |k: usize| (to.min((k + 1) as f64) - from.max(k as f64)) / ratio;
        let pixels = (from.floor() as usize..to.ceil() as usize).filter(|&k| k < self.side);
        pixels.map(|k| (k, part(k))).filter(|(_, part)| *part > 1e-9).collect()
    }

    /// The pictures as markup, and the space at their right that a colour bar takes.
    fn pictures(&self, frame: Frame) -> Result<(String, f64), ReportError> {
        let side = self.shown();
        let size = (self.columns.len() * side, self.rows.len() * side);
        match &self.cells {
            Cells::Colours(cells) => {
                let bytes = self.joined(cells, |image, at| mean(at, |i| image.pixels[i]).map(byte));
                let png = raster::rgb(&self.title, size, bytes.as_flattened())?;
                Ok((picture(&png, frame, false), 14.0))
            }
            Cells::Values { values, shade, unit } => {
                let levels = self.joined(values, |values, at| shade.level(mean(at, |i| [values[i]])[0]));
                let png = raster::png(&self.title, size, &levels, *shade)?;
                let under = picture(&png, frame, false) + &colour_bar::under(&self.title, frame, *shade)?;
                Ok((under, colour_bar::space(frame, *shade, unit)?))
            }
            Cells::Tiles { tiles, shade, unit } => {
                let palette = shade.palette();
                let bytes = self.joined(tiles, |tile, at| tile.pixel(at, *shade, &palette));
                let png = raster::rgb(&self.title, size, bytes.as_flattened())?;
                let under = picture(&png, frame, false) + &colour_bar::under(&self.title, frame, *shade)?;
                Ok((under, colour_bar::space(frame, *shade, unit)?))
            }
        }
    }

    /// Pixels of all pictures as one, each of some of a picture's with their weights.
    fn joined<T, P>(&self, cells: &[Vec<T>], pixel: impl Fn(&T, &[(usize, f64)]) -> P) -> Vec<P> {
        let side = self.shown();
        let covered: Vec<Vec<(usize, f64)>> = (0..side).map(|i| self.covered(i)).collect();
        let of = |line: usize, column: usize| -> Vec<(usize, f64)> {
            let across = |(row, a): &(usize, f64)| {
                let (row, a) = (*row * self.side, *a);
                covered[column].iter().map(move |(column, b)| (row + column, a * b))
            };
            covered[line].iter().flat_map(across).collect()
        };
        let mut all = Vec::with_capacity(side * side * self.rows.len() * self.columns.len());
        for row in cells {
            for line in 0..side {
                for cell in row {
                    all.extend((0..side).map(|i| pixel(cell, &of(line, i))));
                }
            }
        }
        all
    }

    fn label(&self, canvas: &Canvas, frame: Frame) -> Result<(), ReportError> {
        let title = font::shorten(&self.title, TEXT, frame.right)?;
        canvas.text(&title, (4.0, 12.0), TEXT, Align::Left, INK)?;
        canvas.text(&self.column_name, (frame.left - 8.0, HEAD), SMALL, Align::Right, INK)?;
        for (j, lines) in self.heads()?.iter().enumerate() {
            let x = frame.left + (j as f64 + 0.5) * self.cell;
            for (k, line) in lines.iter().enumerate() {
                canvas.text(line, (x, HEAD + LINE * k as f64), SMALL, Align::Centre, INK)?;
            }
        }
        for (i, row) in self.rows.iter().enumerate() {
            let y = frame.top + (i as f64 + 0.5) * self.cell;
            let lines = font::wrap(row, SMALL, NAMES, NAME_LINES)?;
            for (k, line) in lines.iter().enumerate() {
                let lift = (k as f64 - (lines.len() - 1) as f64 / 2.0) * LINE;
                canvas.text(line, (frame.left - 8.0, y + lift), SMALL, Align::Right, INK)?;
            }
        }
        match &self.cells {
            Cells::Values { shade, unit, .. } | Cells::Tiles { shade, unit, .. } => {
                colour_bar::draw(canvas, frame, *shade, unit)
            }
            Cells::Colours(_) => Ok(()),
        }
    }
}

fn all<T>(
    cells: &[Vec<T>],
    each: impl Fn(usize, usize, &T) -> Result<(), ReportError>,
) -> Result<(), ReportError> {
    let places =
        cells.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |(j, c)| (i, j, c)));
    places.into_iter().try_for_each(|(i, j, cell)| each(i, j, cell))
}

/// Weighted mean of values at some places; the weights sum to 1.
fn mean<const N: usize>(at: &[(usize, f64)], value: impl Fn(usize) -> [f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    for &(i, weight) in at {
        sum.iter_mut().zip(value(i)).for_each(|(sum, x)| *sum += weight * x);
    }
    sum
}

/// Steps between the shades of a channel: 86 shades, which the eye cannot tell from 256 in pictures
/// as small as these and which take half the bytes.
const STEP: f64 = 3.0;

/// A byte of sRGB (IEC 61966-2-1) from linear light, cut to [0, 1].
fn byte(x: f64) -> u8 {
    (STEP * (255.0 / STEP * encoded(x)).round()) as u8
}
