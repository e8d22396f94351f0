/// What the tests of scene reading share: documents to start from, and errors as values.
#pragma once

#include "core/error.hpp"
#include "core/scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace grainbench::testing_support {

using Json = nlohmann::ordered_json;

/// All files of presets/scenes, sorted.
std::vector<std::filesystem::path> preset_files();

std::filesystem::path preset(const std::string& name);

std::string text_of(const std::filesystem::path& file);

void write_text(const std::filesystem::path& file, const std::string& text);

/// Fresh empty folder for the running test.
std::filesystem::path test_folder();

/// Document that holds each key of each object (every_key.json).
Json every_key();

/// Folder with the files that every_key() imports.
std::filesystem::path import_folder();

/// A scene of one ball, as small as the rules allow.
Json smallest_scene();

/// Parses; nothing if it is accepted.
std::optional<Error> error_of(const std::string& text, const std::filesystem::path& folder);
std::optional<Error> error_of(const Json& document);

/// Reads a preset with overrides; nothing if it is accepted.
std::optional<Error> error_of_preset(const std::string& name,
                                     const std::vector<std::string>& overrides);

}  // namespace grainbench::testing_support
