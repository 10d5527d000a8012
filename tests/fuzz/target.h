#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace varimap::fuzz {

/// One reader under test.
struct Target {
    std::string name;
    std::vector<std::string> seeds;       ///< good inputs, from which others are made
    std::vector<std::string> dictionary;  ///< words of the format
    /// Reads and uses one input. Throws nothing but an Error that the user can act on.
    std::function<void(const std::string& bytes)> run;
    std::size_t memory_base = 4 << 20;  ///< bytes that it may take, beside a multiple of the input's length
    unsigned longest_cpu_seconds = 10;  ///< for one input
    /// Makes input `number` where changing bytes of the seeds would not do.
    std::function<std::string(std::uint64_t number)> forge = {};
    /// Makes what all inputs need, before the first: its time and memory are no input's.
    std::function<void()> prepare = {};
};

/// Readers of meshes: obj, off, ply, stl, and what preprocess makes of them.
std::vector<Target> mesh_targets();
/// Readers of landmarks, in each form.
std::vector<Target> landmark_targets();
/// Artifacts of every kind with a right hash and hostile content, and their headers.
std::vector<Target> artifact_targets();
/// Stages, each with one forged artifact among those that it reads.
std::vector<Target> stage_targets();
/// Config files and values of parameters.
std::vector<Target> config_targets();
/// Readers of the points and polygons of FBX and COLLADA files; where varimap-import is built.
std::vector<Target> import_targets();
/// Readers of what is carried through a map, and what becomes of it.
std::vector<Target> transfer_targets();

}  // namespace varimap::fuzz
