#!/usr/bin/env python3
"""Writes the unresolved Milky Way as a panorama of V-band surface brightness.

    convert.py TEXTURE STARS OUT.png

TEXTURE  Axel Mellinger's panorama as Stellarium 0.22.2 carries it (textures/milkyway.png, 2048 x 1024).
STARS    the catalogue whose stars the exhibit draws one by one (scenes/stars/stars.txt).
OUT.png  equirectangular, equatorial J2000: column x's centre at right ascension (x + 0.5) / 2048 * 360 degrees, row
         y's centre at declination 90 - (y + 0.5) / 1024 * 180 degrees. 8-bit sRGB-coded Rec. 709; a star of the Sun's
         colour (B-V 0.65) is white. 255 is `peak`, which this program prints.

Units. S10(V): the light of one V = 10 star, spread over a square degree. S10(B): the same for the blue light of a
V = 10 star of the Sun's colour; this is the S10(G2V) at 440 nm of Leinert et al. So S10(B) = S10(V) for sunlight, and
S10(B) = S10(V) * 10^(-0.4 (B-V - 0.65)) for other light.

Needs python3-numpy, python3-pil and python3-scipy.
"""

import sys

import numpy as np
from PIL import Image
from scipy import ndimage, optimize

WIDTH, HEIGHT = 2048, 1024
DEGREE = HEIGHT / 180  # pixels per degree of declination
SUN_BV = 0.65
REC709_Y = np.array([0.2126, 0.7152, 0.0722])

# Equatorial J2000 to galactic (Hipparcos catalogue, ESA SP-1200, vol. 1, eq. 1.5.11, transposed).
GALACTIC = np.array([[-0.0548755604, -0.8734370902, -0.4838350155],
                     [+0.4941094279, -0.4448296300, +0.7469822445],
                     [-0.8676661490, -0.1980763734, +0.4559837762]])

# Pioneer 10's background starlight at 440 nm, beyond the zodiacal dust, S10(B): Leinert et al. 1998, A&AS 127, 1,
# Table 35 (after Toller 1981), as transcribed from the scanned page in github.com/Muno459/twilight. Stars brighter than
# about 6.5 are not in it; diffuse galactic light is. Rows: galactic latitude as in PIONEER_B; columns: galactic
# longitude 0, 10 ... 350, 18 to a line.
PIONEER_B = np.array([-80, -70, -60, -50, -40, -30, -24, -20, -16, -12, -8, -4, 0,
                      4, 8, 12, 16, 20, 24, 30, 40, 50, 60, 70, 80])
PIONEER_L = np.arange(0, 360, 10)
PIONEER = np.array("""
 34  32  30  32  29  33  35  31  28  34  31  26  26  30  27  26  27  30
 33  32  28  26  26  27  27  27  28  29  28  29  29  25  25  28  28  30
 32  28  33  35  39  32  32  34  35  31  24  34  33  30  30  36  33  32
 32  32  30  30  32  30  26  26  33  29  26  25  32  29  29  31  34  35
 39  41  41  39  37  35  41  46  36  33  35  35  32  34  35  35  43  34
 36  34  31  30  33  36  37  38  33  38  42  45  42  40  38  35  36  32
 45  48  49  43  47  49  39  46  41  43  39  37  36  41  45  42  40  44
 40  45  42  39  43  38  38  40  41  40  39  44  43  50  48  38  45  51
 56  68  53  57  63  56  57  63  46  46  48  44  48  45  41  46  47  46
 51  50  56  48  52  46  42  47  52  55  58  55  68  58  62  59  61  58
 78  87  76  77  80  88  68  71  64  60  65  73  53  67  64  57  60  61
 67  65  70  74  69  57  63  66  85  81 213  68  73  78  74  85  81  82
 99 111  96  89  90  88  91  84  81  87  80  74  83  84  78  81  69  77
 67  77  97 122  91  79  91  86 113  95  87  94  94  97 103 101 108 114
120 133 124 105 101 124 105  94 103 105  93  95 108  97  95  78  84  79
 53  90 119 122 109 109 106 101 115 119 116 107 103 116 135 130 133 156
190 176 176 123 111 131 142 112 113 109 120 125 114 124 116 115  73  60
 73 105 130 141 121 131 139 136 143 146 128 140 112 166 176 176 180 204
320 204 221 143 145 186 187 162 163 148 151 157 158 144 129 135 104  63
103 117 139 130 144 208 169 163 197 169 194 197 156 196 242 234 228 281
484 283 224 172 180 219 237 198 230 186 235 205 191 182 150 150  99  77
 81 146 156 188 185 254 262 208 288 239 276 258 246 239 292 309 320 379
569 371 223 172 186 256 244 210 231 262 326 224 215 223 133 119 120 108
128 190 221 182 229 255 282 219 258 246 369 351 323 376 306 467 270 318
290 275 182 100 122 151 187 275 219 221 247 177 199 174 132 125 148 195
180 182 209 251 278 272 342 302 239 177 338 634 354 446 248 314 289 278
147 210 111  87 186 169 220 342 216 156 160 153 124 136 138 108 166 171
182 191 199 222 263 261 274 294 207 181 280 441 356 337 251 279 151 251
164 222  77 107 209 175 223 242 220 195 140 136 111  96  96 102 133 142
147 184 186 189 186 193 197 202 169 181 204 227 238 192 197 247 127 208
169 142  81 167 163 155 170 174 169 160 116 124 115  95  91  84 107 129
134 146 154 149 149 143 147 126 131 142 144 159 173 208 175 209 158 182
 97  84  75 121 125 133 130 144 139 126  98  84 104  89 101  95  93  99
105 100 112 125 118 112 106  99 111 111 131 114 145 174 141 172 121 168
 85  68  71 102 104 102  99 114  95  91  83  74  86  90  92  79  97  87
 89  92 100  97  94  92  89  86  87  93  90  95  93 117 122 125 113 146
 92  72  68  85  86  90  84  85  80  86  73  75  79  73  70  72  75  81
 77  81  81  81  80  80  80  80  75  73  82  84  80  95  95  99  87 106
 68  63  71  66  63  67  74  72  61  66  73  61  57  61  60  58  61  56
 62  62  62  62  61  61  61  61  72  61  64  64  62  67  74  80  73  76
 47  56  50  53  50  44  52  48  41  49  47  44  44  41  51  41  44  51
 51  53  56  58  60  63  65  53  56  51  49  51  47  57  52  48  47  48
 44  43  44  32  41  38  39  39  35  27  40  39  33  37  37  45  37  44
 49  53  58  63  67  72  63  53  45  46  44  41  42  50  64  46  46  42
 37  38  36  30  32  33  33  30  36  39  40  34  34  35  33  31  32  40
 45  42  45  49  57  53  52  53  55  39  42  39  32  38  35  34  38  37
 36  40  32  31  33  27  29  30  33  31  30  28  24  27  28  30  35  35
 35  36  36  36  40  42  42  45  43  35  36  40  35  35  30  32  32  33
 29  27  29  30  28  27  27  30  31  32  35  31  28  29  30  29  28  29
 31  30  29  29  31  32  31  31  30  30  30  31  33  29  25  25  29  31
""".split(), float).reshape(len(PIONEER_B), len(PIONEER_L))
# Pioneer 10 did not map these cells; the table at hand has them filled by interpolation along the row. Columns and rows
# of the rectangle that holds them.
UNMAPPED = (PIONEER_L >= 170) & (PIONEER_L <= 260), (PIONEER_B >= 16) & (PIONEER_B <= 60)
PIONEER_LIMIT = 6.5  # magnitude: brighter stars are not in it
BEAM = 2.3 / 2.355  # Pioneer's resolution, about 2.3 degrees, as a Gaussian's sigma

