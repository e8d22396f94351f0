// Checkpoints. Inputs that begin with 'f' are the bytes of a checkpoint file; a sum over the bytes
// keeps all but whole files from HDF5, which trusts what it reads. All others are edits of the
// columns of a good state, as a file of another version or a forged one would have them: such a
// state must be refused or stepped.
#include "core/simulation.hpp"

#include "io/hdf5/checkpoint.hpp"

#include "tests/fuzz/target.hpp"

#include <algorithm>
#include <cstring>

namespace grainbench::fuzz {
namespace {

/// Spheres that lie in a shaken box with a turning lid, with all that leaves something in a state.
Scene small_scene() {
    Scene scene;
    scene.gravity = Vec3{0.0, 0.0, -9.8};
    scene.particles.species = {{"ball", 0.005, 2000.0}};
    scene.particles.insertion = {
        ListInsertion{.particles = {{.species = "ball", .position = {0.0, 0.0, 0.0049}},
                                    {.species = "ball", .position = {0.0, 0.0, 0.0147}},
                                    {.species = "ball", .position = {0.0098, 0.0, 0.0049}}}}};
    scene.walls = {{.name = "box",
                    .shape = BoxShape{{-0.01, -0.01, 0.0}, {0.02, 0.01, 0.03}},
                    .motion = SinusoidMotion{.velocity = {0.1, 0.0, 0.0}, .frequency = 20.0},
                    .material = {}},
                   {.name = "lid",
                    .shape = Disc{.centre = {0.0, 0.0, 0.025}, .radius = 0.02},
                    .motion = RotationMotion{.axis = {0.0, 0.0, 1.0}, .rate = 3.0},
                    .material = {}}};
    scene.contact.stiffness = ConstantStiffness::Params{.normal = 1e4, .shear = 1e4};
    scene.contact.normal = IncrementalSpring::Params{};
    scene.contact.friction = CoulombFriction::Params{.coefficient = 0.5};
    scene.contact.damping = ViscousDamping::Params{.normal = 0.2, .shear = 0.2, .mode = 3};
    Stage stage;
    stage.duration = 1.0;
    scene.stages = {stage};
    scene.observables.energy = EnergyObservable{};
    return scene;
}

/// Takes numbers off the front of the input; zeros past its end.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    template <class T>
    T take() {
        T value{};
        const std::size_t count = std::min(left_, sizeof value);
        std::memcpy(&value, data_, count);
        data_ += count;
        left_ -= count;
        return value;
    }

    bool empty() const { return left_ == 0; }

private:
    const std::uint8_t* data_;
    std::size_t left_;
};

template <class T>
void edit(std::vector<T>& column, Bytes& bytes) {
    const auto choice = bytes.take<std::uint8_t>();
    if (choice % 3 == 0) {
        column.resize(bytes.take<std::uint16_t>());
    } else if (choice % 3 == 1 && !column.empty()) {
        column[bytes.take<std::uint16_t>() % column.size()] = bytes.take<T>();
    } else {
        std::fill(column.begin(), column.end(), bytes.take<T>());
    }
}

void step_edited_state(Bytes bytes) {
    static const Scene scene = small_scene();
    static const Archive good = [] {
        Observer nobody;
        Simulation simulation(scene, 0);
        simulation.advance(50, nobody);
        Archive archive;
        simulation.save(archive);
        return archive;
    }();
    Archive archive;
    for (const auto& [name, column] : good.columns()) {
        archive.put_column(name, column);
    }
    while (!bytes.empty()) {
        auto at = good.columns().begin();
        std::advance(at, bytes.take<std::uint8_t>() % good.columns().size());
        Archive::Column column = archive.columns().at(at->first);
        std::visit([&](auto& values) { edit(values, bytes); }, column);
        archive.put_column(at->first, std::move(column));
    }
    attempt([&] {
        Observer nobody;
        Simulation simulation(scene, 0);
        simulation.load(archive);
        simulation.advance(3, nobody);
    });
}

}  // namespace
}  // namespace grainbench::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace grainbench;
    if (size > 0 && data[0] == 'f') {
        static const fuzz::InputFile file("checkpoint.h5");
        file.write(fuzz::text_of(data + 1, size - 1));
        fuzz::attempt([] {
            std::string warning;
            io::read_checkpoint(file.path(), "scene", warning);
        });
    } else {
        fuzz::step_edited_state({data, size});
    }
    return 0;
}
