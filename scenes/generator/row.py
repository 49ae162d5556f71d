"""row: the floor of planks; the dragons themselves are placed by hand in row.pbrt."""

import math
from random import Random
from .files import write_png


def write(folder):
    rng = Random(7)
    boards = [(0.75 + 0.35 * rng.random(), rng.random(), rng.random()) for _ in range(8)]
    phases = [2 * math.pi * rng.random() for _ in range(12)]

    def planks(x, y):
        board = x // 32
        shade, start, twist = boards[board]
        across = (x % 32) / 32
        along = (y / 256 + start) % 1
        grain = sum(math.sin(2 * math.pi * (k + 1) * (across * 1.3 + twist + 0.05 * math.sin(2 * math.pi * along + phases[k])))
                    / (k + 1) for k in range(12))
        seam = 0.45 if x % 32 == 0 or int(along * 256) == 0 else 1.0
        tone = shade * seam * (0.86 + 0.07 * grain)
        return (0.62 * tone, 0.47 * tone, 0.36 * tone)

    write_png(folder / "planks.png", 256, 256, planks)
