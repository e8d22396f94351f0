#include "cli/study/recommend.hpp"

#include <fmt/format.h>

#include <cmath>

namespace grainbench::cli {
namespace {

using statistics::Verdict;

/// The fastest of those with the verdict that are faster than `than`; null if there is none.
const VariantResult* fastest(const StudyResult& result, Verdict verdict, double than) {
    const VariantResult* best = nullptr;
    for (const VariantResult& variant : result.variants) {
        const bool counts = !result.is_reference(variant) && !variant.unstable &&
                            variant.verdict == verdict && variant.cost.speed_up > than;
        if (counts && (best == nullptr || variant.cost.speed_up > best->cost.speed_up)) {
            best = &variant;
        }
    }
    return best;
}

std::string margin_text(const StudyResult& result) {
    return fmt::format(
        "{:.3g} {}", result.plan.study.margin * result.quantity.scale, result.quantity.unit);
}

}  // namespace

std::string recommendation_of(const StudyResult& result) {
    const std::string& reference = result.reference().name;
    std::string text = result.plan.quick ? "Shortened study, no ground for a choice. " : "";
    double reached = 1.0;
    if (const VariantResult* same = fastest(result, Verdict::same, 1.0)) {
        reached = same->cost.speed_up;
        text += fmt::format(
            "Use '{}': {:.2g} times as fast as '{}', and its {} is the same within "
            "{} (95 % confidence).",
            same->name,
            reached,
            reference,
            result.quantity.name,
            margin_text(result));
    } else {
        text += fmt::format(
            "Stay with '{}': of nothing faster it is shown that its {} is the same "
            "within {}.",
            reference,
            result.quantity.name,
            margin_text(result));
    }
    if (const VariantResult* open = fastest(result, Verdict::undecided, reached)) {
        text += fmt::format(
            " '{}' is {:.2g} times as fast and undecided; ", open->name, open->cost.speed_up);
        if (open->needed) {
            text += fmt::format("{} realisations would tell.", *open->needed);
        } else if (std::isfinite(open->largest().standard_error)) {
            text += "no affordable number of realisations would tell.";
        } else {
            text += "a single realisation tells nothing of the spread.";
        }
    }
    return text;
}

std::string deviation_text(const VariantResult& variant, const Quantity& quantity) {
    if (variant.difference.at.empty()) {
        return "-";
    }
    const statistics::Estimate largest = variant.largest();
    const double value = quantity.scale * largest.value;
    if (!std::isfinite(largest.standard_error)) {
        return fmt::format("{:+.3g}", value);
    }
    const statistics::Interval interval = statistics::interval_of(largest, 0.95);
    return fmt::format("{:+.3g} [{:.3g}, {:.3g}]",
                       value,
                       quantity.scale * interval.low,
                       quantity.scale * interval.high);
}

std::string verdict_text(const StudyResult& result, const VariantResult& variant) {
    if (result.is_reference(variant)) {
        return "reference";
    }
    if (variant.unstable) {
        return "unstable";
    }
    std::string text(statistics::name_of(variant.verdict));
    if (variant.verdict == Verdict::undecided) {
        text += variant.needed ? fmt::format(", {} would tell", *variant.needed) : "";
    }
    return text;
}

}  // namespace grainbench::cli
