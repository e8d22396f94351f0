#include "core/verify/stability/watched.hpp"

#include "core/error.hpp"

#include <algorithm>

namespace grainbench::verify {

double mechanical_energy(const Run& run) {
    return run.now("energy_kinetic_translation") + run.now("energy_kinetic_rotation") +
           run.now("energy_potential") + run.now("energy_elastic");
}

Ending watch(Run& run, std::uint64_t cycles, std::uint64_t stride) {
    Ending ending;
    const std::uint64_t first = run.simulation().cycle();
    try {
        while (cycles > 0) {
            const std::uint64_t part = stride == 0 ? cycles : std::min(cycles, stride);
            const bool finished = run.advance(part);
            if (stride != 0) {
                ending.largest = std::max(ending.largest, mechanical_energy(run));
            }
            if (finished) {
                break;
            }
            cycles -= part;
        }
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::unstable) {
            throw;
        }
        ending.stopped = true;
        ending.what = error.diagnosis().what;
    }
    ending.cycles = run.simulation().cycle() - first;
    return ending;
}

Ending watch(const Scene& scene, std::uint64_t cycles) {
    Run run(scene);
    return watch(run, cycles);
}

void add_box(Scene& scene, const std::string& name, const Vec3& low, const Vec3& high) {
    Wall wall;
    wall.name = name;
    wall.shape = BoxShape{.low = low, .high = high};
    scene.walls.push_back(std::move(wall));
}

void add_triangles(Scene& scene,
                   const std::string& name,
                   std::vector<Vec3> vertices,
                   std::vector<std::vector<std::int64_t>> triangles) {
    Wall wall;
    wall.name = name;
    wall.shape = Triangles{.vertices = std::move(vertices), .triangles = std::move(triangles)};
    scene.walls.push_back(std::move(wall));
}

void silence_guards(Scene& scene) {
    scene.guards.overlap.action = GuardAction::ignore;
    scene.guards.speed.action = GuardAction::ignore;
    scene.guards.energy.action = GuardAction::ignore;
    scene.guards.late_contacts.action = GuardAction::ignore;
    scene.guards.lost.action = LostAction::ignore;
}

double Noise::next() {
    // The generator of Knuth's MMIX; its high bits are good enough to shake a scene.
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1p-52 - 1.0;
}

Held held_spheres(const Simulation& simulation, double mass) {
    const ParticleFrame frame = simulation.particle_frame();
    Held held;
    for (std::size_t n = 0; n < frame.size(); ++n) {
        if (frame.contacts[n] >= contacts_that_hold) {
            const Vec3& v = frame.velocity[n];
            const Vec3& w = frame.angular_velocity[n];
            const double inertia = 0.4 * mass * frame.radius[n] * frame.radius[n];
            held.energy += 0.5 * (mass * dot(v, v) + inertia * dot(w, w));
            ++held.count;
        }
    }
    return held;
}

}  // namespace grainbench::verify
