"""What README.md and docs/*.md are made of: paragraphs, blocks of code, commands in them and commands within a line."""
import dataclasses
import pathlib
import re

root = pathlib.Path(__file__).resolve().parent.parent.parent


def pages():
    """README.md and every page of docs/, by name."""
    return [root / "README.md", *sorted((root / "docs").glob("*.md"))]


@dataclasses.dataclass
class Block:
    """A block of code: fenced, or indented by four spaces or more behind an empty line."""

    line: int  # of its first line, from 1
    text: str
    before: str  # the paragraph above it
    info: str = ""  # the words behind the fence


def split(text):
    """The page's blocks, and its text with the blocks left out, lines kept."""
    blocks, rest = [], []
    paragraph, fence, current = [], None, None
    for number, line in enumerate(text.split("\n"), 1):
        if fence is not None:
            rest.append("")
            if line.strip() == fence:
                blocks.append(current)
                fence, current, paragraph = None, None, []
            else:
                current.text += line + "\n"
            continue
        if line.lstrip().startswith("```"):
            fence = "```"
            current = Block(number + 1, "", " ".join(paragraph), line.strip().strip("`").strip())
            rest.append("")
            continue
        is_code = line.startswith("    ") and (current is not None or not rest or rest[-1].strip() == "")
        if is_code or (current is not None and not line.strip()):
            if current is None:
                current = Block(number, "", " ".join(paragraph))
            current.text += line[4:] + "\n"
            rest.append("")
            continue
        if current is not None:
            blocks.append(current)
            current, paragraph = None, []
        if line.strip():
            paragraph = [*paragraph, line.strip()] if rest and rest[-1].strip() else [line.strip()]
        rest.append(line)
    if current is not None:
        blocks.append(current)
    return blocks, "\n".join(rest)


def logical_lines(block):
    """Number and text of each line, lines that end with a backslash joined with the next."""
    joined = ""
    for number, line in enumerate(block.text.split("\n"), block.line):
        if line.endswith("\\"):
            joined += line[:-1].strip() + " "
            continue
        if (joined + line).strip():
            yield number, (joined + line.strip()).strip()
        joined = ""


def without_comment(command):
    """A comment begins with # behind white space."""
    return re.sub(r"\s+#\s.*$", "", command)


def commands_within_lines(rest):
    """Number and text of each command in single back quotes."""
    for found in re.finditer(r"`(lockstep [^`]+)`", rest):
        yield rest.count("\n", 0, found.start()) + 1, re.sub(r"\s+", " ", found[1]).replace("\\|", "|")


def named_file(block):
    """The file that the paragraph above says a block is, or none: "`walls.csv`:"."""
    if not block.before.endswith(":"):
        return None
    last = re.split(r"(?<=[.;])\s", block.before)[-1]
    names = re.findall(r"`([\w/.-]+\.(?:glsl|vert|frag|comp|csv|json|txt))`", last)
    return names[-1] if names else None