# Pioneer 10 at 440 and 640 nm, read from its isophote maps: Leinert et al. 1998, Table 34. Not used for the fit.
POLES = [("north galactic pole", 192.859, 27.128, 29, 31), ("south galactic pole", 12.859, -27.128, 33, None),
         ("north celestial pole", 0, 90, 56, 77), ("south celestial pole", 0, -90, 74, 94),
         ("north ecliptic pole", 270, 66.561, 66, 82), ("south ecliptic pole", 90, -66.561, 128, 125)]

# Compact objects of the picture: J2000 position and the radius (degrees) within which only the catalogue's own stars
# are taken out. Their light is that of stars fainter than the catalogue's, or of gas. Positions: Stellarium's deep-sky
# catalogue.
COMPACT = [("M42", 83.822, -5.391, 0.9), ("NGC 6397", 265.175, -53.674, 0.35), ("NGC 6752", 287.717, -59.985, 0.35),
           ("NGC 2516", 119.517, -60.753, 0.35), ("NGC 4755", 193.412, -60.362, 0.35),
           ("NGC 869", 34.75, 57.128, 0.35), ("NGC 884", 35.596, 57.125, 0.35), ("NGC 3293", 158.955, -58.23, 0.35),
           ("NGC 2070", 84.675, -69.1, 0.35), ("NGC 6231", 253.535, -41.827, 0.35),
           ("NGC 3114", 150.65, -60.12, 0.35), ("NGC 3766", 174.075, -61.615, 0.35), ("M35", 92.225, 24.333, 0.35),
           ("NGC 6193", 250.333, -48.763, 0.35), ("NGC 457", 19.896, 58.287, 0.35),
           ("NGC 2477", 118.042, -38.53, 0.35), ("M20", 270.675, -22.972, 0.35), ("NGC 2244", 97.979, 4.942, 0.35),
           ("M25", 277.946, -19.117, 0.35), ("M6", 265.083, -32.253, 0.35), ("M7", 268.463, -34.793, 0.8),
           ("M47", 114.146, -14.483, 0.35), ("M46", 115.442, -14.81, 0.35), ("NGC 7789", 359.35, 56.708, 0.35),
           ("NGC 6124", 246.333, -40.653, 0.35), ("NGC 6087", 244.708, -57.935, 0.35),
           ("M23", 269.267, -18.985, 0.35), ("M37", 88.075, 32.553, 0.35), ("M50", 105.698, -8.338, 0.35),
           ("NGC 6025", 240.821, -60.432, 0.35), ("IC 5076", 314.0, 47.4, 0.35), ("NGC 6940", 308.608, 28.283, 0.35),
           ("M48", 123.429, -5.75, 0.35), ("M39", 322.95, 48.433, 0.35), ("M11", 282.771, -6.27, 0.35),
           ("M4", 245.897, -26.526, 0.35), ("M34", 40.521, 42.762, 0.35), ("NGC 5662", 218.904, -56.618, 0.35),
           ("NGC 2362", 109.671, -24.955, 0.35), ("NGC 2301", 102.938, 0.46, 0.35),
           ("NGC 6541", 272.01, -43.715, 0.35), ("M93", 116.125, -23.857, 0.35),
           ("NGC 2360", 109.429, -15.642, 0.35), ("M36", 84.075, 34.14, 0.35), ("M38", 82.179, 35.855, 0.35),
           ("M81", 148.888, 69.065, 0.35), ("NGC 5128", 201.365, -43.019, 0.35), ("M22", 279.1, -23.905, 0.35),
           ("M55", 294.999, -30.965, 0.35), ("NGC 104", 6.022, -72.081, 0.7), ("NGC 5139", 201.697, -47.479, 0.55),
           ("NGC 362", 15.809, -70.849, 0.35), ("M13", 250.423, 36.461, 0.35), ("NGC 253", 11.888, -25.289, 0.35),
           ("M5", 229.638, 2.081, 0.35), ("M3", 205.548, 28.377, 0.35), ("M15", 322.493, 12.167, 0.35),
           ("M2", 323.363, -0.823, 0.35), ("M92", 259.281, 43.136, 0.35), ("NGC 2808", 138.013, -64.863, 0.35),
           ("NGC 3372", 161.079, -59.889, 1.2), ("NGC 3532", 166.413, -58.753, 0.5),
           ("IC 2602", 160.742, -64.4, 1.0), ("NGC 2264", 100.242, 9.895, 0.35), ("M16", 274.7, -13.807, 1.2),
           ("M17", 275.196, -16.172, 0.4), ("M44", 130.1, 19.667, 0.7), ("M31", 10.685, 41.269, 1.5),
           ("M33", 23.462, 30.66, 0.69)]

