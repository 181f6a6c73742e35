"""The second integration: energies of lobes at a point, in numpy and by other methods than the program's.

GGX, Beckmann and glass: means over samples of half vectors, some shifts of one lattice, whose scatter is the standard
error. Charlie: products of Gauss nodes over directions of light, by two rules, whose difference is the error.
"""
from functools import lru_cache
from math import erf

import numpy as np

ERF = np.vectorize(erf, otypes=[float])
SHIFTS, SAMPLES = 16, 1 << 13
NODES, AVERAGED = (240, 180), 32


@lru_cache
def gauss(n):
    """Gauss nodes in [0, 1] and their weights."""
    x, w = np.polynomial.legendre.leggauss(n)
    return 0.5 * (x + 1), 0.5 * w


@lru_cache
def uniform(count, seed=0):
    """SHIFTS shifts of the first points of the plane's lattice of generalised golden ratios (Roberts 2018)."""
    steps = 1.32471795724474602596 ** -np.array([1.0, 2.0])
    shifts = np.random.default_rng([seed, count]).random((SHIFTS, 1, 2))
    return ((shifts + np.arange(count)[:, None] * steps) % 1).transpose(2, 0, 1)


def lam(alpha, cosine):
    """Smith's Lambda of GGX (Heitz 2014, eq. 72), without the difference of near numbers."""
    x = alpha * alpha * (1 - cosine) * (1 + cosine) / (cosine * cosine)
    return 0.5 * x / (1 + np.sqrt(1 + x))


def visible_normals(alpha, mu, u, v):
    """Half vectors of GGX as the view sees them (Heitz 2018), the view at (sqrt(1 - mu^2), 0, mu)."""
    x, z = alpha * np.sqrt((1 - mu) * (1 + mu)), mu
    length = np.sqrt(x * x + z * z)
    x, z = x / length, z / length
    radius, angle, share = np.sqrt(u), 2 * np.pi * v, 0.5 * (1 + z)
    across, up = radius * np.cos(angle), radius * np.sin(angle)
    up = (1 - share) * np.sqrt(np.maximum(0, 1 - across * across)) + share * up
    out = np.sqrt(np.maximum(0, 1 - across * across - up * up))
    hx, hy, hz = alpha * (out * x - up * z), alpha * across, np.maximum(0, out * z + up * x)
    norm = np.sqrt(hx * hx + hy * hy + hz * hz)
    return hx / norm, hz / norm


def schlick_smith(word, alpha):
    """k of the approximation of Smith's G1, c/(c (1 - k) + k)."""
    return {"alpha/2": alpha / 2, "(roughness + 1)^2/8": (np.sqrt(alpha) + 1) ** 2 / 8, "alpha": alpha}[word]


def masking(lobe, alpha, mu, light):
    """G2 over G1 of the view: what a sample of the visible normals weighs."""
    if "k = " in lobe:
        k = schlick_smith(lobe.split("k = ")[1].split(" (Karis")[0], alpha)
        g1 = lambda c: c / (c * (1 - k) + k)
        return g1(mu) * g1(light) * (1 + lam(alpha, mu))
    if "separable" in lobe:
        return 1 / (1 + lam(alpha, light))
    own = lam(alpha, mu)
    return (1 + own) / (1 + own + lam(alpha, light))


def beckmann_lambda(alpha, cosine):
    """Smith's Lambda of Beckmann with the exact error function (Heitz 2014, eq. 69)."""
    a = cosine / (alpha * np.sqrt(np.maximum((1 - cosine) * (1 + cosine), 1e-300)))
    near = np.minimum(a, 6)
    exact = 0.5 * (ERF(near) - 1) + np.exp(-near * near) / (2 * near * np.sqrt(np.pi))
    return np.where(a < 6, exact, 0)


def halves(lobe, alpha, mu, u, v):
    """Half vectors, their cosines with the view, and what they weigh with lights of some cosine."""
    side = np.sqrt((1 - mu) * (1 + mu))
    if "Beckmann" not in lobe:
        hx, hz = visible_normals(alpha, mu, u, v)
        return hz, hx * side + hz * mu, lambda light: masking(lobe, alpha, mu, light)
    # Samples of D cos (Walter et al. 2007).
    tangent = alpha * np.sqrt(-np.log1p(-u))
    hz = 1 / np.sqrt(1 + tangent * tangent)
    toward = hz * tangent * np.cos(2 * np.pi * v) * side + hz * mu
    view, seen = beckmann_lambda(alpha, np.float64(mu)), np.maximum(toward, 0) / (mu * hz)
    if "correlated" in lobe:
        return hz, toward, lambda light: seen / (1 + view + beckmann_lambda(alpha, light))
    return hz, toward, lambda light: seen / ((1 + view) * (1 + beckmann_lambda(alpha, light)))


def weighed(weigh, on, light):
    """The weights of lights that are on the right side."""
    return np.where(on, weigh(np.where(on, light, 1)), 0)


def reflection(lobe, alpha, mu, u, v):
    """E and B."""
    hz, toward, weigh = halves(lobe, alpha, mu, u, v)
    light = 2 * toward * hz - mu
    weight = weighed(weigh, light > 0, light)
    return weight, weight * (1 - np.clip(toward, 0, 1)) ** 5


def fresnel(eta, cosine):
    """Unpolarised reflectance of a dielectric; eta is the index beyond over the index before."""
    square = eta * eta - 1 + cosine * cosine
    g = np.sqrt(np.maximum(square, 0))
    first = ((g - cosine) / (g + cosine)) ** 2
    second = ((cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1)) ** 2
    return np.where(square < 0, 1, 0.5 * first * (1 + second))


