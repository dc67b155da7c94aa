#!/usr/bin/env python3
"""Writes bodies.json: sizes, orbits, rotation and albedo of the Sun, the eight planets and the Moon.

    bodies.py MOONPOSITION.js OUT.json

MOONPOSITION.js  lib/moonposition.cjs or src/moonposition.js of the npm package astronomia 4.2.0 (MIT). It holds the
                 numbers of Meeus's tables 47.A and 47.B; only numbers are read.

All other numbers stand below, each group with its source. Terms of the Moon smaller than 0.0005 degrees and 0.5 km are
left out; their sum of squares is printed.
"""
import json
import re
import sys

ELEMENTS = """
Mercury 0.38709927 0.20563593 7.00497902 252.25032350 77.45779628 48.33076593
        0.00000037 0.00001906 -0.00594749 149472.67411175 0.16047689 -0.12534081
Venus 0.72333566 0.00677672 3.39467605 181.97909950 131.60246718 76.67984255
        0.00000390 -0.00004107 -0.00078890 58517.81538729 0.00268329 -0.27769418
EarthMoonBarycenter 1.00000261 0.01671123 -0.00001531 100.46457166 102.93768193 0.0
        0.00000562 -0.00004392 -0.01294668 35999.37244981 0.32327364 0.0
Mars 1.52371034 0.09339410 1.84969142 -4.55343205 -23.94362959 49.55953891
        0.00001847 0.00007882 -0.00813131 19140.30268499 0.44441088 -0.29257343
Jupiter 5.20288700 0.04838624 1.30439695 34.39644051 14.72847983 100.47390909
        -0.00011607 -0.00013253 -0.00183714 3034.74612775 0.21252668 0.20469106
Saturn 9.53667594 0.05386179 2.48599187 49.95424423 92.59887831 113.66242448
        -0.00125060 -0.00050991 0.00193609 1222.49362201 -0.41897216 -0.28867794
Uranus 19.18916464 0.04725744 0.77263783 313.23810451 170.95427630 74.01692503
        -0.00196176 -0.00004397 -0.00242939 428.48202785 0.40805281 0.04240589
Neptune 30.06992276 0.00859048 1.77004347 -55.12002969 44.96476227 131.78422574
        0.00026291 0.00005105 0.00035372 218.45945325 -0.32241464 -0.00508664
""".split()

# Printed by corrections.py: polynomial in T; then multiple of Jupiter's and of Saturn's mean longitude, sine, cosine.
CORRECTIONS = [
    ("Jupiter", "longitude_deg", [-0.0018, -0.0575, -0.0231],  # worst 0.14291, then 0.01117
      [[2, -2, 0.0556, -0.0018],
       [1, -2, 0.0363, -0.0065],
       [2, -3, 0.0144, -0.0197],
       [1, -1, -0.022, 0.0005],
       [3, -3, 0.0052, -0.0016],
       [1, 0, 0.0016, -0.0036]]),
    ("Jupiter", "distance_fraction", [-5e-06, 7.3e-05, 5.2e-05],  # worst 0.00084, then 0.00016
      [[2, -2, -1.9e-05, -0.00054],
       [2, -3, -0.00015, -0.000111],
       [1, -1, 1e-06, 0.000124],
       [3, -3, -1.7e-05, -5.9e-05]]),
    ("Saturn", "longitude_deg", [0.0231, 0.1592, 0.0467],  # worst 0.18231, then 0.01372
      [[1, -2, -0.1069, 0.0322],
       [2, -4, -0.078, -0.0314],
       [0, 1, -0.052, -0.0561],
       [2, -2, -0.0092, -0.0003],
       [3, -5, -0.0004, -0.0001],
       [4, -5, 0.0003, 0.0]]),
    ("Saturn", "distance_fraction", [0.000361, 0.000122, 8.2e-05],  # worst 0.00188, then 0.00031
      [[1, -1, 9.6e-05, 0.000862],
       [1, -2, 0.000128, 0.000526],
       [2, -4, -0.000217, 0.000632],
       [0, 1, -0.000457, 0.000425]]),
]

# name: equatorial radius, polar radius (km), GM (km^3/s^2), geometric albedo V
SIZES = {
    "Sun": (695700, 695700, 132712440041.939, None),
    "Mercury": (2440.53, 2438.26, 22031.868551, 0.142),
    "Venus": (6051.8, 6051.8, 324858.592, 0.689),
    "Earth": (6378.1366, 6356.7519, 398600.435507, 0.434),
    "Moon": (1737.4, 1737.4, 4902.800118, 0.12),
    "Mars": (3396.19, 3376.20, 42828.375816, 0.170),
    "Jupiter": (71492, 66854, 126712764.1, 0.538),
    "Saturn": (60268, 54364, 37940584.8418, 0.499),
    "Uranus": (25559, 24973, 5794556.4, 0.488),
    "Neptune": (24764, 24341, 6836527.10058, 0.442),
}

