"""foliage: clumps of grass and flowers of bilinear patches, sown before and behind the focus, under a soft sky."""

import math
from random import Random
from .files import write_exr, write_ply
from .geometry import Mesh, add, mul


def write(folder):
    rng = Random(42)
    for k in range(3):
        write_ply(folder / f"clump{k}.ply", clump(rng, 90))
    write_ply(folder / "petals.ply", flower(16, 0.135, 0.028, 0.35))
    write_ply(folder / "poppy.ply", flower(5, 0.15, 0.085, 1.0))
    write_ply(folder / "stem.ply", stem())
    write_exr(folder / "sky.exr", 64, 64, sky)
    (folder / "plants.pbrt").write_text("\n".join(sow(rng)) + "\n")


def strip(mesh, centres, half_widths, sides):
    """A ribbon as a chain of bilinear patches."""
    mesh.begin_part()
    pairs = []
    for i, (centre, half, side) in enumerate(zip(centres, half_widths, sides)):
        v = i / (len(centres) - 1)
        pairs.append((mesh.vertex(add(centre, mul(side, -half)), (0.0, v)), mesh.vertex(add(centre, mul(side, half)), (1.0, v))))
    for (a, b), (c, d) in zip(pairs, pairs[1:]):
        mesh.faces.append((a, b, d, c))


def clump(rng, blades):
    mesh = Mesh()
    for _ in range(blades):
        angle, reach = 2 * math.pi * rng.random(), 0.42 * math.sqrt(rng.random())
        root = (reach * math.cos(angle), 0.0, reach * math.sin(angle))
        lean_angle = 2 * math.pi * rng.random()
        lean = (math.cos(lean_angle), 0.0, math.sin(lean_angle))
        height, bend, width = 0.45 + 0.5 * rng.random(), 0.08 + 0.4 * rng.random() ** 2, 0.009 + 0.006 * rng.random()
        twist = lean_angle + 1.57 + 0.8 * (rng.random() - 0.5)
        side = (math.cos(twist), 0.0, math.sin(twist))
        steps = 4
        centres = [add(root, add((0, height * (t - 0.25 * bend * t * t), 0), mul(lean, bend * t * t)))
                   for t in (i / steps for i in range(steps + 1))]
        widths = [width * (1 - (i / steps) ** 2) for i in range(steps)] + [0.0006]
        strip(mesh, centres, widths, [side] * (steps + 1))
    return mesh


def flower(petals, size, width, cup):
    """Petals around the y axis; `cup` is how steeply they rise."""
    mesh = Mesh()
    for k in range(petals):
        angle = 2 * math.pi * k / petals
        out, side = (math.cos(angle), 0.0, math.sin(angle)), (-math.sin(angle), 0.0, math.cos(angle))
        centres = [add(mul(out, size * t * (1 - 0.35 * (cup > 0.5) * t)), (0, cup * size * t * (1 - 0.45 * t), 0))
                   for t in (0.12, 0.4, 0.7, 1.0)]
        strip(mesh, centres, [0.35 * width, 0.8 * width, width, 0.45 * width], [side] * 4)
    return mesh


def stem():
    mesh = Mesh()
    for side in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)):
        centres = [(0.03 * math.sin(2.5 * t), -t, 0.0) for t in (0.0, 0.4, 0.8, 1.2)]
        strip(mesh, centres, [0.008] * 4, [side] * 4)
    return mesh


def sow(rng):
    lines = ["# Made by generate.py: clumps of grass, then flowers."]
    for _ in range(620):
        z = 1.5 + 22 * rng.random() ** 1.5
        x = (2 * rng.random() - 1) * (0.9 + 0.62 * z)
        size = 0.85 + 0.4 * rng.random()
        if z < 3.1 and abs(x) < 0.45 * z:
            size *= 0.5  # leave a view to the focus
        elif z < 3.1:
            size *= 1.3
        lines.append(f'AttributeBegin  Translate {x:.3f} 0 {z:.3f}  Rotate {360 * rng.random():.0f} 0 1 0'
                     f'  Scale {size:.3f} {size:.3f} {size:.3f}  ObjectInstance "clump{rng.randrange(3)}"  AttributeEnd')
    for k in range(90):
        z = (4.3 + 0.9 * (rng.random() - 0.5)) if k % 6 == 0 else 2.2 + 14 * rng.random() ** 1.4
        x = (2 * rng.random() - 1) * (0.3 + 0.55 * z)
        y = 0.72 + 0.45 * rng.random()
        kind = "poppy" if rng.random() < 0.4 else "daisy"
        lines.append(f'AttributeBegin  Translate {x:.3f} {y:.3f} {z:.3f}  Rotate {-15 - 45 * rng.random():.0f} 1 0 0'
                     f'  Rotate {60 * (rng.random() - 0.5):.0f} 0 0 1  ObjectInstance "{kind}"  AttributeEnd')
    return lines


def sky(x, y):
    """Equal-area octahedral map (Clarberg 2008) with z up: pale at the horizon, blue above, meadow green below."""
    u, v = 2 * (x + 0.5) / 64 - 1, 2 * (y + 0.5) / 64 - 1
    distance = 1 - (abs(u) + abs(v))
    r = 1 - abs(distance)
    z = math.copysign(1 - r * r, distance)
    if z < 0:
        return (0.10, 0.13, 0.06)
    t = z ** 0.4
    return tuple(a + (b - a) * t for a, b in zip((1.05, 0.98, 0.82), (0.10, 0.26, 0.72)))
