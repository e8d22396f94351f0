/// Runs of hard cases: how they end, and what their energy did on the way.
#pragma once

#include "core/verify/run.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace grainbench::verify {

struct Ending {
    bool stopped = false;      ///< by a guard
    std::uint64_t cycles = 0;  ///< made until then
    std::string what;          ///< said by the guard
    double largest = 0.0;      ///< [J] mechanical energy, the most seen
};

/// Kinetic, elastic and potential [J]; the scene has its ledger on.
double mechanical_energy(const Run& run);

/// Makes up to `cycles` cycles, or all; looks at the energy every `stride` cycles, 0 = never.
Ending watch(Run& run, std::uint64_t cycles, std::uint64_t stride = 0);

/// The same of a scene whose insertion may be refused.
Ending watch(const Scene& scene, std::uint64_t cycles = ~std::uint64_t{0});

/// Six planes about a box, as one wall.
void add_box(Scene& scene, const std::string& name, const Vec3& low, const Vec3& high);

void add_triangles(Scene& scene,
                   const std::string& name,
                   std::vector<Vec3> vertices,
                   std::vector<std::vector<std::int64_t>> triangles);

/// All guards but the one against numbers that are not finite say nothing.
void silence_guards(Scene& scene);

/// Numbers of a fixed sequence in [-1, 1), the same everywhere.
class Noise {
public:
    explicit Noise(std::uint64_t seed) : state_(seed) {}

    double next();

    Vec3 vector() { return {next(), next(), next()}; }

private:
    std::uint64_t state_;
};

/// Fewer contacts than hold a sphere up do not brake its rolling and spinning.
inline constexpr std::int32_t contacts_that_hold = 3;

/// Kinetic energy [J], spin included, of the spheres of one mass that are held, and how many are.
struct Held {
    double energy = 0.0;
    std::size_t count = 0;
};

Held held_spheres(const Simulation& simulation, double mass);

}  // namespace grainbench::verify