# pole right ascension (deg, deg/century), declination, W0 (deg), Wdot (deg/day)
ROTATION = {
    "Sun": ([286.13, 0], [63.87, 0], [84.176, 14.1844000]),
    "Mercury": ([281.0103, -0.0328], [61.4155, -0.0049], [329.5988, 6.1385108]),
    "Venus": ([272.76, 0], [67.16, 0], [160.20, -1.4813688]),
    # W is the Earth rotation angle (IAU 2000) less the pole's right ascension less 90 degrees. The WGCCRE's own
    # W for the Earth (190.147, 360.9856235) is 0.3 degrees off in 2000 and changes by 0.2 degrees a century.
    "Earth": ([0.0, -0.641], [90.0, -0.557], [190.46061838, 360.98562984]),
    "Mars": ([317.68143, -0.1061], [52.88650, -0.0609], [176.630, 350.89198226]),
    "Jupiter": ([268.056595, -0.006499], [64.495303, 0.002413], [284.95, 870.5360000]),
    "Saturn": ([40.589, -0.036], [83.537, -0.004], [38.90, 810.7939024]),
    "Uranus": ([257.311, 0], [-15.175, 0], [203.81, -501.1600928]),
    "Neptune": ([299.36, 0], [43.46, 0], [249.978, 541.1397757]),
    "Moon": ([269.9949, 0.0031], [66.5392, 0.0130], [38.3213, 13.17635815]),
}
E = {"E1": [125.045, -0.0529921], "E2": [250.089, -0.1059842], "E3": [260.008, 13.0120009],
     "E4": [176.625, 13.3407154], "E5": [357.529, 0.9856003], "E6": [311.589, 26.4057084],
     "E7": [134.963, 13.0649930], "E8": [276.617, 0.3287146], "E9": [34.226, 1.7484877],
     "E10": [15.134, -0.1589763], "E11": [119.743, 0.0036096], "E12": [239.961, 0.1643573],
     "E13": [25.053, 12.9590088]}
MOON_RA = {"E1": -3.8787, "E2": -0.1204, "E3": 0.0700, "E4": -0.0172, "E6": 0.0072, "E10": -0.0052, "E13": 0.0043}
MOON_DEC = {"E1": 1.5419, "E2": 0.0239, "E3": -0.0278, "E4": 0.0068, "E6": -0.0029, "E7": 0.0009, "E10": 0.0008,
            "E13": -0.0009}
MOON_W = {"E1": 3.5610, "E2": 0.1208, "E3": -0.0642, "E4": 0.0158, "E5": 0.0252, "E6": -0.0066, "E7": -0.0047,
          "E8": -0.0046, "E9": 0.0028, "E10": 0.0052, "E11": 0.0040, "E12": 0.0019, "E13": -0.0044}


def moon_tables(path):
    text = open(path, encoding="utf-8").read()
    rows = [[int(v) for v in m.group(1).split(",")]
            for m in re.finditer(r"\[\s*((?:-?\d+\s*,\s*){4,5}-?\d+)\s*\]", text)]
    return [r for r in rows if len(r) == 6], [r for r in rows if len(r) == 5]


