#!/usr/bin/env python3
"""Takes the guards of the haptic loop out, one at a time, and sees which tests go red.

usage: guards.py SOURCE_DIR BUILD_DIR [--write] [WORD]
Compares what it sees with docs/guards.md, or writes that page anew with --write. With a WORD only the guards in whose
names it stands are tried, and shown. BUILD_DIR holds a built test_haptics. Exit code 1 when a guard can be taken out
without any test noticing, when the text that it is known by has changed, or when the page has.
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


def linked_into(build_dir):
    objects = glob.glob(os.path.join(build_dir, "tests/haptics/CMakeFiles/test_haptics.dir/*.o"))
    libraries = glob.glob(os.path.join(build_dir, "src/acus/*/libacus_*.a"))
    assert objects and libraries, f"there is no built test_haptics in {build_dir}"
    return [*objects, "-Wl,--start-group", *libraries, "-Wl,--end-group", "-lpugixml", "-ldl"]


def main():
    write = "--write" in sys.argv
    source_dir, build_dir, *words = [word for word in sys.argv[1:] if word != "--write"]
    linked = linked_into(build_dir)
    page, complaints = HEAD, []
    with tempfile.TemporaryDirectory() as scratch:
        for file, title, guards, tests in GUARDS:
            with open(os.path.join(source_dir, "src/acus/haptics", file)) as source:
                text = source.read()
            page += f"\n## {title}\n\nTaken out of `src/acus/haptics/{file}`.\n\n| guard | red without it |\n|---|---|\n"
            chosen = [guard for guard in guards if not words or words[0] in guard[0]]
            if chosen:
                whole = build(text, file, source_dir, linked, scratch)
                assert whole and not red_tests(whole, tests), f"tests fail with all guards of {file} in place"
            for guard in chosen:
                broken = without(guard, text)
                program = broken and build(broken, file, source_dir, linked, scratch)
                red = red_tests(program, tests) if program else []
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
