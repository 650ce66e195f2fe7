#!/usr/bin/env bash
# Every source file is as clang-format would write it; exit code 77 (not run) where there is no clang-format.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"
command -v clang-format >/dev/null || { echo "not run: there is no clang-format here"; exit 77; }

while read -r file; do
  clang-format --style=file "$file" | cmp -s - "$file" || violation "$file" "is not formatted; run ./dev format"
done < <(sources)
verdict
