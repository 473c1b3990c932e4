#!/usr/bin/env python3
"""Writes OUT/lifecycle_tables.md and .json: what the passes of the system lifecycle take on a GL, in tables shaped as the
source's (docs/lifecycle.md), and whether both sides, run free, come to one hash.
  ladder      the packing ladder: move and simulate by layout, split and fused, beside a copy of as many bytes
  management  index lists beside the order of birth, and what packing and fusing change
  ribbons     sorted index lists beside the order of birth; both prefix sums
  polygon     k-gons beside quads, 3,500 large sprites and many small ones
  forces      curl noise, and exact beside plain arithmetic
  hashes      preset exact, free: layouts and scenes, as many particles alive as asked for
Usage: scripts/lifecycle_tables.py LOCKSTEP OUT [--gl KIND] [--parts ladder,...] [--particles N,...] [--ribbons N,...]
           [--frames N] [--alive N] [--hash-frames N] [--layouts L,...] [--hashes NAME,...] [--seconds N] [--jobs N]
           [--threads N] [--known FILE] [--twins] [--render WxH] [--scenes DIR] [--commit NAME]
  --particles  of ladder; the other tables have the first of them
  --layouts    of ladder and hashes
  --hashes     of these rows alone, named as in the table: "fire" are all of its layouts, "fire 40" is one
  --seconds    of the hashes: those that still run are ended then; their verdict is of the frames before
  --threads    of each check among the hashes; its report is kept in OUT/hashes/ when it ends
  --known      of the hashes: a page with a table of them (data/results/lifecycle/h200.md). GL alone runs the rows that
               have one there, a tenth to a half of the time, and its hash after the last frame is held against that
  --twins      times the reference as well
Exit status: 0 every hash is equal, 1 one is not, 2 a part could not be run."""
import argparse
import json
import pathlib
import re
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LAYOUTS = ("112", "80", "72", "64", "48", "44", "40")
SIMULATED = {layout: 48 if layout in ("112", "80", "72") else 24 for layout in LAYOUTS}  # bytes that a step needs
WARM_UP = 66  # from then on, as many die as are born
SUMS = {"destroy": ("destroy_reduce", "destroy_scan", "destroy"), "sort": ("pre_sort", "sort"),
        "indirect": ("post_destroy", "post_emit", "indirect"), "emission": ("emit",), "simulation": ("simulate",),
        "pre-prefix": ("ribbon_distance",), "prefix": ("prefix_reduce", "prefix_scan", "prefix_sum"), "move": ("move",),
        "drawing": ("drawing",), "points": ("ribbon",)}


def numbers(text):
    return [int(n) for n in text.split(",")]


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lockstep")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--gl", default="auto")
    parser.add_argument("--parts", default="ladder,management,ribbons,polygon,forces,hashes")
    parser.add_argument("--particles", type=numbers, default=[1_000_000, 4_000_000])
    parser.add_argument("--ribbons", type=numbers, default=[10_000, 100_000])
    parser.add_argument("--frames", type=int, default=9)
    parser.add_argument("--alive", type=int, default=100_000)
    parser.add_argument("--hash-frames", type=int, default=600)
    parser.add_argument("--layouts", type=lambda text: text.split(","), default=list(LAYOUTS))
    parser.add_argument("--seconds", type=float, default=240)
    parser.add_argument("--hashes", type=lambda text: text.split(","))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--known", type=pathlib.Path)
    parser.add_argument("--twins", action="store_true")
    parser.add_argument("--render", default="1920x1080")
    parser.add_argument("--scenes", type=pathlib.Path, default=ROOT / "data/scenes/lifecycle")
    parser.add_argument("--commit")
    return parser.parse_args()


