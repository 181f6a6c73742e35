//! HLSL: what has a counterpart in GLSL has the values of plain arithmetic, and what lacks a
//! counterpart is refused at its place.

use lobefit_audit::foreign::{ShaderFunction, Surroundings, read_functions};

fn one(source: &str, entry: &str) -> ShaderFunction {
    let around = Surroundings::default();
    let mut found = read_functions(source.as_bytes(), "t.hlsl", Some(entry), &around)
        .unwrap_or_else(|e| panic!("{e}\n{source}"));
    assert_eq!(found.len(), 1);
    found.remove(0)
}

fn values(source: &str, entry: &str, inputs: &[f32]) -> Vec<f32> {
    one(source, entry).at(inputs).expect("it is run")
}

#[test]
fn types_intrinsics_and_casts() {
    let body = |body: &str| format!("float f(float x, half3 v) {{ {body} }}");
    let (x, v) = (0.75_f32, [0.25_f32, 0.5, 2.0]);
    let dot = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    for (text, wanted) in [
        ("return lerp(2.0, 4.0, x);", 2.0 * 0.25 + 4.0 * x),
        ("return frac(x * 3) + rsqrt(4.0h) + rcp(v.z);", 0.25 + 0.5 + 0.5),
        ("return mad(x, 2, 1) + saturate(x + 1);", 2.5 + 1.0),
        ("return fmod(-5.5, 2) + log10(100.0f);", -1.5 + 2.0),
        ("return max(1 - x, 0) * pow(max(x, 0), 2);", 0.25 * 0.5625),
        ("return (float)(int)(x * 4.5) + (half)1;", 4.0),
        ("float3 w = 0; w.x = x; return w.x + w.y + w.z;", x),
        ("float3 w = v; w = 2; return w.y + dot(v, v);", 2.0 + dot),
        ("float2 w = { x, 1.f }; return w.y - w.x;", 0.25),
        ("return lerp(0.04, v, x).y;", 0.04 * 0.25 + 0.5 * x),
        ("return pow(v, 2).z + max(0.5, v).x + min(v, 1).z;", 4.0 + 0.5 + 1.0),
        ("return ((float3)x).z + float3(v.xy, 1).y + v.bgr.x;", x + 0.5 + 2.0),
        ("[unroll] for (int i = 0; i < 3; i++) { x += v[i]; } return x;", 0.75 + 2.75),
        ("[branch] if (x > 0.5) return -x; else return 1;", -x),
        ("const uint n = 3; float s = 0; for (uint k = 0; k < n; ++k) s += k; return s;", 3.0),
        ("return clamp(v, 0, 1).z + step(v, 0.3).x;", 1.0 + 1.0),
    ] {
        let found = values(&body(text), "f", &[x, v[0], v[1], v[2]])[0];
        assert!((found - wanted).abs() <= 4e-7 * wanted.abs().max(1.0), "{text}: {found}, not {wanted}");
    }
}

#[test]
fn rows_of_matrices_are_rows() {
    let source = "
    float4 f(float a, float b)
    {
        float2x2 M = float2x2(1, 2, 3, 4);
        float3x3 N = { 1, 0, 0, 0, 1, 0, 5, 0, 1 };
        float2 column = mul(M, float2(a, b));
        float2 row = mul(float2(a, b), M);
        return float4(column.y, row.y, mul(N, float3(a, b, 1)).z, mul(mul(M, M), column).x + M[1][0] + M[0].y);
    }";
    let (a, b) = (0.5_f32, 0.25_f32);
    let column = [a + 2.0 * b, 3.0 * a + 4.0 * b];
    let square = [7.0, 10.0];
    let last = square[0] * column[0] + square[1] * column[1] + 3.0 + 2.0;
    let wanted = [column[1], 2.0 * a + 4.0 * b, 5.0 * a + 1.0, last];
    assert_eq!(values(source, "f", &[a, b]), wanted);
}

