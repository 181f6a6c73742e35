// What the shims of the shader languages share: short vectors with the swizzles that emitted code uses, and a table that
// is sampled as the Rust lookups sample theirs.
#pragma once
#include <cmath>
#include <cstddef>

// Macros of C that the shader languages do not have.
#undef NAN
#undef INFINITY

namespace shim {

struct float2 {
    float x, y;
    // A number beside a vector is each of its components.
    float2(float s) : x(s), y(s) {}
    float2(float x, float y) : x(x), y(y) {}
};

struct float3 {
    union {
        struct { float x, y, z; };
        float2 xy;
    };
    float3() {}
    explicit float3(float s) : x(s), y(s), z(s) {}
    float3(float x, float y, float z) : x(x), y(y), z(z) {}
};

struct float4 {
    union {
        struct { float x, y, z, w; };
        float2 xy;
        float3 xyz;
    };
    float4() {}
    float4(float x, float y, float z, float w) : x(x), y(y), z(z), w(w) {}
};

inline float3 operator+(float a, float3 b) { return float3(a + b.x, a + b.y, a + b.z); }
inline float3 operator+(float3 a, float3 b) { return float3(a.x + b.x, a.y + b.y, a.z + b.z); }
inline float3 operator-(float3 a, float3 b) { return float3(a.x - b.x, a.y - b.y, a.z - b.z); }
inline float3 operator*(float a, float3 b) { return float3(a * b.x, a * b.y, a * b.z); }
inline float3 operator*(float3 a, float b) { return float3(a.x * b, a.y * b, a.z * b); }
inline float3 operator*(float3 a, float3 b) { return float3(a.x * b.x, a.y * b.y, a.z * b.z); }
inline float3 operator/(float3 a, float b) { return float3(a.x / b, a.y / b, a.z / b); }

inline float4 operator+(float4 a, float4 b) { return float4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w); }
inline float4 operator*(float4 a, float b) { return float4(a.x * b, a.y * b, a.z * b, a.w * b); }

inline float dot(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float abs(float x) { return std::fabs(x); }
inline float min(float x, float y) { return y < x ? y : x; }
inline float max(float x, float y) { return x < y ? y : x; }
inline float clamp(float x, float lo, float hi) { return min(max(x, lo), hi); }
inline float saturate(float x) { return clamp(x, 0.0f, 1.0f); }
inline float sqrt(float x) { return std::sqrt(x); }
inline float rsqrt(float x) { return 1.0f / std::sqrt(x); }
inline float exp(float x) { return std::exp(x); }
inline float exp2(float x) { return std::exp2(x); }
inline float log(float x) { return std::log(x); }
inline float log2(float x) { return std::log2(x); }
inline float pow(float x, float y) { return std::pow(x, y); }
inline float floor(float x) { return std::floor(x); }
inline float sin(float x) { return std::sin(x); }
inline float cos(float x) { return std::cos(x); }
inline float fma(float x, float y, float z) { return std::fma(x, y, z); }
inline float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
inline float smoothstep(float lo, float hi, float x) {
    const float t = clamp((x - lo) / (hi - lo), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// Two evaluations at once.
#define PAIRED(name) inline float2 name(float2 a) { return float2(name(a.x), name(a.y)); }
#define PAIRED_OF_TWO(name) inline float2 name(float2 a, float2 b) { return float2(name(a.x, b.x), name(a.y, b.y)); }
#define PAIRED_OPERATOR(sign) \
    inline float2 operator sign(float2 a, float2 b) { return float2(a.x sign b.x, a.y sign b.y); }
PAIRED(abs) PAIRED(saturate) PAIRED(sqrt) PAIRED(rsqrt) PAIRED(exp) PAIRED(exp2) PAIRED(log) PAIRED(log2)
PAIRED(floor) PAIRED(sin) PAIRED(cos)
PAIRED_OF_TWO(min) PAIRED_OF_TWO(max) PAIRED_OF_TWO(pow)
PAIRED_OPERATOR(+) PAIRED_OPERATOR(-) PAIRED_OPERATOR(*) PAIRED_OPERATOR(/)
inline float2 operator-(float2 a) { return float2(-a.x, -a.y); }
inline float2 clamp(float2 x, float2 lo, float2 hi) { return min(max(x, lo), hi); }
inline float2 fma(float2 x, float2 y, float2 z) { return float2(fma(x.x, y.x, z.x), fma(x.y, y.y, z.y)); }

// Texels with columns fastest and slices slowest; channels that a table lacks are zero, and the last is one.
struct table {
    const float *texels;
    int channels;
    int size[3];

    float channel(int c, const int at[3]) const {
        if (c >= channels) return c == 3 ? 1.0f : 0.0f;
        return texels[((at[2] * size[1] + at[1]) * size[0] + at[0]) * channels + c];
    }

    float blended(int c, int axis, const float position[3], int at[3]) const {
        if (axis < 0) return channel(c, at);
        const float clamped = min(max(position[axis], 0.0f), static_cast<float>(size[axis] - 1));
        int base = static_cast<int>(clamped);
        if (base > size[axis] - 1) base = size[axis] - 1;
        const float fraction = clamped - static_cast<float>(base);
        at[axis] = base;
        const float near = blended(c, axis - 1, position, at);
        at[axis] = fraction > 0.0f ? base + 1 : base;
        const float far = blended(c, axis - 1, position, at);
        return near + (far - near) * fraction;
    }

    float4 sampled(float u, float v, float w) const {
        const float position[3] = {
            u * static_cast<float>(size[0]) - 0.5f,
            v * static_cast<float>(size[1]) - 0.5f,
            w * static_cast<float>(size[2]) - 0.5f,
        };
        int at[3] = {0, 0, 0};
        float value[4];
        for (int c = 0; c < 4; ++c) value[c] = blended(c, 2, position, at);
        return float4(value[0], value[1], value[2], value[3]);
    }

    float4 sampled(float2 uv) const { return sampled(uv.x, uv.y, 0.5f / static_cast<float>(size[2])); }
    float4 sampled(float3 uvw) const { return sampled(uvw.x, uvw.y, uvw.z); }
};

template <typename T>
T table_of(const float *texels, int channels, int columns, int rows, int slices) {
    T made;
    made.texels = texels;
    made.channels = channels;
    made.size[0] = columns;
    made.size[1] = rows;
    made.size[2] = slices;
    return made;
}

}  // namespace shim
