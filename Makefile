# The two commands of the README, and what developers add to them. Needs Python >= 3.11 and make.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
STATIONS := $(VENV)/.stations

.PHONY: demo docs gallery test coverage stations-full bench validate theory-figures validate-flightgear flightgear-pictures \
	hostile faults fuzz mutants inner-loops lint format schema golden clean

demo: $(READY)  ## Fly the paper on a point mass and on a JSBSim F-16, compare, report
	$(BIN)/ftc-jsb compare paper

test: lint $(STATIONS)  ## Every check
	$(BIN)/pytest -n 2

# Without the compiler a flight takes some hundred times as long: tests that fly long or often are left out,
# and tests/conftest.py skips long flights of the others.
FLY_LONG := analysis/test_consistency.py bench benchmarks control/test_robust.py disturbance/test_sensors.py docs \
	disturbance/test_wind.py export flightgear identify inner_loop_design margins mavlink/telemetry/test_flight_events.py \
	mavlink/commands/test_failure_command.py mavlink/test_hostile.py mavlink/test_live.py mavlink/test_mavproxy.py \
	mavlink/test_mavsdk.py mavlink/test_tlog.py mavlink/test_two_vehicles.py point_mass/test_plant.py \
	regression report/page/test_browser.py report/test_figures.py simulation/test_batch.py simulation/test_commands.py \
	simulation/test_fly.py simulation/test_pacing.py six_dof/test_faults.py test_readme.py theory/test_joint_filter.py
FLY_LONG_TESTS := airspeed_is_kept or ctrl_c_saves or own_loop_flies or set_points_by_command

docs: $(READY)  ## The site of the documentation, notebooks executed, links checked, in build/site
	$(BIN)/ftc-jsb warm --quiet
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict
	@echo "The site: build/site/index.html; with its search: $(BIN)/python -m http.server --directory build/site"

# The pictures of docs/gallery.md that no other target draws.
GALLERY := build/gallery
gallery: $(READY)  ## Fly and draw pictures of docs/gallery.md; the report's wants chromium
	for name in paper severe speed-first helix; do \
		$(BIN)/ftc-jsb compare $$name --out $(GALLERY)/$$name --force || exit 1; done
	$(BIN)/ftc-jsb compare turbulence --set 'compare.loops=["robust"]' --out $(GALLERY)/turbulence --force
	chromium --headless --no-sandbox --hide-scrollbars --window-size=1280,1100 --virtual-time-budget=5000 \
		--screenshot=docs/images/gallery/report.png file://$(CURDIR)/$(GALLERY)/paper/report.html
	cp $(GALLERY)/paper/figures/figure1_states.png docs/images/states.png
	cp $(GALLERY)/severe/figures/tracking_errors.png docs/images/gallery/severe_errors.png
	cp $(GALLERY)/speed-first/figures/figure1_states.png docs/images/gallery/speed-first_states.png
	cp $(GALLERY)/turbulence/figures/figure4_effectiveness.png docs/images/gallery/turbulence_effectiveness.png
	cp $(GALLERY)/helix/figures/figure3_trajectories.png docs/images/gallery/helix_trajectories.png

coverage: $(READY)  ## Lines of ftc_jsb that tests run, kernels included: the compiler is switched off
	NUMBA_DISABLE_JIT=1 $(BIN)/pytest -n 2 --cov --cov-report=term $(FLY_LONG:%=--ignore=tests/%) -k "not ($(FLY_LONG_TESTS))"

stations-full: $(READY)  ## MAVProxy with its maps, 0.75 GB more
	$(BIN)/python -m pip install --quiet --editable ".[dev,stations-full]" --constraint constraints.txt

bench: $(READY)  ## Cost of steps, flights and commands, against the targets
	$(BIN)/ftc-jsb bench
	$(BIN)/pytest -n 0 tests/benchmarks --benchmark-enable

validate: $(READY)  ## Long flights and many flights; writes docs/validation.md
	$(BIN)/python -m validation

