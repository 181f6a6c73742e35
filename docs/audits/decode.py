"""Texels of an audited file, read again: none of the program's code, and of each format what the list needs."""
import io
import re
import struct
import zlib

import numpy as np

RAW = {"f16": ("<f2", 1), "f32": ("<f4", 1), "unorm8": ("u1", 255), "unorm16": ("<u2", 65535)}


def named(values):
    """Channels of an image by their names."""
    names = "RGBA" if values.shape[-1] > 2 else "RG"
    return {name: values[..., k].astype(float) for k, name in enumerate(names[: values.shape[-1]])}


def numbered(values, holds):
    """Channels by their numbers, of values in the order of the file and the size that the audit states."""
    size = [int(n) for n in re.search(r", (\d+(?: x \d+)*)", holds).group(1).split(" x ")]
    values = np.asarray(values, float).reshape(*size[::-1], -1)
    return {str(k): values[..., k] for k in range(values.shape[-1])}


def png(content):
    """Levels of a PNG without interlacing (PNG specification, third edition, sec. 9)."""
    at, packed = 8, b""
    while at < len(content):
        length, kind = struct.unpack(">I4s", content[at : at + 8])
        body = content[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            if body[12]:
                raise ValueError("an interlaced PNG")
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    step = {0: 1, 2: 3, 4: 2, 6: 4}[colour] * bits // 8
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * step)
    out, before = [], np.zeros(width * step, np.uint8)
    for line in lines:
        before = unfiltered(line[0], line[1:], before, step)
        out.append(before)
    levels = np.concatenate(out).view(">u2" if bits == 16 else np.uint8)
    return named(levels.reshape(height, width, -1) / (2.0**bits - 1))


def unfiltered(kind, line, above, step):
    """A line of a PNG before its filter."""
    if kind == 0:
        return line
    if kind == 1:
        return line.reshape(-1, step).cumsum(axis=0, dtype=np.uint8).reshape(-1)
    if kind == 2:
        return line + above
    out, over = [0] * step + line.tolist(), [0] * step + above.tolist()
    for i in range(step, len(out)):
        left, up, corner = out[i - step], over[i], over[i - step]
        guess = (left + up) // 2
        if kind == 4:
            far = [abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)]
            guess = (left, up, corner)[far.index(min(far))]
        out[i] = (out[i] + guess) & 255
    return np.array(out[step:], np.uint8)


def radiance(content):
    """A Radiance picture: mantissas over 256 times a power of two (Ward 1991), lines run by run."""
    head, _, rest = content.partition(b"\n\n")
    line, _, body = rest.partition(b"\n")
    height, width = [int(n) for n in re.fullmatch(rb"-Y (\d+) \+X (\d+)", line).groups()]
    at, lines = 0, []
    for _ in range(height):
        at += 4
        line = b""
        while len(line) < 4 * width:
            count = body[at]
            run = count > 128
            line += body[at + 1 : at + 2] * (count - 128) if run else body[at + 1 : at + 1 + count]
            at += 2 if run else 1 + count
        lines.append(np.frombuffer(line, np.uint8).reshape(4, width).T)
    texels = np.array(lines, float)
    return named(texels[..., :3] * 2.0 ** (texels[..., 3:] - 136))


def ktx2(content, layer):
    """The first level of a KTX 2 file of halves (KTX 2.0, sec. 3)."""
    kind, _, width, height = struct.unpack("<4I", content[12:28])
    packed = struct.unpack("<I", content[44:48])[0]
    first, length = struct.unpack("<2Q", content[80:96])
    level = content[first : first + length]
    if packed == 2:
        import zstandard

        level = zstandard.ZstdDecompressor().decompressobj().decompress(level)
    channels = {83: 2, 97: 4}[kind]
    return named(np.frombuffer(level, "<f2").reshape(-1, height, width, channels)[layer])


def exr(path):
    import OpenEXR

    with OpenEXR.File(path, separate_channels=True) as file:
        return {name: channel.pixels.astype(float) for name, channel in file.channels().items()}


def text(content, symbol, holds, raw):
    """Numbers of an array in a text, by its name, or all that stand in brackets, or all."""
    source = re.sub(r"/\*.*?\*/|//[^\n]*", "", content, flags=re.S)
    if symbol:
        source = re.search(re.escape(symbol) + r"\s*(?:\[[^\]=]*\])*\s*=\s*\{([^;]*)\}", source).group(1)
    if "hexadecimal" in holds:
        words = re.findall(r"\b0x([0-9a-fA-F]{1,4})\b", source)
        return np.array([int(word, 16) for word in words], np.uint16).view(np.float16)
    if raw:
        return np.array(re.findall(r"\b\d+\b", source), float) / RAW[raw][1]
    return np.array(re.findall(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", source), float)


def decoded(channels, encoding):
    """Values of encoded ones."""
    if encoding is None:
        return channels
    colours = {name: values for name, values in channels.items() if name != "A"}
    if encoding == "sRGB":
        curve = lambda x: np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)
        return {name: curve(values) for name, values in colours.items()}
    gamma = {"RGBD of gamma 2.2": 2.2, "RGBD": 1.0}[encoding]
    return {name: values**gamma / channels["A"] for name, values in colours.items()}


def texels(path, options, found):
    """Channels of a table by name, slowest axis first; None of a shader."""
    option = lambda name: options[options.index(name) + 1] if name in options else None
    if found["holds"].startswith("shader"):
        return None
    with open(path, "rb") as file:
        content = file.read()
    holds, raw = found["holds"], option("--raw-format")
    if holds.startswith("PNG"):
        channels = png(content)
    elif holds.startswith("Radiance"):
        channels = radiance(content)
    elif holds.startswith("KTX 2"):
        channels = ktx2(content, int(option("--layer") or 0))
    elif holds.startswith("EXR"):
        channels = exr(path)
    elif holds.startswith("NPY"):
        channels = numbered(np.load(io.BytesIO(content)), holds)
    elif holds.startswith("raw"):
        kind, most = RAW[raw]
        channels = numbered(np.frombuffer(content, kind) / most, holds)
    else:
        channels = numbered(text(content.decode(), option("--symbol"), holds, raw), holds)
    return decoded(channels, found.get("encoding"))
