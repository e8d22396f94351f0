/// `grainbench study --stability-map`: which steps are stable at which damping ratio and what they
/// do to the energy, of one contact and of a shaken bed.
#pragma once

#include "core/verify/stability_map.hpp"

#include "render/chart.hpp"

#include "cli/study/report.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::cli {

struct StabilityMapResult {
    std::vector<verify::MapPoint> map;
    std::vector<verify::BedPoint> bed;
    double automatic_step = 0.0;  ///< [s] of that bed
};

/// \param quick 42 points of the map for 650, two steps of the bed for thirteen
StabilityMapResult study_stability_map(bool quick);

/// Step over critical step against damping ratio, coloured by the error of the energy.
render::Chart map_chart(const StabilityMapResult& result);

/// Error of the energy of the shaken bed against its step.
render::Chart bed_chart(const StabilityMapResult& result);

std::string stability_map_text(const StabilityMapResult& result);

/// Writes the charts, stability-map and shaken-bed as PNG, SVG and CSV, into the folder.
void write_stability_map_folder(const StabilityMapResult& result,
                                const StudyOrigin& origin,
                                const std::filesystem::path& folder);

}  // namespace grainbench::cli