# For these the centroid is that of a wide, lopsided object: reported, not fitted. Radius of the centroid in degrees.
EXTENDED = [("M31", 10.685, 41.269, 0.5), ("LMC", 80.894, -69.756, 3.0), ("SMC", 13.187, -72.829, 1.5),
            ("M33", 23.462, 30.660, 0.4), ("M45", 56.75, 24.117, 0.5), ("M8", 270.904, -24.378, 0.4),
            ("M24", 274.2, -18.55, 0.8)]

# Galaxies that the eye sees: place, radius, V magnitude and B-V (RC3: de Vaucouleurs et al. 1991).
GALAXIES = [("LMC", 80.3, -69.2, 5.5, 0.40, 0.51), ("SMC", 13.4, -72.8, 2.2, 2.25, 0.45),
            ("M31", 10.685, 41.27, 1.7, 3.44, 0.92)]


def unit(ra, dec):
    """Direction of a right ascension and declination (degrees)."""
    ra, dec = np.broadcast_arrays(np.radians(ra), np.radians(dec))
    return np.stack([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra), np.sin(dec)], -1)


def angles(v):
    """Longitude (0 ... 360) and latitude of a direction, degrees."""
    return np.degrees(np.arctan2(v[..., 1], v[..., 0])) % 360, np.degrees(np.arcsin(np.clip(v[..., 2], -1, 1)))


def from_galactic(l, b):
    return angles(unit(l, b) @ GALACTIC)


def pixel(ra, dec):
    """Column and row (fractions; whole numbers are pixel centres) of the output."""
    return np.asarray(ra) % 360 / 360 * WIDTH - 0.5, (90 - np.asarray(dec)) * DEGREE - 0.5


def sample(image, ra, dec):
    x, y = np.atleast_1d(*pixel(ra, dec))
    padded = np.concatenate([image[:, -1:], image, image[:, :1]], 1)
    return ndimage.map_coordinates(padded, [y, x + 1], order=1, mode="nearest")


def pixel_shares():
    """Each pixel's share of the whole sky."""
    area = np.cos(np.radians(90 - (np.arange(HEIGHT) + 0.5) / DEGREE))[:, None] * np.ones(WIDTH)
    return area / area.sum()


