/// What a base below a coat keeps of its light, per colour channel: multiply the base's by it and add the coat's lobe. albedo is that
/// of the whole base (of a lobe above a diffuse base k albedo + 1 - k, k what the coupling gives), e_v the albedo of the coat's lobe
/// from the view, `escape` what `coat_escape` gives. A white base keeps 1 - e_v, whatever `escape` is: nothing is lost. With e_v = 0 it is the darkening alone. Of the view alone: not reciprocal.
fn coat_base_scale(albedo: vec3f, e_v: f32, escape: f32) -> vec3f {
    return vec3f((1.0 - e_v) * escape) / (1.0 - albedo * (1.0 - escape));
}

/// The lobe of a diffuse base below a coat, 1/sr per colour channel, in place of albedo/pi: reciprocal. e_v and e_l are the albedo
/// of the coat's lobe from the view and from the light. Coat and white base send back 1 as far as `escape` is (1 - E_avg)/ior^2 of
/// the same albedo.
fn coat_diffuse(albedo: vec3f, ior: f32, e_v: f32, e_l: f32, escape: f32) -> vec3f {
    let white = 0.31830989 * (1.0 - e_v) * (1.0 - e_l) / (ior * ior);
    return albedo * white / (1.0 - albedo * (1.0 - escape));
}
