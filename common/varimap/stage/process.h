#pragma once

namespace varimap {

/// Threads this process may use: its CPU affinity, and no more than SLURM_CPUS_PER_TASK where that is set.
int available_threads();

/// Since the process started, of all its threads: CPU time, and the most memory it held.
double cpu_seconds();
double peak_megabytes();

}  // namespace varimap
