//! Published formulas as shader functions, written here in a shader's own ways, against plain Rust.

use lobefit_math::ops::{exp2f, powf};

use crate::shaders::{assert_bits, at, functions, one, points, read_functions};

/// K of Karis 2014: constants in vectors, a swizzle, a vector result.
fn karis(mu: f32, rough: f32) -> [f32; 2] {
    let [x, y, z, w] = [-rough + 1.0, -0.0275 * rough + 0.0425, -0.572 * rough + 1.04, 0.022 * rough + -0.04];
    let t = (x * x).min(exp2f(-9.28 * mu)) * x + y;
    [-1.04 * t + z, 1.04 * t + w]
}

#[test]
fn karis_in_both_languages() {
    let wgsl = "
        const SLOPE = vec4<f32>(-1.0, -0.0275, -0.572, 0.022);
        fn brdf(mu: f32, rough: f32) -> vec2<f32> {
            let offset = vec4<f32>(1.0, 0.0425, 1.04, -0.04);
            let r = SLOPE * rough + offset;
            let t = min(r.x * r.x, exp2(-9.28 * mu)) * r.x + r.y;
            return vec2<f32>(-1.04, 1.04) * t + r.zw;
        }";
    let glsl = "#version 300 es
        #include \"common.glsl\"
        precision highp float;
        // Split sum on a phone.
        const vec4 slope = vec4(-1, -0.0275, -0.572, 0.022);
        vec2 brdf(float mu, float rough) {
            const vec4 offset = vec4(1, 0.0425, 1.04, -0.04);
            vec4 r = slope * rough + offset;
            float t = min(r.x * r.x, exp2(-9.28 * mu)) * r.x + r.y;
            return vec2(-1.04, 1.04) * t + r.zw;
        }";
    for (source, file) in [(wgsl, "k.wgsl"), (glsl, "k.glsl")] {
        let function = one(source, file, "brdf");
        assert_eq!(function.inputs, ["mu", "rough"]);
        assert_eq!(function.results, ["x", "y"]);
        assert_bits(&function, karis);
    }
}

#[test]
fn lazarov_with_colours_as_arguments() {
    let source = "
        vec3 environment(vec3 f0, float gloss, float mu)
        {
            vec4 t = vec4(1.0 / 0.96, 0.475, (0.0275 - 0.25 * 0.04) / 0.96, 0.25);
            t *= vec4(gloss, gloss, gloss, gloss);
            t += vec4(0.0, 0.0, (0.015 - 0.75 * 0.04) / 0.96, 0.75);
            float a0 = t.x * min(t.y, exp2(-9.28 * mu)) + t.z;
            float a1 = t.w;
            return clamp(a0 + f0 * (a1 - a0), 0.0, 1.0);
        }";
    let function = one(source, "l.glsl", "environment");
    assert_eq!(function.inputs, ["f0.x", "f0.y", "f0.z", "gloss", "mu"]);
    for [gloss, mu] in points() {
        let k = [1.0f32 / 0.96, (0.0275f32 - 0.25 * 0.04) / 0.96, (0.015f32 - 0.75 * 0.04) / 0.96];
        let a0 = (k[0] * gloss) * (0.475 * gloss).min(exp2f(-9.28 * mu)) + (k[1] * gloss + k[2]);
        let a1 = 0.25 * gloss + 0.75;
        for (c, f0) in [0.04f32, 0.5, 1.0].into_iter().enumerate() {
            let found = at(&function, &[0.04, 0.5, 1.0, gloss, mu])[c];
            let expected = (a0 + f0 * (a1 - a0)).clamp(0.0, 1.0);
            assert!((found - expected).abs() <= 2e-7, "{gloss} {mu}: {found} {expected}");
        }
    }
}

