#!/usr/bin/env bash
# What a step costs, as a number that no busy machine changes: the instructions of a hundred steps, counted by valgrind,
# are within 3 % of those in instructions.txt. They are those of the kernels compiled for any x86-64 (CMakeLists.txt says
# why not for AVX2), so what slows the wider clones alone is not seen here, nor is what memory costs.
#
# instructions.sh check|record PROGRAM SCENE
set -euo pipefail
verb=$1 program=$2 scene=$3
recorded_in=$(dirname "${BASH_SOURCE[0]}")/instructions.txt
anew="cmake --build --preset release --target record_instructions"
percent=3

if ! command -v valgrind >/dev/null; then
  echo "Skipped: valgrind, which counts the instructions, is not installed (./dev test installs it)."
  [[ $verb == check ]] && exit 77
  exit 1
fi

# The C library copies memory in another way on each processor; told of none of its features, in one.
export GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-AVX,-FMA,-FMA4,-ERMS,-FSRM,-AVX_Fast_Unaligned_Load

# Of the steps alone: what building the model takes is not counted.
said=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null '--toggle-collect=acus::Simulation::step(double)' \
  "$program" "$scene" 2>&1) || { printf 'Under valgrind the steps of "%s" did not end well:\n%s\n' "$scene" "$said"; exit 1; }
count=$(sed -nE 's/.*Collected : ([0-9]+).*/\1/p' <<<"$said")
if [[ ${count:-0} -eq 0 ]]; then
  echo "No instructions were counted for \"$scene\": has acus::Simulation::step(double) another name, or is it inlined?"
  exit 1
fi

if [[ $verb == record ]]; then
  others=$(grep -v "^$scene " "$recorded_in" || true)
  { printf '%s\n' "$others" && printf '%s %s\n' "$scene" "$count"; } | sed '/^$/d' >"$recorded_in"
  echo "$scene $count"
  exit
fi

recorded=$(sed -nE "s/^$scene ([0-9]+)\$/\1/p" "$recorded_in")
if [[ -z $recorded ]]; then
  echo "instructions.txt has no line for \"$scene\"; \`$anew\` writes it."
  exit 1
fi
change=$(awk -v now="$count" -v then="$recorded" 'BEGIN { printf "%+.2f", 100 * (now / then - 1) }')
what="The steps of \"$scene\" take $count instructions, $change % beside the $recorded in tests/speed/instructions.txt"
if ((100 * (count - recorded) > percent * recorded)); then
  echo "$what: make them cheaper again, or record anew with \`$anew\` and say in a line of CHANGELOG.md what they are paid for."
  exit 1
elif ((100 * (recorded - count) > percent * recorded)); then
  echo "$what: they became cheaper, so record anew with \`$anew\`, lest it be lost again unseen."
  exit 1
fi
echo "$what."
