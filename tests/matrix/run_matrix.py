#!/usr/bin/env python3
"""Runs every verb on every system with shaders of every verdict class and writes every output: what a report line indexes,
joins or prints is executed for each class, also for those that no shipped scene gives on llvmpipe. Cases marked all_verbs
in cases.json go through all verbs, the others through `check`. Meant for a program that
was built with sanitizers (scripts/sanitize.sh), whose reports end a run with exit status 99.

Held of each run: the exit status and the verdict that cases.json expects, no signal, no sanitizer report, an end in time,
outputs that parse.
Usage: tests/matrix/run_matrix.py PROGRAM [--short] [--only SUBSTRING] [--jobs N] [--keep DIR]
--short: of the cases marked all_verbs only those named divergent, whose reports have the most lines, go through all verbs.
Exit status: 0 all held, 1 not."""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

root = pathlib.Path(__file__).resolve().parent.parent.parent
here = pathlib.Path(__file__).resolve().parent
limit_s = 300
# What the program says of a child process that ended with a report: behind its fence that reaches no terminal.
child_fault = r"ended the process|crashed with signal|needs too much memory|did not answer within"


class Run:
    """The runs of one case, in a folder of its own."""

    def __init__(self, program, name, case, system, folder):
        self.program, self.name, self.case, self.folder = program, name, case, folder
        self.system = {**system, "options": case.get("instead", system.get("options", []))}
        self.problems, self.count = [], 0
        self.scene = self.write_scene()
        self.shaders = self.write_shaders()

    def write_scene(self):
        scene = case_scene(self.case, self.system)
        if isinstance(scene, str):
            return str(root / scene)
        path = self.folder / "scene.json"
        path.write_text(json.dumps(scene), encoding="utf-8")
        return str(path)

    def write_shaders(self):
        changes = self.case.get("changes", [])
        if not changes:
            return []
        folder = self.folder / "mine"
        folder.mkdir()
        for name, text, other in changes:
            path = folder / name
            source = path if path.exists() else shipped(self.system["shaders"], name)
            before = source.read_text(encoding="utf-8")
            if text not in before:
                self.problems.append(f"{self.name}: '{text}' is not in {name}")
            path.write_text(before.replace(text, other), encoding="utf-8")
        return ["--shaders", str(folder)]

    def program_run(self, words, statuses, typed=None):
        """The output of one run; notes a problem where its end is not one of `statuses`."""
        self.count += 1
        words = [str(word) for word in words]
        try:
            done = subprocess.run([self.program, *words], input=typed, capture_output=True, text=True, errors="replace",
                                  timeout=limit_s, cwd=self.folder)
        except subprocess.TimeoutExpired:
            self.problems.append(f"{self.name}: {' '.join(words)}: no end within {limit_s} s")
            return ""
        fault = re.search(child_fault, done.stderr)
        if done.returncode not in statuses or fault:
            kept = re.sub(r"[^A-Za-z0-9]+", "_", self.name) + ".log"
            self.problems.append(f"{self.name}: {' '.join(words)}: status {done.returncode}, expected "
                                 f"{' or '.join(map(str, statuses))}: {last_line(done.stderr)} ({kept})")
            (self.folder.parent / kept).write_text(done.stdout + done.stderr, encoding="utf-8")
        return done.stdout

    def json_file(self, name):
        try:
            return json.loads((self.folder / name).read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            self.problems.append(f"{self.name}: {name}: {error}")
            return {}

    def check(self):
        """`check` with every output, then as text alone; runs the commands that its report prints."""
        status = self.case["status"]
        common = [*self.system["options"], *self.case.get("options", []), *self.shaders]
        outputs = ["--json", "report.json", "--hashes", "hashes.txt", "--report", "page", *self.system["outputs"]]
        text = self.program_run(["check", self.scene, *common, *outputs, "--power"], [status])
        verdict = re.search(r"^verdict +(.*)$", text, re.M)
        if not verdict or not re.search(self.case["verdict"], verdict[1]):
            self.problems.append(f"{self.name}: verdict '{verdict and verdict[1]}', expected {self.case['verdict']}")
        for line in self.case.get("lines", []):
            if not re.search(line, text, re.M):
                self.problems.append(f"{self.name}: no line {line}")
        self.json_file("report.json")
        if (self.folder / "junit.xml").exists():
            xml.etree.ElementTree.parse(self.folder / "junit.xml")
        hexed = self.program_run(["check", self.scene, *common, "--hex"], [status])
        for command in printed_commands(hexed)[:4]:
            self.program_run(command, [0, 1])

    def one_item(self):
        """explain, debug and capsules of one item."""
        common = [*self.system["item_options"], *self.case.get("options", []), *self.shaders]
        for item in self.system["items"]:
            self.program_run(["explain", self.scene, *common, "--frame", self.system["frame"], *item], [0, 1, 2])
            self.program_run(["explain", self.scene, *common, "--frame", self.system["frame"], *item, "--json", "explain.json"], [0, 1, 2])
        self.program_run(["debug", self.scene, *common], [0, 1, 2], typed=self.system["debug"])
        for item in self.system["capsules"]:
            self.program_run(["capsule", "cut", self.scene, *common, "--frame", self.system["frame"], *item, "-o", "one.json"], [0, 1, 2])
            if (self.folder / "one.json").exists():
                self.program_run(["capsule", "show", "one.json"], [0, 1])

    def recorded(self):
        """The run in a file: judged as a whole, in parts that are merged, and as a page."""
        common = [*self.system["options"], *self.shaders]
        options = self.case.get("options", [])
        switches = [word for k, word in enumerate(options) if options[max(k - 1, 0)] in ("--preset", "--set") or word in ("--preset", "--set")]
        judged = [word for word in options if word not in switches]
        self.program_run(["record", self.scene, *common, *switches, "-o", "run.h5"], [0])
        if not (self.folder / "run.h5").exists():
            return
        self.program_run(["trace", "run.h5"], [0])
        self.program_run(["check", "--trace", "run.h5", *judged, "--json", "trace.json", "--report", "trace_page"], [0, 1])
        if self.system["shards"]:
            for k in (1, 2):
                self.program_run(["check", "--trace", "run.h5", *judged, "--shard", f"{k}/2", "--json", f"part{k}.json"], [0, 1])
            self.program_run(["merge", "part1.json", "part2.json"], [0, 1])
        self.program_run(["report", "run.h5", "-o", "run_page"], [0, 1, 2])

    def pictures(self):
        common = [*self.system["options"], *self.case.get("options", []), *self.shaders]
        sizes = [word for k, word in enumerate(common) if common[max(k - 1, 0)] == "--particles" or word == "--particles"]
        for side in ("cpu", "gpu"):
            shaders = self.shaders if side == "gpu" else []
            self.program_run(["render", self.scene, *sizes, *shaders, "--side", side, "--frame", "1", "-o", f"{side}.png"], [0, 2])
            self.program_run(["hash", self.scene, *sizes, *shaders, "--side", side, "--frames", "2"], [0, 2])

    def all(self, is_short):
        started = time.monotonic()
        self.check()
        if self.case.get("all_verbs") and (not is_short or self.name.endswith(" divergent")):
            for part in (self.one_item, self.recorded, self.pictures):
                part()
        return self.name, self.count, self.problems, time.monotonic() - started


def shipped(folder, name):
    own = root / "shaders" / folder / name
    return own if own.exists() else root / "shaders" / name


def case_scene(case, system):
    """The case's own scene or its system's, a path or the scene itself, with members replaced."""
    scene = case.get("scene", system["scene"])
    replaced = case.get("replaced")
    if replaced and isinstance(scene, str):
        scene = json.loads((root / scene).read_text(encoding="utf-8"))
    return {**scene, **replaced} if replaced else scene


def last_line(text):
    lines = [line for line in text.splitlines() if "ERROR" in line or "runtime error" in line] or text.splitlines()
    return lines[-1][:200] if lines else "nothing on standard error"


def printed_commands(report):
    """The `lockstep ...` commands of a report, as words."""
    return [line.split("lockstep ", 1)[1].split() for line in report.splitlines()
            if re.match(r"^(repeat|explain|capsule|\s+)\s*lockstep (check|explain|capsule|debug) ", line)
            and "debug" not in line]


def run_case(program, name, case, system, keep, is_short):
    folder = pathlib.Path(tempfile.mkdtemp(prefix="matrix_", dir=keep)) / "run"
    folder.mkdir()
    try:
        return Run(program, name, case, system, folder).all(is_short)
    finally:
        if not keep:
            shutil.rmtree(folder.parent)


def once(program, folder):
    """The verbs that run no scene of a system."""
    run = Run(program, "no system", {}, {"scene": {}, "shaders": ""}, folder)
    for words in json.loads((here / "cases.json").read_text(encoding="utf-8"))["verbs"]:
        statuses = words[0]
        run.program_run([word.replace("ROOT", str(root)) for word in words[1:]], statuses)
    return run.name, run.count, run.problems, 0.0


def main():
    options = argparse.ArgumentParser(usage=__doc__)
    options.add_argument("program")
    options.add_argument("--short", action="store_true")
    options.add_argument("--only", default="")
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--keep")
    chosen = options.parse_args()
    program = str(pathlib.Path(chosen.program).resolve())
    os.environ.update({"OMP_NUM_THREADS": "1", "LP_NUM_THREADS": "1"})
    os.environ.setdefault("ASAN_OPTIONS", "exitcode=99:detect_leaks=0:abort_on_error=0")
    os.environ.setdefault("UBSAN_OPTIONS", "print_stacktrace=1:halt_on_error=1:exitcode=99")
    if chosen.keep:
        pathlib.Path(chosen.keep).mkdir(parents=True, exist_ok=True)
    data = json.loads((here / "cases.json").read_text(encoding="utf-8"))
    work = [(f"{system} {name}", case, data["systems"][system]) for system in data["systems"]
            for name, case in data["systems"][system]["cases"].items() if chosen.only in f"{system} {name}"]
    count, problems = 0, []
    with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
        tasks = [pool.submit(run_case, program, *one, chosen.keep, chosen.short) for one in work]
        if not chosen.only:
            tasks.append(pool.submit(once, program, pathlib.Path(tempfile.mkdtemp(prefix="matrix_", dir=chosen.keep))))
        for task in concurrent.futures.as_completed(tasks):
            name, runs, found, seconds = task.result()
            count += runs
            problems += found
            print(f"{'FAILED' if found else 'held  '} {name}: {runs} runs, {seconds:.0f} s", flush=True)
            for problem in found:
                print("    " + problem, flush=True)
    print(f"{count} runs of {len(work)} cases, {len(problems)} problems")
    return 1 if problems or not count else 0


sys.exit(main())
