#include "stages/remesh/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "varimap/core/log.h"
#include "varimap/results/choice.h"
#include "varimap/results/landmark_words.h"

namespace varimap {

namespace {

/// Landmarks that one warning is about, as it counts them from 1.
struct DoubtedLandmarks {
    std::vector<int> numbers;
    double farthest = 0;  ///< of them; sqrt(area)

    void add(std::size_t index, double distance) {
        numbers.push_back(int(index) + 1);
        farthest = std::max(farthest, distance);
    }
    bool is_one() const { return numbers.size() == 1; }
};

/// "landmark 3", "landmarks 3, 4 and 9".
std::string in_words(const DoubtedLandmarks& landmarks) {
    std::vector<std::string> names;
    for (const int number : landmarks.numbers) names.push_back(std::to_string(number));
    return (landmarks.is_one() ? "landmark " : "landmarks ") + list_in_words(std::move(names));
}

void warn_of_missed(const DoubtedLandmarks& missed) {
    if (missed.is_one())
        warn(
            "{} is not met: its image is off by {:.2f} sqrt(area). Is it right? Look at the picture, and at "
            "the landmarks around it",
            in_words(missed), missed.farthest);
    else if (!missed.numbers.empty())
        warn(
            "{} are not met: their images are off by up to {:.2f} sqrt(area). Are they right? Look at the "
            "picture, and at the landmarks around them",
            in_words(missed), missed.farthest);
}

/// Soft ones may be a little off, not elsewhere.
void warn_of_soft_landmarks(const LandmarkQuality& landmarks) {
    constexpr double elsewhere = 0.2;
    DoubtedLandmarks far;
    for (std::size_t k = 0; k < landmarks.residuals.size(); ++k)
        if (landmarks.residuals[k] > elsewhere) far.add(k, landmarks.residuals[k]);
    if (far.numbers.empty()) return;
    warn(
        "{}, soft, {} far from met: off by up to {:.2f} sqrt(area). Look at the picture; where landmarks are "
        "right, leave out --landmark-weight, or make it larger",
        in_words(far), far.is_one() ? "is" : "are", far.farthest);
}

void warn_of_spikes(const DoubtedLandmarks& spikes) {
    if (spikes.is_one())
        warn(
            "around {} the map is elsewhere: it is met alone, and its surroundings are off by {:.2f} "
            "sqrt(area). Is it right? Look at the picture; if it is, give more landmarks there, or "
            "--landmark-vicinity 4",
            in_words(spikes), spikes.farthest);
    else if (!spikes.numbers.empty())
        warn(
            "around {} the map is elsewhere: they are met alone, and their surroundings are off by up to "
            "{:.2f} sqrt(area). Are they right? Look at the picture; if they are, give more landmarks there, "
            "or --landmark-vicinity 4",
            in_words(spikes), spikes.farthest);
}

/// Of a round surface, which few points hardly turn, all landmarks may be met a little alone: no spike by
/// itself, but together another map.
void warn_of_loose(const DoubtedLandmarks& loose, std::size_t count) {
    constexpr std::size_t several = 3;
    if (loose.numbers.size() < several || 2 * loose.numbers.size() <= count) return;
    warn(
        "most landmarks are met alone: around {} the map is off by up to {:.2f} sqrt(area). Are they right? "
        "Look at the picture; if they are, give more, on all sides: few hardly turn what is round",
        in_words(loose), loose.farthest);
}

void warn_of_exchanged(const std::vector<std::pair<int, int>>& exchanged) {
    if (!exchanged.empty())
        warn("landmarks {} look exchanged: each one's surroundings go to the other's partner",
             exchanged_in_words(exchanged));
}

/// A row too many or too few in one of two lists puts all behind it off. Where the lists are shifted, some
/// may look exchanged by chance; that some were exchanged is no sign of a shift.
void warn_of_shift(const std::vector<char>& is_off, const std::vector<char>& is_exchanged) {
    constexpr int least = 4;
    int count = 0;
    std::size_t first = is_off.size();
    while (first > 0 && (is_off[first - 1] || is_exchanged[first - 1]))
        if (!is_exchanged[--first]) ++count;
    if (count >= least)
        warn("all landmarks from {} on, to the last one, are off: is the list {}?", first + 1,
             first == 0 ? "one row off, or are source and target exchanged" : "one row off");
}

/// Pinned landmarks that the map does not meet, or meets with a spike, or most of them nearly so. Those
/// between vertices are drawn, not held: by .01 they are off at most where nothing contradicts them. Of the
/// 142 right landmarks of the known pairs 101 are within the radius, and all but 7 within 4 times; these 7,
/// on animals of other species, are parts that the map takes elsewhere.
void warn_of_landmarks(const LandmarkQuality& landmarks) {
    constexpr double missed = 0.02, elsewhere = 0.02, times = 4, loosely = 1.5;
    const std::size_t count = landmarks.residuals.size();
    std::vector<char> is_exchanged(count, 0), is_off(count, 0);
    for (const auto& [i, j] : landmarks.exchanged)
        is_exchanged[std::size_t(i)] = is_exchanged[std::size_t(j)] = 1;
    DoubtedLandmarks not_met, spikes, loose;
    for (std::size_t k = 0; k < count; ++k) {
        const LandmarkSurroundings& around = landmarks.surroundings[k];
        const bool is_missed = landmarks.residuals[k] > missed;
        const bool is_loose =
            !is_missed && !is_exchanged[k] && around.distance > elsewhere && times_radius(around) > loosely;
        const bool is_spike = is_loose && times_radius(around) > times;
        if (is_missed) not_met.add(k, landmarks.residuals[k]);
        if (is_loose) loose.add(k, around.distance);
        if (is_spike) spikes.add(k, around.distance);
        is_off[k] = is_missed || is_spike;
    }
    warn_of_missed(not_met);
    warn_of_exchanged(landmarks.exchanged);
    if (spikes.numbers.empty())
        warn_of_loose(loose, count);
    else
        warn_of_spikes(spikes);
    warn_of_shift(is_off, is_exchanged);
}

void warn_of_departure(const InitialMapQuality& moved) {
    if (moved_far(moved))
        warn(
            "the map is far from the initial one: {:.3f} sqrt(area) in the mean. Where shapes differ much, a "
            "good map may become worse: compare both, and to stay nearer give landmarks all over the surface "
            "besides, or a larger --area-bound",
            moved.mean);
}

/// What to give where the map is doubtful.
const char* landmarks_to_give(const PairRecord& record) {
    return record.landmarks.empty() ? "landmarks" : "more landmarks";
}

void warn_of_choice(const ChoiceQuality& choice, const PairRecord& record) {
    if (choice.when_found.confident && !choice.finished.confident)
        warn("the map is less sure than its candidate was ({}): look at the picture, {}or give {}",
             choice.doubt, record.candidates.size() > 1 ? "try --candidate 2, " : "",
             landmarks_to_give(record));
}

/// Distortion is measured on the input's faces: one much longer than high is sheared by the least shift of a
/// corner along it. Says so where such faces have half of a surface's area or more; else empty.
std::string slivers_in_words(const MapQuality& quality) {
    constexpr double sliver = 0.05;
    const bool source = quality.median_thinness_A < sliver, target = quality.median_thinness_B < sliver;
    if (!source && !target) return "";
    return fmt::format(
        "The likely cause: most of the area of {} lies on slivers (faces of a height below {} of their "
        "length), which the least shift shears; mesh {} with rounder faces",
        source && target ? "both surfaces" : (source ? "the source" : "the target"), sliver,
        source && target ? "them" : "it");
}

/// Good maps of whole surfaces have less than .5% reversed and more than 95% covered, those of skulls with
/// their insides 87%. The upper half of a person on a whole one has 8% reversed.
bool reverses_much(const MeasuredDirection& direction) {
    constexpr double much = 2;
    constexpr std::size_t several = 5;  // one of 20 faces is as much, on a right map of a bracket
    return direction.verification.reversed_area_percent > much &&
           direction.verification.reversed_faces.size() >= several;
}
bool covers_little(const MeasuredDirection& direction) {
    return direction.reached().share < 0.8;
}
bool tears(const MeasuredDirection& direction) {
    return reverses_much(direction) || covers_little(direction);
}

void warn_of_tears(const MeasuredDirection& direction, const char* which, const std::string& slivers,
                   const PairRecord& record) {
    if (!tears(direction)) return;
    const std::string cause = fmt::format(
        "Is one a part of the other, or do they have different parts? Look at the picture, give {}",
        landmarks_to_give(record));
    std::vector<std::string> signs;
    if (reverses_much(direction))
        signs.push_back(
            fmt::format("{:.1f}% of the area is reversed", direction.verification.reversed_area_percent));
    if (covers_little(direction))
        signs.push_back(
            fmt::format("only {:.1f}% of the other surface is covered", 100 * direction.reached().share));
    warn("{}: the map tears: {}. {}", which, list_in_words(std::move(signs)),
         slivers.empty() ? cause : slivers);
}

/// Right maps between whole surfaces of the known pairs have 1.32 at most, four-legged animals of other
/// species among them; of halves that were closed with a lid on wholes, which may not tear, 2.1 to 2.5.
/// Skulls with their insides have 2.3, and tear.
void warn_of_strain(double dirichlet, const std::string& slivers) {
    constexpr double strained = 1.6;
    if (dirichlet > strained)
        warn("the map is strained more than right maps are (a Dirichlet energy of {:.2f}). {}", dirichlet,
             !slivers.empty() ? slivers
                              : "Is one surface a part of the other, or is this the wrong map? Look at the "
                                "picture");
}

/// The more twisted of both directions.
void warn_of_twist(const MapQuality& quality, const PairRecord& record) {
    const Twist &there = quality.A_to_B.twist, &back = quality.B_to_A.twist;
    const bool is_there = there.degrees >= back.degrees;
    const Twist& twist = is_there ? there : back;
    if (twist.degrees < doubtful_twist) return;
    warn(
        "the map twists the {} around vertex {} ({:.0f}% of its area) by {:.0f} degrees from end to end, "
        "which round shafts hardly resist: give {} on its sides, several along it",
        is_there ? "source" : "target", twist.vertex, 100 * twist.area, twist.degrees,
        landmarks_to_give(record));
}

/// "that of vertex 12 (3.1% of the area)", of the first few without a partner; empty if all have one.
std::string without_partner(const std::vector<ComponentImage>& components) {
    constexpr std::size_t few = 4;
    std::vector<std::string> names;
    for (const ComponentImage& one : components)
        if (!one.has_partner())
            names.push_back(
                fmt::format("that of vertex {} ({:.2g}% of the area)", one.vertex, 100 * one.area));
    if (names.size() > few) {
        const std::size_t more = names.size() - few + 1;
        names.resize(few - 1);
        names.push_back(fmt::format("{} more", more));
    }
    return names.empty() ? "" : list_in_words(std::move(names));
}

void warn_of_components(const ComponentImages& components, const PairRecord& record) {
    if (!components.are_several()) return;
    const std::string source = without_partner(components.of_source),
                      target = without_partner(components.of_target);
    if (source.empty() && target.empty()) return;
    std::vector<std::string> sides;
    if (!source.empty()) sides.push_back("of the source " + source);
    if (!target.empty()) sides.push_back("of the target " + target);
    warn("components have no partner of their own, and lie on what others lie on, or on nothing: {}. {}",
         list_in_words(std::move(sides)),
         components.are_astray()
             ? fmt::format("Give {} on those that belong together, or map them one by one",
                           landmarks_to_give(record))
             : std::string("What the other surface lacks is better left out"));
}

/// Of whole surfaces it is said before they are mapped (unlike_surfaces.h).
void warn_of_opposed_components(const ComponentImages& components) {
    std::vector<std::string> pairs;
    for (const int c : components.opposed()) {
        const ComponentImage& one = components.of_source[std::size_t(c)];
        pairs.push_back(fmt::format(
            "that of vertex {} of the source ({}) and that of vertex {} of the target", one.vertex,
            one.orientation < 0 ? "inward" : "outward", components.of_target[std::size_t(one.onto)].vertex));
    }
    if (!pairs.empty())
        warn(
            "faces look inward on one surface, outward on the other, where those of the largest component do "
            "not: {}. They are mapped as mirror images; if they are none, reverse the faces of one",
            list_in_words(std::move(pairs)));
}

}  // namespace

void warn_of(const MapQuality& quality, const PairRecord& record) {
    if (record.pins_landmarks())
        warn_of_landmarks(quality.landmarks);
    else
        warn_of_soft_landmarks(quality.landmarks);
    if (quality.initial_map) warn_of_departure(*quality.initial_map);
    if (quality.choice) warn_of_choice(*quality.choice, record);
    const std::string slivers = slivers_in_words(quality);
    warn_of_tears(quality.A_to_B, "source to target", slivers, record);
    warn_of_tears(quality.B_to_A, "target to source", slivers, record);
    if (!tears(quality.A_to_B) && !tears(quality.B_to_A))
        warn_of_strain(quality.in_the_end.dirichlet, slivers);
    warn_of_twist(quality, record);
    warn_of_components(quality.components, record);
    warn_of_opposed_components(quality.components);
}

}  // namespace varimap
