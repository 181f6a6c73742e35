#!/usr/bin/env python3
"""Writes the examples of this folder: a triangle for each material, one kind of surface a file.

    python3 examples/gltf/make.py
"""

import json
import pathlib
import struct

FOLDER = pathlib.Path(__file__).parent

POSITIONS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def material(name, colour=(1, 1, 1), metallic=0.0, roughness=0.5, textured=False, **extensions):
    pbr = {"baseColorFactor": [*colour, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
    if textured:
        pbr["metallicRoughnessTexture"] = {"index": 0}
    out = {"name": name, "pbrMetallicRoughness": pbr}
    if extensions:
        out["extensions"] = {f"KHR_materials_{key}": value for key, value in extensions.items()}
    return out


FILES = {
    "metal": [material("gold", (1, 0.78, 0.34), 1.0, 0.3), material("worn steel", (0.66, 0.6, 0.56), 1.0, 0.9, True)],
    "plastic": [material("red plastic", (0.8, 0.1, 0.05), 0.0, 0.35), material("rubber", (0.1, 0.1, 0.1), 0.0, 0.9)],
    "glass": [
        material("frosted glass", (1, 1, 1), 0.0, 0.4, transmission={"transmissionFactor": 1}, ior={"ior": 1.52},
                 volume={"thicknessFactor": 0.1}, dispersion={"dispersion": 1}),
    ],
    "window": [material("window", (1, 1, 1), 0.0, 0.2, transmission={"transmissionFactor": 1})],
    "brushed": [material("brushed", (0.9, 0.9, 0.9), 1.0, 0.5, anisotropy={"anisotropyStrength": 0.6})],
    "cloth": [
        material("velvet", (0.2, 0.02, 0.05), 0.0, 0.8,
                 sheen={"sheenColorFactor": [0.9, 0.4, 0.5], "sheenRoughnessFactor": 0.4}),
    ],
    "painted": [
        material("car paint", (0.1, 0.2, 0.6), 0.3, 0.5, clearcoat={"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.05}),
        material("soap bubble", (1, 1, 1), 0.0, 0.1, iridescence={"iridescenceFactor": 1}),
        material("sign", (1, 1, 1), unlit={}),
    ],
}


def document(materials):
    used = sorted({name for one in materials for name in one.get("extensions", {})})
    primitives = [{"attributes": {"POSITION": 0}, "material": i} for i in range(len(materials))]
    out = {
        "asset": {"version": "2.0", "generator": "examples/gltf/make.py"},
        "materials": materials,
        "meshes": [{"primitives": primitives}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": len(POSITIONS)}],
        "buffers": [{"byteLength": len(POSITIONS)}],
    }
    if used:
        out["extensionsUsed"] = used
    if any("metallicRoughnessTexture" in one["pbrMetallicRoughness"] for one in materials):
        # A white texel: the range of a texture is what a plan takes, whatever it holds.
        out["textures"], out["images"] = [{"source": 0}], [{"uri": "white.png"}]
    return out


def chunk(kind, data, padding):
    data += padding * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data


for name, materials in FILES.items():
    text = json.dumps(document(materials), separators=(",", ":")).encode()
    body = chunk(b"JSON", text, b" ") + chunk(b"BIN\0", POSITIONS, b"\0")
    (FOLDER / f"{name}.glb").write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
