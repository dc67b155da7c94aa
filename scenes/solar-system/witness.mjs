// Writes tests/world/ephemeris_witness.json with the npm package astronomy-engine 2.1.19 (MIT), whose planets are a
// truncated VSOP87 and whose Moon is Montenbruck and Pfleger's form of Brown's theory. Nothing here reads bodies.json.
//
//     node witness.mjs ASTRONOMY_ENGINE/esm/astronomy.js OUT.json
import { writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
const A = await import(pathToFileURL(process.argv[2]).href);
const dates = ['1900-01-01T12:00:00Z', '1931-07-16T03:00:00Z', '1969-07-20T20:17:40Z', '2000-01-01T12:00:00Z',
               '2026-08-12T17:46:00Z', '2049-11-05T06:30:00Z'];
const planets = ['Mercury', 'Venus', 'Earth', 'Mars', 'Jupiter', 'Saturn', 'Uranus', 'Neptune'];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const round = (x, n) => Number(x.toFixed(n));
const vec = v => [v.x, v.y, v.z];
const wrap = d => d - 360 * Math.floor((d + 180) / 360);
const ECL = A.Rotation_EQJ_ECL();
const ecliptic = v => vec(A.RotateVector(ECL, v));
// Planetocentric latitude and eastward longitude, in degrees, of direction v on the body with this axis.
function place(axis, v) {
    const n = vec(axis.north), a = (axis.ra * 15 + 90) * Math.PI / 180;
    const node = [Math.cos(a), Math.sin(a), 0], w = axis.spin * Math.PI / 180, e = cross(n, node);
    const x = node.map((c, i) => c * Math.cos(w) + e[i] * Math.sin(w)), y = cross(n, x);
    const r = Math.hypot(...v);
    return [round(Math.asin(dot(n, v) / r) * 180 / Math.PI, 4),
            round(Math.atan2(dot(y, v), dot(x, v)) * 180 / Math.PI, 4)];
}
const out = {
    made_by: 'scenes/solar-system/witness.mjs with npm astronomy-engine 2.1.19 (MIT)',
    axes: 'Geometric positions at one instant, without light time or aberration. heliocentric_ecliptic_au: x y z, mean '
        + 'ecliptic and equinox of J2000. moon_geocentric_ecliptic_km: the same axes, from the centre of the Earth. '
        + 'Places are [planetocentric latitude, eastward longitude], degrees; without light time. sub_solar_earth is of the '
        + 'apparent Sun (with light time, aberration, nutation) and Greenwich apparent sidereal time. moon_libration is '
        + '[latitude, longitude] of the Earth over the Moon, after Meeus, chapter 53. sub_earth_* use the library\'s IAU axes; Jupiter in system III.',
    dates: [] };
for (const text of dates) {
    const t = A.MakeTime(new Date(text)), earth = A.HelioVector('Earth', t), moon = A.GeoMoon(t);
    const km = A.KM_PER_AU, sun = A.GeoVector('Sun', t, true), of_date = A.Rotation_EQJ_EQD(t);
    const s = A.EquatorFromVector(A.RotateVector(of_date, sun)), lib = A.Libration(t);
    const row = { utc: text, jd_ut1: round(t.ut + 2451545, 8), jd_tt: round(t.tt + 2451545, 8),
        heliocentric_ecliptic_au: {}, moon_geocentric_ecliptic_km: ecliptic(moon).map(c => round(c * km, 1)),
        sub_solar_earth: [round(s.dec, 4), round(wrap(s.ra * 15 - A.SiderealTime(t) * 15), 4)],
        moon_libration: [round(lib.elat, 4), round(lib.elon, 4)] };
    for (const p of planets) row.heliocentric_ecliptic_au[p] = ecliptic(A.HelioVector(p, t)).map(c => round(c, 8));
    for (const p of ['Mercury', 'Venus', 'Mars', 'Jupiter', 'Saturn', 'Uranus', 'Neptune', 'Moon']) {
        const b = p === 'Moon' ? { x: earth.x + moon.x, y: earth.y + moon.y, z: earth.z + moon.z } : A.HelioVector(p, t);
        row['sub_earth_' + p.toLowerCase()] = place(A.RotationAxis(p, t), [earth.x - b.x, earth.y - b.y, earth.z - b.z]);
    }
    row.sub_earth_sun = place(A.RotationAxis('Sun', t), vec(earth));
    out.dates.push(row);
}
const flat = (m, s) => '[' + s.replace(/\s+/g, ' ') + ']';
writeFileSync(process.argv[3], JSON.stringify(out, null, 1).replace(/\[\s+([^\[\]{}]*?)\s+\]/g, flat) + '\n');
