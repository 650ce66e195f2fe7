#!/usr/bin/env bash
# A file has one job: none that people write is longer than 500 lines, no line longer than 130 characters.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"
longest_file=500
longest_line=130

while read -r file; do
  lines=$(wc -l <"$file")
  [[ $lines -le $longest_file ]] || violation "$file" "$lines lines, more than $longest_file: it has two jobs"
  while read -r line; do
    violation "$file:$line" "a line of more than $longest_line characters"
  done < <(LC_ALL=C.UTF-8 awk -v most=$longest_line 'length($0) > most { print FNR }' "$file")
done < <(files | grep -E '(\.(cpp|h|sh|cmake|ts|svelte)|CMakeLists\.txt|^dev)$' || true)
verdict
