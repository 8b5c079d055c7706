#!/usr/bin/env bash
# flyball run with metrics and requirements, of the model and of the command line.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

cat >motor.toml <<'TOML'
flyball = 1
[blocks]
command = { type = "Step", time = "1 s", after = "2 V" }
motor   = { type = "TransferFcn", numerator = [1], denominator = [0.5, 1] }
[diagram]
wires = ["command -> motor"]
log = ["command", "motor"]
[simulation]
stop = "5 s"
[metrics]
settling = "settling(motor, 2 %, from = 1 s)"
[requirements]
calm = "overshoot(motor) < 5 %"
TOML

expect 0 run motor.toml
says out "settling  1.947"
says out "calm         passed   overshoot(motor) is 0 %, expected < 5 %"
is_empty err

expect 1 run motor.toml --quiet --require 'always motor < 1 V' --require 'final(motor) <= 2 V'
is_empty out
says err "motor.toml: requirement failed: always motor < 1 V: motor is 1.99933 V at 5 s, expected < 1 V"
[[ $(wc -l <err) == 1 ]] || fail "$last: one line expected"

expect 0 run motor.toml --metric 'half=delay(motor, from = 1 s)' --metric 'settling=3 s' --json --output motor.csv
says out '"half": {'
says motor.json '"text": "3 s"'
says motor.json '"passed": true'
expect 0 check motor.csv

expect 1 run motor.toml --quiet --junit verdicts.xml --require "max(motor) < 1 V"
python3 - verdicts.xml <<'PYTHON' || fail "verdicts.xml is not what it should be"
import sys
import xml.etree.ElementTree as xml
root = xml.parse(sys.argv[1]).getroot()
assert root.tag == "testsuites" and root.get("tests") == "2" and root.get("failures") == "1", root.attrib
cases = list(root.iter("testcase"))
assert [case.get("name") for case in cases] == ["calm", "max(motor) < 1 V"]
assert cases[1].find("failure").get("message") == "max(motor) is 1.99933 V, expected < 1 V"
PYTHON
nothing_half_written

# A run that stops is a numerical failure, whatever was required of it.
root_model >root.toml
expect 4 run root.toml --quiet --require 'final(x) < 5' --junit stopped.xml
says stopped.xml "the run was stopped at "

expect 2 run motor.toml --require 'overshot(motor) < 5 %'
says err 'error: --require "overshot(motor) < 5 %", column 1: unknown function "overshot"; did you mean "overshoot"?'
expect 2 run motor.toml --metric 'max(motor)'
says err "--metric: expected NAME=TEXT, found \"max(motor)\""
expect 2 run motor.toml --metric 'x=µ + max(motor)'
says err 'column 1'
expect 5 run motor.toml --quiet --junit no/such/folder/verdicts.xml
is_missing no

sed 's/overshoot(motor) < 5 %/overshoot(motor) < 5 s/' motor.toml >wrong.toml
expect 3 run wrong.toml
says err "wrong.toml:13:28: error: expected a plain number, found s"
expect 3 check wrong.toml
finish
