#include "io/export.hpp"

#include "io/atomic_file.hpp"
#include "io/csv_table.hpp"
#include "io/import.hpp"
#include "io/run_folder.hpp"
#include "io/vtk/pvd.hpp"

#include "tests/unit/io/frames.hpp"
#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace grainbench::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

Scene scene_with_two_species() {
    Scene scene;
    scene.particles.species = {{.name = "glass", .radius = 1.0, .density = 1.0},
                               {.name = "steel", .radius = 1.0, .density = 1.0}};
    return scene;
}

/// A run of two realisations with two frames each.
void write_run(const std::filesystem::path& path) {
    RunFolder run(path, "{}", scene_with_two_species(), 2, {});
    const std::vector<HistoryColumn> columns{{"time", "s", ""}, {"cycle", "1", ""}};
    for (std::size_t k = 0; k < 2; ++k) {
        for (const double time : {0.0, 0.5}) {
            run.write_frame(k, some_particles(3, time), some_walls(time), nullptr);
            run.append_history(k, columns, std::vector<double>{time, 1.0});
        }
    }
    run.finish({});
}

TEST(Export, VtuCopiesTheFrames) {
    const TemporaryFolder folder;
    write_run(folder / "run");
    // Per realisation: 2 particle files, 2 wall files, 2 series, traces.
    EXPECT_EQ(export_run(folder / "run", folder / "out", ExportFormat::vtu), 14U);
    for (const char* name :
         {"particles_000001.vtu", "particles.pvd", "walls_000000.vtp", "walls.pvd", "traces.vtp"}) {
        EXPECT_EQ(read_file(folder / "out" / "realisation-2" / name),
                  read_file(folder / "run" / "realisation-2" / name));
    }
}

TEST(Export, VtpParticlesCanBeImportedAgain) {
    const TemporaryFolder folder;
    write_run(folder / "run");
    EXPECT_EQ(export_run(folder / "run", folder / "out", ExportFormat::vtp), 14U);
    const std::vector<PvdEntry> entries =
        read_pvd(folder / "out" / "realisation-1" / "particles.pvd");
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[1].file, "particles_000001.vtp");
    EXPECT_EQ(entries[1].time, 0.5);
    const auto rows = read_particles(folder / "out" / "realisation-1" / entries[1].file, "sand");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[1].position, some_particles(3).position[1]);
    EXPECT_EQ(rows[1].species, "steel");
}

TEST(Export, CsvHoldsEveryColumnAndTheHistory) {
    const TemporaryFolder folder;
    write_run(folder / "run");
    EXPECT_EQ(export_run(folder / "run", folder / "out", ExportFormat::csv), 5U);
    const CsvTable table = read_csv(folder / "out" / "realisation-1" / "particles_000001.csv");
    ASSERT_EQ(table.rows.size(), 3U);
    const ParticleFrame frame = some_particles(3);
    const auto value = [&](std::size_t row, const std::string& name) {
        for (std::size_t k = 0; k < table.header.cells.size(); ++k) {
            if (table.header.cells[k] == name) {
                return table.number(table.rows[row], k);
            }
        }
        ADD_FAILURE() << "no column " << name;
        return 0.0;
    };
    EXPECT_EQ(table.rows[2].cells[0], std::to_string(frame.id[2]));
    EXPECT_EQ(value(1, "z"), frame.position[1].z);
    EXPECT_EQ(value(1, "radius"), frame.radius[1]);
    EXPECT_EQ(value(2, "current_layer"), 4.0);
    EXPECT_EQ(value(2, "vz"), frame.velocity[2].z);
    EXPECT_EQ(value(2, "wx"), frame.angular_velocity[2].x);
    EXPECT_EQ(value(2, "fx"), frame.force[2].x);
    EXPECT_EQ(value(2, "contacts"), 7.0);
    EXPECT_EQ(read_file(folder / "out" / "history.csv"),
              "realisation,time,cycle\n1,0,1\n1,0.5,1\n2,0,1\n2,0.5,1\n");
}

TEST(Export, NumbersKeepTheDigitsOfTheFileAndNoMore) {
    const TemporaryFolder folder;
    RunFolder run(folder / "run", "{}", scene_with_two_species(), 1, {});
    ParticleFrame frame = some_particles(1);
    frame.position[0] = {0.1, 1e-7, -1.0 / 3.0};
    run.write_frame(0, frame, {}, nullptr);
    export_run(folder / "run", folder / "out", ExportFormat::csv);
    EXPECT_THAT(read_file(folder / "out" / "realisation-1" / "particles_000000.csv"),
                HasSubstr(",0.1,1e-07,-0.33333334,"));
}

TEST(Export, WrongFoldersAreRefused) {
    const TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { export_run(folder / "absent", folder / "out", ExportFormat::vtu); }),
                AllOf(StartsWith("bad input: "), HasSubstr((folder / "absent").string())));
    write_run(folder / "run");
    EXPECT_THAT(error_of([&] { export_run(folder / "run", folder / "run", ExportFormat::vtu); }),
                AllOf(StartsWith("bad input: "), HasSubstr("own folder")));
}

}  // namespace
}  // namespace grainbench::io
