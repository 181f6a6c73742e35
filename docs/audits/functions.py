"""Values of audited shader functions, from their files again: straight-line GLSL, HLSL and WGSL as Python's expressions, in
f64. None of the program's code; of the languages it knows what the list needs.
"""
import os
import re

import numpy as np

# What f32 in the program leaves of f64 here, where terms of some tens add up to about 1.
ROUNDED = 1e-5
# Places along each argument, at whose centres an audit takes a function.
SIDE = 128
TYPE = r"(?:const\s+)?(?:in\s+)?(float[234]?(?:x[234])?|vec[234]|f32|vec[234]f|vec[234]<f32>)"
AXES = "xyzw"


class Vector(np.ndarray):
    """A short vector with swizzles."""

    def __getattr__(self, name):
        if not set(name) <= set(AXES):
            raise AttributeError(name)
        picked = [self[AXES.index(c)] for c in name]
        return picked[0] if len(picked) == 1 else vector(len(picked), *picked)

    def __setattr__(self, name, value):
        self[AXES.index(name)] = value


def vector(n, *parts):
    flat = np.concatenate([np.atleast_1d(np.asarray(p, float)) for p in parts] or [np.zeros(n)])
    return (np.repeat(flat, n) if len(flat) == 1 else flat).view(Vector)


LIBRARY = {
    "vector": vector,
    "matrix": lambda n, *entries: np.array(entries, float).reshape(n, n),
    "mul": lambda m, v: (m @ v).view(Vector),
    "dot": lambda a, b: float(np.dot(a, b)),
    "choose": lambda condition, a, b: a if condition else b,
    "min": np.minimum, "max": np.maximum, "abs": np.abs, "sqrt": np.sqrt, "exp": np.exp, "exp2": np.exp2, "pow": np.power,
    "clamp": np.clip, "saturate": lambda x: np.clip(x, 0, 1), "mix": lambda a, b, t: a + (b - a) * t,
    "mad": lambda a, b, c: a * b + c, "rcp": lambda x: 1 / x,
    # Of MathLib by what it stands for, as it has modes, and of three.js a macro of another file.
    "PositiveRcp": lambda x: 1 / max(x, 1e-15), "RECIPROCAL_PI": 1 / np.pi,
}  # fmt: skip


def text(file, folders):
    """A source with its includes before it, without comments."""
    with open(file, encoding="utf-8") as lines:
        source = lines.read()
    whole = ""
    for name in re.findall(r'#include "([^"]+)"', source):
        found = [p for p in (os.path.join(folder, name) for folder in folders) if os.path.exists(p)]
        whole += text(found[0], folders) if found else ""
    return whole + re.sub(r"/\*.*?\*/|//[^\n]*", "", source, flags=re.S)


def closing(source, at):
    """The place behind the bracket that closes the one at a place."""
    depth = 0
    for i in range(at, len(source)):
        depth += (source[i] in "({") - (source[i] in ")}")
        if depth == 0:
            return i + 1
    raise ValueError("a bracket that is not closed")


def chosen(body, defines):
    """Lines that conditions `#if A == B` leave, whose names are 0 but for the defined. What follows WESL's
    `@if(A)` is left out and its `@else` kept: no function of the page is asked for with such a name."""
    value = lambda word: defines.get(word, int(word) if word.isdigit() else 0)
    lines, taken = [], []
    for line in body.split("\n"):
        condition = re.match(r"\s*#\s*(if|elif)\s+(\w+)(?:\s*==\s*(\w+))?", line)
        if condition:
            kind, a, b = condition.groups()
            holds = value(a) == value(b) if b else value(a) != 0
            before = taken.pop() if kind == "elif" else [False, False]
            taken.append([holds and not before[1], before[1] or holds])
        elif re.match(r"\s*#\s*else", line):
            taken[-1] = [not taken[-1][1], True]
        elif re.match(r"\s*#\s*endif", line):
            taken.pop()
        elif all(branch for branch, _ in taken):
            lines.append(line)
    return re.sub(r"@if\((\w+)\)[^;]*;", "", "\n".join(lines)).replace("@else", "")


def expression(source):
    """Python's form of an expression."""
    source = re.sub(r"\b(?:float|vec)([234])x[234]\s*\(", r"matrix(\1, ", source)
    source = re.sub(r"\b(?:float|vec)([234])(?:f|<f32>)?\s*\(", r"vector(\1, ", source)
    source = re.sub(r"(\d\.?)f\b", r"\1", source).replace("Math::", "")
    while "?" in source:
        # The innermost choice reaches from its bracket, or the beginning, to the bracket's end.
        at = source.rindex("?")
        begin, depth = at, 0
        while begin > 0 and (depth or source[begin - 1] != "("):
            begin -= 1
            depth += (source[begin] == ")") - (source[begin] == "(")
        end = closing(source, begin - 1) - 1 if begin else len(source)
        yes, no = source[at + 1 : end].split(":", 1)
        source = f"{source[:begin]}choose({source[begin:at]}, {yes}, {no}){source[end:]}"
    return source.strip()


