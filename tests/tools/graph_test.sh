#!/usr/bin/env bash
# flyball graph: pictures, order of execution, JSON.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"
two_rates=$sources/models/classic/two_rate_loop.toml

expect 0 graph "$two_rates"
is_empty err
says out "digraph diagram {"
says out "every 100 us"
says out "every 1 ms"
# The blocks of a sample rate, and the wires behind them, have its colour: the fast one, then the slow one.
[[ $(grep -c 'color="#d62728"' out) -ge 2 ]] || fail "$last: the fast rate has no colour"
[[ $(grep -c 'color="#1f77b4"' out) -ge 2 ]] || fail "$last: the slow rate has no colour"
[[ $(grep -c ' -> ' out) -eq 20 ]] || fail "$last: $(grep -c ' -> ' out) wires instead of 20"

expect 0 graph "$two_rates" --output "a graph.svg"
is_empty out
says "a graph.svg" "<svg"
says "a graph.svg" "w_control"
expect 0 graph "$two_rates" --output "a graph.png"
[[ $(head -c 4 "a graph.png" | tail -c 3) == PNG ]] || fail "$last: no PNG"
expect 0 graph "$two_rates" --output "a graph.gv"
says "a graph.gv" "digraph diagram {"
nothing_half_written

# A controller comes after its error, and the fast one after the slow one that feeds it.
expect 0 graph "$two_rates" --order
place() { awk -v name="$1" '$2 == name { print NR; exit }' out; }
(($(place w_error) < $(place w_control) && $(place w_control) < $(place i_control))) ||
  fail "$last: wrong order"
says out "1 ms"

expect 0 graph "$two_rates" --json
says out '"from": "w_error.y"'
says out '"rate": "100 us"'

expect 2 graph "$two_rates" --output graph.pdf
says err 'expected the name of a .svg, .png or .gv file, found "graph.pdf"'
expect 5 graph missing.toml
echo 'flyball = 1' >empty.toml
expect 3 graph empty.toml
expect 5 graph "$two_rates" --output missing/graph.svg
PATH=/nowhere expect 5 graph "$two_rates" --output other.svg
says err "other.svg: not drawn: Graphviz is not installed"
is_missing other.svg
nothing_half_written
expect 0 graph --help
says out "Example:"
finish
