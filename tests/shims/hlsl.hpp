// The part of HLSL that emitted code uses, in C++14, so that it can be run where no HLSL runs.
#pragma once
#include "vectors.hpp"

namespace hlsl {

using namespace shim;

// As compilers may that keep 32 bits. Literals have no suffix then: compile with -fsingle-precision-constant.
using min16float = float;
using min16float2 = float2;
using min16float3 = float3;
using min16float4 = float4;

using uint = unsigned;
inline uint countbits(uint x) { return static_cast<uint>(__builtin_popcount(x)); }

struct SamplerState {};

template <typename T> struct Texture2D : table {
    float4 SampleLevel(SamplerState, float2 uv, float) const { return sampled(uv); }
};

template <typename T> struct Texture3D : table {
    float4 SampleLevel(SamplerState, float3 uvw, float) const { return sampled(uvw); }
};

// An integer, and x + t (y - x), as HLSL has them.
inline int sign(float x) { return (x > 0.0f) - (x < 0.0f); }
inline float lerp(float x, float y, float t) { return x + (y - x) * t; }
inline float mad(float x, float y, float z) { return std::fma(x, y, z); }
inline float2 mad(float2 x, float2 y, float2 z) { return fma(x, y, z); }

}  // namespace hlsl

using namespace hlsl;
