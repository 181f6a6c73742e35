/// Published: Egan and Hilgeman 1973, as in Jensen et al. 2001: 1 - K of a smooth interface with
/// K = -1.4399/ior^2 + 0.7099/ior + 0.6681 + 0.0636 ior.
fn coat_escape_egan(ior: f32) -> f32 {
    let s = 1.0 / ior;
    return 0.3319 - 0.0636 * ior + s * (1.4399 * s - 0.7099);
}
