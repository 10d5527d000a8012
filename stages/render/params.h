#pragma once

#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh_repair/mesh_repair.h"
#include "varimap/stage/parameters.h"

namespace varimap {

struct RenderParams {
    int width = 1200;
    int samples = 9;
    double checker = .09;
    double azimuth = 20;
    double elevation = 8;
    std::string up = "auto";
    bool flips = false;
    bool mirror = false;
    double ratio_range = 4;
    double conformal_range = 4;
    LandmarkReading landmark_reading;
    RepairOptions repair;

    void describe(ParameterList& list) {
        list.add("width", width, "width of the picture, pixels", 64, 16384);
        list.add("samples", samples, "rays per pixel; four where these agree", 1, 256);
        list.add("checker", checker, "edge of the checkerboard's cells, in units of sqrt(source area)", 1e-3,
                 10);
        list.add("azimuth", azimuth, "turns the camera to the right around the surfaces, degrees", -360, 360);
        list.add("elevation", elevation, "raises the camera, degrees", -89, 89);
        list.add("up", up, "axis of the source that points up, - before it: down; auto guesses",
                 {"auto", "x", "y", "z", "-x", "-y", "-z"});
        list.add("ratio_range", ratio_range, "distortion: end of the scale of mass and area ratios", 1.01,
                 1e6);
        list.add("conformal_range", conformal_range, "distortion: end of the scale of conformal distortion",
                 1.01, 1e6);
        list.add("flips", flips, "shows triangles in magenta whose image is reversed");
        list.add("mirror", mirror,
                 "the map reverses orientation on purpose; flips are triangles where it does not");
        landmark_reading.describe(list);
        repair.describe(list);
    }
};

}  // namespace varimap