def smooth(image, sigma):
    """Gaussian of `sigma` degrees on the sphere: wider in columns towards the poles, and across them."""
    dec = 90 - (np.arange(HEIGHT) + 0.5) / DEGREE
    columns = np.minimum(sigma * DEGREE / np.cos(np.radians(dec)), WIDTH / 4)
    frequency = np.fft.rfftfreq(WIDTH)
    rows = np.fft.irfft(np.fft.rfft(image, axis=1) * np.exp(-2 * (np.pi * frequency * columns[:, None])**2), WIDTH, 1)
    rim = int(4 * sigma * DEGREE) + 2
    beyond = lambda part: np.roll(part[::-1], WIDTH // 2, 1)
    padded = np.concatenate([beyond(rows[:rim]), rows, beyond(rows[-rim:])])
    return ndimage.gaussian_filter1d(padded, sigma * DEGREE, 0)[rim:-rim]


def smooth_all(image, sigma):
    return np.stack([smooth(image[..., i], sigma) for i in range(image.shape[-1])], -1)


def disc(ra, dec, radius):
    """Rows, columns and distances (degrees) of the pixels within `radius` of a place."""
    _, y = pixel(ra, dec)
    rows = np.arange(max(0, int(y - radius * DEGREE) - 1), min(HEIGHT, int(y + radius * DEGREE) + 3))
    cosine = max(np.cos(np.radians(np.minimum(90, abs(dec) + radius))), 1e-3)
    half = min(int(radius / cosine * DEGREE) + 2, WIDTH // 2 - 1)
    columns = (int(round(float(pixel(ra, dec)[0]))) + np.arange(-half, half + 1)) % WIDTH
    v = unit((columns[None, :] + 0.5) / WIDTH * 360, 90 - (rows[:, None] + 0.5) / DEGREE)
    distance = np.degrees(np.arccos(np.clip(v @ unit(ra, dec), -1, 1)))
    near = distance <= radius
    r, c = np.nonzero(near)
    return rows[r], columns[c], distance[near]


def centroid(image, ra, dec, search, radius):
    """The direction of the light's centroid about the brightest pixel within `search`, and that pixel's value."""
    r, c, _ = disc(ra, dec, search)
    best = image[r, c].argmax()
    top = (c[best] + 0.5) / WIDTH * 360, 90 - (r[best] + 0.5) / DEGREE
    for _ in range(3):
        rr, cc, _ = disc(*top, radius)
        weight = np.maximum(image[rr, cc], 0) * np.cos(np.radians(90 - (rr + 0.5) / DEGREE))
        if weight.sum() == 0:
            break
        v = (unit((cc + 0.5) / WIDTH * 360, 90 - (rr + 0.5) / DEGREE) * weight[:, None]).sum(0)
        top = angles(v / np.linalg.norm(v))
    return unit(*top), image[r, c].max()


def check_orientation(image, stars):
    """Prints how far compact objects and what is left of stars lie from their catalogue places."""
    light = image.mean(-1)
    detail = light - ndimage.median_filter(np.pad(light, ((0, 0), (30, 30)), "wrap"), 15)[:, 30:-30]

    def report(title, places):
        true, seen, names = [], [], []
        for name, ra, dec, radius in places:
            v, top = centroid(detail, ra, dec, 0.5, radius)
            true.append(unit(ra, dec)), seen.append(v), names.append(name)
        true, seen = np.array(true), np.array(seen)
        off = lambda a, b: np.degrees(2 * np.arcsin(np.linalg.norm(a - b, axis=-1) / 2))
        # A neighbour may be the brightest within the search: such are left out, and named.
        wrong = off(true, seen) > 5 * np.median(off(true, seen))
        left_out = [n for n, w in zip(names, wrong) if w]
        true, seen, names = true[~wrong], seen[~wrong], [n for n, w in zip(names, wrong) if not w]
        u, _, vt = np.linalg.svd(true.T @ seen)
        free = u @ vt  # without the usual sign: the fit itself decides whether the picture is mirrored
        turn = np.degrees(np.arccos(np.clip((np.trace(free) - 1) / 2, -1, 1)))
        as_is, fitted = off(true, seen), off(true, seen @ free.T)
        rms = lambda x: np.sqrt((x**2).mean())
        print(f"{title}: {len(true)}; best orthogonal map has determinant {np.linalg.det(free):+.0f} and turns "
              f"{turn:.3f} degrees; residual rms {rms(as_is):.3f} (with that turn {rms(fitted):.3f}), "
              f"median {np.median(as_is):.3f}, worst {as_is.max():.3f} ({names[as_is.argmax()]}); "
              f"left out: {', '.join(left_out) or 'none'}")
        return list(zip(names, as_is))

    each = report("compact objects", COMPACT)
    print("   " + ", ".join(f"{n} {d:.2f}" for n, d in each))
    left = []
    for ra, dec, v, _ in stars:
        if abs(dec) < 75 and v < 6:
            r, c, _ = disc(ra, dec, 0.3)
            crowd = (np.hypot((stars[:, 0] - ra) * np.cos(np.radians(dec)), stars[:, 1] - dec) < 1).sum() > 1
            if detail[r, c].max() > 20 and not crowd and not protected(ra, dec):
                left.append((f"V{v:.2f} at {ra:.1f} {dec:+.1f}", ra, dec, 0.35))
    report("remains of catalogue stars", left)
    for name, ra, dec, radius in EXTENDED:
        v, _ = centroid(light, ra, dec, radius / 3, radius)
        there = angles(v)
        print(f"   {name}: centroid at {there[0]:.2f} {there[1]:+.2f}, catalogue {ra:.2f} {dec:+.2f}, "
              f"{np.degrees(np.arccos(v @ unit(ra, dec))):.2f} degrees off")


def protected(ra, dec):
    return any(unit(ra, dec) @ unit(r, d) > np.cos(np.radians(radius)) for _, r, d, radius in COMPACT)


def move_47_tucanae(image):
    """Puts 47 Tucanae's light where the cluster is: Stellarium's texture has it 0.2 degrees off (its issue 2420)."""
    ra, dec = next(o[1:3] for o in COMPACT if o[0] == "NGC 104")
    light = image.mean(-1)
    v, _ = centroid(light - np.median(light[disc(ra, dec, 0.8)[:2]]), ra, dec, 0.4, 0.35)
    r, c, d = disc(*angles(v), 0.75)
    rim = d > 0.5
    around = np.median(image[r[rim], c[rim]], 0)
    inside = np.clip((0.6 - d) / 0.15, 0, 1)[:, None]
    over = (image[r, c] - around) * inside
    result = image.copy()
    result[r, c] -= over
    r, c, d = disc(ra, dec, 0.7)
    profile = np.exp(-0.5 * (d / 0.14)**2)  # as wide as in the texture
    result[r, c] += profile[:, None] / profile.sum() * over.sum(0)
    return result


def remove_stars(image, stars):
    """Replaces what is left of stars by their surroundings.

    Stellarium's texture had most of each star removed already. What is left is 5 to 11 steps of 255 within 0.3
    degrees (found by adding up the places of all catalogue stars); many other points stand out too.
    """
    light = image @ np.array([0.25, 0.5, 0.25])
    around = smooth(light, 0.7)
    small = smooth(light, 0.12) - smooth(light, 0.45)
    grain = 0.5 + 0.035 * around  # measured: the spread of `small` at |b| > 10
    keep = np.zeros(light.shape, bool)
    for _, ra, dec, radius in COMPACT:
        r, c, _ = disc(ra, dec, radius)
        keep[r, c] = True
    spot = np.zeros(light.shape, bool)
    touched = 0
    for ra, dec, v, _ in stars:
        radius = 0.3 if v > 4 else 0.4 if v > 2 else 0.6
        r, c, _ = disc(ra, dec, radius)
        if np.abs(small[r, c]).max() > 1.5 * grain[r, c].mean():
            spot[r, c] = True
            touched += 1
    # The Orion nebula outshines the catalogue's stars within it.
    r, c, _ = disc(*COMPACT[0][1:3], 0.5)
    spot[r, c] = False
    # Other points: peaks narrower than 0.3 degrees, three times above the grain; and, where no dust clouds are, the
    # holes that the removal of stars left in the texture.
    points = (small == ndimage.maximum_filter(small, 5)) & (small > 3 * grain)
    points |= (small == ndimage.minimum_filter(small, 5)) & (small < -3 * grain) & (around < 40)
    points &= ~spot & ~keep
    others = np.zeros(light.shape, bool)
    for y, x in zip(*np.nonzero(points)):
        r, c, _ = disc((x + 0.5) / WIDTH * 360, 90 - (y + 0.5) / DEGREE, 0.28)
        others[r, c] = True
    spot |= others & ~keep
    print(f"stars taken out: {touched} of {len(stars)} catalogue places had something left; {points.sum()} other "
          f"points; {100 * (spot * pixel_shares()).sum():.1f} % of the sky refilled")
    # Fill with the mean of the unspotted surroundings, nearest first.
    result = image.copy()
    hole = spot
    for sigma in (0.25, 0.5, 1.0):
        weight = smooth((~spot).astype(float), sigma)
        known = smooth_all(image * ~spot[..., None], sigma) / np.maximum(weight, 1e-9)[..., None]
        good = hole & (weight > 0.15)
        result[good] = known[good]
        hole = hole & ~good
    return result


def remove_grain(image):
    """Shrinks detail finer than 0.7 degrees that is no larger than the sensor's grain.

    Colour carries more grain and less structure than brightness: it is smoothed to 0.25 degrees.
    """
    light = image @ np.array([0.25, 0.5, 0.25])
    scales = [smooth(light, s) for s in (0.09, 0.18, 0.36, 0.72)]
    result = scales[-1]
    grain = 0.35 + 0.02 * np.minimum(scales[-1], 60)
    for fine, coarse, factor in zip(scales, scales[1:], (1.5, 1.0, 0.5)):
        band = fine - coarse
        result = result + np.sign(band) * np.maximum(np.abs(band) - factor * grain, 0)
    result = np.maximum(result, 0)
    # Where the picture is dim, one channel is cut off at black before the next: there only the broad run of colour is
    # kept, 1.5 degrees.
    trust = smooth(light, 0.25)
    trust = np.clip((trust - 5) / 15, 0, 1)[..., None]
    wide = trust * smooth_all(image, 0.25) + (1 - trust) * smooth_all(image, 1.5)
    wide_light = np.maximum(wide @ np.array([0.25, 0.5, 0.25]), 0)
    # Near black the colour is that of the grain, so it fades to white there; the calibration adds light anyway.
    return result[..., None] * (wide + 0.5) / (wide_light + 0.5)[..., None]


# Colour: B-V of light to linear Rec. 709, relative to light of the Sun's B-V, by black bodies.

def blackbody_rgb(bv):
    """Linear Rec. 709 with luminance 1, of light of a B-V; the Sun's is (1, 1, 1).

    Temperature: Ballesteros 2012, EPL 97, 34008. Colour matching: Wyman, Sloan and Shirley 2013, JCGT 2(2).
    """
    nm = np.arange(380.0, 781.0, 5.0)
    lobe = lambda m, s1, s2: np.exp(-0.5 * ((nm - m) / np.where(nm < m, s1, s2))**2)
    xyz = np.stack([1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
                    0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
                    1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)])
    rec709 = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])

    def rgb(x):
        kelvin = 4600 * (1 / (0.92 * x + 1.7) + 1 / (0.92 * x + 0.62))
        return rec709 @ xyz @ (nm**-5 / np.expm1(1.4388e7 / (nm * kelvin)))

    ratio = rgb(bv) / rgb(SUN_BV)
    return ratio / (ratio @ REC709_Y)


