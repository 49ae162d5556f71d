"""butterflies: a swarm with two bilinear patches each, which beat and fly, and a meadow far behind."""

import math
from random import Random
from .files import write_png
from .geometry import dot, lerp, mul, sub, unit

FOCAL_PX = 135 / math.tan(math.radians(15))
COUNT = 210
LIGHT = unit((-0.2, 0.6, -1.0))  # as in butterflies.pbrt
PAIRS = [((0.88, 0.42, 0.05), (0.07, 0.05, 0.05)), ((0.90, 0.78, 0.22), (0.16, 0.10, 0.07)),
         ((0.12, 0.36, 0.78), (0.04, 0.05, 0.12)), ((0.92, 0.90, 0.84), (0.20, 0.18, 0.20)),
         ((0.72, 0.14, 0.10), (0.08, 0.05, 0.06)), ((0.48, 0.24, 0.62), (0.92, 0.86, 0.70))]
WING = [(0.03, -0.34), (0.78, -0.62), (0.05, 0.30), (1.0, 0.62)]  # p00, p10, p01, p11: from the body outwards


def write(folder):
    write_png(folder / "veins.png", 64, 64, veins)
    write_png(folder / "spots.png", 64, 64, spots)
    write_png(folder / "meadow.png", 256, 128, meadow(Random(7)))
    lines = ["# Made by generate.py: colours, then butterflies from afar to near. Each goes from its place at StartTime to",
             "# that at EndTime, while its wings turn about the body."]
    for pattern in ("veins", "spots"):
        for k, pair in enumerate(PAIRS):
            first, second = (f"[{c[0]:.3g} {c[1]:.3g} {c[2]:.3g}]" for c in pair)
            lines.append(f'Texture "{pattern}{k}" "spectrum" "mix" "rgb tex1" {first} "rgb tex2" {second}'
                         f' "texture amount" "{pattern}"')
    rng = Random(20110808)
    swarm = []
    while len(swarm) < COUNT:
        item = Butterfly(rng, len(swarm))
        if not any(shades(item, other) for other in swarm):
            swarm.append(item)
    for item in sorted(swarm, key=lambda item: -item.depth):
        lines += item.lines(rng)
    (folder / "swarm.pbrt").write_text("\n".join(lines) + "\n")


class Butterfly:
    def __init__(self, rng, k):
        u = rng.random()
        # A few near the camera, more than half around the focus, the rest beyond.
        z = 2.7 + 1.5 * u if k < 8 else 6.3 + 4 * u if k < 0.55 * COUNT else 10 + 12 * u
        at = ((2 * rng.random() - 1) * 265, (2 * rng.random() - 1) * 150)
        self.way_angle = 2 * math.pi * rng.random()
        way_px = 4 + 56 * rng.random() ** 1.8 * min(1.0, 10 / z)
        towards = (2 * rng.random() - 1) * 0.09 * z
        way = (math.cos(self.way_angle), math.sin(self.way_angle))
        self.depth, self.size = z, 0.22 + 0.09 * rng.random()
        self.ends = [
            tuple((p + half * way_px * d) * depth / FOCAL_PX for p, d in zip(at, way)) + (depth,)
            for half, depth in ((-0.5, z - towards / 2), (0.5, z + towards / 2))]
        places = [lerp(*self.ends, t) for t in (0.0, 0.25, 0.5, 0.75, 1.0)]
        self.shadows = [sub(place, mul(LIGHT, dot(place, LIGHT))) for place in places]

    def lines(self, rng):
        # Heads along the way, more or less, and leaning towards the camera.
        head = math.degrees(self.way_angle) - 90 + 50 * (rng.random() - 0.5)
        pitch, roll = -18 - 22 * rng.random(), 50 * (rng.random() - 0.5)
        beat = [8 + 12 * rng.random(), 34 + 24 * rng.random()]
        rng.shuffle(beat)
        texture = f"{('veins', 'spots')[rng.randrange(2)]}{rng.randrange(len(PAIRS))}"
        way = sub(self.ends[1], self.ends[0])
        lines = [f'AttributeBegin  Material "diffuse" "texture reflectance" "{texture}"',
                 "Translate {:.3f} {:.3f} {:.3f}  ActiveTransform EndTime".format(*self.ends[0])
                 + "  Translate {:.3f} {:.3f} {:.3f}  ActiveTransform All".format(*way)
                 + f"  Rotate {head:.0f} 0 0 1  Rotate {pitch:.0f} 1 0 0  Rotate {roll:.0f} 0 1 0"]
        for side in (1, -1):
            points = "  ".join(f"{side * self.size * x:.3f} {self.size * y:.3f} 0" for x, y in WING)
            # Normals along the body, about which wings turn: their beat does not change how bright they are.
            lines.append(f"AttributeBegin  ActiveTransform StartTime  Rotate {side * beat[0]:.0f} 0 1 0"
                         f"  ActiveTransform EndTime  Rotate {side * beat[1]:.0f} 0 1 0"
                         f'  Shape "bilinearmesh" "point3 P" [{points}]'
                         ' "normal3 N" [0 1 0  0 1 0  0 1 0  0 1 0]  AttributeEnd')
        return lines + ["AttributeEnd"]


def shades(a, b):
    """Whether the shadow of one meets the other while the shutter is open: it would move otherwise than both."""
    reach = 1.05 * (a.size + b.size)
    return any(math.dist(p, q) < reach for p, q in zip(a.shadows, b.shadows))


def veins(x, y):
    """Dark towards the rim and along lines that spread from the body."""
    u, v = (x + 0.5) / 64, (y + 0.5) / 64
    line = abs(((v - 0.5) * 7 / (0.35 + u)) % 1 - 0.5) < 0.09
    dark = u > 0.84 or v > 0.92 or v < 0.08 or line
    return (1.0, 1.0, 1.0) if dark else (0.0, 0.0, 0.0)


def spots(x, y):
    u, v = (x + 0.5) / 64, (y + 0.5) / 64
    eye = math.hypot(u - 0.62, v - 0.66)
    dark = 0.12 < eye < 0.2 or eye < 0.05 or math.hypot(u - 0.5, v - 0.25) < 0.11 or (u > 0.86 and (v * 6) % 1 < 0.6)
    return (1.0, 1.0, 1.0) if dark else (0.0, 0.0, 0.0)


def meadow(rng):
    """pixel(x, y) of a picture that repeats: flowers and dark patches on green."""
    flowers = []
    for _ in range(45):
        colour = [(0.93, 0.90, 0.80), (0.90, 0.72, 0.25), (0.75, 0.25, 0.22), (0.45, 0.40, 0.75), (0.12, 0.30, 0.16),
                  (0.16, 0.36, 0.14)][rng.randrange(6)]
        flowers.append((256 * rng.random(), 128 * rng.random(), 2.5 + 4 * rng.random(), colour))

    def pixel(x, y):
        colour = (0.36, 0.52, 0.24) if (x // 8 + y // 8) % 2 else (0.28, 0.45, 0.22)
        for fx, fy, radius, c in flowers:
            dx, dy = (abs(x + 0.5 - fx + 128) % 256 - 128), (abs(y + 0.5 - fy + 64) % 128 - 64)
            if math.hypot(dx, dy) < radius:
                colour = c
        return colour

    return pixel
