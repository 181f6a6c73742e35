/// The mean of a metal's Fresnel factor over the hemisphere by Schlick's term, 2 int F(mu) mu dmu, per colour channel.
fn fresnel_average_schlick(f0: vec3f) -> vec3f {
    return f0 + (1.0 - f0) / 21.0;
}

/// The same of Schlick's term with a tint at 82 degrees, less b mu (1 - mu)^6 such that F(1/7) is f82 times
/// Schlick's: its mean is b/126 less (Kutz, Hasan, Edmondson, "Novel aspects of the Adobe Standard Material", 2021).
fn fresnel_average_f82(f0: vec3f, f82: vec3f) -> vec3f {
    let schlick = f0 + (1.0 - f0) * 0.46266436;
    return f0 + (1.0 - f0) / 21.0 - schlick * (1.0 - f82) * (17.651384 / 126.0);
}

/// Fresnel's factor of a metal with the index eta + i k, relative to what lies outside, for light without polarisation.
fn fresnel_conductor(eta: f32, k: f32, cosine: f32) -> f32 {
    let square = cosine * cosine;
    let rest = 1.0 - square;
    let real = eta * eta - k * k - rest;
    let imaginary = 2.0 * eta * k;
    let length = sqrt(real * real + imaginary * imaginary);
    let across = 2.0 * sqrt(max(0.5 * (length + real), 0.0)) * cosine;
    let s = (length + square - across) / (length + square + across);
    let along = length * square + rest * rest;
    return 0.5 * s * (1.0 + (along - across * rest) / (along + across * rest));
}

/// The mean of this factor over the hemisphere of one channel, by the rule of three cosines that is exact for
/// polynomials of degree 5: within 0.0018 where k is at least 1.
fn fresnel_average_conductor(eta: f32, k: f32) -> f32 {
    let ends = 0.13965396 * fresnel_conductor(eta, k, 0.21234054) + 0.40186383 * fresnel_conductor(eta, k, 0.91141204);
    return ends + 0.45848221 * fresnel_conductor(eta, k, 0.59053314);
}

/// The lobe of light that leaves after more than one bounce between facets, 1/sr per colour channel: add it to
/// the lobe f_ss, in place of a factor on it. f_avg is the mean of the Fresnel factor; e_v and e_l are E of the
/// view and of the light, by a table of E (where little is lost, 1/N is not near enough); e_avg is their mean.
/// Energy: lobe and f_ss with F = 1 send back E + (1 - E) = 1, as far as e_l has the mean e_avg; each bounce from
/// the second on is tinted once more. Reciprocal. It fades where less than 2e-4 is lost in the mean, so that
/// errors of 5e-4 of both E are less than 0.002 of the energy there.
/// Kulla and Conty, "Revisiting physically based shading at Imageworks", 2017.
fn ggx_multiscatter_lobe(f_avg: vec3f, e_v: f32, e_l: f32, e_avg: f32) -> vec3f {
    let lost = 1.0 - e_avg;
    let shape = 0.31830989 * (1.0 - e_v) * (1.0 - e_l) / max(lost, 2e-4);
    return f_avg * f_avg * (shape * e_avg) / (1.0 - f_avg * lost);
}
