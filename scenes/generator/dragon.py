"""A small dragon, coiled up and looking along -z: about two units high, standing on y = 0."""

import math
from .geometry import Mesh, add, sub, mul, dot, cross, unit, lerp, resample, catmull_rom, curved_spike

SEGMENTS = 44       # around the body
RINGS_PER_SCALE = 4
SCALE_ROWS = 84
SCALES_AROUND = 11


def spine():
    """Rings along the body from the tail's tip to the back of the head: (x, y, z, radius, dorsal vector)."""
    points = []
    turns, coil = 1.62, 22
    for k in range(coil + 1):
        a = k / coil
        angle = 0.40 * math.pi - 2 * math.pi * turns * (1 - a)
        out = 1.02 - 0.56 * a ** 0.9
        radius = 0.015 + 0.25 * a ** 0.7
        height = radius * 0.9 + 0.95 * max(0.0, a - 0.72) ** 1.3
        radial = (math.cos(angle), 0, math.sin(angle))
        lift = 0.16 * (1 - a) ** 8  # the tip of the tail points up
        points.append((out * radial[0], height + lift, out * radial[2], radius, 0.75 * radial[0], 1.0, 0.75 * radial[2]))
    points += [(-0.22, 0.72, 0.36, 0.255, -0.4, 0.7, 0.8), (-0.24, 0.95, 0.28, 0.24, -0.2, 0.3, 1.0),
               (-0.12, 1.18, 0.24, 0.21, 0, 0.1, 1.0), (0.02, 1.42, 0.30, 0.185, 0, 0.1, 1.0),
               (0.06, 1.66, 0.33, 0.165, 0, 0.2, 1.0), (0.02, 1.88, 0.20, 0.15, 0, 0.6, 1.0),
               (0.0, 1.98, -0.02, 0.14, 0, 1.0, 0.5), (0.0, 1.96, -0.16, 0.13, 0, 1.0, 0.2)]
    rings = []
    sampled = resample(points, SCALE_ROWS * RINGS_PER_SCALE + 1)
    for i, p in enumerate(sampled):
        before, after = sampled[max(i - 1, 0)], sampled[min(i + 1, len(sampled) - 1)]
        along = unit(sub(after[:3], before[:3]))
        dorsal = unit(sub(p[4:7], mul(along, dot(p[4:7], along))))
        rings.append((p[:3], along, dorsal, p[3]))
    return rings


def scale_relief(i, angle):
    """Overlapping scales on back and flanks, broad plates on the belly; a factor on the radius near 1."""
    around = angle / (2 * math.pi)
    belly = min(1.0, max(0.0, (abs(((around + 0.5) % 1) - 0.5) - 0.33) / 0.05))
    along = i / RINGS_PER_SCALE
    best = 0.0
    for row in (math.floor(along), math.floor(along) - 1):
        q = (along - row) / 2                       # a scale spans two rows; its root lies towards the head
        v = (around * SCALES_AROUND + 0.5 * (row % 2)) % 1 - 0.5
        reach = 1 - (2 * v) ** 2
        best = max(best, (1 - q) * max(0.0, reach) ** 0.4)
    plate = 1 - (along % 1)
    return 1 + 0.21 * ((1 - belly) * best + belly * 0.5 * plate) - 0.10 * belly


def body(mesh):
    rings = spine()
    sweep = [(c, along, dorsal, r, r) for c, along, dorsal, r in rings]
    first = sweep[0]
    sweep.insert(0, (first[0], first[1], first[2], 0.0, 0.0))
    mesh.tube(sweep, SEGMENTS, lambda i, angle: scale_relief(max(i - 1, 0), angle), (SCALE_ROWS / 4, 4))
    for row in range(3, SCALE_ROWS - 2):            # the comb along the back
        c, along, dorsal, r = rings[row * RINGS_PER_SCALE]
        size = (0.32 + 0.38 * r / 0.25) * r + 0.03
        root = add(c, mul(dorsal, 0.98 * r))
        sharp_fin(mesh, root, along, dorsal, size, 0.6 * size)


def sharp_fin(mesh, root, along, up, height, width):
    """A blade swept towards the tail: a flat lens in cross-section."""
    side = unit(cross(along, up))
    sweep = []
    for i in range(5):
        t = i / 4
        centre = add(root, add(mul(up, height * t), mul(along, -0.75 * height * t * t)))
        shrink = (1 - t) ** 0.7
        sweep.append((centre, up, along, 0.16 * width * shrink, width * shrink))
    mesh.tube(sweep, 6)


