// measuring_options.h — Options of every command that measures assets: what is measured, on what, kept where.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::cli {

// The groups "Measuring" and "Running" of the help.
void add_measuring_options(Options& options);
void add_running_options(Options& options);
// Of "Running" what does not say where analysis files are kept.
void add_device_options(Options& options);
std::string metric_help();

// All throw UsageError.
void read_measuring(const CommandLine& line, pipeline::Options& options);
// The device's selector, "" for the preferred one.
std::string read_device(const CommandLine& line, pipeline::Options& options);
std::string read_running(const CommandLine& line, pipeline::Options& options);
// A folder that exists, or can be made later. Absent when it was not given.
std::optional<std::filesystem::path> read_folder(const CommandLine& line, const std::string& option);
// At least one asset, none without a name. `command` is for the example.
void check_assets(const std::vector<std::string>& assets, const char* command);

}  // namespace scene_analyzer::cli
