#include "stages/cycles/collection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "varimap/artifact/artifact.h"
#include "varimap/core/error.h"
#include "varimap/core/parallel.h"
#include "varimap/results/choice.h"

namespace varimap {
namespace {

/// Per point of the first, the number of the nearest of the second.
std::vector<int> nearest(const Points& points, const Points& to) {
    std::vector<int> found(std::size_t(points.rows()));
    parallel_for_each_index(found.size(), std::size_t(64), [&](std::size_t v) {
        (to.rowwise() - points.row(Eigen::Index(v))).rowwise().squaredNorm().minCoeff(&found[v]);
    });
    return found;
}

Points positions(const PointPairs& pairs, const TriangleMesh& mesh, double unit, bool of_images) {
    Points points(Eigen::Index(pairs.size()), 3);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        points.row(Eigen::Index(i)) =
            position(mesh, of_images ? pairs[i].second : pairs[i].first).transpose() / unit;
    return points;
}

class Reader {
  public:
    explicit Reader(const std::string& path) {
        try {
            const auto manifest = nlohmann::json::parse(read_file(path));
            for (const auto& [name, file] : manifest.at("surfaces").items()) add_surface(name, file);
            for (const auto& pair : manifest.at("pairs"))
                add_pair(pair.at("name"), pair.at("source"), pair.at("target"), pair.at("candidates"));
        } catch (const nlohmann::json::exception& error) {
            throw InputError(path + ": not a manifest of varimap batch: " + error.what());
        }
    }
    Collection collection;

  private:
    void add_surface(const std::string& name, const std::string& file) {
        number_[name] = int(meshes_.size());
        meshes_.push_back(read_artifact<Surface>(file).value.input);
        units_.push_back(std::sqrt(surface_area(meshes_.back())));
        collection.surfaces.push_back(name);
        collection.samples.emplace_back();
        collection.sketches.push_back(file);
    }
    /// The vertices of its sketch, which are the same in all maps.
    void keep_samples(int surface, const PointPairs& from, const std::string& path) {
        const auto s = std::size_t(surface);
        const Points points = positions(from, meshes_[s], units_[s], false);
        Points& known = collection.samples[s];
        if (known.rows() == 0) known = points;
        if (known.rows() != points.rows() || known != points)
            throw ArtifactError(path +
                                ": made from another sketch than the other candidates; run the batch again");
    }
    void add_pair(const std::string& name, const std::string& source, const std::string& target,
                  const std::string& file) {
        if (!number_.contains(source) || !number_.contains(target))
            throw InputError(name + ": one of its surfaces is not in the manifest");
        PairOfMaps pair{number_[source], number_[target], {}, false};
        const auto a = std::size_t(pair.source), b = std::size_t(pair.target);
        const Candidates found = read_artifact<Candidates>(file).value;
        if (found.maps.empty()) throw ArtifactError(file + ": no candidates");
        require_surfaces(found, meshes_[a], meshes_[b]);
        for (const Correspondences& map : found.maps) {
            keep_samples(pair.source, map.from_A, file);
            keep_samples(pair.target, map.from_B, file);
        }
        // Nearest vertices of the sketches, which all maps of a surface share.
        for (const Correspondences& map : found.maps)
            pair.maps.push_back(
                {nearest(positions(map.from_A, meshes_[b], units_[b], true), collection.samples[b]),
                 nearest(positions(map.from_B, meshes_[a], units_[a], true), collection.samples[a]), 0});
        const auto probable = probabilities(found.list, kinds(pair.maps, collection.samples[b]));
        for (std::size_t k = 0; k < pair.maps.size(); ++k) pair.maps[k].probability = probable[k];
        for (std::size_t k = pair.maps.size(); --k > 0;)
            if (is_mirrored(found.list[k])) pair.maps.erase(pair.maps.begin() + std::ptrdiff_t(k));
        pair.sure = confidence_of(found.list).confident;
        collection.names.push_back(name);
        collection.pairs.push_back(std::move(pair));
    }
    std::map<std::string, int> number_;
    std::vector<TriangleMesh> meshes_;
    std::vector<double> units_;
};

}  // namespace

std::vector<double> probabilities(const std::vector<Candidate>& candidates,
                                  const std::vector<std::size_t>& kind) {
    // Scores mislead now and then, by much: a share of the probability is the same for all kinds.
    constexpr double misled = .3;  // chosen on generated families
    std::vector<double> weight, of_kind(kind.size(), 0), best(kind.size(), 0);
    for (std::size_t k = 0; k < kind.size(); ++k) {
        weight.push_back(
            is_mirrored(candidates[k]) ? 0 : std::exp(candidates.front().score - candidates[k].score));
        of_kind[kind[k]] += weight[k];
        best[kind[k]] = std::max(best[kind[k]], weight[k]);
    }
    const double sum = std::accumulate(best.begin(), best.end(), 0.),
                 count = double(std::ranges::count_if(best, [](double w) { return w > 0; }));
    std::vector<double> result;
    for (std::size_t k = 0; k < kind.size(); ++k) {
        const double share = (1 - misled) * best[kind[k]] / sum + misled / count;
        result.push_back(
            weight[k] > 0 ? plausibility(candidates.front()) * share * weight[k] / of_kind[kind[k]] : 0);
    }
    return result;
}

PointMap on_files(const SampledMap& map, const Surface& source, const Surface& target) {
    Points samples(Eigen::Index(source.on_input.size()), 3);
    for (std::size_t i = 0; i < source.on_input.size(); ++i)
        samples.row(Eigen::Index(i)) = position(source.input, source.on_input[i]).transpose();
    const auto near = nearest(source.input.vertices, samples);
    PointMap images(near.size());
    for (std::size_t v = 0; v < near.size(); ++v)
        images[v] = target.on_input[std::size_t(map.there[std::size_t(near[v])])];
    return to_file(std::move(images), source, target);
}

Collection Collection::read(const std::string& manifest) {
    return Reader(manifest).collection;
}

}  // namespace varimap
