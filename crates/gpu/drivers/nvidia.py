#!/usr/bin/env python3
"""Counts the machine instructions of emitted functions on NVIDIA GPUs, and prints the record.

  pip install --target PACKAGES nvidia-cuda-nvrtc-cu12 nvidia-cuda-nvdisasm
  lobefit cost --isa --from DIR --json | crates/gpu/drivers/nvidia.py PACKAGES DIR [ARCHITECTURE ...] > \\
    reports/isa/nvidia-nvrtc-VERSION.json

DIR is a bake whose languages have "c". NVRTC compiles its fits/lobefit.h, which has the same functions as the WGSL, for each
architecture (sm_75, sm_89 and sm_90 where none is named), with fast maths, and nvdisasm prints the machine code. No GPU and no
driver takes part. Both programs are proprietary, so lobefit depends on neither and runs this nowhere. The scene, its functions and the
hashes of their code come from the record on standard input.

Every invocation loads the numbers that a function takes and stores them, and stores a result. A kernel without the function stores
those numbers again, and its counts are subtracted. Corners of a room are arguments of the kernel. Functions that sample
a table are left out: in C they read memory, without a texture unit.
"""

import base64
import ctypes
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import zlib

ARCHITECTURES = ["sm_75", "sm_89", "sm_90"]
# Whose machine code the record keeps.
LISTED = "sm_90"
THREADS = 64
HELD = {"low", "high", "probe"}


def library(packages):
    """NVRTC, loaded."""
    found = sorted(packages.glob("nvidia/**/libnvrtc.so.12"))
    if not found:
        sys.exit(f"{packages}: holds no libnvrtc.so.12; install nvidia-cuda-nvrtc-cu12 there")
    return ctypes.CDLL(str(found[0]))


def version(packages):
    """The compiler's version, by its package."""
    for folder in packages.glob("nvidia_cuda_nvrtc_cu12-*.dist-info"):
        return re.fullmatch(r"nvidia_cuda_nvrtc_cu12-(.*)\.dist-info", folder.name)[1]
    sys.exit(f"{packages}: nvidia-cuda-nvrtc-cu12 is not installed there by pip")


def compiled(nvrtc, text, architecture):
    """Machine code of a program as an ELF file."""

    def call(name, *arguments):
        code = getattr(nvrtc, name)(*arguments)
        if code and name != "nvrtcCompileProgram":
            sys.exit(f"{name}: error {code}")
        return code

    def output(size, get):
        length = ctypes.c_size_t()
        call(size, program, ctypes.byref(length))
        data = ctypes.create_string_buffer(length.value)
        call(get, program, data)
        return data.raw

    program = ctypes.c_void_p()
    call("nvrtcCreateProgram", ctypes.byref(program), text.encode(), b"lobefit.cu", 0, None, None)
    options = [f"--gpu-architecture={architecture}".encode(), b"--std=c++17", b"--use_fast_math"]
    words = (ctypes.c_char_p * len(options))(*options)
    if call("nvrtcCompileProgram", program, len(options), words):
        sys.exit(output("nvrtcGetProgramLogSize", "nvrtcGetProgramLog").decode())
    return output("nvrtcGetCUBINSize", "nvrtcGetCUBIN")


def structures(header):
    """Numbers in each type."""
    sizes = {"float": 1}
    for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", header, re.S):
        size = 0
        for kind, members in re.findall(r"(\w+) ([^;]+);", re.sub(r"//[^\n]*", "", body)):
            for member in members.split(","):
                count = re.search(r"\[(\d+)\]", member)
                size += sizes.get(kind, 1) * (int(count[1]) if count else 1)
        sizes[name] = size
    return sizes


def kernels(header, names):
    """Kernels that call each function once, and those without; the names of those without; what is left out."""
    sizes = structures(header)
    signature = re.compile(r"^static inline (\w+) (\w+)\(([^)]*)\) \{", re.M)
    text, without, left_out = [], {}, {}
    found = {name: (result, arguments) for result, name, arguments in signature.findall(header)}
    for name in names:
        if name not in found or "*" in found[name][1]:
            left_out[name] = "no function of numbers alone in C"
            continue
        result, arguments = found[name]
        arguments = [argument.replace("const ", "").split() for argument in arguments.split(",")]
        if any(kind not in sizes for kind, _ in arguments):
            left_out[name] = "no function of numbers alone in C"
            continue
        given, words, held = 0, [], []
        for kind, argument in arguments:
            if argument in HELD:
                held.append(f", const {kind} {argument}")
                words.append(argument)
            elif kind == "float":
                words.append(f"a{given}")
                given += 1
            else:
                words.append("{" + ", ".join(f"a{given + k}" for k in range(sizes[kind])) + "}")
                given += sizes[kind]
        given, values = max(given, 1), sizes[result]
        call = f"    const {result} value = {name}({', '.join(words)});\n"
        text.append(kernel(f"with_{name}", given, "".join(held), call, [f"((const float *)&value)[{k}]" for k in range(values)]))
        without[name] = f"without_{given}_{values}"
    for name in sorted(set(without.values())):
        given, values = map(int, name.split("_")[1:])
        text.append(kernel(name, given, "", "", [f"a{k % given}" for k in range(values)]))
    return "".join(text), without, left_out


