// The page puts before this text: what is drawn (COMPENSATION, ALBEDO, BASE with SINGLE, NORMALISED or COMPENSATED, VALUE), the
// shadowing form (CORRELATED, SEPARABLE), ALPHA(roughness), the emitted functions, and
// `float approximation(float roughness, float alpha, float mu, float f0)`, which calls them.
const float PI = 3.14159265;
const float WHITE = 1.25; // radiance of white, so that gains show too

uniform highp usampler2D truth_texels;
uniform ivec2 truth_size;
uniform vec4 truth_domain; // roughness, mu: each from and to
uniform vec4 truth_range;  // E, B: values of 0 and 65535
uniform vec3 f0;
uniform int column;        // 0 the approximation, 1 the truth
uniform int picture;       // 0 a sphere, 1 its error, 2 the error over roughness and mu
uniform vec3 cell;         // left, bottom and side in pixels
uniform float rough;
uniform float limit;       // error of the deepest colours
uniform bool in_furnace;
uniform vec3 light;        // towards the light
uniform sampler2D ramp;

float alpha_of(float roughness) { return ALPHA(roughness); }

// The first of the four texels around a place, and the weights of a cubic through them.
int first_of(float place, int n) { return clamp(int(floor(place)) - 1, 0, n - 4); }
vec4 weights(float q) {
    float a = q - 1.0, b = q - 2.0, c = q - 3.0;
    return vec4(-a * b * c / 6.0, q * b * c / 2.0, -q * a * c / 2.0, q * a * b / 6.0);
}

// The two coordinates that share the columns: one resolves the layer mu ~ alpha, the other what lies beyond it.
vec2 coordinates(float mu, float alpha) { return vec2(sqrt(mu * (1.0 + alpha) / (mu + alpha)), sqrt(mu)); }

// E and B, or the column that is drawn.
vec2 truth(float roughness, float mu) {
    float alpha = alpha_of(roughness), extent = truth_domain.y - truth_domain.x;
    vec2 low = coordinates(truth_domain.z, alpha), high = coordinates(truth_domain.w, alpha);
    vec2 part = (coordinates(mu, alpha) - low) / (high - low);
    float along = extent > 0.0 ? sqrt(max(roughness - truth_domain.x, 0.0) / extent) : 0.0;
    vec2 place = vec2(0.5 * (part.x + part.y), along) * vec2(truth_size - 1);
    ivec2 first = ivec2(first_of(place.x, truth_size.x), first_of(place.y, truth_size.y));
    vec4 wx = weights(place.x - float(first.x)), wy = weights(place.y - float(first.y));
    vec2 sum = vec2(0.0);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) sum += wx[i] * wy[j] * vec2(texelFetch(truth_texels, first + ivec2(i, j), 0).xy);
    return mix(truth_range.xz, truth_range.yw, sum / 65535.0);
}

// What a value should be.
float ideal(vec2 eb, float f0) {
    float e = eb.x, b = eb.y, a = e - b, g = 1.0 - f0;
#if defined(COMPENSATION)
    return 1.0 / e;
#elif defined(ALBEDO)
    return f0 * e + g * b;
#elif defined(SINGLE)
    return 1.0 - e + g * a;
#elif defined(NORMALISED)
    return g * a / e;
#elif defined(COMPENSATED)
    return g * (a / e + (1.0 - e) * (1.0 - g * a / e));
#elif defined(VALUE)
    return e;
#endif
}

// The light that comes back in a white furnace.
float returned(float value, vec2 eb, float f0) {
#if defined(COMPENSATION)
    return (f0 * eb.x + (1.0 - f0) * eb.y) * (1.0 + f0 * (value - 1.0));
#elif defined(BASE)
    return 1.0 - ideal(eb, f0) + value;
#else
    return value;
#endif
}

float value_of(int column, float roughness, float mu, vec2 eb, float f0) {
    return column == 1 ? ideal(eb, f0) : approximation(roughness, alpha_of(roughness), mu, f0);
}

#ifdef MEASURE
// Four floats for each place of a grid over roughness and mu = low + (high - low) y^2: value, truth, error of the light, light.
uniform vec4 span; // roughness, y: each from and to
uniform vec2 places;
out uvec4 bits;
void main() {
    vec2 part = floor(gl_FragCoord.xy) / max(places - 1.0, 1.0);
    float roughness = mix(span.x, span.y, part.x), y = mix(span.z, span.w, part.y);
    float mu = mix(truth_domain.z, truth_domain.w, y * y);
    vec2 eb = truth(roughness, mu);
    float value = value_of(0, roughness, mu, eb, f0.x), should = ideal(eb, f0.x), shown = returned(value, eb, f0.x);
    bits = floatBitsToUint(vec4(value, should, shown - returned(should, eb, f0.x), shown));
}
#else
out vec4 colour;

