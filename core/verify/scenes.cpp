#include "core/verify/scenes.hpp"

namespace grainbench::verify {

Contact contact_of(const Laws& laws) {
    Contact contact;
    contact.stiffness = ConstantStiffness::Params{.normal = laws.normal, .shear = laws.shear};
    if (laws.incremental) {
        contact.normal = IncrementalSpring::Params{};
    }
    if (laws.friction) {
        contact.friction = CoulombFriction::Params{.coefficient = *laws.friction};
    }
    if (laws.damping) {
        contact.damping = ViscousDamping::Params{
            .normal = *laws.damping, .shear = *laws.damping, .mode = laws.damping_mode};
    }
    return contact;
}

Scene scene_of(const Laws& laws, double timestep, double duration, const Sphere& sphere) {
    Scene scene;
    add_species(scene, "ball", sphere);
    scene.contact = contact_of(laws);
    scene.timestep = FixedTimestep{.value = timestep};
    Stage stage;
    stage.name = "only";
    stage.duration = duration;
    scene.stages.push_back(std::move(stage));
    return scene;
}

void add_species(Scene& scene, const std::string& name, const Sphere& sphere) {
    scene.particles.species.push_back(
        {.name = name, .radius = sphere.radius, .density = sphere.density});
}

void add_sphere(Scene& scene,
                const Vec3& position,
                const Vec3& velocity,
                const Vec3& spin,
                const std::string& species) {
    if (scene.particles.insertion.empty()) {
        scene.particles.insertion.emplace_back(ListInsertion{});
    }
    std::get<ListInsertion>(scene.particles.insertion.back())
        .particles.push_back({.species = species,
                              .position = position,
                              .velocity = velocity,
                              .angular_velocity = spin});
}

void add_plane(Scene& scene, const std::string& name, const Vec3& point, const Vec3& normal) {
    Wall wall;
    wall.name = name;
    wall.shape = Plane{.point = point, .normal = normal};
    scene.walls.push_back(std::move(wall));
}

void set_stiffness(
    Scene& scene, const std::string& a, const std::string& b, double normal, double shear) {
    PairContact pair;
    pair.between = {a, b};
    pair.stiffness = ConstantStiffness::Params{.normal = normal, .shear = shear};
    scene.contact.pairs.push_back(std::move(pair));
}

AutomaticTimestep automatic_step(double safety_factor) {
    AutomaticTimestep timestep;
    timestep.safety_factor = safety_factor;
    return timestep;
}

double half_period(double mass, double stiffness) {
    return pi * std::sqrt(mass / stiffness);
}

}  // namespace grainbench::verify
