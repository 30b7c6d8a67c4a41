"""clang-tidy, by the rules of .clang-tidy, in the forms that are quick enough to be used.

    lint.py --build build/release                     the headers of every folder
    lint.py --build build/release core model          of these
    lint.py --build build/release --changed [BASE]    sources and headers that differ from BASE (main)
    lint.py --build build/release --all               every source: 12 s each

Nine tenths of what a source costs are the headers it includes. So the headers of a folder are
looked at together, in one file that includes them all: seconds, where its sources take minutes.
"""
import argparse
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = re.search(r"set\(BALLBOT_FOLDERS([^)]*)\)", (ROOT / "CMakeLists.txt").read_text())[1].split()
# What is compiled for one version of an interface, or from the build folder.
APART = re.compile(r"^fmi/(fmi[23]_|exports)|^messages/frame_fields\.hpp$")


def tracked(*patterns):
    done = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    return [line for line in done.stdout.splitlines() if not APART.match(line)]


def changed(base):
    command = ["git", "diff", "--name-only", "--diff-filter=d", base, "--", "*.cpp", "*.hpp"]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True)
    names = [name for name in done.stdout.splitlines() if name.split("/")[0] in FOLDERS]
    return [n for n in names if n.endswith(".cpp")], [n for n in names if n.endswith(".hpp") and not APART.match(n)]


class Commands:
    """How the build compiles: the options of a source, or of a folder's sources."""

    def __init__(self, build):
        path = build / "compile_commands.json"
        if not path.is_file():
            sys.exit(f"{path}: there is none; ./bootstrap lint configures a build folder that has one")
        self.by_name = {}
        for entry in json.loads(path.read_text()):
            name = os.path.relpath(entry["file"], ROOT)
            self.by_name[name] = entry

    def options(self, entry):
        words = shlex.split(entry["command"])
        while not re.search(r"(\+\+|cc)$", words[0]):  # ccache in front
            words.pop(0)
        end = words.index("-o")
        return [w for w in words[1:end] if not w.startswith("-W")], entry["directory"]

    def of(self, name):
        if name in self.by_name:
            return self.options(self.by_name[name])
        folder = name.split("/")[0]  # compiled together with others, or a header
        for other, entry in self.by_name.items():
            if other.startswith(folder + "/") or f"/{folder}/CMakeFiles/" in entry["file"]:
                return self.options(entry)
        return None


def look(name, path, commands):
    """-> what clang-tidy says of a file that is compiled as `name` is."""
    found = commands.of(name)
    if found is None:
        return ""
    options, directory = found
    command = ["clang-tidy", "--quiet", f"--config-file={ROOT / '.clang-tidy'}", str(path), "--", *options,
               "-include", str(Path(__file__).resolve().parent / "gcc_builtins.hpp")]
    done = subprocess.run(command, cwd=directory, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said = done.stdout.replace(str(ROOT) + "/", "")
    return said if "warning:" in said or "error:" in said else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", metavar="FOLDER")
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--changed", nargs="?", const="main", metavar="BASE")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    for folder in arguments.folders:
        if folder not in FOLDERS:
            parser.error(f"'{folder}' is not one of {', '.join(FOLDERS)}")

    commands, sources = Commands(arguments.build.resolve()), []
    if arguments.changed:
        sources, headers = changed(arguments.changed)
    elif arguments.all:
        sources, headers = tracked(*[f"{f}/*.cpp" for f in FOLDERS]), []
    else:
        headers = tracked(*[f"{f}/*.hpp" for f in arguments.folders or FOLDERS])

    with tempfile.TemporaryDirectory(prefix="ballbot-lint-") as scratch:
        work = [(name, ROOT / name) for name in sources]
        for folder in FOLDERS:
            inside = [h for h in headers if h.startswith(folder + "/")]
            if inside:
                together = Path(scratch) / f"headers_of_{folder}.cpp"
                together.write_text("".join(f'#include "{h}"\n' for h in inside))
                work.append((f"{folder}/all_headers", together))
        with ThreadPoolExecutor(arguments.jobs) as pool:
            said = list(pool.map(lambda w: look(*w, commands), work))
    # A header is seen from several files: each finding once.
    findings = sorted({line for text in said for line in text.splitlines() if re.search(r": (warning|error): ", line)})
    if findings:
        sys.exit("\n".join(findings))
    print(f"{len(sources)} sources and {len(headers)} headers looked at")


if __name__ == "__main__":
    main()
