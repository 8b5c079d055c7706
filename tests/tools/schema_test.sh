#!/usr/bin/env bash
# The schema accepts every shipped model, and refuses what no block has.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"
expect 0 blocks --schema
cp out schema.json
/usr/bin/python3 - schema.json "$sources/models" <<'PYTHON' >out 2>err || fail "the schema: $(cat out err)"
import copy, json, pathlib, sys, tomllib
from jsonschema import Draft4Validator

schema = json.loads(pathlib.Path(sys.argv[1]).read_text())
Draft4Validator.check_schema(schema)
validator = Draft4Validator(schema)
models = {p: tomllib.loads(p.read_text()) for p in pathlib.Path(sys.argv[2]).rglob("*.toml")}
assert len(models) > 10
for path, model in models.items():
    for error in validator.iter_errors(model):
        sys.exit(f"{path}: {list(error.path)}: {error.message}")

arc = next(m for p, m in models.items() if p.name == "arc_error_loop.toml")
def refused(change):
    model = copy.deepcopy(arc)
    change(model)
    assert list(validator.iter_errors(model)), "accepted what it should refuse"
refused(lambda m: m["blocks"]["K1"].update(gian=1.0))
refused(lambda m: m["blocks"]["K1"].pop("type"))
refused(lambda m: m["blocks"]["sine"].update(function="sine"))
refused(lambda m: m["parameters"].update(V=[1.0]))
refused(lambda m: m["simulation"]["solver"].update(method="dp6"))
refused(lambda m: m.update(bloks={}))
refused(lambda m: m.pop("flyball"))
gain = schema["definitions"]["Gain"]
assert gain["properties"]["gain"]["description"] and "description" in gain
PYTHON
finish
