# What every executable is built for: x86-64-v3, which has AVX2 and fused products (Intel since 2013, AMD since 2015), unless this
# machine has not. All takes four fifths of the time of a build for any x86-64 processor, half of which is gained by products that the
# compiler fuses: a b - c d of equal products may be other than 0. It is one build for all of these processors, for kernels chosen at run
# time would gain less and make last digits depend on the machine.
include(CheckCXXSourceRuns)

set(VARIMAP_PROCESSOR "" CACHE STRING
  "Processors to build for, a value of -march: x86-64 is any, native this one alone; empty: x86-64-v3, or any where this is none such")

set(processor ${VARIMAP_PROCESSOR})
if(NOT processor AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") && __builtin_cpu_supports(\"bmi2\") ? 0 : 1; }"
    VARIMAP_RUNS_X86_64_V3)
  if(VARIMAP_RUNS_X86_64_V3)
    set(processor x86-64-v3)
  else()
    message(STATUS "This processor has no AVX2: built for any x86-64 one, a quarter slower")
  endif()
endif()
if(processor)
  # Users too: Eigen aligns memory as wide as the processor's registers.
  target_compile_options(varimap_core PUBLIC -march=${processor})
  target_compile_options(varimap_precompiled PRIVATE -march=${processor})
endif()
