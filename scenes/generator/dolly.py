"""dolly: an avenue of columns with spiral stripes, and marbles at their feet."""

import math
from random import Random
from .files import write_ply
from .geometry import Mesh

PAIRS = [((0.80, 0.22, 0.10), (0.86, 0.80, 0.66)), ((0.12, 0.42, 0.50), (0.86, 0.80, 0.66)),
         ((0.90, 0.62, 0.14), (0.30, 0.16, 0.12)), ((0.42, 0.16, 0.42), (0.84, 0.78, 0.72))]


def write(folder):
    write_ply(folder / "shaft.ply", turned([(0.17, 0.22), (0.155, 1.2), (0.14, 2.2)], 32, twist=0.75))
    write_ply(folder / "ends.ply", turned([(0.27, 0.0), (0.27, 0.12), (0.20, 0.22), (0.17, 0.22)], 32))
    rng = Random(1895)
    lines = ["# Made by generate.py: columns, then marbles."]
    for k in range(12):
        for side in (-1, 1):
            pair = PAIRS[(k + (side > 0)) % 4]
            z = 2.35 + 1.7 * k + (0.5 if side > 0 else 0)
            lines.append(f"AttributeBegin  Translate {1.3 * side:.4g} 0 {z:.4g}  Rotate {360 * rng.random():.0f} 0 1 0")
            lines += textured(f"column{len(lines)}", (10, 3), pair, '"plymesh" "string filename" "dolly/shaft.ply"')
            lines.append('Material "diffuse" "rgb reflectance" [0.66 0.62 0.55]')
            lines.append('Shape "plymesh" "string filename" "dolly/ends.ply"')
            lines.append('Translate 0 2.2 0  Shape "sphere" "float radius" 0.24')
            lines.append("AttributeEnd")
    for k in range(26):
        z = 2.6 + 12 * rng.random() ** 1.3
        x = (2 * rng.random() - 1) * 0.9
        radius = 0.08 + 0.12 * rng.random()
        if abs(x) < 0.3 or k % 3 == 0:
            x = math.copysign(1.75 + 1.2 * rng.random(), x)
        lines.append(f"AttributeBegin  Translate {x:.3f} {radius:.3f} {z:.3f}  Rotate {360 * rng.random():.0f} 1 1 0")
        lines += textured(f"marble{k}", (8, 6), PAIRS[rng.randrange(4)], f'"sphere" "float radius" {radius:.3f}')
        lines.append("AttributeEnd")
    (folder / "avenue.pbrt").write_text("\n".join(lines) + "\n")


def textured(name, checks, colours, shape):
    first, second = (f"[{c[0]:.3g} {c[1]:.3g} {c[2]:.3g}]" for c in colours)
    return [f'Texture "{name}" "spectrum" "checkerboard" "float uscale" {checks[0]} "float vscale" {checks[1]}'
            f' "rgb tex1" {first} "rgb tex2" {second}',
            f'Material "diffuse" "texture reflectance" "{name}"', f"Shape {shape}"]


def turned(outline, segments, twist=0.0):
    """A surface of revolution around y through (radius, height); u goes around, by `twist` more from foot to top."""
    mesh = Mesh()
    rows = len(outline) - 1

    def point(i, j):
        radius, height = outline[i]
        angle = 2 * math.pi * (j % segments) / segments
        return (radius * math.cos(angle), height, radius * math.sin(angle))

    mesh.grid(rows, segments, point, lambda i, j: (j / segments + twist * i / rows, i / rows))
    return mesh
