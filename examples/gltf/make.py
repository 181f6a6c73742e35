#!/usr/bin/env python3
"""Writes the examples of this folder: a triangle for each material, one kind of surface a file; and a game of 40 materials,
../game.glb, with the images of its textures in it.

    python3 examples/gltf/make.py
"""

import json
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).parent

POSITIONS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def material(name, colour=(1, 1, 1), metallic=0.0, roughness=0.5, texture=None, **extensions):
    pbr = {"baseColorFactor": [*colour, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
    if texture is not None:
        pbr["metallicRoughnessTexture"] = {"index": texture}
    out = {"name": name, "pbrMetallicRoughness": pbr}
    if extensions:
        out["extensions"] = {f"KHR_materials_{key}": value for key, value in extensions.items()}
    return out


FILES = {
    "metal": [material("gold", (1, 0.78, 0.34), 1.0, 0.3), material("worn steel", (0.66, 0.6, 0.56), 1.0, 0.9, 0)],
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


# Smallest and largest roughness of each texture of the game, and its metalness.
TEXTURES = [(0.2, 0.55, 1.0), (0.5, 0.9, 0.0), (0.35, 0.7, 0.0)]


def game():
    """18 dielectrics without layers, 10 metals, 3 brushed ones, 4 of glass, 3 of cloth, a window and a sign."""
    coat = {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.03}
    of = []
    of += [material(f"plastic {k}", (0.8, 0.1 + 0.2 * k, 0.05), 0.0, 0.2 + 0.1 * k) for k in range(5)]
    of += [material(f"wood {k}", (0.4, 0.25, 0.1 + 0.02 * k), 0.0, 1.0, 2) for k in range(4)]
    of += [material(f"stone {k}", (0.4 + 0.05 * k,) * 3, 0.0, 1.0, 1) for k in range(5)]
    of += [material(f"car paint {k}", (0.1, 0.2, 0.6 - 0.1 * k), 0.0, 0.45, clearcoat=coat) for k in range(4)]
    of += [material(f"steel {k}", (0.66, 0.6, 0.56), 1.0, 1.0, 0) for k in range(4)]
    of += [material(f"copper {k}", (0.96, 0.64, 0.54), 1.0, 0.2 + 0.2 * k) for k in range(3)]
    of += [material(f"gold {k}", (1, 0.78, 0.34), 1.0, 0.15 + 0.1 * k) for k in range(3)]
    of += [material(f"brushed {k}", (0.91, 0.92, 0.92), 1.0, 0.4 + 0.1 * k, anisotropy={"anisotropyStrength": 0.3 + 0.1 * k}) for k in range(3)]
    of += [
        material(f"glass {k}", (1, 1, 1), 0.0, 0.1 + 0.15 * k, transmission={"transmissionFactor": 1}, ior={"ior": 1.45 + 0.05 * k},
                 volume={"thicknessFactor": 0.1})
        for k in range(4)
    ]
    of += [
        material(f"cloth {k}", (0.2, 0.02, 0.05 + 0.1 * k), 0.0, 0.8,
                 sheen={"sheenColorFactor": [0.9, 0.4, 0.5], "sheenRoughnessFactor": 0.3 + 0.2 * k})
        for k in range(3)
    ]
    of += [material("window", (1, 1, 1), 0.0, 0.05, transmission={"transmissionFactor": 1}), material("sign", unlit={})]
    return [{**one, "pbrMetallicRoughness": rounded(one["pbrMetallicRoughness"])} for one in of]


def rounded(pbr):
    """Factors as one would write them."""
    return {key: [round(x, 4) for x in value] if isinstance(value, list) else round(value, 4) if isinstance(value, float) else value
            for key, value in pbr.items()}


def png(low, high, metal):
    """8 x 8 texels whose green runs from one roughness to another, and whose blue is the metalness."""
    green = [round(255 * (low + (high - low) * k / 63)) for k in range(64)]
    texels = b"".join(b"\0" + b"".join(bytes([255, green[8 * y + x], round(255 * metal)]) for x in range(8)) for y in range(8))
    part = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", 8, 8, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + part(b"IHDR", head) + part(b"IDAT", zlib.compress(texels, 9)) + part(b"IEND", b"")


def document(materials, images):
    """The JSON of the materials, and the bytes of its buffer."""
    used = sorted({name for one in materials for name in one.get("extensions", {})})
    primitives = [{"attributes": {"POSITION": 0}, "material": i} for i in range(len(materials))]
    body, views = POSITIONS, [{"buffer": 0, "byteLength": len(POSITIONS)}]
    for image in images:
        views.append({"buffer": 0, "byteOffset": len(body), "byteLength": len(image)})
        body += image
    out = {
        "asset": {"version": "2.0", "generator": "examples/gltf/make.py"},
        "materials": materials,
        "meshes": [{"primitives": primitives}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": views,
        "buffers": [{"byteLength": len(body)}],
    }
    if used:
        out["extensionsUsed"] = used
    textures = {one["pbrMetallicRoughness"].get("metallicRoughnessTexture", {}).get("index") for one in materials} - {None}
    if textures:
        out["textures"] = [{"source": i} for i in sorted(textures)]
        # Without an image of its own a file names one that is not there: without `--textures` nothing opens it.
        own = [{"bufferView": 1 + i, "mimeType": "image/png"} for i in range(len(images))]
        out["images"] = own or [{"uri": "white.png"}]
    return out, body


def chunk(kind, data, padding):
    data += padding * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data


def write(path, materials, images=()):
    scene, body = document(materials, images)
    text = json.dumps(scene, separators=(",", ":")).encode()
    body = chunk(b"JSON", text, b" ") + chunk(b"BIN\0", body, b"\0")
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)


for name, materials in FILES.items():
    write(FOLDER / f"{name}.glb", materials)
write(FOLDER.parent / "game.glb", game(), [png(*texture) for texture in TEXTURES])
