#!/usr/bin/env python3
"""Makes README's numbers of how strong the check is from the kept results in data/results: every driver, every set, the
worst beside the best.
Usage: scripts/readme_numbers.py          writes them into README.md
       scripts/readme_numbers.py --check  fails where README.md says otherwise, or has such numbers elsewhere"""
import difflib
import json
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
results = root / "data" / "results"
begin = "<!-- made by scripts/readme_numbers.py from data/results; ctest -R readme_numbers -->\n"
end = "<!-- end of what scripts/readme_numbers.py makes -->\n"


def fail(message):
    sys.exit(f"readme_numbers: {message}")


def text_of(name):
    return (results / name).read_text(encoding="utf-8")


def only(pattern, text, name):
    found = re.findall(pattern, text)
    if len(found) != 1:
        fail(f"{name}: expected one line like /{pattern}/, found {len(found)}")
    return found[0]


def of(found, all_of):
    return f"{int(found):,} of {int(all_of):,}"


def share(found, all_of):
    return f"{100 * int(found) / int(all_of):.0f} %"


def number(cell):
    """The number that a cell begins with, or that stands behind "about"."""
    return int(re.match(r"(?:about )?(\d+)", cell)[1])


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def catalogue():
    """Rows of the catalogue of bugs in the collision system, by driver: text, found, cause, power."""
    kept = {name: json.loads(text_of(f"mutants/{name}.json")) for name in ("llvmpipe", "h200")}
    table = [cells(line) for line in text_of("drivers/README.md").split("\n") if re.match(r"\| [^|]*\| \d+ of \d+ \|", line)]
    rows = {row[0]: row for row in table if len(row) == 6}
    names = {
        "the same, at 7a53a6f": "llvmpipe, Mesa 22.3.6",
        "llvmpipe, Mesa 25.0.7, OSMesa": "llvmpipe, Mesa 25.0.7",
        "llvmpipe, Mesa 26.2.6, EGL": "llvmpipe, Mesa 26.2.6",
        "NVIDIA H200, 580.159.04, EGL, at e1246da": "NVIDIA H200, 580.159.04",
    }
    if missing := names.keys() - rows.keys():
        fail(f"data/results/drivers/README.md: no row {' | '.join(missing)}")
    for key, name in (("the same, at 7a53a6f", "llvmpipe"), ("NVIDIA H200, 580.159.04, EGL, at e1246da", "h200")):
        verdict, cause = kept[name]["verdict"], kept[name]["cause"]
        if rows[key][1:3] != [of(verdict["found"], verdict["of"]), of(cause["named"], cause["of"])]:
            fail(f"data/results/drivers/README.md and data/results/mutants/{name}.json differ in the row {key}")
    return kept, [(names[key], *rows[key][1:5]) for key in names]


def system_rows():
    """The same of the other systems whose lists are kept: system, driver, found, named, false alarms."""
    rows = []
    for system in ("dust", "lifecycle", "fluid"):
        name = f"{system}/mutants_llvmpipe.txt"
        found = only(r"(\d+) of (\d+) found, (\d+) of (\d+) named, (\d+) false alarms", text_of(name), name)
        rows.append((system, of(*found[:2]), of(*found[2:4]), int(found[4])))
    page = (root / "docs" / "lights.md").read_text(encoding="utf-8")
    found = only(r"Of (\d+) mistakes in the shaders' texts (\d+) are found, and (\d+) of the (\d+) that", page, "docs/lights.md")
    rows.append(("lights", of(found[1], found[0]), of(*found[2:]), 0))
    return rows


def foreign_sets():
    """Of wrong shaders from other hands: each set as it was first run, before anything was mended for it."""
    text = text_of("foreign/README.md")
    sets = {}
    for line in text.split("\n"):
        row = cells(line)
        if len(row) == 8 and re.fullmatch(r"[0-9a-f]{7}", row[1]) and ", after the names" not in row[0]:
            sets[row[0].split(",")[0]] = [number(cell) for cell in (row[2], row[3], row[4], row[7])]
    if len(sets) < 11:
        fail(f"data/results/foreign/README.md: expected eleven sets or more, found {len(sets)}")
    right = only(
        r"All (\d+) that keep the order of operations AGREE; of (\w+) that round otherwise (\w+) AGREE and (\w+)\s+are DIVERGENT",
        text,
        "foreign/README.md",
    )
    return sets, right