/// L2 of Narkowicz 2014.
fn narkowicz(gloss: f32, mu: f32) -> [f32; 2] {
    let t = |a: f32, b: f32| a * gloss + b;
    let [t0, t1, t2, t3] = [t(0.5745, 0.5753), t(1.548, -0.2511), t(-0.02397, -0.02066), t(1.301, 0.4755)];
    let bias = (t0 * t1.min(exp2f(-7.672 * mu)) + t2).clamp(0.0, 1.0);
    [t3.clamp(0.0, 1.0) - bias, bias]
}

#[test]
fn narkowicz_through_out_arguments_and_a_helper() {
    let source = "
        #define LINEAR(a, b) ((a) * gloss + (b))
        float saturate(float x) { return clamp(x, 0.0, 1.0); }
        void split_sum(in float gloss, float mu, out float scale, out float bias) {
            vec4 t;
            t.x = LINEAR(0.5745, 0.5753);
            t.y = LINEAR(1.548, -0.2511);
            t.zw = vec2(LINEAR(-0.02397, -0.02066), LINEAR(1.301, 0.4755));
            bias = saturate(t.x * min(t.y, exp2(-7.672 * mu)) + t.z);
            scale = saturate(t.w) - bias;
        }";
    let function = one(source, "n.glsl", "split_sum");
    assert_eq!(function.results, ["scale", "bias"]);
    assert_bits(&function, narkowicz);
}

/// M1, the rational biquadratic of MaterialX.
fn material_x(x: f32, y: f32) -> [f32; 2] {
    let rows = [
        [0.10031f32, 0.9345, 1.0, 1.0],
        [-0.63301, -2.32352, -1.76427, 0.22797],
        [9.74995, 2.22823, 8.26501, 15.93688],
        [-2.02075, -3.74584, 11.5484, -55.82466],
        [29.38247, 1.4245, 28.99991, 13.07919],
        [-8.24713, -0.76829, -7.50867, 41.25882],
        [-26.5151, 1.43366, -36.16186, 54.86775],
        [19.98406, 0.2906, 15.85408, 300.10923],
        [-5.41717, 0.62933, 33.4155, -284.73288],
    ];
    let (x2, y2) = (x * x, y * y);
    let terms = [x, y, x * y, x2, y2, x2 * y, x * y2, x2 * y2];
    let r: Vec<f32> = (0..4)
        .map(|c| rows[1..].iter().zip(terms).fold(rows[0][c], |sum, (row, term)| sum + row[c] * term))
        .collect();
    [(r[0] / r[2]).clamp(0.0, 1.0), (r[1] / r[3]).clamp(0.0, 1.0)]
}

