#!/usr/bin/env python3
"""Counts the instructions of scenes in which effects are off, once in this program and once in a build
that does not have these effects at all, and compares.

    share/off-is-free.py [--jobs N]      some minutes
    share/off-is-free.py --list         only whether the edits fit the sources

The edits of tests/performance/bare.txt take the effects away: local damping, driven groups, sinks and
sources, periodic directions, orientations, the energy ledger, records of contacts, scaled inertia,
sorting of slots, coarse-grained fields, deletion of lost particles, elevation, all contact laws but the
linear ones. The scenes are those whose instructions are under test (tests/performance). Needs Python
3.9, valgrind, and what the preset core-only needs. Copies and builds lie in build/off-is-free*. Exit
code 0 if no scene takes more than a hundredth more than in the bare build, 1 if one does, 2 if it
cannot be done.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

import planting
from planting import ROOT, fail, run

BAND = 0.01


def build(name, edits, jobs):
    """The program that steps the scenes, built from a copy with the edits."""
    copy = planting.Copy(name)
    copy.bring_up_to_date(edits)
    copy.configure("-DCMAKE_BUILD_TYPE=Release", "-DGRAINBENCH_BUILD_TESTS=OFF")
    result = copy.build(jobs, "grainbench_core")
    if result.returncode != 0:
        fail(f"{name} does not build:\n{result.stdout}")
    program = copy.build_folder / "counted_steps"
    tree = copy.tree
    command = ["c++", "-std=gnu++20", "-O3", "-DNDEBUG", "-ffp-contract=off", f"-I{tree}",
               f"-I{copy.build_folder / 'generated'}", str(tree / "tests/performance/counted_steps.cpp"),
               str(tree / "cli/bench/cases.cpp"), str(copy.build_folder / "core/libgrainbench-core.a"),
               "-lhwy", "-ltbb", "-lpthread", "-o", str(program)]
    result = run(command)
    if result.returncode != 0:
        fail(f"{name} does not build:\n{' '.join(command)}\n{result.stdout}")
    return program


def count(program):
    """Instructions per particle-step by scene."""
    with tempfile.TemporaryDirectory() as folder:
        result = subprocess.run(
            ["valgrind", "--tool=callgrind", "--instr-atstart=no",
             f"--callgrind-out-file={folder}/counts", str(program)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if result.returncode != 0:
            fail(f"callgrind failed:\n{result.stderr}")
        steps = {name: float(n) for name, n in (line.split() for line in result.stdout.splitlines())}
        counts = {}
        for name in os.listdir(folder):
            text = open(os.path.join(folder, name)).read()
            trigger = re.search(r"^desc: Trigger: Client Request: (.+)$", text, re.M)
            total = re.search(r"^(?:totals|summary): (\d+)$", text, re.M)
            if trigger and total and trigger.group(1) in steps:
                counts[trigger.group(1)] = int(total.group(1)) / steps[trigger.group(1)]
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    edits = planting.read_edits("tests/performance/bare.txt")
    if options.list:
        planting.planted_files(edits)
        print(f"{len(edits)} edits fit the sources")
        return 0
    if not shutil.which("valgrind"):
        fail("valgrind is not installed")
    full = count(build("off-is-free", [], options.jobs))
    bare = count(build("off-is-free-bare", edits, options.jobs))
    print("| scene | instructions per particle-step | in the bare build | more |")
    print("|---|---:|---:|---:|")
    worst = 0.0
    for scene, instructions in full.items():
        more = instructions / bare[scene] - 1.0
        worst = max(worst, more)
        print(f"| `{scene}` | {instructions:.1f} | {bare[scene]:.1f} | {100.0 * more:+.2f} % |")
    print(f"\nat most {100.0 * worst:.2f} % more than without the effects, asked for are "
          f"{100.0 * BAND:.0f} %")
    return 0 if worst <= BAND else 1


if __name__ == "__main__":
    sys.exit(main())
