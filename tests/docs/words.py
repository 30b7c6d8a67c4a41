"""Verbs and options that the pages name, wherever they stand, are those of the programs.

    words.py --source ROOT --bin build/release/bin
"""
import argparse
import re
import shlex
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from generated import pages  # noqa: E402
from page import Page  # noqa: E402

OPTION = re.compile(r"(?<![\w-])--?[a-zA-Z][\w-]*")
# Options of other programs that our pages speak of.
FOREIGN = {"--partition", "--benchmark_filter", "--help", "--version"}


def helpText(*command):
    return subprocess.run([*command, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout


def optionsByVerb(program):
    verbs = re.findall(r"^  ([a-z]+) {2,}", helpText(program).split("Subcommands:")[1], re.M)
    return {verb: set(OPTION.findall(helpText(program, verb))) | FOREIGN for verb in verbs}


def unknown(text, verbs, all_options):
    """What is wrong with `text`, a command or an option in a sentence; None if nothing is."""
    words = shlex.split(text.replace("'", ""), comments=True)
    if words[:1] == ["ballbot"] and len(words) > 1 and not words[1].startswith("-"):
        if words[1] not in verbs:
            return f"there is no verb '{words[1]}'"
        missing = set(OPTION.findall(" ".join(w for w in words[2:] if w.startswith("-")))) - verbs[words[1]]
        return f"{words[1]} knows no {', '.join(sorted(missing))}" if missing else None
    if words and words[0].startswith("--") and words[0].split("=")[0] not in all_options:
        return f"nothing knows {words[0]}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--bin", type=Path, required=True)
    arguments = parser.parse_args()
    verbs = optionsByVerb(str(arguments.bin / "ballbot"))
    bootstrap = set(OPTION.findall(helpText(str(arguments.source / "bootstrap"))))
    all_options = set().union(bootstrap, *verbs.values())
    wrong = []
    for name in pages(arguments.source):
        page = Page(arguments.source / name)
        commands = [(block.place, c) for block in page.blocks for c in block.commands]
        for place, text in page.spans + commands:
            if problem := unknown(text, verbs, all_options):
                wrong.append(f"{place}: `{text}`: {problem}")
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
