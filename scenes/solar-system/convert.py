#!/usr/bin/env python3
"""Turns published maps into maps of weights: how much of each kind of spectra.json lies at each place.

    convert.py THREE_GLOBE STELLARIUM [OUT]

THREE_GLOBE  the folder package/ of npm three-globe 2.45.2
STELLARIUM   the folder usr/share/stellarium of Debian's stellarium-data 0.22.2-1
OUT          where the files go; as a rule this folder, which also holds spectra.json

Every map is equirectangular: north up, the left edge at longitude 180 degrees west, eastward to the right. maps.json tells
which channel is which kind. Reflectance at a place = sum over channels of value / 255 * scale * kind's reflectance.

Needs python3-numpy, python3-pil and python3-scipy.
"""
import json
import os
import re
import sys

import numpy as np
from PIL import Image
from scipy import ndimage

GLOBE, STELLARIUM = sys.argv[1:3]
OUT = sys.argv[3] if len(sys.argv) > 3 else os.path.dirname(os.path.abspath(__file__))
SPECTRA = json.load(open(os.path.join(OUT, "spectra.json")))["kinds"]
MAPS = {}


def kind(name, nm):
    return np.interp(nm, *np.array(SPECTRA[name]["reflectance"]).T)


def load(path, size, mode="RGB"):
    """A picture as numbers of 0 to 255, reduced to size (width, height) by area means."""
    im = Image.open(path).convert(mode)
    if im.size != size:
        im = im.resize(size, Image.BOX if im.size[0] >= size[0] else Image.BICUBIC)
    return np.array(im).astype(float)


def texture(name, size, mode="RGB"):
    return load(f"{STELLARIUM}/textures/{name}", size, mode)


def area(shape):
    return np.cos((np.arange(shape[0]) + 0.5) / shape[0] * np.pi - np.pi / 2)[:, None] * np.ones(shape[:2])


def mean(values):
    a = area(values.shape)
    return (values * a).sum() / a.sum()


def quantile(values, q):
    """The value below which the share q of the globe's area lies."""
    o = np.argsort(values.ravel())
    c = np.cumsum(area(values.shape).ravel()[o])
    return values.ravel()[o][np.searchsorted(c, q * c[-1])]


def save(name, channels, kinds, scale, step=1, quality=None, **more):
    data = [np.clip(np.rint(c / scale * 255 / step) * step, 0, 255).astype(np.uint8) for c in channels]
    if len(data) == 2:
        data.append(np.zeros_like(data[0]))
    im = Image.fromarray(data[0] if len(data) == 1 else np.dstack(data))
    path = os.path.join(OUT, name)
    im.save(path, **({"quality": quality, "subsampling": 0} if quality else {"optimize": True}))
    MAPS[name] = {"size": list(im.size), "channels": kinds, "scale": round(float(scale), 4), **more}
    print(f"{name:20} {os.path.getsize(path):8} bytes  " + "  ".join(
        f"{k}: mean {mean(c):.3f}, greatest {c.max():.2f}" for k, c in zip(kinds, channels)))


