#include "cli/bench/work_model.hpp"

#include <variant>

namespace grainbench::cli {

namespace {

// Bytes. A packet is four doubles; particles have five (core/kernels/kernels.hpp).
constexpr double packet = 32.0;
constexpr double flag = 1.0;
constexpr double index = 4.0;
constexpr double pair = 2.0 * index;
constexpr double bit = 1.0 / 8.0;

// Operations, counted in the source of the passes; comparisons and choices are left out.
constexpr double drift_operations = 18.0;    // fall 3, drift 6, sum of velocities 3, fastest 6
constexpr double kick_operations = 18.0;     // force and torque, 9 each
constexpr double test_operations = 12.0;     // apart 3, square 5, reach 3, its square 1
constexpr double shape_operations = 18.0;    // apart, distance, normal, overlap, levers
constexpr double mass_operations = 2.0;      // effective mass
constexpr double opening_operations = 8.0;   // relative velocity, its normal part
constexpr double sliding_operations = 41.0;  // with spins: sliding velocity, mean spin
constexpr double linear_operations = 1.0;
constexpr double incremental_operations = 4.0;
constexpr double friction_operations = 63.0;  // carry 48, increment 5, trial and limit 10
constexpr double damping_operations = 14.0;
constexpr double force_operations = 10.0;  // sum of the parts, added to two bodies
constexpr double shear_force_operations = 6.0;
constexpr double torque_operations = 21.0;
constexpr double sum_operations = 30.0;  // a contact in the sums for the stable step
constexpr double step_operations = 6.0;  // a particle in them

struct ContactWork {
    double operations = 0.0;
    double history = 0.0;        ///< [B] per contact
    double read_packets = 1.0;   ///< of each particle: position, then velocity, spin
    double added_packets = 1.0;  ///< force, then torque
};

ContactWork contact_work(const Contact& contact) {
    const bool is_incremental = std::holds_alternative<IncrementalSpring::Params>(contact.normal);
    const bool has_shear = contact.friction.has_value() || contact.damping.has_value();
    ContactWork work;
    work.operations = shape_operations + force_operations +
                      (is_incremental ? incremental_operations : linear_operations);
    if (is_incremental || has_shear) {
        work.operations += opening_operations;
        work.read_packets = 2.0;
    }
    if (has_shear) {
        work.operations += sliding_operations + shear_force_operations + torque_operations;
        work.read_packets = 3.0;
        work.added_packets = 2.0;
    }
    if (contact.friction) {
        work.operations += friction_operations;
    }
    if (contact.damping) {
        work.operations += damping_operations + mass_operations;
    }
    work.history = is_incremental || contact.friction ? packet : 0.0;
    return work;
}

}  // namespace

Work work_of(const WorkCounts& n, const Contact& contact, bool automatic_step) {
    const ContactWork c = contact_work(contact);
    const double kicked = n.loaded < 0.5 ? n.loaded : 1.0;  // Engine::few_are_loaded, nearly
    Work work;
    // Motion: position and velocity of all; force, torque and spin of those that are loaded.
    work.bytes += 2.0 * 2.0 * packet + 2.0 * flag + kicked * 2.0 * 3.0 * packet;
    work.operations += drift_operations + kicked * kick_operations;
    // Which objects touch: all are charged, of which those in doubt are tested (TouchFinder).
    work.bytes += packet + n.objects * (pair + bit);
    work.operations += n.objects * test_operations;
    // Contacts.
    work.bytes += n.touching * (index + pair + 2.0 * c.history) +
                  n.loaded * (flag + packet * (c.read_packets + 2.0 * c.added_packets));
    work.operations += n.touching * c.operations;
    // Renewal of the objects, their histories among them; then the sums for the stable step.
    work.bytes += n.renewals * (packet + n.candidates * pair + n.objects * (pair + c.history) +
                                n.touching * 2.0 * c.history);
    work.operations += n.renewals * n.candidates * test_operations;
    if (automatic_step) {
        work.bytes += n.renewals * (4.0 * packet + n.objects * (index + pair));
        work.operations += n.renewals * (n.objects * sum_operations + step_operations);
    }
    // Candidates: cells sorted, neighbours tested (as many again fail), pairs put in order.
    work.bytes += n.builds * (3.0 * packet + 3.0 * n.candidates * pair);
    work.operations += n.builds * 2.0 * n.candidates * test_operations;
    work.working_set = n.particles * (5.0 * packet + flag + n.candidates * pair +
                                      n.objects * (pair + c.history) + n.touching * index);
    return work;
}

}  // namespace grainbench::cli
