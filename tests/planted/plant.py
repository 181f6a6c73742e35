#!/usr/bin/env python3
"""Plants the defects of defects.json, one at a time, and says which tests catch each.

    python3 tests/planted/plant.py [NUMBER ...]

All defects go into one copy of the packages, each behind a switch that an environment variable turns, so that
they are built once. A defect is a text of a file with the expression between [[ and ]] that it replaces, and
the tests that are run with it: `math` are those of crates/math, `attack` those of crates/promises, the others
the files of crates/truth/tests. A defect that fewer than two tests catch fails the run. caught.md beside this
file has the row of each.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
COPY = ROOT / "target" / "planted"
SWITCH = "LOBEFIT_PLANTED"
# Part of the usual trials: a defect is found at once or never.
TRIALS = "0.02"
SECONDS = 300

PLANTED = f'''
/// Whether a defect is switched on.
#[inline(always)]
pub fn planted(defect: u32) -> bool {{
    static ON: std::sync::LazyLock<u32> =
        std::sync::LazyLock::new(|| std::env::var("{SWITCH}").map_or(0, |text| text.parse().expect("a number")));
    *ON == defect
}}
'''


def parts(text):
    """What stands before the expression, the expression, and what stands after it."""
    before, rest = text.split("[[", 1)
    expression, after = rest.rsplit("]]", 1)
    return before, expression, after


def plant(defects):
    """Copies the packages and puts a switch in the place of each expression."""
    shutil.rmtree(COPY / "tree", ignore_errors=True)
    ignore = shutil.ignore_patterns("target", ".git", "reports", "tables")
    shutil.copytree(ROOT, COPY / "tree", ignore=ignore, symlinks=True)
    for number, defect in enumerate(defects, 1):
        path = COPY / "tree" / defect["file"]
        text = path.read_text()
        before, expression, after = parts(defect["from"])
        assert text.count(before + expression + after) == 1, defect["name"]
        path_to = "crate" if "crates/math" in defect["file"] else "lobefit_math"
        switch = f"(if {path_to}::planted({number}) {{ {defect['to']} }} else {{ {expression} }})"
        path.write_text(text.replace(before + expression + after, before + switch + after))
    library = COPY / "tree" / "crates/math/src/lib.rs"
    library.write_text(library.read_text() + PLANTED)
    # Tests of units compile files once more, outside of their package: there the switch is the library's.
    units = COPY / "tree" / "crates/math/tests/units.rs"
    units.write_text(units.read_text() + "\n#[allow(unused_imports)]\nuse lobefit_math::planted;\n")


def build():
    """The commands that run tests, by the names that the list has."""
    packages = [word for name in ("math", "truth", "promises") for word in ("-p", f"lobefit-{name}")]
    command = ["cargo", "test", "--release", "--no-run", "--message-format=json", "--target-dir", COPY / "build"]
    done = subprocess.run(command + packages, cwd=COPY / "tree", stdout=subprocess.PIPE, text=True, check=True)
    commands = {}
    for line in done.stdout.splitlines():
        message = json.loads(line)
        if message.get("executable") and message["target"]["kind"] == ["test"]:
            source, name = Path(message["target"]["src_path"]), message["target"]["name"]
            name = "math" if "crates/math" in str(source) else name
            commands[name] = [message["executable"]]
            if name == "truth":
                files = [path.stem for path in source.parent.glob("*.rs")]
                commands.update({file: [message["executable"], f"{file}::"] for file in files})
    return commands


def failures(command, number):
    """Tests of a command that fail with a defect; the command itself where it does not end."""
    environment = {**os.environ, SWITCH: str(number), "LOBEFIT_TRIALS": TRIALS, "RUST_BACKTRACE": "0"}
    name, *part = [Path(command[0]).name.split("-")[0], *command[1:]]
    package = {"attack": "promises", "complete": "promises"}.get(name, "truth")
    name = part[0].removesuffix("::") if part else name
    folder = COPY / "tree" / "crates" / package
    try:
        done = subprocess.run(command, cwd=folder, env=environment, timeout=SECONDS, capture_output=True, text=True)
    except subprocess.TimeoutExpired:
        return [f"{name} does not end"]
    found = re.findall(r"^test (\S+) \.\.\. FAILED$", done.stdout, re.MULTILINE)
    return [f"{name} {test.removeprefix(f'{name}::')}" for test in found] or ([f"{name} dies"] if done.returncode else [])


HEAD = [
    "# Defects that were planted, and the tests that caught them",
    "",
    "`python3 tests/planted/plant.py` plants each and writes this page; four of those that caught it are named.",
    "",
    "| defect | in | tests that fail | of them |",
    "|---|---|---|---|",
]


def written():
    """The rows of the page by defect: what a run of some defects leaves as it is."""
    path = HERE / "caught.md"
    rows = path.read_text().splitlines()[len(HEAD) :] if path.exists() else []
    return {row.split(" | ")[0].removeprefix("| "): row for row in rows}


def main():
    defects = json.loads((HERE / "defects.json").read_text())
    asked = {int(number) for number in sys.argv[1:]} or set(range(1, len(defects) + 1))
    plant(defects)
    commands = build()
    used = sorted({name for number in asked for name in defects[number - 1]["tests"]})
    sound = {name: failures(commands[name], 0) for name in used}
    assert not any(sound.values()), f"without a defect: {sound}"
    rows, lines, missed = written(), [], []
    for number, defect in enumerate(defects, 1):
        if number not in asked:
            continue
        caught = [test for name in defect["tests"] for test in failures(commands[name], number)]
        row = f"| {defect['name']} | `{defect['file']}` | {len(caught)} | {', '.join(caught[:4])} |"
        print(row, flush=True)
        lines.append(row)
        rows[defect["name"]] = row
        if len(caught) < 2:
            missed.append(defect["name"])
    page = [rows[defect["name"]] for defect in defects if defect["name"] in rows]
    (HERE / "caught.md").write_text("\n".join(HEAD + page) + "\n")
    print(f"{len(lines) - len(missed)} of {len(lines)} defects caught by two tests or more")
    if missed:
        sys.exit(f"caught by fewer than two: {missed}")


main()
