//! Functions that engines and HLSL have and GLSL has not, in GLSL: they are for names that a source
//! does not declare itself.

use std::fmt::Write;

use super::ShaderLanguage;

/// The name of the text in messages.
pub(super) const NAME: &str = "HLSL's own functions";

/// Types of numbers, and what tells their overloads apart.
const TYPES: [&str; 4] = ["float", "vec2", "vec3", "vec4"];

/// The functions of a language.
pub(super) fn library(language: ShaderLanguage) -> String {
    let mut text = String::new();
    if language == ShaderLanguage::Wgsl {
        return text;
    }
    for t in TYPES {
        // Engines define it for all their sources, and shaders call it without saying so.
        add(&mut text, t, "saturate", &[t], "clamp(a, 0.0, 1.0)");
    }
    if language == ShaderLanguage::Hlsl {
        hlsl(&mut text);
    }
    text
}

fn add(text: &mut String, result: &str, name: &str, parameters: &[&str], value: &str) {
    let names = ["a", "b", "c"];
    let list: Vec<String> = parameters.iter().zip(names).map(|(t, n)| format!("{t} {n}")).collect();
    // Writing to a string does not fail.
    let _ = writeln!(text, "{result} {name}({}) {{ return {value}; }}", list.join(", "));
}

/// HLSL's own, and its overloads of shared ones in which a number stands for a vector.
fn hlsl(text: &mut String) {
    for t in TYPES {
        add(text, t, "rcp", &[t], "1.0 / a");
        add(text, t, "fmod", &[t, t], "a - b * trunc(a / b)");
        add(text, t, "mad", &[t, t, t], "a * b + c");
        add(text, t, "log10", &[t], "log2(a) * 0.30102999566");
    }
    add(text, "float", "mul", &["float", "float"], "a * b");
    for (n, v) in [(2, "vec2"), (3, "vec3"), (4, "vec4")] {
        add(text, "float", "mul", &[v, v], "dot(a, b)");
        add(text, v, "mul", &["float", v], "a * b");
        add(text, v, "mul", &[v, "float"], "a * b");
        // Rows of HLSL are columns here.
        let m = format!("mat{n}");
        add(text, v, "mul", &[&m, v], "b * a");
        add(text, v, "mul", &[v, &m], "b * a");
        add(text, &m, "mul", &[&m, &m], "b * a");
        // GLSL has max(v, x), min(v, x) and step(x, v) itself.
        for name in ["min", "max", "pow", "fmod"] {
            add(text, v, name, &["float", v], &format!("{name}({v}(a), b)"));
        }
        for name in ["pow", "fmod", "step"] {
            add(text, v, name, &[v, "float"], &format!("{name}(a, {v}(b))"));
        }
        for name in ["mix", "clamp", "mad", "smoothstep"] {
            for shape in ["fvf", "vff", "ffv", "fvv", "vfv", "vvf"] {
                let types: Vec<&str> = shape.chars().map(|c| if c == 'v' { v } else { "float" }).collect();
                let known = name == "mix" && shape == "vvf"
                    || name == "clamp" && shape == "vff"
                    || name == "smoothstep" && shape == "ffv";
                if !known {
                    let value = format!("{name}({v}(a), {v}(b), {v}(c))");
                    add(text, v, name, &types, &value);
                }
            }
        }
    }
}
