override c0: f32 = 1.0009242;
override c1: f32 = -0.09440306;
override c2: f32 = -0.02122717;
override c3: f32 = 0.120672934;
override c4: f32 = 0.75621694;
override c5: f32 = -0.62545055;
override k0: f32 = 4.705344;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Ten operations: a sum of powers of an exponential.
fn cosine_ior_decay_10(mu: f32, ior: f32) -> f32 {
    let decay = exp2(-k0 * mu);
    return c0 + decay * (c1 + ior * (c2 + c3 * mu) + decay * (c4 + c5 * decay));
}
