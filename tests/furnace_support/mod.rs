//! What furnace tests share: the emitted functions of tables, run as the program of somebody who
//! uses them, and textbook lobes.

pub mod tables;
pub mod textbook;

use lobefit::data::{Decode, Table};
use lobefit::effects::table::Point;
use lobefit::emit::compensation::Compensation;
use lobefit_shade::code::Language;
use lobefit_shade::code::helpers;

use crate::emit_support::programs;
use crate::emit_support::solid::{self, names_of, readable};

/// An emitted table: its functions, and what they read.
pub struct Emitted {
    /// Rust.
    pub text: String,
    /// Name of the lookup.
    pub function: String,
    /// Arguments of the lookup.
    pub inputs: Vec<&'static str>,
    /// Channels of a texel.
    pub channels: usize,
    /// Texels in the order of the lookup, channels fastest.
    pub texels: Vec<f32>,
}

impl Emitted {
    pub fn new(table: &Table, decode: Decode) -> Emitted {
        let names = names_of(table);
        let readable = readable(table, decode, &names);
        let channels = &table.channels;
        let texel = |i: usize| channels.iter().map(move |c| c.texels[i] as f32);
        Emitted {
            text: readable.print(Language::Rust).expect("printed"),
            inputs: readable.inputs().expect("printed"),
            channels: channels.len(),
            texels: (0..channels[0].texels.len()).flat_map(texel).collect(),
            function: names.lookup,
        }
    }
}

/// The Rust file that a bake emits for these tables.
pub fn include(tables: &[Emitted], compensation: Compensation) -> String {
    let lookups: Vec<&str> = tables.iter().map(|table| table.text.as_str()).collect();
    let lookups = lookups.join("\n");
    let (shared, compensation) =
        (helpers(Language::Rust, &lookups), compensation.print(Language::Rust).expect("printed"));
    format!("#![allow(dead_code)]\n{lookups}\n{shared}\n{compensation}")
}

/// F0 of the three channels of the test's metal.
pub const F0: [f64; 3] = [1.0, 0.9, 0.5];

/// What emitted functions return at a point.
#[derive(Clone, Copy, Debug)]
pub struct Returned {
    /// The sampled E.
    pub e: f64,
    /// A lobe of 1 compensated: for metals of [`F0`], for glass three times the same.
    pub factors: [f64; 3],
}

/// The functions of `include`, compiled by rustc, for every table at its points, with the
/// compensation of colours; that of one channel must agree with it.
pub fn returned(
    include: &str,
    compensation: Compensation,
    tables: &[(&Emitted, &[Point])],
) -> Vec<Vec<Returned>> {
    let (mut numbers, mut body) = (Vec::new(), String::from("    let rest = &numbers[..];\n"));
    let (colours, factor) = match compensation {
        Compensation::Reflection => {
            (format!("reflection([1.0; 3], {F0:?}, e)"), format!("reflection_factor({:?}, e)", F0[0]))
        }
        Compensation::Glass => ("glass([1.0; 3], e)".into(), "glass_factor(e)".into()),
    };
    for (Emitted { function, inputs: given, channels, texels, .. }, points) in tables {
        numbers.extend(texels.iter().flat_map(|x| x.to_le_bytes()));
        numbers.extend(solid::bytes(points));
        let (count, inputs) = (texels.len(), 6 * points.len());
        let texels = match channels {
            1 => "texels.to_vec()".to_string(),
            n => format!(
                "texels.chunks_exact({n}).map(|t| t.try_into().unwrap()).collect::<Vec<[f32; {n}]>>()"
            ),
        };
        body += &format!(
            "    let (texels, rest) = rest.split_at({count});
    let texels = {texels};
    let (inputs, rest) = rest.split_at({inputs});
    for p in inputs.chunks_exact(6) {{
        let [roughness, alpha, n_dot_v, anisotropy, ior, cos2_phi]: [f32; 6] = p.try_into().unwrap();
        let e = lobefit::{function}(&texels, {});
        let colours = lobefit::ggx_compensate_{colours};
        assert_eq!(lobefit::ggx_compensate_{factor}, colours[0]);
        out.push(e);
        out.extend(colours);
    }}
",
            given.join(", ")
        );
    }
    body += "    assert!(rest.is_empty());\n";
    let found = programs::run(include, 1, &body, &numbers);
    let mut found = found.chunks_exact(4).map(|v| {
        let [e, a, b, c] = [v[0], v[1], v[2], v[3]].map(f64::from);
        Returned { e, factors: [a, b, c] }
    });
    tables.iter().map(|(_, points)| found.by_ref().take(points.len()).collect()).collect()
}
