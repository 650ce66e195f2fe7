#!/usr/bin/env bash
# A file has one job: none that people write is longer than 500 lines.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"
longest_file=500

while read -r file; do
  lines=$(wc -l <"$file")
  [[ $lines -le $longest_file ]] || violation "$file" "$lines lines, more than $longest_file: it has two jobs"
done < <(files | grep -E '(\.(cpp|h|sh|cmake|ts|svelte)|CMakeLists\.txt|^dev)$' || true)
verdict
