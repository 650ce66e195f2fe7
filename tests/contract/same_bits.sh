#!/usr/bin/env bash
# The same scene ends in the same bits whoever compiled the program: g++ optimised, g++ with sanitizers and
# assertions, clang. The scenes buckle, puncture, cut, slide, stop, withdraw and enter again, so that every law has its
# part in the hash of the last state. Exit code 77 (not run) outside `./dev test`, which has just built all three programs:
# an old one would only show that the source has changed.
set -euo pipefail
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The hash of the last state of SCENE, by the program of BUILD.
hash_of() {
  "build/$1/acus" run "scenes/$2.toml" --set tissue.tetrahedra=600 --json |
    grep -oE '"state_hash": *"[0-9a-f]{16}"'
}

[[ -n ${ACUS_PROGRAMS_ARE_FRESH:-} ]] || { echo "not run: only ./dev test builds all three programs"; exit 77; }
for scene in quick pause_withdraw_reinsert; do
  for build in release dev clang; do
    hash_of "$build" "$scene" >"$scratch/$build"
    printf '%-25s %-8s %s\n' "$scene" "$build" "$(cat "$scratch/$build")"
  done
  cmp "$scratch/release" "$scratch/dev"
  cmp "$scratch/release" "$scratch/clang"
done
