"""The schema of studies accepts every shipped study, and refuses what no study has.

Arguments: the schema, the root of the sources, a study that has everything.
"""
import copy, json, pathlib, sys, tomllib
from jsonschema import Draft4Validator

schema = json.loads(pathlib.Path(sys.argv[1]).read_text())
Draft4Validator.check_schema(schema)
validator = Draft4Validator(schema)
sources = pathlib.Path(sys.argv[2])
studies = {p: tomllib.loads(p.read_text()) for p in (sources / "studies").glob("*/*.toml")}
assert len(studies) >= 6
for path, study in studies.items():
    for error in validator.iter_errors(study):
        sys.exit(f"{path}: {list(error.path)}: {error.message}")

every = tomllib.loads(pathlib.Path(sys.argv[3]).read_text())
for error in validator.iter_errors(every):
    sys.exit(f"{list(error.path)}: {error.message}")

def refused(change):
    study = copy.deepcopy(every)
    change(study)
    assert list(validator.iter_errors(study)), "accepted what it should refuse"
refused(lambda s: s.pop("study"))
refused(lambda s: s["study"].update(model="a.toml"))
refused(lambda s: s["study"].update(titel="a"))
refused(lambda s: s["cases"].update(a=3))
refused(lambda s: s["sweep"].update(combine="zap"))
refused(lambda s: s["sweep"].update(T=[]))
refused(lambda s: s["sweep"].update(T={"from": 1.0, "until": 2.0}))
refused(lambda s: s["monte_carlo"].update(runs=0))
refused(lambda s: s["monte_carlo"].update(T={"nromal": [0.0, 1.0]}))
refused(lambda s: s["monte_carlo"].update(T={"triangular": [0.0, 1.0]}))
refused(lambda s: s["metrics"].update(a=3))
refused(lambda s: s["fit"]["step"].update(loss="hubber"))
refused(lambda s: s["pareto"]["gains"].update(minimize=["a"]))
refused(lambda s: s["bisect"]["limit"].pop("requirement"))
refused(lambda s: s["plot"][0].update(by="cases"))
