# Everything needs Python 3.11 or newer, git and make; the environment is made in .venv.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
TOOLS := out/tools
OUT ?= out/paper
TEST_PROCESSES ?= 2
PART ?= 1/1
PEERS_PYTHON ?= $(BIN)/python
# What many short processes load is compiled once, whatever the environment says of it.
unexport PYTHONDONTWRITEBYTECODE
PYTEST := $(BIN)/python -m pytest -n $(TEST_PROCESSES) --dist loadgroup

.PHONY: full long durations cases mutants lab paper paper-full test check benchmark turns peers memory grid-error coverage coverage-table intervals interface-stiffness part-coverage leak-coverage seal-coverage bootstrap-coverage persson contact-area robustness friction-paths friction-speed friction-peers soak yielding yield-of-maps square-leakage start-up constants flow-benchmark pull-off layers permeance lab-benchmark study correlations finite-size area averaging sealing friction published paper-figures docs measured-figures validation lowest newest dist architecture clean

lab: $(VENV)/installed
	$(BIN)/roughline lab

paper: $(VENV)/installed
	$(BIN)/roughline paper --scale quick --out $(OUT)

paper-full: $(VENV)/installed
	$(BIN)/roughline paper --scale full --out out/paper-full

# What is short, and of each test that is long a short case.
test: $(VENV)/installed
	$(PYTEST) --tier short

# All tests, or one of some parts of them that take as long as each other: PART=2/3.
full: $(VENV)/installed
	$(PYTEST) --part $(PART)

# Or a part of those that `make test` leaves out, such as PART=5/12.
long: $(VENV)/installed
	$(PYTEST) --tier long --part $(PART)

# Runs all tests, and writes how long each takes: tests/durations.json, by which the tests above are chosen.
durations: $(VENV)/installed
	$(PYTEST) --record

# All random cases, of which `make full` tries a fixed share; in some hours.
cases: $(VENV)/installed
	ROUGHLINE_CASES=all $(PYTEST) $$(grep -rl "^from random_cases import" tests)

# Which of the mistakes of tests/mutants.toml the tests find that each names; in about half an hour.
mutants: $(VENV)/installed
	$(BIN)/python tests/mutants.py out/mutants

check: $(VENV)/installed
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

benchmark: $(VENV)/installed
	$(BIN)/python benchmarks/measure.py

# Times this state and another in turns; OLD names the folder of its package, such as ../old/src.
turns: $(VENV)/installed
	$(BIN)/python benchmarks/turns.py $(OLD) src

# Measures the other programs that this Python has; PEERS_PYTHON=... names that of another environment.
peers: $(VENV)/installed
	PYTHONPATH=src $(PEERS_PYTHON) benchmarks/peers.py

memory: $(VENV)/installed
	$(BIN)/python benchmarks/memory.py

grid-error: $(VENV)/installed
	$(BIN)/python benchmarks/measured_coverage.py finer --seed 1000

coverage: $(VENV)/installed
	$(BIN)/python benchmarks/measured_coverage.py pieces

# How often intervals hold what is known of many bodies; fails where a promise is not kept; resumable.
coverage-table: $(VENV)/installed
	$(BIN)/python benchmarks/promised_coverage.py

contact-area: $(VENV)/installed
	$(BIN)/python benchmarks/contact_area.py

persson: $(VENV)/installed
	$(BIN)/python benchmarks/persson.py

bootstrap-coverage: $(VENV)/installed
	$(BIN)/python benchmarks/bootstrap_coverage.py

interface-stiffness: $(VENV)/installed
	$(BIN)/python benchmarks/measured_coverage.py tiled

# Every interval on every kind of surface, in about an hour; resumable.
intervals: $(VENV)/installed
	$(BIN)/python benchmarks/measured_coverage.py

leak-coverage: $(VENV)/installed
	$(BIN)/python benchmarks/measured_coverage.py leak

seal-coverage: $(VENV)/installed
	$(BIN)/python benchmarks/measured_coverage.py seal

part-coverage: $(VENV)/installed
	$(BIN)/python benchmarks/measured_coverage.py mine

robustness: $(VENV)/installed
	$(BIN)/python benchmarks/robustness.py

friction-paths: $(VENV)/installed
	$(BIN)/python benchmarks/friction_paths.py friction_paths.csv

soak: $(VENV)/installed
	$(BIN)/python benchmarks/soak.py 100 1

yielding: $(VENV)/installed
	$(BIN)/python benchmarks/yielding.py

# MAPS names the folder of the measured maps.
yield-of-maps: $(VENV)/installed
	$(BIN)/python benchmarks/yield_of_maps.py $(MAPS)

flow-benchmark: $(VENV)/installed
	$(BIN)/python benchmarks/flow.py

pull-off: $(VENV)/installed
	$(BIN)/python benchmarks/pull_off.py

layers: $(VENV)/installed
	$(BIN)/python benchmarks/layers.py

friction-speed: $(VENV)/installed
	$(BIN)/python benchmarks/friction_speed.py

# PEERS_PYTHON has ASPHER beside roughline's own libraries, as for `peers`
friction-peers: $(VENV)/installed
	PYTHONPATH=src $(PEERS_PYTHON) benchmarks/friction_peers.py

