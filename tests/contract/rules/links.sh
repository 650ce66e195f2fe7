#!/usr/bin/env bash
# A page names only what exists: the target of each relative link, each path in `backquotes` that begins with a
# folder of this tree or of src/acus, and each name in backquotes right behind the source file that has it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"

while read -r page; do
  while IFS=: read -r line target; do
    [[ -e $(dirname "$page")/${target%%#*} ]] || violation "$page:$line" "links to $target, which does not exist"
  done < <(grep -noE '\]\([^)#:]+[^):]*\)' "$page" | sed 's/:\](\(.*\))$/:\1/' || true)
  while IFS=: read -r line path; do
    compgen -G "${path%%:*}" >/dev/null || violation "$page:$line" "names $path, which does not exist"
  done < <(grep -noE '`(src|apps|bindings|tests|bench|docs|scenes|studies|examples)/[^` <>]*`' "$page" | tr -d '\140' || true)
  while read -r path name; do
    path=src/acus/${path//\`/} name=${name//\`/}
    if [[ ! -e $path ]]; then
      violation "$page" "names $path, which does not exist"
    elif [[ -n $name ]] && ! grep -qw -- "$name" "${path%.*}".*; then
      violation "$page" "names $name in $path, which does not have it"
    fi
  done < <(grep -oE '`(base|numeric|mesh|tissue|needle|coupling|force|sim|io|view|study)/[a-z0-9_]+\.(h|cpp)`( `[A-Za-z_]+`)?' "$page" || true)
done < <(files | grep -E '\.md$' || true)
verdict
