#!/usr/bin/env python3
"""Prints the rows of the published tables of area lights in docs/audit.md.

    python3 docs/audits/ltc.py FOLDER

FOLDER holds each file as OWNER/NAME/PATH, at the commit that is stated. `lobefit` is on PATH. A file that is not there is exit code 1.
"""
import json
import os
import subprocess
import sys

# Words of the row, its files, their commit, and further options.
TABLES = [
    ("`ltc_code`", ["selfshadow/ltc_code/fit/results/ltc_1.dds", "selfshadow/ltc_code/fit/results/ltc_2.dds"], "31e5e96b54f98f33098f8503003119ba2231a1c6"),
    ("Bevy", ["bevyengine/bevy/crates/bevy_pbr/src/ltc/ltc.ktx2"], "4805ca792c3e94eef07afd6fa9a2712f388c9a67"),
]


def row(folder, words, files, at):
    """The row of a pair."""
    first, *scales = [os.path.join(folder, file) for file in files]
    more = [word for file in scales for word in ("--scales", file)]
    done = subprocess.run(["lobefit", "audit", first, "--as", "ltc", "--json", *more], capture_output=True, text=True)
    if not done.stdout.startswith("{"):
        sys.exit(f"{first}: {done.stderr.strip()}")
    errors = json.loads(done.stdout)["errors"]
    cells = [f"{error['max']}, RMS {error['rms']}" for error in errors]
    return " | ".join([f"| {words}, at `{at[:8]}`, of GGX", *cells]) + " |"


for table in TABLES:
    print(row(sys.argv[1], *table))