def earth():
    size = (2048, 1024)
    code = load(f"{GLOBE}/example/img/earth-blue-marble.jpg", size)
    # NASA's MODIS pictures show reflectance 0 ... 1.1 by this curve (red 645 nm, green 555 nm, blue 469 nm).
    target = np.interp(code, [0, 110, 160, 210, 240, 255], np.array([0, 30, 60, 120, 190, 255]) / 255 * 1.1)
    water = load(f"{GLOBE}/example/img/earth-water.png", size, "L") / 255
    # Ice shelves are water in the mask and white in the picture.
    white = (target.min(axis=2) > 0.35) & (target.min(axis=2) > 0.75 * target.max(axis=2))
    water[white] = 0
    land = 1 - water
    basis = np.array([[kind(k, nm) for k in ("vegetation", "soil", "snow")] for nm in (645, 555, 469)])
    # Non-negative least squares of three kinds in three bands: try all seven sets of kinds, keep the best.
    t = target.reshape(-1, 3)
    best, weights = np.full(len(t), np.inf), np.zeros_like(t)
    for subset in ([0], [1], [2], [0, 1], [0, 2], [1, 2], [0, 1, 2]):
        b = basis[:, subset]
        x = t @ np.linalg.pinv(b).T
        x = np.clip(x, 0, None)
        total = x.sum(axis=1, keepdims=True)
        x /= np.maximum(total, 1)
        err = ((x @ b.T - t) ** 2).sum(axis=1)
        better = err < best - 1e-9
        best[better] = err[better]
        weights[better] = 0
        weights[np.ix_(better, subset)] = x[better]
    weights = weights.reshape(*target.shape)
    residual = np.einsum("ijk,lk->ijl", weights, basis) - target
    a = area(target.shape) * (land > 0.99)
    print("Earth, land: reflectance of the picture at 645, 555, 469 nm", *(f"{(a * target[..., i]).sum() / a.sum():.3f}" for i in range(3)))
    print("  weights less picture: mean", *(f"{(a * residual[..., i]).sum() / a.sum():+.4f}" for i in range(3)), " rms",
          *(f"{np.sqrt((a * residual[..., i] ** 2).sum() / a.sum()):.4f}" for i in range(3)))
    print(f"  sum of weights on land: mean {(a * weights.sum(axis=2)).sum() / a.sum():.3f}")
    save("earth-surface.png", list(np.moveaxis(weights * land[..., None], 2, 0)), ["vegetation", "soil", "snow"], 1, step=4)
    save("earth-water.png", [water], ["water"], 1, step=17)

    night = load(f"{GLOBE}/example/img/earth-night.jpg", size)
    # The picture's ground and sea are blue-green with red below 15; only lamps are red, up to 107.
    lights = np.clip((ndimage.gaussian_filter(night[..., 0], 0.5) - 17) / 88, 0, 1)
    save("earth-lights.png", [lights], ["city-lights"], 1, step=5,
         rule="The light is the square of value / 255. 1 is the centre of a great city, about 0.3 cd/m2 upward (an estimate).")

    clouds = load(f"{GLOBE}/example/clouds/clouds.png", (4096, 2048), "RGBA")[..., 3]
    clouds = clouds.reshape(1024, 2, 2048, 2).mean(axis=(1, 3)) / 255
    # The picture shows fair weather and thin clouds too thin; the power brings them up. Smaller powers show its steps.
    print(f"Earth, clouds: mean {mean(clouds):.3f} in the picture")
    save("earth-clouds.jpg", [clouds ** 0.6], ["cloud"], 1, quality=75, power=0.6)


def moon():
    grey = texture("moon_4k.jpg", (1024, 512), "L")
    highland, mare = kind("moon-highland", 550), kind("moon-mare", 550)
    # The picture's number is proportional to the albedo within its contrast: the near side's mean is the measured one.
    near = grey[:, 256:768]
    lon = (np.arange(512) + 0.5) / 512 * np.pi - np.pi / 2
    w = area(near.shape) ** 2 * np.cos(lon)
    albedo = grey * (0.57 * highland + 0.43 * mare) / ((near * w).sum() / w.sum())
    m = np.clip((highland - albedo) / (highland - mare), 0, 1)
    h = 1 - m
    over = albedo / (h * highland + m * mare)
    print(f"Moon: albedo at 550 nm, mean {mean(albedo):.3f}, 5 % below {quantile(albedo, .05):.3f}, 5 % above {quantile(albedo, .95):.3f}; "
          f"mare on the near side {(m[:, 256:768] * w).sum() / w.sum():.2f}")
    save("moon.png", [h * over, m * over], ["moon-highland", "moon-mare"], 2, step=2)


def grey_body(body, name, size, contrast, quality=88):
    rgb = texture(name, size)
    v = rgb @ [0.2126, 0.7152, 0.0722]
    v = np.clip(1 + contrast * (v / mean(v) - 1), 0, None)
    v /= mean(v)
    save(f"{body}.jpg", [v], [body], max(1.0, v.max() / 1.0), quality=quality, contrast=contrast)


def mars():
    rgb = texture("mars.png", (512, 256))
    ice = np.clip((rgb[..., 2] - 95) / 90, 0, 1) * (np.abs(np.arange(256) - 127.5)[:, None] > 80)
    red = rgb[..., 0]
    lo, hi = quantile(red, 0.02), quantile(red, 0.85)
    bright = np.clip((red - lo) / (hi - lo), 0, 1.15)
    weights = np.array([bright, np.clip(1 - bright, 0, None)]) * (1 - ice)
    v = mean(weights[0]) * kind("mars-bright", 550) + mean(weights[1]) * kind("mars-dark", 550) + mean(ice) * kind("snow", 550) * 0.6
    print(f"Mars: V before scaling {v:.3f}, ice {mean(ice):.3f}")
    weights *= 0.170 / v
    ice = ice * 0.6 * 0.170 / v
    save("mars.png", [*weights, ice], ["mars-bright", "mars-dark", "snow"], 1.25, step=2)


