#!/usr/bin/env python3
"""Holds what README.md and docs/*.md name: every page, picture and file of the tree is there, and every page is named by
another one.
Usage: tests/docs/links_test.py"""
import re
import sys

from page_text import pages, root, split

folders = ("crosscheck", "data", "docs", "gpu", "reference", "scripts", "shaders", "tests")
# Files that a page makes up as an example: their folder is there. NAME stands for any name.
made_up = re.compile(r"haze_pass|shaders/wall\.glsl")
# Files of somebody's project.
elsewhere = re.compile(r"mine/|build/|include/lockstep/|~|sparks/")
# What a build or a download makes.
made_later = re.compile(r"data/meshes")


source_endings = r"\.(?:cpp|hpp|sh|py|mjs|cmake|vert|frag|geom|comp|glsl|md)$"


def tree_files():
    """Every file of these folders, behind a /."""
    return [
        "/" + path.relative_to(root).as_posix()
        for folder in folders
        for path in (root / folder).rglob("*")
        if "node_modules" not in path.parts
    ]


def is_there(name):
    if made_later.search(name):
        return True
    if made_up.search(name):
        name = name.rsplit("/", 1)[0]
    name = re.sub(r"\{[^}]*\}|[A-Z]{4,}", "*", name)
    if any(root.glob(name)):
        return True
    # A pair of files goes by its name without an ending.
    return not re.search(r"\.\w+$", name) and any(root.glob(name + ".*"))


def main():
    problems = []
    named = {}
    files = tree_files()
    for page in pages():
        name = page.relative_to(root).as_posix()
        blocks, rest = split(page.read_text(encoding="utf-8"))
        for found in re.finditer(r"`([^`\n]+)`", rest):
            line = rest.count("\n", 0, found.start()) + 1
            for word in found[1].split():
                word = word.strip(",;:()'\"").split(":")[0].rstrip("/")
                if word.split("/")[0] not in folders or "/" not in word:
                    # A path from within a folder: `report/row_text.hpp`.
                    inner = "/" in word and re.fullmatch(r"[\w./-]+", word) and re.search(source_endings, word)
                    if inner and not any(file.endswith("/" + word) for file in files) and not elsewhere.match(word):
                        problems.append(f"{name}:{line}: `{word}` is not there")
                    continue
                if word.startswith("docs/"):
                    named.setdefault(word, set()).add(name)
                if not is_there(word):
                    problems.append(f"{name}:{line}: `{word}` is not there")
        for found in re.finditer(r"\]\(([^)#]+)\)", rest):
            line = rest.count("\n", 0, found.start()) + 1
            if "://" not in found[1] and re.fullmatch(r"[\w./-]+", found[1]) and not (page.parent / found[1]).exists():
                problems.append(f"{name}:{line}: the link {found[1]} leads nowhere")
    for page in pages()[1:]:
        name = page.relative_to(root).as_posix()
        if not named.get(name, set()) - {name}:
            problems.append(f"{name}: no other page names it")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


sys.exit(main())