BV_GRID = np.linspace(-0.3, 2.0, 47)
BV_RATIO = np.array([np.log(c[2] / c[0]) for c in map(blackbody_rgb, BV_GRID)])
BV_GREEN = np.array([np.log(c[1] / np.sqrt(c[0] * c[2])) for c in map(blackbody_rgb, BV_GRID)])


def greenness(rgb):
    """The logarithm of green to what a black body of the same ratio of blue to red has."""
    log = np.log(np.maximum(rgb, 1e-9))
    return log[..., 1] - (log[..., 0] + log[..., 2]) / 2 - np.interp(colour_index(rgb), BV_GRID, BV_GREEN)


def colour_index(rgb):
    """B-V of light by its ratio of blue to red."""
    ratio = np.log(np.maximum(rgb[..., 2], 1e-9) / np.maximum(rgb[..., 0], 1e-9))
    return np.interp(-ratio, -BV_RATIO, BV_GRID)


def light_of_stars(stars):
    """The catalogue's stars that Pioneer's map holds too, S10(V) and S10(B), spread over its beam."""
    faint = stars[stars[:, 2] >= PIONEER_LIMIT]
    x, y = pixel(faint[:, 0], faint[:, 1])
    places = np.clip(np.rint(y).astype(int), 0, HEIGHT - 1), np.rint(x).astype(int) % WIDTH
    maps = []
    for magnitude in (faint[:, 2], faint[:, 2] + faint[:, 3] - SUN_BV):
        light = np.zeros((HEIGHT, WIDTH))
        np.add.at(light, places, 10**(-0.4 * (magnitude - 10)))
        maps.append(smooth(light / (np.cos(np.radians(90 - (np.arange(HEIGHT) + 0.5) / DEGREE)) / DEGREE**2)[:, None], BEAM))
    return maps