class Functions:
    """The functions of a source."""

    def __init__(self, source, defines):
        self.source, self.defines = source, defines

    def found(self, name, types=None, count=None):
        """Parameters (type, name) and statements of a function."""
        for head in re.finditer(r"\b" + name + r"\s*\(", self.source):
            end = closing(self.source, head.end() - 1)
            body = re.match(r"\s*(?:->\s*[\w<>]+\s*)?\{", self.source[end:])
            if not body:
                continue
            listed = [p.strip() for p in self.source[head.end() : end - 1].split(",")]
            pairs = [re.fullmatch(TYPE + r"\s+(\w+)", p) or re.fullmatch(r"(?P<n>\w+)\s*:\s*(?P<t>[\w<>]+)", p) for p in listed]
            if not all(pairs):
                continue
            own = [(p["t"], p["n"]) if "t" in p.groupdict() else p.groups() for p in pairs]
            if (types is None or [t for t, _ in own] == types) and (count is None or len(own) == count):
                start = end + body.end()
                return own, chosen(self.source[start : closing(self.source, start - 1) - 1], self.defines)
        return None

    def call(self, name, arguments, types=None):
        """What a function returns."""
        own, body = self.found(name, types, len(arguments))
        known = Called(self)
        known.update(zip((n for _, n in own), arguments))
        for statement in re.sub(r"[{}]", "", body).split(";"):
            line = " ".join(statement.split())
            line = re.sub(r"^(let|var)\s+(\w+)(\s*:\s*[\w<>]+)?", r"\2", line)
            bare = re.fullmatch(r"(?:float|vec)([234]) (\w+)", line)
            line = f"{bare[2]} = vector({bare[1]})" if bare else re.sub("^" + TYPE + r"\s+(?=\w+\s*=)", "", line)
            if line.startswith("return"):
                return eval(expression(line[6:]), {}, known)
            if line:
                exec(re.sub(r"=\s*(.*)", lambda m: "= " + expression(m[1]), line, count=1), {}, known)
        raise ValueError(f"{name} returns nothing")


class Called(dict):
    """Names of a call: its own, the library's, and functions of the source."""

    def __init__(self, functions):
        super().__init__()
        self.functions = functions

    def __missing__(self, name):
        if name in LIBRARY:
            return LIBRARY[name]
        if self.functions.found(name):
            return lambda *arguments: self.functions.call(name, arguments)
        raise KeyError(name)


class Channels:
    """The channels of an audited function, each a number of a texel."""

    def __init__(self, file, options, found):
        given = lambda name: [value for option, value in zip(options, options[1:]) if option == name]
        defines = {d.split("=")[0]: float(d.split("=")[1]) for d in given("--define")}
        self.functions = Functions(text(file, given("--include")), defines)
        asked = (given("--function") or [re.search(r"function (\w+)", found["holds"])[1]])[0]
        self.name, *types = asked.rstrip(")").split("(")
        self.types = [t.strip() for t in types[0].split(",")] if types else None
        self.parameters, _ = self.functions.found(self.name, self.types)
        self.axes = [axis["axis"] for axis in found["conventions"][0]["axes"]]

    def __getitem__(self, channel):
        return lambda texel: self.value(channel, {name: (i + 0.5) / SIDE for name, i in zip(self.axes, texel)})

    def value(self, channel, at):
        """Of a result, at f0 = 0 and 1 of its own or as they follow from two others, a component."""
        component = AXES.index(channel[0]) if channel[0] in AXES else 0
        result = lambda f0: np.atleast_1d(
            self.functions.call(self.name, [argument(kind, name, at, f0) for kind, name in self.parameters], self.types)
        )[component]
        if "less f0 A" in channel:
            low = float(re.search(r"by f0 = ([\d.]+) and 1", channel)[1])
            return (result(low) - low * result(1.0)) / (1 - low)
        f0 = re.search(r"at f0 = ([\d.]+)", channel)
        return result(float(f0[1]) if f0 else 1.0)


def argument(kind, name, at, f0):
    """An argument: of an axis, a direction whose cosine one is, what is 1 in such functions, or f0."""
    if name in at:
        return at[name]
    cosine = at.get("dot(normal, viewDir)")
    if name in ("normal", "viewDir"):
        return vector(3, 0, 0, 1) if name == "normal" else vector(3, np.sqrt(1 - cosine * cosine), 0, cosine)
    value = 1.0 if name.lower() == "f90" else f0
    size = re.search("[234]", kind.replace("f32", ""))
    return vector(int(size[0]), value) if size else value