class Run:
    """What was asked, and the scenes that are made of the shipped ones."""

    def __init__(self, asked):
        self.asked, self.gl, self.made = asked, "", asked.out / "scenes"
        self.made.mkdir(parents=True, exist_ok=True)
        self.render = [int(n) for n in asked.render.split("x")]

    def shipped(self, name):
        scene = json.loads((self.asked.scenes / f"{name}.json").read_text())
        if "sprite" in scene:
            scene["sprite"]["texture"] = str((self.asked.scenes / scene["sprite"]["texture"]).resolve())
        return scene

    def kept(self, name, scene):
        file = self.made / f"{name}.json"
        file.write_text(json.dumps(scene))
        return file

    def shower(self, count, forces=()):
        """A second's life for all: each frame a sixtieth dies and is born."""
        scene = self.shipped("million")
        scene["render"] = self.render
        scene["switches"] = {} if forces else {"integration": "ballistic"}
        scene["camera"] = {"eye": [0, 4, 24], "target": [0, 4, 0]}
        scene["emitters"][0].update(rate=count, lifetime=[1, 1], capacity=count, size=[0.03, 0.03], blend="opaque",
                                    forces=list(forces))
        return self.kept(f"shower_{count}_{len(forces)}", scene)

    def ribbon(self, count):
        scene = self.shipped("ribbon_100k")
        scene["render"] = self.render
        scene["emitters"][0].update(rate=count, lifetime=[1, 1], capacity=count, bursts=[])
        return self.kept(f"ribbon_{count}", scene)

    def bench(self, scene, count, settings, preset="corrected", floor=False, warm_up=WARM_UP):
        """The milliseconds of each row: GL, the GPU's clock and the twin. Rows of one name are added up."""
        words = [self.asked.lockstep, "bench", scene, "--counts", count, "--gl", self.asked.gl, "--frames",
                 self.asked.frames, "--warm-up", warm_up, "--preset", preset, *(w for s in settings for w in ("--set", s)),
                 *([] if self.asked.twins else ["--gl-only"]), *(["--floor"] if floor else [])]
        print("+", *words, file=sys.stderr, flush=True)
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
        if done.returncode not in (0, 1) or (self.asked.twins and done.returncode != 0):
            raise RuntimeError(done.stdout + done.stderr)
        lines = done.stdout.splitlines()
        self.gl, rows = lines[0], {}
        for line in map(str.split, lines[4:]):
            row = rows.setdefault(line[1], [0.0, 0.0, 0.0])
            for i in range(3):
                row[i] += 0.0 if line[2 + i] == "-" else float(line[2 + i])
        return rows


def of(rows, column, clock=1):
    """By the GPU's clock; nothing where no pass of the column ran."""
    there = [rows[name][clock] for name in SUMS.get(column, (column,)) if name in rows]
    return sum(there) if there else None


def total(rows):
    return rows["frame"][1] + of(rows, "drawing")


def ms(x):
    return "-" if x is None else f"{x:.3f}" if x < 10 else f"{x:.1f}"


def ratio(a, b):
    return "-" if a is None or not b else f"{a / b:.2f}"


def table(head, rows):
    cells = [head, ["---"] * len(head), *rows]
    return ["", *("| " + " | ".join(map(str, row)) + " |" for row in cells), ""]


def twin_of(run, rows):
    return f"{rows['frame'][2]:.1f} ({ratio(rows['frame'][0], rows['frame'][2])}x)" if run.asked.twins else "-"


def ladder(run):
    text, kept = ["## The packing ladder", "",
                  "Milliseconds. A copy: `glCopyBufferSubData` of as many bytes as the particles have. A step's bytes: 48 of each",
                  "particle to 72 bytes, 24 from 64 down, read and written, at the speed of the copy."], {}
    for count in run.asked.particles:
        scene, rows, first = run.shower(count), [], None
        for layout in run.asked.layouts:
            split = run.bench(scene, count, [f"layout={layout}", "fuse=split"], floor=True)
            fused = run.bench(scene, count, [f"layout={layout}", "fuse=fused"])
            kept[f"{count}, {layout}"] = {"split": split, "fused": fused}
            first = first or split
            copy = split.get("copy_of_particles", [0.0] * 3)[1]  # small buffers have none
            step = copy * SIMULATED[layout] / int(layout)
            move, both = of(split, "move"), of(fused, "move")
            rows.append([layout, ms(move), ratio(of(first, "move"), move), ms(copy or None), ratio(move, copy),
                         ms(of(split, "simulation")), ratio(of(split, "simulation"), step), ms(both), ratio(both, copy),
                         ratio(move + of(split, "simulation"), both), ms(of(split, "drawing")), twin_of(run, fused)])
        text += ["", f"### {count:,} particles"]
        text += table(["layout", "move", f"{run.asked.layouts[0]} / it", "a copy", "move / copy", "simulate", "/ its bytes", "both fused",
                       "fused / copy", "split / fused", "drawing", "twin's frame (GL / twin)"], rows)
    return text, kept