WHOLE_SKY_BV = 0.80     # see report.md; Pioneer's 440 and 640 nm at the poles of Table 34 give 0.65 + 0.11 ... 0.19
BACKGROUND_BV = 0.75    # of the light the texture has clipped to black
TONE_POWER = 1.1        # of the code value; powers from 0.9 to 1.2 fit Pioneer alike, this one its brightest places too
GAIN_SIGMA = 4.5, 10.0  # degrees, of the smooth correction: near the plane, and elsewhere
REMOVED_LIMIT = 7       # magnitude: what is left of brighter stars in the texture is taken out one by one
SATURATION = 0.45       # the texture's colours are far stronger than those of starlight


def calibrate(image, stars):
    """The picture (0 ... 255) as linear Rec. 709 whose luminance is S10(V)."""
    area = pixel_shares()
    x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    l, b = angles(unit((x + 0.5) / WIDTH * 360, 90 - (y + 0.5) / DEGREE) @ GALACTIC.T)
    node_l, node_b = np.meshgrid(PIONEER_L, PIONEER_B)
    node_ra, node_dec = from_galactic(node_l, node_b)
    measured = np.ones(PIONEER.shape, bool)
    measured[np.ix_(UNMAPPED[1], UNMAPPED[0])] = False
    clouds = (unit(node_ra, node_dec) @ unit(80.9, -69.8) > np.cos(np.radians(6))) \
        | (unit(node_ra, node_dec) @ unit(13.2, -72.8) > np.cos(np.radians(4)))
    used = measured & ~clouds
    stars_v, stars_b = (sample(light, node_ra, node_dec) for light in light_of_stars(stars))
    # The colour of what is left of the whole sky without the catalogue's stars.
    whole_v = PIONEER * 10**(0.4 * (WHOLE_SKY_BV - SUN_BV))
    rest_bv = SUN_BV - 2.5 * np.log10(node_mean(np.maximum(PIONEER - stars_b, 0)) / node_mean(np.maximum(whole_v - stars_v, 0)))
    print(f"the catalogue's stars beyond {PIONEER_LIMIT}: S10(B) {node_mean(stars_b):.1f} of {node_mean(PIONEER):.1f}; "
          f"what is left has B-V {rest_bv:.2f}")

    # The tone curve: a power of the code value over a black level (report.md). The background below that level is a
    # smooth function of latitude.
    soft = lambda scale: np.exp(-(np.hypot(b, 8) - 8) / scale)
    terms = [np.ones(b.shape), soft(12), soft(35)]
    light = 255 * (image @ np.array([0.25, 0.5, 0.25]) / 255)**TONE_POWER
    smoothed = [sample(smooth(t, BEAM), node_ra, node_dec) for t in terms + [light]]
    error = 0.08 * PIONEER + 4  # Pioneer's own: 2 to 3 S10, 5 in the Milky Way, and its beam on uneven ground

    chroma = None
    bv_nodes = np.full(PIONEER.shape, rest_bv)
    background = blackbody_rgb(BACKGROUND_BV)
    for _ in range(4):
        # Where few bright stars of the catalogue crowd into a beam, a quarter is left.
        target = np.maximum(PIONEER - stars_b, 0.25 * PIONEER) * 10**(0.4 * (bv_nodes - SUN_BV))
        matrix = np.stack(smoothed, -1)
        k, _ = optimize.nnls(matrix[used] / error[used][:, None], target[used] / error[used])
        base = sum(w * t for w, t in zip(k, terms))
        value = base + k[-1] * light
        # Balance the channels, tone the colours down, then add the background's own colour.
        if chroma is None:
            total = (image * area[..., None]).sum((0, 1))
            balanced = image / total * (total @ np.array([0.25, 0.5, 0.25])) * blackbody_rgb(rest_bv)
        mixed = k[-1] * balanced + base[..., None] * background
        chroma = np.maximum(mixed, 1e-3) / np.maximum(mixed @ REC709_Y, 1e-3)[..., None]
        # Geometric: scales the logarithm of each channel's ratio, so that B-V scales about the mean.
        centre = blackbody_rgb(rest_bv)
        chroma = centre * (chroma / centre)**SATURATION
        # No starlight is green, but the texture's dim parts are where one channel is clipped before the next.
        # Magenta is that of glowing hydrogen: most of it is kept.
        green = greenness(chroma)
        chroma[..., 1] *= np.exp(-np.where(green > 0, 0.8, 0.2) * green)
        chroma /= (chroma @ REC709_Y)[..., None]
        # Smooth correction of the brightness: the logarithm of Pioneer's ratio to ours, averaged over some degrees;
        # fewer near the plane, where the table's rows are close and its noise is small beside the light.
        ours = sample(smooth(value, BEAM), node_ra, node_dec)
        ratio = np.log(target / ours)
        weight = used * (target / error)**2 * np.cos(np.radians(node_b)) * np.gradient(PIONEER_B)[:, None]
        gain = [sphere_mean(ratio, weight, unit(node_ra, node_dec), sigma) for sigma in GAIN_SIGMA]
        plane = np.exp(-(b / 16)**4)
        gain = plane * gain[0] + (1 - plane) * gain[1]
        value = value * np.exp(gain)
        # Shift the colours so that the whole sky's is as stated.
        rgb = chroma * value[..., None]
        sky = (rgb * area[..., None]).sum((0, 1))
        chroma = chroma * (centre / (sky / (sky @ REC709_Y)))
        chroma /= (chroma @ REC709_Y)[..., None]
        rgb = chroma * value[..., None]
        bv_nodes = colour_index(np.stack([sample(smooth(rgb[..., i], BEAM), node_ra, node_dec) for i in range(3)], -1))
    print(f"tone: S10(V) = {k[-1] * 255:.1f} (code / 255)^{TONE_POWER} + {k[0]:.1f} + {k[1]:.1f} exp(-|b|/12) "
          f"+ {k[2]:.1f} exp(-|b|/35), |b| rounded off over 8 degrees; then a smooth factor of "
          f"{np.exp(gain.min()):.2f} to {np.exp(gain.max()):.2f}, rms {np.sqrt((gain**2 * area).sum()):.3f} in its "
          "logarithm")
    return rgb, used


