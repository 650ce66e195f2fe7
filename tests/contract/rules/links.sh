#!/usr/bin/env bash
# A page names only what exists: the target of each relative link, and each path in `backquotes` that begins
# with a folder of this tree.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"

while read -r page; do
  while IFS=: read -r line target; do
    [[ -e $(dirname "$page")/${target%%#*} ]] || violation "$page:$line" "links to $target, which does not exist"
  done < <(grep -noE '\]\([^)#:]+[^):]*\)' "$page" | sed 's/:\](\(.*\))$/:\1/' || true)
  while IFS=: read -r line path; do
    compgen -G "${path%%:*}" >/dev/null || violation "$page:$line" "names $path, which does not exist"
  done < <(grep -noE '`(src|apps|tests|bench|docs|scenes|studies|examples)/[^` <>]*`' "$page" | tr -d '\140' || true)
done < <(files | grep -E '\.md$' || true)
verdict
