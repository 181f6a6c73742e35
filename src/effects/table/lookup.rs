//! A table as a shader reads it, whatever the number of its axes: coordinates, linear fetch and
//! decoding, in f32 or f16.

use crate::data::{AXES, Axis, Coordinate, Decode, Decoder, Surface, Table, Values};
use lobefit_shade::{Precision, ShadeError};

/// Arguments of an emitted lookup. Those that the table does not use are not read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// The parameter that alpha is made from.
    pub roughness: f32,
    /// GGX width.
    pub alpha: f32,
    /// Cosine between normal and view.
    pub mu: f32,
    /// Anisotropy.
    pub anisotropy: f32,
    /// Index of refraction, inside over outside.
    pub ior: f32,
    /// Square of the cosine of the view's azimuth from the alpha_x axis.
    pub cos2_phi: f32,
}

impl Point {
    /// What warps and decodings use of it.
    fn surface(&self) -> Surface<f32> {
        let Point { alpha, ior, anisotropy, cos2_phi, .. } = *self;
        Surface { alpha, ior, anisotropy, cos2_phi }
    }
}

/// The variable of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variable {
    Roughness,
    Alpha,
    Mu,
    Anisotropy,
    Ior,
    Cos2Phi,
}

impl Variable {
    pub(super) fn of(axis: &Axis) -> Option<Variable> {
        match axis.name.as_str() {
            "roughness" => Some(Variable::Roughness),
            "alpha" => Some(Variable::Alpha),
            "mu" => Some(Variable::Mu),
            "anisotropy" => Some(Variable::Anisotropy),
            "ior" => Some(Variable::Ior),
            "cos2_phi" => Some(Variable::Cos2Phi),
            _ => None,
        }
    }

    fn at(self, point: &Point) -> f32 {
        match self {
            Variable::Roughness => point.roughness,
            Variable::Alpha => point.alpha,
            Variable::Mu => point.mu,
            Variable::Anisotropy => point.anisotropy,
            Variable::Ior => point.ior,
            Variable::Cos2Phi => point.cos2_phi,
        }
    }
}

/// A table that cannot be looked up.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LookupError {
    /// Other channels than the decoding reads.
    #[error("table {table}: {channels} channels; its decoding reads {expected}")]
    Channels {
        /// Table's name.
        table: String,
        /// Channels found.
        channels: usize,
        /// Channels that the decoding reads.
        expected: usize,
    },
    /// More axes than a table has.
    #[error("table {table}: {axes} axes; a table has one to {AXES}")]
    Axes {
        /// Table's name.
        table: String,
        /// Axes found.
        axes: usize,
    },
    /// B is asked for where the table or the truth has none.
    #[error("table {table}: its error of B is asked for, and the table or the truth has none")]
    NoBias {
        /// Table's name.
        table: String,
    },
    /// A warp or a decoding that cannot be computed, a defect of this program.
    #[error(transparent)]
    Shader(ShadeError),
    /// An axis of no known variable.
    #[error("table {table}: axis {axis} is none of roughness, alpha, mu, anisotropy, ior, cos2_phi")]
    Axis {
        /// Table's name.
        table: String,
        /// The axis.
        axis: String,
    },
}

/// A table prepared for lookups.
#[derive(Clone, Debug)]
pub struct Lookup<'a> {
    table: &'a str,
    /// Variable, size and coordinate of each axis.
    axes: Vec<(Variable, usize, Coordinate)>,
    /// Texels of each channel.
    texels: Vec<Vec<f32>>,
    decoder: Decoder,
    /// Steps of the interpolation weights: many texture units keep 8 fractional bits.
    weight_steps: Option<f32>,
    /// Of coordinates and decoding; the fetch between is that of the texture unit.
    precision: Precision,
}

/// The texels around a position along one axis, as offsets into the channel.
#[derive(Clone, Copy, Default)]
struct Cell {
    /// Of the texel before the position.
    base: usize,
    /// From there to the next; 0 on a texel.
    step: usize,
    fraction: f32,
}

