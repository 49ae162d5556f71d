"""lights: strings of small bulbs in sagging arcs, far and near."""

import math
from random import Random

COLOURS = [(1.0, 0.52, 0.16), (1.0, 0.62, 0.26), (1.0, 0.20, 0.08), (0.18, 0.42, 1.0), (0.12, 0.85, 0.42), (0.95, 0.25, 0.75)]

# (start, end, sag, bulbs, radius, radiance, colours)
STRINGS = [
    ((-9.0, 4.4, 12.0), (1.0, 5.2, 17.0), 1.5, 15, 0.12, 15, (0, 1)),
    ((-1.0, 5.4, 16.0), (11.0, 4.2, 13.0), 1.7, 16, 0.12, 15, (0, 1)),
    ((-13.0, 7.0, 22.0), (12.0, 7.5, 26.0), 2.2, 24, 0.17, 16, (0, 2, 3, 4, 5)),
    ((-6.0, 2.2, 20.0), (9.0, 2.6, 24.0), 0.7, 13, 0.14, 18, (3, 4, 5)),
    ((-2.2, 2.05, 3.6), (-0.5, 2.45, 3.0), 0.25, 5, 0.022, 26, (0, 1, 2)),
    ((0.6, 2.35, 2.7), (1.9, 1.75, 3.3), 0.2, 4, 0.019, 26, (0, 1, 5)),
]


def write(folder):
    rng = Random(1224)
    lines = ["# Made by generate.py: bulbs of the strings, then those that lie on the ground."]
    for start, end, sag, count, radius, radiance, colours in STRINGS:
        for k in range(count):
            a = (k + 0.5 + 0.3 * (rng.random() - 0.5)) / count
            x, y, z = (p + (q - p) * a for p, q in zip(start, end))
            bulb(lines, (x, y - sag * 4 * a * (1 - a), z), radius, radiance, COLOURS[colours[k % len(colours)]])
    for k in range(9):
        angle = 2 * math.pi * k / 9 + 0.4
        reach = 1.5 + 0.25 * rng.random()
        at = (-0.75 + reach * math.cos(angle), 0.045, 5.7 + reach * math.sin(angle))
        bulb(lines, at, 0.045, 26, COLOURS[(0, 1)[k % 2]])
    (folder / "bulbs.pbrt").write_text("\n".join(lines) + "\n")


def bulb(lines, at, radius, radiance, colour):
    rgb = " ".join(f"{radiance * c:.4g}" for c in colour)
    lines.append(f'AttributeBegin  Translate {at[0]:.3f} {at[1]:.3f} {at[2]:.3f}  AreaLightSource "diffuse" "rgb L" [{rgb}]'
                 f'  Shape "sphere" "float radius" {radius}  AttributeEnd')
