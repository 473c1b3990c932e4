#!/usr/bin/python3
"""What scripts/driver_matrix.sh keeps of its runs.

driver_results.py add FILE --driver D --renderer TEXT --commit C --runs DIR [--mutants PATH] --run RUN...
    puts the runs DIR/RUN.{json,status,error}, RUN = DRIVER/SCENE.PRESET.NxF, into FILE. Rows of other scenes, presets and
    sizes stay. A run on another renderer than TEXT names did not run.
driver_results.py table DIR --commit C --driver D...
    writes DIR/README.md of all files there, and judges the drivers' rows of that commit: status 0, 1 something is
    divergent, 2 something was not run.
"""
import argparse
import json
import os
import pathlib
import sys

RIGHT = ("AGREE", "LEGAL")


def text_of(path):
    return path.read_text(errors="replace") if path.exists() else ""


def row_of(run, runs, renderer, commit):
    scene, preset, size = run.split("/", 1)[1].rsplit(".", 2)
    row = {"scene": scene, "preset": preset, "size": size, "commit": commit}
    status = int(text_of(runs / f"{run}.status") or 2)
    report = runs / f"{run}.json"
    if not report.exists():
        words = text_of(runs / f"{run}.error").strip().splitlines()
        return row | {"not_run": words[-1] if words else f"exit status {status}, without a word"}
    report = json.loads(report.read_text())
    if renderer not in report["context"]:
        return row | {"not_run": f"this is not {renderer}: {report['context']}"}
    verdicts = report["verdicts"] or {}  # a free run has none
    counts = {f"{kind}_{what}": number for kind in ("particles", "texels") for what, number in verdicts.get(kind, {}).items() if number}
    return row | {"verdict": report["verdict"], "status": status, "renderer": report["context"],
                  "particle_frames": report["particles"] * report["frames"], "hits": report["hits"],
                  "hash": report["hash"]["gpu"], **counts}


def add(arguments):
    file, runs = pathlib.Path(arguments.file), pathlib.Path(arguments.runs)
    results = json.loads(file.read_text()) if file.exists() else {"driver": arguments.driver, "rows": []}
    for run in arguments.run:
        row = row_of(run, runs, arguments.renderer, arguments.commit)
        same = [row[key] for key in ("scene", "preset", "size")]
        results["rows"] = [r for r in results["rows"] if [r[key] for key in ("scene", "preset", "size")] != same] + [row]
    results["rows"].sort(key=lambda row: (row["scene"], row["preset"], row["size"]))
    if arguments.mutants:
        score = pathlib.Path(arguments.mutants + ".json")
        if score.exists():
            score = json.loads(score.read_text())
            results["mutants"] = {key: score[key] for key in ("verdict", "cause", "commit", "renderer")}
        else:
            words = text_of(pathlib.Path(arguments.mutants + ".txt")).strip().splitlines()
            results["mutants"] = {"not_run": words[-1] if words else "without a word", "commit": arguments.commit}
    with open(f"{file}.new", "w") as out:  # a row a line
        rows = ",\n".join("    " + json.dumps(row, sort_keys=True) for row in results.pop("rows"))
        head = "".join(f"  {json.dumps(key)}: {json.dumps(value)},\n" for key, value in results.items())
        out.write(f'{{\n{head}  "rows": [\n{rows}\n  ]\n}}\n')
    os.replace(f"{file}.new", file)


def judged(rows):
    """(wrong, not run, skipped for want of a mesh)"""
    ran = [row for row in rows if "verdict" in row]
    skipped = [row for row in rows if row.get("not_run", "").startswith("skipped: ")]
    return ([row for row in ran if row["verdict"] not in RIGHT or row["status"] != 0],
            [row for row in rows if "not_run" in row and row not in skipped], skipped)


def cell(rows):
    wrong, missing, skipped = judged(rows)
    verdicts = [row["verdict"] for row in rows if "verdict" in row]
    parts = [f"{verdicts.count(name)} {name}" for name in sorted(set(verdicts))]
    parts += [f"{len(group)} {name}" for name, group in (("not run", missing), ("skipped", skipped)) if group]
    return ("**" if wrong or missing else "") + ", ".join(parts) + ("**" if wrong or missing else "")


def mutants_cell(results):
    score = results.get("mutants", {})
    if "not_run" in score:
        return "**not run**"
    if not score:
        return ""
    found = score["verdict"]
    return f"{found['found']} of {found['of']}, {found['false_alarms']} false alarms ({score['commit']})"


def table(arguments):
    folder = pathlib.Path(arguments.folder)
    lines = ["# Shipped shaders on Mesa's drivers", "",
             "`scripts/driver_matrix.sh ROOTS --mutants` made these files: each scene of `data/scenes` in each preset, `exact` as a free",
             "run. A cell counts runs by verdict; bold is what must not be.", "",
             "| driver | renderer | paper | corrected | exact | particle-frames | mutants found | commit |", "|---|---|---|---|---|---|---|---|"]
    status = 0
    complaints = []
    for file in sorted(folder.glob("*.json")):
        results = json.loads(file.read_text())
        rows = results["rows"]
        by_preset = [cell([row for row in rows if row["preset"] == preset]) for preset in ("paper", "corrected", "exact")]
        renderers = sorted({row["renderer"] for row in rows if "renderer" in row})
        commits = sorted({row["commit"] for row in rows})
        lines.append(f"| {results['driver']} | {'; '.join(renderers)} | " + " | ".join(by_preset) +
                     f" | {sum(row.get('particle_frames', 0) for row in rows):,} | {mutants_cell(results)} | {', '.join(commits)} |")
        if results["driver"] not in arguments.driver:
            continue
        wrong, missing, skipped = judged([row for row in rows if row["commit"] == arguments.commit])
        for row in wrong + missing + skipped:
            what = row.get("not_run") or f"{row['verdict']}, {row.get('particles_divergent', 0)} particle states and " \
                                         f"{row.get('texels_divergent', 0)} texels divergent"
            complaints.append(f"{results['driver']} {row['scene']} {row['preset']} {row['size']}: {what}")
        score = results.get("mutants", {})
        survived = "verdict" in score and (score["verdict"]["found"] < score["verdict"]["of"] or score["verdict"]["false_alarms"])
        if wrong or survived:
            status = 1
        elif (missing or "not_run" in score) and status == 0:
            status = 2
    (folder / "README.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines[5:] + [""] + complaints))
    return status


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(required=True)
    verb = verbs.add_parser("add")
    verb.add_argument("file")
    for name in ("driver", "renderer", "commit", "runs", "mutants"):
        verb.add_argument(f"--{name}", required=name != "mutants")
    verb.add_argument("--run", nargs="+")
    verb.set_defaults(run_verb=add)
    verb = verbs.add_parser("table")
    verb.add_argument("folder")
    verb.add_argument("--commit", required=True)
    verb.add_argument("--driver", nargs="+")
    verb.set_defaults(run_verb=table)
    arguments = parser.parse_args()
    sys.exit(arguments.run_verb(arguments))


if __name__ == "__main__":
    main()