#[test]
fn materialx_with_a_loop_over_an_array_of_vectors() {
    let source = "
        const R = array<vec4<f32>, 9>(
            vec4(0.10031, 0.9345, 1.0, 1.0), vec4(-0.63301, -2.32352, -1.76427, 0.22797),
            vec4(9.74995, 2.22823, 8.26501, 15.93688), vec4(-2.02075, -3.74584, 11.5484, -55.82466),
            vec4(29.38247, 1.4245, 28.99991, 13.07919), vec4(-8.24713, -0.76829, -7.50867, 41.25882),
            vec4(-26.5151, 1.43366, -36.16186, 54.86775), vec4(19.98406, 0.2906, 15.85408, 300.10923),
            vec4(-5.41717, 0.62933, 33.4155, -284.73288));
        struct Split { a: f32, b: f32 }
        fn albedo(x: f32, y: f32) -> Split {
            let x2 = x * x;
            let y2 = y * y;
            var terms = array<f32, 8>(x, y, x * y, x2, y2, x2 * y, x * y2, x2 * y2);
            var r = R[0];
            for (var i = 0; i < 8; i++) { r += R[i + 1] * terms[i]; }
            let q = saturate(r.xy / r.zw);
            return Split(q.x, q.y);
        }";
    let function = one(source, "m.wgsl", "albedo");
    assert_eq!(function.results, ["a", "b"]);
    assert_bits(&function, material_x);
    let source = "
        vec3 directional(float x, float y, vec3 F0, vec3 F90) {
            float x2 = x * x;
            float y2 = y * y;
            vec4 r = vec4(0.10031, 0.9345, 1.0, 1.0) + vec4(-0.63301, -2.32352, -1.76427, 0.22797) * x
                + vec4(9.74995, 2.22823, 8.26501, 15.93688) * y + vec4(-2.02075, -3.74584, 11.5484, -55.82466) * (x * y)
                + vec4(29.38247, 1.4245, 28.99991, 13.07919) * x2 + vec4(-8.24713, -0.76829, -7.50867, 41.25882) * y2
                + vec4(-26.5151, 1.43366, -36.16186, 54.86775) * (x2 * y) + vec4(19.98406, 0.2906, 15.85408, 300.10923) * (x * y2)
                + vec4(-5.41717, 0.62933, 33.4155, -284.73288) * (x2 * y2);
            vec2 ab = clamp(r.xy / r.zw, 0.0, 1.0);
            return F0 * ab.x + F90 * ab.y;
        }";
    let function = one(source, "m.glsl", "directional");
    for [x, y] in points() {
        let [a, b] = material_x(x, y);
        let found = at(&function, &[x, y, 0.1, 0.04, 0.7, 1.0, 1.0, 0.5])[1];
        assert_eq!(found.to_bits(), (0.04 * a + 1.0 * b).to_bits());
    }
}

/// G of Ray Tracing Gems, chapter 32, equation 4, in the order of its matrix products.
fn gems(mu: f32, alpha: f32) -> [f32; 2] {
    let (x, y) = ([1.0, mu, mu * mu, mu * mu * mu], [1.0, alpha, alpha * alpha, alpha * alpha * alpha]);
    let row2 = |m: [f32; 4]| [m[0] * x[0] + m[1] * x[1], m[2] * x[0] + m[3] * x[1]];
    let form2 = |m: [f32; 4]| row2(m)[0] * y[0] + row2(m)[1] * y[1];
    let row3 = |m: [f32; 9], p: [f32; 3]| [0, 3, 6].map(|i| m[i] * p[0] + m[i + 1] * p[1] + m[i + 2] * p[2]);
    let form3 = |m: [f32; 9], p: [f32; 3]| {
        let r = row3(m, p);
        r[0] * y[0] + r[1] * y[1] + r[2] * y[3]
    };
    let bias = form2([0.99044, -1.28514, 1.29678, -0.755907])
        / form3(
            [1.0, 2.92338, 59.4188, 20.3225, -27.0302, 222.592, 121.563, 626.13, 316.627],
            [x[0], x[1], x[3]],
        );
    let scale = form2([0.0365463, 3.32707, 9.0632, -9.04756])
        / form3(
            [1.0, 3.59685, -1.36772, 9.04401, -16.3174, 9.22949, 5.56589, 19.7886, -20.2123],
            [x[0], x[2], x[3]],
        );
    [scale, bias]
}

