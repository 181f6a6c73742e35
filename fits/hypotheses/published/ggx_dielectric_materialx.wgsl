/// Published: MaterialX, mx_microfacet_specular.glsl, mx_ggx_dir_albedo_analytic, as its dielectric takes it:
/// f0 R1/R3 + R2/R4, each biquadratic in mu and alpha, f0 from the index of refraction. Meant for the
/// height-correlated Smith form.
fn ggx_dielectric_materialx(alpha: f32, mu: f32, ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    let f0 = root * root;
    let m2 = mu * mu;
    let a2 = alpha * alpha;
    let ma = mu * alpha;
    let m2a = m2 * alpha;
    let ma2 = mu * a2;
    let m2a2 = m2 * a2;
    let r1 = 0.10031 - 0.63301 * mu + 9.74995 * alpha - 2.02075 * ma + 29.38247 * m2
        - 8.24713 * a2 - 26.5151 * m2a + 19.98406 * ma2 - 5.41717 * m2a2;
    let r2 = 0.9345 - 2.32352 * mu + 2.22823 * alpha - 3.74584 * ma + 1.4245 * m2
        - 0.76829 * a2 + 1.43366 * m2a + 0.2906 * ma2 + 0.62933 * m2a2;
    let r3 = 1.0 - 1.76427 * mu + 8.26501 * alpha + 11.5484 * ma + 28.99991 * m2
        - 7.50867 * a2 - 36.16186 * m2a + 15.85408 * ma2 + 33.4155 * m2a2;
    let r4 = 1.0 + 0.22797 * mu + 15.93688 * alpha - 55.82466 * ma + 13.07919 * m2
        + 41.25882 * a2 + 54.86775 * m2a + 300.10923 * ma2 - 284.73288 * m2a2;
    return f0 * saturate(r1 / r3) + saturate(r2 / r4);
}
