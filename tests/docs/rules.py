"""How the commands of README.md and docs/ are run in a test: which with less, which with another exit status than 0, and
which not, each with its reason."""
import dataclasses
import functools
import re
import subprocess


@dataclasses.dataclass
class Rule:
    """Of the commands of a page that begin so."""

    begin: str
    smaller: str = ""  # options that take the place of the page's, or are added: a run of seconds
    status: int | None = None  # None: 1 where the page says DIVERGENT behind it, else 0
    only_looked_up: str = ""  # why it is not run: its verb and options are looked up
    shows: bool = False  # the block behind it is its output


planted = (
    "mkdir -p mine && sed 's/ && len < particle_min_length//' shaders/collision/collision_pass.vert > mine/collision_pass.vert"
)

# Run before a page's first command: what the page takes for granted.
recorded = "lockstep record data/scenes/lattice.json --gl osmesa --particles 50 --frames 200 -o run.h5"
set_up = {
    "explain": planted,
    "live_view": recorded,
    "shards": recorded,
    "traces": planted,
}

minutes = "takes minutes"
needs_page = "needs the built report page: tests/page runs it"

pages = {
    "README": [Rule("lockstep check data/scenes/x_streams.json", status=1, shows=True)],
    "catalogue": [
        Rule("lockstep study catalogue", only_looked_up=minutes),
        Rule("lockstep study cameras", "--frames 4 --every 2"),
        Rule("lockstep study data/scenes/catalogue/NAME.json", "--frames 4"),
        Rule("lockstep render", "--frame 2"),
    ],
    "dust": [
        Rule("lockstep check", "--particles 500 --frames 3"),
        Rule("lockstep explain", "--frame 4"),
        Rule("lockstep render", "--particles 500 --frame 3"),
        Rule("lockstep bench", "--counts 256 --frames 2"),
    ],
    "fluid": [
        Rule("lockstep check data/scenes/fluid/wave.json", "--particles 256 --frames 1"),
        Rule("lockstep explain", "--particles 200"),
        Rule("lockstep render", "--particles 200 --frame 0"),
    ],
    "functions": [
        Rule("lockstep function fast.glsl", only_looked_up="the page prints neither of the two shaders"),
    ],
    "graphs": [Rule("lockstep graph check data/graphs/fade.json", "--items 1000")],
    "lifecycle": [
        Rule("lockstep check data/scenes/lifecycle/embers.json", "--frames 4"),
        Rule("lockstep check data/scenes/lifecycle/fire.json", "--frames 3"),
        Rule("lockstep render", "--frame 3"),
    ],
    "lights": [
        Rule("lockstep check data/scenes/lights/hall.json", "--particles 16 --frames 1"),
        Rule("lockstep render", "--particles 16 --frame 0"),
    ],
    "own_shader": [
        Rule("lockstep check data/scenes/x_streams.json --shaders mine", "--frames 3", status=1),
        Rule("lockstep check --stress", status=1),
        Rule("lockstep check data/scenes/x_streams.json --particles", "--frames 4"),
    ],
    "remedies": [Rule("lockstep study remedies", only_looked_up=minutes)],
    "report": [
        Rule("lockstep check", only_looked_up=needs_page),
        Rule("lockstep report", only_looked_up=needs_page),
    ],
    "shards": [
        Rule("lockstep check --trace run.h5 --shard", "--shard 1/1"),
        Rule("lockstep check --trace run.h5 --threads 1", only_looked_up="in a Slurm job: tests/package/shards_test.sh runs it"),
    ],
    "thesis": [  # as printed: tests/cli/thesis_page_test.cpp
        Rule("lockstep study rest", "--frames 4 --every 2"),
        Rule("lockstep study data/", "--frames 4"),
        Rule("lockstep render", "--frame 2"),
        Rule("lockstep check", only_looked_up=needs_page),
    ],
    "thesis_tables": [Rule("lockstep study thesis", only_looked_up=minutes + "; tests/cli/study_test.cpp runs a small one")],
    "traces": [
        Rule("lockstep record", "--particles 1400 --frames 4"),
        Rule("lockstep trace 1", only_looked_up="the first line of a recording's text, not a command"),
        Rule("lockstep recording 1", only_looked_up="the first line of a recording's text, not a command"),
    ],
    "translators": [
        Rule("lockstep check", only_looked_up="its shaders are what a translator made: tests/cli/spirv_test.cpp runs some")
    ],
}

# Pages whose fenced blocks another test runs: tests/package/unit_tests_page_test.sh.
fenced_run_elsewhere = {"unit_tests"}

# First words that make a line a command. What others begin with is code or output.
run_here = {"lockstep", "mkdir", "sed", "cp", "printf", "c++", "./engine"}
run_elsewhere = {
    "grains": "tests/package/consumer_test.sh",
    "cmake": "tests/package/new_system_test, unit_tests_page_test.sh",
    "mpirun": "tests/package/shards_test.sh",
}

# What stands for something in a usage line.
placeholders = {
    "data/scenes/catalogue/NAME.json": "data/scenes/catalogue/one_sided.json",
    "SCENE": "data/scenes/stress/borders.json",
    "DIR": "out",
    "NAME=VALUE": "collision_range=0.02",
    "F": "3",
    "I": "17",
    "X,Y": "20,4",
}


def is_command(word):
    return word in run_here or word in run_elsewhere or word.startswith("scripts/")


def needs_mesh(command):
    return re.search(r"/(bunny|dragon)_", command) is not None


@functools.cache
def software_gl(program):
    """The kind of GL context that runs without a GPU, or nothing."""
    for kind in ("osmesa", "egl"):
        if subprocess.run([program, "probe", "--gl", kind], capture_output=True, check=False).returncode == 0:
            return kind
    return None


def filled_in(command):
    """With a value for each placeholder."""
    for name, value in placeholders.items():
        command = re.sub(rf"(?<![\w/.-]){name}(?![\w/.-])", value, command)
    return command


def on_this_machine(command, program):
    return re.sub(r"--gl \S+", f"--gl {software_gl(program)}", filled_in(command))


def with_values(command, options):
    """`command` with these options instead of its own, or besides."""
    words = options.split()
    for name, value in zip(words[::2], words[1::2]):
        changed, count = re.subn(rf"(?<!\S){name} \S+", f"{name} {value}", command)
        command = changed if count else f"{command} {name} {value}"
    return command
