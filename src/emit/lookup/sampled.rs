//! The lookup in the languages that have textures: one fetch.

use super::functions::numbers;
use super::{LETTERS, Readable, decoding};
use crate::data::TexelFormat;
use crate::emit::spelling::{argument, declare, head, vector};
use lobefit_shade::code::Language;

/// What picks a texel's channels from the four that are fetched.
const SWIZZLES: [&str; 4] = [".x", ".xy", ".xyz", ""];

/// Types of the arguments `table` and `linear_clamp`; GLSL's table holds its sampler.
fn resources(language: Language, axes: usize) -> Vec<String> {
    let (table, sampler) = match language {
        Language::Wgsl => (format!("texture_{axes}d<f32>"), "sampler"),
        Language::Hlsl => (format!("Texture{axes}D<float4>"), "SamplerState"),
        Language::Msl => (format!("texture{axes}d<float>"), "sampler"),
        _ => return vec![argument(language, "table", &format!("sampler{axes}D"))],
    };
    vec![argument(language, "table", &table), argument(language, "linear_clamp", sampler)]
}

fn fetch(language: Language, coordinates: &str) -> String {
    match language {
        Language::Hlsl => format!("table.SampleLevel(linear_clamp, {coordinates}, 0.0f)"),
        Language::Msl => format!("table.sample(linear_clamp, {coordinates}, level(0.0f))"),
        Language::Wgsl => format!("textureSampleLevel(table, linear_clamp, {coordinates}, 0.0)"),
        _ => format!("textureLod(table, {coordinates}, 0.0)"),
    }
}

/// What a device must have for texels of 32 bits.
fn feature(language: Language) -> &'static str {
    match language {
        Language::Wgsl => "Texels of 32 bits need a device with the feature float32-filterable.",
        Language::Msl => "Texels of 32 bits need a device with supports32BitFloatFiltering.",
        Language::Hlsl => "Texels of 32 bits need a device that filters them, which Direct3D leaves open.",
        _ => "Texels of 32 bits need, in OpenGL ES, the extension OES_texture_float_linear.",
    }
}

pub(super) fn lookup(readable: &Readable, language: Language) -> String {
    let (name, n) = (readable.identifier(), readable.table.axes.len());
    let body = decoding::body(readable.decode, |_| String::new());
    let uv = LETTERS[..n].concat();
    let arguments = [resources(language, n), numbers(language, &readable.arguments())].concat();
    let mut text =
        format!("/// {} by one fetch; the sampler filters linearly and clamps to the edge.\n", body.meaning);
    if readable.table.format == TexelFormat::F32 {
        text += &format!("/// {}\n", feature(language));
    }
    text += &head(language, &format!("{name}_lookup"), &arguments, &vector(language, body.values.len()));
    let call = format!("{name}_{uv}({})", readable.coordinate_arguments().join(", "));
    text += &declare(language, &vector(language, n), &uv, &call);
    text += &declare(language, &vector(language, 4), "texel", &fetch(language, &uv));
    let channels = SWIZZLES[readable.decode.channels() - 1];
    let decoded: String = readable.decode_arguments().iter().map(|name| format!(", {name}")).collect();
    text + &format!("    return {name}_decode(texel{channels}{decoded});\n}}\n")
}
