#!/usr/bin/env python3
"""Runs the commands of a page of README.md and docs/ in a folder of its own, in their order, and holds their exit status.
What would take minutes or a GPU runs with less (rules.py says how, and why), or has its options looked up in the help.
Usage: tests/docs/commands_test.py PROGRAM PAGE...      PAGE: README, or a name in docs/ without .md
       tests/docs/commands_test.py PROGRAM --times      every page, with seconds a command"""
import os
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import tempfile

import rules
from page_text import Block, commands_within_lines, logical_lines, named_file, pages, root, split, without_comment

longest = 300  # seconds for one command, on a machine that has other things to do


def bash(command, folder, program, seconds=longest):
    environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}", OMP_WAIT_POLICY="passive")
    environment.pop("TEST_SHARD_INDEX", None)
    return subprocess.run(
        ["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, timeout=seconds, errors="replace"
    )


def seconds_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Page:
    def __init__(self, path, program):
        self.path, self.program = path, program
        self.name = path.relative_to(root).as_posix()
        self.rules = rules.pages.get(path.stem, [])
        self.used = set()
        self.problems = []
        self.seconds = []

    def complain(self, line, command, what):
        self.problems.append(f"{self.name}:{line}: {what}\n    {command}")

    def rule(self, command):
        for number, rule in enumerate(self.rules):
            if command.startswith(rule.begin):
                self.used.add(number)
                return rule
        return rules.Rule("")

    def run(self):
        blocks, rest = split(self.path.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory(prefix="lockstep-docs-") as folder:
            self.folder = pathlib.Path(folder)
            for name in ("data", "scripts", "docs", "tests"):
                (self.folder / name).symlink_to(root / name)
            (self.folder / "shaders").mkdir()  # pages put files of their own there
            for entry in (root / "shaders").iterdir():
                (self.folder / "shaders" / entry.name).symlink_to(entry)
            (self.folder / "bin").mkdir()
            (self.folder / "bin" / "lockstep").symlink_to(self.program)
            if set_up := rules.set_up.get(self.path.stem):
                done = bash(rules.on_this_machine(set_up, self.program), folder, self.program)
                if done.returncode != 0:
                    self.complain(1, set_up, f"its preparation ends with status {done.returncode}: {done.stderr.strip()}")
            for block in blocks:
                self.write_file(block)
            for number, block in enumerate(blocks):
                if self.path.stem in rules.fenced_run_elsewhere and block.info:
                    continue
                shown = blocks[number + 1] if number + 1 < len(blocks) else None
                self.run_block(block, shown)
            for line, command in commands_within_lines(rest):
                if not self.rule(command).only_looked_up.endswith("not a command"):
                    self.look_up(line, command)
        for number, rule in enumerate(self.rules):
            if number not in self.used:
                self.problems.append(f"tests/docs/rules.py: {self.name} has no command that begins with: {rule.begin}")

    def write_file(self, block):
        """The block that the page says is a file, wherever it says so."""
        name = named_file(block)
        first = next((text.split()[0] for _, text in logical_lines(block)), "")
        if not name or rules.is_command(first):
            return
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        if path.parent.resolve().is_relative_to(self.folder.resolve()) and not path.is_symlink():
            path.write_text(block.text.rstrip("\n") + "\n")

    def run_block(self, block, shown):
        commands = list(logical_lines(block))
        output = ""
        for line, command in commands:
            if rules.is_command(command.split()[0]):
                output = self.run_command(line, command)
        if shown is not None and any(self.rule(command).shows for _, command in commands if rules.is_command(command.split()[0])):
            self.hold_output(shown, output)

    def run_command(self, line, text):
        """Its output."""
        command = without_comment(text)
        rule = self.rule(command)
        status = rule.status if rule.status is not None else int("DIVERGENT" in text[len(command) :])
        word = command.split()[0]
        for path in re.findall(r"(?<![\w/.])(?:data|shaders|scripts|docs|tests)/[\w./-]+", rules.filled_in(command)):
            if not (self.folder / path).exists() and not path.startswith("data/meshes"):
                self.complain(line, command, f"{path} is not there")
        if word.startswith("scripts/"):
            self.look_up_script(line, command)
            return ""
        if rule.only_looked_up or word in rules.run_elsewhere:
            self.look_up(line, command)
            return ""
        if rules.needs_mesh(command) and not (root / "data" / "meshes").is_dir():
            self.look_up(line, command)
            return ""
        told = rules.on_this_machine(rules.with_values(command, rule.smaller), self.program)
        begin = seconds_of_children()
        try:
            done = bash(told, self.folder, self.program)
        except subprocess.TimeoutExpired:
            self.complain(line, told, f"takes more than {longest} s")
            return ""
        self.seconds.append((seconds_of_children() - begin, told))
        if done.returncode != status:
            end = (done.stderr.strip() or done.stdout.strip()).split("\n")[-1]
            self.complain(line, told, f"status {done.returncode}, expected {status}: {end}")
        return done.stdout

    def look_up(self, line, command):
        """That verb and options exist."""
        if "lockstep " not in command:
            return
        words = shlex.split(command[command.index("lockstep ") :], comments=False)
        verb = []
        for word in words[1:]:
            if not re.fullmatch(r"[a-z]+", word):
                break
            verb.append(word)
        while verb:
            done = bash(shlex.join(["lockstep", *verb, "--help"]), self.folder, self.program)
            if done.returncode == 0:
                break
            verb.pop()
        if not verb and words[1:] and words[1].islower() and not words[1].startswith("-"):
            return self.complain(line, command, f"there is no verb {words[1]}")
        if not verb:
            return None
        for word in words[1:]:
            option = word.split("=")[0]
            if re.fullmatch(r"--?[a-z][a-z-]*", option) and not re.search(rf"(?<![\w-]){option}(?![\w-])", done.stdout):
                self.complain(line, command, f"lockstep {' '.join(verb)} has no option {option}")
        return None

    def look_up_script(self, line, command):
        words = command.split()
        script = root / words[0]
        if not script.is_file() or not os.access(script, os.X_OK):
            return self.complain(line, command, f"{words[0]} cannot be run")
        text = script.read_text(encoding="utf-8")
        for word in words[1:]:
            if word.startswith("--") and word not in text:
                self.complain(line, command, f"{words[0]} has no option {word}")
        return None

    def hold_output(self, shown, output):
        """Each line of the block is one of the output, in this order; ... stands for any."""
        # Another driver has other numbers.
        driver = [line for line in shown.text.split("\n") if line.startswith("GL  ")]
        if driver and driver[0].rstrip() not in output:
            output = re.sub(r"(Mesa [\d.]+)-[^\s;]+", r"\1", output)  # the package's own version behind Mesa's
            output = re.sub(r"\d[\d.,]*", "0", output)
            shown = Block(shown.line, re.sub(r"\d[\d.,]*", "0", shown.text), "")
        lines = iter(output.split("\n"))
        for number, line in enumerate(shown.text.rstrip("\n").split("\n"), shown.line):
            begin = line.rstrip()
            if not begin or begin.strip() == "...":
                continue
            cut = begin.endswith(" ...")
            begin = begin.removesuffix(" ...")
            if not any(one.startswith(begin) if cut else one.rstrip() == begin for one in lines):
                self.complain(number, begin, "is not what the program prints there")
                return


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program = str(pathlib.Path(sys.argv[1]).resolve())
    times = sys.argv[2:] == ["--times"]
    chosen = pages() if times else [root / ("README.md" if name == "README" else f"docs/{name}.md") for name in sys.argv[2:]]
    if not rules.software_gl(program):
        print("skipped: no software GL")
        return 1 if os.environ.get("LOCKSTEP_REQUIRE_GL", "0") not in ("", "0") else 77
    status = 0
    for path in chosen:
        page = Page(path, program)
        page.run()
        for problem in page.problems:
            print(problem)
            status = 1
        if times:
            print(f"{sum(one for one, _ in page.seconds):6.1f} s {page.name}")
            for seconds, command in sorted(page.seconds, reverse=True)[:6]:
                print(f"    {seconds:6.1f} s {command}")
            sys.stdout.flush()
    return status


sys.exit(main())
