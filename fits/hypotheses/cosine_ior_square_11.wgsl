override c0: f32 = -1.7842735;
override c1: f32 = 2.2318501;
override c2: f32 = -0.60637695;
override c3: f32 = -0.03185163;
override c4: f32 = 2.3951938;
override c5: f32 = -1.9400353;
override c6: f32 = 0.5192761;
override c7: f32 = 0.9348402;
override c8: f32 = -6.723331;

/// Of the cosine of the view and the index of refraction: roughness has one value.
/// Eleven operations: the square of a sum.
fn cosine_ior_square_11(mu: f32, ior: f32) -> f32 {
    let rest = 1.0 - mu;
    let t1 = mu * rest;
    let root = c0 + ior * (c1 + c2 * ior) + rest * (c3 + rest * (c4 + ior * (c5 + c6 * ior) + t1 * (c7 + c8 * t1)));
    return root * root;
}
