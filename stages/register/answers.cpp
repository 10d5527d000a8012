#include "stages/register/answers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/core/statistics.h"
#include "varimap/landmarks/landmark_points.h"

namespace varimap {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Vec3 middle_position(const std::vector<Vec3>& positions) {
    Vec3 result;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (const Vec3& position : positions) values.push_back(position[axis]);
        result[axis] = mean_median(std::move(values));
    }
    return result;
}

double mean_probability(const std::vector<Answer>& answers) {
    double sum = 0;
    for (const Answer& answer : answers) sum += answer.probability;
    return sum / double(answers.size());
}

}  // namespace

Points corresponding_points(const std::vector<Answer>& answers) {
    const Correspondence& first = answers.front().map;
    // Of several templates the first may be the specimen's only one, or not map it at all: count by the maps.
    const std::size_t vertices =
        answers.front().from_first.empty() ? first.there.size() : answers.front().from_first.size();
    std::vector<PointCarrier> carriers;
    carriers.reserve(answers.size());
    for (const Answer& answer : answers)
        carriers.emplace_back(answer.map.from, answer.map.there, answer.map.to);
    const ClosestPoint closest(first.to);
    Points points = Points::Constant(Eigen::Index(vertices), 3, nan);
    for (std::size_t v = 0; v < vertices; ++v) {
        std::vector<Vec3> found;
        for (std::size_t k = 0; k < answers.size(); ++k) {
            const Answer& answer = answers[k];
            const SurfacePoint image = answer.from_first.empty()       ? answer.map.there[v]
                                       : answer.from_first[v].face < 0 ? SurfacePoint{}
                                                                       : carriers[k](answer.from_first[v]);
            if (image.face >= 0) found.push_back(position(answer.map.to, image));
        }
        if (found.empty()) continue;
        Vec3 place = middle_position(found);
        if (found.size() > 1) place = position(first.to, closest(place).point);
        points.row(Eigen::Index(v)) = place.transpose();
    }
    return points;
}

TransferredLandmarks transfer_landmarks(const std::vector<Answer>& answers,
                                        const std::vector<PointMap>& landmarks) {
    const auto count = Eigen::Index(landmarks.front().size());
    TransferredLandmarks result{Points::Constant(count, 3, nan), Eigen::VectorXd::Constant(count, nan),
                                Eigen::VectorXd::Constant(count, nan), Eigen::VectorXd::Zero(count)};
    const TriangleMesh& specimen = answers.front().map.to;
    const ClosestPoint closest(specimen);
    std::vector<std::vector<Vec3>> found{std::size_t(count)};
    std::vector<std::vector<double>> returns{std::size_t(count)};
    for (std::size_t k = 0; k < answers.size(); ++k) {
        const Correspondence& map = answers[k].map;
        const PointCarrier there(map.from, map.there, map.to), back(map.to, map.back, map.from);
        const double unit = std::sqrt(surface_area(map.from));
        for (std::size_t i = 0; i < std::size_t(count); ++i) {
            const SurfacePoint& landmark = landmarks[k][i];
            const SurfacePoint image = landmark.face < 0 ? landmark : there(landmark);
            if (image.face < 0) continue;
            found[i].push_back(position(map.to, image));
            const SurfacePoint returned = back(image);
            if (returned.face >= 0)
                returns[i].push_back((position(map.from, returned) - position(map.from, landmark)).norm() /
                                     unit);
        }
    }
    const double unit = std::sqrt(surface_area(specimen)), probability = mean_probability(answers);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto& places = found[std::size_t(i)];
        if (places.empty()) continue;
        Vec3 place = middle_position(places);
        if (places.size() > 1) place = position(specimen, closest(place).point);
        double squares = 0;
        for (const Vec3& one : places) squares += (one - place).squaredNorm() / double(places.size());
        result.positions.row(i) = place.transpose();
        result.spread[i] = std::sqrt(squares) / unit;
        if (returns[std::size_t(i)].empty()) continue;
        result.round_trip[i] = mean_median(returns[std::size_t(i)]);
        const double deviation = std::hypot(result.round_trip[i], result.spread[i]) / far_from_surface;
        result.confidence[i] = probability / (1 + deviation * deviation);
    }
    return result;
}

}  // namespace varimap
