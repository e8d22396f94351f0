#!/usr/bin/env python3
"""Plants the faults of tests/mutation/faults.txt in a copy of the core, one at a time, and runs the
tests of the core until one of them notices.

    share/mutation-check.py [--only REGEX] [--jobs N]    half an hour on two cores for all
    share/mutation-check.py --list                      only whether every fault fits the sources

Needs Python 3.9 and what the preset core-only needs. The copy and its build lie in build/mutation;
the sources themselves are never written. Exit code 0 if at least nine of ten faults were caught, 1 if
not, 2 if the check itself cannot be done: a fault that does not fit, or tests that fail without one.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import time

import planting
from planting import ROOT, fail, planted, run

COPY = planting.Copy("mutation")

# Quick ones first: the first that fails ends the run of a fault.
TESTS = ["unit/core/unit_laws", "unit/core/unit_scales", "unit/core/unit_phases",
         "unit/core/unit_engine", "unit/core/unit_walls", "unit/core/unit_search",
         "physics/physics_work_precision", "equivalence/equivalence", "unit/core/unit_insertion",
         "determinism/determinism", "stability/stability_guards", "physics/physics_verify",
         "stability/stability_catalogue"]

# A test that takes so many times what it took without a fault, and so many seconds more, hangs.
PATIENCE_FACTOR = 10
PATIENCE_SECONDS = 60

# Scenes name laws by their parameters, so all sources include the laws. Only these use what a law
# does; the others are as they were whatever is planted there.
LAWS = ("core/contact/laws/", "core/contact/tangential.hpp")
USERS_OF_LAWS = [f"core/kernels/kernels_{isa}.cpp" for isa in ("scalar", "sse4", "avx2", "avx512")]
USERS_OF_LAWS += ["core/contact/contact_table.cpp", "tests/unit/core/law_test.cpp",
                  "tests/unit/core/law_rules_test.cpp"]

CAUGHT_AT_LEAST = 0.9


def build(jobs):
    return COPY.build(jobs, *(pathlib.PurePath(test).name for test in TESTS))


def first_failure(patience):
    """Name of the first test that fails, or None; notes how long those took whose patience is unknown."""
    for test in TESTS:
        program = COPY.build_folder / "tests" / test
        start = time.monotonic()
        try:
            result = run([str(program), "--gtest_brief=1", "--gtest_fail_fast", "--gtest_color=no"],
                         timeout=patience.get(test))
        except subprocess.TimeoutExpired:
            return f"{program.name} (hangs)"
        if result.returncode != 0:
            for line in result.stdout.splitlines():
                if line.startswith("[  FAILED  ]"):
                    return line.removeprefix("[  FAILED  ]").split(",")[0].split("(")[0].strip()
            return f"{program.name} (exit code {result.returncode})"
        patience.setdefault(test, PATIENCE_FACTOR * (time.monotonic() - start) + PATIENCE_SECONDS)
    return None


def write(fault, text):
    """Writes a file of the copy so that what must be built anew is, and nothing else."""
    path = COPY.tree / fault["file"]
    before = path.stat()
    path.write_text(text)
    if fault["file"].startswith(LAWS):
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
        for user in USERS_OF_LAWS:
            os.utime(COPY.tree / user)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()

    faults = planting.read_edits("tests/mutation/faults.txt")
    for fault in faults:
        planted(fault, (ROOT / fault["file"]).read_text())
    if options.list:
        print(f"{len(faults)} faults fit the sources")
        return 0
    COPY.bring_up_to_date()
    COPY.configure("-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O1")
    result = build(options.jobs)
    if result.returncode != 0:
        fail(f"the core does not build without a fault:\n{result.stdout}")
    patience = {}
    test = first_failure(patience)
    if test:
        fail(f"{test} fails without a fault")

    chosen = [fault for fault in faults if re.search(options.only, fault["name"])]
    caught = 0
    print("| fault | file | caught by | s |\n|---|---|---|---|")
    for fault in chosen:
        start = time.monotonic()
        text = (COPY.tree / fault["file"]).read_text()
        write(fault, planted(fault, text))
        try:
            result = build(options.jobs)
            if result.returncode != 0:
                fail(f"'{fault['name']}' does not compile:\n{result.stdout}")
            test = first_failure(patience)
        finally:
            write(fault, text)
        caught += test is not None
        print(f"| {fault['name']} | `{fault['file'].removeprefix('core/')}` | "
              f"{'`' + test + '`' if test else '**survives**'} | "
              f"{time.monotonic() - start:.0f} |", flush=True)
    print(f"\n{caught} of {len(chosen)} faults caught")
    return 0 if caught >= CAUGHT_AT_LEAST * len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