def made():
    kept, drivers = catalogue()
    sets, right = foreign_sets()
    bugs = len(kept["llvmpipe"]["mutants"])
    same = sum("equivalent" in mutant for mutant in kept["llvmpipe"]["mutants"])
    alarms = sum(one["verdict"]["false_alarms"] for one in kept.values())
    wrong, found, named, misled = (sum(column) for column in zip(*sets.values()))
    least = min(sets.values(), key=lambda one: one[2] / one[0])
    most = max(sets.values(), key=lambda one: one[2] / one[0])
    missed = min(sets.values(), key=lambda one: one[1] / one[0])
    lines = [
        f"{bugs} bugs of the collision system, in shaders and in host code, planted one at a time (`tests/mutants/`), and those of "
        "other systems:",
        "",
        "| bugs of | driver | found, of those that change anything | cause named first | would have shown: found, missed |",
        "|---|---|---|---|---|",
    ]
    for driver, is_found, cause, _, shown in drivers:
        lines.append(f"| collision | {driver} | {is_found} | {cause} | {shown} |")
    for system, is_found, cause, false in system_rows():
        alarms += false
        lines.append(f"| {system} | llvmpipe, Mesa 22.3.6 | {is_found} | {cause} | |")
    rule = {name: [one["other_rules"][name] for one in kept.values()] for name in ("rel 1e-7", "image")}
    compared = [" and ".join(of(one["found"], one["of"]) for one in both) for both in rule.values()]
    lines += [
        "",
        f"The last column is what the report's line `power` said beforehand. False alarms, on {same} changes that provably change "
        f"nothing and on the shipped shaders: {alarms}. On the same runs, comparing final states with a relative error of 1e-7 finds "
        f"{compared[0]} (Mesa 22.3.6 and H200), a fuzzy image comparison {compared[1]}.",
        "",
        "Wrong shaders that others wrote without seeing lockstep's list of mistakes, each set as it was first run, on llvmpipe "
        f"(`data/results/foreign/README.md`); {misled} of the causes mislead:",
        "",
        f"| of {len(sets)} sets | found | cause named right |",
        "|---|---|---|",
        f"| all | {of(found, wrong)} | {of(named, wrong)} ({share(named, wrong)}) |",
        *(
            f"| {what} | {of(one[1], one[0])} | {of(one[2], one[0])} ({share(one[2], one[0])}) |"
            for what, one in (("fewest found", missed), ("fewest causes", least), ("most causes", most))
        ),
        "",
        f"Of the right shaders in the last six of these sets all {right[0]} that keep the order of operations AGREE. Of {right[1]} that "
        f"round otherwise {right[2]} AGREE and {right[3]} are DIVERGENT, each with a hint that names the rule by which it is legal.",
    ]
    return "\n".join(lines) + "\n"


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    path = root / "README.md"
    text = path.read_text(encoding="utf-8")
    if text.count(begin) != 1 or text.count(end) != 1:
        fail(f"README.md: expected one line each of {begin.strip()} and {end.strip()}")
    head, rest = text.split(begin)
    now, tail = rest.split(end)
    right = made()
    if not sys.argv[1:]:
        path.write_text(head + begin + right + end + tail, encoding="utf-8")
        return 0
    status = 0
    if now != right:
        print("README.md does not say what the kept results say; scripts/readme_numbers.py writes it:")
        print("".join(difflib.unified_diff(now.splitlines(True), right.splitlines(True), "README.md", "data/results")))
        status = 1
    for line in (head + tail).split("\n"):
        # What a program printed is held by a run of it (tests/docs).
        if not line.startswith("    ") and (chosen := re.search(r"[\d,]+ of (?:the )?[\d,]+|\d %", line)):
            print(f"README.md: '{chosen[0]}' stands outside of what scripts/readme_numbers.py makes: {line}")
            status = 1
    return status


sys.exit(main())
