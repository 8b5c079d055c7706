"""kills_test.py FLYBALL KILLS: a study of 200 runs is killed (SIGKILL) so many times, at random moments; a thousand
times where FLYBALL_SOAK is set.

Whatever the moment: what was finished before stays finished, no half file is left, and in the end the results have the
bytes of the study that nobody killed. A study that is complete begins anew in another folder."""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FLYBALL = sys.argv[1]
KILLS = 1000 if os.environ.get("FLYBALL_SOAK") else int(sys.argv[2])
MODEL = """flyball = 1
[parameters]
T = { value = 0.5, unit = "s" }
deviation = 0.2
[blocks]
noise = { type = "RandomNumber", deviation = "deviation", sample_time = "0.01 s" }
sum = { type = "Sum", signs = "+-" }
rate = { type = "Gain", gain = "1/T" }
x = { type = "Integrator", initial = 1.0 }
[diagram]
wires = ["noise -> sum.u1", "x -> sum.u2", "sum -> rate -> x"]
log = ["x"]
[simulation]
stop = "1 s"
"""
STUDY = """flyball = 1
[study]
model = "lag.toml"
[cases]
fast = { T = "0.2 s" }
slow = { T = "0.8 s" }
[monte_carlo]
runs = 100
[metrics]
last = "final(x)"
largest = "max(abs(x))"
[requirements]
small = "max(abs(x)) < 10"
"""


def command(folder):
    return [FLYBALL, "study", "lag_study.toml", "--output", folder, "--quiet", "--threads", "2"]


def results(folder):
    """All that is written for people and other programs; the store is where it comes from."""
    return {path.name: path.read_bytes() for path in Path(folder).iterdir() if not path.name.startswith("study.") or
            path.name == "study.json"}


def status(folder):
    told = subprocess.run([FLYBALL, "study", "lag_study.toml", "--output", folder, "--status", "--json"], check=True,
                          stdout=subprocess.PIPE)
    return json.loads(told.stdout)


def main():
    random.seed(4)
    Path("lag.toml").write_text(MODEL)
    Path("lag_study.toml").write_text(STUDY)
    begin = time.monotonic()
    subprocess.run(command("whole"), check=True)
    duration = time.monotonic() - begin
    expected = results("whole")
    kills = complete = before = 0
    while kills < KILLS or before > 0:
        # As a process of its own group nothing of it outlives the kill. Short times, so that few runs are done.
        process = subprocess.Popen(command("killed"))
        try:
            process.wait(random.uniform(0.0, 0.6 * duration) if kills < KILLS else None)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            kills += 1
        left = [name for name in os.listdir("killed")] if os.path.isdir("killed") else []
        for name, content in results("killed").items() if left else ():
            # What a kill leaves of a file has no name that anybody reads, until the next process removes it.
            if not name.endswith(".part") and content != expected[name]:
                sys.exit(f"kill {kills}: {name} is not what it should be")
        finished = status("killed")["finished"]
        if finished < before:
            sys.exit(f"kill {kills}: {before} runs were finished, now {finished} are")
        before = finished
        if process.returncode == 0:
            if results("killed") != expected:
                sys.exit(f"kill {kills}: the results differ")
            complete += 1
            before = 0
            shutil.rmtree("killed")
        elif process.returncode != -signal.SIGKILL:
            sys.exit(f"kill {kills}: status {process.returncode}")
    print(f"{kills} kills, {complete} studies complete, all with the same bytes")
    if complete == 0 or kills == 0:
        sys.exit("nothing was tried")


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    main()
