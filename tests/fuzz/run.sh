#!/usr/bin/env bash
# Installs what the fuzzers need, builds them and runs each for some seconds:
#     bash tests/fuzz/run.sh [SECONDS]        600 each by default
# Corpora grow under build/fuzz/corpus. A finding stops the run and is left as a file there; once fixed, it goes to
# tests/fuzz/seeds/NAME, which the normal tests replay.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds="${1:-600}"
[[ $seconds =~ ^[0-9]+$ ]] || { echo "usage: tests/fuzz/run.sh [SECONDS]" >&2; exit 2; }

bash cmake/install_packages.sh
bash cmake/install_packages.sh cmake/fuzz_packages.txt
cmake --preset fuzz
cmake --build --preset fuzz
export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=detect_leaks=0
for name in scene ply picture lens aperture spd deep_exr tlfr; do
    corpus="build/fuzz/corpus/$name"
    mkdir -p "$corpus"
    echo "== $name, $seconds s"
    if ! "build/fuzz/tests/slant_${name}_fuzz" "$corpus" "tests/fuzz/seeds/$name" -max_total_time="$seconds" \
        -timeout=20 -rss_limit_mb=4096 -artifact_prefix="$corpus-" -print_final_stats=1 >"$corpus.log" 2>&1; then
        tail -n 60 "$corpus.log"
        exit 1
    fi
    grep "^stat::" "$corpus.log"
done