#[test]
fn ray_tracing_gems_with_matrices() {
    // The columns of a GLSL matrix are the rows of the formula's, so the vector multiplies from the
    // left.
    let source = "
        vec2 approximate(float mu, float alpha) {
            vec4 X, Y;
            X.x = 1.0; X.y = mu; X.z = mu * mu; X.w = mu * mu * mu;
            Y.x = 1.0; Y.y = alpha; Y.z = alpha * alpha; Y.w = alpha * alpha * alpha;
            mat2 M1 = mat2(0.99044, -1.28514, 1.29678, -0.755907);
            mat3 M2 = mat3(1.0, 2.92338, 59.4188, 20.3225, -27.0302, 222.592, 121.563, 626.13, 316.627);
            mat2 M3 = mat2(0.0365463, 3.32707, 9.0632, -9.04756);
            mat3 M4 = mat3(1.0, 3.59685, -1.36772, 9.04401, -16.3174, 9.22949, 5.56589, 19.7886, -20.2123);
            float bias = dot(X.xy * M1, Y.xy) / dot(X.xyw * M2, Y.xyw);
            float scale = dot(X.xy * M3, Y.xy) / dot(X.xzw * M4, Y.xyw);
            return vec2(scale, bias);
        }";
    let function = one(source, "g.glsl", "approximate");
    for [mu, alpha] in points() {
        let expected = gems(mu, alpha);
        for c in 0..2 {
            let found = at(&function, &[mu, alpha])[c];
            assert!(
                (found - expected[c]).abs() <= 4e-6 * expected[c].abs().max(1.0),
                "{mu} {alpha}: {found} {}",
                expected[c]
            );
        }
    }
    let wgsl = "
        fn bias(mu: f32, alpha: f32) -> f32 {
            let X = vec4(1.0, mu, mu * mu, mu * mu * mu);
            let Y = vec4(1.0, alpha, alpha * alpha, alpha * alpha * alpha);
            let M1 = mat2x2(0.99044, 1.29678, -1.28514, -0.755907);
            let M2 = mat3x3(1.0, 20.3225, 121.563, 2.92338, -27.0302, 626.13, 59.4188, 222.592, 316.627);
            return dot(M1 * X.xy, Y.xy) / dot(M2 * X.xyw, Y.xyw);
        }";
    let function = one(wgsl, "g.wgsl", "bias");
    assert_eq!(function.results, [""]);
    for [mu, alpha] in points() {
        let found = at(&function, &[mu, alpha])[0];
        assert!((found - gems(mu, alpha)[1]).abs() <= 1e-6);
    }
}

/// U of UE5, after its shading model file.
fn unreal(r: f32, mu: f32) -> [f32; 2] {
    let e = 1.0 - (powf(r, mu / r) * ((r * mu + 0.0266916) / (0.466495 + mu))).clamp(0.0, 1.0);
    let fifth = |x: f32| x * ((x * x) * (x * x));
    let b = fifth(1.0 - mu) * powf(2.36651 * powf(mu, 4.7703 * r) + 0.0387332, r);
    [e, b]
}

#[test]
fn unreal_with_powers_of_known_and_unknown_exponents() {
    let source = "
        struct Terms { float e; float b; };
        Terms energy(float r, float mu) {
            Terms t;
            t.e = 1.0 - clamp(pow(r, mu / r) * ((r * mu + 0.0266916) / (0.466495 + mu)), 0.0, 1.0);
            t.b = pow(1.0 - mu, 5.0) * pow(2.36651 * pow(mu, 4.7703 * r) + 0.0387332, r);
            return t;
        }";
    let function = one(source, "u.glsl", "energy");
    assert_eq!(function.results, ["e", "b"]);
    for [r, mu] in points().filter(|[r, _]| *r > 0.0) {
        for (found, expected) in at(&function, &[r, mu]).into_iter().zip(unreal(r, mu)) {
            assert_eq!(found.to_bits(), expected.to_bits(), "{r} {mu}");
        }
    }
}

/// Q of Tauray.
fn tauray(mu: f32, y: f32) -> [f32; 2] {
    let h = mu * y;
    let mut n = 0.356334 * h * h * h - 2.189899;
    n = n * h + (y * (y * (30.106651 * y - 72.778887) + 57.887217) - 11.910812);
    n = n * mu + (y * (y * (-34.517973 * y + 86.062015) - 69.862862) + 16.205007);
    n = n * mu + (y * (y * (7.556232 * y - 19.236401) + 16.191891) - 4.561471);
    let e = (1.0 + n * y * y).clamp(0.0, 1.0);
    let top = 1.0 - 0.398996 * y + mu * (-1.79907 + mu * (0.79907 + 0.398996 * y));
    let b = top / (1.0 + 16.436949 * y * y + mu * (25.826333 * mu - 15.469869 * y));
    [e, b.clamp(0.0, 1.0)]
}

