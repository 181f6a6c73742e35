// The page puts before this text, each word with LIVE_ before it: what is drawn (COMPENSATION, ALBEDO, BASE with SINGLE, NORMALISED or
// COMPENSATED, VALUE), the shadowing form (CORRELATED, SEPARABLE), ALPHA(roughness); then the emitted functions, and
// `float live_approximation(float roughness, float alpha, float mu, float f0)`, which calls them. Names that begin with live_ are free:
// no hypothesis has one.
const float live_PI = 3.14159265;
const float live_WHITE = 1.25; // radiance of white, so that gains show too

uniform highp usampler2D live_truth_texels;
uniform ivec2 live_truth_size;
uniform vec4 live_truth_domain; // roughness, mu: each from and to
uniform vec4 live_truth_range;  // E, B: values of 0 and 65535
uniform vec3 live_f0;
uniform int live_column;        // 0 the approximation, 1 the truth
uniform int live_picture;       // 0 a sphere, 1 its error, 2 the error over roughness and mu
uniform vec3 live_cell;         // left, bottom and side in pixels
uniform float live_rough;
uniform float live_limit;       // error of the deepest colours
uniform bool live_in_furnace;
uniform vec3 live_light;        // towards the light
uniform sampler2D live_ramp;

float live_alpha_of(float roughness) { return LIVE_ALPHA(roughness); }

// The first of the four texels around a place, and the weights of a cubic through them.
int live_first_of(float place, int n) { return clamp(int(floor(place)) - 1, 0, n - 4); }
vec4 live_weights(float q) {
    float a = q - 1.0, b = q - 2.0, c = q - 3.0;
    return vec4(-a * b * c / 6.0, q * b * c / 2.0, -q * a * c / 2.0, q * a * b / 6.0);
}

// The two coordinates that share the columns: one resolves the layer mu ~ alpha, the other what lies beyond it.
vec2 live_coordinates(float mu, float alpha) { return vec2(sqrt(mu * (1.0 + alpha) / (mu + alpha)), sqrt(mu)); }

// E and B, or the column that is drawn.
vec2 live_truth(float roughness, float mu) {
    float alpha = live_alpha_of(roughness), extent = live_truth_domain.y - live_truth_domain.x;
    vec2 low = live_coordinates(live_truth_domain.z, alpha), high = live_coordinates(live_truth_domain.w, alpha);
    vec2 part = (live_coordinates(mu, alpha) - low) / (high - low);
    float along = extent > 0.0 ? sqrt(max(roughness - live_truth_domain.x, 0.0) / extent) : 0.0;
    vec2 place = vec2(0.5 * (part.x + part.y), along) * vec2(live_truth_size - 1);
    ivec2 first = ivec2(live_first_of(place.x, live_truth_size.x), live_first_of(place.y, live_truth_size.y));
    vec4 wx = live_weights(place.x - float(first.x)), wy = live_weights(place.y - float(first.y));
    vec2 sum = vec2(0.0);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) sum += wx[i] * wy[j] * vec2(texelFetch(live_truth_texels, first + ivec2(i, j), 0).xy);
    return mix(live_truth_range.xz, live_truth_range.yw, sum / 65535.0);
}

// What a value should be.
float live_ideal(vec2 eb, float f0) {
    float e = eb.x, b = eb.y, a = e - b, g = 1.0 - f0;
#if defined(LIVE_COMPENSATION)
    return 1.0 / e;
#elif defined(LIVE_ALBEDO)
    return f0 * e + g * b;
#elif defined(LIVE_SINGLE)
    return 1.0 - e + g * a;
#elif defined(LIVE_NORMALISED)
    return g * a / e;
#elif defined(LIVE_COMPENSATED)
    return g * (a / e + (1.0 - e) * (1.0 - g * a / e));
#elif defined(LIVE_VALUE)
    return e;
#endif
}

// The light that comes back in a white furnace.
float live_returned(float value, vec2 eb, float f0) {
#if defined(LIVE_COMPENSATION)
    return (f0 * eb.x + (1.0 - f0) * eb.y) * (1.0 + f0 * (value - 1.0));
#elif defined(LIVE_BASE)
    return 1.0 - live_ideal(eb, f0) + value;
#else
    return value;
#endif
}

float live_value_of(int column, float roughness, float mu, vec2 eb, float f0) {
    return column == 1 ? live_ideal(eb, f0) : live_approximation(roughness, live_alpha_of(roughness), mu, f0);
}

#ifdef LIVE_MEASURE
// Four floats for each place of a grid over roughness and mu = low + (high - low) y^2: value, truth, error of the light, light.
uniform vec4 live_span; // roughness, y: each from and to
uniform vec2 live_places;
out uvec4 live_bits;
void main() {
    vec2 part = floor(gl_FragCoord.xy) / max(live_places - 1.0, 1.0);
    float roughness = mix(live_span.x, live_span.y, part.x), y = mix(live_span.z, live_span.w, part.y);
    float mu = mix(live_truth_domain.z, live_truth_domain.w, y * y);
    vec2 eb = live_truth(roughness, mu);
    float value = live_value_of(0, roughness, mu, eb, live_f0.x), should = live_ideal(eb, live_f0.x), shown = live_returned(value, eb, live_f0.x);
    live_bits = floatBitsToUint(vec4(value, should, shown - live_returned(should, eb, live_f0.x), shown));
}
#else
out vec4 live_colour;

