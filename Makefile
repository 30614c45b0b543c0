# urto, from a clone to results. `make demo` and `make test` install what is missing on Debian and its kin.

PREFIX  ?= /usr/local
URTO     = target/release/urto
# MPI is built in where the machine has it; URTO_MPI=no leaves it out.
FEATURES = $$(.ci/packages features)

.PHONY: demo test build mpi vendored bench scale trade decompositions verify man install clean packages needed

demo: build            # crushes a can under a plate, half a minute on two cores, and draws it
	@mkdir -p out
	$(URTO) run decks/can_crush.i --output out/can_crush
	$(URTO) view out/can_crush.e --output out/can_crush.png --variable EQPS --mirror y --from front --time 3.2e-3
	$(URTO) view out/can_crush.e --output out/can_crush.gif --variable EQPS --mirror y --from front --animate --size 800x600
	@echo
	@echo "The print log     out/can_crush.o       text; the energy balance is at its end"
	@echo "The results       out/can_crush.e       EXODUS: open them with ParaView"
	@echo "The picture       out/can_crush.png     the can after 3.2 ms"
	@echo "The animation     out/can_crush.gif     the whole crush"

test: packages         # every test; those over MPI too where the machine has it
	cargo test $(FEATURES)

build: needed          # the program, in target/release
	cargo build --release $(FEATURES)

mpi: needed            # the program with MPI, or the reason why not
	cargo build --release --features mpi

vendored:              # the program with netCDF and HDF5 in it, which needs no library of the system
	@.ci/packages vendored
	cargo build --release --features vendored

bench: needed          # times the kernels and the whole step beside the machine's bandwidth
	cargo bench

# A study is priced for both machines; out/*.csv has the numbers.
STUDY = $(URTO) scale --ranks $(RANKS) --steps $(STEPS)
RANKS = 1,2,4,8,16,32,64,128,256
STEPS = 50

scale: build           # the scaling studies of docs/performance.md: what hundreds of ranks would do, and what it would cost
	@mkdir -p out
	for machine in paragon cluster; do \
	  in="--machine $$machine --csv out/$$machine"; \
	  $(STUDY) $${in}_beam.csv decks/bending_beam.i && \
	  $(STUDY) $${in}_beam_scaled.csv --scaled decks/bending_beam_scaled.i && \
	  $(STUDY) $${in}_wall.csv decks/brick_wall.i && \
	  $(STUDY) $${in}_wall_scaled.csv --scaled decks/brick_wall.i --mesh meshes/brick_wall_scaled.mesh && \
	  $(STUDY) $${in}_can.csv decks/can_crush_paper.i && \
	  $(STUDY) $${in}_can_scaled.csv --scaled decks/can_crush_paper.i --mesh meshes/can_crush_scaled.mesh || exit 1; \
	done

trade: build           # the fronts of docs/trade.md: what each knob costs and gains on some decks
	.ci/trade $(URTO) out/trade

decompositions: build  # contact shared out by bisection, in slices and with the elements, as docs/performance.md compares them
	@mkdir -p out
	for machine in paragon cluster; do for way in rcb slices static; do \
	  in="--ranks 16,64,256 --machine $$machine --decomposition $$way --csv out/$$machine"; \
	  $(URTO) scale $${in}_wall_$$way.csv decks/brick_wall.i && \
	  $(URTO) scale $${in}_can_$$way.csv decks/can_crush_paper.i || exit 1; \
	done; done

verify: needed         # the problems with known answers only, at full size, with what they found
	cargo test --release --test 'verification_*' -- --nocapture --include-ignored

man: build             # man pages from the option table and the grammar
	$(URTO) generate man > man/urto.1
	$(URTO) generate man-deck > man/urto-deck.5
	$(URTO) generate man-mesh > man/urto-mesh.5

install: build         # program, man pages and completions for bash, zsh and fish, under PREFIX
	install -D $(URTO) $(DESTDIR)$(PREFIX)/bin/urto
	install -D -m 644 man/urto.1 $(DESTDIR)$(PREFIX)/share/man/man1/urto.1
	install -D -m 644 man/urto-deck.5 $(DESTDIR)$(PREFIX)/share/man/man5/urto-deck.5
	install -D -m 644 man/urto-mesh.5 $(DESTDIR)$(PREFIX)/share/man/man5/urto-mesh.5
	install -d $(DESTDIR)$(PREFIX)/share/bash-completion/completions
	$(URTO) generate bash > $(DESTDIR)$(PREFIX)/share/bash-completion/completions/urto
	install -d $(DESTDIR)$(PREFIX)/share/zsh/site-functions
	$(URTO) generate zsh > $(DESTDIR)$(PREFIX)/share/zsh/site-functions/_urto
	install -d $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d
	$(URTO) generate fish > $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d/urto.fish

needed:
	@.ci/packages build

packages:
	@.ci/packages

clean:
	cargo clean
	rm -rf out
