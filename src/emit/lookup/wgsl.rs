//! The WGSL functions of a table.

use super::{LETTERS, Readable, comment, coordinates, declared, decoding};
use crate::data::TexelFormat;

/// What picks a texel's channels from the four that are fetched.
const SWIZZLES: [&str; 4] = [".x", ".xy", ".xyz", ""];

fn vector(n: usize) -> String {
    format!("vec{n}<f32>")
}

pub(super) fn print(readable: &Readable) -> String {
    let [uv, decode, lookup] = [uv, decode, lookup].map(|part| part(readable));
    format!("{}{uv}\n{decode}\n{lookup}", comment("///", readable.header))
}

fn uv(readable: &Readable) -> String {
    let (name, axes) = (readable.identifier(), &readable.table.axes);
    let letters = &LETTERS[..axes.len()];
    let (result, arguments) = (vector(axes.len()), declared(&readable.coordinate_arguments()));
    let mut text = format!("fn {name}_{}({arguments}) -> {result} {{\n", letters.concat());
    text.extend(coordinates(axes).iter().map(|line| format!("    {line}\n")));
    text + &format!("    return {result}({});\n}}\n", letters.join(", "))
}

fn decode(readable: &Readable) -> String {
    let (name, channels) = (readable.identifier(), readable.decode.channels());
    let part = |i: usize| if channels == 1 { "texel".into() } else { format!("texel.{}", &"xyzw"[i..=i]) };
    let body = decoding::body(readable.decode, part);
    let texel = if channels == 1 { "f32".into() } else { vector(channels) };
    let arguments = [format!("texel: {texel}"), declared(&readable.decode_arguments())];
    let arguments = arguments.iter().filter(|a| !a.is_empty()).cloned().collect::<Vec<_>>().join(", ");
    let result = body.result(vector);
    let mut text = format!("/// {} from a texel of the table above.\n", body.meaning);
    text += &format!("fn {name}_decode({arguments}) -> {result} {{\n");
    text.extend(body.lets.iter().map(|line| format!("    {line}\n")));
    let values = body.values.join(", ");
    let value = if body.values.len() == 1 { values } else { format!("{result}({values})") };
    text + &format!("    return {value};\n}}\n")
}

fn lookup(readable: &Readable) -> String {
    let (name, n) = (readable.identifier(), readable.table.axes.len());
    let body = decoding::body(readable.decode, |_| String::new());
    let (meaning, result, uv) = (body.meaning, body.result(vector), LETTERS[..n].concat());
    let channels = SWIZZLES[readable.decode.channels() - 1];
    let decoded: String = readable.decode_arguments().iter().map(|name| format!(", {name}")).collect();
    let feature = match readable.table.format {
        TexelFormat::F16 => "",
        TexelFormat::F32 => "/// Texels of 32 bits need a device with the feature float32-filterable.\n",
    };
    format!(
        "/// {meaning} by one fetch; the sampler filters linearly and clamps to the edge.
{feature}fn {name}_lookup(table: texture_{n}d<f32>, linear_clamp: sampler, {}) -> {result} {{
    let {uv} = {name}_{uv}({});
    let texel = textureSampleLevel(table, linear_clamp, {uv}, 0.0);
    return {name}_decode(texel{channels}{decoded});
}}
",
        declared(&readable.arguments()),
        readable.coordinate_arguments().join(", "),
    )
}