COLUMNS = ("emission", "destroy", "move", "simulation", "indirect", "drawing")


def management(run):
    count = run.asked.particles[0]
    kinds = {"index lists, scan": ["management=index_lists", "layout=112"],
             "index lists, atomic": ["management=index_lists", "layout=112", "compaction=atomic"],
             "order of birth, 112": ["layout=112", "fuse=split"], "order of birth, 72": ["layout=72", "fuse=split"],
             "order of birth, 40": ["layout=40", "fuse=split"], "simulation fused, 40": ["layout=40", "fuse=fused"],
             "fused, atomic, 40": ["layout=40", "fuse=fused", "compaction=atomic"]}
    kept = {name: run.bench(run.shower(count), count, settings) for name, settings in kinds.items()}
    rows = [[name, *(ms(of(one, column)) for column in COLUMNS), ms(total(one)),
             ratio(total(kept["index lists, scan"]), total(one))] for name, one in kept.items()]
    text = ["", f"## {count:,} sprites, {run.asked.render}, opaque"]
    return text + table(["", *COLUMNS, "total", "index lists / it"], rows), kept


RIBBON = ("sort", "move", "simulation", "pre-prefix", "prefix", "points", "drawing")


def ribbons(run):
    kinds = {"index lists, sorted, 112": ["management=index_lists", "layout=112", "uv_anchor=oldest"],
             "order of birth, 112": ["layout=112", "fuse=split"], "order of birth, 40": ["layout=40", "fuse=split"],
             "40, fused": ["layout=40"], "40, fused, float_blocks": ["layout=40", "distance_sum=float_blocks", "uv_anchor=oldest"]}
    text, kept = ["", "## Ribbons, UV by distance"], {}
    for count in run.asked.ribbons:
        these = {name: run.bench(run.ribbon(count), count, settings) for name, settings in kinds.items()}
        kept.update({f"{name}, {count}": one for name, one in these.items()})
        text += ["", f"### {count:,} points"]
        text += table(["", *RIBBON, "total"], [[name, *(ms(of(one, column)) for column in RIBBON), ms(total(one))]
                                               for name, one in these.items()])
    return text, kept


def polygon(run):
    kept, rows = {}, []
    for name in ("kgon_large", "kgon_small"):
        scene = run.shipped(name)
        scene["render"] = run.render
        count = min(scene["emitters"][0]["capacity"], run.asked.particles[0])
        scene["emitters"][0]["bursts"] = [[0, count]]
        times = {}
        for corners in ("quad", 3, 4, 6, 8):
            scene["sprite"]["bounding"] = corners if corners == "quad" else {"k": corners}
            times[corners] = run.bench(run.kept(f"{name}_{corners}", scene), count, [], warm_up=2)
        kept[name] = {str(k): v for k, v in times.items()}
        quad = of(times["quad"], "drawing")
        rows.append([name, f"{count:,}", *(ms(of(one, "drawing")) for one in times.values()),
                     *(ratio(quad, of(one, "drawing")) for k, one in times.items() if k != "quad")])
    text = ["", f"## Polygons and quads, {run.asked.render}", "", "Milliseconds of drawing, and quad / polygon."]
    return text + table(["scene", "sprites", "quad", "k = 3", "4", "6", "8", "quad / 3", "/ 4", "/ 6", "/ 8"], rows), kept


def forces(run):
    count, noise = run.asked.particles[0], [{"type": "curl_noise", "strength": 1.5, "frequency": 1.7}]
    kinds = {"no force": ((), "corrected"), "curl noise": (noise, "corrected"), "no force, exact": ((), "exact"),
             "curl noise, exact": (noise, "exact")}
    kept = {name: run.bench(run.shower(count, of_it), count, ["fuse=split"], preset) for name, (of_it, preset) in kinds.items()}
    rows = [[name, ms(of(one, "move")), ms(of(one, "simulation")), ms(one["frame"][1]),
             ratio(one["frame"][1], kept[name.removesuffix(", exact")]["frame"][1])] for name, one in kept.items()]
    return ["", f"## Forces and arithmetic, {count:,} particles, 40 bytes"] + table(
        ["", "move", "simulate", "frame", "/ plain"], rows), kept


