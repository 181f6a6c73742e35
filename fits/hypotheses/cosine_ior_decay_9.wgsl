override c0: f32 = 1.0028199;
override c1: f32 = 0.03830286;
override c2: f32 = 0.4447818;
override c3: f32 = -0.45573825;
override c4: f32 = -0.018138396;
override k0: f32 = 5.276859;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Nine operations: a sum of powers of an exponential.
fn cosine_ior_decay_9(mu: f32, ior: f32) -> f32 {
    let decay = exp2(-k0 * mu);
    return c0 + decay * (c1 + decay * (c2 + decay * (c3 + c4 * ior)));
}