def jupiter():
    rgb = texture("jupiter.png", (512, 256))
    blue = rgb[..., 2]
    t = np.clip((blue - quantile(blue, 0.05)) / (quantile(blue, 0.95) - quantile(blue, 0.05)), 0, 1)
    t = t + 0.5 - mean(t)
    zone = np.clip(t, 0, 1)
    save("jupiter.png", [zone, 1 - zone], ["jupiter-zone", "jupiter-belt"], 1, step=2)


def rings():
    """Published optical depths, region by region, with the fine structure of Bjoern Jonsson's profile."""
    alpha = np.array(Image.open(f"{STELLARIUM}/textures/saturn_rings_radial.png").convert("RGBA"))[0, :, 3] / 255
    shape = -np.log(1 - np.clip(alpha, 0, 0.97))
    inner, outer = 74510.0, 140390.0
    radius = inner + (np.arange(len(alpha)) + 0.5) / len(alpha) * (outer - inner)
    # inner edge, outer edge (km), mean normal optical depth, reflectivity of the particles at 550 nm
    regions = [("C", 74490, 91975, 0.12, 0.22), ("B1", 91975, 98500, 1.1, 0.52), ("B2", 98500, 104500, 1.6, 0.56),
               ("B3", 104500, 110000, 3.5, 0.58), ("B4", 110000, 117570, 2.2, 0.58),
               ("Cassini Division", 117570, 122050, 0.11, 0.30), ("A inner", 122050, 126500, 0.80, 0.50),
               ("A middle", 126500, 133410, 0.50, 0.50), ("Encke", 133410, 133745, 0.0, 0.50),
               ("A outer", 133745, 136487, 0.55, 0.48), ("Keeler", 136487, 136522, 0.0, 0.48),
               ("A edge", 136522, 136770, 0.55, 0.48)]
    rows = []
    for name, lo, hi, tau, reflectivity in regions:
        n = max(2, round((hi - lo) / 250))
        r = lo + (np.arange(n) + 0.5) / n * (hi - lo)
        s = np.interp(r, radius, shape)
        if hi - lo < 400 or s.mean() <= 0:
            s = np.ones(n)
        s = np.clip(s / s.mean(), 0, None)
        if name == "C":
            s = s ** 2 / (s ** 2).mean()
        rows += [[round(a, 1), round(float(b), 4), reflectivity] for a, b in zip(r.tolist(), tau * s)]
    rows = [[74490.0, 0.0, 0.22]] + rows + [[136770.0, 0.0, 0.48]]
    data = {"columns": ["radius_km", "normal_optical_depth", "reflectivity_550nm"],
            "source": "Mean optical depths of the regions and gaps: rounded from Colwell et al. 2009 (in Saturn from "
                      "Cassini-Huygens, chapter 13). Fine structure within a region: Bjoern Jonsson's ring profile after "
                      "Voyager, by way of Stellarium, scaled to those means. Reflectivity: of the particles, rounded from "
                      "Dones, Cuzzi and Showalter 1993, Icarus 105, 184. Estimates; not an occultation's table.",
            "rows": rows}
    text = re.sub(r"\[\s+(-?[\d.e+-]+(?:,\s+-?[\d.e+-]+)*)\s+\]", lambda m: "[" + re.sub(r"\s+", " ", m.group(1)) + "]",
                  json.dumps(data, indent=1))
    open(os.path.join(OUT, "saturn-rings.json"), "w", encoding="utf-8").write(text + "\n")
    print(f"saturn-rings.json: {len(rows)} rows")


earth()
moon()
grey_body("mercury", "mercury.png", (512, 256), 0.8)
grey_body("venus", "venus.png", (256, 128), 0.1)
mars()
jupiter()
grey_body("saturn", "saturn.png", (512, 256), 0.7)
grey_body("uranus", "uranus.png", (256, 128), 0.3)
grey_body("neptune", "neptune.png", (512, 256), 0.3)
rings()
with open(os.path.join(OUT, "maps.json"), "w", encoding="utf-8") as f:
    json.dump({"projection": "equirectangular; row 0 is the north pole; column x's centre is longitude (x + 0.5) / width * "
                             "360 - 180 degrees, eastward", "maps": MAPS}, f, indent=1)
    f.write("\n")
print("all maps:", sum(os.path.getsize(os.path.join(OUT, n)) for n in MAPS), "bytes")
