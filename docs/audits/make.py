#!/usr/bin/env python3
"""Audits the files of zoo.json and writes docs/audits.md.

    python3 docs/audits/make.py --list
    python3 docs/audits/make.py FOLDER [ARTEFACT ...]

The list says where each file lies: repository, path, and the version that was audited. With artefacts, by the names of the page, it only makes the files of these that are cut out of others. FOLDER holds each file as OWNER/NAME/PATH, or OWNER/NAME@AT/PATH where zoo.json states `at` for the artefact. `lobefit`
is on PATH. Results stay in FOLDER/audits; a result that is newer than its file and the program is used again.
A file that is not there, and an audit that fails, is a row that says so, and exit code 1.
"""
import base64
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
# Texels that recompute.py integrates again.
POINTS = "200"
FITS = {"whole": "is", "part": "is, but for a part,", "none": "follows no convention; the nearest is"}
BRIEFLY = {"whole": "", "part": " (but for a part)", "none": " (follows no convention)"}


def ending(artefact):
    """The extension of a file that is made of the artefact's own; None where that is audited as it is."""
    parts = {"cut": ".bin", "decode": ".png", "include": os.path.splitext(artefact["file"])[1]}
    return next((kind for part, kind in parts.items() if part in artefact), None)


def place(folder, artefact):
    """The file that is audited: the artefact's own, a part that is cut out of it, or a list of includes."""
    repository, path = artefact["file"].split(": ")
    if repository == "lobefit":
        return os.path.join(ROOT, path)
    at = "@" + artefact["at"] if "at" in artefact else ""
    whole = os.path.join(folder, repository + at, path)
    if "make" in artefact and not os.path.exists(whole):
        os.makedirs(os.path.dirname(whole), exist_ok=True)
        subprocess.run([*shlex.split(artefact["make"]), os.path.abspath(whole)], cwd=ROOT, check=True)
    if not os.path.exists(whole):
        return whole
    with open(whole, "rb") as file:
        content = file.read()
    if "cut" in artefact:
        first, length = artefact["cut"]
        part = content[first : first + length]
    elif "decode" in artefact:
        text = re.search(artefact["decode"] + r'\s*=\s*"data:image/png;base64,([^"]+)"', content.decode())
        part = base64.b64decode(text.group(1))
    elif "include" in artefact:
        part = "".join(f'#include "{name}"\n' for name in [*artefact["include"], path]).encode()
    else:
        return whole
    made = os.path.join(folder, "audits", artefact["id"] + ending(artefact))
    os.makedirs(os.path.dirname(made), exist_ok=True)
    with open(made, "wb") as file:
        file.write(part)
    shutil.copystat(whole, made)
    return made


def digest(file):
    with open(file, "rb") as content:
        return hashlib.sha256(content.read()).hexdigest()


def listed():
    return json.load(open(os.path.join(HERE, "zoo.json")))


def options(folder, artefact):
    """The options of an artefact, and the folders of what it includes."""
    repository, path = artefact["file"].split(": ")
    folders = [os.path.join(folder, repository, part) for part in ("", os.path.dirname(path))]
    included = [word for name in folders for word in ("--include", name)] if "include" in artefact else []
    return ["--as", artefact["quantity"], *artefact["options"], *included]


def audit(folder, artefact):
    """The result as JSON, or why there is none."""
    file = place(folder, artefact)
    if not os.path.exists(file):
        return "the file is not there"
    result = os.path.join(folder, "audits", artefact["id"] + ".json")
    programs = [os.path.realpath(shutil.which(name) or file) for name in ("lobefit", "lobefit-audit")]
    newest = max(os.path.getmtime(f) for f in (file, *programs))
    command = ["lobefit", "audit", file, *options(folder, artefact), "--points", POINTS, "--json", "--quiet"]
    said = result + ".command"
    same = os.path.exists(result) and os.path.exists(said) and open(said).read() == shlex.join(command)
    if not (same and os.path.getmtime(result) > newest):
        print(artefact["id"], file=sys.stderr)
        done = subprocess.run(command, capture_output=True, text=True)
        with open(result, "w") as out:
            out.write(done.stdout if done.stdout.startswith("{") else json.dumps({"error": done.stderr.strip() or f"exit code {done.returncode}"}))
        with open(said, "w") as out:
            out.write(shlex.join(command))
    found = json.load(open(result))
    return found if "error" not in found else found["error"].rsplit(": ", 1)[-1]