def main(moonposition, out):
    lr, b = moon_tables(moonposition)
    assert len(lr) == 60 and len(b) == 60, (len(lr), len(b))
    keep_l = [[*r[:4], r[4] / 1e6] for r in lr if abs(r[4]) >= 500]
    keep_r = [[*r[:4], r[5] / 1e3] for r in lr if abs(r[5]) >= 500]
    keep_b = [[*r[:4], r[4] / 1e6] for r in b if abs(r[4]) >= 500]
    for name, rows, i, unit in (("longitude", lr, 4, 1e6), ("distance", lr, 5, 1e3), ("latitude", b, 4, 1e6)):
        left = [r[i] / unit for r in rows if abs(r[i]) < 500]
        print(f"Moon, {name}: {len(rows) - len(left)} terms kept, the others together {sum(v * v / 2 for v in left) ** .5:.5f} rms")

    elements, names, k = {}, ["a_au", "e", "i_deg", "L_deg", "perihelion_longitude_deg", "node_longitude_deg"], 0
    while k < len(ELEMENTS):
        v = [float(x) for x in ELEMENTS[k + 1:k + 13]]
        elements[ELEMENTS[k]] = {n: [v[j], v[j + 6]] for j, n in enumerate(names)}
        k += 13
    corrections = {}
    for name, what, polynomial, terms in CORRECTIONS:
        corrections.setdefault(name, {})[what] = {"polynomial": polynomial, "terms": terms}
    rotation = {n: dict(zip(("pole_ra_deg", "pole_dec_deg", "W_deg"), map(list, v))) for n, v in ROTATION.items()}
    rotation["Neptune"]["terms"] = {
        "angles": {"N": {"deg": 357.85, "deg_per_century": 52.316}},
        "pole_ra_sin": {"N": 0.70}, "pole_dec_cos": {"N": -0.51}, "W_sin": {"N": -0.48}}
    rotation["Moon"]["terms"] = {
        "angles": {n: {"deg": v[0], "deg_per_day": v[1]} for n, v in E.items()},
        "pole_ra_sin": MOON_RA, "pole_dec_cos": MOON_DEC, "W_sin": MOON_W, "W_deg_per_day2": -1.4e-12}
    data = {
        "time": "d is days and T is centuries of 36525 days of TT (a good stand-in for TDB) since JD 2451545.0. The "
                "Earth's W takes d in UT1: its own turn follows UT1, all else TT.",
        "sizes": {
            "source": "Radii: IAU WGCCRE 2015 (Archinal et al. 2018, CMDA 130, 22); the Sun: IAU 2015 resolution B3. GM: "
                      "JPL DE440 (Park et al. 2021, AJ 161, 105); for Mars to Neptune the planet with its moons. Geometric albedo in "
                      "V: Mallama, Krobusek and Pavlov 2017, Icarus 282, 19; the Moon: Allen's Astrophysical "
                      "Quantities, 4th edition.",
            "bodies": {n: {"radius_km": a, "flattening": round(1 - c / a, 7), "gm_km3_s2": gm,
                           "geometric_albedo_v": p} for n, (a, c, gm, p) in SIZES.items()}},
        "orbits": {
            "source": "E. M. Standish, Keplerian elements for approximate positions of the major planets (JPL Solar "
                      "System Dynamics), table 1, valid 1800 to 2050",
            "frame": "heliocentric, mean ecliptic and equinox of J2000",
            "value": "[at J2000, rate per century]",
            "obliquity_deg": 23.43928, "au_km": 149597870.7,
            "bodies": elements,
            "corrections": {
                "source": "fitted by corrections.py to plan94 of ERFA (Simon et al. 1994, A&A 282, 663), 1895 to 2055",
                "rule": "Not Standish's; may be left out. Turn the planet about the ecliptic pole by longitude_deg and "
                        "multiply its distance by 1 + distance_fraction. Each is a polynomial in T (T held at -1.05 and "
                        "0.55 beyond them) plus terms [a, b, sine, cosine] of the angle a L_Jupiter + b L_Saturn.",
                "bodies": corrections}},
        "moon": {
            "source": "J. Meeus, Astronomical Algorithms, 2nd edition (1998), chapter 47, after Chapront's ELP-2000/82; "
                      "numbers by way of the npm package astronomia 4.2.0 (MIT)",
            "frame": "geocentric, mean ecliptic and equinox of date; take the precession below back to J2000",
            "arguments_deg": {
                "Lp": [218.3164477, 481267.88123421, -0.0015786, 1 / 538841, -1 / 65194000],
                "D": [297.8501921, 445267.1114034, -0.0018819, 1 / 545868, -1 / 113065000],
                "M": [357.5291092, 35999.0502909, -0.0001536, 1 / 24490000],
                "Mp": [134.9633964, 477198.8675055, 0.0087414, 1 / 69699, -1 / 14712000],
                "F": [93.2720950, 483202.0175233, -0.0036539, -1 / 3526000, 1 / 863310000],
                "A1": [119.75, 131.849], "A2": [53.09, 479264.290], "A3": [313.45, 481266.484]},
            "arguments": "polynomials in T, constant first",
            "eccentricity_factor": [1, -0.002516, -0.0000074],
            "rule": "Each row is [multiple of D, of M, of Mp, of F, coefficient]. Terms with |multiple of M| = 1 or 2 "
                    "are multiplied by E or E^2, E from eccentricity_factor. longitude = Lp + sum coefficient * sin; "
                    "latitude = sum coefficient * sin; distance = 385000.56 km + sum coefficient * cos.",
            "longitude_deg_sin": keep_l,
            "longitude_extra_deg_sin": {"A1": 0.003958, "Lp-F": 0.001962, "A2": 0.000318},
            "latitude_deg_sin": keep_b,
            "latitude_extra_deg_sin": {"Lp": -0.002235, "A3": 0.000382, "A1-F": 0.000175, "A1+F": 0.000175,
                                       "Lp-Mp": 0.000127, "Lp+Mp": -0.000115},
            "distance_mean_km": 385000.56, "distance_km_cos": keep_r,
            "mass_ratio_earth_moon": 81.3005691,
            "precession": {
                "source": "Lieske et al. 1977, as in Meeus, formulae 21.6 and 21.7",
                "eta_arcsec": [0, 47.0029, -0.03302, 0.000060],
                "Pi_deg": [174.876384, -0.24161358, 0.000009831],
                "p_arcsec": [0, 5029.0966, 1.11113, -0.000006],
                "rule": "Polynomials in T. From J2000 to date: v_date = Rz(-(Pi+p)) Rx(eta) Rz(Pi) v_2000, where Rz "
                        "and Rx turn the axes (Rz(a) has rows (cos a, sin a, 0), (-sin a, cos a, 0), (0, 0, 1)). "
                        "Back: the transpose."}},
        "rotation": {
            "source": "IAU WGCCRE 2015 (Archinal et al. 2018, CMDA 130, 22) without its terms below 0.02 degrees for "
                      "Mercury; Mars, Earth and Moon: IAU WGCCRE 2009 (Archinal et al. 2011, CMDA 109, 101). "
                      "Jupiter: system III; Saturn: system III. The "
                      "Earth's W: the Earth rotation angle of IAU 2000 resolution B1.8.",
            "frame": "ICRF equator. pole_ra_deg and pole_dec_deg: [at J2000, rate per century]; W_deg: [at J2000, "
                     "rate per day]. Terms: add coefficient * sin or cos of the angle.",
            "rule": "The prime meridian stands at W eastward along the equator from its node on the ICRF equator, at "
                    "right ascension pole_ra + 90 degrees. Longitude grows eastward (right-handed about the pole "
                    "given) for the maps here.",
            "bodies": rotation},
        "moons": {
            "source": "Radii: IAU WGCCRE 2015. Orbits: circles fitted here; Jupiter's to npm astronomy-engine 2.1.19 (theory "
                      "L1.2), 1900 to 2049, Titan's to pyephem 4.1.4, 2000 to 2019. Geometric albedo V: rounded from Allen's "
                      "Astrophysical Quantities; Titan: Karkoschka 1998.",
            "rule": "The moon stands in its planet's equator (the pole of `rotation`) at theta degrees eastward from the "
                    "node at right ascension pole_ra + 90 degrees: theta = theta_deg[0] + theta_deg[1] d. It turns its "
                    "longitude 0 to the planet. worst_deg is what the circle leaves out: the orbit's eccentricity and "
                    "tilt.",
            "bodies": {n: {"parent": p, "radius_km": r, "distance_km": a, "theta_deg": th, "geometric_albedo_v": v,
                           "worst_deg": e}
                       for n, p, r, a, th, v, e in (
                           ("Io", "Jupiter", 1821.49, 421769, [19.9458, 203.48895686], 0.63, 0.5),
                           ("Europa", "Jupiter", 1560.8, 671088, [214.5066, 101.37472403], 0.67, 1.2),
                           ("Ganymede", "Jupiter", 2631.2, 1070432, [221.7875, 50.31760771], 0.43, 0.4),
                           ("Callisto", "Jupiter", 2410.3, 1882740, [80.9708, 21.57107272], 0.17, 0.9),
                           ("Titan", "Saturn", 2575.0, 1221870, [8.8, 22.57697855], 0.22, 5))}},
        "rings": {
            "source": "French et al. 2017, Icarus 290, 14 (edges rounded)",
            "Saturn": {"D_inner_km": 66900, "C_inner_km": 74490, "B_inner_km": 91975, "B_outer_km": 117570,
                       "A_inner_km": 122050, "A_outer_km": 136770, "encke_inner_km": 133423, "encke_outer_km": 133745}},
    }
    with open(out, "w", encoding="utf-8") as f:
        text = json.dumps(data, indent=1)
        text = re.sub(r"\[\s+([^\[\]{}]*?)\s+\]", lambda m: "[" + re.sub(r"\s+", " ", m.group(1)) + "]", text)
        f.write(text + "\n")


main(*sys.argv[1:])
