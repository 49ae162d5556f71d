#!/usr/bin/env bash
# tests/format.sh [--fix]: checks that C++ and GLSL are formatted as .clang-format has it, or formats them.
set -euo pipefail
cd "$(dirname "$0")/.."

case "$#:${1-}" in
    0:) action=(--dry-run --Werror) ;;
    1:--fix) action=(-i) ;;
    *) echo "usage: tests/format.sh [--fix]" >&2; exit 2 ;;
esac

find host tests shaders scenes -name '*.cpp' -o -name '*.h' | xargs clang-format "${action[@]}"
# clang-format takes a file for C++ by its name, so that GLSL goes through copies with another.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cp .clang-format "$scratch"
find shaders -name '*.comp' -o -name '*.glsl' | while read -r shader; do
    copy="$scratch/$(basename "$shader").cpp"
    cp "$shader" "$copy"
    clang-format "${action[@]}" "$copy"
    cmp -s "$copy" "$shader" || cp "$copy" "$shader"
done
