#!/usr/bin/env python3
"""Gathers every sentence that the program can print, from the string literals of its sources, and holds the words that are
not used in them (plain English).
Usage: scripts/sentences.py          prints every sentence, by file
       scripts/sentences.py --check  fails where a sentence has such a word"""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
folders = ["crosscheck", "gpu", "reference"]

# What is not said, and what is said instead.
instead = {
    r"\b(tells?|told|telling)\b": "reports, says",
    r"\bround (it|them|the|its|this|that|texel)\b|\bwraps? round\b": "around",
    r"\b(is|are) to (be|write)\b": "must",
    r"^(only )?(who|nobody|everyone)\b": "the particle, grain or light that is meant",
    r"\butili[sz]e": "use",
    r"\bplease\b": "no please: say what would be right",
    r"\binvalid\b": "what it is, and what would be right",
    r"\bunexpected error\b": "what went wrong",
    # A line of help stands alone.
    r"^judge it\b": "judge the last rendered frame",
    r"\bKth of N\b": "part K of N",
    r"\bopens in any browser\b": "self-contained",
    r"^begin something\b": "create a project skeleton",
}

token = re.compile(
    r'//[^\n]*|/\*.*?\*/|#\s*(?:include|error|pragma)[^\n]*|'
    r'(?:u8|u|U|L)?R"(?P<mark>[^()\s]*)\((?P<raw>.*?)\)(?P=mark)"|"(?P<text>(?:\\.|[^"\\\n])*)"|'
    r"'(?:\\.|[^'\\\n])+'|(?P<space>\s+)|(?P<other>.)",
    re.S,
)


def literals(source):
    """Each literal, those beside each other as one."""
    current = None
    for found in token.finditer(source):
        text = found["raw"] if found["raw"] is not None else found["text"]
        if text is not None:
            current = (current or "") + text
        elif found["other"] is not None and current is not None:
            yield current
            current = None
    if current is not None:
        yield current


def is_sentence(text):
    """Two words at least, of which one is no placeholder."""
    plain = re.sub(r"\{[^{}]*\}|\\.", " ", text)
    return len(re.findall(r"[A-Za-z]{2,}", plain)) >= 2 and " " in text.strip()


def gather():
    files = []
    for folder in folders:
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            if "node_modules" in path.parts:
                continue
            sentences = []
            for text in literals(path.read_text(encoding="utf-8")):
                line = text.replace("\\n", "\n").replace('\\"', '"').replace("\\\\", "\\").strip()
                if is_sentence(line) and line not in sentences:
                    sentences.append(line)
            if sentences:
                files.append((path.relative_to(root).as_posix(), sentences))
    return files


def shown(files):
    text = ""
    for name, sentences in files:
        text += f"{name}\n" + "".join("    " + s.replace("\n", "\n      ") + "\n" for s in sentences) + "\n"
    return text


def main():
    files = gather()
    if sys.argv[1:] == []:
        print(shown(files), end="")
        return 0
    if sys.argv[1:] != ["--check"]:
        print(__doc__, file=sys.stderr)
        return 2
    problems = [
        f"{name}: \"{sentence}\": {word} is not said; use: {right}"
        for name, sentences in files
        for sentence in sentences
        for word, right in instead.items()
        if re.search(word, sentence, re.I)
    ]
    for problem in problems:
        print(problem)
    return 1 if problems else 0


sys.exit(main())
