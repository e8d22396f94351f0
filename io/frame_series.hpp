/// The numbered files of one kind in the folder of a realisation, with their .pvd.
#pragma once

#include "io/vtk/pvd.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::io {

class FrameSeries {
public:
    /// \param name "particles" for particles_000000.vtu and particles.pvd
    /// \param extension ".vtu", ".vtp" or ".vti"
    FrameSeries(std::filesystem::path folder, std::string name, std::string extension);

    std::filesystem::path path_of(std::size_t frame) const;

    /// Lists a frame whose file is complete.
    void add(std::size_t frame, double time);

    /// Takes up the series that an earlier run left and takes back its frames from `frame_count`
    /// on.
    void resume(std::size_t frame_count);

private:
    std::string file_of(std::size_t frame) const;
    std::filesystem::path pvd() const;

    std::filesystem::path folder_;
    std::string name_;
    std::string extension_;
    std::vector<PvdEntry> entries_;
};

}  // namespace grainbench::io
