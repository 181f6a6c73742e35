/// What a layer below a sheen keeps, as KHR_materials_sheen scales it: multiply the layer by it and add the sheen. e_v and e_l are
/// `sheen_albedo` of the view and of the light. In [0, 1]: at grazing E exceeds 1, and a formula of E may be negative by its error.
/// Reciprocal, and for that not white in a furnace: the larger E takes more from the layer than the sheen sends back.
fn sheen_base_scale(sheen_color: vec3f, e_v: f32, e_l: f32) -> f32 {
    let most = max(sheen_color.x, max(sheen_color.y, sheen_color.z));
    return saturate(1.0 - most * max(e_v, e_l));
}