inner-loops: $(READY)  ## Fly and judge every inner loop's steps: table and figures of docs/aircraft.md
	$(BIN)/ftc-jsb inner-loop f16 f15 F4N A4 T38 --report --out docs/images/inner-loop --force

theory-figures: $(READY)  ## Fly the systems of docs/theory.md and draw its figures
	for name in levitator reactor vessel; do \
		$(BIN)/ftc-jsb theory $$name --out build/theory-$$name --force && \
		cp build/theory-$$name/theory.png docs/images/theory_$$name.png || exit 1; done

# FlightGear with its data is 1.8 GB. What is there already is not installed again.
FLIGHTGEAR := flightgear xvfb dbus x11-apps imagemagick
ROOT := $(if $(filter 0,$(shell id -u)),,sudo)

validate-flightgear: $(READY)  ## The real FlightGear, flown by the outer loop, 7 minutes
	dpkg-query -W $(FLIGHTGEAR) > /dev/null 2>&1 || \
		{ $(ROOT) apt-get update && $(ROOT) apt-get install --yes --no-install-recommends $(FLIGHTGEAR); }
	$(BIN)/python -m validation.flightgear

flightgear-pictures: $(READY)  ## The pictures of docs/flightgear.md, by the real FlightGear
	$(BIN)/python -m validation.flightgear --pictures docs/images/flightgear

hostile: $(READY)  ## A million hostile frames on the MAVLink vehicle, some minutes
	FTC_JSB_HOSTILE=1000000 $(BIN)/pytest -n 0 tests/mavlink/test_hostile.py

FAULTS ?= 1
faults: $(READY)  ## Every write, rename and fsync of four commands fails once, in three ways; hours. FAULTS=20: every 20th
	FTC_JSB_FAULTS=$(FAULTS) $(BIN)/pytest -n 0 -s tests/reliability/test_injected_faults.py

CASES ?= 100000
fuzz: $(READY)  ## CASES hostile files or messages at every door; hours with all 100,000
	FTC_JSB_FUZZ=$(CASES) $(BIN)/pytest -n 2 tests/reliability/test_fuzz.py

SAMPLE ?= 0
mutants: $(READY)  ## Changes of law, filter, detector, verdict and link parser, and whether tests notice; hours. SAMPLE=12
	$(BIN)/python -m pip install --quiet --editable ".[mutants]" --constraint constraints.txt
	$(BIN)/python -m validation.mutants --sample $(SAMPLE)

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: $(READY)
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

schema: $(READY)  ## Write the JSON Schemas that the shipped files name
	$(BIN)/ftc-jsb schema scenario > scenarios/schema/scenario.json
	$(BIN)/ftc-jsb schema campaign > scenarios/schema/campaign.json

golden: $(READY)  ## Rewrite the golden flights and figures; say why in the commit
	$(BIN)/pytest -n 0 tests/regression tests/report/test_figures.py --rewrite-golden

$(READY): pyproject.toml constraints.txt
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "ftc-jsb needs Python 3.11 or later; try make PYTHON=python3.12")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip --constraint constraints.txt
	$(BIN)/python -m pip install --quiet --editable . --constraint constraints.txt
	# The kernels are compiled while the tools of developers are fetched.
	PYTHONPATH=$(CURDIR) $(BIN)/python -m ftc_jsb warm & \
	$(BIN)/python -m pip install --quiet --editable ".[dev]" --constraint constraints.txt; status=$$?; wait; exit $$status
	touch $@

# MAVProxy's own requirements include its maps' vtk and opencv; what it needs besides is in the extra.
$(STATIONS): $(READY)
	$(BIN)/python -m pip install --quiet --editable ".[dev,stations]" --constraint constraints.txt
	$(BIN)/python -m pip install --quiet --no-deps mavproxy --constraint constraints.txt
	touch $@

clean:
	rm -rf $(VENV) build dist .coverage* .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
