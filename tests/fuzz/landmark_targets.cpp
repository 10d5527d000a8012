#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "fixtures/shapes.h"
#include "fuzz/scratch_file.h"
#include "fuzz/target.h"
#include "varimap/landmarks/vertex_list.h"

namespace varimap::fuzz {
namespace {

const std::vector<std::string> numbers{"# source target\n0 1\n2 3\n 5 7\r\n", "0\n5\n11\n",
                                       "1 0 0 0\n2 1 0 0\n3 0 1 0\n"};
// Points near the mesh's vertices; others are refused.
const std::vector<std::string> coordinates{
    "0 .526 .851\n.526 .851 0\n.851 0 .526\n",
    "0 .526 .851 0 .526 .851\n.526 .851 0 .526 .851 0\n.851 0 .526 .851 0 .526\n"};
const std::vector<std::string> meshlab{
    "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData/>\n"
    " <point x=\"0\" y=\".526\" z=\".851\" name=\"nose\" active=\"1\"/>\n"
    " <point name=\"tail\" active=\"0\" z=\"0\" y=\".851\" x=\".526\"/>\n</PickedPoints>\n"};
const std::vector<std::string> slicer{
    R"({"markups": [{"type": "Fiducial", "coordinateSystem": "RAS", "controlPoints": [
        {"label": "ear", "position": [0, 0.526, 0.851], "positionStatus": "defined"},
        {"label": "tail", "position": [0.526, 0.851, 0]}, {"label": "x", "positionStatus": "undefined"}]}]})"};
const std::vector<std::string> old_slicer{
    "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
    "1,.526,.851,0,0,0,0,1,1,1,0,tail,,\r\n2,0,.526,.851,0,0,0,1,1,1,0,nose,,\n"};
const std::vector<std::string> landmark_editor{
    "Version 1.0\n3\nS000 0 .526 .851\nS001 9999 9999 9999\nC000 .526 .851 0\n"};

/// Read as the list of both surfaces, or as the file of pairs.
Target target(const std::string& name, const std::string& ending, const std::vector<std::string>& seeds,
              const std::vector<std::string>& dictionary) {
    static const TriangleMesh mesh = shapes::ellipsoid(0);
    return {name, seeds, dictionary, [=](const std::string& bytes) {
                const ScratchFile file(bytes, ending);
                std::vector<std::string> files{file.path()};
                if (bytes.size() % 2 == 0 || ending != ".txt") files.push_back(file.path());
                for (const auto& [a, b] : read_landmarks(files, mesh, mesh).points)
                    if (!(position(mesh, a) + position(mesh, b)).allFinite())
                        throw std::logic_error("a landmark is nowhere");
            }};
}

}  // namespace

std::vector<Target> landmark_targets() {
    return {target("vertices", ".txt", numbers, {"#"}),
            target("vts", ".vts", {numbers[1], numbers[2]}, {"#"}),
            target("coordinates", ".txt", coordinates, {"#"}),
            target("pp", ".pp", meshlab, {"<point ", "x=\"1\"", "active", ">", "\""}),
            target("mrk_json", ".mrk.json", slicer,
                   {"null", "[]", "{}", "\"markups\"", "\"position\"", "\"label\"", "\"LPS\"", "true"}),
            target("pts", ".pts", landmark_editor, {"Version", "9999", "S002 "}),
            target("fcsv", ".fcsv", old_slicer, {",", "#", "# CoordinateSystem = RAS", "0", "IJK"})};
}

}  // namespace varimap::fuzz
