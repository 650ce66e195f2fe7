#!/usr/bin/env bash
# The same bits everywhere: what a state depends on takes its sines and arcs from numeric/circular.h and does without the
# other functions whose last bit is each C library's own (roots, sums and products are the same everywhere), and it hangs on
# no order that is each C++ library's own.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../tree.sh"
# Neither is part of a step: the angles of a mesh are shown, and the paper's deflection is compared with.
not_in_a_state='mesh/quality\.cpp|needle/paper_deflection\.cpp'

# Its halves are put in order afterwards.
own_order='mesh/locator\.cpp:nth_element'

while read -r file; do
  while IFS=: read -r line text; do
    violation "$file:$line" "takes its last bit from the C library: $text"
  done < <(grep -nE 'std::(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|erf|tgamma)[(]' "$file" || true)
  while IFS=: read -r line name; do
    [[ $file:${name#std::} =~ ($own_order)$ ]] || violation "$file:$line" "takes an order from the C++ library: $name"
  done < <(grep -noE 'std::(nth_element|partial_sort(_copy)?|partition|make_heap|shuffle|sample|reduce|transform_reduce|hash|unordered_(multi)?(map|set))\>' "$file" || true)
done < <(files src/acus/{base,numeric,mesh,tissue,needle,coupling,force,sim} | grep -E '\.(cpp|h)$' | grep -vE "$not_in_a_state" || true)
verdict
