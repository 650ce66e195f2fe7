#!/usr/bin/env python3
"""Takes the guards of the haptic loop out, one at a time, and sees which tests go red.

usage: guards.py SOURCE_DIR BUILD_DIR [--write] [WORD]
Compares what it sees with docs/guards.md, or writes that page anew with --write. With a WORD only the guards in whose
names, or in the names of whose files, it stands are tried and shown. BUILD_DIR holds the built test_haptics and
test_stopped_simulation. Exit code 1 when a guard can be taken out without any test noticing, when the text that it is
known by has changed, or when the page has.
"""
import glob
import os
import sys
import tempfile

from broken_code import build, red_tests
from guard_list import GUARDS

HEAD = """# The guards of the haptic loop, and the tests that miss them

Each guard was taken out of the program by itself, and these are the tests that then fail. Drawn by

    python3 tests/haptics/guards.py . build/release --write

and compared by `./dev nightly` with what is so; `tests/haptics/guard_list.py` says what is done to take each out.

Two things stand twice, for whoever changes the code: the peak is kept to both where the force is aimed and, last of
all, where it leaves, and the row below takes both out, for the second alone would only take off roundings; and a speed
is bounded before its norm is taken, although anything beyond 1.2 m/s is off anyway.
"""


def without(guard, text):
    """`text` without the guard; None where a replacement does not stand in it exactly once."""
    for old, new in guard[1]:
        if text.count(old) != 1:
            return None
        text = text.replace(old, new)
    return text


def certainly_red(program, tests, runs):
    """The tests that fail in each of so many runs."""
    red = red_tests(program, tests)
    for _ in range(runs - 1):
        red = red_tests(program, ":".join(red)) if red else red
    return red


def linked_into(build_dir):
    objects = [object for tests in ("haptics", "stopped_simulation")
               for object in glob.glob(os.path.join(build_dir, f"tests/haptics/CMakeFiles/test_{tests}.dir/*.o"))]
    libraries = glob.glob(os.path.join(build_dir, "src/acus/*/libacus_*.a"))
    assert objects and libraries, f"test_haptics and test_stopped_simulation are not built in {build_dir}"
    return [*objects, "-Wl,--start-group", *libraries, "-Wl,--end-group", "-lpugixml", "-ldl"]


def main():
    write = "--write" in sys.argv
    os.environ["ACUS_TRIALS"] = "3"  # of test_stopped_simulation
    source_dir, build_dir, *words = [word for word in sys.argv[1:] if word != "--write"]
    linked = linked_into(build_dir)
    page, complaints = HEAD, []
    with tempfile.TemporaryDirectory() as scratch:
        for file, title, guards, tests, runs in GUARDS:
            with open(os.path.join(source_dir, "src/acus/haptics", file)) as source:
                text = source.read()
            page += f"\n## {title}\n\nTaken out of `src/acus/haptics/{file}`.\n\n| guard | red without it |\n|---|---|\n"
            chosen = [guard for guard in guards if not words or words[0] in (file + " " + guard[0])]
            if chosen:
                whole = build(text, file, source_dir, linked, scratch)
                red = certainly_red(whole, tests, runs) if whole else ["the compiler"]
                assert not red, f"with all guards of {file} in place these fail: {red}"
            for guard in chosen:
                broken = without(guard, text)
                program = broken and build(broken, file, source_dir, linked, scratch)
                red = certainly_red(program, tests, runs) if program else []
                if not broken:
                    complaints.append(f"{file}: the text of '{guard[0]}' does not stand there once")
                elif not program:
                    complaints.append(f"{file}: without '{guard[0]}' it does not compile")
                elif not red:
                    complaints.append(f"{file}: no test goes red without '{guard[0]}'")
                row = f"| {guard[0]} | {', '.join(f'`{test}`' for test in red)} |"
                print(row, flush=True)
                page += row + "\n"
    path = os.path.join(source_dir, "docs/guards.md")
    if write and not words:
        with open(path, "w") as file:
            file.write(page)
    elif not words and open(path).read() != page:
        complaints.append("docs/guards.md is not what was seen; draw it anew with --write")
    for complaint in complaints:
        print(complaint)
    sys.exit(1 if complaints else 0)


main()
