"""``roughline about`` says what a report of an error needs."""

import json
from importlib import metadata

import roughline as rl
from roughline.computing.cores import available_cores


def test_it_tells_versions_and_the_machine(invoke):
    code, out, _ = invoke("about")
    assert code == 0
    told = {line.split()[0]: line.split(maxsplit=1)[1] for line in out.splitlines()}
    assert told["roughline"] == rl.__version__
    assert told["cores"] == str(available_cores())
    for name in ("numpy", "scipy", "numba", "ducc0", "SurfaceTopography"):
        assert told[name] == metadata.version(name)
    assert "pytest" not in told


def test_it_tells_the_same_to_programs(invoke):
    code, out, _ = invoke("about", "--json")
    told = json.loads(out)
    assert code == 0
    assert told["roughline"] == rl.__version__
    assert told["packages"]["numpy"] == metadata.version("numpy")
