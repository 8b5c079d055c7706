#!/usr/bin/env bash
# A report in a browser: its figures are drawn, the console is silent, the page is not blank.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "skipped: there is no Chromium"
  exit 77
}

# browse FLAG… PAGE: runs the browser on a page; its log is in log.
browse() {
  local page=${*: -1}
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --hide-scrollbars \
    --user-data-dir="$folder/profile" --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --v=0 \
    --virtual-time-budget=4000 "${@:1:$#-1}" "$(python3 -c 'import pathlib, sys; print(pathlib.Path(sys.argv[1]).resolve().as_uri())' "$page")" \
    >dom 2>log || fail "the browser ended with status $?: $(tail -n 3 log)"
  ! grep -q 'CONSOLE' log || fail "the console of $page: $(grep CONSOLE log)"
}

# pixels FILE.png: prints its width, height, and the part of its pixels that are not white, in percent.
pixels() {
  python3 - "$1" <<'PYTHON'
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
assert data[:8] == b"\x89PNG\r\n\x1a\n"
at, rows, packed = 8, None, b""
while at < len(data):
    length, kind = struct.unpack(">I4s", data[at:at + 8])
    body = data[at + 8:at + 8 + length]
    if kind == b"IHDR":
        width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
        assert depth == 8 and colour in (2, 6) and interlace == 0
    elif kind == b"IDAT":
        packed += body
    at += 12 + length
size = 3 if colour == 2 else 4
raw, stride, before, dark = zlib.decompress(packed), width * size, bytearray(width * size), 0
for y in range(height):
    kind = raw[y * (stride + 1)]
    line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
    if kind:
        for k in range(stride):
            a = line[k - size] if k >= size else 0
            b = before[k]
            c = before[k - size] if k >= size else 0
            if kind == 1: guess = a
            elif kind == 2: guess = b
            elif kind == 3: guess = (a + b) // 2
            else:
                p = a + b - c
                pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
                guess = a if pa <= pb and pa <= pc else b if pb <= pc else c
            line[k] = (line[k] + guess) & 255
    dark += sum(1 for k in range(0, stride, size) if min(line[k:k + 3]) < 200)
    before = line
print(width, height, round(100 * dark / (width * height), 2))
PYTHON
}

cat >robot.toml <<'TOML'
flyball = 1
[model]
title = "A robot turns"
[blocks]
cruise = { type = "Constant", value = "0.5 m/s" }
turn   = { type = "SineWave", amplitude = "1 rad/s", frequency = "1 rad/s" }
robot  = { type = "Unicycle" }
[diagram]
wires = ["cruise -> robot.v", "turn -> robot.omega"]
log = ["robot.pose", "turn"]
[simulation]
stop = "12 s"
[requirements]
slow = "max(turn) < 2 rad/s"
TOML
expect 0 run robot.toml --quiet --report robot.html
browse --window-size=1100,900 --screenshot="$folder/robot.png" robot.html
read -r width height dark < <(pixels robot.png)
[[ $width == 1100 && $height == 900 ]] || fail "the picture is $width x $height"
awk -v dark="$dark" 'BEGIN { exit !(dark > 0.5 && dark < 50) }' || fail "$dark % of the picture are dark"

# One canvas for a panel and one for what lies above it; the robot's mark has been put in its place.
browse --dump-dom robot.html
(($(grep -o '<canvas' dom | wc -l) >= 4)) || fail "the figures are not drawn"
grep -qE '<g class="mark shown"[^>]*transform="translate\([0-9.]+ [0-9.]+\) rotate' dom || fail "the robot is not on its way"
finish
