"""What a page of the documentation says to the tests: its commands, the marks beside them, and the
blocks that a program writes. README.md in this folder has the rules."""
import re
import shlex
from dataclasses import dataclass, field
from pathlib import Path

SHELL = "sh"
OURS = re.compile(r"(ballbot|ballbot_benchmarks|build/release/bin/\S+|\./bootstrap)( |$)")
MARK = re.compile(r"<!-- test (skip|first|add|together|stop|exits)\b ?(.*) -->$")


class PageError(Exception):
    """Something in a page that breaks the rules; says where."""


@dataclass
class Block:
    """One fenced block of commands and the marks in the lines before it."""

    place: str
    commands: list = field(default_factory=list)
    marks: list = field(default_factory=list)  # (verb, quoted beginning of commands or "", rest)

    def mark(self, verb, command):
        """The rest of the mark `verb` that is for this command, or None."""
        for known, beginning, rest in self.marks:
            if known == verb and command.startswith(beginning):
                return rest
        return None


@dataclass
class Generated:
    """A block that a command writes: lines first to last of the page, marks not counted."""

    place: str
    command: str
    on_request: bool
    first: int
    last: int


class Page:
    def __init__(self, path):
        self.path = Path(path)
        self.lines = self.path.read_text().splitlines()
        self.blocks, self.generated, self.spans = [], [], []
        self._read()

    def _read(self):
        marks, fence, block, opened = [], None, None, None
        for number, line in enumerate(self.lines):
            place = f"{self.path}:{number + 1}"
            if line.startswith("```"):
                if fence is None:
                    fence = line[3:].strip()
                    block = Block(place, [], marks) if fence == SHELL else None
                    if marks and not block:
                        raise PageError(f"{place}: a mark for tests stands before no block of commands")
                    marks = []
                else:
                    if block:
                        block.commands = joined(block.commands)
                        self.blocks.append(block)
                    fence = block = None
            elif block:
                block.commands.append(line)
            elif outsideCommand(fence, line):
                raise PageError(f"{place}: a command outside a block of commands. Begin the block with ```{SHELL}")
            elif fence is None:
                opened = self._outside(place, number, line, marks, opened)
        if marks:
            raise PageError(f"{self.path}: a mark for tests at the end stands before no block of commands")
        if opened:
            raise PageError(f"{opened.place}: a generated block without <!-- end -->")

    def _outside(self, place, number, line, marks, opened):
        if match := MARK.match(line):
            marks.append(readMark(place, *match.groups()))
        elif line.startswith("<!-- test"):
            raise PageError(f"{place}: not a mark for tests: {line}. tests/docs/README.md has them")
        elif match := re.match(r"<!-- generated( on request)?: (.*) -->$", line):
            return Generated(place, match[2], bool(match[1]), number + 1, -1)
        elif line == "<!-- end -->" and opened:
            opened.last = number
            self.generated.append(opened)
            return None
        elif not opened:
            self.spans += [(place, span) for span in re.findall(r"`([^`]+)`", line)]
        return opened


def outsideCommand(fence, line):
    """Is this a command in a block that is not said to have commands, fenced or indented?"""
    if fence == "":
        return bool(OURS.match(line))
    return fence is None and line.startswith("    ") and bool(OURS.match(line.strip()))


def readMark(place, verb, rest):
    """-> (verb, beginning of the commands it is for, rest), of e.g. `skip "ballbot hil": hardware`."""
    match = re.match(r'(?:"([^"]*)")?:? ?(.*)$', rest)
    beginning, rest = match[1] or "", match[2]
    if verb in ("skip", "first", "add", "stop", "exits") and not rest:
        raise PageError(f"{place}: the mark '{verb}' says nothing after its colon")
    return verb, beginning, rest


def joined(lines):
    """One command a line: comments and empty lines dropped, continued lines joined."""
    commands, begun = [], ""
    for line in lines:
        line = begun + line.strip()
        if line.endswith("\\"):
            begun = line[:-1]
            continue
        begun = ""
        if shlex.split(line, comments=True):
            commands.append(line)
    return commands
