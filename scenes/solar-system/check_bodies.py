#!/usr/bin/env python3
"""Compares bodies.json with the witness and prints the worst differences.

    check_bodies.py bodies.json ../../tests/world/ephemeris_witness.json [--without-corrections]

Needs python3-numpy. With python3-erfa it also compares 1900 to 2049, a thousand dates, with ERFA's plan94 and moon98.
"""
import json
import sys

import numpy as np

B = {}  # bodies.json
DEG = np.pi / 180
PLANETS = "Mercury Venus Earth Mars Jupiter Saturn Uranus Neptune".split()


def poly(c, t):
    return sum(v * t ** k for k, v in enumerate(c))


def rz(a):
    return np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])


def rx(a):
    return np.array([[1, 0, 0], [0, np.cos(a), np.sin(a)], [0, -np.sin(a), np.cos(a)]])


def orbit(name, t):
    a, e, i, l, w, n = (poly(v, t) for v in B["orbits"]["bodies"][name].values())
    m = (l - w + 180) % 360 - 180
    x = m * DEG + e * np.sin(m * DEG)
    for _ in range(10):
        x -= (x - e * np.sin(x) - m * DEG) / (1 - e * np.cos(x))
    p = np.array([a * (np.cos(x) - e), a * np.sqrt(1 - e * e) * np.sin(x), 0])
    v = rz(-n * DEG) @ rx(-i * DEG) @ rz(-(w - n) * DEG) @ p
    c = B["orbits"].get("corrections", {}).get("bodies", {}).get(name)
    if c:
        lj, ls = ((B["orbits"]["bodies"][k]["L_deg"][0] + B["orbits"]["bodies"][k]["L_deg"][1] * t) * DEG
                  for k in ("Jupiter", "Saturn"))
        held = min(max(t, -1.05), 0.55)
        turn, longer = (poly(c[what]["polynomial"], held) + sum(s * np.sin(a * lj + b * ls) + k * np.cos(a * lj + b * ls)
                        for a, b, s, k in c[what]["terms"]) for what in ("longitude_deg", "distance_fraction"))
        v = rz(-turn * DEG) @ v * (1 + longer)
    return v


def moon(t):
    g = B["moon"]
    q = {k: poly(v, t) * DEG for k, v in g["arguments_deg"].items()}
    e = poly(g["eccentricity_factor"], t)

    def total(rows, f):
        return sum(r[4] * e ** abs(r[1]) * f(r[0] * q["D"] + r[1] * q["M"] + r[2] * q["Mp"] + r[3] * q["F"]) for r in rows)

    def extra(terms):
        s = 0
        for k, v in terms.items():
            for op in "+-":
                if op in k:
                    a, b = k.split(op)
                    s += v * np.sin(q[a] + (q[b] if op == "+" else -q[b]))
                    break
            else:
                s += v * np.sin(q[k])
        return s

    l = q["Lp"] + (total(g["longitude_deg_sin"], np.sin) + extra(g["longitude_extra_deg_sin"])) * DEG
    b = (total(g["latitude_deg_sin"], np.sin) + extra(g["latitude_extra_deg_sin"])) * DEG
    r = g["distance_mean_km"] + total(g["distance_km_cos"], np.cos)
    v = r * np.array([np.cos(b) * np.cos(l), np.cos(b) * np.sin(l), np.sin(b)])
    p = g["precession"]
    eta, pi, pa = poly(p["eta_arcsec"], t) / 3600 * DEG, poly(p["Pi_deg"], t) * DEG, poly(p["p_arcsec"], t) / 3600 * DEG
    return (rz(-(pi + pa)) @ rx(eta) @ rz(pi)).T @ v


def positions(t):
    au = B["orbits"]["au_km"]
    m = moon(t) / au
    out = {n: orbit("EarthMoonBarycenter" if n == "Earth" else n, t) for n in PLANETS}
    out["Earth"] = out["Earth"] - m / (1 + B["moon"]["mass_ratio_earth_moon"])
    return out, m


def axis(name, tt, ut):
    r = B["rotation"]["bodies"][name]
    d, t = tt, tt / 36525
    ra, dec = (r[k][0] + r[k][1] * t for k in ("pole_ra_deg", "pole_dec_deg"))
    w = r["W_deg"][0] + r["W_deg"][1] * (ut if name == "Earth" else d)
    terms = r.get("terms", {})
    angle = {k: (v["deg"] + v.get("deg_per_day", 0) * d + v.get("deg_per_century", 0) * t) * DEG
             for k, v in terms.get("angles", {}).items()}
    ra += sum(c * np.sin(angle[k]) for k, c in terms.get("pole_ra_sin", {}).items())
    dec += sum(c * np.cos(angle[k]) for k, c in terms.get("pole_dec_cos", {}).items())
    w += sum(c * np.sin(angle[k]) for k, c in terms.get("W_sin", {}).items()) + terms.get("W_deg_per_day2", 0) * d * d
    return rz(w * DEG) @ rx((90 - dec) * DEG) @ rz((90 + ra) * DEG)


