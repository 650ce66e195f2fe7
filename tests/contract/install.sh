#!/usr/bin/env bash
# An installed acus serves a program that knows nothing of this tree: examples/embed is built against it and finds the
# load of a clamped-pinned column at 1 % end shortening, 1.0038 times 2.04575 pi^2 EI / L^2 = 0.6446 N (the
# exact elastica; needle of Table I).
set -euo pipefail
source_dir=$1
build_dir=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build_dir" --prefix "$scratch/acus" >/dev/null
"$scratch/acus/bin/acus" --help >/dev/null
cp -r "$source_dir/examples/embed" "$scratch/embed"
cmake -S "$scratch/embed" -B "$scratch/embed/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$scratch/acus" >/dev/null
cmake --build "$scratch/embed/build" >/dev/null
force=$("$scratch/embed/build/embed")
printf 'hand force %s N, elastica 0.6446 N\n' "$force"
awk -v force="$force" 'BEGIN { exit !(force > 0.6446 * 0.99 && force < 0.6446 * 1.01) }'
