/// Filters and colours of particles.
#include "render/particle_view.hpp"

#include "core/error.hpp"

#include "tests/unit/io/temporary_folder.hpp"
#include "tests/unit/render/small_run.hpp"

#include <gmock/gmock.h>

namespace grainbench::render {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::SizeIs;

class ParticleViewTest : public testing::Test {
protected:
    explicit ParticleViewTest(std::size_t particles = 60) {
        write_small_run(folder_.path(), particles);
        const RunFrames frames(folder_.path(), {});
        instant_ = frames.read(0);
        names_ = frames.group_names();
    }

    ParticleView view(ParticleColour colour, std::vector<ParticleFilter> filters = {}) const {
        return view_particles(
            instant_, {.colour = std::move(colour), .filters = std::move(filters)}, names_);
    }

    std::string error_of(ParticleColour colour, std::vector<ParticleFilter> filters = {}) const {
        try {
            view(std::move(colour), std::move(filters));
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::bad_input);
            return error.what();
        }
        return "no error";
    }

    TemporaryFolder folder_;
    Instant instant_;
    std::vector<std::string> names_;
};

TEST_F(ParticleViewTest, LayerFilterKeepsTheTopLayerAndEveryIntruder) {
    // 12 of the 60 spheres are in layer 1 and 12 are large; some are both.
    const ParticleView seen = view(SpeciesColour{}, {LayerFilter{{1}, {"large"}}});
    for (std::size_t r = 0; r < 2; ++r) {
        const ParticleFrame& frame = instant_.realisations[r].particles.frame;
        std::size_t expected = 0;
        for (std::size_t k = 0; k < frame.size(); ++k) {
            expected += frame.layer[k] == 1 || frame.species[k] == 1 ? 1U : 0U;
        }
        EXPECT_GT(expected, 12U);
        EXPECT_LT(expected, 60U);
        EXPECT_THAT(seen.realisations.at(r).position, SizeIs(expected));
        EXPECT_THAT(seen.realisations.at(r).colour, SizeIs(expected));
    }
    EXPECT_THAT(seen.key->entries,
                ElementsAre(Pair("small", species_colour(0)), Pair("large", species_colour(1))));
}

TEST_F(ParticleViewTest, SliceAndRegionKeepWhatLiesInside) {
    const ParticleView slice = view(SpeciesColour{}, {SliceFilter{Axis::z, 0.0, 0.01}});
    EXPECT_THAT(slice.realisations.at(0).position, SizeIs(16));
    const ParticleView both =
        view(SpeciesColour{},
             {SliceFilter{Axis::z, 0.0, 0.01}, RegionFilter{{{-1, -1, -1}, {0, 0, 1}}}});
    EXPECT_THAT(both.realisations.at(0).position, SizeIs(4));
}

TEST_F(ParticleViewTest, NamesGroups) {
    EXPECT_THAT(view(GroupColour{}).key->entries,
                ElementsAre(Pair("fine", group_colour(1)), Pair("coarse", group_colour(2))));
}

TEST_F(ParticleViewTest, ScalesReachFromTheLeastToTheMostOrAsAsked) {
    const ColourScale found = *view(SpeedColour{}).scale;
    // Speeds are held with single precision: 0.01 at the bottom, |(0.01, 0.06)| at level 3.
    EXPECT_FLOAT_EQ(static_cast<float>(found.range.low), 0.01F);
    EXPECT_FLOAT_EQ(static_cast<float>(found.range.high), std::sqrt(0.0037F));
    const ColourScale asked =
        *view(ArrayColour{.array = "force", .component = Component::z, .range = Range{-1.0, 3.0}})
             .scale;
    EXPECT_EQ(asked.range.low, -1.0);
    EXPECT_EQ(asked.range.high, 3.0);
    EXPECT_EQ(asked.title, "force, z [N]");
}

TEST_F(ParticleViewTest, ArrayThatIsNotThereListsThoseThatAre) {
    EXPECT_THAT(error_of(ArrayColour{.array = "velocitty"}),
                AllOf(HasSubstr("no array 'velocitty'"),
                      HasSubstr("write 'velocity'"),
                      HasSubstr("'angular_velocity'"),
                      HasSubstr("'contacts'")));
    EXPECT_THAT(error_of(ArrayColour{.array = "radius", .component = Component::x}),
                HasSubstr("one number for each particle"));
    EXPECT_THAT(error_of(LayerColour{}, {SpeciesFilter{{"iron"}}}),
                AllOf(HasSubstr("no species 'iron'"), HasSubstr("'small' or 'large'")));
}

class EmptyFrame : public ParticleViewTest {
protected:
    EmptyFrame() : ParticleViewTest(0) {}
};

TEST_F(EmptyFrame, HasNoColoursAndAScaleAllTheSame) {
    EXPECT_THAT(view(LayerColour{}).key->entries, SizeIs(0));
    const ColourScale scale = *view(SpeedColour{}).scale;
    EXPECT_LT(scale.range.low, scale.range.high);
}

TEST(RangeOf, IsNeverEmpty) {
    for (const double value : {5.0, -2.0}) {
        const Range range = range_of({}, {value, value});
        EXPECT_LT(range.low, value);
        EXPECT_GT(range.high, value);
    }
    const Range nothing_yet = range_of({}, {0.0, 0.0});
    EXPECT_EQ(nothing_yet.low, 0.0);
    EXPECT_GT(nothing_yet.high, 0.0);
}

}  // namespace
}  // namespace grainbench::render
