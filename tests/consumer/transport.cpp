#include <varimap/transport/sinkhorn.h>

#include <cmath>
#include <cstdio>

/// Two points of equal mass onto themselves: half of the mass lies on the diagonal, up to what is blurred.
int main() {
    const varimap::Support support = varimap::Support::dense(2, 2);
    const Eigen::Vector4d entries(0, 1, 1, 0);
    const Eigen::VectorXd cost = entries, mass = Eigen::Vector2d(0.5, 0.5);
    varimap::Potentials potentials = varimap::Potentials::zero(2, 2);
    varimap::Coupling plan;
    plan.support = support;
    varimap::sinkhorn({support, cost, mass, mass, 0.2, 2}, {1e-12, 1000}, potentials, plan);
    const double diagonal = plan.value[0] + plan.row_background[0] * plan.column_background[0];
    const double expected = 0.5 / (1 + std::exp(-1 / 0.2));  // of m_i n_j exp((f_i + g_j - c_ij) / gamma)
    std::printf("%.12f on the diagonal, %.12f expected\n", diagonal, expected);
    return std::abs(diagonal - expected) < 1e-9 ? 0 : 1;
}
