"""Runs the commands of one page as a reader would, from top to bottom, in a folder of its own.

    run_page.py PAGE --source ROOT --bin build/release/bin
"""
import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from page import Page, PageError  # noqa: E402

PATIENCE_S = 240

# Programs that build, in the place of the real ones: what they would build is there already, and it is
# tests/bootstrap that asks whether the right thing is built.
STAND_INS = {
    "dpkg-query": "echo install ok installed",
    "cmake": "exit 0",
    "ctest": "exit 0",
    "cmake/native_simbody.sh": "pwd",
}


def prepare(folder, source, programs):
    """The project as a reader has it after a build; what a command writes stays in `folder`."""
    for name in ("bootstrap", "configs", "docs", "messages", "packages.txt", "tests"):
        (folder / name).symlink_to(source / name)
    for preset in ("release", "native"):
        (folder / "build" / preset).mkdir(parents=True)
        (folder / "build" / preset / "bin").symlink_to(programs)
        (folder / "build" / preset / "build.ninja").touch()
    for name, does in STAND_INS.items():
        stand_in = folder / name if "/" in name else folder / "stand-ins" / name
        stand_in.parent.mkdir(exist_ok=True)
        stand_in.write_text(f"#!/bin/sh\n{does}\n")
        stand_in.chmod(0o755)
    return dict(os.environ, PATH=f"{folder}/stand-ins:{programs}:{os.environ['PATH']}")


class Shell:
    def __init__(self, folder, environment):
        self.folder, self.environment = folder, environment

    def start(self, command):
        print(f"$ {command}", flush=True)
        return subprocess.Popen(["bash", "-c", command], cwd=self.folder, env=self.environment, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                start_new_session=True)


def stop(process, number=signal.SIGINT):
    os.killpg(process.pid, number)


def finish(process, place, command, output="", expected=0):
    """Waits for the end; another exit code than the page says is an error of the page."""
    try:
        output += process.communicate(timeout=PATIENCE_S)[0]
    except subprocess.TimeoutExpired:
        stop(process, signal.SIGKILL)
        output += process.communicate()[0]
        raise PageError(f"{place}: `{command}` did not end within {PATIENCE_S} s:\n{output}")
    if process.returncode != expected:
        raise PageError(f"{place}: `{command}` ends with exit code {process.returncode}, not {expected}:\n{output}")


def serveUntil(process, text, place, command):
    """Ctrl-C once `text` was printed."""
    output = ""
    for line in process.stdout:
        output += line
        if text in line:
            stop(process)
            break
    else:
        raise PageError(f"{place}: `{command}` ended without saying '{text}':\n{output}")
    finish(process, place, command, output)


def runTogether(shell, block, commands):
    """Each command in a terminal of its own; when the last has ended, the others get Ctrl-C."""
    running = []
    try:
        for command in commands:
            running.append((shell.start(command), command))
            time.sleep(float(block.mark("together", command) or 1))
        last, command = running[-1]
        finish(last, block.place, command)
        for process, command in reversed(running[:-1]):
            if process.poll() is None:
                stop(process)
            finish(process, block.place, command)
    finally:
        for process, _ in running:
            if process.poll() is None:
                stop(process, signal.SIGKILL)


def asTested(block, command):
    """The command with what its block adds to it, or None where the page says why it is not run."""
    if (reason := block.mark("skip", command)) is not None:
        print(f"# not run, {reason}: {command}")
        return None
    if "ballbot_benchmarks" in command:  # figures are not for tests; that the filter finds something is
        return f"test -n \"$({command} --benchmark_list_tests=true)\""
    extra = block.mark("add", command)
    if not extra:
        return command
    shown, *comment = re.split(r"(?=\s+# )", command, maxsplit=1)
    return f"{shown} {extra}{''.join(comment)}"


def runBlock(shell, block):
    commands = [c for c in (asTested(block, command) for command in block.commands) if c]
    for verb, _, before in block.marks:
        if verb == "first":
            finish(shell.start(before), block.place, before)
    if block.mark("together", "") is not None and commands:
        runTogether(shell, block, commands)
        return
    for command in commands:
        process = shell.start(command)
        if text := block.mark("stop", command):
            serveUntil(process, text, block.place, command)
        else:
            finish(process, block.place, command, expected=int(block.mark("exits", command) or 0))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page")
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--bin", type=Path, required=True)
    parser.add_argument("--keep", action="store_true", help="keep the folder and print its name")
    arguments = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="ballbot-docs-"))
    try:
        page = Page(arguments.source / arguments.page)
        shell = Shell(folder, prepare(folder, arguments.source.resolve(), arguments.bin.resolve()))
        for block in page.blocks:
            runBlock(shell, block)
    except PageError as error:
        sys.exit(str(error))
    finally:
        if arguments.keep:
            print(folder)
        else:
            shutil.rmtree(folder)


if __name__ == "__main__":
    main()
