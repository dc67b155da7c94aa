"""The avenue's textures, computed, as PNG files."""
import random
import struct
import zlib
from math import exp, hypot, pi, sin


def png(width, height, rows, palette=None):
    """rows: one bytes object each, 3 bytes a pixel or, with a palette of (r, g, b), one."""
    step = 1 if palette else 3

    def filtered(row, above):
        # The filter whose differences are smallest packs best, as the PNG specification suggests.
        plain = bytes([0]) + row
        left = bytes([1]) + bytes((x - (row[i - step] if i >= step else 0)) & 255 for i, x in enumerate(row))
        up = bytes([2]) + bytes((x - y) & 255 for x, y in zip(row, above))
        return min((plain, left, up), key=lambda f: sum(min(x, 256 - x) for x in f[1:]))

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    body = b"".join(filtered(row, above) for row, above in zip(rows, [bytes(width * step)] + rows[:-1]))
    out = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3 if palette else 2, 0, 0, 0))
    if palette:
        out += chunk(b"PLTE", b"".join(bytes(colour) for colour in palette))
    return out + chunk(b"IDAT", zlib.compress(body, 9)) + chunk(b"IEND", b"")


def mix(a, b, t):
    return a + (b - a) * t


def noise_field(size, cells, rng):
    """Smooth noise from -1 to 1 that tiles."""
    lattice = [[rng.uniform(-1, 1) for _ in range(cells)] for _ in range(cells)]

    def at(x, y):
        i, j = int(x), int(y)
        s, t = x - i, y - j
        s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
        a, b = lattice[j % cells], lattice[(j + 1) % cells]
        i0, i1 = i % cells, (i + 1) % cells
        return mix(mix(a[i0], a[i1], s), mix(b[i0], b[i1], s), t)
    scale = cells / size
    return [[at(x * scale, y * scale) for x in range(size)] for y in range(size)]


def limestone(size=512):
    """Warm pale stone in faint beds, fine-grained, one joint between two drums at the top."""
    rng = random.Random(1)
    octaves = [(noise_field(size, 4 << k, rng), 0.55 ** k) for k in range(6)]
    dark, light = (176, 152, 118), (246, 236, 214)
    levels = 48
    palette = [tuple(round(mix(a, b, i / (levels - 1))) for a, b in zip(dark, light)) for i in range(levels)]
    rows = []
    for y in range(size):
        row = bytearray()
        joint = exp(-(min(y, size - y) / 2.2) ** 2)
        for x in range(size):
            cloud = sum(field[y][x] * weight for field, weight in octaves)
            beds = sin(2 * pi * (5 * y / size + 0.35 * octaves[0][0][y][x] + 0.12 * octaves[2][0][y][x]))
            vein = exp(-(octaves[1][0][y][x] * 14 + octaves[3][0][y][x] * 2) ** 2)
            value = 0.70 + 0.13 * cloud + 0.11 * beds - 0.22 * vein - 0.75 * joint
            row.append(round(max(0.0, min(1.0, value)) * (levels - 1)))
        rows.append(bytes(row))
    return png(size, size, rows, palette)


def dice(face=128):
    """The six faces of a die side by side, three above three, light with a dark border and dark pips."""
    places = {1: "e", 2: "ai", 3: "aei", 4: "acgi", 5: "acegi", 6: "acdfgi"}
    levels = 32
    palette = [(round(mix(40, 255, i / (levels - 1))),) * 3 for i in range(levels)]
    rows = []
    for y in range(2 * face):
        row = bytearray()
        for x in range(3 * face):
            number = 1 + x // face + 3 * (y // face)
            s, t = (x % face + 0.5) / face, (y % face + 0.5) / face
            edge = min(s, 1 - s, t, 1 - t)
            pips = (("abcdefghi".index(p) for p in places[number]))
            pip = min(hypot(s - 0.25 * (1 + p % 3), t - 0.25 * (1 + p // 3)) for p in pips)
            checker = 0.08 * ((int(s * 8) + int(t * 8)) % 2)
            ink = max(min(1, max(0, (0.055 - edge) * face / 2 + 0.5)), min(1, max(0, (0.085 - pip) * face / 2 + 0.5)))
            row.append(round((1 - checker) * (1 - 0.85 * ink) * (levels - 1)))
        rows.append(bytes(row))
    return png(3 * face, 2 * face, rows, palette)


def stipple(size=64):
    """A cell of a staggered grid of darker dots: one in the middle of the left half, one on the right half's edge."""
    levels = 32
    palette = [(round(mix(90, 255, i / (levels - 1))),) * 3 for i in range(levels)]
    rows = []
    for y in range(size):
        row = bytearray()
        for x in range(2 * size):
            s, t = (x + 0.5) / size, (y + 0.5) / size
            away = min(hypot(s - 0.5, t - 0.5), hypot(s - 1.5, t), hypot(s - 1.5, t - 1))
            row.append(round(min(1, max(0, (away - 0.27) * size / 3 + 0.5)) * (levels - 1)))
        rows.append(bytes(row))
    return png(2 * size, size, rows, palette)
