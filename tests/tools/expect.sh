# Helpers of the command's tests: source this with the path of flyball as $1 and of the sources as $2.
set -u
flyball=$1
sources=$2
arc=$sources/models/line_arc/arc_error_loop.toml
folder=$(mktemp -d "${TMPDIR:-/tmp}/it's a \"test\" \$x.XXXXXX")
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder" || exit 1
failures=0

fail() {
  echo "FAILED: $*"
  echo "--- standard output"; cat out
  echo "--- standard error"; cat err
  failures=$((failures + 1))
}

# expect STATUS ARGUMENT...: runs flyball with the arguments; its streams are in out and err.
expect() {
  local wanted=$1 status=0
  shift
  last="flyball $*"
  "$flyball" "$@" >out 2>err </dev/null || status=$?
  if ((status != wanted)); then fail "$last: status $status instead of $wanted"; fi
}

# says STREAM TEXT: the text stands in out, err or another file.
says() { grep -qF -e "$2" -- "$1" || fail "$last: no \"$2\" in $1"; }
is_empty() { [[ ! -s $1 ]] || fail "$last: $1 is not empty"; }
exists() { [[ -s $1 ]] || fail "$last: there is no $1"; }
is_missing() { [[ ! -e $1 ]] || fail "$last: there is a $1"; }
nothing_half_written() { [[ -z $(find . -name '.*.part') ]] || fail "$last: $(find . -name '.*.part') was left"; }
finish() { exit $((failures > 0)); }

# A loop whose root becomes that of a negative number at t = 1 s.
root_model() {
  cat <<'TOML'
flyball = 1
[blocks]
clock = { type = "Clock" }
root  = { type = "Expression", formula = "sqrt(1 - u)" }
x     = { type = "Integrator" }
[diagram]
wires = ["clock -> root -> x"]
log = ["x"]
[simulation]
stop = "2 s"
log_interval = "0.125 s"
TOML
}