impl<'a> Lookup<'a> {
    /// Lookups with f32 interpolation weights. The texels are taken as they are: quantise the table
    /// first.
    ///
    /// # Errors
    /// No axis or more than a table has, other channels than `decode` reads, an axis of another
    /// variable than [`Point`] has.
    pub fn new(table: &'a Table, decode: Decode) -> Result<Lookup<'a>, LookupError> {
        let (name, axes) = (|| table.name.clone(), table.axes.len());
        let (channels, expected) = (table.channels.len(), decode.channels());
        if !(1..=AXES).contains(&axes) {
            return Err(LookupError::Axes { table: name(), axes });
        }
        if channels != expected {
            return Err(LookupError::Channels { table: name(), channels, expected });
        }
        let variable = |axis: &'a Axis| {
            let unknown = || LookupError::Axis { table: name(), axis: axis.name.clone() };
            Ok((
                Variable::of(axis).ok_or_else(unknown)?,
                axis.size,
                axis.coordinate().map_err(LookupError::Shader)?,
            ))
        };
        let axes = table.axes.iter().map(variable).collect::<Result<_, LookupError>>()?;
        let texels = table.channels.iter().map(|c| c.texels.iter().map(|t| *t as f32).collect()).collect();
        let decoder = decode.decoder().map_err(LookupError::Shader)?;
        let (weight_steps, precision) = (None, Precision::F32);
        Ok(Lookup { table: &table.name, axes, texels, decoder, weight_steps, precision })
    }

    /// The same with interpolation weights rounded to `bits` fractional bits, as texture units do.
    pub fn with_weight_bits(mut self, bits: u32) -> Lookup<'a> {
        self.weight_steps = Some((1_u32 << bits) as f32);
        self
    }

    /// The same with coordinates and decoding in another arithmetic. In f16 the inputs, both roughness and
    /// alpha given, and the texel that is fetched are rounded first.
    pub fn with_precision(mut self, precision: Precision) -> Lookup<'a> {
        self.precision = precision;
        self
    }

    /// Name of the table.
    pub fn table(&self) -> &'a str {
        self.table
    }

    /// The decoded values at a point, in the shader's arithmetic.
    pub fn at(&self, point: &Point) -> Values {
        self.decoder.at(self.texel(point), point.mu, point.surface(), self.precision)
    }

    /// Where a point lies, in texels from the centre of the first one along each axis; 0 along axes
    /// that the table does not have.
    pub fn position(&self, point: &Point) -> [f64; AXES] {
        let mut position = [0.0; AXES];
        for (x, (variable, size, coordinate)) in position.iter_mut().zip(&self.axes) {
            let n = *size as f64;
            let u = f64::from(coordinate.at(variable.at(point), point.surface(), self.precision));
            *x = (u * n - 0.5).clamp(0.0, n - 1.0);
        }
        position
    }

    /// The texel between those around a point; channels that the table does not have are 0.
    pub fn texel(&self, point: &Point) -> [f32; 4] {
        let (surface, mut stride) = (point.surface(), 1);
        let mut cells = [Cell::default(); AXES];
        for (cell, (variable, size, coordinate)) in cells.iter_mut().zip(&self.axes) {
            *cell = self.cell(coordinate.at(variable.at(point), surface, self.precision), *size, stride);
            stride *= size;
        }
        let mut texel = [0.0; 4];
        for (value, texels) in texel.iter_mut().zip(&self.texels) {
            *value = between(texels, &cells[..self.axes.len()]);
        }
        texel
    }

    /// The cell of a texture coordinate, clamped to the edge, on an axis whose texels lie `stride`
    /// apart.
    fn cell(&self, coordinate: f32, n: usize, stride: usize) -> Cell {
        let position = (coordinate * n as f32 - 0.5).max(0.0).min((n - 1) as f32);
        let position = match self.weight_steps {
            Some(steps) => (position * steps + 0.5).floor() / steps,
            None => position,
        };
        let base = (position as usize).min(n - 1);
        let fraction = position - base as f32;
        Cell { base: base * stride, step: if fraction > 0.0 { stride } else { 0 }, fraction }
    }
}

/// The value between the texels of some cells, along the first axis first.
fn between(texels: &[f32], cells: &[Cell]) -> f32 {
    let Some((Cell { base, step, fraction }, before)) = cells.split_last() else { return texels[0] };
    let near = between(&texels[*base..], before);
    let far = between(&texels[base + step..], before);
    near + (far - near) * fraction
}