class Head:
    """Head space: x right, y up, z forward; placed at the end of the neck, looking along -z and a little down."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.origin = (0.0, 1.95, -0.26)
        self.forward = unit((0.0, -0.30, -1.0))
        self.right = (1.0, 0.0, 0.0)
        self.up = unit(cross(self.forward, self.right))
        if self.up[1] < 0:
            self.up = mul(self.up, -1)

    def place(self, p):
        return add(self.origin, add(mul(self.right, p[0]), add(mul(self.up, p[1]), mul(self.forward, p[2]))))

    def turn(self, d):
        return unit(sub(self.place(d), self.origin))

    def loft(self, stations, segments, rings, droop=0.0):
        """A tube through stations (z, y, half width, height above y, depth below y); droop turns it about z = 0."""
        mesh = self.mesh
        sampled = [catmull_rom(stations, (len(stations) - 1) * i / rings) for i in range(rings + 1)]

        def point(i, j):
            z, y, width, above, below = sampled[i]
            angle = 2 * math.pi * (j % segments) / segments
            up = math.cos(angle)
            y += max(0, above) * up if up > 0 else max(0, below) * up
            x = max(0, width) * math.copysign(abs(math.sin(angle)) ** 0.85, math.sin(angle))
            return self.place((x, y * math.cos(droop) - z * math.sin(droop), z * math.cos(droop) + y * math.sin(droop)))

        mesh.grid(rings, segments, point, lambda i, j: (i / rings, j / segments))

    def build(self):
        self.loft([(-0.30, 0.0, 0.0, 0.0, 0.0), (-0.28, 0.0, 0.11, 0.10, 0.11), (-0.16, 0.01, 0.17, 0.15, 0.14),
                   (-0.03, 0.02, 0.195, 0.165, 0.12), (0.07, 0.02, 0.18, 0.15, 0.075), (0.17, 0.015, 0.135, 0.09, 0.05),
                   (0.30, 0.01, 0.108, 0.075, 0.045), (0.42, 0.015, 0.105, 0.08, 0.04), (0.51, 0.02, 0.115, 0.10, 0.04),
                   (0.58, 0.015, 0.095, 0.08, 0.035), (0.625, 0.01, 0.05, 0.04, 0.02), (0.635, 0.01, 0.0, 0.0, 0.0)], 28, 44)
        jaw = [(-0.12, -0.10, 0.0, 0.0, 0.0), (-0.10, -0.10, 0.10, 0.04, 0.05), (0.05, -0.10, 0.12, 0.03, 0.055),
               (0.22, -0.085, 0.092, 0.02, 0.05), (0.40, -0.07, 0.075, 0.02, 0.045), (0.50, -0.06, 0.06, 0.02, 0.05),
               (0.555, -0.055, 0.03, 0.015, 0.03), (0.56, -0.055, 0.0, 0.0, 0.0)]
        self.loft(jaw, 20, 24, droop=0.24)
        for side in (-1, 1):
            self.side_parts(side)

    def side_parts(self, side):
        def spike(root, direction, bend, size, width, segments=8, rings=8):
            bent = sub(self.place(bend), self.origin)
            curved_spike(self.mesh, self.place(root), self.turn(direction), bent, size, width, segments, rings)

        self.mesh.ball(self.place((side * 0.137, 0.085, 0.10)), 0.056, 12)
        spike((side * 0.115, 0.115, 0.19), (side * 0.22, 0.35, -1), (side * 0.04, 0.03, 0), 0.24, 0.05)    # brow
        spike((side * 0.09, 0.13, -0.06), (side * 0.35, 0.75, -0.7), (side * 0.06, 0.14, -0.30), 0.52, 0.058, 10, 14)
        spike((side * 0.15, 0.06, -0.12), (side * 0.9, 0.25, -0.6), (side * 0.02, 0.05, -0.16), 0.26, 0.048)  # ear
        spike((side * 0.16, -0.02, -0.12), (side * 0.9, -0.15, -0.6), (side * 0.0, 0.03, -0.14), 0.21, 0.042)
        spike((side * 0.14, -0.10, -0.10), (side * 0.8, -0.5, -0.6), (side * 0.0, 0.03, -0.12), 0.16, 0.036)
        spike((side * 0.10, 0.03, 0.50), (side * 1.0, 0.15, 0.25), (side * 0.10, -0.28, -0.42), 0.40, 0.016, 6, 14)
        spike((side * 0.045, 0.10, 0.54), (side * 0.3, 1, -0.3), (0, 0.0, -0.04), 0.06, 0.03, 8, 4)           # nostril
        for k in range(5):                                                                                    # teeth
            z = 0.20 + 0.082 * k
            spike((side * (0.098 - 0.004 * abs(k - 2)), -0.01, z), (side * 0.05, -1, 0.1), (0, 0, -0.01),
                  0.085 if k == 4 else 0.055, 0.017, 5, 3)


def leg(mesh, joints, radii):
    """An arm through its joints, with four claws at its end."""
    points = [tuple(j) + (r,) for j, r in zip(joints, radii)]
    sampled = resample(points, 22)
    sweep = []
    for i, p in enumerate(sampled):
        along = unit(sub(sampled[min(i + 1, 21)][:3], sampled[max(i - 1, 0)][:3]))
        up = unit(sub((0.2, 1.0, 0.1), mul(along, dot((0.2, 1.0, 0.1), along))))
        radius = p[3] * (1 + 0.06 * (i % 2))
        sweep.append((p[:3], along, up, radius, radius))
    sweep.append(sweep[-1][:3] + (0.0, 0.0))
    mesh.tube(sweep, 14)
    centre, along, up = sweep[-1][:3]
    for k in range(4):
        spread = (k - 1.5) * 0.55
        side = unit(cross(along, up))
        direction = unit(add(mul(along, math.cos(spread)), mul(side, math.sin(spread))))
        curved_spike(mesh, add(centre, mul(along, -0.02)), direction, (0, -0.10, 0), 0.17, 0.042, 7, 6)


def dragon():
    mesh = Mesh()
    body(mesh)
    Head(mesh).build()
    leg(mesh, [(0.02, 1.02, 0.22), (0.24, 0.98, 0.10), (0.40, 0.78, -0.06), (0.34, 0.66, -0.30), (0.30, 0.60, -0.42)],
        [0.13, 0.11, 0.085, 0.07, 0.075])
    leg(mesh, [(-0.22, 1.02, 0.22), (-0.44, 0.98, 0.08), (-0.58, 0.80, -0.10), (-0.46, 0.64, -0.32), (-0.40, 0.58, -0.44)],
        [0.13, 0.11, 0.085, 0.07, 0.075])
    return mesh
