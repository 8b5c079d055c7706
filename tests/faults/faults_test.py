"""faults_test.py FLYBALL SHIM SOURCES: the n-th call to the system fails, for each n until none is left.

Whatever fails: flyball says which file and why, with status 5; under each final name stands the whole old
content or the whole new one; nothing else is left. Interrupted calls and short writes are no failures."""
import errno
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FLYBALL, SHIM, SOURCES = sys.argv[1:]
if " " in SHIM:  # LD_PRELOAD is cut at blanks
    SHIM = shutil.copy(SHIM, tempfile.mkdtemp(prefix="flyball-shim-"))
ARC = (Path(SOURCES) / "models/line_arc/arc_error_loop.toml").read_bytes()
SHORT_WRITE = 0

# What fails, with which errors.
FAULTS = {
    "open": [errno.ENOSPC, errno.EIO, errno.EINTR],
    "read": [errno.EIO, errno.EINTR],
    "write": [errno.ENOSPC, errno.EIO, errno.EINTR, SHORT_WRITE],
    "fsync": [errno.ENOSPC, errno.EIO, errno.EINTR],
    "rename": [errno.ENOSPC, errno.EIO, errno.EINTR],
    "close": [errno.EIO, errno.EINTR],
    "unlink": [errno.EIO],
    "mkdir": [errno.ENOSPC, errno.EIO],
}
# Their failure need not matter: a file that was read is closed, a part is removed.
MAY_BE_IGNORED = {"close", "unlink"}

# Stand-ins, so that thousands of runs take seconds. They leave what the real ones would.
DRAW = r"""case $part in
*png*) printf 'IEND\256B`\202' ;;
*) echo '<svg></svg>' ;;
esac >"$part"
"""
GNUPLOT = "#!/bin/sh\npart=${2##*figure = \\'}; part=${part%\\'}\n" + DRAW
DOT = "#!/bin/sh\npart=$3\n" + DRAW

# Name, arguments, files before, and how far apart the failing calls are once the first ten have failed.
CASES = [
    ("run", ["run", "m.toml", "--output", "r.csv", "--stop", "0.1", "--log-interval", "0.05"],
     {"m.toml": ARC} | {f"r.{ending}": b"old\n" for ending in ("csv", "json", "gp", "svg", "png")}, 1),
    ("format", ["format", "m.toml"], {"m.toml": ARC.replace(b" = ", b"=")}, 1),
    ("graph", ["graph", "m.toml", "-o", "g.svg"], {"m.toml": ARC, "g.svg": b"old\n"}, 1),
    ("blocks", ["blocks", "--markdown", "pages"], {}, 29),
]


class Folder:
    """A folder that is watched by the shim, and beside it what is not."""

    def __init__(self, root):
        self.root, self.path = root, root / "watched"
        self.programs, self.report = root / "programs", root / "report"
        self.programs.mkdir()
        for name, text in (("gnuplot", GNUPLOT), ("dot", DOT)):
            (self.programs / name).write_text(text)
            (self.programs / name).chmod(0o755)

    def fill(self, files):
        shutil.rmtree(self.path, ignore_errors=True)
        self.report.unlink(missing_ok=True)
        self.path.mkdir()
        for name, content in files.items():
            (self.path / name).write_bytes(content)

    def content(self):
        # What is printed tells of the time that it took.
        files = (path for path in self.path.rglob("*") if path.is_file() and path != self.path / "out")
        return {str(path.relative_to(self.path)): path.read_bytes() for path in files}

    def run(self, arguments, fault):
        path = f"{self.programs}:{os.environ['PATH']}"
        environment = os.environ | {"PATH": path, "LD_PRELOAD": SHIM, "FAULT_FOLDER": str(self.path),
                                    "FAULT_REPORT": str(self.report)} | fault
        # Standard output is below the folder as well: printing fails, too. What is said of it is seen.
        with open(self.path / "out", "wb") as out:
            return subprocess.run([FLYBALL, *arguments], cwd=self.path, env=environment, stdin=subprocess.DEVNULL,
                                  stdout=out, stderr=subprocess.PIPE, text=True, timeout=60)


def problems(result, fault, before, after, whole):
    call, number = fault["FAULT_CALL"], int(fault["FAULT_ERRNO"])
    if number in (errno.EINTR, SHORT_WRITE):
        expected = [0]
    else:
        expected = [0, 5] if call in MAY_BE_IGNORED else [5]
    if result.returncode not in expected:
        yield f"status {result.returncode}"
    missing = [name for name in whole if after.get(name) != whole[name]]
    if result.returncode == 0 and missing:
        yield f"success, and not all is there: {missing}"
    if result.returncode == 5:
        names = [*whole, *before, "pages", "standard output"]
        if not any(name in result.stderr for name in names) or os.strerror(number) not in result.stderr:
            yield "no file or no reason is named"
    for name, content in after.items():
        if name.endswith(".part"):
            if call != "unlink" and not (call == "open" and fault["FAULT_MODE"] == "ever"):
                yield f"{name} was left"
        elif content not in (before.get(name), whole.get(name)):
            yield f"{name} is neither the old nor the new one"
    yield from (f"{name} is gone" for name in before if name not in after)


def check_call(folder, case, call, number, mode):
    """Gives the number of runs in which a call failed, and of those in which something was wrong."""
    name, arguments, before, stride = case
    folder.fill(before)
    folder.run(arguments, {})
    whole = folder.content()
    runs = failures = 0
    at = 1
    while True:
        fault = {"FAULT_CALL": call, "FAULT_AT": str(at), "FAULT_ERRNO": str(number), "FAULT_MODE": mode}
        folder.fill(before)
        result = folder.run(arguments, fault)
        if not folder.report.exists():
            return runs, failures
        found = list(problems(result, fault, before, folder.content(), whole))
        runs += 1
        failures += bool(found)
        if found:
            print(f"FAILED: {name}, {call} {at} {mode}, {errno.errorcode.get(number, 'short')}: {'; '.join(found)}")
            print(result.stderr, end="")
        at += 1 if at < 10 else stride


def require_preload(folder):
    folder.fill({})
    result = folder.run(["--version"], {})
    if "runtime does not come first" in result.stderr or "ThreadSanitizer" in result.stderr:
        print("skipped: a sanitizer wants to be the first library that is loaded")
        sys.exit(77)
    if result.returncode != 0:
        sys.exit(f"flyball does not start with the shim: {result.stderr}")


def main():
    total = failed = 0
    with tempfile.TemporaryDirectory() as root:
        folder = Folder(Path(root))
        require_preload(folder)
        for case in CASES:
            runs = 0
            for call, numbers in FAULTS.items():
                for number in numbers:
                    # A signal does not come again for ever.
                    for mode in ("once",) if number == errno.EINTR else ("once", "ever"):
                        hit, wrong = check_call(folder, case, call, number, mode)
                        runs += hit
                        failed += wrong
            print(f"{case[0]}: {runs} runs in which a call failed")
            if runs < 20:
                sys.exit("the shim does not reach the calls")
            total += runs
    print(f"{total} runs, {failed} of them wrong")
    return failed > 0


sys.exit(main())
