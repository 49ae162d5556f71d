#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors, checks the formatting and runs every test:
#     bash tests/run.sh                the release build
#     bash tests/run.sh --sanitizers   address + undefined behaviour and thread sanitizers first, then release
# Works as root or with sudo, without a display, and without a GPU: the tests run on Mesa's lavapipe.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() { echo "usage: tests/run.sh [--sanitizers]" >&2; exit 2; }
presets=(release)
case "$#:${1-}" in
    0:) ;;
    1:--sanitizers) presets=(asan-ubsan tsan release) ;;
    *) usage ;;
esac

say() { printf '\n== %s\n' "$*"; }

say "Debian packages"
cmake/install_packages.sh

say "Formatting"
tests/format.sh
echo "as .clang-format has it"

# One driver for every machine, so that a GPU driver's arithmetic cannot decide a comparison to the bit.
lavapipe=$(find /usr/share/vulkan/icd.d /usr/local/share/vulkan/icd.d /etc/vulkan/icd.d \
    -name 'lvp_icd*.json' 2>/dev/null | head -n 1 || true)
if [[ -n $lavapipe ]]; then
    export VK_DRIVER_FILES="$lavapipe" VK_ICD_FILENAMES="$lavapipe"
fi
export SLANT_VALIDATE=1

for preset in "${presets[@]}"; do
    say "Building preset $preset (shaders pass spirv-val on the way)"
    cmake --preset "$preset" -DSLANT_WERROR=ON
    cmake --build --preset "$preset"
    say "Testing preset $preset, Vulkan driver ${lavapipe:-as the system has it}"
    ctest --preset "$preset" --parallel "$(nproc)" --timeout 300
done
