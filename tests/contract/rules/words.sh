#!/usr/bin/env bash
# The tree stands alone: no address of a package registry, no path of one machine, no unfinished work.
# (The patterns are written so that they do not find themselves.)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"

search() { files | grep -vxF LICENSE | tr '\n' '\0' | xargs -0 -r grep -nIE "$1" /dev/null || true; }

violations_from_grep "an address of a package registry" \
  < <(search '(pypi|crates|npmjs|conan|pythonhosted|debian|ubuntu|anaconda)[.](org|io|com|net)/?[a-z]*|proxy[.]golang')
violations_from_grep "a path of one machine" < <(search '(^|[^[:alnum:]_.])/(work|root|home)(/|[[:space:]]|$)')
violations_from_grep "a folder beside the checkout" < <(search '[.][.]/(shared|[.]library)\>')
violations_from_grep "unfinished work" < <(search '\<(TO[D]O|FIX[M]E|X[X]X)\>')
[[ -f LICENSE ]] || violation LICENSE "is absent"
verdict
