#!/usr/bin/env bash
# tests/install/check.sh BUILD_DIR: installs the build, moves the tree, and builds and runs against it the program that
# host/render/README.md shows.
set -euo pipefail
build=$1
source="$(cd "$(dirname "$0")" && pwd)"
root="$(cd "$source/../.." && pwd)"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/moved"
"$scratch/moved/bin/slant" --help >/dev/null
mkdir "$scratch/consumer"
cp "$source/CMakeLists.txt" "$scratch/consumer"
sed -n '/^```cpp$/,/^```$/{/^```/!p}' "$root/host/render/README.md" > "$scratch/consumer/consumer.cpp"
cmake -S "$scratch/consumer" -B "$scratch/consumer/build" -G Ninja -Dslant_ROOT="$scratch/moved" >/dev/null
cmake --build "$scratch/consumer/build"
cd "$scratch"
"$scratch/consumer/build/consumer" "$source/scene.pbrt"
for file in picture.exr field.exr near.exr; do
    [[ -s $file ]] || { echo "error: the example has not written $file" >&2; exit 1; }
done
if grep -rl "$scratch/first" "$scratch/moved"; then
    echo "error: the files above hold the path of the first prefix" >&2
    exit 1
fi