def place(name, v_ecliptic, tt, ut):
    v = axis(name, tt, ut) @ rx(-B["orbits"]["obliquity_deg"] * DEG) @ v_ecliptic
    return np.arcsin(v[2] / np.linalg.norm(v)) / DEG, np.arctan2(v[1], v[0]) / DEG


def angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b) / DEG


def main():
    global B
    B = json.load(open(sys.argv[1]))
    if "--without-corrections" in sys.argv:
        B["orbits"].pop("corrections")
    witness = json.load(open(sys.argv[2]))
    worst = {}

    def note(key, value):
        worst[key] = max(worst.get(key, 0), abs(value))

    for row in witness["dates"]:
        tt, ut = row["jd_tt"] - 2451545, row["jd_ut1"] - 2451545
        ours, m = positions(tt / 36525)
        wit = {n: np.array(v) for n, v in row["heliocentric_ecliptic_au"].items()}
        wm = np.array(row["moon_geocentric_ecliptic_km"])
        for n in PLANETS:
            note(f"{n:8} from the Sun, degrees", angle(ours[n], wit[n]))
            note(f"{n:8} distance from the Sun, percent", (np.linalg.norm(ours[n]) / np.linalg.norm(wit[n]) - 1) * 100)
            if n != "Earth":
                note(f"{n:8} from the Earth, degrees", angle(ours[n] - ours["Earth"], wit[n] - wit["Earth"]))
        note("Moon from the Earth, degrees", angle(m, wm))
        note("Moon distance, km", np.linalg.norm(m) * B["orbits"]["au_km"] - np.linalg.norm(wm))
        # Rotation: with the witness's positions, so that only the axes differ.
        for n in ["Sun", "Moon"] + [p for p in PLANETS if p != "Earth"]:
            v = -wm if n == "Moon" else wit["Earth"] - (0 if n == "Sun" else wit[n])
            lat, lon = place(n, v, tt, ut)
            w = row["sub_earth_" + n.lower()]
            note(f"{n:8} latitude of the Earth, degrees", lat - w[0])
            note(f"{n:8} longitude of the Earth, degrees", (lon - w[1] + 180) % 360 - 180)
            if n == "Moon":
                note("Moon     libration (Meeus) latitude, degrees", lat - row["moon_libration"][0])
                note("Moon     libration (Meeus) longitude, degrees", lon - row["moon_libration"][1])
        # The apparent Sun stands 0.0057 degrees back along its path.
        lat, lon = place("Earth", -wit["Earth"], tt, ut)
        note("Earth    latitude of the Sun, degrees", lat - row["sub_solar_earth"][0])
        note("Earth    longitude of the Sun, degrees", (lon - row["sub_solar_earth"][1] + 180) % 360 - 180)
    print("The witness's dates, worst:")
    for k in sorted(worst):
        print(f"  {k:46} {worst[k]:.4f}")
    try:
        import erfa
    except ImportError:
        return
    worst = {}
    eq = rx(B["orbits"]["obliquity_deg"] * DEG)
    for tt in np.linspace(-36524, 18262, 1000):
        ours, m = positions(tt / 36525)
        earth = eq @ erfa.epv00(2451545.0, tt)[0]["p"]
        wit = {n: eq @ erfa.plan94(2451545.0, tt, k)["p"]
               for k, n in ((1, "Mercury"), (2, "Venus"), (4, "Mars"), (5, "Jupiter"), (6, "Saturn"), (7, "Uranus"),
                            (8, "Neptune"))}
        note("Earth    from the Sun, degrees", angle(ours["Earth"], earth))
        for n, v in wit.items():
            note(f"{n:8} from the Sun, degrees", angle(ours[n], v))
            note(f"{n:8} from the Earth, degrees", angle(ours[n] - ours["Earth"], v - earth))
        note("Moon     from the Earth, degrees", angle(m, eq @ erfa.moon98(2451545.0, tt)["p"]))
    print("ERFA (epv00, plan94, moon98), 1000 dates from 1900 to 2049, worst:")
    for k in sorted(worst):
        print(f"  {k:46} {worst[k]:.4f}")


if __name__ == "__main__":
    main()