def ours(folder):
    """Tables and formulas of a bake of ours.json: largest error and RMS, operations."""
    bake = os.path.join(folder, "audits", "ours")
    command = ["lobefit", "bake", os.path.join(HERE, "ours.json"), "--out", bake, "--quiet"]
    subprocess.run(command, check=True)
    manifest = json.load(open(os.path.join(bake, "manifest.json")))
    tables = {t["name"]: t["error"]["lookup"] for t in manifest["tables"]}
    formulas = {}
    for report in ("reflection", "sheen"):
        for a in json.load(open(os.path.join(bake, "reports", report + ".json")))["approximations"]:
            formulas[a["name"]] = a
    formulas.update((fit["name"], fit) for fit in manifest["fits"] if fit["quantity"] == "ggx-average")
    return tables, formulas


def pair(folder, entry):
    """Errors of a pair of tables of area lights, or why there are none."""
    repository, path = entry["file"].split(": ")
    place = lambda name: os.path.join(folder, repository, name)
    command = ["lobefit", "audit", place(path), "--as", "ltc", "--json", *entry["options"]]
    command += ["--scales", place(entry["scales"])] if "scales" in entry else []
    done = subprocess.run(command, capture_output=True, text=True)
    return json.loads(done.stdout) if done.stdout.startswith("{") else done.stderr.strip()


def shares(found):
    """Each error of a pair: the largest, and the RMS."""
    return [f"{number(e['max'])}, RMS {number(e['rms'])}" for e in found["errors"]]


def grade(found):
    """The verdict in a word; a pair has none without a limit."""
    if isinstance(found, str):
        return "none"
    return found["verdict"]["grade"] if "verdict" in found else found.get("grade", "no limit")


def reason(name, found):
    """Why an artefact does not pass, as the audit says it, and what mends it."""
    if isinstance(found, str) or grade(found) == "PASS":
        return []
    verdict, other = found["verdict"], found.get("otherwise")
    said = [f"- `{name}`: **{verdict['grade']}** {verdict['headline']}."]
    if other and other["verdict"]["grade"] != "UNKNOWN":
        said.append(f"Without {other['without']}: {other['verdict']['grade']} {other['verdict']['headline']}.")
    remedy = "; ".join(verdict.get("remedy", []))
    said += [f"Remedy: {remedy}."] * bool(remedy)
    return [" ".join(said)]


def number(x):
    return f"{x:.2g}" if abs(x) < 1e-3 else f"{x:.3g}"


def where(at):
    return ", ".join(f"{name} {number(value)}" for name, value in at.items())


def error(figures):
    inner = f"; {number(figures['inner'])} between texels" if "inner" in figures else ""
    return f"{number(figures['max'])} ({where(figures['at'])}), RMS {number(figures['rms'])}{inner}"


def compared(entry, tables, formulas):
    """What this program makes at the same size, or with no more operations, or why it makes nothing."""
    if isinstance(entry, str):
        return entry
    if isinstance(entry, list):
        said = [(("same lookup" if "plain" in name else "own lookup"), tables[name]) for name in entry]
        return "<br>".join(f"{how}: {number(e['max'])}, RMS {number(e['rms'])}" for how, e in said)
    if "formula" in entry:
        figures, ops = formulas[entry["formula"]]["certificate"], formulas[entry["formula"]]["cost"]["ops"]
        return f"`{entry['formula']}`: {number(figures['max_abs'])}, RMS {number(figures['rms'])} ({ops} operations, no table)"
    theirs = formulas[entry["published"]]["cost"]["ops"]
    family = [a for n, a in formulas.items() if n.startswith(entry["family"]) and not a["published"]]
    fitting = [a for a in family if a["cost"]["ops"] <= theirs]
    best = min(fitting or family, key=lambda a: (a["certificate"]["max_abs"], a["cost"]["ops"]))
    figures = best["certificate"]
    return f"`{best['name']}`: {number(figures['max_abs'])}, RMS {number(figures['rms'])} ({best['cost']['ops']} operations, theirs {theirs})"


def reading(found):
    """The convention that was found, in words."""
    first = found["conventions"][0]
    axis = lambda a: (
        ("1 - " if a["reversed"] else "") + a["coordinate"] + (f" ({a['registration']})" if "registration" in a else "")
    )
    axes = ", ".join(f"{a['axis']}: {axis(a)}" for a in first["axes"])
    decoded = f"; decoded from {found['encoding']}" if found.get("encoding") else ""
    return (f"{axes}; {first['lobe']}" if first.get("lobe") else axes) + decoded


def stands(found):
    """How a file stands to the convention that was found: a published fit that fits none is held against one."""
    held = found["fits"] == "none" and "published" in found
    return f"is {found['published']['name']}; held against" if held else FITS[found["fits"]]


