#!/usr/bin/env bash
# Nothing is forgotten: every .cpp is named in the CMakeLists.txt beside it, and every header is included by some file
# or named there.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"

named_in_cmake() { grep -qsE "(^|[[:space:](/])$(basename "$1" | sed 's/\./\\./g')([[:space:])]|\$)" "$2"; }

all_sources=$(sources; files examples | grep -E '\.(cpp|h)$' || true)
while read -r file; do
  case $file in
    *.cpp) named_in_cmake "$file" "$(dirname "$file")/CMakeLists.txt" ||
      violation "$file" "is not named in $(dirname "$file")/CMakeLists.txt" ;;
    src/*.h) grep -qE "#include [<\"]${file#src/}[>\"]" $all_sources || named_in_cmake "$file" "$(dirname "$file")/CMakeLists.txt" ||
      violation "$file" "is included by no file" ;;
  esac
done <<<"$all_sources"
verdict
