#include "varimap/multilevel/descent.h"

#include <algorithm>
#include <utility>

#include "varimap/core/error.h"
#include "varimap/core/log.h"

namespace varimap {

namespace {

/// Appends a row to the trace and writes it to the log.
class Recorder {
  public:
    Recorder(const LevelPair& pair, int level_index, Trace& trace) : trace_(trace) {
        row_.level = level_index;
        row_.euclidean = pair.A.level.kind == LevelKind::euclidean;
        row_.iteration = -1;
        row_.samples_A = int(pair.A.level.samples.size());
        row_.samples_B = int(pair.B.level.samples.size());
    }

    void operator()(const Alternation& step) {
        ++row_.iteration;
        row_.sinkhorn_iterations = step.sinkhorn.iterations;
        row_.entries = step.entries;
        row_.gamma = step.gamma;
        row_.energy = step.energy;
        row_.marginal_error = step.sinkhorn.marginal_error;
        trace_.push_back(row_);
        log("level {} ({}, {} x {}) iteration {}: energy {:.6g}, {} entries, {} Sinkhorn iterations, "
            "marginal error {:.2g}",
            row_.level, row_.euclidean ? "Euclidean" : "diffusion", row_.samples_A, row_.samples_B,
            row_.iteration, row_.energy, step.entries, row_.sinkhorn_iterations, row_.marginal_error);
    }

  private:
    TraceRow row_;
    Trace& trace_;
};

}  // namespace

Descent::Descent(const PairContext& context, const AlternationOptions& alternation,
                 const IroningOptions& ironing)
    : context_(context), alternation_(alternation), ironing_(context, ironing) {}

int Descent::resume(const std::vector<int>& samples_A, const std::vector<int>& samples_B,
                    const std::string& stage) {
    const int index = context_.find_diffusion_level(samples_A, samples_B);
    if (index < 0)
        throw ArtifactError("the plan's samples are not those of a level of these hierarchies; rerun " +
                            stage);
    resumed_ = context_.diffusion_cells(index);
    return index;
}

void Descent::enter(LevelPair level) {
    const LevelPair coarse = std::exchange(level_, std::move(level));
    switch_.reset();
    if (resumed_)
        switch_.emplace(resumed_->A, resumed_->B, level_);
    else if (!coarse.A.level.samples.empty())
        switch_.emplace(coarse.A.level, coarse.B.level, level_);
    resumed_.reset();
}

int Descent::samples() const {
    return int(std::min(level_.A.level.samples.size(), level_.B.level.samples.size()));
}

Start Descent::hand_down(const Coupling& coarse_plan) const {
    return switch_->hand_down(coarse_plan, alternation_.support_threshold);
}

AlternatingMinimization Descent::settled(const Start& start, const Observer& observe) const {
    return settled(start, level_.partners, observe);
}

AlternatingMinimization Descent::settled(const Start& start, const Partners& partners,
                                         const Observer& observe) const {
    AlternatingMinimization minimization(level_.A.side, level_.B.side, alternation_, partners);
    minimization.start(start.centres, start.kept);
    minimization.run(observe);
    return minimization;
}

Solution TracedDescent::solve(const Start& start, const Task& task) {
    Recorder record(level(), task.index, trace_);
    const auto observe = [&](const Alternation& step) { record(step); };
    AlternatingMinimization minimization = settled(start, observe);
    if (task.ironed) ironing().iron(level(), minimization, observe);
    if (task.last) observe(minimization.tight_step());
    return minimization.take_solution();
}

}  // namespace varimap
