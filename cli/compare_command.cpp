#include "cli/compare_command.hpp"

#include "core/error.hpp"

#include "io/text.hpp"

#include "render/image.hpp"
#include "render/image_comparison.hpp"

#include "cli/compare/bench_comparison.hpp"
#include "cli/compare/run_comparison.hpp"
#include "cli/exit_codes.hpp"

#include <fmt/format.h>

#include <string>

namespace grainbench::cli {
namespace {

namespace fs = std::filesystem;

constexpr double picture_threshold = 0.02;
constexpr double bench_threshold = 0.1;
constexpr double run_threshold = 0.0;

/// What can be compared; the kind of the arguments decides which comparison runs.
enum class Kind { image, bench, run, unknown };

Kind kind_of(const fs::path& path) {
    if (fs::is_directory(path)) {
        return Kind::run;
    }
    return path.extension() == ".png"    ? Kind::image
           : path.extension() == ".json" ? Kind::bench
                                         : Kind::unknown;
}

int compare_pictures(const CompareArguments& arguments, const Streams& streams) {
    const render::ImageComparison comparison = render::compare_images(
        render::read_png(arguments.first), render::read_png(arguments.second));
    const double difference = 1.0 - comparison.similarity;
    const double threshold = arguments.threshold.value_or(picture_threshold);
    const bool is_alike = difference <= threshold;
    if (!arguments.difference.empty()) {
        render::write_png(arguments.difference, comparison.difference, {});
    }
    if (arguments.json) {
        streams.out << fmt::format(
            "{{\"ssim\": {}, \"difference\": {}, \"threshold\": {}, \"alike\": {}, "
            "\"differing_pixels\": {}, \"lowest_ssim\": {}, \"lowest_at\": [{}, {}]}}\n",
            io::to_text(comparison.similarity),
            io::to_text(difference),
            io::to_text(threshold),
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
            io::to_text(threshold),
            comparison.differing_pixels,
            comparison.lowest_x,
            comparison.lowest_y,
            comparison.lowest);
    }
    return is_alike ? exit_ok : exit_check_failed;
}

int compare_bench_results(const CompareArguments& arguments, const Streams& streams) {
    const double threshold = arguments.threshold.value_or(bench_threshold);
    const BenchComparison comparison =
        compare_benchmarks(arguments.first, arguments.second, threshold);
    streams.out << (arguments.json ? to_json(comparison, threshold)
                                   : to_text(comparison, threshold));
    return is_too_slow(comparison) ? exit_check_failed : exit_ok;
}

int compare_run_folders(const CompareArguments& arguments, const Streams& streams) {
    const double threshold = arguments.threshold.value_or(run_threshold);
    const RunComparison comparison = compare_runs(arguments.first, arguments.second);
    streams.out << (arguments.json ? to_json(comparison, threshold)
                                   : to_text(comparison, threshold));
    return comparison.is_within(threshold) ? exit_ok : exit_check_failed;
}

}  // namespace

int compare_command(const CompareArguments& arguments, const Streams& streams) {
    const Kind kind = kind_of(arguments.first) == kind_of(arguments.second)
                          ? kind_of(arguments.first)
                          : Kind::unknown;
    if (kind != Kind::image && !arguments.difference.empty()) {
        throw_bad_input({.what = "only pictures have a difference picture",
                         .where = "-o " + arguments.difference.string(),
                         .likely_cause = "the output of the comparison was meant to go to a file",
                         .next_step = "leave -o out and redirect stdout"});
    }
    switch (kind) {
        case Kind::image:
            return compare_pictures(arguments, streams);
        case Kind::bench:
            return compare_bench_results(arguments, streams);
        case Kind::run:
            return compare_run_folders(arguments, streams);
        case Kind::unknown:
            break;
    }
    throw_bad_input(
        {.what = "these two cannot be compared",
         .where = arguments.first.string() + " and " + arguments.second.string(),
         .likely_cause = "they are not of one kind: two PNG pictures, two results of `grainbench "
                         "bench --json` (.json) or two run folders",
         .next_step = "grainbench compare A.png B.png, or OLD.json NEW.json, or RUN_A RUN_B"});
}

}  // namespace grainbench::cli