def alive_scene(run, name, uv=None):
    """A shipped scene with as many alive as asked for."""
    scene, count = run.shipped(name), run.asked.alive
    for emitter in scene["emitters"]:
        life = sum(emitter["lifetime"]) / 2
        emitter.update(rate=count / life / len(scene["emitters"]), capacity=count, bursts=[])
        emitter.update({"uv": uv} if uv else {})
        for stage, graph in emitter.get("graphs", {}).items():
            if isinstance(graph, str):
                emitter["graphs"][stage] = str((run.asked.scenes / graph).resolve())
    return run.kept(f"{name}_{run.asked.alive}{'_' + uv if uv else ''}", scene)


def is_named(row, name):
    return row == name or row.startswith(name + " ")


def known_hashes(run):
    """Of each row that ran to its end on both sides."""
    rows = re.findall(r"^\| (.+?) \| (\d+) \| AGREE \| `(\w+)` \|$", run.asked.known.read_text(), re.M)
    return {name: kept for name, frames, kept in rows if int(frames) == run.asked.hash_frames}


def hash_jobs(run):
    """Name, scene and settings: of every layout one before any has two."""
    jobs = []
    for layout in reversed(run.asked.layouts):
        jobs += [(f"fountain {layout}", alive_scene(run, "fountain"), [f"layout={layout}"]),
                 (f"fire {layout}", alive_scene(run, "fire"), [f"layout={layout}"]),
                 (f"embers {layout}", alive_scene(run, "embers"), [f"layout={layout}", "fuse=split"]),
                 (f"index_lists {layout}", alive_scene(run, "index_lists"), [f"layout={layout}"])]
    for uv in ("distance", "stretched", "segment"):
        jobs += [(f"ribbon_loop {uv} {layout}", alive_scene(run, "ribbon_loop", uv), [f"layout={layout}"])
                 for layout in reversed(run.asked.layouts)]
    jobs += [("sorted_ribbon 112", alive_scene(run, "sorted_ribbon"), []),
             ("fountain atomic 40", alive_scene(run, "fountain"), ["compaction=atomic"]),
             ("graphs 40", alive_scene(run, "graphs"), [])]
    asked = run.asked.hashes
    if asked is not None:
        unknown = [name for name in asked if not any(is_named(job[0], name) for job in jobs)]
        if unknown:
            raise RuntimeError(f"--hashes: none is named {unknown[0]}; there are {', '.join(job[0] for job in jobs)}")
        jobs = [job for job in jobs if any(is_named(job[0], name) for name in asked)]
    if run.asked.known:
        known = known_hashes(run)
        jobs = [job for job in jobs if job[0] in known]
        if not jobs:
            raise RuntimeError(f"--known {run.asked.known}: has no hash of these rows after {run.asked.hash_frames} frames")
    by_scene = {}
    for job in jobs:
        by_scene.setdefault(job[0].rsplit(" ", 1)[0], []).append(job)
    turns = max(map(len, by_scene.values()))
    return [of_scene[turn] for turn in range(turns) for of_scene in by_scene.values() if turn < len(of_scene)]


def hashed(run, jobs):
    """Runs jobs side by side; ends what still runs when the time is up. Of each its report."""
    asked, waiting, running, reports = run.asked, list(jobs), {}, {}
    end = time.monotonic() + asked.seconds
    kept = asked.out / "hashes"
    kept.mkdir(exist_ok=True)
    while waiting or running:
        over = time.monotonic() > end
        while waiting and not over and len(running) < asked.jobs:
            name, scene, settings = waiting.pop(0)
            how = ["hash", scene, "--side", "gpu"] if asked.known else ["check", scene, "--mode", "free", "--no-render"]
            words = [asked.lockstep, *how, "--preset", "exact", "--frames", asked.hash_frames, "--gl", asked.gl, "--threads",
                     asked.threads, *(w for s in settings for w in ("--set", s))]
            print("+", *words, file=sys.stderr, flush=True)
            running[name] = subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if over:
            for process in running.values():
                process.send_signal(signal.SIGINT)
        for name, process in list(running.items()):
            if over or process.poll() is not None:
                reports[name] = process.communicate()[0]
                (kept / f"{name}.txt").write_text(reports[name])
                del running[name]
        waiting = [] if over else waiting
        time.sleep(0.1)
    return reports


