# The jobs of a class, which wait for nothing: make keeps so many of them running as -j says. Paths come by the environment,
# since make would read more into them.
include class.mk
.PHONY: all $(JOBS)
.SUFFIXES:
all: $(JOBS)
$(JOBS):
	-@BATCH_ROW=$(ROW_$@) "$$BATCH_JOB" "$$BATCH_OUT" $(KIND) $@ $(THREADS) $(STAGE)
