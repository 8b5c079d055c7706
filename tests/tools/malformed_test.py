"""malformed_test.py FLYBALL SOURCES: model files with mistakes of many kinds, given to the command.

Whatever stands in the file: status 3 and a place in the file for each error, status 5 where it cannot be read, or a
model that is in order. Never a signal, and memory that is in proportion to the file."""
import os
import random
import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

FLYBALL, SOURCES = sys.argv[1], Path(sys.argv[2])
MODELS = [SOURCES / "models" / name for name in
          ("line_arc/arc_error_loop.toml", "classic/valve_takeover.toml", "classic/two_rate_loop.toml")]
FILE = "m.toml"
PLACE = re.compile(rf"{FILE}:(\d+):(\d+): error: .")
DONE, MODEL_ERROR, INPUT_OUTPUT = 0, 3, 5
# Seconds after which a run counts as one without an end.
PATIENCE = 120
# The text is held a few times: as it was read, for positions, for the parser. A sanitizer holds on to what was freed.
# A buffer that doubles holds a file of the largest size and a half twice while it grows.
MOST_MEMORY = 1_600_000_000

failures = 0
runs = 0


def fail(what, said):
    global failures
    failures += 1
    print(f"FAILED: {what}\n{said[:2000]}")


def run(arguments, what):
    """Status and standard error; a signal, too long a run and too much memory are failures."""
    global runs
    runs += 1
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen([FLYBALL, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=said)
        watch = threading.Timer(PATIENCE, process.kill)
        watch.start()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = 0  # it was waited for
        watch.cancel()
        said.seek(0)
        text = said.read().decode(errors="replace")
    if os.WIFSIGNALED(status):
        fail(f"{what}: signal {os.WTERMSIG(status)}", text)
    if used.ru_maxrss * 1024 > MOST_MEMORY:
        fail(f"{what}: {used.ru_maxrss // 1024} MB", text)
    return os.waitstatus_to_exitcode(status), text


def check(text, what, expected):
    """What the command says of this text, which must have one of the expected statuses."""
    Path(FILE).write_bytes(text)
    status, said = run(["check", FILE], what)
    if status not in expected:
        fail(f"{what}: status {status}", said)
    places = [line for line in said.splitlines() if ": error: " in line]
    if status == MODEL_ERROR and not places:
        fail(f"{what}: no error", said)
    lines = text.split(b"\n")
    for line in places if status == MODEL_ERROR else []:
        place = PLACE.match(line)
        if not place or not 1 <= int(place[1]) <= len(lines) or \
                not 1 <= int(place[2]) <= len(lines[int(place[1]) - 1]) + 1:
            fail(f"{what}: no place in the file", line)
    return said


def changed(lines, edit):
    lines = list(lines)
    edit(lines)
    return b"\n".join(lines)


def deleted(lines, chance):
    del lines[chance.randrange(len(lines))]


def doubled(lines, chance):
    lines.insert(chance.randrange(len(lines)), chance.choice(lines))


def swapped(lines, chance):
    a, b = chance.randrange(len(lines)), chance.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]


def replace(lines, chance, pattern, text):
    places = [(k, found) for k, line in enumerate(lines) if not line.startswith(b"#")
              for found in re.finditer(pattern, line)]
    k, found = chance.choice(places)
    lines[k] = lines[k][:found.start(1)] + text + lines[k][found.end(1):]


def wrong_type(lines, chance):
    value = chance.choice([b"true", b'[1, "two"]', b"{ x = 1 }", b"1979-05-27", b"-7", b'"?"', b"1e400"])
    replace(lines, chance, rb'= ("[^"]*"|-?[0-9.][0-9.e-]*)', value)


def wrong_port(lines, chance):
    port = chance.choice([b"nowhere", b"nowhere.u", b"H.nothing.x", b".", b"", b"a b"])
    replace(lines, chance, rb'-> ([\w.]+)', port)


def nul(lines, chance):
    replace(lines, chance, rb'^[\w\[" ]+()', b"\0")


def bad_utf8(lines, chance):
    replace(lines, chance, rb'^.+()', chance.choice([b"\xff", b"\xc3", b"\xed\xa0\x80", b"\xc0\xaf"]))


EDITS = [(deleted, 12, {DONE, MODEL_ERROR}), (doubled, 12, {DONE, MODEL_ERROR}), (swapped, 12, {DONE, MODEL_ERROR}),
         (wrong_type, 12, {DONE, MODEL_ERROR}), (wrong_port, 8, {MODEL_ERROR}), (nul, 4, {MODEL_ERROR}),
         (bad_utf8, 4, {MODEL_ERROR})]


def test_edits():
    for model in MODELS:
        lines = model.read_bytes().split(b"\n")
        for edit, count, expected in EDITS:
            for seed in range(count):
                chance = random.Random(f"{model.name} {edit.__name__} {seed}")
                check(changed(lines, lambda own: edit(own, chance)), f"{model.name}, {edit.__name__} {seed}", expected)