vec3 live_three(int column, float roughness, float mu, vec2 eb, bool in_light) {
    vec3 found;
    for (int i = 0; i < 3; i++) {
        float value = live_value_of(column, roughness, mu, eb, live_f0[i]);
        found[i] = in_light ? live_returned(value, eb, live_f0[i]) : value;
    }
    return found;
}

vec3 live_displayed(vec3 x) {
    x = clamp(x, 0.0, 1.0);
    return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

// A sky that a rough lobe sees blurred.
vec3 live_sky(float up, float roughness) {
    float width = mix(0.05, 1.0, roughness);
    return mix(vec3(0.05, 0.045, 0.04), vec3(0.66, 0.7, 0.76), smoothstep(-width, width, up));
}

// The lobe of a round light of radiance one over a small angle, and the base below it.
vec3 live_lit(vec3 n, float roughness, float mu, vec2 eb, vec3 value) {
    float alpha = live_alpha_of(roughness), a2 = alpha * alpha, nl = max(dot(n, live_light), 0.0);
#ifdef LIVE_BASE
    // the base sees the whole sky, and is shown half as bright for it is white
    vec3 back = live_sky(2.0 * n.z * n.y, roughness) * (1.0 - live_three(1, roughness, mu, eb, false)) + live_sky(n.y, 1.0) * value;
#else
    vec3 back = live_sky(2.0 * n.z * n.y, roughness) * live_three(live_column, roughness, mu, eb, true);
#endif
#if defined(LIVE_COMPENSATION) || defined(LIVE_BASE)
    vec3 h = normalize(live_light + vec3(0.0, 0.0, 1.0));
    float nh = dot(n, h), t = nh * nh * (a2 - 1.0) + 1.0, d = a2 / (live_PI * t * t);
    float lv = sqrt(a2 + (1.0 - a2) * mu * mu), ll = sqrt(a2 + (1.0 - a2) * nl * nl);
#ifdef LIVE_CORRELATED
    float v = 0.5 / max(nl * lv + mu * ll, 1e-6);
#else
    float v = 1.0 / max((mu + lv) * (nl + ll), 1e-6);
#endif
    vec3 lobe = d * v * (live_f0 + (1.0 - live_f0) * pow(clamp(1.0 - h.z, 0.0, 1.0), 5.0));
#if defined(LIVE_COMPENSATION)
    lobe *= 1.0 + live_f0 * (value - 1.0);
#elif defined(LIVE_NORMALISED)
    lobe = lobe / eb.x + value / live_PI;
#elif defined(LIVE_COMPENSATED)
    lobe = lobe * (1.0 + live_f0 * (1.0 / eb.x - 1.0)) + value / live_PI;
#else
    lobe += value / live_PI;
#endif
    back += lobe * nl * 1.3;
#endif
#ifdef LIVE_BASE
    back *= 0.5;
#endif
    return back;
}

void main() {
    vec2 place = (gl_FragCoord.xy - live_cell.xy) / live_cell.z;
    if (live_picture == 2) {
        float roughness = mix(live_truth_domain.x, live_truth_domain.y, place.x);
        float mu = mix(live_truth_domain.z, live_truth_domain.w, place.y * place.y);
        vec2 eb = live_truth(roughness, mu);
        float value = live_value_of(0, roughness, mu, eb, live_f0.x);
        float off = live_returned(value, eb, live_f0.x) - live_returned(live_ideal(eb, live_f0.x), eb, live_f0.x);
        live_colour = vec4(texture(live_ramp, vec2(0.5 + 0.5 * clamp(off / live_limit, -1.0, 1.0), 0.5)).rgb, 1.0);
        if (abs(roughness - live_rough) * live_cell.z < (live_truth_domain.y - live_truth_domain.x)) live_colour.rgb *= 0.3;
        return;
    }
    vec2 at = (place - 0.5) / 0.44;
    float r = length(at), pixel = 1.0 / (0.44 * live_cell.z), covered = clamp((1.0 - r) / pixel + 0.5, 0.0, 1.0);
    float up = sqrt(max(1.0 - r * r, 0.0)), mu = clamp(up, live_truth_domain.z, live_truth_domain.w);
    vec2 eb = live_truth(live_rough, mu);
    if (live_picture == 1) {
        vec3 off = live_three(0, live_rough, mu, eb, true) - live_three(1, live_rough, mu, eb, true);
        vec3 size = abs(off);
        float worst = size.x >= max(size.y, size.z) ? off.x : size.y >= size.z ? off.y : off.z;
        vec3 tone = texture(live_ramp, vec2(0.5 + 0.5 * clamp(worst / live_limit, -1.0, 1.0), 0.5)).rgb;
        float rim = smoothstep(1.0 - 3.0 * pixel, 1.0 - 1.5 * pixel, r);
        live_colour = vec4(mix(tone, vec3(0.5), 0.6 * rim), 1.0) * covered;
    } else if (live_in_furnace) {
        vec3 back = live_three(live_column, live_rough, mu, eb, true);
        live_colour = vec4(live_displayed(mix(vec3(1.0), back, covered) / live_WHITE), 1.0);
    } else {
        vec3 n = vec3(at, up), behind = mix(vec3(0.03), vec3(0.12, 0.13, 0.15), place.y);
        vec3 back = live_lit(n, live_rough, mu, eb, live_three(live_column, live_rough, mu, eb, false));
        live_colour = vec4(live_displayed(mix(behind, back, covered)), 1.0);
    }
}
#endif
