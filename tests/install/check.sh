#!/usr/bin/env bash
# tests/install/check.sh BUILD_DIR: installs the build, moves the tree, and builds and runs a program against it.
set -euo pipefail
build=$1
source="$(cd "$(dirname "$0")" && pwd)"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/moved"
"$scratch/moved/bin/slant" --help >/dev/null
cmake -S "$source" -B "$scratch/consumer" -G Ninja -Dslant_ROOT="$scratch/moved" >/dev/null
cmake --build "$scratch/consumer"
"$scratch/consumer/consumer"
if grep -rl "$scratch/first" "$scratch/moved"; then
    echo "error: the files above hold the path of the first prefix" >&2
    exit 1
fi