def held_against(run, report, right):
    """As a check would tell it."""
    found = re.fullmatch(rf"{run.asked.hash_frames - 1} (\w+)", report.strip().splitlines()[-1] if report.strip() else "")
    if not found:
        return report or "verdict ended before its last frame"
    return f"verdict {'AGREE' if found[1] == right else 'DIFFERS'}: the hash that is known\nhash {found[1]}"


def hashes(run):
    jobs = hash_jobs(run)
    known = known_hashes(run) if run.asked.known else {}
    reports, rows, kept = hashed(run, jobs), [], {}
    for name, _, settings in jobs:
        report = reports.get(name, "")
        if name in known and name in reports:
            report = held_against(run, report, known[name])
        lines = dict(line.split(None, 1) for line in report.splitlines() if len(line.split(None, 1)) == 2)
        ended = re.search(r"interrupted after (\d+) of", report)
        verdict = lines.get("verdict", report.strip().splitlines()[-1] if report.strip() else "was not begun")
        kept[name] = {"settings": settings, "verdict": verdict, "hash": lines.get("hash"),
                      "frames": int(ended.group(1)) if ended else asked_frames(run, verdict)}
        rows.append([name, kept[name]["frames"], verdict.split(":")[0], f"`{lines['hash'].split()[0]}`" if "hash" in lines else "-"])
    how = "hash --side gpu" if run.asked.known else "check --mode free"
    text = ["", f"## {'GL alone' if run.asked.known else 'Both sides run free'}, preset exact", "",
            f"{run.asked.alive:,} alive in the mean once the oldest die; `lockstep {how} --preset exact --frames "
            f"{run.asked.hash_frames}`,", f"ended after {run.asked.seconds:g} s in all, {run.asked.jobs} at once."]
    return text + table(["scene, layout", "frames", "verdict", "hash after the last"], rows), kept


def asked_frames(run, verdict):
    return run.asked.hash_frames if verdict.startswith(("AGREE", "LEGAL", "DIFFERS")) else 0


def commit_of(asked):
    if asked.commit:
        return asked.commit
    try:
        done = subprocess.run(["git", "describe", "--always", "--dirty", "--abbrev=7"], cwd=ROOT, capture_output=True, text=True)
    except FileNotFoundError:
        return "an unknown commit"
    return done.stdout.strip() or "an unknown commit"


def main():
    asked = options()
    run = Run(asked)
    parts = {"ladder": ladder, "management": management, "ribbons": ribbons, "polygon": polygon, "forces": forces,
             "hashes": hashes}
    text, kept, seconds, failed = [], {}, {}, False
    for part in asked.parts.split(","):
        begun = time.monotonic()
        try:
            lines, kept[part] = parts[part](run)
        except RuntimeError as error:
            failed, lines = True, ["", f"## {part}: not run to the end", "", f"    {str(error).strip()}"]
        seconds[part] = round(time.monotonic() - begun)
        text += lines
        took = ", ".join(f"{name} {n} s" for name, n in seconds.items())
        head = ["# Lifecycle", "", f"{run.gl or asked.gl}, at {commit_of(asked)}; {asked.frames} frames after {WARM_UP}; {took}.",
                "Medians by the GPU's clock.", "",
                f"    {' '.join(['scripts/lifecycle_tables.py LOCKSTEP OUT', *sys.argv[3:]])}", ""]
        page = re.sub(r"\n{3,}", "\n\n", "\n".join(head + text)).rstrip() + "\n"
        (asked.out / "lifecycle_tables.md").write_text(page)
        (asked.out / "lifecycle_tables.json").write_text(
            json.dumps({"gl": run.gl, "commit": commit_of(asked), "seconds": seconds, **kept}, indent=1) + "\n")
    print(page, end="")
    wrong = [name for name, one in kept.get("hashes", {}).items() if not one["verdict"].startswith(("AGREE", "was not begun"))]
    sys.exit(2 if failed else 1 if wrong else 0)


main()
