#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "stages/cycles/choice.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"
#include "varimap/mesh/surface.h"
#include "varimap/results/candidates.h"
#include "varimap/stage/stage_main.h"

namespace {

using namespace varimap;

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
    std::vector<std::string> names;
    std::vector<PairOfMaps> pairs;
    Samples samples;

  private:
    void add_surface(const std::string& name, const std::string& file) {
        number_[name] = int(meshes_.size());
        meshes_.push_back(read_artifact<Surface>(file).value.input);
        units_.push_back(std::sqrt(surface_area(meshes_.back())));
        samples.emplace_back();
    }
    /// The vertices of its sketch, which are the same in all maps.
    void keep_samples(int surface, const PointPairs& from, const std::string& path) {
        const auto s = std::size_t(surface);
        const Points points = positions(from, meshes_[s], units_[s], false);
        if (samples[s].rows() == 0) samples[s] = points;
        if (samples[s].rows() != points.rows() || samples[s] != points)
            throw ArtifactError(path +
                                ": made from another sketch than the other candidates; run the batch again");
    }
    void add_pair(const std::string& name, const std::string& source, const std::string& target,
                  const std::string& file) {
        if (!number_.contains(source) || !number_.contains(target))
            throw InputError(name + ": one of its surfaces is not in the manifest");
        PairOfMaps pair{number_[source], number_[target], {}, 0};
        const auto a = std::size_t(pair.source), b = std::size_t(pair.target);
        const Candidates found = read_artifact<Candidates>(file).value;
        if (found.maps.empty()) throw ArtifactError(file + ": no candidates");
        require_surfaces(found, meshes_[a], meshes_[b]);
        for (const Correspondences& map : found.maps) {
            keep_samples(pair.source, map.from_A, file);
            keep_samples(pair.target, map.from_B, file);
        }
        for (std::size_t k = 0; k < found.maps.size(); ++k) {
            if (k > 0 && is_mirrored(found.list[k])) continue;
            pair.maps.push_back(
                {nearest(positions(found.maps[k].from_A, meshes_[b], units_[b], true), samples[b]),
                 nearest(positions(found.maps[k].from_B, meshes_[a], units_[a], true), samples[a]),
                 found.list[k].score});
        }
        pair.trust = confidence_of(found.list).probability;
        names.push_back(name);
        pairs.push_back(std::move(pair));
    }
    std::map<std::string, int> number_;
    std::vector<TriangleMesh> meshes_;
    std::vector<double> units_;
};

}  // namespace

int main(int argc, char** argv) {
    Stage stage("cycles", "Which of the maps found for each pair make the loops of a collection close");
    const auto& manifest =
        stage.input("manifest", "JSON of varimap batch: surfaces and pairs with their candidates");
    const auto& first_only = stage.flag("first", "only measure loops of the first candidates");
    return stage.main(argc, argv, [&] {
        const Reader all(manifest);
        const Choice first(all.pairs.size(), 0);
        const Choice choice = first_only ? first : choose(all.samples, all.pairs);
        const auto before = measure_loops(all.samples, all.pairs, first);
        const auto after = measure_loops(all.samples, all.pairs, choice);
        int changed = 0;
        fmt::print("name,candidate,candidates,loops,closed_before,closed,error_before,error\n");
        for (std::size_t p = 0; p < all.pairs.size(); ++p) {
            changed += choice[p] != 0;
            fmt::print("{},{},{},{},{},{},{:.5f},{:.5f}\n", all.names[p], choice[p] + 1,
                       all.pairs[p].maps.size(), after[p].count, before[p].closed, after[p].closed,
                       before[p].error, after[p].error);
        }
        log("{} pairs, {} with another candidate than the first", all.pairs.size(), changed);
    });
}
