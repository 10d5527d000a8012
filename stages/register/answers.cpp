#include "stages/register/answers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "varimap/core/parallel.h"
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

/// The place that answers agree on best; `closest`: on the specimen.
Vec3 agreed_place(const std::vector<Vec3>& places, const ClosestPoint& closest,
                  const TriangleMesh& specimen) {
    const Vec3 middle = middle_position(places);
    return places.size() > 1 ? position(specimen, closest(middle).point) : middle;
}

/// What the answers say of one landmark.
struct Opinions {
    std::vector<Vec3> places;     ///< on the specimen
    std::vector<double> returns;  ///< from it to its image's image on the template, in units of sqrt(area)
};

std::vector<Opinions> opinions_of(const std::vector<Answer>& answers,
                                  const std::vector<PointMap>& landmarks) {
    std::vector<Opinions> result(landmarks.front().size());
    for (std::size_t k = 0; k < answers.size(); ++k) {
        const Correspondence& map = answers[k].map;
        const PointCarrier there(map.from, map.there, map.to), back(map.to, map.back, map.from);
        const double unit = std::sqrt(surface_area(map.from));
        for (std::size_t i = 0; i < result.size(); ++i) {
            const SurfacePoint& landmark = landmarks[k][i];
            const SurfacePoint image = landmark.face < 0 ? landmark : there(landmark);
            if (image.face < 0) continue;
            result[i].places.push_back(position(map.to, image));
            const SurfacePoint returned = back(image);
            if (returned.face >= 0)
                result[i].returns.push_back(
                    (position(map.from, returned) - position(map.from, landmark)).norm() / unit);
        }
    }
    return result;
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
    parallel_for_each_index(vertices, std::size_t(256), [&](std::size_t v) {
        std::vector<Vec3> found;
        for (std::size_t k = 0; k < answers.size(); ++k) {
            const Answer& answer = answers[k];
            const SurfacePoint image = answer.from_first.empty()       ? answer.map.there[v]
                                       : answer.from_first[v].face < 0 ? SurfacePoint{}
                                                                       : carriers[k](answer.from_first[v]);
            if (image.face >= 0) found.push_back(position(answer.map.to, image));
        }
        if (!found.empty()) points.row(Eigen::Index(v)) = agreed_place(found, closest, first.to).transpose();
    });
    return points;
}

TransferredLandmarks transfer_landmarks(const std::vector<Answer>& answers,
                                        const std::vector<PointMap>& landmarks) {
    const auto count = Eigen::Index(landmarks.front().size());
    TransferredLandmarks result{Points::Constant(count, 3, nan), Eigen::VectorXd::Constant(count, nan),
                                Eigen::VectorXd::Constant(count, nan), Eigen::VectorXd::Zero(count)};
    const std::vector<Opinions> said = opinions_of(answers, landmarks);
    const TriangleMesh& specimen = answers.front().map.to;
    const ClosestPoint closest(specimen);
    const double unit = std::sqrt(surface_area(specimen)), probability = mean_probability(answers);
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto& [places, returns] = said[std::size_t(i)];
        if (places.empty()) continue;
        const Vec3 place = agreed_place(places, closest, specimen);
        double squares = 0;
        for (const Vec3& one : places) squares += (one - place).squaredNorm() / double(places.size());
        result.positions.row(i) = place.transpose();
        result.spread[i] = std::sqrt(squares) / unit;
        if (returns.empty()) continue;
        result.round_trip[i] = mean_median(returns);
        const double deviation = std::hypot(result.round_trip[i], result.spread[i]) / far_from_surface;
        result.confidence[i] = probability / (1 + deviation * deviation);
    }
    return result;
}

}  // namespace varimap