def restore_galaxies(rgb):
    """Scales what stands over its surroundings in three galaxies, so that their light is that of their V magnitude.

    The texture's black level has cut off their outskirts, and its making (the removal of stars) half of the rest.
    """
    light = rgb @ REC709_Y
    result = rgb.copy()
    for name, ra, dec, radius, magnitude, bv in GALAXIES:
        r, c, d = disc(ra, dec, radius)
        ring, ring_c, ring_d = disc(ra, dec, 1.25 * radius)
        outside = ring_d > radius
        around = np.median(rgb[ring[outside], ring_c[outside]], 0)
        pixel_area = np.cos(np.radians(90 - (r + 0.5) / DEGREE)) / DEGREE**2
        inside = np.clip(2.5 * (1 - d / radius), 0, 1)
        inside = inside * inside * (3 - 2 * inside)
        over = np.maximum(rgb[r, c] - around, 0) * inside[:, None]
        flux = ((light[r, c] - around @ REC709_Y) * pixel_area).sum()
        added = (10**(-0.4 * (magnitude - 10)) - flux) / ((over @ REC709_Y) * pixel_area).sum()
        # ... and its colour that of the published B-V.
        colour = over.sum(0) / (over.sum(0) @ REC709_Y)
        result[r, c] += (1 + added) * over * blackbody_rgb(bv) / colour - over
        seen = 10 - 2.5 * np.log10(flux)
        print(f"{name}: V {seen:.2f} in the picture, {magnitude} published: "
              f"detail times {1 + added:.2f}")
    return result


def sphere_mean(values, weights, places, sigma):
    """Weighted mean of scattered values under a Gaussian of `sigma` degrees, at every pixel."""
    rows, columns = 91, 180
    dec = np.linspace(90, -90, rows)
    grid = unit(np.arange(columns) * 2.0 % 360, dec[:, None] * np.ones(columns))
    distance2 = 2 - 2 * np.tensordot(grid, places.reshape(-1, 3), (-1, -1))
    kernel = np.exp(-0.5 * distance2 / np.radians(sigma)**2) * weights.ravel()
    coarse = (kernel @ values.ravel()) / np.maximum(kernel.sum(-1), 1e-12)
    coarse = np.concatenate([coarse, coarse[:, :1]], 1)
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    return ndimage.map_coordinates(coarse, [(y + 0.5) / DEGREE / 2, (x + 0.5) / WIDTH * columns], order=1)


def node_mean(values):
    """The mean over the sky of values at Table 35's nodes."""
    bounds = np.concatenate([[-90], (PIONEER_B[1:] + PIONEER_B[:-1]) / 2, [90]])
    return (values * np.diff(np.sin(np.radians(bounds)))[:, None]).sum() / 2 / 36


