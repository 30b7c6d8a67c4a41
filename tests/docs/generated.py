"""Compares the generated blocks of the pages with what their commands print, or writes them anew.

    generated.py --source ROOT --bin build/release/bin [PAGE...]            compare; pages: default all
    generated.py --source ROOT --bin build/release/bin --write [PAGE...]    write
    ... --on-request    those too that take too long for a test
"""
import argparse
import difflib
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from page import Page  # noqa: E402
from run_page import prepare  # noqa: E402

# What differs between two runs of one program: wall-clock time, and where the project lies.
OF_THE_MACHINE = [re.compile(r"in \d+\.\d+ s, \d+\.\d+ times real time")]


def pages(source):
    return ["README.md"] + sorted(str(p.relative_to(source)) for p in (source / "docs").rglob("*.md"))


def compared(lines):
    for pattern in OF_THE_MACHINE:
        lines = [pattern.sub("(as fast as the machine is)", line) for line in lines]
    return lines


def content(old, output):
    """The new lines of a block; where the old ones stood in a fence, the new ones do. A line that is
    new in what the machine decides alone stays as it was."""
    as_before = dict(zip(compared(old), old))
    output = [as_before.get(key, line) for key, line in zip(compared(output), output)]
    if old and old[0].startswith("```"):
        return [old[0], *output, "```"]
    return output


def produce(block, arguments, folder):
    """What the block's command prints in the project's folder."""
    environment = prepare(folder, arguments.source, arguments.bin)
    done = subprocess.run(["bash", "-c", "set -o pipefail; " + block.command], cwd=folder, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{block.place}: `{block.command}` ends with exit code {done.returncode}:\n{done.stderr}")
    return [line.rstrip() for line in done.stdout.rstrip("\n").split("\n")]


def treat(name, arguments):
    """-> what differs, as lines of a diff; with --write the page is changed."""
    page = Page(arguments.source / name)
    lines, differences = list(page.lines), []
    for block in reversed(page.generated):
        if block.on_request and not arguments.on_request:
            continue
        old = page.lines[block.first:block.last]
        with tempfile.TemporaryDirectory(prefix="ballbot-docs-") as folder:
            new = content(old, produce(block, arguments, Path(folder)))
        if compared(old) != compared(new):
            differences += difflib.unified_diff(old, new, block.place, block.command, lineterm="")
            lines[block.first:block.last] = new
    if arguments.write and differences:
        page.path.write_text("\n".join(lines) + "\n")
    return differences


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*")
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--bin", type=Path, required=True)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--on-request", action="store_true")
    arguments = parser.parse_args()
    arguments.source, arguments.bin = arguments.source.resolve(), arguments.bin.resolve()
    differences = []
    for name in arguments.pages or pages(arguments.source):
        differences += treat(name, arguments)
    if differences and not arguments.write:
        sys.exit("\n".join(differences) + "\nWrite them anew: tests/docs/generated.py --write (README.md beside it)")


if __name__ == "__main__":
    main()
