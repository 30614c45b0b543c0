# urto, from a clone to results. `make demo` and `make test` install what is missing on Debian and its kin.

PREFIX  ?= /usr/local
URTO     = target/release/urto
# MPI is built in where the machine has it; URTO_MPI=no leaves it out.
FEATURES = $$(.ci/packages features)

.PHONY: demo test build mpi bench verify man install clean packages needed

demo: build            # runs the Taylor bar, a minute or two on two cores, and draws it
	@mkdir -p out
	$(URTO) run decks/taylor_bar.i --output out/taylor_bar
	$(URTO) view out/taylor_bar.e --output out/taylor_bar.png --variable EQPS --mirror xy
	$(URTO) view out/taylor_bar.e --output out/taylor_bar_cut.png --variable EQPS --mirror x
	@echo
	@echo "The print log     out/taylor_bar.o      text; the energy balance is at its end"
	@echo "The results       out/taylor_bar.e      EXODUS: open them with ParaView"
	@echo "The pictures      out/taylor_bar.png, and cut open: out/taylor_bar_cut.png"

test: packages         # every test; those over MPI too where the machine has it
	cargo test $(FEATURES)

build: needed          # the program, in target/release
	cargo build --release $(FEATURES)

mpi: needed            # the program with MPI, or the reason why not
	cargo build --release --features mpi

bench: needed          # times the kernels and the whole step beside the machine's bandwidth
	cargo bench

verify: needed         # the problems with known answers only, at full size, with what they found
	cargo test --release --test 'verif*' -- --nocapture --include-ignored

man: build             # man pages from the option table and the grammar
	$(URTO) generate man > man/urto.1
	$(URTO) generate man-deck > man/urto-deck.5
	$(URTO) generate man-mesh > man/urto-mesh.5

install: build         # program, man pages and completions, under PREFIX
	install -D $(URTO) $(DESTDIR)$(PREFIX)/bin/urto
	install -D -m 644 man/urto.1 $(DESTDIR)$(PREFIX)/share/man/man1/urto.1
	install -D -m 644 man/urto-deck.5 $(DESTDIR)$(PREFIX)/share/man/man5/urto-deck.5
	install -D -m 644 man/urto-mesh.5 $(DESTDIR)$(PREFIX)/share/man/man5/urto-mesh.5
	install -d $(DESTDIR)$(PREFIX)/share/bash-completion/completions
	$(URTO) generate bash > $(DESTDIR)$(PREFIX)/share/bash-completion/completions/urto

needed:
	@.ci/packages build

packages:
	@.ci/packages

clean:
	cargo clean
	rm -rf out
