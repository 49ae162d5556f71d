#!/usr/bin/env bash
# Installs what is missing, builds the program, and renders scenes/row.pbrt from 8 samples per pixel into out/, on the
# best Vulkan device (Mesa's lavapipe included). Beside it: the same 8 samples, only filtered, and a reference, so that
# you can compare all three side by side. Works as root or with sudo, without a display.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf '\n== %s\n' "$*"; }

say "Debian packages that are missing"
cmake/install_packages.sh

say "Building preset release"
cmake --preset release
cmake --build --preset release --target slant

slant=build/release/slant
scene=scenes/row.pbrt
mkdir -p out

say "Vulkan devices"
"$slant" devices

say "8 samples per pixel, reconstructed"
"$slant" render "$scene" --spp 8 --exposure 0.3 -o out/row.exr --png out/row.png --stats out/row.json

say "The same 8 samples per pixel, only filtered"
"$slant" render "$scene" --spp 8 --exposure 0.3 --method box -o out/row-input.exr --png out/row-input.png

say "Brute force with 256 samples per pixel, as a reference"
"$slant" reference "$scene" --spp 256 --exposure 0.3 -o out/row-reference.exr --png out/row-reference.png

say "Distance to that reference: the filtered input, then the reconstruction"
"$slant" diff out/row-input.exr out/row-reference.exr
"$slant" diff out/row.exr out/row-reference.exr

python3 scenes/side_by_side.py out/row-side-by-side.png out/row-input.png out/row.png out/row-reference.png

say "Done"
cat <<'END'
out/row.exr, out/row.png    the reconstructed picture
out/row.json                what each stage cost
out/row-side-by-side.png    input samples | reconstructed | reference
END
