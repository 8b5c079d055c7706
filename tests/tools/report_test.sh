#!/usr/bin/env bash
# flyball report, and run --report: one file of HTML that stands alone.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"
servo=$sources/models/classic/pid_servo.toml

cat >odd.toml <<'TOML'
flyball = 1
# </script><script>alert("model")</script> & <b>
[model]
title = "A robot's <way> & </script>"
[blocks]
cruise = { type = "Constant", value = "0.5 m/s" }
turn   = { type = "SineWave", amplitude = "1 rad/s", frequency = "1 rad/s" }
robot  = { type = "Unicycle" }
[diagram]
wires = ["cruise -> robot.v", "turn -> robot.omega"]
log = ["robot.pose", "turn"]
[simulation]
stop = "12 s"
log_interval = "1 ms"
[metrics]
length = "path_length(robot.pose.x, robot.pose.y)"
[requirements]
"short_way" = "path_length(robot.pose.x, robot.pose.y) < 5 m"
TOML
expect 1 run odd.toml --quiet --output odd.csv --report "odd report.html"
says "odd report.html" "<h1>A robot's &lt;way&gt; &amp; &lt;/script&gt;</h1>"
says "odd report.html" "&lt;/script&gt;&lt;script&gt;alert(&quot;model&quot;)&lt;/script&gt; &amp; &lt;b&gt;"
says "odd report.html" "1 of 1 requirements failed"
says "odd report.html" "The way of robot.pose"
says "odd report.html" "flyball run odd.toml"
[[ $(grep -c 'alert("' "odd report.html") == 0 ]] || fail "$last: the model's text became a script"
nothing_half_written

# From the files alone the report is the same, and so it is every time.
expect 0 report odd.csv --output again.html --quiet
cmp -s "odd report.html" again.html || fail "$last: another report than that of the run"

# Nothing is asked of the network.
! grep -oE '(src|href)="[^#"][^"]*"' again.html | grep -vE 'xlink|"data:' || fail "$last: the report is not alone"

# Twelve thousand rows of four columns are thinned to what can be seen.
size=$(stat -c %s again.html)
((size < 1000000)) || fail "$last: $size bytes"

# A model that has changed since is not shown.
sed -i 's/0.5 m/0.6 m/' odd.toml
expect 0 report odd.csv --quiet
says odd.html "has changed since this run"
sed -i 's/^1,/1.5,/' odd.csv
expect 3 report odd.csv --output changed.html
is_missing changed.html
expect 5 report nothing.csv
expect 2 report odd.toml
expect 5 run "$servo" --quiet --report no/such/report.html
is_missing no

# Python reads the page to its end, with every tag closed.
expect 0 run "$servo" --quiet --report servo.html --require 'always abs(controller) <= 12.001 V' --metric 'rise=rise(shaft)'
python3 - servo.html again.html <<'PYTHON' || fail "a report is not well-formed"
import html.parser, sys
void = {"meta", "input", "br", "link"}
class Reader(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open = []
    def handle_starttag(self, tag, attributes):
        if tag not in void:
            self.open.append(tag)
    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, (tag, self.getpos())
for name in sys.argv[1:]:
    reader = Reader()
    reader.feed(open(name, encoding="utf-8").read())
    reader.close()
    assert not reader.open, reader.open
PYTHON
finish
