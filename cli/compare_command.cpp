#include "cli/compare_command.hpp"

#include "core/error.hpp"

#include "io/text.hpp"

#include "render/image.hpp"
#include "render/image_comparison.hpp"

#include "cli/exit_codes.hpp"

#include <fmt/format.h>

#include <string>

namespace grainbench::cli {
namespace {

namespace fs = std::filesystem;

/// What can be compared; the kind of the arguments decides which comparison runs.
enum class Kind { image, unknown };

Kind kind_of(const fs::path& path) {
    return path.extension() == ".png" ? Kind::image : Kind::unknown;
}

int compare_pictures(const CompareArguments& arguments, const Streams& streams) {
    const render::ImageComparison comparison = render::compare_images(
        render::read_png(arguments.first), render::read_png(arguments.second));
    const double difference = 1.0 - comparison.similarity;
    const bool is_alike = difference <= arguments.threshold;
    if (!arguments.difference.empty()) {
        render::write_png(arguments.difference, comparison.difference, {});
    }
    if (arguments.json) {
        streams.out << fmt::format(
            "{{\"ssim\": {}, \"difference\": {}, \"threshold\": {}, \"alike\": {}, "
            "\"differing_pixels\": {}, \"lowest_ssim\": {}, \"lowest_at\": [{}, {}]}}\n",
            io::to_text(comparison.similarity),
            io::to_text(difference),
            io::to_text(arguments.threshold),
            is_alike,
            comparison.differing_pixels,
            io::to_text(comparison.lowest),
            comparison.lowest_x,
            comparison.lowest_y);
    } else {
        streams.out << fmt::format(
            "similarity  {:.6f} (SSIM; 1 = the same, 0 = nothing in common): {}\n"
            "difference  {:.6f}, {} the threshold of {}\n"
            "pixels      {} differ; least alike around ({}, {}) from the upper left, SSIM {:.3f}\n",
            comparison.similarity,
            render::similarity_in_words(comparison),
            difference,
            is_alike ? "within" : "over",
            io::to_text(arguments.threshold),
            comparison.differing_pixels,
            comparison.lowest_x,
            comparison.lowest_y,
            comparison.lowest);
    }
    return is_alike ? exit_ok : exit_check_failed;
}

}  // namespace

int compare_command(const CompareArguments& arguments, const Streams& streams) {
    if (kind_of(arguments.first) == Kind::image && kind_of(arguments.second) == Kind::image) {
        return compare_pictures(arguments, streams);
    }
    throw_bad_input(
        {.what = "these two cannot be compared",
         .where = arguments.first.string() + " and " + arguments.second.string(),
         .likely_cause = "they are not two files of one kind; PNG pictures can be compared",
         .next_step = "grainbench compare A.png B.png"});
}

}  // namespace grainbench::cli
