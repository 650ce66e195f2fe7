#!/usr/bin/env bash
# ./dev on machines that lack something: a pretended dpkg-query, apt-get and id stand first on the PATH.
set -euo pipefail
source_dir=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

# machine INSTALLED APT_EXIT UID: dpkg-query knows INSTALLED alone (or, for "all", everything it is asked about).
machine() {
  rm -rf "$scratch/bin" "$scratch/apt.log"
  mkdir "$scratch/bin"
  cat >"$scratch/bin/dpkg-query" <<TEXT
#!/bin/bash
code=0
for package in "\${@:3}"; do
  if [[ "$1" == all || " $1 " == *" \$package "* ]]; then printf 'ii %s\n' "\$package"; else code=1; fi
done
exit \$code
TEXT
  printf '#!/bin/bash\necho "$@" >>%q\nexit %d\n' "$scratch/apt.log" "$2" >"$scratch/bin/apt-get"
  printf '#!/bin/bash\necho %d\n' "$3" >"$scratch/bin/id"
  local tool
  for tool in bash env dirname sed tr cat mkdir basename printf xargs; do
    ln -s "$(command -v "$tool")" "$scratch/bin/$tool"
  done
  printf '#!/bin/bash\n' | tee "$scratch/bin/git" >"$scratch/bin/clang-format"
  chmod +x "$scratch"/bin/{dpkg-query,apt-get,id,git,clang-format}
}

# says EXPECTED EXIT [VERB]: `./dev VERB` (format) on the pretended machine ends with EXIT and EXPECTED in its words.
says() {
  local said code=0
  said=$(PATH="$scratch/bin" "$source_dir/dev" "${3:-format}" 2>&1) || code=$?
  if [[ $code -ne $2 || $said != *"$1"* ]]; then
    printf 'expected exit %d and "%s", got exit %d and: %s\n' "$2" "$1" "$code" "$said"
    failures=$((failures + 1))
  fi
}

apt_was_asked() {
  if [[ "$(cat "$scratch/apt.log" 2>/dev/null)" != *"$1"* ]]; then
    printf 'apt-get was not asked for "%s"\n' "$1"
    failures=$((failures + 1))
  fi
}

machine all 1 0 && says "" 0
[[ ! -e $scratch/apt.log ]] || { echo "apt-get was called though nothing is missing"; failures=$((failures + 1)); }
machine "" 0 0 && says "install clang-format" 0
apt_was_asked "install -y -qq --no-install-recommends clang-format"
machine "" 100 0 && says "apt-get could not install: clang-format" 1
apt_was_asked "update"
machine "" 0 1000 && says "need root to install (there is no sudo here): clang-format" 1
machine "cmake" 0 1000 && says ": g++ ninja-build ccache libeigen3-dev libcli11-dev nlohmann-json3-dev libpugixml-dev libtomlplusplus-dev \
libboost-dev libgtest-dev librapidcheck-dev libbenchmark-dev clang libclang-rt-dev emscripten nodejs node-typescript clang-format chromium valgrind" 1 test
machine "" 0 0 && rm "$scratch/bin/dpkg-query" && says "this is not Debian" 1

printf '%d expectations failed\n' "$failures"
[[ $failures -eq 0 ]]
