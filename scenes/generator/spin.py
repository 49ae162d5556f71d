"""spin: a flat wheel with polar textures around the z axis, facing -z, and the leg that holds it."""

import math
from .files import write_ply
from .geometry import Mesh

SPOKES = 7
COLOURS = [(0.80, 0.16, 0.07), (0.90, 0.62, 0.14), (0.10, 0.45, 0.62)]
PALE, DARK = (0.86, 0.82, 0.72), (0.10, 0.10, 0.12)


# Name, sectors and bands of its checks, colours.
PARTS = [("tyre", (16, 2), DARK, (0.58, 0.55, 0.50)), ("rim", (12, 1), PALE, (0.72, 0.09, 0.12))]
PARTS += [(f"spoke{k}", (2, 2 + k % 3), COLOURS[k % 3], PALE) for k in range(SPOKES)]
PARTS += [("hub", (6, 2), (0.88, 0.70, 0.26), (0.12, 0.20, 0.34))]


def write(folder):
    write_ply(folder / "tyre.ply", ring(1.10, 1.28))
    write_ply(folder / "rim.ply", ring(0.94, 1.10))
    write_ply(folder / "spoke.ply", spoke())
    write_ply(folder / "hub.ply", ring(0.0, 0.26))
    lines = ["# Made by generate.py: materials of the wheel. They stand apart since textures do not move."]
    for name, checks, first, second in PARTS:
        lines += material(name, checks, first, second)
    (folder / "materials.pbrt").write_text("\n".join(lines) + "\n")

    lines = ["# Made by generate.py: tyre, rim, spokes and hub around the z axis."]
    for name, *_ in PARTS:
        angle = 360 / SPOKES * int(name[5:]) if name.startswith("spoke") else 0
        mesh = "spoke" if name.startswith("spoke") else name
        lines.append(f'AttributeBegin  NamedMaterial "{name}"  Rotate {angle:.4g} 0 0 1'
                     f'  Shape "plymesh" "string filename" "spin/{mesh}.ply"  AttributeEnd')
    (folder / "wheel.pbrt").write_text("\n".join(lines) + "\n")

    lines = ["# Made by generate.py: the leg, so close before the wheel that its shadow hides behind it; the axle's cap."]
    lines += material("leg", (1, 14), (0.55, 0.60, 0.64), (0.16, 0.24, 0.32))
    lines += ['NamedMaterial "leg"',
              'Shape "trianglemesh" "point3 P" [-0.16 -3 5.996  0.16 -3 5.996  0.07 0 5.996  -0.07 0 5.996]'
              ' "point2 uv" [0 0  1 0  1 1  0 1] "integer indices" [0 2 1  0 3 2]',
              'Material "diffuse" "rgb reflectance" [0.8 0.78 0.72]',
              'AttributeBegin  Translate 0 0 5.993  Shape "disk" "float radius" 0.11  AttributeEnd']
    (folder / "stand.pbrt").write_text("\n".join(lines) + "\n")


def material(name, checks, first, second):
    first, second = (f"[{c[0]:.3g} {c[1]:.3g} {c[2]:.3g}]" for c in (first, second))
    return [f'Texture "{name}" "spectrum" "checkerboard" "float uscale" {checks[0]} "float vscale" {checks[1]}'
            f' "rgb tex1" {first} "rgb tex2" {second}',
            f'MakeNamedMaterial "{name}" "string type" "diffuse" "texture reflectance" "{name}"']


def ring(inner, outer, steps=108):
    """u goes once around, v from the inside to the outside."""
    mesh = Mesh()

    def point(i, j):
        r, angle = (inner, outer)[i], 2 * math.pi * (j % steps) / steps
        return (r * math.cos(angle), r * math.sin(angle), 0.0)

    mesh.grid(1, steps, point, lambda i, j: (j / steps, float(i)))
    return mesh


def spoke():
    """From the hub to the rim along x, tapered; u goes across, v along it."""
    mesh = Mesh()
    ends = [(0.25, 0.11), (0.95, 0.07)]  # distance from the axle, half of the width
    mesh.grid(1, 1, lambda i, j: (ends[j][0], (2 * i - 1) * ends[j][1], 0.002), lambda i, j: (float(i), float(j)))
    return mesh
