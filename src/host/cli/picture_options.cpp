#include "cli/picture_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "cli/option_parsing.h"

namespace scene_analyzer::cli {
namespace {

using pictures::Subject;

constexpr std::uint32_t kLeastWidth = 240, kLeastHeight = 120;  // below it no legend can be read
constexpr std::array<std::string_view, 4> kMapNames = {"thesis", "viridis", "cividis", "coolwarm"};

[[noreturn]] void refuse_name(const std::string& option, const std::string& text,
                              const std::vector<std::string>& known) {
  const std::string meant = nearest(text, known);
  throw UsageError(fmt::format("--{}: '{}' is none of {}{}", option, text, fmt::join(known, ", "),
                               meant.empty() ? "" : fmt::format("; did you mean {}?", meant)));
}

void read_subject(const std::string& text, analysis::MetricSet metrics, pictures::Content& content) {
  std::vector<std::string> known = {"aggregate", "planar_groups"};
  known.insert(known.end(), analysis::kMetricKeys.begin(), analysis::kMetricKeys.end());
  if (text == "aggregate") {
    content.subject = Subject::kAggregate;
  } else if (text == "planar_groups") {
    content.subject = Subject::kPlanarGroups;
  } else if (const auto metric = analysis::metric_of(text)) {
    content.subject = Subject::kMetric;
    content.metric = *metric;
    if (!metrics[index_of(*metric)])
      throw UsageError(fmt::format("--metric: {} is not among the metrics that --metrics asks for", text));
  } else {
    refuse_name("metric", text, known);
  }
}

ratings::ColorMap read_map(const std::string& text) {
  const auto* found = std::ranges::find(kMapNames, text);
  if (found == kMapNames.end()) refuse_name("colormap", text, {kMapNames.begin(), kMapNames.end()});
  return static_cast<ratings::ColorMap>(found - kMapNames.begin());
}

void read_content(const CommandLine& line, analysis::MetricSet metrics, pictures::Content& content) {
  if (const auto subject = line.value("metric")) read_subject(*subject, metrics, content);
  if (const auto map = line.value("colormap")) content.map = read_map(*map);
  const auto emphasis = line.value("emphasis");
  if (!emphasis) return;
  if (*emphasis != "extremes") refuse_name("emphasis", *emphasis, {"extremes"});
  content.emphasize_extremes = true;
  if (content.subject == Subject::kPlanarGroups)
    throw UsageError("--emphasis: planar groups have no extreme meshes; choose another --metric");
}

}  // namespace

void add_picture_options(Options& options) {
  options.add("Pictures",
              {
                  {"export",
                   "write the scene as binary glTF with the colours of ratings as vertex colours, and "
                   "ratings as extras of its nodes, for any viewer or modelling program",
                   "FILE.glb"},
                  {"image", "draw the scene, every mesh in the colour of its rating, and write it to FILE",
                   "FILE.png"},
                  {"image-set",
                   "draw every metric, absolute and relative, the aggregate, the planar groups and the "
                   "scene's own colours, and write them into DIR",
                   "DIR"},
                  {"metric",
                   "what the picture of --image shows: a metric, aggregate (default), or planar_groups: "
                   "triangles by the size of their group",
                   "KEY"},
                  {"colormap",
                   "thesis (default: green, yellow, red), viridis or cividis (readable with a colour vision "
                   "deficiency), coolwarm",
                   "NAME"},
                  {"size", "size of pictures, legend included, default 1280x720", "WxH"},
                  {"target",
                   "where pictures look at, world units, with a field of view of 45 degrees; default the "
                   "middle of the scene, all of it in view",
                   "X,Y,Z"},
                  {"emphasis",
                   "extremes: meshes below the upper quarter of the scene's range become transparent, so "
                   "that small and hidden ones are found",
                   "extremes"},
              });
}

std::optional<std::filesystem::path> read_export(const CommandLine& line) {
  const std::optional<std::filesystem::path> file = line.value("export");
  if (file && file->extension() != ".glb")
    throw UsageError(fmt::format("--export writes binary glTF; '{}' does not end in .glb", file->string()));
  return file;
}

PictureRequest read_pictures(const CommandLine& line, analysis::MetricSet metrics, bool relative) {
  PictureRequest request;
  request.image = line.value("image");
  request.image_set = line.value("image-set");
  const bool exported = line.value("export").has_value();
  for (const char* option : {"size", "target", "emphasis"})
    if (!request.wanted() && line.value(option))
      throw UsageError(
          fmt::format("--{} is about a picture; add --image FILE.png or --image-set DIR", option));
  for (const char* option : {"metric", "colormap"})
    if (!request.wanted() && !exported && line.value(option))
      throw UsageError(fmt::format(
          "--{} is about colours; add --image FILE.png, --image-set DIR or --export FILE.glb", option));
  if (!request.image && !exported && line.value("metric"))
    throw UsageError("--metric chooses what --image and --export show; --image-set shows everything");
  if (request.image && request.image->extension() != ".png")
    throw UsageError(
        fmt::format("--image writes PNG files; '{}' does not end in .png", request.image->string()));
  read_content(line, metrics, request.content);
  if (exported && request.content.subject == Subject::kPlanarGroups)
    throw UsageError(
        "--export has one colour per mesh, which planar_groups has not; choose another --metric");
  request.content.relative = relative;
  if (const auto size = line.value("size"))
    std::tie(request.format.width, request.format.height) = parse_pixels("size", *size);
  if (request.format.width < kLeastWidth || request.format.height < kLeastHeight)
    throw UsageError(fmt::format("--size: pictures have at least {} x {} pixels", kLeastWidth, kLeastHeight));
  if (const auto target = line.value("target")) request.format.target = parse_vector3("target", *target);
  return request;
}

}  // namespace scene_analyzer::cli