def glass(lobe, ior, alpha, mu, u, v):
    """R and T; a light that leaves on the wrong side counts 0."""
    eta = ior if "outside" in lobe else 1 / ior
    hz, toward, weigh = halves(lobe, alpha, mu, u, v)
    toward = np.clip(toward, 1e-12, 1)
    share = fresnel(eta, toward)
    inner = 1 - (1 - toward * toward) / eta**2
    up = 2 * toward * hz - mu
    down = mu / eta - (toward / eta - np.sqrt(np.maximum(inner, 0))) * hz
    return share * weighed(weigh, up > 0, up), (1 - share) * weighed(weigh, (inner > 0) & (down > 0), down)


def sampled(quantity, lobe, at, more):
    """First and second base value of every shift; without a cosine the cosine-weighted averages."""
    alpha = max(at["alpha"], 1e-8)
    if "mu" in at:
        return lit(quantity, lobe, at, (alpha, max(at["mu"], 1e-9), *uniform(SAMPLES * more)))
    # Gauss nodes in the root of the cosine, each with shifts of its own.
    x, w = gauss(AVERAGED)
    mus, weights = x**2, 4 * w * x**3
    own = lambda k, mu: lit(quantity, lobe, at, (alpha, mu, *uniform(SAMPLES * more // 8, k)))
    return sum(weight * own(k, mu) for k, (mu, weight) in enumerate(zip(mus, weights)))


def lit(quantity, lobe, at, rest):
    """First and second base value of every shift, at one cosine."""
    lobe = "Beckmann, " * quantity.startswith("beckmann") + lobe
    if quantity.endswith("-glass"):
        ior, side = at["ior"], lobe
        if "rays from" not in lobe:
            ior, side = (ior, "outside, " + lobe) if ior >= 1 else (1 / ior, "inside, " + lobe)
        both = glass(side, ior, *rest)
    else:
        both = reflection(lobe, *rest)
    return np.stack([part.mean(axis=1) for part in both], axis=1)


def shadow(alpha, cosine):
    """Lambda of Estevez and Kulla (2017, sec. 3 and table 1)."""
    mix = (1 - alpha) ** 2
    smooth = np.array([25.3245, 3.32435, 0.16801, -1.27393, -4.85967])
    rough = np.array([21.5473, 3.82987, 0.19823, -1.97760, -4.32054])
    a, b, c, d, e = mix * smooth + (1 - mix) * rough
    fit = lambda x: a / (1 + b * x**c) + d * x + e
    mirrored = np.maximum(1 - cosine, 0)
    return np.exp(np.where(cosine < 0.5, fit(np.minimum(cosine, 0.5)), 2 * fit(0.5) - fit(mirrored)))


def charlie(lobe, alpha, mu, nodes):
    """E of the sheen lobe over cosine and azimuth of the light, nodes crowded at the horizon and behind."""
    x, w = gauss(nodes)
    cosine, turn = (x**3)[:, None], (np.pi * x**3)[None, :]
    weights = 2 * np.pi * (3 * x * x * w)[:, None] * (3 * x * x * w)[None, :]
    # The azimuth is counted from the side opposite to the view.
    along = mu * cosine - np.cos(turn) * np.sqrt((1 - mu) * (1 + mu) * (1 - cosine) * (1 + cosine))
    half = (mu + cosine) ** 2 / np.maximum(2 + 2 * along, 1e-300)
    density = (2 + 1 / alpha) * np.exp(0.5 / alpha * np.log(np.maximum(1 - half, 1e-300))) / (2 * np.pi)
    if "Neubelt" in lobe:
        visibility = cosine / (4 * (cosine + mu - cosine * mu))
    else:
        visibility = 1 / (4 * mu * (1 + shadow(alpha, np.float64(mu)) + shadow(alpha, cosine)))
    return (weights * density * visibility).sum()


def base(quantity, lobe, at, more=1):
    """Base values, an independent estimate a row: E and B, R and T, or E alone."""
    if quantity != "sheen-charlie":
        return sampled(quantity, lobe, at, more)
    grown = [int(n * more**0.25) for n in NODES]
    return np.array([[charlie(lobe, at["alpha"], max(at["mu"], 1e-9), n), 0.0] for n in grown])


def column(holds, quantity, at, values):
    """What a channel holds, of base values."""
    first, second = values.T
    word = holds.split(" (")[0].replace("_avg", "")
    total = first + second if quantity.endswith("-glass") else first
    simple = {"E": total, "1-E": 1 - total, "1/E": 1 / total, "1/E-1": 1 / total - 1}
    if word in simple:
        return simple[word]
    if word.startswith("f0="):
        return second + float(word[3:]) * (first - second)
    return {
        "A": first - second, "B": second, "B/E": second / first,
        "R": first, "T": second, "1-R": 1 - first, "R/E": first / total,
    }[word]  # fmt: skip


def truth(quantity, lobe, at, holds, more=1):
    """The value and its standard error, of samples with what none of them may have met."""
    estimates = column(holds, quantity, at, base(quantity, lobe, at, more))
    unseen = 0 if quantity == "sheen-charlie" else 1 / (SHIFTS * SAMPLES * more)
    return estimates.mean(), estimates.std(ddof=1) / np.sqrt(len(estimates)) + unseen