def kernel(name, given, held, call, values):
    lines = [f"    const float a{k} = given[at + {k * THREADS}u];\n" for k in range(given)]
    lines.append(call)
    lines += [f"    kept[at + {k * THREADS}u] = a{k};\n" for k in range(given)]
    lines += [f"    result[at + {k * THREADS}u] = {value};\n" for k, value in enumerate(values)]
    step = THREADS * 2 ** (max(given, len(values)) - 1).bit_length()
    return (
        f'extern "C" __global__ void {name}(const float *__restrict__ given, float *__restrict__ kept,\n'
        f"    float *__restrict__ result{held}) {{\n"
        f"    const unsigned at = blockIdx.x * {step}u + threadIdx.x;\n{''.join(lines)}}}\n"
    )


def kind(operation, operands):
    """What an instruction is counted as; nothing for hints, branches and the end."""
    base = operation.split(".")[0]
    if base in {"NOP", "BRA", "EXIT", "RET", "BSSY", "BSYNC", "WARPSYNC", "DEPBAR", "YIELD"}:
        return None
    if base == "MUFU":
        return "transcendental"
    # A half-precision multiply-add of zeros makes a number of 32 bits out of two of 16.
    literal = re.fullmatch(r"-?(\d[\d.e+-]*|0x[0-9a-f]+|[+-]?INF|[+-]?QNAN)", operands[-1] if operands else "")
    zeros = base == "HFMA2" and operands[1:3] in (["-RZ", "RZ"], ["RZ", "RZ"])
    if zeros or (literal and (base in {"MOV", "UMOV"} or operation.startswith("IMAD.MOV"))):
        return "moves"
    if base in {"LDG", "STG", "LD", "ST", "LDL", "STL", "LDS", "STS", "LDC", "TEX", "TLD", "TLD4"}:
        return "memory"
    if base[0] == "U" or base in {"S2R", "S2UR", "R2UR", "CS2R", "LDCU"}:
        return "scalar"
    return "vector"


def kernels_in(listing):
    """Names and instructions of all kernels in what nvdisasm prints."""
    for section in re.split(r"^\.text\.", listing, flags=re.M)[1:]:
        lines = re.findall(r"/\*[0-9a-f]{4,}\*/\s+(.*?) *;", section.split("\n.section", 1)[0])
        yield re.match(r"\w+", section)[0], [line for line in lines if line != "NOP"]


def counts(listing):
    """Counts of every kernel in what nvdisasm prints."""
    found = {}
    for name, lines in kernels_in(listing):
        row = {"vector": 0, "transcendental": 0, "scalar": 0, "memory": 0, "moves": 0}
        for line in lines:
            operation, _, rest = re.sub(r"^@!?\w+\s+", "", line).partition(" ")
            what = kind(operation, [operand.strip() for operand in rest.split(",") if operand.strip()])
            if what:
                row[what] += 1
        found[name] = {**row, "bytes": 16 * len(lines)}
    return found


def machine_code(listing, names):
    """The instructions of the kernels that call functions, by the names of the functions."""
    found = {name.removeprefix("with_"): "\n".join(lines) for name, lines in kernels_in(listing)}
    # Other constants and functions for three channels are left out, as `lobefit cost --isa` does.
    return {name: found[name] for name in names if not name.endswith(("_rms", "_rgb"))}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    packages, bake = map(pathlib.Path, sys.argv[1:3])
    architectures = sys.argv[3:] or ARCHITECTURES
    record = json.load(sys.stdin)
    nvrtc, disassemblers = library(packages), sorted(packages.glob("nvidia/**/nvdisasm"))
    if not disassemblers:
        sys.exit(f"{packages}: holds no nvdisasm; install nvidia-cuda-nvdisasm there")
    header = bake / "fits/lobefit.h"
    if not header.is_file():
        sys.exit(f"{header}: not there; bake a scene whose languages have \"c\"")
    header = header.read_text()
    text, without, left_out = kernels(header, sorted(record["functions"]))
    header = header.replace("#include <math.h>", "").replace("static inline", "static __device__ inline")
    rows = []
    for architecture in architectures:
        code = compiled(nvrtc, header + text, architecture)
        with tempfile.NamedTemporaryFile(suffix=".cubin") as file:
            file.write(code)
            file.flush()
            listing = subprocess.run([disassemblers[0], "-c", file.name], capture_output=True, text=True, check=True).stdout
        found = counts(listing)
        if architecture == LISTED:
            texts = machine_code(listing, without)
        for name, base in without.items():
            whole = found[f"with_{name}"]
            row = {key: whole[key] - found[base][key] for key in whole}
            rows.append({"function": name, "family": architecture, "precision": "f32", **row})
    rows.sort(key=lambda row: row["function"])
    left = [{"function": name, "precision": "f32", "reason": why} for name, why in left_out.items()]
    functions = {name: function for name, function in record["functions"].items() if name in without}
    whole = {
        "schema_version": record["schema_version"],
        "command": "lobefit cost --isa --from DIR --json | crates/gpu/drivers/nvidia.py PACKAGES DIR",
        "scene": record["scene"],
        "driver": "nvidia-nvrtc",
        "version": version(packages),
        "left_out": left,
        "functions": {},
        "rows": [],
    }
    if LISTED in architectures:
        texts = json.dumps(dict(sorted(texts.items())), separators=(",", ":")).encode()
        whole["listings"] = {"family": LISTED, "packed": base64.b64encode(zlib.compress(texts, 9)).decode()}

    def line(value):
        return json.dumps(value, separators=(",", ":"))

    lines = ",\n    ".join(f"{line(name)}:{line(function)}" for name, function in sorted(functions.items()))
    text = json.dumps(whole, indent=2).replace('"functions": {}', f'"functions": {{\n    {lines}\n  }}', 1)
    print(text.replace('"rows": []', '"rows": [\n    ' + ",\n    ".join(map(line, rows)) + "\n  ]", 1))


if __name__ == "__main__":
    main()
