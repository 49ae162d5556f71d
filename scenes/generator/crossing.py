"""crossing: things that cross the view, placed by where they stand on the picture and how far they go there."""

import math
from .files import write_ply
from .geometry import Mesh

FOCAL_PX = 135 / math.tan(math.radians(15))

RED, ORANGE, YELLOW, GREEN = (0.80, 0.13, 0.08), (0.88, 0.40, 0.08), (0.90, 0.66, 0.16), (0.14, 0.52, 0.30)
BLUE, VIOLET, PALE, DARK = (0.08, 0.30, 0.62), (0.42, 0.15, 0.48), (0.88, 0.84, 0.74), (0.10, 0.10, 0.13)

MESHES = {"box": "box", "wheel": "wheel", "disc": "wheel"}
TILTS = {"box": [(8, 48), (0, 2), (-8, -21)], "wheel": [(12, 20), (1, -3), (-10, 25)], "disc": [(0, 0)] * 3}

# Shadows of one thing on another would move otherwise than both, and so would the light on boxes and balls that turn:
# neither is in this list. Each row: kind; place on the picture in pixels from its middle, and depth, half way; the way in pixels and in depth; half of
# the size in pixels; turn of a wheel about its axle over the shutter, in degrees; checks; colours
THINGS = [
    ("ball", (-120, -60), 2.9, (80, 6), 0.0, 44, 0, (4, 3), RED, YELLOW),         # near and fast
    ("wheel", (166, 74), 4.2, (-44, -14), 0.0, 46, 0, (6, 1), YELLOW, VIOLET),
    ("ball", (62, -112), 4.0, (-66, 22), 0.0, 20, 0, (4, 3), GREEN, PALE),
    ("disc", (-26, 4), 8.0, (-26, 6), 0.0, 37, 0, (10, 2), BLUE, PALE),          # in focus: one right before another
    ("disc", (8, -6), 7.98, (42, 2), 0.0, 25, -25, (8, 2), ORANGE, DARK),
    ("ball", (-120, 69), 8.0, (12, -20), 0.0, 26, 0, (8, 6), YELLOW, RED),
    ("ball", (70, 66), 7.4, (18, 10), -2.6, 25, 0, (8, 6), VIOLET, PALE),        # towards the camera, out of focus and in
    ("box", (78, -86), 6.3, (-22, 12), 2.6, 34, 0, (5, 5), GREEN, YELLOW),      # away, through the plane in focus
    ("box", (-206, 74), 6.0, (-5, 2), 0.0, 30, 0, (4, 4), BLUE, PALE),           # slow
    ("ball", (-30, 92), 9.6, (58, -30), 0.0, 17, 0, (8, 6), PALE, RED),
    ("wheel", (-196, -16), 9.0, (36, 34), 0.0, 25, 30, (9, 2), GREEN, PALE),     # turns as it goes
    ("box", (206, -14), 10.0, (0, -46), 0.0, 22, 0, (4, 4), RED, PALE),
    ("ball", (-133, -33), 11.0, (-40, 0), 0.0, 18, 0, (8, 5), BLUE, YELLOW),
    ("ball", (126, 14), 12.5, (-28, -8), 0.0, 19, 0, (8, 6), ORANGE, PALE),
    ("wheel", (-131, 100), 13.0, (64, 0), 0.0, 19, 0, (8, 2), DARK, ORANGE),     # far and fast
    ("box", (74, 74), 13.5, (-8, -5), 0.0, 16, 0, (4, 4), VIOLET, YELLOW),
    ("wheel", (104, -87), 12.0, (24, 10), -3.0, 21, 0, (8, 2), PALE, BLUE),     # from afar
    ("ball", (-6, -64), 5.4, (9, 30), 0.0, 15, 0, (6, 5), PALE, DARK),
    ("box", (-166, -112), 7.0, (30, 14), 0.8, 20, 0, (4, 4), PALE, RED),
    ("ball", (40, -38), 14.0, (-50, 20), 0.0, 14, 0, (8, 6), YELLOW, GREEN),
]


def write(folder):
    write_ply(folder / "box.ply", box())
    write_ply(folder / "wheel.ply", wheel())
    lines = ["# Made by generate.py: each thing goes from its transform at StartTime to that at EndTime."]
    for index, thing in enumerate(THINGS):
        lines += place(f"thing{index}", index, *thing)
    (folder / "things.pbrt").write_text("\n".join(lines) + "\n")


def place(name, index, kind, at, depth, way, toward, size, turn, checks, first, second):
    def world(side):
        z = depth + 0.5 * side * toward
        return tuple((p + 0.5 * side * d) * z / FOCAL_PX for p, d in zip(at, way)) + (z,)

    start, end = world(-1), world(1)
    radius = size * depth / FOCAL_PX
    first, second = (f"[{c[0]:.3g} {c[1]:.3g} {c[2]:.3g}]" for c in (first, second))
    lines = ["AttributeBegin",
             f'    Texture "{name}" "spectrum" "checkerboard" "float uscale" {checks[0]} "float vscale" {checks[1]}'
             f' "rgb tex1" {first} "rgb tex2" {second}',
             f'    Material "diffuse" "texture reflectance" "{name}"',
             "    Translate {:.4f} {:.4f} {:.4f}".format(*start),
             "    ActiveTransform EndTime  Translate {:.4f} {:.4f} {:.4f}".format(*(b - a for a, b in zip(start, end)))
             + "  ActiveTransform All"]
    if kind == "ball":
        lines.append(f'    Rotate {-70 - 13 * (index % 4)} 1 0.2 0  Shape "sphere" "float radius" {radius:.4f}')
    else:
        x, y = TILTS[kind][index % 3]
        lines.append(f"    Rotate {x} 1 0 0  Rotate {y} 0 1 0"
                     + (f"  ActiveTransform EndTime  Rotate {turn} 0 0 1  ActiveTransform All" if turn else "")
                     + f"  Scale {radius:.4f} {radius:.4f} {radius:.4f}")
        lines.append(f'    Shape "plymesh" "string filename" "crossing/{MESHES[kind]}.ply"')
    return lines + ["AttributeEnd"]


def box():
    """A cube whose corners are at 1.25 from its centre; u and v go once over each side."""
    mesh, half = Mesh(), 0.72
    for axis in range(3):
        for sign in (-1, 1):
            def point(i, j):
                p = [0.0, 0.0, 0.0]
                p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = sign * half, (2 * i - 1) * half, sign * (2 * j - 1) * half
                return tuple(p)

            mesh.grid(1, 1, point, lambda i, j: (float(i), float(j)))
    return mesh


def wheel(holes=6, steps=8):
    """A flat wheel of radius 1 that faces -z, with wedges cut out: u goes around, v outwards."""
    mesh = Mesh()

    def band(inner, outer, first, last, count):
        def point(i, j):
            r, angle = (inner, outer)[i], first + (last - first) * j / count
            return (r * math.cos(angle), r * math.sin(angle), 0.0)

        mesh.grid(1, count, point, lambda i, j: ((first + (last - first) * j / count) / (2 * math.pi), (inner, outer)[i]))

    band(0.72, 1.0, 0.0, 2 * math.pi, holes * steps)
    band(0.0, 0.34, 0.0, 2 * math.pi, holes * steps)
    for k in range(holes):
        band(0.34, 0.72, 2 * math.pi * k / holes, 2 * math.pi * (k + 0.42) / holes, steps // 2)
    return mesh
