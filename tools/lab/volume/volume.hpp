// Ways of keeping hair's volume, side by side: limp hair on a ball.
#pragma once

#include "methods.hpp"
#include "methods/models.hpp"

namespace lab::volume {

struct VolumeOptions {
    std::string model = "articulated"; // of those that bend or hang as chains; one step of history
    uint32_t strands = 2000;
    double seconds = 3;
    std::vector<std::string> methods; // names; none: all
    std::string out = "out/lab";
};

struct VolumeRow {
    const Method* method = nullptr;
    double volume = 0, volume_least = 0; // over that at rest: at the end, least of the last second
    double volume_most = 0;              // of the whole run
    double height = 0, height_least = 0; // the same, of hair above the equator, over the ball
    // Of hair in free fall, what a step of the method changes: |sum of m dv| over the sum of m |dv|,
    // and the kinetic energy about the mean velocity that it adds, over what there was.
    double momentum = 0, energy = 0;
    double neighbours = 0; // share of the pairs of vertices within 12 mm at rest that still are
    double crowd = 0;      // such pairs at the end, over those at rest
    double jitter = 0;     // rms way of all vertices in the last step, over the strands' length
    double cost = 0;       // ms a step, of the method alone, least of the run
    std::vector<double> volumes; // after every step
};

std::vector<VolumeRow> measure_volume(Contexts& contexts, const VolumeOptions& options);

std::string volume_text(const std::vector<VolumeRow>& rows);
std::string volume_csv(const std::vector<VolumeRow>& rows);
std::string volume_curves(const std::vector<VolumeRow>& rows); // time and a column for each row
// <out>/volume.svg and .png: volume over time, a line for each row. False: there is no gnuplot.
bool draw_volume(const std::vector<VolumeRow>& rows, const VolumeOptions& options);

constexpr double rate = 60; // 1/s, steps

} // namespace lab::volume
