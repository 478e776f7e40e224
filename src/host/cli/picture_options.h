// picture_options.h — What `analyze` draws: the options of pictures and of the exported scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "analysis/metric.h"
#include "cli/command_line.h"
#include "mesh/scene.h"
#include "pictures/picture_content.h"
#include "pictures/scene_studio.h"

namespace scene_analyzer::cli {

struct PictureRequest {
  std::optional<std::filesystem::path> image;      // --image: one PNG file, of `content`
  std::optional<std::filesystem::path> image_set;  // --image-set: a folder for one of everything
  pictures::Content content;                       // subject, colour map, emphasis
  pictures::PictureFormat format;                  // size and target

  bool wanted() const { return image || image_set; }
};

void add_picture_options(Options& options);

// Of --export. Throws UsageError.
std::optional<std::filesystem::path> read_export(const CommandLine& line);

// Throws UsageError, also for options that change nothing without --image, --image-set or --export.
PictureRequest read_pictures(const CommandLine& line, analysis::MetricSet metrics, bool relative);

}  // namespace scene_analyzer::cli
