/// `grainbench study --single-contact`: how errors of one impact fall with the steps in it, and why
/// the example's bed runs at 2e-5 s and not at 3e-5 s.
#pragma once

#include "core/verify/work_precision.hpp"

#include "render/chart.hpp"

#include "cli/study/report.hpp"
#include "cli/study/table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace grainbench::cli {

struct SingleContactResult {
    std::vector<verify::WorkCurve> curves;
    std::vector<verify::StepPoint> steps;
};

SingleContactResult study_single_contact();

/// Order of convergence of each outcome, one row per law and mode.
Table orders_table(const SingleContactResult& result);

/// Errors at few steps, of the example's law.
Table errors_table(const SingleContactResult& result);

/// Error of one outcome against steps per contact, for each law and mode.
render::Chart work_chart(const SingleContactResult& result, verify::Outcome outcome);

/// Errors of all outcomes, of the example's law.
render::Chart outcomes_chart(const SingleContactResult& result);

/// Energy error of impacts against the step, with the example's steps and the sticking limit.
render::Chart step_chart(const SingleContactResult& result);

std::string single_contact_text(const SingleContactResult& result);

/// Writes index.html, single-contact.md, single-contact.csv and the charts into the folder.
void write_single_contact_folder(const SingleContactResult& result,
                                 const StudyOrigin& origin,
                                 const std::filesystem::path& folder);

}  // namespace grainbench::cli
