#!/usr/bin/env python3
"""Writes the meshes, images and included parts of the scenes beside this file (or below the folder given).

The .pbrt files at the top are written by hand; what they include comes from here. The same script gives the same
bytes on every run, and tests/render/scenes_test.cpp holds the committed files to that.
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
from generator import butterflies, crossing, dolly, dragon, files, foliage, lights, row, spheres, spin  # noqa: E402


def main():
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    scenes = {scene.__name__.split(".")[-1]: scene
              for scene in (spheres, row, lights, foliage, spin, crossing, dolly, butterflies)}
    for folder in ("meshes", *scenes):
        (target / folder).mkdir(parents=True, exist_ok=True)
    files.write_ply(target / "meshes" / "dragon.ply", dragon.dragon())
    for folder, scene in scenes.items():
        scene.write(target / folder)


main()
