#!/usr/bin/env bash
# Each rule is fed a good tree, which it must pass, and one broken in a single place, which it must name.
set -euo pipefail
rules="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/rules"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

good_tree() {
  rm -rf "$scratch/tree"
  mkdir -p "$scratch"/tree/src/acus/{base,mesh,needle,force,sim}
  cd "$scratch/tree"
  printf 'Apache\n' >LICENSE
  printf 'BasedOnStyle: Google\n' >.clang-format
  printf '#pragma once\n' | tee src/acus/base/a.h src/acus/mesh/a.h src/acus/needle/a.h src/acus/force/a.h >src/acus/acus.h
  printf '#include "acus/acus.h"\n#include "acus/base/a.h"\n#include "acus/force/a.h"\n#include "acus/mesh/a.h"\n' >use.txt
  printf '#include <vector>\n\n#include "acus/base/a.h"\n#include "acus/force/a.h"\n' >src/acus/sim/s.cpp
  printf '#include "acus/mesh/a.h"\n#include "acus/needle/a.h"\n' >>src/acus/sim/s.cpp
  printf 'acus_library(sim SOURCES s.cpp)\n' >src/acus/sim/CMakeLists.txt
  printf '# a.h\n' >src/acus/CMakeLists.txt
  printf 'acus_library(acus acus.h)\n' >>src/acus/CMakeLists.txt
  printf 'See [the licence](LICENSE) and `src/acus/sim/s.cpp`.\n' >README.md
}

# notices RULE BREAKAGE EXPECTED: the rule passes the good tree, and after BREAKAGE fails with EXPECTED in its words.
notices() {
  local rule=$1 breakage=$2 expected=$3 said
  good_tree
  if ! said=$(bash "$rules/$rule.sh" "$scratch/tree"); then
    printf 'rule %s fails on a good tree: %s\n' "$rule" "$said"
    failures=$((failures + 1))
  fi
  eval "$breakage"
  if said=$(bash "$rules/$rule.sh" "$scratch/tree") || [[ $said != *"$expected"* ]]; then
    printf 'rule %s does not notice: %s\n  it said: %s\n' "$rule" "$breakage" "$said"
    failures=$((failures + 1))
  fi
}

add() { printf '%s\n' "$2" >>"$1"; }

notices includes 'add src/acus/base/a.h "#include \"acus/mesh/a.h\""' 'src/acus/base/a.h:2: base may not include mesh'
notices includes 'add src/acus/needle/a.h "#include \"acus/force/a.h\""' 'needle may not include force'
notices includes 'add src/acus/force/a.h " # include \"acus/sim/s.h\""' 'force may not include sim'
notices includes 'add src/acus/sim/s.cpp "#include \"acus/acus.h\""' 'sim may not include acus.h'
notices includes 'add src/acus/sim/s.cpp "#include \"../base/a.h\""' 'write the whole path'
notices includes 'add src/acus/sim/s.cpp "#include <thread>"' 'the engine knows no thread'
notices includes 'add src/acus/base/team.cpp "#include <mutex>"' 'the engine knows no mutex'
notices includes 'add src/acus/sim/s.cpp "#include <sys/socket.h>"' 'the engine knows no sys/socket.h'
notices includes 'add src/acus/base/a.h "#include <chrono>"' 'the engine knows no chrono'
notices includes 'add src/acus/base/a.h "#include <format>"' 'libc++ 13 lacks'
notices includes 'mkdir src/acus/stray; add src/acus/stray/a.h "#pragma once"' 'no place in the order'
notices same_bits 'add src/acus/sim/s.cpp "double y = std::sin(x);"' 'src/acus/sim/s.cpp:7: takes its last bit'
notices same_bits 'add src/acus/sim/s.cpp "std::unordered_map<int, int> m;"' 'src/acus/sim/s.cpp:7: takes an order'
notices same_bits 'add src/acus/mesh/locator.cpp "auto h = std::hash<int>();"' 'src/acus/mesh/locator.cpp:1: takes an order'
notices listed 'add src/acus/sim/forgotten.cpp "int x;"' 'src/acus/sim/forgotten.cpp: is not named'
notices listed 'add src/acus/sim/forgotten.h "#pragma once"' 'src/acus/sim/forgotten.h: is included by no file'
notices size 'seq 501 >src/acus/sim/long.h' 'long.h: 501 lines'
notices words 'add README.md "Get it from https://py""pi.org/acus"' 'README.md:2: an address of a package registry'
notices words 'add README.md "It lies in /ro""ot/acus"' 'README.md:2: a path of one machine'
notices words 'add src/acus/sim/s.cpp "// TO""DO: think"' 'unfinished work'
notices words 'rm LICENSE' 'LICENSE: is absent'
notices links 'add README.md "[gone](docs/gone.md)"' 'README.md:2: links to docs/gone.md'
notices links 'add README.md "\`src/acus/sim/gone.cpp\`"' 'README.md:2: names src/acus/sim/gone.cpp'
notices links 'add README.md "\`sim/gone.h\`"' 'README.md: names src/acus/sim/gone.h'
notices links 'add README.md "\`sim/s.cpp\` \`vanished\`"' 'names vanished in src/acus/sim/s.cpp'
notices words 'add README.md "see ../sha""red/x"' 'README.md:2: a folder beside the checkout'
if command -v clang-format >/dev/null; then
  notices format 'add src/acus/sim/s.cpp "int   x ;"' 'src/acus/sim/s.cpp: is not formatted'
fi

printf '%d proofs failed\n' "$failures"
[[ $failures -eq 0 ]]
