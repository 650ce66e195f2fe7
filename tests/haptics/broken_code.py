"""Builds tests around a source file that has been broken on purpose, and says which of them notice."""
import os
import re
import subprocess
import sys

FLAGS = ["-std=c++20", "-O1", "-w", "-ffp-contract=off", "-isystem/usr/include/eigen3"]


def build(text, name, source_dir, linked, scratch):
    """The program of the tests in `linked` (objects and libraries) with `text` in the place of the source file `name`;
    None where that does not compile."""
    path = os.path.join(scratch, name)
    program = os.path.join(scratch, "broken")
    with open(path, "w") as file:
        file.write(text)
    command = ["g++", *FLAGS, f"-I{source_dir}/src", path, *linked, "-lgtest", "-lgtest_main", "-lpthread", "-o", program]
    compiler = subprocess.run(command, capture_output=True, text=True)
    if compiler.returncode != 0:
        sys.stderr.write(compiler.stderr[-2000:])
        return None
    return program


def goes_red(program, timeout=20):
    """Whether any test fails; one that never ends has failed."""
    try:
        return subprocess.run([program, "--gtest_fail_fast", "--gtest_brief=1"], capture_output=True, timeout=timeout).returncode != 0
    except subprocess.TimeoutExpired:
        return True


def red_tests(program, which, timeout=60):
    """The names of the tests of `which` (a filter of GoogleTest) that fail; after one that crashes or does not end, the
    others are run without it."""
    red = []
    while True:
        command = [program, f"--gtest_filter={which}{'-' + ':'.join(red) if red else ''}"]
        try:
            run = subprocess.run(command, capture_output=True, timeout=timeout)
            said, code = run.stdout, run.returncode
        except subprocess.TimeoutExpired as stuck:
            said, code = stuck.stdout or b"", -1
        said = said.decode(errors="replace")
        red += dict.fromkeys(re.findall(r"^\[  FAILED  \] (\S+) \(\d+ ms\)", said, re.MULTILINE))
        begun = re.findall(r"^\[ RUN      \] (\S+)", said, re.MULTILINE)
        whole = re.search(r"^\[==========\] .* ran\.", said, re.MULTILINE)
        if code == 0 or whole or not begun:
            return red
        red.append(begun[-1])
