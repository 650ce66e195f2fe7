# Read by the rules: which files a tree has, and how a rule reports what it found.

cd "$1"
violations=0

# The paths on standard input that lie below the given ones; all when none is given.
below() {
  if [[ $# -eq 0 ]]; then cat; else grep -E "^($(IFS='|'; echo "$*"))(/|$)" || true; fi
}

# Files of the tree below the given paths that git tracks or would track; every file when it is no git checkout.
files() {
  if [[ -e .git ]]; then
    git ls-files --cached --others --exclude-standard -- "$@" | sort -u | while read -r file; do
      [[ ! -f $file ]] || printf '%s\n' "$file"
    done
  else
    find . -type f -not -path './build/*' -not -path './out/*' | sed 's|^\./||' | sort | below "$@"
  fi
}

sources() { files src apps bench bindings emulators tests | grep -E '\.(cpp|h)$' || true; }

# violation WHERE SENTENCE
violation() {
  printf '%s: %s\n' "$1" "$2"
  violations=$((violations + 1))
}

# Turns the lines of `grep -n` (file:line:text) on standard input into violations.
violations_from_grep() {
  local where line text
  while IFS=: read -r where line text; do violation "$where:$line" "$1: $text"; done
}

verdict() { [[ $violations -eq 0 ]]; }
