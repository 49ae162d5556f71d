"""spin: a wheel of flat parts with polar textures around the z axis, facing -z, and the stand that holds it."""

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
    write_ply(folder / "tyre.ply", ring(1.10, 1.28, 0.07))
    write_ply(folder / "rim.ply", ring(0.94, 1.10, 0.06))
    write_ply(folder / "spoke.ply", spoke())
    write_ply(folder / "hub.ply", ring(0.0, 0.26, 0.06))
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

    lines = ["# Made by generate.py: the leg, close before the wheel, so that its shadow hides behind it; the axle's cap."]
    lines += material("leg", (1, 14), (0.55, 0.60, 0.64), (0.16, 0.24, 0.32))
    lines += ['NamedMaterial "leg"',
              'Shape "trianglemesh" "point3 P" [-0.16 -3 5.92  0.16 -3 5.92  0.07 0 5.92  -0.07 0 5.92]'
              ' "point2 uv" [0 0  1 0  1 1  0 1] "integer indices" [0 2 1  0 3 2]',
              'Material "diffuse" "rgb reflectance" [0.8 0.78 0.72]',
              'AttributeBegin  Translate 0 0 5.91  Shape "disk" "float radius" 0.11  AttributeEnd']
    (folder / "stand.pbrt").write_text("\n".join(lines) + "\n")


def material(name, checks, first, second):
    first, second = (f"[{c[0]:.3g} {c[1]:.3g} {c[2]:.3g}]" for c in (first, second))
    return [f'Texture "{name}" "spectrum" "checkerboard" "float uscale" {checks[0]} "float vscale" {checks[1]}'
            f' "rgb tex1" {first} "rgb tex2" {second}',
            f'MakeNamedMaterial "{name}" "string type" "diffuse" "texture reflectance" "{name}"']


def ring(inner, outer, half, steps=108):
    """A ring with a square section; u goes once around, v from the inside to the outside."""
    mesh = Mesh()
    loop = [(inner, half), (inner, -half), (outer, -half), (outer, half)]
    for (r0, z0), (r1, z1) in zip(loop, loop[1:]):
        v0, v1 = (0.0 if r == inner else 1.0 for r in (r0, r1))

        def point(i, j):
            angle = 2 * math.pi * (j % steps) / steps
            r, z = ((r0, z0), (r1, z1))[i]
            return (r * math.cos(angle), r * math.sin(angle), z)

        if (r0, z0) != (r1, z1) and max(r0, r1) > 0:
            mesh.grid(1, steps, point, lambda i, j: (j / steps, (v0, v1)[i]))
    return mesh


def spoke():
    """From the hub to the rim along x, tapered, with a square section; u goes across each side, v along it."""
    mesh = Mesh()
    ends = [(0.22, 0.11, 0.05), (0.97, 0.07, 0.04)]  # distance from the axle, half of the width and of the depth
    corners = [(-1, 1), (-1, -1), (1, -1), (1, 1)]
    for (y0, z0), (y1, z1) in zip(corners, corners[1:]):
        mesh.grid(1, 1, lambda i, j: (ends[j][0], ends[j][1] * (y0, y1)[i], ends[j][2] * (z0, z1)[i]),
                  lambda i, j: (i, j))
    return mesh
