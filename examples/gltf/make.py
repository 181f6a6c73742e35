#!/usr/bin/env python3
"""Writes the examples of this folder: a triangle for each material, one kind of surface a file; a game of 40 materials,
../game.glb, with the images of its textures in it; and a courtyard to be seen, ../courtyard.glb.

    python3 examples/gltf/make.py
"""

import json
import math
import pathlib
import random
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


def write(path, scene, body):
    text = json.dumps(scene, separators=(",", ":")).encode()
    body = chunk(b"JSON", text, b" ") + chunk(b"BIN\0", body, b"\0")
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)


def box():
    """A cube of side 1 on the ground, without its floor."""
    corners = [(x - 0.5, y, z - 0.5) for y in (0, 1) for z in (0, 1) for x in (0, 1)]
    quads = [(4, 6, 7, 5), (0, 4, 5, 1), (1, 5, 7, 3), (3, 7, 6, 2), (2, 6, 4, 0)]
    return corners, [k for a, b, c, d in quads for k in (a, b, c, a, c, d)], 4


def column(sides=10):
    """A tube of diameter and height 1, as a strip."""
    ring = [(0.5 * math.cos(2 * math.pi * k / sides), 0.5 * math.sin(2 * math.pi * k / sides)) for k in range(sides)]
    corners = [(x, y, z) for x, z in ring for y in (0, 1)]
    return corners, [k % (2 * sides) for k in range(2 * sides + 2)], 5


def arch(steps=12):
    """A wall of width and height 1 and depth 0.2 above a round opening of diameter 0.8."""
    at = [math.pi * k / steps for k in range(steps + 1)]
    inner = [(-0.4 * math.cos(t), 0.5 * math.sin(t)) for t in at]
    corners = [(x, y, z) for z in (-0.1, 0.1) for x, low in inner for y in (low, 1)]
    side = 2 * (steps + 1)
    quads = [(z + 2 * k, z + 2 * k + 1, z + 2 * k + 3, z + 2 * k + 2) for z in (0, side) for k in range(steps)]
    quads += [(2 * k, 2 * k + 2, side + 2 * k + 2, side + 2 * k) for k in range(steps)]
    return corners, [k for a, b, c, d in quads for k in (a, b, c, a, c, d)], 4


def crown():
    """A tree's crown of diameter 1: a bumpy ball."""
    rows, sides, bumps = 6, 10, random.Random(5)
    corners = []
    for i in range(rows + 1):
        for k in range(sides):
            r = 0.5 * bumps.uniform(0.8, 1.0) if 0 < i < rows else 0.5
            t, p = math.pi * i / rows, 2 * math.pi * k / sides
            corners.append((r * math.sin(t) * math.cos(p), r * math.cos(t), r * math.sin(t) * math.sin(p)))
    at = lambda i, k: i * sides + k % sides
    quads = [(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)) for i in range(rows) for k in range(sides)]
    return corners, [k for a, b, c, d in quads for k in (a, b, c, a, c, d)], 4


def ground(side=88, steps=16):
    """A terrain of gentle waves."""
    height = lambda x, z: 0.15 * math.sin(0.13 * x) * math.cos(0.17 * z) - 0.15
    line = [side * (k / steps - 0.5) for k in range(steps + 1)]
    corners = [(x, height(x, z), z) for z in line for x in line]
    n = steps + 1
    quads = [(z * n + x, z * n + n + x, z * n + n + x + 1, z * n + x + 1) for z in range(steps) for x in range(steps)]
    return corners, [k for a, b, c, d in quads for k in (a, b, c, a, c, d)], 4


