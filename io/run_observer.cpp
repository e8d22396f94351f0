// What a simulation reports goes into its run folder. Apart from run_folder.cpp, because this is
// the only file of io that calls the engine.
#include "core/simulation.hpp"

#include "io/run_folder.hpp"

namespace grainbench::io {
namespace {

class RunObserver : public Observer {
public:
    RunObserver(RunFolder& folder, std::size_t realisation)
        : folder_(&folder), realisation_(realisation) {}

    void on_history(const Simulation& simulation) override {
        folder_->append_history(
            realisation_, simulation.history_columns(), simulation.history_row());
    }

    void on_trace(const Simulation& simulation) override {
        folder_->append_trace(realisation_, simulation.time(), simulation.trace_points());
    }

    void on_frame(const Simulation& simulation) override {
        // Frames are taken on the thread of the simulation; only the writing takes turns.
        const ParticleFrame particles = simulation.particle_frame();
        const WallFrame walls = simulation.wall_frame();
        if (folder_->wants_contacts(simulation.stage())) {
            const ContactFrame contacts = simulation.contact_frame();
            folder_->write_frame(realisation_, particles, walls, &contacts);
        } else {
            folder_->write_frame(realisation_, particles, walls, nullptr);
        }
    }

    void on_fields(const Simulation& simulation) override {
        folder_->write_fields(realisation_, simulation.field_frame());
    }

    void on_checkpoint(const Simulation& simulation) override {
        Archive archive;
        simulation.save(archive);
        folder_->write_checkpoint(realisation_, std::move(archive));
    }

private:
    RunFolder* folder_;
    std::size_t realisation_;
};

}  // namespace

Observer& RunFolder::observer(std::size_t realisation) {
    const std::scoped_lock lock(observers_mutex_);
    std::unique_ptr<Observer>& observer = observers_.at(realisation);
    if (!observer) {
        observer = std::make_unique<RunObserver>(*this, realisation);
    }
    return *observer;
}

}  // namespace grainbench::io