permeance: $(VENV)/installed
	$(BIN)/python benchmarks/permeance.py

# Writes src/roughline/spectra/square_leakage.npz again, after a change of what it holds.
square-leakage: $(VENV)/installed
	$(BIN)/python benchmarks/square_leakage.py

# MAPS names files of instruments, if there are any.
start-up: $(VENV)/installed
	$(BIN)/python benchmarks/start_up.py $(MAPS)

# Each constant of the margins doubled, one at a time, in half an hour; MAPS as above; resumable.
constants: $(VENV)/installed
	$(BIN)/python benchmarks/constants.py $(MAPS)

lab-benchmark: $(VENV)/installed
	$(BIN)/python benchmarks/lab_moves.py

study: $(VENV)/installed
	$(BIN)/roughline campaign run studies/paper/plan.toml --store out/study.zarr
	$(BIN)/python -m studies reduce paper out/study.zarr
	$(BIN)/python -m studies.paper.gallery

correlations: $(VENV)/installed
	$(BIN)/roughline campaign run studies/correlations/plan.toml --store out/correlations.zarr
	$(BIN)/python -m studies reduce correlations out/correlations.zarr
	$(BIN)/python -m studies publish correlations

finite-size: $(VENV)/installed
	$(BIN)/roughline campaign run studies/finite_size/plan.toml --store out/finite-size.zarr
	$(BIN)/python -m studies reduce finite_size out/finite-size.zarr
	$(BIN)/python -m studies publish finite_size

area: $(VENV)/installed
	$(BIN)/roughline campaign run studies/area/plan.toml --store out/area.zarr
	$(BIN)/python -m studies reduce area out/area.zarr
	$(BIN)/python -m studies publish area

# In two hours of two cores; resumable.
sealing: $(VENV)/installed
	OMP_NUM_THREADS=1 $(BIN)/python -m studies.sealing.run out/sealing.jsonl 2
	$(BIN)/python -m studies reduce sealing out/sealing.jsonl
	$(BIN)/python -m studies publish sealing

# In an hour of two cores; resumable.
friction: $(VENV)/installed
	OMP_NUM_THREADS=1 $(BIN)/python -m studies.friction.run out/friction.jsonl 2
	$(BIN)/python -m studies reduce friction out/friction.jsonl
	$(BIN)/python -m studies publish friction

# Of the data of the paper's study, which come with the package.
averaging: $(VENV)/installed
	$(BIN)/python -m studies reduce averaging
	$(BIN)/python -m studies publish averaging

published: $(VENV)/installed
	$(BIN)/python -m studies publish paper correlations area averaging finite_size sealing friction

# The errors against exact solutions that the handbook tells, from the tests' own run.
validation: $(VENV)/installed
	rm -f docs/validation.json
	ROUGHLINE_VALIDATION=1 $(BIN)/python -m pytest tests/halfspace/test_exact_solutions.py tests/halfspace/test_hardness_exact.py tests/halfspace/friction/test_exact_friction.py tests/reduction/test_exact_solutions.py

# The handbook as a site, which opens from disk: out/docs/index.html.
docs: $(VENV)/installed
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs out/docs
	@echo "the handbook lies in out/docs/index.html"

# The suite with the lowest versions that pyproject.toml allows, and with the newest that there are.
# Old versions beside new ones warn of each other, so that warnings are no errors there.
lowest: RESOLUTION := lowest-direct
newest: RESOLUTION := highest
lowest newest: $(TOOLS)/installed
	$(TOOLS)/bin/uv venv --quiet --clear --python $(PYTHON) out/$@
	VIRTUAL_ENV=out/$@ $(TOOLS)/bin/uv pip install --quiet --compile-bytecode --resolution $(RESOLUTION) --editable ".[test]"
	out/$@/bin/python -m pytest -n $(TEST_PROCESSES) --dist loadgroup -o filterwarnings=

# What a release uploads; its wheel is installed into an empty environment, and used.
dist: $(TOOLS)/installed
	rm -rf dist build
	$(TOOLS)/bin/python -m build --quiet --outdir dist
	$(TOOLS)/bin/twine check --strict dist/*
	$(TOOLS)/bin/uv venv --quiet --clear --python $(PYTHON) out/wheel
	VIRTUAL_ENV=out/wheel $(TOOLS)/bin/uv pip install --quiet dist/*.whl
	out/wheel/bin/roughline about
	out/wheel/bin/python benchmarks/first_use.py

$(TOOLS)/installed:
	$(PYTHON) -m venv $(TOOLS)
	$(TOOLS)/bin/python -m pip install --quiet --disable-pip-version-check build twine uv
	touch $@

measured-figures: $(VENV)/installed
	$(BIN)/python docs/draw_measured.py

# Those of paper/paper.md, in a minute or two.
paper-figures: $(VENV)/installed
	$(BIN)/python paper/draw.py

architecture: $(VENV)/installed
	$(BIN)/python docs/draw_architecture.py

$(VENV)/installed: pyproject.toml requirements.lock
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "roughline needs Python 3.11 or newer; set PYTHON=...")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --editable .
	touch $@

clean:
	rm -rf $(VENV) out build dist
