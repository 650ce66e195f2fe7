#!/usr/bin/env python3
"""Breaks the force gate in every small way there is and sees whether its tests notice.

usage: gate_mutants.py SOURCE_DIR OBJECT_OF_THE_TESTS
Exit code 1 when fewer than 95 % of the mutants are killed, or when one survives that gate_survivors.txt does not explain.
"""
import os
import re
import sys
import tempfile

from broken_code import build, goes_red

SWAPS = [
    (r"<=", "<"), (r"(?<![<=>-])<(?![<=])", "<="), (r">=", ">"), (r"(?<![->])>(?![>=])", ">="),
    (r"==", "!="), (r"!=", "=="), (r"&&", "||"), (r"\|\|", "&&"), (r" \+ ", " - "), (r" - ", " + "),
    (r" \* ", " / "), (r" / ", " * "), (r"\+=", "-="), (r"-=", "+="), (r"\+\+", "--"),
    (r"std::min\(", "std::max("), (r"std::max\(", "std::min("),
    (r"(?<![\w.])(\d+\.\d+|\d+e-?\d+|\d+\.\d+e-?\d+)(?![\w.])", lambda m: m.group(1) + " * 1.5 + 0.001"),
    (r"(?<![\w.])(\d+)(?![\w.])", lambda m: m.group(1) + " + 1"),
]
STATEMENT = re.compile(r"^(\s+)([^/#{}]*;)(\s*//.*)?$")
DECLARATION = re.compile(r"^\s+(const|constexpr|using|double|GateOutput|return)\b")


def mutants(text):
    """(line number, what was done, whole text) of every mutant."""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        code = line.split("//")[0]
        if not code.strip() or code.lstrip().startswith(("#", "namespace", "using", "}")):
            continue
        for pattern, replacement in SWAPS:
            for match in re.finditer(pattern, code):
                new = replacement(match) if callable(replacement) else replacement
                if "<" in match.group() or ">" in match.group():
                    if re.search(r"(array|static_cast|size_t|include)\s*$|^\s*\w+>", code[: match.start()]) or "<std" in code[match.start():match.start() + 5] or code[match.end() - 1:match.end() + 1] == ">(" or "->" in code[match.start() - 1:match.end()]:
                        continue
                changed = code[: match.start()] + new + code[match.end():]
                yield number + 1, f"{match.group().strip()} -> {new.strip()}", "\n".join(lines[:number] + [changed] + lines[number + 1:])
        if STATEMENT.match(code.rstrip()) and not DECLARATION.match(code):
            yield number + 1, f"without: {code.strip()}", "\n".join(lines[:number] + [";"] + lines[number + 1:])


def killed(text, source_dir, tests, scratch):
    """True, False, or None where the mutant does not compile."""
    program = build(text, "force_gate.cpp", source_dir, tests, scratch)
    return program and goes_red(program)


def main():
    source_dir, *tests = sys.argv[1:]
    gate = os.path.join(source_dir, "src/acus/haptics/force_gate.cpp")
    with open(gate) as file:
        text = file.read()
    with open(os.path.join(source_dir, "tests/haptics/gate_survivors.txt")) as file:
        explained = {line.split(" | ")[0].strip() for line in file if " | " in line}
    all_lines = text.split("\n")
    dead = alive = 0
    unexplained = []
    with tempfile.TemporaryDirectory() as scratch:
        assert killed(text, source_dir, tests, scratch) is False, "the gate's tests fail without any mutation"
        for number, what, mutant in mutants(text):
            verdict = killed(mutant, source_dir, tests, scratch)
            if verdict is None:
                continue
            dead += verdict
            if verdict:
                continue
            alive += 1
            name = f"{all_lines[number - 1].strip()} [{what}]"
            if name not in explained:
                unexplained.append(f"force_gate.cpp:{number}: {name}")
            print(f"survives: {name}{'' if name in explained else ' (not explained)'}", flush=True)
    share = dead / max(dead + alive, 1)
    print(f"{dead} of {dead + alive} mutants killed, {100 * share:.1f} %")
    for one in unexplained:
        print(f"not explained: {one}")
    sys.exit(0 if share >= 0.95 and not unexplained else 1)


main()
