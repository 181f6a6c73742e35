// The part of GLSL that emitted code uses, in C++14, so that it can be run where no GLSL runs. Literals have no suffix there:
// compile with -fsingle-precision-constant.
#pragma once
#include "vectors.hpp"

namespace glsl {

using namespace shim;

// Compilers may keep 32 bits.
#define mediump
#define highp

using uint = unsigned;
using vec2 = float2;
using vec3 = float3;
using vec4 = float4;

struct sampler2D : table {};
struct sampler3D : table {};

inline vec4 textureLod(const sampler2D &table, vec2 uv, float) { return table.sampled(uv); }
inline vec4 textureLod(const sampler3D &table, vec3 uvw, float) { return table.sampled(uvw); }
inline float sign(float x) { return x > 0.0f ? 1.0f : (x < 0.0f ? -1.0f : 0.0f); }
inline float inversesqrt(float x) { return rsqrt(x); }
inline float mix(float x, float y, float t) { return x * (1.0f - t) + y * t; }
inline vec2 inversesqrt(vec2 x) { return rsqrt(x); }
inline vec2 mix(vec2 x, vec2 y, vec2 t) { return vec2(mix(x.x, y.x, t.x), mix(x.y, y.y, t.y)); }

}  // namespace glsl

using namespace glsl;