def integrated():
    """The entries of recompute.py, by artefact."""
    file = os.path.join(HERE, "recomputed.json")
    return {e["id"]: e for e in json.load(open(file))["artefacts"]} if os.path.exists(file) else {}


def unknown(folder, artefact, entry):
    """Why the second integration says nothing of a file; None where it does."""
    if entry is None:
        return "none"
    file = place(folder, artefact)
    return "of another file" if os.path.exists(file) and entry.get("sha256") != digest(file) else None


def again(entry, name):
    """What the second integration found of a channel."""
    own = next((c for c in entry.get("channels", []) if c["name"] == name), None)
    if own is None:
        return entry.get("why", "none")
    said = f"{number(own['max'])}, RMS {number(own['rms'])}; {own['points']} ± {number(own['standard_error'])}"
    return said if own["agrees"] else f"{said}; differs: {own['why']}"


def rows(artefact, found, compare, entry):
    """A row for each channel that is judged."""
    name = f"`{artefact['id']}` {artefact['what']}"
    if isinstance(found, str):
        return [f"| {name} | | {found} | | | | {compare} |"]
    white = found.get("furnace") if artefact["quantity"] != "sheen-charlie" else None
    furnace = f"{white['least']:+.1%} to {white['most']:+.1%} ({where(white['at'])})" if white else ""
    out = []
    for channel in found["channels"]:
        if "texels" not in channel:
            continue
        lookup = used(artefact, channel) if channel.get("lookup") else None
        out.append(
            f"| {name} | {channel['holds'].split(' (')[0]} | {error(channel['texels'])} | {again(entry, channel['name'])} "
            f"| {error(lookup) if lookup else ''} | {furnace} | {compare} |"
        )
        name = furnace = compare = ""
    return out


def used(artefact, channel):
    """The error of what a shader gets: of a lookup with the remap that it has, or of a call."""
    kinds = ["lookup"] if artefact.get("remapped") else ["plain_lookup", "lookup"]
    return next(channel[kind] for kind in [*kinds, "texels"] if channel.get(kind))


def glance(projects, found, lights):
    """A row for each artefact: the verdict, the worst channel, and whether an issue is written for the project."""
    lines = ["| project | artefact | verdict | largest error of a lookup or a call | issues below |", "|---|---|---|---|---|"]
    for project in projects:
        name, issues = project["project"], len(project["issues"])
        anchor = re.sub(r"[^\w\- ]", "", name.lower()).replace(" ", "-")
        for artefact in project["artefacts"]:
            result = found[artefact["id"]]
            said = "see below"
            if isinstance(result, dict):
                worst = max((c for c in result["channels"] if "texels" in c), key=lambda c: used(artefact, c)["max"])
                figures = used(artefact, worst)
                said = f"{worst['holds'].split(' (')[0]} {number(figures['max'])}, RMS {number(figures['rms'])}"
                said += BRIEFLY[result["fits"]]
                said += f" (decoded from {result['encoding']})" if result.get("encoding") else ""
            lines.append(f"| [{name}](#{anchor}) | {artefact['what']} | {grade(result)} | {said} | {issues or ''} |")
        for entry, result in lights[name]:
            said = f"a square light {shares(result)[0]}" if isinstance(result, dict) else "see below"
            lines.append(f"| [{name}](#{anchor}) | {entry['what']} | {grade(result)} | {said} | {issues or ''} |")
    return lines + [""]


def of_lights(lights, ours):
    """The pairs of a project, and ours."""
    lines = ["", "| tables of area lights | a square light | a light of any shape | E | B |", "|---|---|---|---|---|"]
    for what, result in [*((entry["what"], result) for entry, result in lights), ("ours, 64 x 64 halves", ours)]:
        cells = shares(result) if isinstance(result, dict) else [result]
        lines.append(f"| {what} | {' | '.join(cells + [''] * (4 - len(cells)))} |")
    return lines


def command_of(entry):
    """How a pair is audited, where its files lie."""
    scales = ["--scales", os.path.basename(entry["scales"])] if "scales" in entry else []
    command = ["lobefit", "audit", os.path.basename(entry["file"]), "--as", "ltc", *entry["options"], *scales]
    return [f"# {entry['what']}, {entry['file']}", shlex.join(command)]


