"""memory_test.py FLYBALL: a study of 100 000 runs takes as much memory as one of 2 000."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

FLYBALL = sys.argv[1]
MODEL = """flyball = 1
[blocks]
x = { type = "Integrator", initial = 1.0 }
k = { type = "Gain", gain = -1.0 }
[diagram]
wires = ["x -> k -> x"]
log = ["x"]
[simulation]
stop = "1 s"
log_interval = "0.1 s"
solver = { method = "rk4", step = "0.1 s" }
"""
STUDY = """flyball = 1
[study]
model = "m.toml"
[sweep]
"k.gain" = {{ from = -1.0, to = -2.0, points = {points} }}
x.initial = {{ from = 1.0, to = 2.0, points = 100 }}
[metrics]
last = "final(x)"
largest = "max(abs(x))"
"""


def peak(points):
    """The largest resident size of the process [kB]."""
    Path("s.toml").write_text(STUDY.format(points=points))
    child = subprocess.Popen([FLYBALL, "study", "s.toml", "--output", f"r{points}", "--quiet", "--threads", "2"])
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"status {status}")
    rows = sum(1 for _ in open(f"r{points}/runs.csv")) - 1
    if rows != 100 * points:
        sys.exit(f"{rows} rows of {100 * points}")
    return usage.ru_maxrss


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    Path("m.toml").write_text(MODEL)
    few, many = peak(20), peak(1000)
    print(f"{few} kB for 2 000 runs, {many} kB for 100 000 runs")
    # 16 bytes a run for keys, and what allocator and page cache keep: a log a run would take hundreds.
    if many > few + 8192:
        sys.exit("memory grows with the number of runs")
