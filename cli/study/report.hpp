/// The result of a study for people and for scripts.
#pragma once

#include "cli/study/result.hpp"
#include "cli/study/table.hpp"

#include <filesystem>
#include <string>

namespace grainbench::cli {

/// Who made a study, where and by which command.
struct StudyOrigin {
    std::string command;
    std::string cpu;
    unsigned threads = 1;
    std::string date;  ///< day
};

/// One row per variant: cost, deviation and verdict; what others published where a study says so.
Table variants_table(const StudyResult& result);

/// One row per variant and number of realisations; empty where the study asks for none.
Table growth_table(const StudyResult& result);

/// Table, warnings and recommendation.
std::string study_text(const StudyResult& result);

/// One row per variant, plain numbers in SI units.
std::string study_csv(const StudyResult& result);

/// Everything but the curves of single realisations.
std::string study_json(const StudyResult& result, const StudyOrigin& origin);

/// Writes study.json, variants.csv, curves.csv, study.md, index.html and the charts, each with its
/// numbers as CSV, into the folder.
void write_study_folder(const StudyResult& result,
                        const StudyOrigin& origin,
                        const std::filesystem::path& folder);

}  // namespace grainbench::cli