def tables(rgb, used, stars):
    """Prints the outcome beside the published values."""
    area = pixel_shares()
    beam = np.stack([smooth(rgb[..., i], BEAM) for i in range(3)], -1)

    def at(ra, dec):
        c = np.stack([sample(beam[..., i], ra, dec) for i in range(3)], -1)
        v, bv = np.squeeze(c @ REC709_Y), np.squeeze(colour_index(c))
        return v, bv, v * 10**(-0.4 * (bv - SUN_BV))

    stars_v, stars_b = light_of_stars(stars)
    luminance = rgb @ REC709_Y
    node_l, node_b = np.meshgrid(PIONEER_L, PIONEER_B)
    node_ra, node_dec = from_galactic(node_l, node_b)
    blue = at(node_ra, node_dec)[2] + sample(stars_b, node_ra, node_dec)
    print("whole sky, S10: V mean %.1f without stars; B at Table 35's nodes: ours with stars %.1f, published %.1f; B-V %.2f" % (
        (luminance * area).sum(), node_mean(blue), node_mean(PIONEER),
        colour_index((rgb * area[..., None]).sum((0, 1)))))
    ratio = np.log(blue / PIONEER)[used]
    print(f"Table 35, {used.sum()} nodes: ours / published: mean {np.exp(ratio.mean()):.3f}, spread {ratio.std():.3f}")
    print("by latitude, mean over longitude, S10(B) ours/published: " + ", ".join(
        f"{lat:+d}: {o:.0f}/{p:.0f}" for lat, o, p in zip(PIONEER_B, blue.mean(1), PIONEER.mean(1))))

    def published(l, b):
        i = np.interp(b, PIONEER_B, np.arange(len(PIONEER_B)))
        padded = np.concatenate([PIONEER, PIONEER[:, :1]], 1)
        return ndimage.map_coordinates(padded, [np.atleast_1d(i), np.atleast_1d(l / 10)], order=1, mode="nearest")[0]

    print("  l    b  S10(V)  B-V  S10(B) ours published")
    for l, b in [(l, 0) for l in range(0, 360, 30)] + [(l, b) for l in (0, 180) for b in range(-90, 91, 15)]:
        v, bv, own_b = at(*from_galactic(l, b))
        with_stars = own_b + sample(stars_b, *from_galactic(l, b))[0]
        note = "" if b in PIONEER_B else " (interpolated)"
        if UNMAPPED[0][l // 10] and PIONEER_B[UNMAPPED[1]].min() <= b <= PIONEER_B[UNMAPPED[1]].max():
            note = " (not mapped by Pioneer)"
        print(f"{l:4d} {b:+4d} {v:7.0f} {bv:5.2f} {with_stars:7.0f} "
              f"{published(l, b):9.0f}{note}")
    print("poles of Table 34: S10(V) ours, published (from B and R), B ours, published")
    for name, ra, dec, blue_there, red_there in POLES:
        v, bv, own_b = at(ra, dec)
        visual = blue_there * (red_there / blue_there)**0.55 if red_there else float("nan")
        with_v, with_b = v + sample(stars_v, ra, dec)[0], own_b + sample(stars_b, ra, dec)[0]
        print(f"  {name}: {with_v:.0f}, {visual:.0f}; {with_b:.0f}, {blue_there}")
    order = np.argsort(np.where(used, PIONEER, 0), None)[::-1][:8]
    print("brightest nodes of Table 35, S10(B) ours/published: " + ", ".join(
        f"l {node_l.flat[i]} b {node_b.flat[i]:+d}: {blue.flat[i]:.0f}/{PIONEER.flat[i]:.0f}" for i in order))
    print("|b| = 80, mean S10(B) ours/published: %.1f/%.1f" % (blue[[0, -1]].mean(), PIONEER[[0, -1]].mean()))
    i = 36 * list(PIONEER_B).index(-30) + 28
    print(f"by the LMC, l 280 b -30 (not fitted), S10(B) ours/published: {blue.flat[i]:.0f}/{PIONEER.flat[i]:.0f}")
    i = np.argmax(beam @ REC709_Y)
    ra, dec = (i % WIDTH + 0.5) / WIDTH * 360, 90 - (i // WIDTH + 0.5) / DEGREE
    print("brightest beam of 2.3 degrees: S10(V) %.0f at l %.0f b %+.0f; darkest %.0f" % (
        (beam @ REC709_Y).max(), *angles(unit(ra, dec) @ GALACTIC.T), (beam @ REC709_Y).min()))
    print("single pixels, S10(V): " + ", ".join(f"{p} %: {np.percentile(luminance, p):.0f}" for p in
                                              (0, 1, 10, 50, 90, 99, 99.9, 99.99, 100)))


def main(texture, catalogue, out):
    # The texture shows the sky from within: right ascension 90 degrees at its left edge, falling to the right. Its
    # pixel centres fall on the output's, so nothing is resampled. `check_orientation` measures that.
    image = np.asarray(Image.open(texture).convert("RGB")).astype(float)
    assert image.shape == (HEIGHT, WIDTH, 3), image.shape
    image = np.roll(image[:, ::-1], WIDTH // 4, 1)
    lines = [line.split() for line in open(catalogue) if not line.startswith("#")]
    stars = np.array([[int(f) if f != "-" else 65 for f in line[:4]] for line in lines]) / [1e5, 1e5, 100, 100]
    seen = stars[stars[:, 2] <= 6]
    check_orientation(image, seen)
    image = move_47_tucanae(image)
    image = remove_stars(image, stars[stars[:, 2] <= REMOVED_LIMIT])
    image = remove_grain(image)
    rgb, used = calibrate(image, stars)
    rgb = restore_galaxies(rgb)
    tables(rgb, used, stars)

    peak = np.percentile(rgb.max(-1), 99.995)  # the cores of a few clusters and nebulae, some 100 pixels, saturate
    code = np.clip(rgb / peak, 0, 1)
    code = np.where(code <= 0.0031308, 12.92 * code, 1.055 * code**(1 / 2.4) - 0.055) * 255
    # The dark sky's steps are 5 % apart, a visible contour each. Half a step of noise hides them and keeps the mean.
    code += np.random.default_rng(1).uniform(-0.5, 0.5, code.shape[:2])[..., None]
    Image.fromarray(np.clip(np.rint(code), 0, 255).astype(np.uint8)).save(out, optimize=True)
    written = np.asarray(Image.open(out)) / 255
    written = np.where(written <= 0.04045, written / 12.92, ((written + 0.055) / 1.055)**2.4) * peak
    print("the written file's mean, S10(V): %.1f; clipped pixels: %d" % (
        (written @ REC709_Y * pixel_shares()).sum(), (rgb.max(-1) > peak).sum()))
    print(f"peak = {peak:.1f} S10(V) = {peak * 1e-4 / 3600:.4e} V = 0 stars per square arcminute")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