#[test]
fn files_as_engines_ship_them() {
    let source = "
    #pragma once
    import Utils.Math;
    Texture2D<float4> gLut : register(t0);
    SamplerState gSampler : register(s0);
    cbuffer Frame : register(b0) { float4 tint; }
    namespace Brdf
    {
        static const float kCoefficients[2][2] = { { 0.5, 2 }, { 1.0f, 4 } };
        static const half3 kGrey = { 1, 2, 4 };
        /** A fit, with odd signs: it's 5 > 4. */
        [Differentiable]
        inline float3 fitted(in const float3 specular, half alpha, float cosTheta = 1.0, out float bias) : SV_Target
        {
            float4 X;
            X.x = 1.f;
            X.yz = float2(cosTheta, alpha);
            X.w = kCoefficients[1][1];
            bias = kCoefficients[0][1] * X.y;
            if (alpha <= 0) return 0;
            return specular * X.w + Brdf::kGrey * bias;
        }
    }
    struct Lobe : ILobe { float alpha; float eval(float3 wi) { return alpha * wi.z; } }
    float3 sampled<T : ISampler>(T s) { return s.next(); }
    float textured(float2 uv) { return gLut.Sample(gSampler, uv).x; }
    float method(Lobe lobe) { return lobe.eval(float3(0, 0, 1)); }
    float after(float x) { return 2 * x; }
    ";
    let found = one(source, "fitted");
    assert_eq!(found.signature, "fitted(float3, half, float)".replace("float)", "float, float)"));
    assert_eq!(found.inputs, ["specular.x", "specular.y", "specular.z", "alpha", "cosTheta"]);
    assert_eq!(found.results, ["x", "y", "z", "bias"]);
    let [r, g, b, bias] = found.at(&[0.5, 0.25, 1.0, 0.5, 0.25]).unwrap().try_into().unwrap();
    assert_eq!([r, g, b, bias], [2.5, 2.0, 6.0, 0.5]);
    assert_eq!(values(source, "after", &[0.5]), [1.0]);
    for (entry, place, part) in
        [("textured", "26:5", "texture"), ("method", "24:", "HLSL"), ("nothing", "", "fitted")]
    {
        let error =
            read_functions(source.as_bytes(), "t.hlsl", Some(entry), &Surroundings::default()).unwrap_err();
        let message = error.to_string();
        assert!(
            message.starts_with(&format!("t.hlsl: {place}")) && message.contains(part),
            "{entry}: {message}"
        );
    }
}

#[test]
fn functions_of_namespaces_are_called_with_default_arguments() {
    let source = "
    #define COMPILE_TIME
    #define SAFE 3
    namespace lib {
    namespace Math {
        inline float Inverse( float x, COMPILE_TIME const uint mode = SAFE, float least = 0.25 )
        { if( mode <= 1 ) return rcp( x ); return 1.0f / max( x, least ); }
        inline float2 Inverse( float2 x, COMPILE_TIME const uint mode = SAFE )
        { return float2( Inverse( x.x, mode ), Inverse( x.y, mode, 0.5 ) ); }
    }
    namespace BRDF {
        float term( float x, float y )
        { float2 both = Math::Inverse( float2( x, y ) ); return both.x + both.y + lib::Math::Inverse( x, 1u ); }
    } }
    ";
    assert_eq!(values(source, "term", &[0.125, 0.25]), [4.0 + 2.0 + 8.0]);
}

/// Structures as arguments and as variables, with semantics, with and without a semicolon behind the brace.
#[test]
fn structures_are_read() {
    let source = "struct Surf { float roughness : TEXCOORD0; float nov; };
    struct Pair { float a; float b; }
    float of(Surf s) { Pair p; p.a = 2.0 * s.roughness; p.b = s.nov; return p.a + p.b; }
    Pair both(float x) { Pair p; p.a = x; p.b = 2.0 * x; return p; }
    ";
    let found = one(source, "of");
    assert_eq!(found.inputs, ["s.roughness", "s.nov"]);
    assert_eq!(found.at(&[0.5, 0.25]).unwrap(), [1.25]);
    assert_eq!(one(source, "both").at(&[0.5]).unwrap(), [0.5, 1.0]);
}