def section(project, found, compares, entries, lights):
    lines = [f"## {project['project']}", "", f"{project['at']}. {project['notes']}"]
    if project["artefacts"]:
        lines += ["", "| artefact | holds | error at its points | second integration | error of a lookup | white furnace | ours |"]
        lines += ["|---|---|---|---|---|---|---|"]
    for artefact in project["artefacts"]:
        name = artefact["id"]
        lines += rows(artefact, found[name], compares[name], entries[name])
    lines += of_lights(lights[project["project"]], lights["ours"]) if lights[project["project"]] else []
    reasons = [line for artefact in project["artefacts"] for line in reason(artefact["id"], found[artefact["id"]])]
    lines += [""] * bool(reasons) + reasons
    lines += ["", "```sh"]
    for artefact in project["artefacts"]:
        name, file = artefact["id"], artefact["file"]
        lines.append(f"# {name}, {file}")
        if "how" in artefact:
            lines.append(f"# {artefact['how']}")
        here, said = os.path.basename(file.split(": ")[1]), options("", artefact)
        if "make" in artefact:
            lines.append(f"{artefact['make']} {here}")
        if ending(artefact):
            lines.append(f"python3 docs/audits/make.py FOLDER {name}")
            here, said = f"FOLDER/audits/{name}{ending(artefact)}", options("FOLDER", artefact)
        lines.append(shlex.join(["lobefit", "audit", here, *said]))
        if isinstance(found[name], dict):
            lines.append(f"# {stands(found[name])} {reading(found[name])}")
    for entry, _ in lights[project["project"]]:
        lines += command_of(entry)
    lines += ["```", ""]
    for issue in project["issues"]:
        lines += [f"> **{issue['title']}**", ">", f"> {issue['text']}", ""]
    return lines


def main(folder):
    zoo = listed()
    os.makedirs(os.path.join(folder, "audits"), exist_ok=True)
    artefacts = [a for p in zoo["projects"] for a in p["artefacts"]]
    found = {a["id"]: audit(folder, a) for a in artefacts}
    tables, formulas = ours(folder)
    compares = {a["id"]: compared(a["ours"], tables, formulas) for a in artefacts}
    known = integrated()
    stale = {a["id"]: unknown(folder, a, known.get(a["id"])) for a in artefacts}
    entries = {i: {"why": why} if why else known[i] for i, why in stale.items()}
    page = open(os.path.join(HERE, "head.md")).read().splitlines() + [""]
    lights = {p["project"]: [(e, pair(folder, e)) for e in p.get("area_lights", [])] for p in zoo["projects"]}
    own = "tables/ggx-ltc-correlated-64x64"
    lights["ours"] = pair(folder, {"file": f"audits/ours: {own}.exr", "scales": f"{own}-light.exr", "options": []})
    page += glance(zoo["projects"], found, lights)
    for project in zoo["projects"]:
        page += section(project, found, compares, entries, lights)
    with open(os.path.join(ROOT, "docs", "audits.md"), "w") as out:
        out.write("\n".join(page).rstrip() + "\n")
    missing = [i for i, f in found.items() if isinstance(f, str)]
    missing += [e["what"] for p in zoo["projects"] for e, f in lights[p["project"]] if isinstance(f, str)]
    missing += [own] * isinstance(lights["ours"], str)
    unsure = [f"{i} ({why})" for i, why in stale.items() if why]
    said = ["not audited: " + ", ".join(missing)] * bool(missing)
    said += ["no second integration: " + ", ".join(unsure)] * bool(unsure)
    if said:
        sys.exit("\n".join(said))


def files(folder, names):
    """Makes the files of artefacts, and says where they lie."""
    artefacts = [a for p in listed()["projects"] for a in p["artefacts"] if a["id"] in names]
    if len(artefacts) != len(set(names)):
        sys.exit("an artefact that zoo.json has not")
    made = [place(folder, artefact) for artefact in artefacts]
    missing = [path for path in made if not os.path.exists(path)]
    if missing:
        sys.exit(f"not there: {', '.join(missing)}")
    print("\n".join(made))


def sources():
    """Where each file lies, what is audited of it, and the version."""
    for project in listed()["projects"]:
        for artefact in project["artefacts"]:
            at = f" (at {artefact['at']})" if "at" in artefact else ""
            cut = " bytes {0} to {1}".format(artefact["cut"][0], sum(artefact["cut"]) - 1) if "cut" in artefact else ""
            print(f"{artefact['id']}: {artefact['file']}{cut}{at}; {project['at']}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if sys.argv[1:] == ["--list"]:
        sources()
        sys.exit()
    if len(sys.argv) > 2:
        files(sys.argv[1], sys.argv[2:])
    else:
        main(sys.argv[1])
