#!/usr/bin/env python3
"""Writes the DFG texture that Godot makes at start-up, as its formulas have it.

    python3 docs/audits/godot.py dfg.npy

128 x 128 texels of B and A + B by 1024 points of Hammersley's set, drawn from D of GGX with alpha = roughness^2, and
Schlick's G of k = alpha/2 (Karis 2013, "Real Shading in Unreal Engine 4"); rows of roughness (128 - y + 1/2)/128, columns of n_dot_v
(x + 1/2)/128. Computed in f64, rounded to half.
"""
import sys

import numpy as np

SIZE, SAMPLES = 128, 1024


def reversed_bits(i):
    """The bits of i after the binary point, the lowest first (van der Corput)."""
    return sum(((i >> k) & 1) / 2.0 ** (k + 1) for k in range(32))


def row(roughness, mu):
    """B and A + B of a roughness at cosines."""
    index = np.arange(SAMPLES, dtype=np.int64)
    phi, v = 2 * np.pi * index / SAMPLES, reversed_bits(index)
    alpha = roughness * roughness
    cosine = np.sqrt((1 - v) / (1 + (alpha * alpha - 1) * v))
    half = np.sqrt(1 - cosine * cosine) * np.sin(phi)
    mu = mu[:, None]
    d = half * np.sqrt(1 - mu * mu) + cosine * mu
    light = 2 * d * cosine - mu
    g = lambda c: c / (c * (1 - alpha / 2) + alpha / 2)
    vh = np.clip(d, 0, 1)
    weight = np.where(light > 0, g(mu) * g(np.clip(light, 1e-9, 1)) * vh / (cosine * mu), 0)
    return np.stack([((1 - vh) ** 5 * weight).mean(1), weight.mean(1)], -1)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    at = (np.arange(SIZE) + 0.5) / SIZE
    rows = [row((SIZE - y + 0.5) / SIZE, at) for y in range(SIZE)]
    np.save(sys.argv[1], np.array(rows).astype("f2"))
