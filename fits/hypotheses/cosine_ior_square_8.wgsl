override c0: f32 = -0.332499;
override c1: f32 = -0.60785794;
override c2: f32 = 1.009142;
override c3: f32 = -0.9936534;
override c4: f32 = 0.3963194;
override c5: f32 = 0.66580814;
override c6: f32 = -0.14646992;
override c7: f32 = 0.005699818;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Eight operations: the square of a sum.
fn cosine_ior_square_8(mu: f32, ior: f32) -> f32 {
    let root = c0 + mu * (c1 + mu * (c2 + mu * (c3 + c4 * mu))) + ior * (c5 + ior * (c6 + c7 * mu));
    return root * root;
}