#[test]
fn tauray_with_branches_and_early_returns() {
    let source = "
        float cubic(float y, float a, float b, float c, float d) { return y * (y * (a * y + b) + c) + d; }
        fn_placeholder
        vec2 preintegrated(float mu, float y) {
            float h = mu * y;
            float n = 0.356334 * h * h * h - 2.189899;
            n = n * h + cubic(y, 30.106651, -72.778887, 57.887217, -11.910812);
            n = n * mu + cubic(y, -34.517973, 86.062015, -69.862862, 16.205007);
            n = n * mu + cubic(y, 7.556232, -19.236401, 16.191891, -4.561471);
            float top = 1.0 - 0.398996 * y + mu * (-1.79907 + mu * (0.79907 + 0.398996 * y));
            float b = top / (1.0 + 16.436949 * y * y + mu * (25.826333 * mu - 15.469869 * y));
            float e = 1.0 + n * y * y;
            if (e > 1.0) { e = 1.0; } else if (e < 0.0) e = 0.0;
            if (b < 0.0) return vec2(e, 0.0);
            return vec2(e, b > 1.0 ? 1.0 : b);
        }"
    .replace("fn_placeholder", "");
    let function = one(&source, "q.glsl", "preintegrated");
    for [mu, y] in points() {
        for (found, expected) in at(&function, &[mu, y]).into_iter().zip(tauray(mu, y)) {
            assert!((found - expected).abs() <= 3e-6, "{mu} {y}: {found} {expected}");
        }
    }
    // All readable functions, helpers among them.
    let names: Vec<String> = functions(&source, "q.glsl", None).into_iter().map(|f| f.name).collect();
    assert_eq!(names, ["cubic", "preintegrated"]);
}

#[test]
fn published_glsl_is_read_as_it_is_printed() {
    // Karis's fit in the words of engines: a view and a normal, const in, saturate from elsewhere
    // or as a macro.
    let body = "vec2 dfg( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
        float dotNV = saturate( dot( normal, viewDir ) );
        const vec4 c0 = vec4( - 1, - 0.0275, - 0.572, 0.022 );
        const vec4 c1 = vec4( 1, 0.0425, 1.04, - 0.04 );
        vec4 r = roughness * c0 + c1;
        float a004 = min( r.x * r.x, exp2( - 9.28 * dotNV ) ) * r.x + r.y;
        vec2 fab = vec2( - 1.04, 1.04 ) * a004 + r.zw;
        return fab;
    }";
    for before in [
        "",
        "#define saturate( a ) clamp( a, 0.0, 1.0 )\n",
        "#ifndef saturate\n#define saturate(a) clamp(a, 0.0, 1.0)\n#endif\n#define whiteComplement( a ) ( 1.0 - saturate( a ) )\n",
        "float saturate(float x) { return clamp(x, 0.0, 1.0); }\n",
    ] {
        let function = one(&format!("{before}{body}"), "d.glsl", "dfg");
        assert_eq!(function.inputs.len(), 7);
        for [mu, rough] in points() {
            let side = (1.0 - mu * mu).sqrt();
            let found = at(&function, &[0.0, 0.0, 1.0, side, 0.0, mu, rough]);
            let expected = karis(mu, rough);
            assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 2e-7), "{found:?} {expected:?}");
        }
    }
    // A place in a message is that of the text, not of what is put before it.
    let source = "float f(float x) { return saturate(x); }\nfloat g(float x) { return saturate(y); }";
    let error = read_functions(source.as_bytes(), "p.glsl", Some("g")).unwrap_err().to_string();
    assert!(error.starts_with("p.glsl: 2:"), "{error}");
    assert_eq!(functions(source, "p.glsl", None)[0].left_out[0].name, "g");
}