def test_line_ends_and_mark():
    """Files of other systems say the same."""
    text = MODELS[0].read_bytes()
    results = []
    for what, variant in (("as it is", text), ("CR LF", text.replace(b"\n", b"\r\n")),
                          ("byte-order mark", b"\xef\xbb\xbf" + text)):
        Path(FILE).write_bytes(variant)
        status, said = run(["run", FILE, "--quiet", "--output", "r.csv"], what)
        results.append(Path("r.csv").read_bytes())
        if status != DONE or results[-1] != results[0]:
            fail(what, said)
    said = check(text.replace(b"\n", b"\r\n").replace(b'"Gain"', b'"Gian"'), "CR LF", {MODEL_ERROR})
    if f'{FILE}:28:19: error: unknown block type "Gian"' not in said:
        fail("the place in a file with CR LF", said)


def test_nesting():
    deep = 10_000
    value = b'flyball = 1\n[blocks]\nc = { type = "Constant", value = %s }\n'
    lists, tables = b"[" * deep + b"]" * deep, b"{ a = " * deep + b"1" + b" }" * deep
    types = b"".join(b'[subsystems.S%d]\nports = {}\nblocks = { b = { type = "S%d" } }\n' % (k, k + 1)
                     for k in range(deep))
    for what, text, expected in (
            ("brackets", value % (b'"' + b"(" * deep + b"1" + b")" * deep + b'"'), "nested too deeply"),
            ("functions", value % (b'"' + b"abs(" * deep + b"1" + b")" * deep + b'"'), "too"),
            ("signs", value % (b'"' + b"-" * deep + b'1"'), "nested too deeply"),
            ("powers", value % (b'"' + b"2^" * deep + b'1"'), "too"),
            ("lists", value % lists, "nested more than 64 levels deep"),
            ("lists that do not end", value % (b"[" * deep), "nested more than 64 levels deep"),
            ("inline tables", value % tables, "nested more than 64 levels deep"),
            ("tables", b"[" + b"subsystems.a." * deep + b"blocks]\n", "nested more than 64 levels deep"),
            ("subsystems", b'flyball = 1\n' + types + b'[subsystems.S%d]\nports = {}\nblocks = {}\n'
             b'[blocks]\ntop = { type = "S0" }\n' % deep, "levels")):
        said = check(text, what, {MODEL_ERROR})
        if expected not in said:
            fail(f"{deep} {what}", said)


def test_long_lines():
    size = 100_000_000
    value = b'flyball = 1\n[blocks]\nc = { type = "Constant", value = %s }\n'
    for what, text in (("a word", b"x" * size), ("a list", value % (b"[" + b"1.5, " * (size // 5) + b"1]")),
                       ("an expression", value % (b'"' + b"1+" * (size // 2) + b'1"')),
                       ("a wire", b'flyball = 1\n[diagram]\nwires = ["a' + b" -> b" * (size // 5) + b'"]\n'),
                       ("a comment", b"flyball = 1 # " + "\u00e9".encode() * (size // 2))):
        said = check(text, what, {MODEL_ERROR})
        if "error: the line is longer than 1000000 bytes" not in said:
            fail(f"100 MB: {what}", said)
    # Just short enough, and nothing but mistakes.
    wires = b"flyball = 1\n[blocks]\n[diagram]\nwires = [%s]\n"
    for what, text in (("numbers behind a letter of two bytes", value % (b'["\xc3\xa9", ' + b"1.5, " * 190_000 + b"1]")),
                       ("a wire", wires % (b'"a' + b"->b" * 300_000 + b'"')),
                       ("many wires", wires % (b'"a->b", ' * 120_000))):
        check(text, f"1 MB: {what}", {MODEL_ERROR})


def test_unreadable():
    os.mkdir("folder.toml")
    for name, reason in (("folder.toml", "Is a directory"), ("missing.toml", "No such file or directory"),
                         ("/dev/zero", "File too large")):
        status, said = run(["check", name], name)
        if status != INPUT_OUTPUT or f"error: {name}: cannot be read: {reason}" not in said:
            fail(f"{name}: status {status}", said)
    for what, text in (("an empty file", b""), ("a mark alone", b"\xef\xbb\xbf"), ("line ends alone", b"\r\n\r\n")):
        if f"{FILE}:1:1: error: " not in check(text, what, {MODEL_ERROR}):
            fail(f"{what}: not said at its start", "")


with tempfile.TemporaryDirectory(prefix="flyball-malformed-") as folder:
    os.chdir(folder)
    for test in (test_edits, test_line_ends_and_mark, test_nesting, test_long_lines, test_unreadable):
        test()
    os.chdir("/")
print(f"{runs} runs, {failures} failures")
sys.exit(failures > 0)
