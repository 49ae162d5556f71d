"""spheres: sixty marbles on the floor, and forty more that climb in a helix through the plane in focus."""

import math
from random import Random
from .files import write_png

WARM = [(0.80, 0.16, 0.07), (0.86, 0.36, 0.06), (0.90, 0.62, 0.14), (0.70, 0.07, 0.16)]
MIDDLE = [(0.12, 0.55, 0.42), (0.88, 0.70, 0.26), (0.82, 0.22, 0.10), (0.10, 0.40, 0.62)]
COOL = [(0.07, 0.24, 0.62), (0.20, 0.12, 0.55), (0.10, 0.48, 0.60), (0.45, 0.14, 0.52)]
PALE = [(0.86, 0.80, 0.66), (0.75, 0.80, 0.84), (0.90, 0.66, 0.30)]


def write(folder):
    write_png(folder / "dots.png", 128, 64, dots)
    write_png(folder / "swirl.png", 128, 64, swirl)
    rng = Random(20110807)
    balls = helix(rng)
    balls += floor(rng, 100 - len(balls), balls)
    lines = ["# Made by generate.py: one object per group of lines, front to back."]
    for index, (x, y, z, radius) in enumerate(sorted(balls, key=lambda ball: ball[2])):
        palette = WARM if z < 8 else MIDDLE if z < 13.5 else COOL
        a, b = palette[rng.randrange(4)], PALE[rng.randrange(3)]
        first, second = (f"[{c[0]:.3g} {c[1]:.3g} {c[2]:.3g}]" for c in (a, b))
        kind = rng.randrange(5)
        name = f"ball{index}"
        lines.append("AttributeBegin")
        if kind < 3:
            across, along = [(8, 6), (14, 1), (1, 9)][kind]  # checks, meridians, parallels
            lines.append(f'    Texture "{name}" "spectrum" "checkerboard" "float uscale" {across} "float vscale" {along}'
                         f' "rgb tex1" {first} "rgb tex2" {second}')
        else:
            image = ("dots", "swirl")[kind - 3]
            lines.append(f'    Texture "{name}" "spectrum" "mix" "rgb tex1" {first} "rgb tex2" {second}'
                         f' "texture amount" "{image}"')
        lines.append(f'    Material "diffuse" "texture reflectance" "{name}"')
        lines.append(f"    Translate {x:.4f} {y:.4f} {z:.4f}")
        lines.append(f"    Rotate {rng.random() * 360:.1f} 0 1 0  Rotate {-90 + 70 * (rng.random() - 0.5):.1f} 1 0 0")
        lines.append(f'    Shape "sphere" "float radius" {radius:.4f}')
        lines.append("AttributeEnd")
    (folder / "balls.pbrt").write_text("\n".join(lines) + "\n")


def helix(rng):
    balls = []
    for k in range(40):
        a = k / 39
        angle = 2 * math.pi * (2.1 * a + 0.62)
        reach = 3.5
        balls.append((reach * math.cos(angle), 0.55 + 3.9 * a, 10.6 + 0.95 * reach * math.sin(angle),
                      0.30 + 0.06 * rng.random()))
    return balls


def floor(rng, count, taken):
    """Marbles at rest, none touching another, inside a wedge that the camera sees."""
    placed = list(taken)
    balls = []
    while len(balls) < count:
        radius = 0.24 + 0.42 * rng.random() ** 2
        z = 4.3 + radius + 18.5 * rng.random() ** 1.25
        x = (2 * rng.random() - 1) * 0.66 * z
        if z < 8 and abs(x) < 0.25 * z:
            continue  # leave a view to the focus
        if all(math.dist((x, radius, z), other[:3]) > 1.12 * (radius + other[3]) for other in placed):
            placed.append((x, radius, z, radius))
            balls.append(placed[-1])
    return balls


def dots(x, y):
    v = (y + 0.5) / 64
    row = math.floor(v * 8)
    u = ((x + 0.5) / 128 * 14 + 0.5 * (row % 2)) % 1 - 0.5
    stretch = max(0.15, math.sin(math.pi * v))  # round on the sphere, not in the image
    inside = math.hypot(u * stretch, (v * 8) % 1 - 0.5) < 0.3
    return (1.0, 1.0, 1.0) if inside else (0.0, 0.0, 0.0)


def swirl(x, y):
    u, v = (x + 0.5) / 128, (y + 0.5) / 64
    wave = math.sin(2 * math.pi * (3 * u + 2.2 * v + 0.12 * math.sin(2 * math.pi * (u + 2 * v))))
    value = min(1.0, max(0.0, 0.5 + 2.2 * wave))
    return (value, value, value)
