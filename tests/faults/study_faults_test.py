"""study_faults_test.py FLYBALL SHIM: the n-th call to the system of a study fails, for each n until none is left.

Whatever fails: flyball says which file and why, with status 5, or it did not matter and all results are there; each
result that is there is whole. The same command then ends the study with the bytes of one in which nothing failed."""
import errno
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FLYBALL, SHIM = sys.argv[1:]
if " " in SHIM:  # LD_PRELOAD is cut at blanks
    SHIM = shutil.copy(SHIM, tempfile.mkdtemp(prefix="flyball-shim-"))
MODEL = """flyball = 1
[blocks]
x = { type = "Integrator", initial = 1.0 }
k = { type = "Gain", gain = -1.0 }
[diagram]
wires = ["x -> k -> x"]
log = ["x"]
[simulation]
stop = "1 s"
"""
STUDY = """flyball = 1
[study]
model = "m.toml"
[sweep]
"k.gain" = [-1.0, -2.0, -3.0, -4.0, -5.0, -6.0]
[metrics]
last = "final(x)"
"""
FAULTS = {
    "open": [errno.ENOSPC, errno.EIO],
    "read": [errno.EIO],
    "write": [errno.ENOSPC, errno.EIO],
    "fsync": [errno.ENOSPC, errno.EIO],
    "truncate": [errno.EIO],
    "rename": [errno.ENOSPC, errno.EIO],
    "close": [errno.EIO],
    "unlink": [errno.EIO],
    "mkdir": [errno.ENOSPC],
}


class Study:
    def __init__(self, root):
        self.path, self.report = Path(root) / "watched", Path(root) / "report"

    def fill(self):
        shutil.rmtree(self.path, ignore_errors=True)
        self.report.unlink(missing_ok=True)
        self.path.mkdir()
        (self.path / "m.toml").write_text(MODEL)
        (self.path / "s.toml").write_text(STUDY)

    def run(self, fault):
        environment = os.environ | {"LD_PRELOAD": SHIM, "FAULT_FOLDER": str(self.path),
                                    "FAULT_REPORT": str(self.report)} | fault
        return subprocess.run([FLYBALL, "study", "s.toml", "--output", "out", "--quiet", "--threads", "1"],
                              cwd=self.path, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, timeout=60)

    def results(self):
        names = ("runs.csv", "summary.csv", "study.json")
        return {name: (self.path / "out" / name).read_bytes() for name in names
                if (self.path / "out" / name).exists()}


def problems(study, result, number, whole):
    if result.returncode not in (0, 5):
        yield f"status {result.returncode}"
    if result.returncode == 0 and study.results() != whole:
        yield "success, and not all is there"
    # SQLite keeps the system's reason of some failures to itself; then it names the file.
    if result.returncode == 5 and os.strerror(number) not in result.stderr and "study.sqlite: cannot" not in result.stderr:
        yield f"neither the reason nor the store is named: {result.stderr}"
    for name, content in study.results().items():
        if content != whole[name]:
            yield f"{name} is not whole"
    again = study.run({})
    if again.returncode != 0 or study.results() != whole:
        yield f"it does not go on: status {again.returncode}: {again.stderr}"


def main():
    runs = failed = 0
    with tempfile.TemporaryDirectory() as root:
        study = Study(root)
        study.fill()
        first = study.run({})
        if "runtime does not come first" in first.stderr:
            print("skipped: a sanitizer wants to be the first library that is loaded")
            return 77
        if first.returncode != 0:
            sys.exit(f"the study does not run: {first.stderr}")
        whole = study.results()
        for call, numbers in FAULTS.items():
            for number in numbers:
                for mode in ("once", "ever"):
                    at = 1
                    while True:
                        study.fill()
                        result = study.run({"FAULT_CALL": call, "FAULT_AT": str(at), "FAULT_ERRNO": str(number),
                                            "FAULT_MODE": mode})
                        if not study.report.exists():
                            break
                        found = list(problems(study, result, number, whole))
                        runs += 1
                        failed += bool(found)
                        if found:
                            print(f"FAILED: {call} {at} {mode}, {errno.errorcode[number]}: {'; '.join(found)}")
                            print(result.stderr, end="")
                        at += 1
    print(f"{runs} runs in which a call failed, {failed} of them wrong")
    return 1 if failed > 0 or runs < 50 else 0


sys.exit(main())