def courtyard():
    """Four wings with arcades about a court with a tower, stalls and trees; fences and houses around: nodes, and the JSON with its buffer."""
    shapes = [ground(), box(), column(), arch(), crown()]
    nodes, dice = [], random.Random(21)
    GROUND, BOX, COLUMN, ARCH, CROWN = range(5)
    trim = lambda values: [round(x, 3) for x in values]

    def node(mesh=None, at=(0, 0, 0), scale=(1, 1, 1), turn=0.0, children=()):
        one = {} if mesh is None else {"mesh": mesh}
        one |= {"translation": trim(at)} if any(at) else {}
        one |= {"scale": trim(scale)} if tuple(scale) != (1, 1, 1) else {}
        one |= {"rotation": [0, round(math.sin(turn / 2), 6), 0, round(math.cos(turn / 2), 6)]} if turn else {}
        one |= {"children": list(children)} if children else {}
        nodes.append(one)
        return len(nodes) - 1

    def wing():
        """Along x, 36 m long, its arcade to positive z."""
        parts = [node(BOX, (0, 0, -3), (36, 7, 5)), node(BOX, (0, 4, 1.5), (36, 0.4, 4))]
        parts += [node(ARCH, (4.5 * k, 0, 3.4), (4.5, 4.2, 2)) for k in range(-3, 4)]
        parts += [node(COLUMN, (4.5 * k + 2.25, 0, 3.4), (0.5, 2, 0.5)) for k in range(-4, 4)]
        parts += [node(BOX, (5 * k, 7, -3), (1, 1.5, 1)) for k in (-3, -1, 2)]
        return parts

    def tree(x, z, size):
        return [node(COLUMN, (x, -0.3, z), (0.12 * size, 0.7 * size, 0.12 * size)), node(CROWN, (x, 0.9 * size, z), (size * 0.8,) * 3)]

    def fence(length):
        bars = [node(BOX, (0.4 * k, 0, 0), (0.08, 1.8, 0.08)) for k in range(int(length / 0.4))]
        return bars + [node(BOX, (length / 2, y, 0), (length, 0.08, 0.05)) for y in (0.3, 1.5)]

    roots = [node(GROUND)]
    for quarter in range(4):
        turn = quarter * math.pi / 2
        at = (-24 * math.sin(turn), 0, -24 * math.cos(turn))
        roots.append(node(None, at, turn=turn, children=wing()))
        roots.append(node(None, (37 * math.cos(turn), 0, -37 * math.sin(turn)), turn=turn + 0.2, children=fence(20)))
        roots.append(node(None, (30 * math.cos(turn + 0.8), 0, -30 * math.sin(turn + 0.8)), turn=turn + 2.4, children=fence(8)))
    roots.append(node(None, (4, 0, -3), turn=0.4, children=[node(BOX, scale=(5, 11, 5)), node(COLUMN, (0, 11, 0), (3, 4, 3))]))
    for k in range(14):
        x, z = dice.uniform(-17, 17), dice.uniform(-17, 17)
        turn = dice.uniform(0, 3)
        posts = [node(COLUMN, (x, 0, z), (0.12, 2.4, 0.12)) for x in (-1.2, 1.2) for z in (-0.8, 0.8)]
        goods = [node(BOX, (0.5 * k - 1, 0.9, 0.25 * (k % 2)), (0.3, 0.2 + 0.05 * k, 0.3)) for k in range(5)]
        stall = [node(BOX, (0, 0, 0), (2.6, 0.9, 1)), node(BOX, (0, 2.4, 0), (3, 0.1, 2.2))] + posts + goods
        if math.hypot(x - 4, z + 3) > 5:
            roots.append(node(None, (x, 0, z), turn=turn, children=stall))
    for k in range(22):
        x, z = dice.uniform(-42, 42), dice.uniform(-42, 42)
        if max(abs(x), abs(z)) > 32 or max(abs(x), abs(z)) < 16:
            roots += tree(x, z, dice.uniform(3, 6))
    for k in range(10):
        turn, far = 2 * math.pi * (k + 0.3) / 10, dice.uniform(37, 41)
        roots.append(node(BOX, (far * math.cos(turn), -0.3, far * math.sin(turn)), (dice.uniform(3, 6), dice.uniform(3, 9), 4), turn))
    return nodes, roots, shapes


def drawn(nodes, roots, shapes):
    """The JSON of nodes with their shapes, and its buffer."""
    body, views, accessors, meshes = b"", [], [], []
    for corners, indices, mode in shapes:
        for data, kind, number, count in [
            (struct.pack(f"<{3 * len(corners)}f", *(round(x, 4) for corner in corners for x in corner)), "VEC3", 5126, len(corners)),
            (struct.pack(f"<{len(indices)}H", *indices), "SCALAR", 5123, len(indices)),
        ]:
            views.append({"buffer": 0, "byteOffset": len(body), "byteLength": len(data)})
            accessors.append({"bufferView": len(views) - 1, "componentType": number, "count": count, "type": kind})
            body += data + b"\0" * (-len(data) % 4)
        ends = [[round(end(corner[k] for corner in corners), 4) for k in range(3)] for end in (min, max)]
        accessors[-2] |= {"min": ends[0], "max": ends[1]}
        last = len(accessors) - 1
        meshes.append({"primitives": [{"attributes": {"POSITION": last - 1}, "indices": last, "mode": mode}]})
    scene = {
        "asset": {"version": "2.0", "generator": "examples/gltf/make.py"},
        "scene": 0,
        "scenes": [{"nodes": roots}],
        "nodes": nodes,
        "meshes": meshes,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(body)}],
    }
    return scene, body


for name, materials in FILES.items():
    write(FOLDER / f"{name}.glb", *document(materials, ()))
write(FOLDER.parent / "game.glb", *document(game(), [png(*texture) for texture in TEXTURES]))
write(FOLDER.parent / "courtyard.glb", *drawn(*courtyard()))
