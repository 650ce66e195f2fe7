#!/usr/bin/env bash
# The tests of the force gate go through every line and every branch of it. BUILD holds test_gate_coverage, in which the
# gate is compiled for gcov.
set -euo pipefail
build=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
object=$(find "$build" -path '*test_gate_coverage*' -name 'force_gate.cpp.gcno')
find "$(dirname "$object")" -name '*.gcda' -delete
"$build/test_gate_coverage" --gtest_brief=1
cd "$scratch"
gcov --branch-probabilities --object-directory "$(dirname "$object")" "$object" >summary
grep -A4 "force_gate.cpp'" summary
whole=$(grep -A4 "force_gate.cpp'" summary | grep -cE '^(Lines executed|Branches executed|Taken at least once):100.00% of')
[[ $whole -ne 3 ]] || exit 0
grep -nE '#####|branch .*(never executed|taken 0%)' force_gate.cpp.gcov
exit 1
