#!/usr/bin/env python3
"""Checks the audits of zoo.json by a second integration and writes docs/audits/recomputed.json.

    python3 docs/audits/recompute.py FOLDER [ARTEFACT ...]

FOLDER is that of make.py, whose audits are used again. With artefacts, the others keep what was found of them. Of each
channel `lobefit audit --points` draws 200 texels of those that it judges. Here the value of each is read from the file
again (of tables by decode.py, of shader functions by functions.py), its coordinates follow from the convention that the
audit states, and the truth comes from lobes.py, which shares neither method nor code with the program. A channel agrees
where

- no truth differs from that of the audit by more than four standard errors, also at the texel that the audit calls worst;
- no error exceeds the largest that the audit states by more;
- the RMS lies within what a sample of as many texels leaves.

A truth that differs is integrated again, with sixteen times the samples.

Takes numpy; OpenEXR for the files in EXR, zstandard for those of KTX 2.
"""
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import json
import multiprocessing
import sys
import time

import numpy as np

import decode
import functions
import lobes
import make

# A lobe of its own scatter misses four standard errors of sixteen shifts once in a thousand times.
SIGMAS, AGAIN = 4, 16

index = lambda root: (1 + root) / (1 - root) if root < 1 else np.inf
SCALES = {
    "alpha": ("alpha", lambda x: x),
    "roughness": ("alpha", lambda x: x**2),
    "alpha^(1/3)": ("alpha", lambda x: x**3),
    "alpha^(1/4)": ("alpha", lambda x: x**4),
    "alpha^2": ("alpha", np.sqrt),
    "mu": ("mu", lambda x: x),
    "sqrt(mu)": ("mu", lambda x: x**2),
    "theta": ("mu", lambda x: np.cos(0.5 * np.pi * x)),
    "sqrt(1-mu)": ("mu", lambda x: 1 - x**2),
    "mu^2": ("mu", np.sqrt),
    "ior-1": ("ior", lambda x: 1 + x),
    "(ior-1)/1.5": ("ior", lambda x: 1 + 1.5 * x),
    "(ior-1)/2": ("ior", lambda x: 1 + 2 * x),
    "(ior-1.05)/2": ("ior", lambda x: 1.05 + 2 * x),
    "(ior-1.05)/1.95": ("ior", lambda x: 1.05 + 1.95 * x),
    "f0": ("ior", lambda x: index(np.sqrt(x))),
    "sqrt(f0)": ("ior", index),
    "f0^(1/4)": ("ior", lambda x: index(x**2)),
    "1/ior": ("ior", lambda x: 1 / x),
    "2/ior-1": ("ior", lambda x: 2 / (1 + x)),
}
SHIFTS = {
    "centre": (0.5, 0), "endpoint": (0, 1), "left": (0, 0), "right": (1, 0),
    "one-high": (1.5, 0), "one-low": (-0.5, 0), "end-high": (1, 1), "end-low": (-1, 1),
}  # fmt: skip


def coordinate(axis, i, n):
    """An input and its value at texel i of n; a function is taken at centres."""
    i = n - 1 - i if axis["reversed"] else i
    shift, ends = SHIFTS[axis.get("registration", "centre")]
    of = lambda i, n: min(max((i + shift) / max(n - ends, 1), 0), 1)
    if axis["coordinate"] == "1/ior..ior":
        # From inside with the index falling from 2.5 to 1, then from outside with the index rising.
        half = n // 2
        ior = 1 + 1.5 * of(half - 1 - i if i < half else i - half, half)
        return "ior", (1 / ior if i < half else ior)
    name, scale = SCALES[axis["coordinate"]]
    return name, max(scale(of(i, n)), axis.get("clamp", 0))


def place(axes, texel, size):
    """The inputs of a texel."""
    return dict(coordinate(axis, i, n) for axis, i, n in zip(axes, texel, size))


def read_again(point, values, axes):
    """The value and the inputs of a point, and what is wrong with those that the audit states."""
    texel, near = point["texel"], functions.ROUNDED
    if callable(values):
        value, size = float(values(texel)), [functions.SIDE] * len(texel)
    else:
        values = values.squeeze()
        value, size, near = values[tuple(texel[::-1])], values.shape[::-1], 1e-6
    at = place(axes, texel, size)
    if abs(value - point["value"]) > near * max(1, abs(value)):
        return value, at, f"texel {texel} holds {value:.6g}, the audit reads {point['value']:.6g}"
    far = [name for name, x in point["at"].items() if abs(at.get(name, np.inf) - x) > 1e-6 * max(1, abs(x))]
    return value, at, f"texel {texel} lies elsewhere along {', '.join(far)}" if far else None


