#!/usr/bin/env bash
# The same bits everywhere: what a state depends on takes its sines and arcs from numeric/circular.h and does without the
# other functions whose last bit is each C library's own. (Roots, sums and products are the same everywhere.)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"
# Neither is part of a step: the angles of a mesh are shown, and the paper's deflection is compared with.
not_in_a_state='mesh/quality\.cpp|needle/paper_deflection\.cpp'

while read -r file; do
  while IFS=: read -r line text; do
    violation "$file:$line" "takes its last bit from the C library: $text"
  done < <(grep -nE 'std::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|erf|tgamma)[(]' "$file" || true)
done < <(files src/acus/{base,numeric,mesh,tissue,needle,coupling,force,sim} | grep -E '\.(cpp|h)$' | grep -vE "$not_in_a_state" || true)
verdict
