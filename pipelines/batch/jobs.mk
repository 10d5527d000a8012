# The jobs of a class, which wait for nothing: make keeps so many of them running as -j says.
include $(JOBS_FILE)
.PHONY: all $(JOBS)
.SUFFIXES:
all: $(JOBS)
$(JOBS):
	-@$(JOB) "$(OUT)" $(KIND) $@ $(THREADS) $(STAGE)