def integrated(found, at, holds, stated):
    """The truth and its standard error, and how far it lies from that of the audit beyond what both leave."""
    lobe = found["conventions"][0]["lobe"]
    for more in (1, AGAIN):
        truth, error = lobes.truth(found["quantity"], lobe, at, holds, more)
        beyond = abs(truth - stated) - SIGMAS * error - found["truth_error"]
        if beyond <= 0:
            break
    return truth, error, beyond


def channel(found, own, values):
    """The figures of a channel, and why they do not agree where they do not."""
    axes, texels, why = found["conventions"][0]["axes"], own["texels"], None
    errors, leaves = [], []
    # The worst that the audit states comes last: it must be as it says, and is none of the drawn.
    for point in [*own["points"], texels]:
        value, at, wrong = read_again(point, values, axes)
        truth, error, beyond = integrated(found, at, own["holds"], point["truth"])
        errors.append(value - truth)
        leaves.append(error)
        if beyond > 0:
            wrong = f"{make.where(at)}: {truth:.6g} ± {error:.2g} here, {point['truth']:.6g} in the audit"
        why = why or wrong
    errors = errors[:-1]
    most, rms, n = max(map(abs, errors)), float(np.sqrt(np.mean(np.square(errors)))), len(errors)
    off = SIGMAS * max(leaves) + found["truth_error"]
    if most > texels["max"] + off:
        why = why or f"{most:.4g} is above the largest error that is stated, {texels['max']:.4g}"
    # The variance of a squared error is at most rms^2 (max^2 - rms^2).
    drawn = 0 if n == texels["judged"] else texels["rms"] * np.sqrt(max(texels["max"] ** 2 - texels["rms"] ** 2, 0) / n)
    if abs(rms**2 - texels["rms"] ** 2) > SIGMAS * drawn + 2 * texels["rms"] * off + off**2:
        why = why or f"an RMS of {rms:.4g}, where {texels['rms']:.4g} is stated"
    figures = {"name": own["name"], "holds": own["holds"].split(" (")[0], "points": n, "max": most, "rms": rms}
    stated = {"audit_max": texels["max"], "audit_rms": texels["rms"], "standard_error": max(leaves)}
    return {**rounded({**figures, **stated}), "agrees": why is None, **({"why": why} if why else {})}


def rounded(figures):
    return {name: float(f"{x:.4g}") if isinstance(x, float) else x for name, x in figures.items()}


def entry(job):
    """What is found of an artefact, and the seconds that it took."""
    folder, artefact = job
    begun, found = time.time(), make.audit(folder, artefact)
    if isinstance(found, str):
        return {"id": artefact["id"], "agrees": False, "why": found}, 0
    file = make.place(folder, artefact)
    values = decode.texels(file, artefact["options"], found) or functions.Channels(file, make.options(folder, artefact), found)
    judged = [own for own in found["channels"] if own.get("points")]
    done = [channel(found, own, values[own["name"]]) for own in judged]
    head = {"id": artefact["id"], "sha256": make.digest(file)}
    return {**head, "agrees": all(c["agrees"] for c in done), "channels": done}, time.time() - begun


def main(folder, names):
    artefacts = [a for p in make.listed()["projects"] for a in p["artefacts"]]
    os.makedirs(os.path.join(folder, "audits"), exist_ok=True)
    entries = make.integrated() if names else {}
    with multiprocessing.Pool(2) as pool:
        wanted = [(folder, a) for a in artefacts if not names or a["id"] in names]
        for found, seconds in pool.imap(entry, wanted):
            entries[found["id"]] = found
            points = sum(c["points"] for c in found.get("channels", []))
            why = "agrees" if found["agrees"] else "; ".join(c["why"] for c in [found, *found.get("channels", [])] if "why" in c)
            print(f"{found['id']}: {points} points, {seconds:.0f} s: {why}", file=sys.stderr)
    done = [entries[a["id"]] for a in artefacts if a["id"] in entries]
    with open(os.path.join(make.HERE, "recomputed.json"), "w") as out:
        json.dump({"schema_version": 1, "artefacts": done}, out, indent=1)
        out.write("\n")
    if not all(found["agrees"] for found in done):
        sys.exit("does not agree: " + ", ".join(found["id"] for found in done if not found["agrees"]))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
