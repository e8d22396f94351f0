/// The answer of a study in words.
#pragma once

#include "cli/study/result.hpp"

#include <string>

namespace grainbench::cli {

/// The cheapest setting that is still right, and what might be cheaper.
std::string recommendation_of(const StudyResult& result);

/// "+0.12 [-0.30, 0.54]" in the unit of the quantity.
std::string deviation_text(const VariantResult& variant, const Quantity& quantity);

/// "same", "different", "undecided, 12 would tell", "unstable", "reference"
std::string verdict_text(const StudyResult& result, const VariantResult& variant);

}  // namespace grainbench::cli
