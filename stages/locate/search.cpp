#include "stages/locate/search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/locate/agreement.h"
#include "stages/locate/anchors.h"
#include "stages/locate/rigid_search.h"
#include "stages/locate/starts.h"
#include "varimap/core/error.h"
#include "varimap/core/log.h"
#include "varimap/core/parallel.h"

namespace varimap {

namespace {

constexpr std::size_t improved = 6;   ///< placements that are placed again
constexpr int most_improvements = 4;  ///< of each
constexpr double least_gain = 1e-3;   ///< of the agreement
/// Mean distance of placements that are elsewhere, in units of sqrt(area) of the part.
constexpr double elsewhere = 0.15;

struct Rated {
    Placement placement;
    double agreement;
};

class PlacementSearch {
  public:
    PlacementSearch(const Sketches& sketches, const Sides& sides, double share, const LocateParams& params)
        : sketches_(sketches),
          sides_(sides),
          share_(share),
          params_(params),
          reliefs_(sides.reliefs()),
          agreement_(sketches, sides, share) {}

    FoundPlacement run() const {
        std::vector<Rated> found;
        if (sides_.landmarks_tell()) {
            found = placed({rigid_images(sides_, share_), images_by_landmarks(sketches_, sides_, share_)},
                           {relief_factors.begin(), relief_factors.end()});
            if (found.front().placement.strain < params_.enough) return {std::move(found.front().placement)};
        }
        for (Rated& one : placed(rigid_guesses(sketches_, sides_, share_), {1}))
            found.push_back(std::move(one));
        if (found.empty()) throw InputError("the part has no face by which it could be placed");
        sort(found);
        parallel_for_each_index(std::min(improved, found.size()), std::size_t(1),
                                [&](std::size_t k) { improve(found[k]); });
        sort(found);
        for (const Rated& one : found)
            log("placed: agreement {:.3f}, relief {:.2f}, strain {:.3f}", one.agreement, one.placement.relief,
                one.placement.strain);
        FoundPlacement best{found.front().placement};
        if (!sides_.landmarks_tell()) best.lead = lead_of(found);
        return best;
    }

  private:
    Rated rated(const PointMap& images, double relief_factor) const {
        PlacingOptions options = params_.placing;
        options.relief_weight *= relief_factor;
        Placement placement = pinned_placement(images, sides_, share_, reliefs_, options);
        const double agreement = agreement_(placement);
        return {std::move(placement), agreement};
    }
    static void sort(std::vector<Rated>& list) {
        std::stable_sort(list.begin(), list.end(),
                         [](const Rated& a, const Rated& b) { return a.agreement > b.agreement; });
    }
    /// From each of the images, with each of the reliefs; the best first.
    std::vector<Rated> placed(const std::vector<PointMap>& images,
                              const std::vector<double>& relief_factors_of_each) const {
        const std::size_t each = relief_factors_of_each.size();
        std::vector<Rated> list(images.size() * each);
        parallel_for_each_index(list.size(), std::size_t(1), [&](std::size_t k) {
            list[k] = rated(images[k / each], relief_factors_of_each[k % each]);
        });
        sort(list);
        return list;
    }
    void improve(Rated& one) const {
        for (int i = 0; i < most_improvements; ++i) {
            const PointMap images = images_by_anchors(one.placement.images, sketches_, share_);
            const double before = one.agreement;
            for (const double factor : relief_factors)
                if (Rated other = rated(images, factor); other.agreement > one.agreement + least_gain)
                    one = std::move(other);
            if (!(one.agreement > before)) break;
        }
    }
    double lead_of(const std::vector<Rated>& sorted) const {
        const Rated& best = sorted.front();
        const auto other = std::find_if(sorted.begin(), sorted.end(), [&](const Rated& one) {
            return distance(best.placement, one.placement) > elsewhere;
        });
        return other == sorted.end() ? std::numeric_limits<double>::infinity()
                                     : best.agreement - other->agreement;
    }
    /// Mean distance of the images, in units of sqrt(area) of the part.
    double distance(const Placement& a, const Placement& b) const {
        double sum = 0;
        for (std::size_t v = 0; v < a.images.size(); ++v)
            sum +=
                sides_.part.mass[Eigen::Index(v)] *
                (position(sides_.whole.mesh, a.images[v]) - position(sides_.whole.mesh, b.images[v])).norm();
        return sum / sides_.part.mass.sum() / std::sqrt(share_);
    }

    const Sketches& sketches_;
    const Sides& sides_;
    double share_;
    const LocateParams& params_;
    std::vector<ReliefPair> reliefs_;
    PlacementAgreement agreement_;
};

}  // namespace

FoundPlacement find_placement(const Sketches& sketches, const Sides& sides, double share,
                              const LocateParams& params) {
    return PlacementSearch(sketches, sides, share, params).run();
}

}  // namespace varimap
