#include "varimap/multilevel/wasserstein_centres.h"

namespace varimap {

Centres wasserstein_centres(const LevelPair& pair, const PairContext& context,
                            const AlternationOptions& options) {
    const RowMatrix a = sample_positions(context.A().surface, pair.A.level);
    const RowMatrix b = sample_positions(context.B().surface, pair.B.level);
    Coupling plan;
    plan.support = Support::dense(int(a.rows()), int(b.rows()));
    Eigen::VectorXd cost(plan.support.entries());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        for (Eigen::Index j = 0; j < b.rows(); ++j)
            cost[i * b.rows() + j] = (a.row(i) - b.row(j)).squaredNorm();
    Potentials potentials = Potentials::zero(int(a.rows()), int(b.rows()));
    const TransportProblem problem{plan.support,
                                   cost,
                                   pair.A.side.mass,
                                   pair.B.side.mass,
                                   cost.maxCoeff() / options.gamma_divisor,
                                   cost.maxCoeff() * options.background_factor};
    sinkhorn(problem, {options.marginal_tolerance, options.sinkhorn_iterations}, potentials, plan);
    return update_centres(pair.A.side, pair.B.side, plan).centres;
}

}  // namespace varimap
