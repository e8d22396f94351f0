// What a simulation reports goes into its run folder. Apart from run_folder.cpp, because this is
// the only file of io that calls the engine.
#include "core/simulation.hpp"

#include "io/run_folder.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace grainbench::io {
namespace {

class RunObserver : public Observer {
public:
    RunObserver(RunFolder& folder, Background& background, std::size_t realisation)
        : folder_(&folder), background_(&background), realisation_(realisation) {}

    void on_history(const Simulation& simulation) override {
        if (!columns_) {
            columns_ = std::make_shared<const Columns>(simulation.history_columns());
        }
        background_->post([this, columns = columns_, row = simulation.history_row()] {
            folder_->append_history(realisation_, *columns, row);
        });
    }

    void on_trace(const Simulation& simulation) override {
        background_->post([this, time = simulation.time(), points = simulation.trace_points()] {
            folder_->append_trace(realisation_, time, points);
        });
    }

    void on_frame(const Simulation& simulation) override {
        background_->make_room();

        struct Frame {
            ParticleFrame particles;
            WallFrame walls;
            std::optional<ContactFrame> contacts;
        };

        const auto frame = std::make_shared<Frame>();
        frame->particles = simulation.particle_frame();
        frame->walls = simulation.wall_frame();
        if (folder_->wants_contacts(simulation.stage())) {
            frame->contacts = simulation.contact_frame();
        }
        background_->post_large([this, frame] {
            folder_->write_frame(realisation_,
                                 frame->particles,
                                 frame->walls,
                                 frame->contacts ? &*frame->contacts : nullptr);
        });
    }

    void on_fields(const Simulation& simulation) override {
        background_->make_room();
        const auto fields = std::make_shared<const FieldFrame>(simulation.field_frame());
        background_->post_large([this, fields] { folder_->write_fields(realisation_, *fields); });
    }

    void on_checkpoint(const Simulation& simulation) override {
        background_->make_room();
        const auto archive = std::make_shared<Archive>();
        simulation.save(*archive);
        background_->post_large(
            [this, archive] { folder_->write_checkpoint(realisation_, std::move(*archive)); });
    }

private:
    using Columns = std::vector<HistoryColumn>;

    RunFolder* folder_;
    Background* background_;
    std::size_t realisation_;
    std::shared_ptr<const Columns> columns_;  ///< for the simulation may be gone by then
};

}  // namespace

Observer& RunFolder::observer(std::size_t realisation) {
    const std::scoped_lock lock(observers_mutex_);
    std::unique_ptr<Observer>& observer = observers_.at(realisation);
    if (!observer) {
        observer = std::make_unique<RunObserver>(*this, background_, realisation);
    }
    return *observer;
}

}  // namespace grainbench::io
