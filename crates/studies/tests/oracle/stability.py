"""Truths of the study of stability, in 60 digits (loss 30, sum f64, albedo 5): writes stability.json beside itself.

Needs mpmath (pip install mpmath). Run: python3 stability.py

A case has rows for f64 and rows for f32. A row is the distance from the limit, the inputs as numbers
of that precision (exactly, in the shortest decimals that read back as them) and the truth at exactly
these inputs. Rows whose inputs are the limit itself in that precision are left out. Every formula here
is the definition; digits, not forms, keep it from cancelling.
"""
import json
import pathlib
import struct
from math import fsum

from mpmath import atan, cos, log, mp, mpf, nstr, pi, quad, sin, sqrt, tan

mp.dps = 60
HERE = pathlib.Path(__file__).parent


def f32(x):
    return struct.unpack("f", struct.pack("f", float(x)))[0]


def f64(x):
    return float(x)


def decades(first, last, per):
    """Distances 10^first, ... 10^-last, with the digits of an irrational number, so that none is a short binary fraction."""
    n = (first + last) * per
    return [mpf(10) ** (first - mpf(i) / per) * (1 if i else mpf("0.9876543")) for i in range(n + 1)]


def case(name, inputs, distances, at, truth, precisions=("f64", "f32"), keep=lambda x: True):
    """`at` gives the inputs of a distance; `truth` takes them rounded."""
    rows = {}
    for precision, rounded in (("f64", f64), ("f32", f32)):
        rows[precision] = []
        for t in distances if precision in precisions else []:
            x = [rounded(v) for v in at(t)]
            if keep([mpf(v) for v in x]):
                rows[precision].append([float(nstr(t, 4))] + x + [float(nstr(truth(*map(mpf, x)), 17))])
    return {"name": name, "inputs": inputs, **rows}


def peak(alpha, x, z):
    """D of GGX for the direction (x, 0, z), whose length need not be 1: tan = x/z."""
    tan2 = (x / z) ** 2
    cos4 = 1 / (1 + tan2) ** 2
    return 1 / (pi * alpha**2 * cos4 * (1 + tan2 / alpha**2) ** 2)


def smith(alpha, mu):
    return (sqrt(1 + alpha**2 * (1 - mu**2) / mu**2) - 1) / 2


def loss(alpha):
    """1 - E at normal incidence: normals by t = tan^2, D cos d omega = alpha^2/(alpha^2 + t)^2 dt; light at twice the angle."""
    def weight(t):
        return alpha**2 / (alpha**2 + t) ** 2

    def lambda_light(t):
        tan2 = 4 * t / (1 - t) ** 2
        return (sqrt(1 + alpha**2 * tan2) - 1) / 2

    def lost(t):
        light = lambda_light(t)
        return weight(t) * light / (1 + light)

    # t = e^s over the decades, the horizon t = 1 by tanh-sinh.
    cuts = [mpf(0)] + [alpha**2 * mpf(10) ** k for k in range(-2, 40) if alpha**2 * mpf(10) ** k < mpf(1) / 2] + [mpf(1) / 2, mpf(1)]
    mp.dps = 30
    # Relative to weights as small as alpha^2, E + loss = 1 needs the digits of 30.
    value = sum(quad(lost, [a, b]) for a, b in zip(cuts, cuts[1:])) + alpha**2 / (alpha**2 + 1)
    mp.dps = 60
    return value


def visibility(alpha, v, l):
    return 1 / (1 + smith(alpha, v) + smith(alpha, l)) / (4 * v * l)


def fresnel(ior, c):
    """From outside (ior > 1) or, with the index of the far side over this one's, from inside."""
    c_t = sqrt(1 - (1 - c**2) / ior**2)
    s = (c - ior * c_t) / (c + ior * c_t)
    p = (ior * c - c_t) / (ior * c + c_t)
    return (s**2 + p**2) / 2


def leaves(ior, c):
    return 1 - fresnel(1 / ior, c)


def stretched(ax, ay, x, y, z):
    """Lambda of an anisotropic lobe."""
    return (sqrt(1 + ((ax * x) ** 2 + (ay * y) ** 2) / z**2) - 1) / 2


def albedo(alpha, mu):
    """E by visible normals: the mean of G2/G1 over the spherical cap (Dupuy and Benyoub 2023), lights below the horizon 0."""
    mp.dps = 15
    length = sqrt(alpha**2 * (1 - mu**2) + mu**2)
    sx, sz = alpha * sqrt(1 - mu**2) / length, mu / length
    of_view = smith(alpha, mu)

    def kept(z, phi):
        r = sqrt(1 - z**2)
        n = [alpha * (r * cos(phi) + sx), alpha * r * sin(phi), z + sz]
        norm2 = n[0] ** 2 + n[1] ** 2 + n[2] ** 2
        n_v = n[0] * sqrt(1 - mu**2) + n[2] * mu
        light = 2 * n_v * n[2] / norm2 - mu
        return 0 if light <= 0 else (1 + of_view) / (1 + of_view + smith(alpha, light))

    def ring(z):
        # The light's height falls or rises once between 0 and pi: the horizon by bisection.
        low, high = mpf(0), pi
        up = [kept(z, low) > 0, kept(z, high) > 0]
        if up[0] == up[1]:
            return gauss(lambda p: kept(z, p), low, high) if up[0] else mpf(0)
        a, b = low, high
        for _ in range(40):
            middle = (a + b) / 2
            a, b = (middle, b) if (kept(z, middle) > 0) == up[0] else (a, middle)
        return gauss(lambda p: kept(z, p), low, a) if up[0] else gauss(lambda p: kept(z, p), b, high)

    cuts = [-sz + (1 + sz) * sin(pi * k / 32) ** 2 for k in range(17)]
    value = sum(gauss(ring, a, b) for a, b in zip(cuts, cuts[1:])) / (pi * (1 + sz))
    mp.dps = 60
    return value


