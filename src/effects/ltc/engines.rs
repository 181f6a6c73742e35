//! A pair of tables in the one file that an engine reads it from.

use crate::data::{Engine, Table, TexelFormat, shortest};
use crate::emit::ktx2;
use crate::emit::texture::TextureError;
use std::fmt::Write as _;

/// The file of a pair, after a header where the file has room for one.
pub(super) fn file(engine: Engine, pair: [&Table; 2], header: &[String]) -> Result<Vec<u8>, TextureError> {
    match engine {
        Engine::Babylon => Ok(babylon(pair)),
        Engine::Bevy => ktx2::layers(&pair),
        Engine::Three => Ok(three(pair, header).into_bytes()),
    }
}

/// Texels of a table one after another.
fn texels(table: &Table) -> impl Iterator<Item = [f64; 4]> {
    let count: usize = table.size().iter().product();
    (0..count).map(|i| std::array::from_fn(|c| table.channels[c].texels[i]))
}

fn babylon([matrices, lights]: [&Table; 2]) -> Vec<u8> {
    let both = texels(matrices).zip(texels(lights)).flat_map(|(matrix, light)| [matrix, light]);
    let mut bytes = Vec::new();
    both.flatten().for_each(|x| TexelFormat::F16.write(x, &mut bytes));
    bytes
}

/// The arrays that `RectAreaLightTexturesLib` makes its textures from, under the names that it has for them.
fn three(pair: [&Table; 2], header: &[String]) -> String {
    let mut text: String = header.iter().map(|line| format!("// {line}\n")).collect();
    for (table, name) in pair.into_iter().zip(["LTC_MAT_1", "LTC_MAT_2"]) {
        let of = |c: usize| table.channels[c].name.as_str();
        let _ = writeln!(
            text,
            "\n// {}, {}, {}, {} of each texel.\nexport const {name} = [",
            of(0),
            of(1),
            of(2),
            of(3)
        );
        for texel in texels(table) {
            let [a, b, c, d] = texel.map(|x| shortest(table.format.quantise(x) as f32));
            let _ = writeln!(text, "{a}, {b}, {c}, {d},");
        }
        text += "];\n";
    }
    text
}
