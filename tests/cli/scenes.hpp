/// Scenes of the tests of the command line.
#pragma once

#include <string>

namespace grainbench::cli {

/// Balls that fall into a cup, two realisations, two stages of 0.1 s.
inline constexpr const char* cup_scene = R"({
  "format": "grainbench-scene/1",
  "title": "Balls in a cup",
  "gravity": [0, 0, -9.8],
  "particles": {
    "species": [{"name": "bead", "radius": 0.003, "density": 1500}],
    "insertion": [{"type": "lattice", "species": "bead", "origin": [-0.02, -0.02, 0.005],
                   "spacing": [0.008, 0.008, 0.008], "counts": [6, 6, 4], "jitter": 0.0005}]},
  "walls": [{"name": "cup", "shape": {"type": "cylinder", "base": [0, 0, 0], "radius": 0.04,
                                      "height": 0.1, "part": "open_top"}}],
  "contact": {"stiffness": {"law": "constant_stiffness", "normal": 1e4, "shear": 1e4},
              "normal": {"law": "incremental_spring"},
              "friction": {"law": "coulomb_friction", "coefficient": 0.6},
              "damping": {"law": "viscous_damping", "normal": 0.1, "shear": 0.1, "mode": 3}},
  "stages": [{"name": "fall", "duration": 0.1},
             {"name": "shake", "duration": 0.1,
              "motions": [{"wall": "cup", "motion": {"type": "sinusoid", "velocity": [0, 0, 0.3],
                                                     "frequency": 20}}]}],
  "traces": [{"nearest_to": [0, 0, 0]}],
  "realisations": {"count": 2, "seed": 7},
  "output": {"frame_interval": 0.05, "history_interval": 0.01, "trace_interval": 0.01,
             "checkpoint_interval": 0.05}
}
)";

}  // namespace grainbench::cli