def gauss(f, a, b, rule=[]):
    """16 nodes: errors of 1e-5 and less, where half precision has three digits."""
    if not rule:
        from numpy.polynomial.legendre import leggauss
        rule.extend(zip(*leggauss(16)))
    return (b - a) / 2 * sum(float(w) * f((a + b) / 2 + (b - a) / 2 * mpf(float(x))) for x, w in rule)


def sums():
    """Sums of the first n weights (2^24 - k_i)/2^24/3, k_i the upper 22 bits of i 2654435769 mod 2^32, each rounded to f64."""
    rows, parts, start = [], [], 0
    for n in (int(mpf(10) ** (mpf(k) / 5)) for k in range(5, 36)):
        weights = ((2**24 - ((i * 2654435769 & 0xFFFFFFFF) >> 10)) / 2**24 / 3 for i in range(start, n))
        parts, start = parts + [fsum(weights)], n
        rows.append([float(nstr(1 / mpf(n), 4)), n, fsum(parts)])
    return {"name": "sum", "inputs": ["n"], "f64": [], "f32": rows}


def at_critical(t):
    return [mpf(3) / 2, sqrt(mpf(5)) / 3 + t]


def below_critical(t):
    return [mpf(3) / 2, sqrt(mpf(5)) / 3 - t]


def beyond(x):
    return x[0] ** 2 * (1 - x[1] ** 2) < 1


def total(ior, c):
    """All light is reflected, whatever the polarisation: no root has a value."""
    assert ior**2 * (1 - c**2) > 1
    return mpf(1)


def slanted(ratio):
    """phi where both axes count alike, tan(phi) = 1/ratio, at 60 degrees from the normal."""
    phi, theta = atan(1 / ratio), pi / 3
    return [mpf(1), ratio, sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)]


def main():
    half = decades(0, 3, 6)
    cases = [
        case("peak", ["alpha", "x", "z"], decades(0, 8, 3), lambda a: [a, sin(atan(a)), cos(atan(a))], peak),
        case("loss", ["e", "alpha"], decades(0, 6, 3), lambda a: [1 - loss(f64(a) * mpf(1)), a], lambda e, a: loss(a)),
        case("lambda", ["alpha", "mu"], decades(0, 9, 3), lambda a: [a, mpf("0.6")], smith),
        case("grazing", ["alpha", "mu_v", "mu_l"], decades(0, 12, 2), lambda m: [mpf("0.3"), m, mpf("0.5")], visibility),
        case("ior", ["ior", "c"], decades(0, 14, 2), lambda t: [1 + t, mpf("0.7")], fresnel, keep=lambda x: x[0] > 1),
        case("critical", ["ior", "c"], decades(-1, 7, 5), at_critical, leaves, keep=beyond),
        case("total", ["ior", "c"], decades(-1, 7, 5), below_critical, total, keep=lambda x: x[0] ** 2 * (1 - x[1] ** 2) > 1),
        case("anisotropy", ["ax", "ay", "x", "y", "z"], decades(0, 8, 3), slanted, stretched),
        sums(),
        case("half", ["roughness", "alpha", "mu"], half, lambda t: [sqrt(t), t, t], lambda r, a, m: 1 / albedo(a, m), precisions=("f32",)),
    ]
    for made in cases:
        print(made["name"], len(made["f64"]), len(made["f32"]))
    lines = []
    for made in cases:
        rows = {p: "[" + ",\n  ".join(json.dumps(r, separators=(",", ":")) for r in made[p]) + "]" for p in ("f64", "f32")}
        head = f'"name":{json.dumps(made["name"])},"inputs":{json.dumps(made["inputs"], separators=(",", ":"))}'
        lines.append("{" + head + f',\n "f64":{rows["f64"]},\n "f32":{rows["f32"]}' + "}")
    (HERE / "stability.json").write_text("[" + ",\n".join(lines) + "]\n")


if __name__ == "__main__":
    import sys
    if sys.argv[1:] == ["--check"]:
        print(nstr(loss(mpf("0.5")), 18), "0.312151484889763627", nstr(loss(mpf("1e-4")), 18), "1.00013358214006751e-8")
        print(nstr(albedo(mpf("0.1"), mpf("0.1")), 12), "0.8834550018671", nstr(albedo(mpf("0.3"), mpf("0.5")), 12), "0.8217110031508")
    else:
        main()