vec3 three(int column, float roughness, float mu, vec2 eb, bool in_light) {
    vec3 found;
    for (int i = 0; i < 3; i++) {
        float value = value_of(column, roughness, mu, eb, f0[i]);
        found[i] = in_light ? returned(value, eb, f0[i]) : value;
    }
    return found;
}

vec3 displayed(vec3 x) {
    x = clamp(x, 0.0, 1.0);
    return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

// A sky that a rough lobe sees blurred.
vec3 sky(float up, float roughness) {
    float width = mix(0.05, 1.0, roughness);
    return mix(vec3(0.05, 0.045, 0.04), vec3(0.66, 0.7, 0.76), smoothstep(-width, width, up));
}

// The lobe of a round light of radiance one over a small angle, and the base below it.
vec3 lit(vec3 n, float roughness, float mu, vec2 eb, vec3 value) {
    float alpha = alpha_of(roughness), a2 = alpha * alpha, nl = max(dot(n, light), 0.0);
#ifdef BASE
    // the base sees the whole sky, and is shown half as bright for it is white
    vec3 back = sky(2.0 * n.z * n.y, roughness) * (1.0 - three(1, roughness, mu, eb, false)) + sky(n.y, 1.0) * value;
#else
    vec3 back = sky(2.0 * n.z * n.y, roughness) * three(column, roughness, mu, eb, true);
#endif
#if defined(COMPENSATION) || defined(BASE)
    vec3 h = normalize(light + vec3(0.0, 0.0, 1.0));
    float nh = dot(n, h), t = nh * nh * (a2 - 1.0) + 1.0, d = a2 / (PI * t * t);
    float lv = sqrt(a2 + (1.0 - a2) * mu * mu), ll = sqrt(a2 + (1.0 - a2) * nl * nl);
#ifdef CORRELATED
    float v = 0.5 / max(nl * lv + mu * ll, 1e-6);
#else
    float v = 1.0 / max((mu + lv) * (nl + ll), 1e-6);
#endif
    vec3 lobe = d * v * (f0 + (1.0 - f0) * pow(clamp(1.0 - h.z, 0.0, 1.0), 5.0));
#if defined(COMPENSATION)
    lobe *= 1.0 + f0 * (value - 1.0);
#elif defined(NORMALISED)
    lobe = lobe / eb.x + value / PI;
#elif defined(COMPENSATED)
    lobe = lobe * (1.0 + f0 * (1.0 / eb.x - 1.0)) + value / PI;
#else
    lobe += value / PI;
#endif
    back += lobe * nl * 1.3;
#endif
#ifdef BASE
    back *= 0.5;
#endif
    return back;
}

void main() {
    vec2 place = (gl_FragCoord.xy - cell.xy) / cell.z;
    if (picture == 2) {
        float roughness = mix(truth_domain.x, truth_domain.y, place.x);
        float mu = mix(truth_domain.z, truth_domain.w, place.y * place.y);
        vec2 eb = truth(roughness, mu);
        float value = value_of(0, roughness, mu, eb, f0.x);
        float off = returned(value, eb, f0.x) - returned(ideal(eb, f0.x), eb, f0.x);
        colour = vec4(texture(ramp, vec2(0.5 + 0.5 * clamp(off / limit, -1.0, 1.0), 0.5)).rgb, 1.0);
        if (abs(roughness - rough) * cell.z < (truth_domain.y - truth_domain.x)) colour.rgb *= 0.3;
        return;
    }
    vec2 at = (place - 0.5) / 0.44;
    float r = length(at), pixel = 1.0 / (0.44 * cell.z), covered = clamp((1.0 - r) / pixel + 0.5, 0.0, 1.0);
    float up = sqrt(max(1.0 - r * r, 0.0)), mu = clamp(up, truth_domain.z, truth_domain.w);
    vec2 eb = truth(rough, mu);
    if (picture == 1) {
        vec3 off = three(0, rough, mu, eb, true) - three(1, rough, mu, eb, true);
        vec3 size = abs(off);
        float worst = size.x >= max(size.y, size.z) ? off.x : size.y >= size.z ? off.y : off.z;
        vec3 tone = texture(ramp, vec2(0.5 + 0.5 * clamp(worst / limit, -1.0, 1.0), 0.5)).rgb;
        float rim = smoothstep(1.0 - 3.0 * pixel, 1.0 - 1.5 * pixel, r);
        colour = vec4(mix(tone, vec3(0.5), 0.6 * rim), 1.0) * covered;
    } else if (in_furnace) {
        vec3 back = three(column, rough, mu, eb, true);
        colour = vec4(displayed(mix(vec3(1.0), back, covered) / WHITE), 1.0);
    } else {
        vec3 n = vec3(at, up), behind = mix(vec3(0.03), vec3(0.12, 0.13, 0.15), place.y);
        vec3 back = lit(n, rough, mu, eb, three(column, rough, mu, eb, false));
        colour = vec4(displayed(mix(behind, back, covered)), 1.0);
    }
}
#endif
