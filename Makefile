# Every target sets up what it needs: uv beside the checkout, an environment in .venv, pinned versions from constraints.txt.
UV_VERSION := 0.13.8
UV := .tools/bin/uv
BIN := .venv/bin
# What Python makes of the sources is kept, whatever the environment says, and apart from them: tests start many processes.
export PYTHONDONTWRITEBYTECODE :=
export PYTHONPYCACHEPREFIX := $(CURDIR)/.tools/bytecode
INSTALL := $(UV) pip install -q --python .venv --constraint constraints.txt

# What `make fuzz` tries: another seed makes other cases; MINUTES for each kind; KINDS names some of them.
SEED := 0
MINUTES := 1
KINDS :=

.PHONY: help demo test check reasoners sim wheel fuzz peers bench editors accept lock clean

help:            ## say what there is
	@grep -hE '^[a-z]+: .*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):[^#]*## /  make \1\t/'

demo: .venv/.runtime  ## two robots wipe two surfaces with one skill
	$(BIN)/skillc demo --out out/demo

test: .venv/.dev ## the fast tests
	$(BIN)/pytest -n 2 --dist worksteal

check: .venv/.dev ## style, types, import rules
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/skillc fmt --check skills_src
	$(BIN)/mypy
	$(BIN)/lint-imports

reasoners: .venv/.dev ## what tools of others find in ontology, scenes, descriptions and domains (some need Java)
	$(BIN)/pytest -m reasoner -n 2

sim: .venv/.dev  ## whole tasks on both arms, in simulation
	$(BIN)/pytest -m sim -n 2

wheel: .venv/.dev ## build the wheel and use it in a clean environment
	$(BIN)/pytest -m wheel

fuzz: .venv/.dev ## random input of each kind for MINUTES=1 with SEED=0; inputs that break a promise are kept in out/fuzz
	PYTHONPATH=tests $(BIN)/python -m fuzz $(KINDS) --seed $(SEED) --minutes $(MINUTES)

peers: .venv/.dev ## all trees in the BehaviorTree.CPP whose checkout is BTCPP=DIR (needs CMake and a C++ compiler)
	cmake -S tests/peers -B build/peers -D BTCPP=$(abspath $(BTCPP))
	cmake --build build/peers --target load_trees --parallel 2
	PYTHONPATH=tests:tests/compiler $(BIN)/python -m peers build/peers/load_trees

bench: .venv/.dev ## benchmarks; each prints ratios
	for file in benchmarks/[a-z]*.py; do echo "== $$file"; $(BIN)/python $$file || exit 1; done

editors:         ## the extension for VS Code, as editors/vscode/dist/skillc.vsix (needs Node 20)
	cd editors/vscode && npm ci --ignore-scripts && npm test && npm run package

accept: .venv/.dev ## rewrite the expected artifacts of tests/cases/build
	$(BIN)/python tests/accept.py

lock: .tools/.uv ## pin every version anew
	$(UV) pip compile -q --universal --python-version 3.11 --all-extras --no-emit-index-url --no-header --no-annotate \
	    --upgrade pyproject.toml -o constraints.txt

clean:           ## remove the environment and all output
	rm -rf .venv .tools build dist out

.tools/.uv: Makefile
	python3 -m pip install -q --disable-pip-version-check --root-user-action ignore --upgrade --target .tools uv==$(UV_VERSION)
	@touch $@

.venv/.created: .tools/.uv
	test -d .venv || $(UV) venv -q --python python3 .venv
	@touch $@

.venv/.runtime: pyproject.toml constraints.txt .venv/.created
	$(INSTALL) -e '.[planner,motion,video,editor]'
	@touch $@

# What the tests import is compiled once, on all cores; else each of their processes does it. Some files are for other Pythons.
.venv/.dev: .venv/.runtime
	$(INSTALL) -e '.[planner,temporal,motion,fast,video,editor,dev]'
	$(BIN)/python -m compileall -qq -j 0 .venv/lib || true
	@touch $@
