"""Vectors as tuples, smooth curves, and a mesh that is put together from swept tubes and sheets."""

import math


def add(a, b): return (a[0] + b[0], a[1] + b[1], a[2] + b[2])
def sub(a, b): return (a[0] - b[0], a[1] - b[1], a[2] - b[2])
def mul(a, s): return (a[0] * s, a[1] * s, a[2] * s)
def dot(a, b): return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
def length(a): return math.sqrt(dot(a, a))
def unit(a): return mul(a, 1 / length(a))
def lerp(a, b, t): return tuple(x + (y - x) * t for x, y in zip(a, b))


def catmull_rom(points, t):
    """Uniform Catmull-Rom through tuples of any length; t from 0 to len(points) - 1."""
    i = min(int(t), len(points) - 2)
    f = t - i
    p0, p1, p2, p3 = (points[min(max(i + k, 0), len(points) - 1)] for k in (-1, 0, 1, 2))
    return tuple(0.5 * (2 * b + (c - a) * f + (2 * a - 5 * b + 4 * c - d) * f * f + (3 * b - a - 3 * c + d) * f ** 3)
                 for a, b, c, d in zip(p0, p1, p2, p3))


def resample(points, count):
    """`count` tuples along the Catmull-Rom curve, evenly spaced by the length of the first three coordinates."""
    fine = [catmull_rom(points, (len(points) - 1) * i / (40 * len(points))) for i in range(40 * len(points) + 1)]
    reached = [0.0]
    for a, b in zip(fine, fine[1:]):
        reached.append(reached[-1] + length(sub(b, a)))
    result, k = [], 0
    for i in range(count):
        wanted = reached[-1] * i / (count - 1)
        while k < len(fine) - 2 and reached[k + 1] < wanted:
            k += 1
        result.append(lerp(fine[k], fine[k + 1], (wanted - reached[k]) / (reached[k + 1] - reached[k])))
    return result


class Mesh:
    """Positions, uvs and faces; normals are smooth over equal positions of one part."""

    def __init__(self):
        self.positions, self.uvs, self.faces, self.parts, self.part = [], [], [], [], 0

    def begin_part(self):
        self.part += 1

    def vertex(self, position, uv):
        self.positions.append(position)
        self.uvs.append(uv)
        self.parts.append(self.part)
        return len(self.positions) - 1

    def triangle(self, a, b, c):
        if len({self.positions[i] for i in (a, b, c)}) == 3:
            self.faces.append((a, b, c))

    def grid(self, rows, columns, point, uv):
        """A part of (rows + 1) x (columns + 1) vertices: point(i, j), uv(i, j); two triangles per cell."""
        self.begin_part()
        index = [[self.vertex(point(i, j), uv(i, j)) for j in range(columns + 1)] for i in range(rows + 1)]
        for i in range(rows):
            for j in range(columns):
                a, b, c, d = index[i][j], index[i + 1][j], index[i + 1][j + 1], index[i][j + 1]
                self.triangle(a, c, b)
                self.triangle(a, d, c)

    def tube(self, rings, segments, outline=lambda i, angle: 1.0, uv_scale=(1, 1)):
        """Sweeps rings of (centre, along, up, half width, half height); angle 0 is up. Closed by zero-size rings."""
        def point(i, j):
            centre, along, up, width, height = rings[i]
            side = unit(cross(along, up))
            angle = 2 * math.pi * (j % segments) / segments
            r = outline(i, angle)
            return add(centre, add(mul(up, height * r * math.cos(angle)), mul(side, width * r * math.sin(angle))))

        self.grid(len(rings) - 1, segments, point,
                  lambda i, j: (uv_scale[0] * i / (len(rings) - 1), uv_scale[1] * j / segments))

    def ball(self, centre, radius, segments):
        def point(i, j):
            theta, phi = math.pi * i / segments, math.pi * (j % (2 * segments)) / segments
            if i in (0, segments):
                return add(centre, (0, radius if i == 0 else -radius, 0))
            return add(centre, mul((math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)), radius))

        self.grid(segments, 2 * segments, point, lambda i, j: (j / (2 * segments), i / segments))

    def normals(self):
        sums = {}
        for face in self.faces:
            corners = [self.positions[i] for i in face]
            normal = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]))
            for i in face:
                key = (self.parts[i], self.positions[i])
                sums[key] = add(sums.get(key, (0, 0, 0)), normal)
        result = []
        for part, position in zip(self.parts, self.positions):
            normal = sums.get((part, position), (0, 1, 0))
            result.append(unit(normal) if length(normal) > 0 else (0, 1, 0))
        return result


def curved_spike(mesh, root, direction, bend, size, width, segments=6, rings=5):
    """A horn-like spike of length `size` that leaves along `direction` and bends by the vector `bend` at its tip."""
    def centre(t): return add(root, add(mul(direction, size * t), mul(bend, t * t)))
    sweep = []
    for i in range(rings + 1):
        t = i / rings
        along = unit(sub(centre(t + 0.01), centre(t - 0.01)))
        reference = (0, 1, 0) if abs(along[1]) < 0.9 else (1, 0, 0)
        up = unit(sub(reference, mul(along, dot(reference, along))))
        radius = width * (1 - t) ** 0.8 if i < rings else 0.0
        sweep.append((centre(t), along, up, radius, radius))
    sweep.insert(0, sweep[0][:3] + (0.0, 0.0))
    mesh.tube(sweep, segments)
