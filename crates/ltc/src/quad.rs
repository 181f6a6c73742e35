//! What shaders call for a quadrilateral: the text, and its value in their arithmetic.

use crate::LtcError;
use lobefit_math::vector::Vec3;
use lobefit_shade::code::Language;
use lobefit_shade::{Source, Tape};

/// Names of the functions, each after those that it calls; the last is what a shader calls.
pub const FUNCTIONS: [&str; 6] = ["ltc_arc", "ltc_edge", "ltc_raised", "ltc_lit", "ltc_leaving", QUAD];

/// The function of a quadrilateral.
pub const QUAD: &str = "ltc_quad";

/// Names of the arguments, a vector component by component.
const MATRIX: [&str; 4] = ["matrix.x", "matrix.y", "matrix.z", "matrix.w"];
const AXES: [char; 3] = ['x', 'y', 'z'];

/// The function's text in WGSL, what it calls before it.
pub const TEXT: &str = include_str!("quad.wgsl");

/// The function, evaluated in f32.
#[derive(Clone, Debug)]
pub struct Quad {
    tape: Tape,
    /// For each input of the tape where it stands among those of the matrix and of the corners.
    places: Vec<usize>,
}

impl Quad {
    fn source() -> Result<Source, LtcError> {
        let source = Source::parse("quad.wgsl", TEXT)?;
        Ok(source.inlined(|name| name == "taken"))
    }

    /// The functions in a language; `error` says how far the last is off.
    ///
    /// # Errors
    /// A text that does not parse, a defect of this program.
    pub fn print(language: Language, error: &str) -> Result<String, LtcError> {
        let (source, mut text) = (Quad::source()?, String::new());
        for name in FUNCTIONS {
            let mut header = source.doc(name)?.to_vec();
            header.extend((name == QUAD).then(|| error.to_string()));
            text += &format!("\n{}", source.print(language, name, &header)?);
        }
        Ok(text)
    }

    /// The last of them.
    ///
    /// # Errors
    /// A text that does not parse, a defect of this program.
    pub fn new() -> Result<Quad, LtcError> {
        let tape = Quad::source()?.tape(QUAD, 0)?;
        let corner = |k: usize| AXES.map(|axis| format!("p{k}.{axis}"));
        let names: Vec<String> =
            MATRIX.into_iter().map(String::from).chain((0..4).flat_map(corner)).collect();
        let place = |input: &String| names.iter().position(|name| name == input);
        let places = tape.inputs().iter().map(place).collect::<Option<Vec<usize>>>();
        let unknown = || LtcError::Shape(format!("{QUAD} has other arguments: {}", tape.inputs().join(", ")));
        Ok(Quad { places: places.ok_or_else(unknown)?, tape })
    }

    /// Operations of a call.
    pub fn ops(&self) -> u32 {
        self.tape.cost_ops()
    }

    /// The share of the light within a quadrilateral by a matrix as a texel has it.
    pub fn share(&self, texel: [f64; 4], corners: &[Vec3; 4]) -> f64 {
        let mut given = [0.0_f32; 16];
        let all = texel.iter().chain(corners.iter().flatten());
        given.iter_mut().zip(all).for_each(|(to, from)| *to = *from as f32);
        let inputs: Vec<f32> = self.places.iter().map(|place| given[*place]).collect();
        f64::from(self.tape.at(&inputs, &[]))
    }
}
