"""Copies of the sources with edits planted in them, for share/mutation-check.py and share/off-is-free.py.

An edit file holds blocks

    fault: what it does        (or `edit:`)
    file: core/engine.cpp
    - a line as it is
    + the line that takes its place

whose old lines must fit exactly once. The sources themselves are never written.
"""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def fail(message):
    print(f"{pathlib.Path(sys.argv[0]).stem}: {message}", file=sys.stderr)
    sys.exit(2)


def run(command, **keywords):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **keywords)


def read_edits(name):
    edits = []
    for line in (ROOT / name).read_text().splitlines():
        if line.startswith(("fault: ", "edit: ")):
            edits.append({"name": line.split(": ", 1)[1], "old": [], "new": [], "from": name})
        elif line.startswith("file: "):
            edits[-1]["file"] = line[6:]
        elif line.startswith("- "):
            edits[-1]["old"].append(line[2:])
        elif line.startswith("+ "):
            edits[-1]["new"].append(line[2:])
        elif line and not line.startswith("#"):
            fail(f"{name}: cannot read '{line}'")
    return edits


def planted(edit, text):
    old = "\n".join(edit["old"])
    count = text.count(old)
    if count != 1:
        fail(f"'{edit['name']}' fits {count} times into {edit['file']}, not once:\n{old}\n"
             f"Where that code has changed, change the edit in {edit['from']} with it.")
    return text.replace(old, "\n".join(edit["new"]))


def planted_files(edits):
    """Text by file, with all edits planted."""
    texts = {}
    for edit in edits:
        text = texts.get(edit["file"]) or (ROOT / edit["file"]).read_text()
        texts[edit["file"]] = planted(edit, text)
    return texts


class Copy:
    """A copy of the tracked sources, without io and render, and its build, in build/NAME."""

    def __init__(self, name):
        self.tree = ROOT / "build" / name / "tree"
        self.build_folder = ROOT / "build" / name / "build"

    def bring_up_to_date(self, edits=()):
        """Files that are the same keep their time, and so their objects."""
        texts = planted_files(edits)
        tracked = run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True).stdout
        wanted = {name for name in tracked.splitlines() if (ROOT / name).is_file()}
        for name in wanted:
            content = texts[name].encode() if name in texts else (ROOT / name).read_bytes()
            to = self.tree / name
            if not to.exists() or to.read_bytes() != content:
                to.parent.mkdir(parents=True, exist_ok=True)
                to.write_bytes(content)
                shutil.copymode(ROOT / name, to)
        for path in [p for p in self.tree.rglob("*") if p.is_file()]:
            if str(path.relative_to(self.tree)) not in wanted:
                path.unlink()

    def configure(self, *options):
        launcher = shutil.which("ccache")
        command = ["cmake", "-S", str(self.tree), "-B", str(self.build_folder), "-G", "Ninja",
                   "-DGRAINBENCH_BUILD_IO=OFF", "-DGRAINBENCH_BUILD_RENDER=OFF", *options]
        if launcher:
            command.append(f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}")
        result = run(command)
        if result.returncode != 0:
            fail(f"the copy cannot be configured:\n{result.stdout}")

    def build(self, jobs, *targets):
        return run(["cmake", "--build", str(self.build_folder), "--parallel", str(jobs), "--target",
                    *targets])
