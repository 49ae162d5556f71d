#!/usr/bin/env bash
# Installs the missing packages of a list for Debian 12. Needs root or sudo only when something is missing.
#     bash cmake/install_packages.sh [LIST]        cmake/packages.txt by default
set -euo pipefail
list="${1:-$(dirname "$0")/packages.txt}"

missing=()
while read -r package; do
    [[ -z $package || $package == \#* ]] && continue
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
done <"$list"
((${#missing[@]})) || exit 0

echo "installing from Debian: ${missing[*]}" >&2
as_root=()
if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "error: run as root, or install sudo: missing ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
