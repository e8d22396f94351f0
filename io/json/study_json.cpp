#include "io/json/read_described.hpp"
#include "io/json/reference_builder.hpp"
#include "io/json/schema_builder.hpp"
#include "io/study.hpp"

#include <algorithm>
#include <set>

namespace grainbench::io {
namespace {

constexpr std::string_view preamble =
    R"(# Study reference

One JSON file describes a study: a scene, settings to compare on it, and the difference that does not
matter. `grainbench study STUDY.json` runs it; [studies](studies.md) says how to read the answer. A file
may start from another one by `"extends": "other.json"`.

This page is made of the field tables of the program (`grainbench schema study`); edit those, not this.
)";

void check_names(const Study& study, Problems& problems) {
    std::vector<std::string_view> names;
    const std::vector<StudyVariant> variants = variants_of(study);
    for (const StudyVariant& variant : variants) {
        if (std::find(names.begin(), names.end(), variant.name) != names.end()) {
            problems.add({.pointer = "/variants",
                          .what = "two variants are called '" + variant.name + "'",
                          .likely_cause = "a copied entry, or an axis that repeats a variant",
                          .next_step = "rename one of them"});
        }
        names.push_back(variant.name);
    }
    if (names.size() < 2) {
        problems.add({.pointer = "/variants",
                      .what = "a study compares at least two variants",
                      .likely_cause = "'variants' and 'axes' are missing or short",
                      .next_step = "name the settings to compare"});
        return;
    }
    const auto check = [&](const std::string& pointer, const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            problems.add(unknown_name(pointer, "variant", name, names));
        }
    };
    check("/reference", study.reference);
    if (study.quick) {
        for (std::size_t k = 0; k < study.quick->variants.size(); ++k) {
            check("/quick/variants/" + std::to_string(k), study.quick->variants[k]);
        }
    }
}

void check_numbers(const Study& study, Problems& problems) {
    for (std::size_t k = 0; k < study.growth.size(); ++k) {
        if (study.growth[k] > study.realisations) {
            problems.add({.pointer = "/growth/" + std::to_string(k),
                          .what = std::to_string(study.growth[k]) + " realisations are more than " +
                                  std::to_string(study.realisations) + " that are run",
                          .likely_cause = "'realisations' is too small",
                          .next_step = "raise 'realisations' or remove the entry"});
        }
    }
    const auto* profile = std::get_if<FinalProfile>(&study.observable);
    if (profile != nullptr && profile->high <= profile->low) {
        problems.add({.pointer = "/observable/high",
                      .what = "the profile ends where it begins, or before",
                      .likely_cause = "'low' and 'high' are swapped",
                      .next_step = "give a high that is above low"});
    }
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
    Study study = read_described<Study>(file);
    validate_study(study, file.string());
    return study;
}

void validate_study(const Study& study, const std::string& name) {
    Problems problems;
    check_names(study, problems);
    check_numbers(study, problems);
    problems.raise_if_any(name);
}

std::string write_study(const Study& study) {
    return pretty_text(write_value(study));
}

std::vector<StudyVariant> variants_of(const Study& study) {
    std::vector<StudyVariant> variants = study.variants;
    if (study.axes.empty()) {
        return variants;
    }
    std::vector<StudyVariant> combined{StudyVariant{}};
    for (const StudyAxis& axis : study.axes) {
        std::vector<StudyVariant> longer;
        for (const StudyVariant& before : combined) {
            for (const StudyVariant& value : axis.values) {
                StudyVariant both = before;
                both.name += (both.name.empty() ? "" : ", ") + value.name;
                both.set.insert(both.set.end(), value.set.begin(), value.set.end());
                // A cost that was published holds for a combination only if it is of one knob.
                both.published = study.axes.size() == 1 ? value.published : std::nullopt;
                longer.push_back(std::move(both));
            }
        }
        combined = std::move(longer);
    }
    variants.insert(variants.end(), combined.begin(), combined.end());
    return variants;
}

std::string study_schema() {
    SchemaBuilder builder;
    return pretty_text(file_schema<Study>(
        builder, "grainbench study", "Settings of a scene to compare: accuracy against time"));
}

std::string study_reference() {
    ReferenceBuilder builder(preamble);
    builder.add_section<Study>({});
    return builder.text();
}

}  // namespace grainbench::io
